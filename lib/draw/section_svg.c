/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The diagrams of N, V and M one below the other, under the body with the places of its loads. Positive values are up.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/format.h"
#include "draw/svg.h"
#include "fbd_section.h"
#include "fbd_view.h"

static const double width = 150, left = 14, right = 14, body_height = 34, first_top = 46, plot_height = 34,
                    pitch = 44, text_size = 3.4;
enum { samples = 48, plots = 3 };

static const char *const symbols[plots] = {"N", "V", "M"};
static const char *const meanings[plots] = {"normal force", "shear force", "bending moment"};

struct sheet {
    const fbd_section *section;
    struct text text;
    double length;
    double top; /* of the present plot */
    double low, high;
    int force; /* N, V, M */
};

static double across(const struct sheet *sheet, double x)
{
    return left + (width - left - right) * x / sheet->length;
}

static struct vec at(const struct sheet *sheet, double x, double value)
{
    const double share = (value - sheet->low) / (sheet->high - sheet->low);
    return (struct vec){across(sheet, x), sheet->top + plot_height * (1 - share)};
}

/* ---- the body */

static bool is_named_before(const fbd_section *section, size_t i)
{
    const fbd_section_load load = fbd_section_load_get(section, i);
    for (size_t k = 0; k < i; k++) {
        const fbd_section_load other = fbd_section_load_get(section, k);
        if (other.x == load.x && strcmp(other.name, load.name) == 0) return true;
    }
    return false;
}

/* The names of loads, on the lowest of some lines where they have room. */
static void write_names(struct sheet *sheet)
{
    enum { lines = 4 };
    const fbd_section *section = sheet->section;
    double end[lines] = {0};
    for (size_t i = 0; i < fbd_section_load_count(section); i++) {
        const fbd_section_load load = fbd_section_load_get(section, i);
        if (is_named_before(section, i)) continue;
        const double half = svg_text_width(load.name, text_size) / 2;
        const double x = fmin(fmax(across(sheet, load.x), left + half - 8), width - right - half + 8);
        int line = 0;
        while (line + 1 < lines && x - half < end[line]) line++;
        end[line] = x + half + 1.5;
        svg_text(&sheet->text, "label", (struct vec){x, body_height - 5 - 4.2 * line}, text_size, load.name);
    }
}

static void draw_body(struct sheet *sheet)
{
    const struct vec from = {across(sheet, 0), body_height}, to = {across(sheet, sheet->length), body_height};
    for (size_t i = 0; i < fbd_section_load_count(sheet->section); i++) {
        const double x = across(sheet, fbd_section_load_get(sheet->section, i).x);
        svg_line(&sheet->text, "reference", (struct vec){x, body_height - 2.6},
                 (struct vec){x, body_height + 2.6});
    }
    svg_line(&sheet->text, "bar", from, to);
    svg_line(&sheet->text, "bar-inside", from, to);
    write_names(sheet);
}

/* ---- one plot */

static void set_range(struct sheet *sheet)
{
    const double low = fbd_section_extreme_of(sheet->section, sheet->force, false).value,
                 high = fbd_section_extreme_of(sheet->section, sheet->force, true).value;
    sheet->low = fmin(low, 0);
    sheet->high = fmax(high, 0);
    const double range = sheet->high - sheet->low;
    if (!(range > 0)) {
        sheet->low = -1;
        sheet->high = 1;
    }
    const double air = 0.14 * (sheet->high - sheet->low); /* for the values beside the curve */
    if (low < 0) sheet->low -= air;
    if (high > 0) sheet->high += air;
}

static double value_at(const struct sheet *sheet, double x, bool behind)
{
    const fbd_cut cut = fbd_section_at(sheet->section, x, behind);
    return sheet->force == 0 ? cut.N : sheet->force == 1 ? cut.V : cut.M;
}

/* The area between the curve and the axis; steps of the curve are vertical. */
static void draw_area(struct sheet *sheet)
{
    const size_t ends = fbd_section_ends(sheet->section, NULL, 0);
    double *x = calloc(ends, sizeof *x);
    struct vec *corners = calloc(ends * (samples + 1) + 2, sizeof *corners);
    sheet->text.failed |= !x || !corners;
    if (x && corners) {
        size_t count = 0;
        fbd_section_ends(sheet->section, x, ends);
        corners[count++] = at(sheet, 0, 0);
        for (size_t i = 0; i + 1 < ends; i++)
            for (int k = 0; k <= samples; k++) {
                const double place = k == samples ? x[i + 1] : x[i] + (x[i + 1] - x[i]) * k / samples;
                corners[count++] = at(sheet, place, value_at(sheet, place, k < samples));
            }
        corners[count++] = at(sheet, sheet->length, 0);
        svg_polygon(&sheet->text, "body", corners, count);
    }
    free(x);
    free(corners);
}

/* Broken lines at the places of loads. */
static void draw_places(struct sheet *sheet)
{
    const fbd_section *section = sheet->section;
    const double low = fbd_section_extreme_of(section, sheet->force, false).value,
                 high = fbd_section_extreme_of(section, sheet->force, true).value;
    double last = NAN;
    for (size_t i = 0; i < fbd_section_load_count(section); i++) {
        const double x = fbd_section_load_get(section, i).x;
        if (x != last)
            svg_line(&sheet->text, "reference", at(sheet, x, fmax(high, 0)), at(sheet, x, fmin(low, 0)));
        last = x;
    }
}

/* "N·m" of "N*m". */
static const char *printed_unit(const struct sheet *sheet)
{
    static const char *const couples[][2] = {{"N*m", "N·m"}, {"lbf*ft", "lbf·ft"}, {"ft*lbf", "ft·lbf"}};
    const fbd_units units = fbd_model_units(fbd_section_source_of(sheet->section).model);
    const char *unit = sheet->force == 2 ? units.moment : units.force;
    for (size_t i = 0; i < sizeof couples / sizeof *couples; i++)
        if (strcmp(unit, couples[i][0]) == 0) return couples[i][1];
    return unit;
}

static void write_extreme(struct sheet *sheet, bool greatest)
{
    const fbd_section *section = sheet->section;
    const fbd_section_extreme extreme = fbd_section_extreme_of(section, sheet->force, greatest);
    char number[100];
    if (extreme.value == 0) return;
    format_into(number, sizeof number, "%s%.5g %s at x = %.5g", extreme.value < 0 ? "−" : "",
                fabs(extreme.value), printed_unit(sheet), extreme.x);
    const struct vec point = at(sheet, extreme.x, extreme.value);
    const double half = svg_text_width(number, 2.9) / 2;
    const struct vec center = {fmin(fmax(point.x, left + half - 6), width - right - half + 6),
                               point.y + (extreme.value > 0 ? -2.6 : 2.9)};
    svg_circle(&sheet->text, "center-dark", point, 0.7);
    svg_text(&sheet->text, "note", center, 2.9, number);
}

static void draw_plot(struct sheet *sheet, int force)
{
    const fbd_section *section = sheet->section;
    char label[80];
    sheet->force = force;
    sheet->top = first_top + pitch * force;
    set_range(sheet);
    text_printf(&sheet->text, "<g id=\"section-%s\">\n", symbols[force]);
    draw_places(sheet);
    draw_area(sheet);
    svg_line(&sheet->text, "axis", at(sheet, 0, 0), at(sheet, sheet->length, 0));
    format_into(label, sizeof label, "%s [%s], %s", symbols[force], printed_unit(sheet), meanings[force]);
    svg_text_at(&sheet->text, "axis-label", (struct vec){left - 8, sheet->top - 1.5}, label);
    const fbd_section_extreme least = fbd_section_extreme_of(section, force, false),
                              greatest = fbd_section_extreme_of(section, force, true);
    write_extreme(sheet, true);
    if (least.value < greatest.value) write_extreme(sheet, false);
    text_add(&sheet->text, "</g>\n");
}

char *fbd_section_svg(const fbd_section *section)
{
    if (!section) return NULL;
    struct sheet sheet = {.section = section, .length = fbd_section_length(section)};
    const fbd_section_source source = fbd_section_source_of(section);
    const char *title = fbd_model_title(source.model);
    const double height = first_top + 2 * pitch + plot_height + 8;
    char words[200];
    format_into(words, sizeof words, "Section forces of %s at t = %.6g s%s", source.body, source.t,
                source.at_rest ? ", at rest" : "");
    svg_begin(&sheet.text, (struct vec){width, height}, 1, title[0] ? title : words, words);
    svg_text_at(&sheet.text, "heading", (struct vec){5, 9}, title[0] ? title : words);
    svg_text_at(&sheet.text, "note", (struct vec){5, 14}, words);
    draw_body(&sheet);
    for (int k = 0; k < plots; k++) draw_plot(&sheet, k);
    format_into(words, sizeof words, "x = 0 to %.6g %s", sheet.length, fbd_model_units(source.model).length);
    svg_text(&sheet.text, "axis-label", (struct vec){width / 2, height - 4}, text_size, words);
    text_add(&sheet.text, "</svg>\n");
    if (sheet.text.failed) text_free(&sheet.text);
    return sheet.text.data;
}
