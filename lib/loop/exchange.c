/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/exchange.h"

#include <float.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/project.h"
#include "loop/contacts.h"
#include "loop/switch_event.h"
#include "numeric/tolerances.h"

/* ---- scenes whose events are not all zeros of functions */

static const char *lack_of(const struct tree *tree, int index)
{
    const struct coupling *coupling = &tree->couplings[index];
    switch (coupling->kind) {
    case constraint_slot:
    case constraint_groove:
        if (coupling->source->curve || isfinite(coupling->source->from) || isfinite(coupling->source->to))
            return "the slot `%s` may have ends";
        return NULL;
    case constraint_capstan: return "the rope `%s` may come off its drum";
    case constraint_rope:
        if (coupling->wound[0] != 0 || coupling->wound[1] != 0 || coupling->reels)
            return "the rope `%s` may be all unwound, or hauled in";
        if (coupling->end_count > 2 || rope_goes_on(tree, index) ||
            (index > 0 && rope_goes_on(tree, index - 1)))
            return "the rope `%s` may leave its pulley, or have no length left between two points";
        return NULL;
    case constraint_plane: return "the friction `%s` turns with the velocity, down to the stop";
    default: return NULL;
    }
}

bool exchange_lack(const struct fbd_model *model, struct text *words)
{
    const struct tree *tree = model->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        const char *form = lack_of(tree, i);
        if (!form) continue;
        text_printf(words, form, tree->couplings[i].name);
        return true;
    }
    return false;
}

/* ---- life */

/* All pairs take part in the next step, whose length is not known. */
static void wake_contacts(struct run *run)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i < tree->meeting_count; i++)
        run->contacts.asleep[i] = meeting_is_gone(run->state->tree, &tree->meetings[i]);
}

/* The present state is the start of a step. */
static void begin(struct run *run)
{
    run->step.from = run->state->t;
    run->step.from_rest = run->state->rest;
    state_copy(run->during, run->state);
    wake_contacts(run);
    run_evaluate(run);
    const struct pole *nearest;
    if (run->poles.count > 0) poles_longest_step(&run->poles, run->state, &nearest);
}

/* The modes have changed. */
static void start_modes(struct run *run)
{
    begin(run);
    scan_forget(&run->search.timed);
    run->search.knows_timed = false;
    scan_forget(&run->search.moving);
    watchers_follow(&run->watchers, run->during);
    run_note_sign(run);
    run->stale = true;
}

bool exchange_init(struct exchange *exchange, const struct fbd_state *start,
                   const struct run_options *options)
{
    const struct fbd_model *model = start->model;
    struct run_options own = *options;
    const struct state_start from = {start->t, start->y, start->branch, start};
    own.structure = false;
    *exchange = (struct exchange){0};
    exchange->run = run_new(model, &own, start->t != 0 ? &from : NULL, &exchange->memory);
    exchange->kept = ARENA_ARRAY(&exchange->memory, plan_size(&model->plan) + 1, double);
    if (!exchange->run || !exchange->kept) return false;
    struct run *run = exchange->run;
    const double length = own.until - start->t;
    exchange->length = length > 0 ? length : 1;
    if (run->end.outcome == FBD_DONE) run->end.outcome = FBD_GOING; /* its end is that of the other program */
    if (run->end.outcome == FBD_GOING) start_modes(run);
    return true;
}

void exchange_free(struct exchange *exchange)
{
    run_free(exchange->run);
    arena_free(&exchange->memory);
    *exchange = (struct exchange){0};
}

/* ---- within a step */

void exchange_put(struct exchange *exchange, double t, const double *y)
{
    struct run *run = exchange->run;
    if (t != run->state->t) state_set_moment(run->state, time_dd_at(t));
    memcpy(run->state->y, y, plan_size(&run->model->plan) * sizeof *y);
    run->stale = true;
    exchange->moved = true;
}

void exchange_set_input(struct exchange *exchange, size_t input, double value)
{
    struct run *run = exchange->run;
    run->state->held[input] = run->during->held[input] = value;
    run->stale = true;
    exchange->moved = true;
}

void exchange_slopes(struct exchange *exchange, double *dy)
{
    run_evaluate(exchange->run);
    state_flow(exchange->run->state, dy);
}

/* The functions at the state, and their rates. */
static void evaluate(struct run *run)
{
    run_evaluate(run);
    watchers_evaluate(&run->watchers, &run->watchers.moving, run->state, run_end(run), run->state->y, NULL,
                      run->work.values, run->work.values + run->search.moving.count);
    run->stale = true; /* the scratch of the state is that of the functions */
}

/* The time since the first zero of a function that has become negative, 0 without one. */
static double time_since(struct run *run)
{
    const double *values = run->work.values, *rates = values + run->search.moving.count;
    double since = 0;
    for (size_t i = 0; i < run->search.moving.count; i++)
        if (values[i] < 0 && rates[i] < 0) since = fmax(since, values[i] / rates[i]);
    return since;
}

void exchange_functions(struct exchange *exchange, double *values)
{
    struct run *run = exchange->run;
    evaluate(run);
    for (size_t i = 0; i < run->search.moving.count; i++)
        values[i] = fabs(run->work.values[i]) < HUGE_VAL ? run->work.values[i] : 1;
}

/* ---- the end of a step */

/* Close the couplings, from wherever the steps of another method have led. Returns whether they were off by more than the
 * tolerance, relative to the size of the mechanism and to its speed; at rest, to a speed that would move it by its size
 * within the run. */
static bool project(const struct exchange *exchange)
{
    struct run *run = exchange->run;
    const double least = negligible_sum; /* rounding in a mechanism of many rows, relative to its size */
    const double tolerance = fmax(run->options.tolerance, least);
    const struct tree *tree = run->model->tree;
    if (!tree_has_couplings(tree)) return false;
    const struct closing closing = state_close(run->state);
    constraints_follow(run->model, run->state->tree);
    run->stale = true;
    projection_begin(run);
    if (closing.left.position > 1e3 * tolerance * run->drift.reach)
        run_fail(
            run, FBD_FAILED,
            "at t = %.9g the coupling `%s` cannot be closed (its error is %.3g): the mechanism is at the end "
            "of its reach, or the steps of the importer are too long",
            run_time(run), coupling_row_name(tree, closing.left.row >= 0 ? closing.left.row : 0),
            closing.left.position);
    const double speed = fmax(run->drift.speed, run->drift.reach / exchange->length);
    return closing.off.position > tolerance * run->drift.reach || closing.off.velocity > tolerance * speed;
}

bool exchange_complete(struct exchange *exchange)
{
    struct run *run = exchange->run;
    const size_t size = plan_size(&run->model->plan);
    const double h = run->state->t - run->step.from;
    double *most = run->recent.anchor + size;
    if (run->end.outcome != FBD_GOING) return false;
    evaluate(run);
    if (time_since(run) > 0) return true;
    run_evaluate(run);
    if (run->poles.count > 0 && h > 0 &&
        poles_passed(&run->poles, run->during, h, run->state->t, run->state->y,
                     (state_flow(run->state, run->work.sample), run->work.sample)))
        run_fail(run, FBD_FAILED, "by t = %.9g a step has passed a division by zero", run_time(run));
    for (size_t i = 0; i < size; i++) most[i] = fmax(most[i], fabs(run->state->y[i]));
    memcpy(exchange->kept, run->state->y, size * sizeof *exchange->kept);
    const bool drifts = project(exchange);
    memcpy(run->state->y, exchange->kept, size * sizeof *exchange->kept);
    run->stale = true;
    if (run->end.outcome != FBD_GOING) return false;
    run_check_jam(run, false);
    run_check_sides(run);
    run_check_lifetimes(run);
    if (run->end.outcome != FBD_GOING) return false;
    watchers_arm(&run->watchers, run->state, h);
    run->stale = true;
    begin(run);
    return drifts;
}

/* ---- events */

/* Prescribed motions and sticking bodies are where they have to be, not only up to the errors of the other program: a body
 * that sticks is at rest on its surface to the last bit. `during` has the modes. */
static void impose(struct run *run)
{
    impose_drives(run, run->state->t, run->state->y);
    run->stale = true;
}

/* Move the state along its motion. */
static void move(struct run *run, double time)
{
    run_evaluate(run);
    state_flow(run->state, run->work.sample);
    for (size_t i = 0; i < plan_size(&run->model->plan); i++) run->state->y[i] += time * run->work.sample[i];
    state_set_moment(run->state, time_dd_after(run_end(run), time));
    run->stale = true;
}

/* Move the state back to the first zero; flags the functions that cross there. Returns whether there is one, and adds the
 * time to *back. */
static bool go_back(struct run *run, double *back)
{
    enum { most_steps = 5 };
    const double instant = round_off(64, fmax(fabs(run->state->t), run->step.longest));
    const double *values = run->work.values, *rates = values + run->search.moving.count;
    bool any = false;
    evaluate(run);
    double since = time_since(run);
    if (!(since > 0)) return false;
    for (size_t i = 0; i < run->search.moving.count; i++) {
        const bool down = values[i] < 0 && rates[i] < 0;
        run->search.moving.crossed[i] = down && values[i] / rates[i] >= since - instant;
        any |= run->search.moving.crossed[i];
    }
    for (int step = 0; step < most_steps && since != 0; step++) {
        double next = HUGE_VAL;
        move(run, -since);
        *back += since;
        evaluate(run);
        for (size_t i = 0; i < run->search.moving.count; i++)
            if (run->search.moving.crossed[i] && rates[i] < 0) next = fmin(next, values[i] / rates[i]);
        since = fabs(next) < HUGE_VAL && fabs(next) > round_off(1, fabs(run->state->t)) ? next : 0;
    }
    return any;
}

/* A switch that an input has passed by a jump changes its branch, whatever its rate. */
static bool find_jumps(struct run *run)
{
    const struct watcher_set *set = &run->watchers.moving;
    bool any = false;
    evaluate(run);
    for (size_t i = 0; i < set->count; i++) {
        const bool down = set->watchers[i].kind == watch_kink && run->work.values[i] < 0 &&
                          run->work.values[set->count + i] == 0;
        run->search.moving.crossed[i] = down;
        any |= down;
    }
    return any;
}

static void apply(struct run *run, const bool *timed, const bool *moving)
{
    state_copy(run->during, run->state);
    impose(run);
    run_evaluate(run);
    state_copy(run->during, run->state);
    run_check_jam(run, false);
    if (run->end.outcome == FBD_GOING) run_apply(run, timed, moving);
    run->stale = true;
    if (run->end.outcome != FBD_GOING) return;
    state_copy(run->during, run->state);
    impose(run);
    start_modes(run);
}

static void apply_timed(struct exchange *exchange)
{
    struct run *run = exchange->run;
    const double beyond = time_dd_since(run_end(run), exchange->next);
    if (!exchange->timed || beyond < 0) return;
    exchange->timed = false;
    move(run, -beyond);
    state_set_moment(run->state, exchange->next);
    apply(run, run->search.timed.crossed, NULL);
    move(run, beyond);
}

static void apply_moving(struct exchange *exchange)
{
    struct run *run = exchange->run;
    const double t = run->state->t, rest = run->state->rest;
    double back = 0;
    bool any = false;
    while (run->end.outcome == FBD_GOING && go_back(run, &back)) {
        apply(run, NULL, run->search.moving.crossed);
        if (run->end.outcome != FBD_GOING) return;
        move(run, back);
        back = 0;
        any = true;
    }
    if (run->end.outcome != FBD_GOING) return;
    state_set_moment(run->state, (struct time_dd){t, rest});
    impose(run);
    const bool jumps = find_jumps(run);
    if (jumps || !any) apply(run, NULL, jumps ? run->search.moving.crossed : NULL);
}

static void apply_all(struct exchange *exchange)
{
    struct run *run = exchange->run;
    exchange->moved = false;
    impose(run);
    project(exchange);
    if (run->end.outcome != FBD_GOING) return;
    apply_timed(exchange);
    apply_moving(exchange); /* unless the run has ended */
}

/* Find the next zero of a function of time alone, within the length of the run from here; without one the search goes on
 * at the returned time. */
static double next_timed(struct exchange *exchange)
{
    struct run *run = exchange->run;
    if (run->watchers.timed.count == 0) return NAN;
    const double to = run->state->t + exchange->length;
    run->options.until = run->search.timed.horizon = to;
    const int found = run_find_timed(run, to);
    exchange->timed = found == 1;
    if (found != 1) return found == 2 ? run->search.timed.clear : to;
    exchange->next = run_pin_timed(run);
    const double t = exchange->next.t;
    return exchange->next.rest > 0 ? nextafter(t, HUGE_VAL) : t;
}

void exchange_update(struct exchange *exchange, double *next)
{
    struct run *run = exchange->run;
    *next = NAN;
    if (run->end.outcome != FBD_GOING) return;
    if (exchange->moved) apply_all(exchange);
    if (run->end.outcome != FBD_GOING) return;
    watchers_arm(&run->watchers, run->state, 0);
    run->stale = true;
    begin(run);
    *next = next_timed(exchange);
}
