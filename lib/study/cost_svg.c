/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The work-precision diagram: error on the x axis (more accurate to the right), time of a run on the y axis,
 * both logarithmic; one line for each method, labelled at its end; the Pareto front as a broad grey band
 * beneath; the range below the floor of the reference shaded.
 *
 * Lines differ by colour (the set of Okabe and Ito, which colour-blind readers can distinguish) and by
 * marker, so that the drawing is readable in black and white too. Text stays text.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/svg.h"
#include "fbd_study.h"
#include "study/cost.h"

enum { width = 960, height = 640, left = 86, right = 800, top = 74, bottom = 560, label_pitch = 17 };

struct axes {
    double x_first, x_last; /* -log10(error) */
    double y_first, y_last; /* log10(time) */
};

static double across(const struct axes *axes, double error)
{
    double x = (-log10(error) - axes->x_first) / (axes->x_last - axes->x_first);
    return left + (right - left) * x;
}

static double upward(const struct axes *axes, double seconds)
{
    double y = (log10(seconds) - axes->y_first) / (axes->y_last - axes->y_first);
    return bottom - (bottom - top) * y;
}

/* ---- ranges */

static bool is_drawn(const fbd_point *point)
{
    return point->state == FBD_POINT_MEASURED && point->error < 1 && point->seconds > 0;
}

static double drawn_error(const fbd_cost *cost, const fbd_point *point)
{
    return fmax(point->error, cost->reference.floor);
}

static bool find_axes(const fbd_cost *cost, struct axes *axes)
{
    double largest = 0, least = HUGE_VAL, most = 0;
    for (size_t i = 0; i < cost->point_count; i++) {
        const fbd_point *point = &cost->points[i];
        if (!is_drawn(point)) continue;
        largest = fmax(largest, drawn_error(cost, point));
        least = fmin(least, point->seconds);
        most = fmax(most, point->seconds);
    }
    if (!(largest > 0)) return false;
    const double air = 0.12;
    *axes = (struct axes){.x_first = floor(-log10(largest)),
                          .x_last = ceil(-log10(cost->reference.floor) + 0.3),
                          .y_first = log10(least) - air,
                          .y_last = log10(most) + air};
    if (axes->y_last - axes->y_first < 1) { /* at least one labelled decade */
        axes->y_first = floor(axes->y_first);
        axes->y_last = ceil(axes->y_last);
    }
    if (axes->x_last <= axes->x_first) axes->x_last = axes->x_first + 1;
    return true;
}

/* ---- pieces */

/* Append a coordinate on the paper, to a hundredth. */
static void place(struct text *text, double value)
{
    text_number(text, round(value * 100) / 100, 7);
}

static void pair(struct text *text, double x, double y)
{
    place(text, x);
    text_add(text, " ");
    place(text, y);
}

static void line(struct text *text, const char *style, double x1, double y1, double x2, double y2)
{
    text_printf(text, "<path class=\"%s\" d=\"M", style);
    pair(text, x1, y1);
    text_add(text, " L");
    pair(text, x2, y2);
    text_add(text, "\"/>\n");
}

static void begin_text(struct text *text, double x, double y, const char *attributes)
{
    text_add(text, "<text x=\"");
    place(text, x);
    text_add(text, "\" y=\"");
    place(text, y);
    text_printf(text, "\"%s>", attributes);
}

/* ---- frame and grid */

static void x_ticks(struct text *text, const struct axes *axes)
{
    for (int d = (int)axes->x_first; d <= (int)axes->x_last; d++) {
        double x = across(axes, pow(10, -d));
        line(text, "grid", x, top, x, bottom);
        begin_text(text, x, bottom + 20, " text-anchor=\"middle\"");
        if (d == 0)
            text_add(text, "1</text>\n");
        else
            text_printf(text, "10<tspan dy=\"-5\" font-size=\"9\">\xE2\x88\x92%d</tspan></text>\n", d);
    }
}

/* "1 us", "10 ms", "100 s" */
static void y_label(struct text *text, int decade)
{
    static const char *const units[] = {"ns", "\xC2\xB5s", "ms", "s"};
    int k = decade < -9 ? 0 : decade >= 0 ? 3 : (decade + 9) / 3;
    text_number(text, pow(10, decade - 3 * (k - 3)), 6);
    text_printf(text, " %s", units[k]);
}

static void y_ticks(struct text *text, const struct axes *axes)
{
    for (int d = (int)floor(axes->y_first); d <= (int)axes->y_last; d++) {
        for (int k = 1; k < 10; k++) {
            double value = k * pow(10, d), y = upward(axes, value);
            if (y > bottom || y < top) continue;
            if (k > 1) {
                line(text, "tick", left, y, left + (k == 5 ? 6 : 4), y);
                continue;
            }
            line(text, "grid", left, y, right, y);
            begin_text(text, left - 9, y + 4, " text-anchor=\"end\"");
            y_label(text, d);
            text_add(text, "</text>\n");
        }
    }
}

static void frame(struct text *text, const struct axes *axes)
{
    x_ticks(text, axes);
    y_ticks(text, axes);
    text_printf(text, "<rect class=\"frame\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"/>\n", left, top,
                right - left, bottom - top);
    begin_text(text, (left + right) / 2.0, bottom + 48, " text-anchor=\"middle\"");
    text_add(text, "largest error over the run, divided by the size of the quantity"
                   " \xE2\x80\x94 more accurate to the right \xE2\x86\x92</text>\n");
    text_printf(text,
                "<text transform=\"translate(24 %d) rotate(-90)\" text-anchor=\"middle\">time of a run "
                "(median)</text>\n",
                (top + bottom) / 2);
}

static void floor_band(struct text *text, const fbd_cost *cost, const struct axes *axes)
{
    double x = across(axes, cost->reference.floor);
    text_add(text, "<rect class=\"floor\" x=\"");
    place(text, x);
    text_printf(text, "\" y=\"%d\" width=\"", top);
    place(text, right - x);
    text_printf(text, "\" height=\"%d\"/>\n", bottom - top);
    line(text, "floorline", x, top, x, bottom);
    text_add(text, "<text class=\"small\" transform=\"translate(");
    const double beside = 14;
    place(text, x + beside < right ? x + beside : x - 5);
    text_printf(text, " %d) rotate(-90)\">floor of the reference</text>\n", bottom - 8);
}

/* ---- the front */

static int by_error(const void *left_point, const void *right_point)
{
    const fbd_point *a = *(const fbd_point *const *)left_point, *b = *(const fbd_point *const *)right_point;
    return (a->error < b->error) - (a->error > b->error);
}

static void front(struct text *text, const fbd_cost *cost, const struct axes *axes)
{
    const fbd_point **points = calloc(cost->point_count + 1, sizeof *points);
    size_t count = 0;
    if (!points) {
        text->failed = true;
        return;
    }
    for (size_t i = 0; i < cost->point_count; i++)
        if (cost->points[i].front && is_drawn(&cost->points[i])) points[count++] = &cost->points[i];
    qsort(points, count, sizeof *points, by_error);
    if (count > 1) {
        text_add(text, "<path class=\"front\" d=\"");
        for (size_t i = 0; i < count; i++) {
            text_add(text, i ? " L" : "M");
            pair(text, across(axes, drawn_error(cost, points[i])), upward(axes, points[i]->seconds));
        }
        text_add(text, "\"/>\n");
        const fbd_point *middle = points[count / 2];
        begin_text(text, across(axes, drawn_error(cost, middle)) + 10, upward(axes, middle->seconds) + 24,
                   " class=\"small\"");
        text_add(text, "Pareto front</text>\n");
    }
    free(points);
}

/* ---- the methods */

enum { colour_count = 8, marker_count = 5 };

/* The class of its colour, c0 to c7: the style sheet has other colours on dark paper. */
static int colour_of(size_t series)
{
    return (int)(series % colour_count);
}

static void marker(struct text *text, size_t series, double x, double y)
{
    static const char *const shapes[marker_count] = {
        "m-3.2 0a3.2 3.2 0 1 0 6.4 0a3.2 3.2 0 1 0 -6.4 0", /* circle */
        "m-3 -3h6v6h-6z",                                   /* square */
        "m0 -4l3.7 6.4h-7.4z",                              /* triangle */
        "m0 -4l4 4l-4 4l-4 -4z",                            /* diamond */
        "m0 4l3.7 -6.4h-7.4z",                              /* triangle upside down */
    };
    text_add(text, "M");
    pair(text, x, y);
    text_printf(text, "%s", shapes[series % marker_count]);
}

/* Draw one method and return the end of its line. */
static bool curve(struct text *text, const fbd_cost *cost, const struct axes *axes, size_t s, double end[2])
{
    const fbd_series *series = &cost->series[s];
    bool any = false;
    struct text marks = {0};
    text_printf(text, "<path class=\"curve%s c%d\" d=\"", series->fixed ? " fixed" : "", colour_of(s));
    for (size_t i = series->first; i < series->first + series->count; i++) {
        const fbd_point *point = &cost->points[i];
        if (!is_drawn(point)) continue;
        end[0] = across(axes, drawn_error(cost, point));
        end[1] = upward(axes, point->seconds);
        text_add(text, any ? " L" : "M");
        pair(text, end[0], end[1]);
        marker(&marks, s, end[0], end[1]);
        any = true;
    }
    if (!any) text_add(text, "M0 0");
    text_printf(text, "\"/>\n<path class=\"marks%s c%d\" d=\"%s\"/>\n", series->fixed ? " open" : "",
                colour_of(s), any ? marks.data : "M0 0");
    text->failed = text->failed || marks.failed;
    text_free(&marks);
    return any;
}

struct label {
    size_t series;
    double x, y; /* end of the line */
    double at;   /* height of the name */
};

static int by_height(const void *one, const void *other)
{
    const struct label *a = one, *b = other;
    return (a->y > b->y) - (a->y < b->y);
}

/* Separate the labels without changing their order: shift each one down as far as necessary, then up from the
 * bottom. */
static void spread(struct label *labels, size_t count)
{
    double least = top + 4;
    for (size_t i = 0; i < count; i++) {
        labels[i].at = fmax(labels[i].y, least);
        least = labels[i].at + label_pitch;
    }
    double most = bottom;
    for (size_t i = count; i-- > 0;) {
        labels[i].at = fmin(labels[i].at, most);
        most = labels[i].at - label_pitch;
    }
}

static void names(struct text *text, const fbd_cost *cost, struct label *labels, size_t count)
{
    qsort(labels, count, sizeof *labels, by_height);
    spread(labels, count);
    for (size_t i = 0; i < count; i++) {
        const struct label *label = &labels[i];
        const fbd_series *series = &cost->series[label->series];
        text_printf(text, "<path class=\"leader c%d\" d=\"M", colour_of(label->series));
        pair(text, label->x + 6, label->y);
        text_add(text, " L");
        pair(text, fmax(right + 6, label->x + 6), label->at);
        text_add(text, " h6\"/>\n");
        text_printf(text, "<path class=\"marks%s c%d\" d=\"", series->fixed ? " open" : "",
                    colour_of(label->series));
        marker(text, label->series, right + 19, label->at);
        text_add(text, "\"/>\n");
        begin_text(text, right + 28, label->at + 4, "");
        text_printf(text, "%s%s", series->method, series->fixed ? ", fixed h" : "");
        if (!isnan(series->order))
            text_printf(text, "<tspan class=\"small\" dx=\"5\">order %.1f</tspan>", series->order);
        text_add(text, "</text>\n");
    }
}

static void curves(struct text *text, const fbd_cost *cost, const struct axes *axes)
{
    struct label *labels = calloc(cost->series_count + 1, sizeof *labels);
    size_t count = 0;
    if (!labels) {
        text->failed = true;
        return;
    }
    for (size_t s = 0; s < cost->series_count; s++) {
        double end[2] = {0};
        if (curve(text, cost, axes, s, end))
            labels[count++] = (struct label){.series = s, .x = end[0], .y = end[1]};
    }
    names(text, cost, labels, count);
    free(labels);
}

/* ---- the whole */

/* Restricted to these drawings on any page; dark only on a screen. The contrast of colours to the paper is
 * that of text, 4.5 to 1. */
static const char style[] =
    ".fbd-cost text{font:13px Helvetica,Arial,sans-serif;fill:#111}.fbd-cost .paper{fill:#fff}"
    ".fbd-cost .title{font-size:17px;font-weight:bold}.fbd-cost .small{font-size:11px;fill:#555}"
    ".fbd-cost .grid{stroke:#dcdcdc;stroke-width:.7}.fbd-cost .tick{stroke:#111;stroke-width:.7}"
    ".fbd-cost .frame{fill:none;stroke:#111}.fbd-cost .floor{fill:#efefef}"
    ".fbd-cost .floorline{stroke:#777;stroke-dasharray:5 3}"
    ".fbd-cost "
    ".front{fill:none;stroke:#bdbdbd;stroke-width:9;stroke-linejoin:round;stroke-linecap:round;opacity:.75}"
    ".fbd-cost .curve{fill:none;stroke-width:1.5;stroke-linejoin:round}"
    ".fbd-cost .fixed{stroke-dasharray:6 3}.fbd-cost .marks{stroke-width:1;fill:currentColor}"
    ".fbd-cost .open{fill:#fff}.fbd-cost .leader{fill:none;stroke-width:.6;stroke-dasharray:1 2}"
    ".fbd-cost .c0{color:#000000;stroke:#000000}.fbd-cost .c1{color:#0072B2;stroke:#0072B2}"
    ".fbd-cost .c2{color:#C04F00;stroke:#C04F00}.fbd-cost .c3{color:#00795A;stroke:#00795A}"
    ".fbd-cost .c4{color:#A8447A;stroke:#A8447A}.fbd-cost .c5{color:#1F78A8;stroke:#1F78A8}"
    ".fbd-cost .c6{color:#8A6200;stroke:#8A6200}.fbd-cost .c7{color:#7A5195;stroke:#7A5195}"
    "@media screen and (prefers-color-scheme:dark){.fbd-cost text{fill:#e8e8e8}"
    ".fbd-cost .paper,.fbd-cost .open{fill:#14171c}.fbd-cost .small{fill:#a8adb5}"
    ".fbd-cost .grid{stroke:#333a44}.fbd-cost .tick,.fbd-cost .frame{stroke:#ccd}"
    ".fbd-cost .floor{fill:#20262e}.fbd-cost .floorline{stroke:#99a}.fbd-cost .front{stroke:#4a525d}"
    ".fbd-cost .c0{color:#ffffff;stroke:#ffffff}.fbd-cost .c1{color:#6fb3ec;stroke:#6fb3ec}"
    ".fbd-cost .c2{color:#ff9466;stroke:#ff9466}.fbd-cost .c3{color:#4fd0a5;stroke:#4fd0a5}"
    ".fbd-cost .c4{color:#f0a0cf;stroke:#f0a0cf}.fbd-cost .c5{color:#8ad4ff;stroke:#8ad4ff}"
    ".fbd-cost .c6{color:#ffc14d;stroke:#ffc14d}.fbd-cost .c7{color:#c79be0;stroke:#c79be0}}";

char *fbd_cost_svg(const fbd_cost *cost)
{
    if (!cost) return NULL;
    struct text text = {0};
    struct axes axes;
    const char *title = fbd_model_title(cost->model);
    text_printf(&text,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fbd-cost\" width=\"%d\" height=\"%d\" "
                "viewBox=\"0 0 %d %d\">\n"
                "<title>What accuracy costs</title>\n<style>%s</style>\n"
                "<rect class=\"paper\" width=\"%d\" height=\"%d\"/>\n",
                width, height, width, height, style, width, height);
    begin_text(&text, left, 32, " class=\"title\"");
    svg_escape(&text, title[0] ? title : "What accuracy costs");
    text_add(&text, "</text>\n");
    begin_text(&text, left, 54, "");
    text_add(&text, "Error against time over ");
    text_number(&text, cost->until, 6);
    text_add(&text, " s of motion, for every method from loose to tight</text>\n");
    if (find_axes(cost, &axes)) {
        floor_band(&text, cost, &axes);
        frame(&text, &axes);
        front(&text, cost, &axes);
        curves(&text, cost, &axes);
    } else {
        begin_text(&text, left, top + 40, "");
        text_add(&text, "No run has a known error.</text>\n");
    }
    text_add(&text, "</svg>\n");
    if (text.failed) text_free(&text);
    return text.data;
}
