/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The cost of accuracy as data: CSV and JSON.
 */
#include <math.h>

#include "fbd_study.h"
#include "study/cost.h"

static const char *state_name(fbd_point_state state)
{
    return state == FBD_POINT_MEASURED ? "measured" : state == FBD_POINT_FAILED ? "failed" : "skipped";
}

/* ---- CSV; values not measured are empty */

static void cell(struct text *text, bool there, double value)
{
    text_add(text, ",");
    if (there && !isnan(value)) text_exact(text, value);
}

static void cell_text(struct text *text, const char *value)
{
    text_add(text, ",\"");
    for (const char *c = value; *c; c++) text_printf(text, *c == '"' ? "\"\"" : "%c", *c);
    text_add(text, "\"");
}

static void csv_row(struct text *text, const fbd_point *point, double order)
{
    bool measured = point->state == FBD_POINT_MEASURED;
    text_printf(text, "%s", point->method);
    cell(text, point->tolerance > 0, point->tolerance);
    cell(text, point->step > 0, point->step);
    text_printf(text, ",%s", state_name(point->state));
    cell(text, measured, point->error);
    cell(text, measured, point->error_end);
    text_printf(text, ",%d", measured && point->floor);
    cell(text, measured, point->event_error);
    text_printf(text, ",%d", measured && point->same_events);
    cell(text, measured, point->seconds);
    cell(text, measured, point->low);
    cell(text, measured, point->high);
    text_printf(text, ",%u,%lu,%lu,%lu,%lu,%lu,%d", point->repeats, point->stats.rhs, point->stats.jacobians,
                point->stats.steps, point->stats.rejected, point->stats.events, point->front);
    cell(text, true, order);
    cell_text(text, measured ? point->worst : point->reason);
    text_add(text, "\n");
}

char *fbd_cost_csv(const fbd_cost *cost)
{
    if (!cost) return NULL;
    struct text text = {0};
    text_add(&text, "method,tolerance,step [s],state,error,error at end,at floor,event error [s],same events,"
                    "time [s],time low [s],time high [s],repeats,rhs,jacobians,steps,rejected,events,front,"
                    "order,note\n");
    for (size_t s = 0; s < cost->series_count; s++)
        for (size_t i = 0; i < cost->series[s].count; i++)
            csv_row(&text, &cost->points[cost->series[s].first + i], cost->series[s].order);
    if (text.failed) text_free(&text);
    return text.data;
}

/* ---- JSON; values not measured are null */

static void member(struct text *text, const char *name, double value)
{
    text_json_key(text, name);
    text_json_number(text, value);
    text_add(text, ", ");
}

static void member_text(struct text *text, const char *name, const char *value)
{
    text_json_key(text, name);
    text_json_string(text, value);
    text_add(text, ", ");
}

static void member_flag(struct text *text, const char *name, bool value)
{
    text_printf(text, "\"%s\": %s, ", name, value ? "true" : "false");
}

static void json_setting(struct text *text, const fbd_point *point)
{
    member_text(text, "method", point->method);
    member(text, "tolerance", point->tolerance > 0 ? point->tolerance : NAN);
    member(text, "step", point->step > 0 ? point->step : NAN);
}

static void json_point(struct text *text, const fbd_point *point)
{
    bool measured = point->state == FBD_POINT_MEASURED;
    text_add(text, "{");
    json_setting(text, point);
    member_text(text, "state", state_name(point->state));
    member_text(text, "reason", point->reason);
    member(text, "error", measured ? point->error : NAN);
    member(text, "error_end", measured ? point->error_end : NAN);
    member_text(text, "worst", measured ? point->worst : "");
    member_flag(text, "floor", measured && point->floor);
    member(text, "event_error", measured ? point->event_error : NAN);
    member_flag(text, "same_events", measured && point->same_events);
    member(text, "seconds", measured ? point->seconds : NAN);
    member(text, "seconds_low", measured ? point->low : NAN);
    member(text, "seconds_high", measured ? point->high : NAN);
    member_flag(text, "front", point->front);
    text_printf(text,
                "\"repeats\": %u, \"rhs\": %lu, \"jacobians\": %lu, \"steps\": %lu, \"rejected\": %lu, "
                "\"events\": %lu}",
                point->repeats, point->stats.rhs, point->stats.jacobians, point->stats.steps,
                point->stats.rejected, point->stats.events);
}

static void json_reference(struct text *text, const fbd_cost *cost)
{
    fbd_reference reference = fbd_cost_reference(cost);
    text_add(text, "  \"reference\": {");
    member_text(text, "says", reference.says);
    text_add(text, "\"methods\": [");
    for (int k = 0; k < 2; k++) {
        text_add(text, k ? ", {" : "{");
        member_text(text, "method", reference.method[k]);
        text_printf(text, "\"tolerance\": %.0e}", reference.tolerance[k]);
    }
    text_add(text, "], ");
    member_flag(text, "exact", reference.exact);
    member_flag(text, "exact_differs", reference.exact_differs);
    member(text, "floor", reference.floor);
    member(text, "floor_end", reference.floor_end);
    member(text, "tenfold", reference.tenfold);
    member(text, "known", reference.known);
    text_printf(text, "\"complete\": %s},\n", reference.complete ? "true" : "false");
}

static void json_scales(struct text *text, const fbd_cost *cost)
{
    size_t size = quantity_count(cost->model);
    text_add(text, "  \"scales\": {");
    for (size_t i = 0, shown = 0; i < size; i++) {
        if (!(cost->reference.scale[i] > 0)) continue;
        text_printf(text, "%s\"%s\": ", shown++ ? ", " : "", quantity_name_of(cost->model, i));
        text_exact(text, cost->reference.scale[i]);
    }
    text_add(text, "},\n");
}

static void json_answers(struct text *text, const fbd_cost *cost)
{
    text_add(text, "  \"answers\": [");
    for (int decade = 3, shown = 0; decade <= 12; decade += 3) {
        const fbd_point *point = cost_cheapest(cost, pow(10, -decade));
        if (!point) continue;
        text_printf(text, "%s\n    {\"target\": 1e-%d, ", shown++ ? "," : "", decade);
        json_setting(text, point);
        member(text, "error", point->error);
        text_add(text, "\"seconds\": ");
        text_exact(text, point->seconds);
        text_add(text, "}");
    }
    text_add(text, "\n  ],\n");
}

char *fbd_cost_json(const fbd_cost *cost)
{
    if (!cost) return NULL;
    struct text text = {0};
    text_add(&text, "{\n  \"title\": ");
    text_json_string(&text, fbd_model_title(cost->model));
    text_add(&text, ",\n  \"until\": ");
    text_exact(&text, cost->until);
    text_add(&text, ",\n");
    json_reference(&text, cost);
    json_scales(&text, cost);
    json_answers(&text, cost);
    text_add(&text, "  \"series\": [");
    for (size_t s = 0; s < cost->series_count; s++) {
        const fbd_series *series = &cost->series[s];
        text_add(&text, s ? ",\n    {" : "\n    {");
        member_text(&text, "method", series->method);
        member_flag(&text, "fixed", series->fixed);
        member(&text, "order", series->order);
        text_add(&text, "\"points\": [");
        for (size_t i = 0; i < series->count; i++) {
            text_add(&text, i ? ",\n      " : "\n      ");
            json_point(&text, &cost->points[series->first + i]);
        }
        text_add(&text, "\n    ]}");
    }
    text_add(&text, "\n  ]\n}\n");
    if (text.failed) text_free(&text);
    return text.data;
}
