/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "study/find.h"

enum { digits = 12 };

static void put_value(struct text *text, const struct fbd_find *find, double value)
{
    text_number(text, value, digits);
    if (find->shown_unit[0]) text_printf(text, " %s", find->shown_unit);
}

/* ---- text */

static void write_question(struct text *text, const struct fbd_find *find)
{
    static const char *const words[] = {
        [find_happenings] = "the happenings change", [find_equilibrium] = "equilibrium ceases or begins"};
    text_printf(text, "%s from ", find->parameter);
    text_number(text, find->from, digits);
    text_add(text, " to ");
    put_value(text, find, find->to);
    text_add(text, ": where ");
    if (find->condition[0])
        text_shown(text, find->condition);
    else
        text_add(text, words[find->kind]);
    text_add(text, find->kind == find_event   ? " begins or ceases to happen\n"
                   : find->kind == find_limit ? " is reached\n"
                                              : "\n");
}

/* The length of the entries that two stories begin with alike. */
static size_t common_start(const char *a, const char *b)
{
    size_t common = 0;
    for (size_t i = 0; a[i] && a[i] == b[i]; i++)
        if (a[i] == ',') common = i + 2;
    return common;
}

/* A story without the entries that both sides begin with, and cut to about a line. */
static void write_side(struct text *text, const char *side, const char *story, size_t common)
{
    enum { longest = 70 };
    const char *rest = story + common, *end = rest;
    text_printf(text, "      %s   %s", side, common > 0 ? "... " : story[0] ? "" : "nothing happens");
    if (common > 0 && !*rest) text_add(text, "and no more");
    for (const char *next = rest; *next && next - rest <= longest; next += strspn(next, ", "))
        end = next += strcspn(next, ",");
    text_add_bytes(text, rest, (size_t)(end - rest));
    text_add(text, *end ? ", ...\n" : "\n");
}

static void write_sides(struct text *text, const fbd_solution *solution)
{
    const size_t common = common_start(solution->below, solution->above);
    write_side(text, "below", solution->below, common);
    write_side(text, "above", solution->above, common);
}

/* The digits of a value that are above its error. */
static int digits_above(double value, double error)
{
    const double known = floor(log10(fabs(value) / error));
    return (int)fmin(digits, fmax(3, isfinite(known) ? known : 0));
}

static void write_solution(struct text *text, const struct fbd_find *find, const fbd_solution *solution)
{
    static const char *const notes[] = {[FBD_SOLUTION_ROOT] = "",
                                        [FBD_SOLUTION_CHANGE] = "",
                                        [FBD_SOLUTION_JUMP] = "   (no solution: the difference jumps there)"};
    text_printf(text, "  %s = ", find->parameter);
    text_number(text, solution->value, digits_above(solution->value, solution->error));
    if (find->shown_unit[0]) text_printf(text, " %s", find->shown_unit);
    text_add(text, solution->closed_form ? "   (closed form: the margin is linear)" : "   +- ");
    if (!solution->closed_form) text_number(text, solution->error, 2);
    text_printf(text, "%s\n", notes[solution->kind]);
    const bool root = solution->kind == FBD_SOLUTION_ROOT;
    if (!root)
        write_sides(text, solution);
    else
        text_printf(text, "      %s from %s to %s\n",
                    find->kind == find_equation ? "left side - right side" : "margin", solution->below,
                    solution->above);
}

static void write_gap(struct text *text, const struct fbd_find *find, const fbd_find_gap *gap)
{
    text_add(text, "  ");
    put_value(text, find, gap->value);
    text_printf(text, "   %s", gap->failed ? gap->status : "no value");
    text_add(text, gap->reason[0] ? ": " : "");
    text_shown(text, gap->reason);
    text_add(text, "\n");
}

static void write_gaps(struct text *text, const struct fbd_find *find)
{
    enum { most_listed = 10 };
    if (find->gap_count == 0) return;
    text_printf(text, "\nNot searched: beside %zu run%s without a value, with %s =\n", find->gap_count,
                find->gap_count > 1 ? "s" : "", find->parameter);
    for (size_t i = 0; i < find->gap_count && i < most_listed; i++) write_gap(text, find, &find->gaps[i]);
    if (find->gap_count > most_listed) text_printf(text, "  and %zu others\n", find->gap_count - most_listed);
}

/* The ends of the range whose outcome no other value has. */
static void write_alone(struct text *text, const struct fbd_find *find)
{
    for (int end = 0; end < 2; end++) {
        if (!find->alone[end]) continue;
        text_add(text, "      with ");
        put_value(text, find, end == 0 ? find->from : find->to);
        text_printf(text, " alone   %s\n", find->alone[end][0] ? find->alone[end] : "nothing happens");
    }
}

static void write_none(struct text *text, const struct fbd_find *find)
{
    text_add(text, "  no such value in this range\n");
    if (isfinite(find->least)) {
        text_add(text, find->formula ? "      left side - right side from " : "      margin from ");
        text_number(text, find->least, 6);
        text_add(text, " to ");
        text_number(text, find->most, 6);
        text_printf(text, find->formula ? " %s\n" : "%s\n",
                    find->formula ? row_formula_unit(find->formula) : "");
    } else if (find->kind != find_equation && find->kind != find_limit) {
        text_printf(text, "      at its beginning   %s\n",
                    find->throughout[0] ? find->throughout : "nothing happens");
    }
}

char *fbd_find_text(const fbd_find *find)
{
    if (!find) return NULL;
    struct text text = {0};
    const fbd_found found = fbd_find_summary(find);
    write_question(&text, find);
    for (size_t i = 0; i < find->solution_count; i++) write_solution(&text, find, &find->solutions[i]);
    if (find->solution_count == 0) write_none(&text, find);
    write_alone(&text, find);
    write_gaps(&text, find);
    text_printf(&text, "\n%zu runs, %zu of them at distances of ", found.runs, found.scan);
    put_value(&text, find, found.step);
    text_add(&text, found.linear ? ": the difference is linear there, and there is no other value\n"
                    : find_is_equation(find)
                        ? ": of two values closer than that both may be missed if the difference has "
                          "several extrema between them\n"
                        : ": of two values closer than that both may be missed\n");
    if (text.failed) text_free(&text);
    return text.data;
}

/* ---- JSON */

static void json_solution(struct text *text, const fbd_solution *solution)
{
    static const char *const kinds[] = {"root", "change", "jump"};
    text_add(text, "{");
    text_json_words(text, "kind", kinds[solution->kind], ", ");
    text_json_member(text, "value", solution->value, ", ");
    text_json_member(text, "error", solution->error, ", ");
    text_json_flag(text, "closed_form", solution->closed_form, ", ");
    text_json_words(text, "below", solution->below, ", ");
    text_json_words(text, "above", solution->above, "}");
}

static void json_gap(struct text *text, const fbd_find_gap *gap)
{
    text_add(text, "{");
    text_json_member(text, "value", gap->value, ", ");
    text_json_flag(text, "failed", gap->failed, ", ");
    text_json_words(text, "status", gap->status, ", ");
    text_json_words(text, "reason", gap->reason, "}");
}

char *fbd_find_json(const fbd_find *find)
{
    if (!find) return NULL;
    struct text text = {0};
    const fbd_found found = fbd_find_summary(find);
    text_add(&text, "{\n  ");
    text_json_words(&text, "parameter", found.parameter, ",\n  ");
    text_json_words(&text, "unit", found.unit, ",\n  ");
    text_json_words(&text, "condition", found.condition, ",\n  ");
    text_json_member(&text, "from", found.from, ", ");
    text_json_member(&text, "to", found.to, ", ");
    text_json_member(&text, "step", found.step, ", ");
    text_json_flag(&text, "linear", found.linear, ",\n");
    text_printf(&text, "  \"scan\": %zu, \"runs\": %zu, \"failed\": %zu,\n  \"solutions\": [", found.scan,
                found.runs, found.failed);
    for (size_t i = 0; i < find->solution_count; i++) {
        text_add(&text, i ? ",\n    " : "\n    ");
        json_solution(&text, &find->solutions[i]);
    }
    text_add(&text, "],\n  \"gaps\": [");
    for (size_t i = 0; i < find->gap_count; i++) {
        text_add(&text, i ? ",\n    " : "\n    ");
        json_gap(&text, &find->gaps[i]);
    }
    text_add(&text, "]\n}\n");
    if (text.failed) text_free(&text);
    return text.data;
}
