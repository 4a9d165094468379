/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The cost of accuracy as a table and sentences.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fbd_study.h"
#include "study/cost.h"

void text_seconds(struct text *text, double seconds)
{
    static const struct {
        double size;
        const char *unit;
    } units[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}};
    size_t k = seconds >= 1 ? 0 : seconds >= 1e-3 ? 1 : 2;
    text_number(text, seconds / units[k].size, 3);
    text_printf(text, " %s", units[k].unit);
}

/* 1e-6, not 1e-06. */
static void power(struct text *text, double value)
{
    int exponent = (int)floor(log10(value) + 1e-9);
    double digits = value / pow(10, exponent);
    if (exponent < -2 || exponent > 5)
        text_printf(text, "%.3ge%d", digits, exponent);
    else
        text_number(text, value, 4);
}

static void setting(struct text *text, const fbd_point *point)
{
    text_add(text, point->step > 0 ? "h = " : "");
    power(text, point->step > 0 ? point->step : point->tolerance);
    if (point->step > 0) text_add(text, " s");
}

/* ---- the table */

static void error(struct text *text, double value, double floor)
{
    if (isnan(value))
        text_add(text, "-");
    else if (value <= floor)
        text_printf(text, "<= %.0e", floor);
    else
        text_printf(text, "%.1e", value);
}

static void numbers(struct text *text, const struct fbd_cost *cost, const fbd_point *point)
{
    error(text, point->error, cost->reference.floor);
    text_pad(text, 34);
    error(text, point->error_end, cost->reference.floor_end);
    text_pad(text, 44);
    if (!point->same_events)
        text_add(text, "other");
    else if (isnan(point->event_error))
        text_add(text, "-");
    else
        text_printf(text, "%.1e", point->event_error);
    text_pad(text, 53);
    text_seconds(text, point->seconds);
    text_pad(text, 63);
    enum { enough_for_a_spread = 4 };
    if (point->repeats >= enough_for_a_spread)
        text_printf(text, "%.0f %%", 50 * (point->high - point->low) / point->seconds);
    else
        text_add(text, "-");
    text_pad(text, 69);
    text_printf(text, "%7lu %7lu %7lu %6lu %6lu", point->stats.rhs, point->stats.jacobians,
                point->stats.steps, point->stats.rejected, point->stats.events);
}

static void row(struct text *text, const struct fbd_cost *cost, const fbd_point *point)
{
    text_printf(text, "%s %s", point->front ? "*" : " ", point->method);
    text_pad(text, 11);
    setting(text, point);
    text_pad(text, 24);
    if (point->state == FBD_POINT_MEASURED)
        numbers(text, cost, point);
    else
        text_printf(text, "%s: %s", point->state == FBD_POINT_FAILED ? "failed" : "skipped", point->reason);
    text_add(text, "\n");
}

/* Skipped points at the end of a ladder are one row. */
static void rows(struct text *text, const struct fbd_cost *cost, const fbd_series *series)
{
    size_t end = series->first + series->count, last = end;
    while (last > series->first && cost->points[last - 1].state == FBD_POINT_SKIPPED) last--;
    for (size_t i = series->first; i < last; i++) row(text, cost, &cost->points[i]);
    if (last < end) {
        const fbd_point *point = &cost->points[last];
        text_printf(text, "  %s", point->method);
        text_pad(text, 11);
        setting(text, point);
        text_pad(text, 24);
        text_printf(text, "skipped%s: %s\n", last + 1 < end ? ", and all below" : "", point->reason);
    }
    if (isnan(series->order)) return;
    text_pad(text, 11);
    text_printf(text, "observed order %.1f\n", series->order);
}

static void table(struct text *text, const struct fbd_cost *cost)
{
    text_add(text,
             "\n  method   setting      error     error     time of   time of         "
             "right-h.\n"
             "                        max       at end    events    a run     +-        sides  Jacob.   "
             "steps reject events\n");
    for (size_t s = 0; s < cost->series_count; s++) rows(text, cost, &cost->series[s]);
    text_add(text, "* on the Pareto front: nothing is both more accurate and cheaper\n");
}

/* ---- the reference */

/* Break lines at blanks, at about the width of the report. */
static void paragraph(struct text *text, const char *sentences)
{
    enum { width = 108 };
    size_t column = 2;
    text_add(text, "  ");
    for (const char *word = sentences; *word;) {
        size_t length = strcspn(word, " ");
        if (column > 2 && column + length > width) {
            text_add(text, "\n  ");
            column = 2;
        }
        text_add_bytes(text, word, length);
        column += length + 1;
        word += length;
        while (*word == ' ') word++;
        if (*word && column + strcspn(word, " ") <= width) text_add(text, " ");
    }
    text_add(text, "\n");
}

static void measure(struct text *text, const struct fbd_cost *cost)
{
    const struct certified_reference *reference = &cost->reference;
    size_t size = quantity_count(cost->model);
    text_add(text, "\nReference\n");
    paragraph(text, cost->says);
    text_add(text, "\nErrors are divided by the size of each quantity: ");
    size_t shown = 0, counted = 0;
    enum { most_shown = 6 };
    for (size_t i = 0; i < size; i++) counted += reference->scale[i] > 0;
    for (size_t i = 0; i < size && shown < most_shown; i++) {
        if (!(reference->scale[i] > 0)) continue;
        text_printf(text, "%s%s ", shown ? ", " : "", quantity_name_of(cost->model, i));
        text_number(text, reference->scale[i], 3);
        text_printf(text, " %s", quantity_unit_of(cost->model, i));
        shown++;
    }
    if (counted > shown) text_printf(text, " and %zu more", counted - shown);
    text_add(text, counted ? "\n" : "nothing moves\n");
}

/* ---- answers */

static void answer(struct text *text, const struct fbd_cost *cost, double target)
{
    const fbd_point *point = cost_cheapest(cost, target);
    text_add(text, "  ");
    power(text, target);
    if (target < cost->reference.floor) {
        text_printf(text, "  cannot be measured: the uncertainty of the reference is %.1e\n",
                    cost->reference.floor);
        return;
    }
    if (!point) {
        text_add(text, "  is not reached within this budget\n");
        return;
    }
    text_add(text, " costs ");
    text_seconds(text, point->seconds);
    text_printf(text, " with %s", point->method);
    text_pad(text, 34);
    text_printf(text, "fbd-run --method %s %s ", point->method, point->step > 0 ? "--step" : "--tolerance");
    power(text, point->step > 0 ? point->step : point->tolerance);
    text_pad(text, 77);
    text_add(text, "(error ");
    error(text, point->error, cost->reference.floor);
    text_add(text, ")\n");
}

char *fbd_cost_text(const fbd_cost *cost)
{
    if (!cost) return NULL;
    struct text text = {0};
    text_heading(&text, fbd_model_title(cost->model));
    text_printf(&text, "What accuracy costs, over %.6g s\n", cost->until);
    measure(&text, cost);
    table(&text, cost);
    if (cost->reference.track.reached > 0) {
        text_add(&text, "\nAnswers\n");
        for (int decade = 3; decade <= 12; decade += 3) answer(&text, cost, pow(10, -decade));
    }
    if (text.failed) text_free(&text);
    return text.data;
}
