/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A plot of columns over the time as SVG: curves differ by colour and by dashes, events are dashed vertical lines.
 */
#include <math.h>

#include "base/format.h"
#include "base/printed.h"
#include "draw/svg.h"
#include "note/note.h"

static const double width = 160, height = 62, left = 20, right = 4, top = 9, bottom = 11;

enum { most_curves = 6, most_event_lines = 40 };

static const char *const classes[most_curves] = {"applied",  "reaction", "gravity",
                                                 "friction", "spring",   "damper"};
static const char *const dashes[most_curves] = {"none", "4 1.2", "1.2 1", "5 1 1 1", "2.5 1", "6 1 1 1 1 1"};

struct plot {
    const struct making *making;
    struct text text;
    struct vec low, high, step; /* of the axes, and the distance of ticks */
};

static double value_at(const struct plot *plot, size_t row, size_t column)
{
    return plot->making->table.values[row * plot->making->table.columns + column];
}

static struct vec at(const struct plot *plot, double t, double value)
{
    const double x = (t - plot->low.x) / (plot->high.x - plot->low.x),
                 y = (value - plot->low.y) / (plot->high.y - plot->low.y);
    return (struct vec){left + x * (width - left - right), height - bottom - y * (height - top - bottom)};
}

/* ---- axes */

/* 1, 2 or 5 times a power of ten, so that `range` has about `count` ticks. */
static double tick_step(double range, double count)
{
    const double power = pow(10, floor(log10(range / count))), share = range / count / power;
    return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

static void set_axes(struct plot *plot, const size_t *columns, size_t count)
{
    const size_t rows = plot->making->table.rows;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < count; i++)
        for (size_t r = 0; r < rows; r++) {
            low = fmin(low, value_at(plot, r, columns[i]));
            high = fmax(high, value_at(plot, r, columns[i]));
        }
    const double size = fmax(fabs(low), fabs(high)), least = size > 0 ? 1e-6 * size : 1;
    if (high - low < least) low -= least, high += least; /* a constant */
    plot->step.y = tick_step(high - low, 5);
    plot->low = (struct vec){value_at(plot, 0, 0), plot->step.y * floor(low / plot->step.y + 1e-9)};
    plot->high = (struct vec){value_at(plot, rows - 1, 0), plot->step.y * ceil(high / plot->step.y - 1e-9)};
    if (!(plot->high.x > plot->low.x)) plot->high.x = plot->low.x + 1;
    plot->step.x = tick_step(plot->high.x - plot->low.x, 8);
}

static void number_label(struct text *label, double value)
{
    number_write(label, value, note_digits);
}

static void tick(struct plot *plot, double place, bool time)
{
    struct text label = {0};
    const double step = time ? plot->step.x : plot->step.y, value = fabs(place) < 1e-9 * step ? 0 : place;
    const struct vec from = time ? at(plot, place, plot->low.y) : at(plot, plot->low.x, place),
                     to = time ? at(plot, place, plot->high.y) : at(plot, plot->high.x, place);
    number_label(&label, value);
    const char *number = label.data ? label.data : "";
    svg_line(&plot->text, value == 0 && !time ? "ground" : "hatch", from, to);
    if (time)
        svg_text(&plot->text, "note", (struct vec){from.x, from.y + 3.2}, 2.9, number);
    else
        svg_text_at(&plot->text, "note", (struct vec){from.x - 1.2 - svg_text_width(number, 2.6), from.y + 1},
                    number);
    plot->text.failed |= label.failed;
    text_free(&label);
}

static void draw_axes(struct plot *plot)
{
    const double air = 1e-9;
    const double x = plot->step.x * ceil(plot->low.x / plot->step.x - air);
    for (int k = 0; x + k * plot->step.x <= plot->high.x * (1 + air); k++)
        tick(plot, x + k * plot->step.x, true);
    for (int k = 0; plot->low.y + k * plot->step.y <= plot->high.y + air * plot->step.y; k++)
        tick(plot, plot->low.y + k * plot->step.y, false);
    svg_text(&plot->text, "axis-label", (struct vec){(left + width - right) / 2, height - 3}, 3.4, "t [s]");
}

static void draw_events(struct plot *plot)
{
    fbd_simulation *simulation = plot->making->simulation;
    const size_t count = fbd_simulation_event_count(simulation);
    for (size_t i = 0; i < count && count <= most_event_lines; i++) {
        const double t = fbd_simulation_event(simulation, i).t;
        svg_line(&plot->text, "reference", at(plot, t, plot->low.y), at(plot, t, plot->high.y));
    }
}

/* ---- curves */

/* Points nearer than a tenth of a millimetre to the last one are left out. */
static void draw_curve(struct plot *plot, size_t column, size_t index)
{
    const double least = 0.1;
    const size_t rows = plot->making->table.rows;
    struct vec last = {-HUGE_VAL, -HUGE_VAL};
    text_printf(
        &plot->text,
        "<g class=\"%s\"><polyline class=\"shaft\" style=\"stroke-width:.45;stroke-dasharray:%s\" points=\"",
        classes[index], dashes[index]);
    for (size_t r = 0; r < rows; r++) {
        const struct vec point = at(plot, value_at(plot, r, 0), value_at(plot, r, column));
        if (r + 1 < rows && hypot(point.x - last.x, point.y - last.y) < least) continue;
        if (r > 0) text_add(&plot->text, " ");
        svg_point(&plot->text, point);
        last = point;
    }
    text_add(&plot->text, "\"/></g>\n");
}

static void draw_legend(struct plot *plot, const size_t *columns, size_t count)
{
    double x = left;
    for (size_t i = 0; i < count; i++) {
        struct text name = {0};
        text_symbol(&name, plot->making->table.heads[columns[i]].name);
        const char *shown = name.data ? name.data : "";
        text_printf(&plot->text, "<g class=\"%s\">", classes[i]);
        text_printf(&plot->text, "<line class=\"shaft\" style=\"stroke-dasharray:%s\"", dashes[i]);
        char place[120];
        format_into(place, sizeof place, " x1=\"%.2f\" x2=\"%.2f\" y1=\"4.4\" y2=\"4.4\"/>", x, x + 8);
        text_add(&plot->text, place);
        svg_text_at(&plot->text, "label", (struct vec){x + 9.5, 5.5}, shown);
        text_add(&plot->text, "</g>\n");
        x += 13 + svg_text_width(shown, 3.4);
        plot->text.failed |= name.failed;
        text_free(&name);
    }
}

char *plot_svg(const struct making *making, const size_t *columns, size_t count, const char *title)
{
    struct plot plot = {.making = making};
    set_axes(&plot, columns, count);
    svg_begin(&plot.text, (struct vec){width, height}, 1, title,
              "Each curve over the time; events as dashed lines");
    draw_axes(&plot);
    draw_events(&plot);
    for (size_t i = 0; i < count; i++) draw_curve(&plot, columns[i], i);
    draw_legend(&plot, columns, count);
    text_add(&plot.text, "</svg>\n");
    if (plot.text.failed) text_free(&plot.text);
    return plot.text.data;
}
