/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "base/number.h"
#include "fbd_view.h"
#include "study/find.h"

static bool refuse(struct fbd_find *find, const char *hint, const char *message, const char *text)
{
    diag_in_file(find->errors, "--find");
    diag_add(find->errors, FBD_ERROR, "bad-find", (struct pos){0, 0}, hint, "%s `%.80s`", message, text);
    return false;
}

static const char form[] =
    "write `PARAMETER: CONDITION` or `PARAMETER = FROM..TO UNIT: CONDITION`, as `mu: block "
    "slips` or `h = 2..3 m: ball.x = 1.5 m`";

/* A text without the blanks around it, in the arena. */
static const char *trimmed(struct fbd_find *find, const char *text, size_t length)
{
    while (length && (text[0] == ' ' || text[0] == '\t')) text++, length--;
    while (length && (text[length - 1] == ' ' || text[length - 1] == '\t')) length--;
    return arena_text(&find->arena, text, length);
}

/* The number that a text begins with; *unit is the rest. */
static bool read_end(struct fbd_find *find, const char *text, double *value, const char **unit)
{
    const size_t sign = text[0] == '-' || text[0] == '+';
    const size_t length = number_length(text + sign, strlen(text + sign));
    *value = length ? number_value(text + sign, length) * (text[0] == '-' ? -1 : 1) : NAN;
    *unit = trimmed(find, text + sign + length, strlen(text + sign + length));
    return *unit && isfinite(*value) && !strpbrk(*unit, ",;");
}

/* FROM..TO UNIT; FROM may have the unit, too. */
static bool read_range(struct fbd_find *find, const char *range)
{
    const char *dots = strstr(range, ".."), *unit = "";
    if (!dots) return refuse(find, form, "no range", range);
    while (dots[2] == '.') dots++; /* 1...2 is 1. to 2 */
    const char *low = trimmed(find, range, (size_t)(dots - range)),
               *high = trimmed(find, dots + 2, strlen(dots + 2));
    if (!low || !high) return false;
    if (!read_end(find, low, &find->from, &unit) || !read_end(find, high, &find->to, &find->unit))
        return refuse(find, form, "no range", range);
    if (!find->unit[0]) find->unit = unit;
    if (unit[0] && strcmp(unit, find->unit) != 0)
        return refuse(find, "give both ends in one unit", "two units in", range);
    return find->from < find->to || refuse(find, "the first end is the smaller one", "no range", range);
}

bool find_read_question(struct fbd_find *find, const char *question)
{
    const char *colon = strchr(question, ':');
    const size_t length = colon ? (size_t)(colon - question) : strlen(question);
    const char *head = trimmed(find, question, length), *equals = head ? strchr(head, '=') : NULL;
    find->condition = colon ? trimmed(find, colon + 1, strlen(colon + 1)) : "";
    find->unit = "";
    find->from = find->to = NAN;
    if (!head || !find->condition) return false;
    find->parameter = equals ? trimmed(find, head, (size_t)(equals - head)) : head;
    const char *range = equals ? trimmed(find, equals + 1, strlen(equals + 1)) : NULL;
    if (!find->parameter || (equals && !range)) return false;
    if (!find->parameter[0] || (colon && !find->condition[0]))
        return refuse(find, form, "no question", question);
    return !range || read_range(find, range);
}

/* ---- the file */

/* The words of two, `block slips`, as the event `block.slips`. */
static const char *event_of(struct fbd_find *find)
{
    char *event = arena_text(&find->arena, find->condition, strlen(find->condition));
    if (event && strchr(event, ' ') == strrchr(event, ' ') && strchr(event, ' ')) *strchr(event, ' ') = '.';
    return event;
}

static bool take_range(struct fbd_find *find, const fbd_model *model)
{
    const char *names[200];
    size_t count = 0;
    for (size_t i = 0; i < fbd_model_parameter_count(model); i++) {
        const fbd_parameter parameter = fbd_model_parameter(model, i);
        if (count < sizeof names / sizeof *names) names[count++] = parameter.name;
        if (strcmp(parameter.name, find->parameter) != 0) continue;
        find->shown_unit =
            find->unit[0] ? find->unit : arena_text(&find->arena, parameter.unit, strlen(parameter.unit));
        if (!find->shown_unit) return false;
        if (isfinite(find->from)) return true;
        find->from = parameter.low;
        find->to = parameter.high;
        find->unit = "";
        if (isfinite(find->from) && find->from < find->to) return true;
        return refuse(find, form, "the file gives no `range` for the parameter", find->parameter);
    }
    diag_in_file(find->errors, "--find");
    diag_add(find->errors, FBD_ERROR, "unknown-parameter", (struct pos){0, 0},
             diag_nearest(find->errors, find->parameter, names, count), "the model has no parameter `%.40s`",
             find->parameter);
    return false;
}

bool find_complete_question(struct fbd_find *find)
{
    const fbd_find_plan *plan = find->plan;
    const bool none = !find->condition[0], equation = strpbrk(find->condition, "=<>") != NULL;
    fbd_errors *again =
        plan->statics && !equation ? find->errors : NULL; /* rows give the notes of the file */
    fbd_model *model = fbd_model_parse(find->source, find->source_length, find->name, plan->settings,
                                       plan->setting_count, again);
    bool fine = !model ? !again : take_range(find, model);
    fbd_model_free(model);
    if (equation)
        find->kind = find_equation;
    else if (plan->statics)
        find->kind = none ? find_equilibrium : find_limit;
    else
        find->kind = none ? find_happenings : find_event;
    if (find->kind == find_limit) find->limit = find->condition;
    if (fine && find->kind == find_event) fine = (find->event = event_of(find)) != NULL;
    if (!fine || find->kind != find_equation) return fine;
    diag_in_file(find->errors, "--find");
    return (find->formula = row_formula_read(&find->arena, find->condition, find->errors)) != NULL;
}
