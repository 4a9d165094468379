/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Section forces as a table: at equal distances, and before and behind each load.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "output/words.h"
#include "section/name.h"

enum { digits = 9, tenths = 10 };

/* ---- the rows */

static int compare(const void *a, const void *b)
{
    const double one = *(const double *)a, other = *(const double *)b;
    return one < other ? -1 : one > other;
}

/* The tenths of the length and the places of the loads, in ascending order, in `places`; returns their number. */
static size_t list_places(const fbd_section *section, double *places)
{
    size_t count = 0, kept = 0;
    for (int i = 0; i <= tenths; i++) places[count++] = section_snap(section, section->length * i / tenths);
    for (size_t i = 0; i < section->load_count; i++) places[count++] = section->loads[i].x;
    qsort(places, count, sizeof *places, compare);
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || places[i] > places[kept - 1]) places[kept++] = places[i];
    return kept;
}

static bool is_loaded(const fbd_section *section, double x)
{
    for (size_t i = 0; i < section->load_count; i++)
        if (section->loads[i].x == x) return true;
    return false;
}

typedef void write_row(struct text *text, const fbd_section *section, fbd_cut cut, bool behind, bool loaded);

static void each_row(struct text *text, const fbd_section *section, const double *x, write_row *write)
{
    double *places = calloc(tenths + 2 + section->load_count, sizeof *places);
    size_t count = places && !x ? list_places(section, places) : 1;
    if (!places) text->failed = true;
    for (size_t i = 0; places && i < count; i++) {
        const double place = x ? *x : places[i];
        const bool loaded = is_loaded(section, place), first = place == 0, last = place == section->length;
        if (!first) write(text, section, fbd_section_at(section, place, false), false, loaded);
        if (!last && (first || loaded))
            write(text, section, fbd_section_at(section, place, true), true, loaded);
    }
    free(places);
}

/* ---- the text */

static const char *unit_of(const fbd_section *section, int force)
{
    return force == section_M ? moment_unit(section->model) : force_unit(section->model);
}

static void write_number(struct text *text, double value)
{
    text_add(text, value < 0 ? "" : " ");
    text_number(text, value, digits);
}

static void text_row(struct text *text, const fbd_section *section, fbd_cut cut, bool behind, bool loaded)
{
    text_add(text, "  ");
    text_number(text, cut.x, digits);
    const double values[section_forces] = {cut.N, cut.V, cut.M};
    for (int k = 0; k < section_forces; k++) {
        text_pad(text, 16 + 18 * (size_t)k);
        write_number(text, values[k]);
    }
    const bool first = cut.x == 0, last = cut.x == section->length;
    if (loaded) {
        text_pad(text, 70);
        text_add(text, first || last || behind ? "" : "before ");
        text_add(text, !first && !last && behind ? "behind " : "");
        bool comma = false;
        for (size_t i = 0; i < section->load_count; i++) {
            if (section->loads[i].x != cut.x) continue;
            text_add(text, comma ? ", " : "");
            text_shown(text, section->loads[i].name);
            comma = true;
        }
    }
    text_add(text, "\n");
}

static void write_head(struct text *text, const fbd_section *section)
{
    const char *length = length_unit(section->model);
    text_heading(text, section->model->scene->title);
    text_printf(text, "Section forces of `%s` at t = ", section->body->name);
    text_number(text, section->t, digits);
    text_printf(text, " s%s\n", section->at_rest ? ", at rest" : "");
    text_add(text, "  x from ");
    if (section->start) text_printf(text, "`%s` ", section->start);
    text_add(text, "(0) to ");
    if (section->end) text_printf(text, "`%s` ", section->end);
    text_add(text, "(");
    text_number(text, section->length, digits);
    text_printf(text, " %s); N > 0: tension; V > 0: turns a part clockwise; M > 0: sagging\n", length);
    if (section->lump_count > 0)
        text_add(text, "  parts that are not straight count as concentrated at their centres\n");
    text_printf(text, "\n  x [%s]", length);
    for (int k = 0; k < section_forces; k++) {
        text_pad(text, 17 + 18 * (size_t)k);
        text_printf(text, "%s [%s]", section_symbols[k], unit_of(section, k));
    }
    text_add(text, "\n");
}

static void write_extremes(struct text *text, const fbd_section *section)
{
    const char *length = length_unit(section->model);
    text_add(text, "\n");
    for (int k = 0; k < section_forces; k++)
        for (int greatest = 1; greatest >= 0; greatest--) {
            const fbd_section_extreme extreme = fbd_section_extreme_of(section, k, greatest);
            text_printf(text, "  %s %s", greatest ? "greatest" : "least", section_symbols[k]);
            text_pad(text, 16);
            write_number(text, extreme.value);
            text_printf(text, " %s", unit_of(section, k));
            text_pad(text, 40);
            text_add(text, "at x = ");
            text_number(text, extreme.x, digits);
            text_printf(text, " %s\n", length);
        }
}

char *fbd_section_text(const fbd_section *section, const double *x)
{
    if (!section) return NULL;
    struct text text = {0};
    write_head(&text, section);
    each_row(&text, section, x, text_row);
    if (!x) write_extremes(&text, section);
    if (text.failed) text_free(&text);
    return text.data;
}

/* ---- JSON */

static void json_row(struct text *text, const fbd_section *section, fbd_cut cut, bool behind, bool loaded)
{
    (void)section;
    if (text->length > 0 && text->data[text->length - 1] != '[') text_add(text, ",");
    text_add(text, "{");
    text_json_member(text, "x", cut.x, ",");
    text_json_flag(text, "behind", behind && loaded, ",");
    text_json_member(text, "N", cut.N, ",");
    text_json_member(text, "V", cut.V, ",");
    text_json_member(text, "M", cut.M, "}");
}

static void json_extremes(struct text *text, const fbd_section *section)
{
    for (int k = 0; k < section_forces; k++) {
        text_printf(text, "%s\"%s\":{", k ? "," : "", section_symbols[k]);
        for (int greatest = 0; greatest < 2; greatest++) {
            const fbd_section_extreme extreme = fbd_section_extreme_of(section, k, greatest);
            text_json_key(text, greatest ? "greatest" : "least");
            text_add(text, "{");
            text_json_member(text, "x", extreme.x, ",");
            text_json_member(text, "value", extreme.value, greatest ? "}" : "},");
        }
        text_add(text, "}");
    }
}

static void json_loads(struct text *text, const fbd_section *section)
{
    for (size_t i = 0; i < section->load_count; i++) {
        const struct section_load *load = &section->loads[i];
        text_add(text, i ? ",{" : "{");
        text_json_words(text, "name", load->name, ",");
        text_json_member(text, "x", load->x, ",");
        for (int k = 0; k < section_forces; k++)
            text_json_member(text, section_symbols[k], load->jump[k], k < section_M ? "," : "}");
    }
}

char *fbd_section_json(const fbd_section *section, const double *x)
{
    if (!section) return NULL;
    struct text text = {0};
    const struct fbd_model *model = section->model;
    text_add(&text, "{");
    text_json_words(&text, "body", section->body->name, ",");
    text_json_member(&text, "t", section->t, ",");
    text_json_flag(&text, "at_rest", section->at_rest, ",");
    text_json_member(&text, "length", section->length, ",");
    text_json_key(&text, "units");
    text_add(&text, "{");
    text_json_words(&text, "x", length_unit(model), ",");
    text_json_words(&text, "N", force_unit(model), ",");
    text_json_words(&text, "V", force_unit(model), ",");
    text_json_words(&text, "M", moment_unit(model), "},");
    text_json_key(&text, "sections");
    text_add(&text, "[");
    each_row(&text, section, x, json_row);
    text_add(&text, "],");
    text_json_key(&text, "jumps");
    text_add(&text, "[");
    json_loads(&text, section);
    text_add(&text, "],");
    text_json_key(&text, "extremes");
    text_add(&text, "{");
    json_extremes(&text, section);
    text_add(&text, "}}\n");
    if (text.failed) text_free(&text);
    return text.data;
}
