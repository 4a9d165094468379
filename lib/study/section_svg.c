/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The diagrams of N, V and M one below the other, under the body with the places of its loads. Positive values are up.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/format.h"
#include "draw/svg.h"
#include "study/section.h"

static const double width = 150, left = 14, right = 14, body_height = 34, first_top = 46, plot_height = 34,
                    pitch = 44, text_size = 3.4;
enum { samples = 48 };

struct sheet {
    const fbd_section *section;
    struct text text;
    double top; /* of the present plot */
    double low, high;
    enum section_force force;
};

static double across(const struct sheet *sheet, double x)
{
    return left + (width - left - right) * x / sheet->section->length;
}

static struct vec at(const struct sheet *sheet, double x, double value)
{
    const double share = (value - sheet->low) / (sheet->high - sheet->low);
    return (struct vec){across(sheet, x), sheet->top + plot_height * (1 - share)};
}

/* ---- the body */

static bool is_named_before(const fbd_section *section, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (section->loads[k].x == section->loads[i].x &&
            strcmp(section->loads[k].name, section->loads[i].name) == 0)
            return true;
    return false;
}

/* The names of loads, on the lowest of some lines where they have room. */
static void write_names(struct sheet *sheet)
{
    enum { lines = 4 };
    const fbd_section *section = sheet->section;
    double end[lines] = {0};
    for (size_t i = 0; i < section->load_count; i++) {
        const char *name = section->loads[i].name;
        if (is_named_before(section, i)) continue;
        const double half = svg_text_width(name, text_size) / 2;
        const double x =
            fmin(fmax(across(sheet, section->loads[i].x), left + half - 8), width - right - half + 8);
        int line = 0;
        while (line + 1 < lines && x - half < end[line]) line++;
        end[line] = x + half + 1.5;
        svg_text(&sheet->text, "label", (struct vec){x, body_height - 5 - 4.2 * line}, text_size, name);
    }
}

static void draw_body(struct sheet *sheet)
{
    const fbd_section *section = sheet->section;
    const struct vec from = {across(sheet, 0), body_height},
                     to = {across(sheet, section->length), body_height};
    for (size_t i = 0; i < section->load_count; i++) {
        const double x = across(sheet, section->loads[i].x);
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
    const double low = fbd_section_extreme_of(sheet->section, (int)sheet->force, false).value,
                 high = fbd_section_extreme_of(sheet->section, (int)sheet->force, true).value;
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

/* The area between the curve and the axis; steps of the curve are vertical. */
static void draw_area(struct sheet *sheet)
{
    const fbd_section *section = sheet->section;
    struct vec *corners = calloc(section->piece_count * (samples + 1) + 2, sizeof *corners);
    size_t count = 0;
    if (!corners) {
        sheet->text.failed = true;
        return;
    }
    corners[count++] = at(sheet, 0, 0);
    for (size_t i = 0; i < section->piece_count; i++) {
        const struct section_piece *piece = &section->pieces[i];
        for (int k = 0; k <= samples; k++) {
            const double t = 2. * k / samples - 1, value = polynomial_at(&piece->of[sheet->force], t);
            corners[count++] = at(sheet, piece->from + (piece->to - piece->from) * (t + 1) / 2,
                                  section_rounded(section, sheet->force, value));
        }
    }
    corners[count++] = at(sheet, section->length, 0);
    svg_polygon(&sheet->text, "body", corners, count);
    free(corners);
}

/* Broken lines at the places of loads. */
static void draw_places(struct sheet *sheet)
{
    const fbd_section *section = sheet->section;
    const fbd_section_extreme *extremes = section->extremes[sheet->force];
    for (size_t i = 0; i < section->load_count; i++) {
        if (i == 0 || section->loads[i].x != section->loads[i - 1].x)
            svg_line(&sheet->text, "reference", at(sheet, section->loads[i].x, fmax(extremes[1].value, 0)),
                     at(sheet, section->loads[i].x, fmin(extremes[0].value, 0)));
    }
}

/* "N·m" of "N*m". */
static const char *printed_unit(const fbd_section *section, enum section_force force)
{
    static const char *const couples[][2] = {{"N*m", "N·m"}, {"lbf*ft", "lbf·ft"}, {"ft*lbf", "ft·lbf"}};
    const char *unit = section_unit(section, force);
    for (size_t i = 0; i < sizeof couples / sizeof *couples; i++)
        if (strcmp(unit, couples[i][0]) == 0) return couples[i][1];
    return unit;
}

static void write_extreme(struct sheet *sheet, bool greatest)
{
    const fbd_section *section = sheet->section;
    const fbd_section_extreme extreme = fbd_section_extreme_of(section, (int)sheet->force, greatest);
    char number[100];
    if (extreme.value == 0) return;
    format_into(number, sizeof number, "%s%.5g %s at x = %.5g", extreme.value < 0 ? "−" : "",
                fabs(extreme.value), printed_unit(section, sheet->force), extreme.x);
    const struct vec point = at(sheet, extreme.x, extreme.value);
    const double half = svg_text_width(number, 2.9) / 2;
    const struct vec center = {fmin(fmax(point.x, left + half - 6), width - right - half + 6),
                               point.y + (extreme.value > 0 ? -2.6 : 2.9)};
    svg_circle(&sheet->text, "center-dark", point, 0.7);
    svg_text(&sheet->text, "note", center, 2.9, number);
}

static void draw_plot(struct sheet *sheet, enum section_force force)
{
    const fbd_section *section = sheet->section;
    char label[80];
    sheet->force = force;
    sheet->top = first_top + pitch * (double)force;
    set_range(sheet);
    text_printf(&sheet->text, "<g id=\"section-%s\">\n", section_symbols[force]);
    draw_places(sheet);
    draw_area(sheet);
    svg_line(&sheet->text, "axis", at(sheet, 0, 0), at(sheet, section->length, 0));
    format_into(label, sizeof label, "%s [%s], %s", section_symbols[force], printed_unit(section, force),
                section_words[force]);
    svg_text_at(&sheet->text, "axis-label", (struct vec){left - 8, sheet->top - 1.5}, label);
    const fbd_section_extreme least = fbd_section_extreme_of(section, (int)force, false),
                              greatest = fbd_section_extreme_of(section, (int)force, true);
    write_extreme(sheet, true);
    if (least.value < greatest.value) write_extreme(sheet, false);
    text_add(&sheet->text, "</g>\n");
}

char *fbd_section_svg(const fbd_section *section)
{
    if (!section) return NULL;
    struct sheet sheet = {.section = section};
    const char *title = fbd_model_title(section->model);
    const double height = first_top + 2 * pitch + plot_height + 8;
    char words[200];
    format_into(words, sizeof words, "Section forces of %s at t = %.6g s%s", section->body, section->t,
                section->at_rest ? ", at rest" : "");
    svg_begin(&sheet.text, (struct vec){width, height}, 1, title[0] ? title : words, words);
    svg_text_at(&sheet.text, "heading", (struct vec){5, 9}, title[0] ? title : words);
    svg_text_at(&sheet.text, "note", (struct vec){5, 14}, words);
    draw_body(&sheet);
    for (int k = 0; k < section_forces; k++) draw_plot(&sheet, (enum section_force)k);
    format_into(words, sizeof words, "x = 0 to %.6g %s", section->length,
                fbd_model_units(section->model).length);
    svg_text(&sheet.text, "axis-label", (struct vec){width / 2, height - 4}, text_size, words);
    text_add(&sheet.text, "</svg>\n");
    if (sheet.text.failed) text_free(&sheet.text);
    return sheet.text.data;
}
