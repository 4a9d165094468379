/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The report of a scene of many bodies: a summary. The full report has some ten lines for each body.
 */
#include <string.h>

#include "dynamics/mass.h"
#include "output/couplings.h"
#include "output/equations.h"
#include "output/report.h"
#include "output/words.h"

enum { few_events = 12, few_states = 4, few_forces = 6, few_parameters = 12 };

static void count_of(struct text *text, const char *before, size_t count, const char *one,
                     const char *several)
{
    if (count > 0) text_printf(text, "%s%zu %s", before, count, count == 1 ? one : several);
}

static void write_size(struct text *text, const struct fbd_model *model)
{
    size_t listed = 0;
    for (size_t b = 0; b < model->body_count; b++) listed += (size_t)model->bodies[b].load_count;
    count_of(text, "", model->body_count, "body", "bodies");
    count_of(text, ", ", (size_t)model->plan.n, "coordinate", "coordinates");
    count_of(text, ", ", (size_t)model->plan.own, "state", "states");
    count_of(text, ", ", listed, "force or moment", "forces and moments");
    text_add(text, "\n");
}

/* ---- events, by their kinds; those of the file by their names */

static bool is_alike(const struct fbd_model *model, const struct run_event *a, const struct run_event *b)
{
    return a->kind == b->kind &&
           (a->kind != FBD_EVENT_USER || strcmp(event_name(model, a), event_name(model, b)) == 0);
}

/* Write all events that are like event `first`. */
static void write_kind(struct text *text, const struct ensemble *run, size_t first)
{
    const struct run_event *event = &run->events[first], *last = event;
    size_t count = 0;
    for (size_t i = first; i < run->event_count; i++) {
        if (!is_alike(run->model, event, &run->events[i])) continue;
        last = &run->events[i];
        count++;
    }
    text_printf(text, "  %s",
                event->kind == FBD_EVENT_USER ? event_name(run->model, event)
                                              : fbd_event_kind_name(event->kind));
    text_pad(text, 20);
    text_printf(text, "%zu, t = ", count);
    text_number(text, event->t, report_digits);
    if (count > 1) {
        text_add(text, " to ");
        text_number(text, last->t, report_digits);
    }
    text_add(text, " s\n");
}

static bool is_first_of_its_kind(const struct ensemble *run, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (is_alike(run->model, &run->events[i], &run->events[index])) return false;
    return true;
}

static bool events_are_few(const struct ensemble *run)
{
    return run->event_count <= few_events;
}

static void write_events(const struct page *page)
{
    const struct ensemble *run = page->result->simulation->ensemble;
    if (run->event_count == 0)
        text_add(page->text, "\nEvents: none\n");
    else
        text_printf(page->text, "\nEvents: %zu\n", run->event_count);
    for (size_t i = 0; i < run->event_count; i++) {
        if (events_are_few(run))
            report_event(page, i);
        else if (is_first_of_its_kind(run, i))
            write_kind(page->text, run, i);
    }
}

/* ---- all bodies together */

struct totals {
    double mass;
    struct vec G, v; /* the centre of mass of all, and its velocity */
};

static struct totals totals_of(const struct fbd_state *state)
{
    const struct instant at = state_instant(state);
    struct totals all = {0};
    for (size_t b = 0; b < state->model->body_count; b++) {
        const struct model_body *body = &state->model->bodies[b];
        const struct pose pose = body_pose(body, &at);
        const struct motion_of_point G = point_motion(body, &pose, body->inertia.G);
        const double mass = body_mass(body, &at);
        all.mass += mass;
        all.G = vec_add(all.G, vec_scale(mass, G.p));
        all.v = vec_add(all.v, vec_scale(mass, G.v));
    }
    all.G = vec_scale(1 / all.mass, all.G);
    all.v = vec_scale(1 / all.mass, all.v);
    return all;
}

static void pair(struct text *text, const char *name, struct vec v, const char *unit)
{
    text_printf(text, "%s (", name);
    text_number(text, v.x, report_digits);
    text_add(text, ", ");
    text_number(text, v.y, report_digits);
    text_printf(text, ") %s", unit);
}

static void write_total(struct text *text, const struct fbd_state *state)
{
    const bool si = state->model->scene->units == unit_si;
    const struct totals all = totals_of(state);
    text_add(text, "  t = ");
    text_number(text, state->t, report_digits);
    text_add(text, " s");
    text_pad(text, 20);
    text_add(text, "mass ");
    text_number(text, all.mass, report_digits);
    text_add(text, si ? " kg, " : " slug, ");
    pair(text, "at", all.G, si ? "m, " : "ft, ");
    pair(text, "v", all.v, si ? "m/s\n" : "ft/s\n");
}

/* ---- some of them */

static void write_states(const struct page *page, struct fbd_state *state)
{
    const size_t count = state->model->body_count;
    text_add(page->text, "\nFinal state at t = ");
    text_number(page->text, state->t, report_digits);
    text_add(page->text, " s, of the first bodies and the last\n");
    for (size_t b = 0; b < count; b++) {
        if (b < few_states || b + few_states >= count)
            report_body_state(page, state, b);
        else if (b == few_states)
            text_printf(page->text, "  ... %zu more\n", count - (size_t)2 * few_states);
    }
    report_own_states(page, state);
}

/* ---- the largest forces */

struct large {
    const char *body, *name;
    struct vec force;
    double size;
};

/* Insert into the ordered list of the largest; of a force and its opposite keep the first. */
static void consider(struct large list[static few_forces], struct large one)
{
    const double rounding = 1e-12; /* of the same force on two bodies */
    size_t place = 0;
    while (place < few_forces && list[place].size > one.size * (1 + rounding)) place++;
    if (place == few_forces || one.size == 0) return;
    for (size_t k = place; k < few_forces && list[k].size >= one.size * (1 - rounding); k++) {
        const struct vec sum = vec_add(list[k].force, one.force);
        if (hypot(sum.x, sum.y) <= rounding * one.size) return;
    }
    memmove(&list[place + 1], &list[place], (few_forces - 1 - place) * sizeof *list);
    list[place] = one;
}

static void write_largest(const struct page *page, const struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    struct arrow *arrows = page->result->ledger.arrows;
    const struct instant at = state_instant(state);
    struct large list[few_forces] = {0};
    for (size_t b = 0; b < model->body_count; b++) {
        const size_t count = diagram_fill(model, (int)b, &at, state->slots, arrows);
        for (size_t i = 0; i < count; i++)
            consider(list, (struct large){model->bodies[b].name, arrows[i].name, arrows[i].force,
                                          hypot(arrows[i].force.x, arrows[i].force.y)});
    }
    if (list[0].size > 0) text_add(page->text, "\nLargest forces at the end, in the world's x and y\n");
    for (size_t i = 0; i < few_forces && list[i].size > 0; i++) {
        text_printf(page->text, "  %s on %s", list[i].name, list[i].body);
        text_pad(page->text, 36);
        pair(page->text, "", list[i].force, force_unit(model));
        text_add(page->text, "\n");
    }
}

void report_short(const struct page *page)
{
    fbd_result *result = page->result;
    const struct ensemble *run = result->simulation->ensemble;
    struct fbd_state *state = fbd_result_state(result);
    write_size(page->text, run->model);
    write_events(page);
    report_early_end(page);
    state_ready(state);
    text_add(page->text, "\nAll bodies together\n");
    write_total(page->text, result->start);
    write_total(page->text, state);
    write_states(page, state);
    write_largest(page, state);
    report_energy(page);
    couplings_report(page->text, result);
    report_parameters(page, few_parameters);
    report_cost(page);
    text_printf(
        page->text,
        "\nIn short, as there are more than %d bodies. Left out: the equations at the start, %s%zu final "
        "states, most forces and their work; --full has them\n",
        report_few_bodies, events_are_few(run) ? "" : "each event, ",
        run->model->body_count - (size_t)2 * few_states);
}
