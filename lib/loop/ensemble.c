/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/ensemble.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "dynamics/constraint.h"
#include "rest/balance.h"

/* ---- allocation */

static int group_branch(const struct group *group, int index)
{
    return group->selection ? group->selection->branches[index] : index;
}

/* Copy the components and branches of an island from the start. */
static void part_of_start(const struct ensemble *ensemble, const struct group *group, double *y, int *branch)
{
    const struct fbd_state *whole = ensemble->options.start;
    const struct plan *plan = &group->model->plan;
    for (size_t i = 0; i < plan_size(plan); i++) y[i] = whole->y[group_component(ensemble->model, group, i)];
    for (int i = 0; i < plan->branches; i++) branch[i] = whole->branch[group_branch(group, i)];
}

/* A run that begins at the start of the ensemble. */
static struct run *run_from_start(struct ensemble *ensemble, struct group *group)
{
    const struct plan *plan = &group->model->plan;
    double *y = calloc(plan_size(plan) + 1, sizeof *y);
    int *branch = calloc((size_t)plan->branches + 1, sizeof *branch);
    struct run *run = NULL;
    if (y && branch) {
        const struct fbd_state *whole = ensemble->options.start;
        const struct state_start part = {whole->t, y, branch, whole};
        part_of_start(ensemble, group, y, branch);
        run = run_new(group->model, &ensemble->options, &part, &group->memory);
    }
    free(y);
    free(branch);
    return run;
}

static void free_run(struct group *group)
{
    run_free(group->run);
    state_free(group->probe);
    model_free(group->owned);
    arena_free(&group->memory);
    group->run = NULL;
    group->probe = NULL;
    group->model = group->owned = NULL;
}

bool ensemble_make_run(struct ensemble *ensemble, struct group *group)
{
    free_run(group);
    group->memory.much_room = true;
    group->model = ensemble->model;
    if (group->selection)
        group->model = group->owned = model_group(ensemble->model, group->selection, &group->memory);
    if (!group->model) return false;
    group->run = ensemble->options.start ? run_from_start(ensemble, group)
                                         : run_new(group->model, &ensemble->options, NULL, &group->memory);
    if (!group->run || group->run->end.outcome == FBD_OUT_OF_MEMORY) return false;
    group->quiet = group->run->watchers.timed.count + group->run->watchers.moving.count == 0;
    return true;
}

static bool make_groups(struct ensemble *ensemble)
{
    ensemble->count = 1;
    if (ensemble->options.structure && ensemble->model->body_count > 1) {
        if (!islands_make(&ensemble->division, ensemble->model)) return false;
        if (ensemble->division.count > 1) ensemble->count = ensemble->division.count;
    }
    ensemble->groups = ARENA_ARRAY(&ensemble->memory, ensemble->count, struct group);
    ensemble->queue = ARENA_ARRAY(&ensemble->memory, 2 * ensemble->count, size_t);
    if (ensemble->memory.failed) return false;
    ensemble->due = ensemble->queue + ensemble->count;
    for (size_t p = 0; p < ensemble->count; p++) {
        struct group *group = &ensemble->groups[p];
        if (ensemble->count > 1) group->selection = &ensemble->division.selections[p];
        if (!ensemble_make_run(ensemble, group)) return false;
        const struct run *run = group->run;
        if (run->end.refusal && !ensemble->refused) ensemble->refused = run;
        if (run->end.outcome != FBD_GOING) ensemble_fail(ensemble, run->end.outcome, run->end.reason);
        ensemble->due[p] = p;
        ensemble_free_run(ensemble, group);
    }
    return true;
}

struct ensemble *ensemble_new(const struct fbd_model *model, const struct run_options *options)
{
    struct ensemble *ensemble = block_alloc(sizeof *ensemble);
    if (!ensemble) return NULL;
    ensemble->model = model;
    ensemble->memory.much_room = true;
    ensemble->options = *options;
    ensemble->reason = "";
    ensemble->from = ensemble->t = options->start ? options->start->t : 0;
    ensemble->next_told = HUGE_VAL;
    ensemble->state = state_make(model, NULL, &ensemble->memory);
    if (ensemble->memory.failed || !make_groups(ensemble)) {
        ensemble_free(ensemble);
        return NULL;
    }
    ensemble_release(ensemble, ensemble->count);
    return ensemble;
}

void ensemble_free(struct ensemble *ensemble)
{
    if (!ensemble) return;
    for (size_t p = 0; ensemble->groups && p < ensemble->count; p++) free_run(&ensemble->groups[p]);
    state_free(ensemble->state);
    islands_free(&ensemble->division);
    arena_free(&ensemble->memory);
    free(ensemble->events);
    free(ensemble);
}

/* The first early end counts. */
void ensemble_fail(struct ensemble *ensemble, fbd_outcome outcome, const char *reason)
{
    if (ensemble->outcome != FBD_GOING && ensemble->outcome != FBD_DONE) return;
    ensemble->outcome = outcome;
    ensemble->reason = reason;
}

void ensemble_spoil(struct ensemble *ensemble, const char *format, ...)
{
    if (ensemble->outcome == FBD_FAILED || ensemble->outcome == FBD_OUT_OF_MEMORY) return;
    va_list args;
    va_start(args, format);
    /* NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): it is, a line above */
    vsnprintf(ensemble->own_reason, sizeof ensemble->own_reason, format, args);
    va_end(args);
    ensemble->outcome = FBD_FAILED;
    ensemble->reason = ensemble->own_reason;
}

/* ---- the log of events */

static int group_body(const struct group *group, int index)
{
    return index < 0 || !group->selection ? index : group->selection->bodies[index];
}

int group_load(const struct group *group, int index)
{
    return index < 0 || !group->selection ? index : group->selection->loads[index];
}

static bool add_event(struct ensemble *ensemble, const struct run_event *event)
{
    if (ensemble->event_count == ensemble->event_room) {
        size_t room = ensemble->event_room ? 2 * ensemble->event_room : 16;
        struct run_event *events = realloc(ensemble->events, room * sizeof *events);
        if (!events) return false;
        ensemble->events = events;
        ensemble->event_room = room;
    }
    ensemble->events[ensemble->event_count++] = *event;
    return true;
}

static int by_time(const void *a, const void *b)
{
    const struct run_event *first = a, *second = b;
    if (first->t != second->t) return first->t < second->t ? -1 : 1;
    if (first->group != second->group) return first->group < second->group ? -1 : 1;
    return first->order < second->order ? -1 : 1;
}

void ensemble_release(struct ensemble *ensemble, size_t count)
{
    size_t before = ensemble->event_count;
    for (size_t i = 0; i < count; i++) {
        struct group *group = &ensemble->groups[ensemble->due[i]];
        const struct run *run = group->run;
        for (; run && group->released < run->log.count && run->log.events[group->released].t <= ensemble->t;
             group->released++) {
            struct run_event event = run->log.events[group->released];
            event.body = group_body(group, event.body);
            event.load = group_load(group, event.load);
            if (event.watch >= 0 && group->selection) event.watch = group->selection->events[event.watch];
            event.group = ensemble->due[i];
            event.order = group->released;
            if (!add_event(ensemble, &event)) {
                ensemble_fail(ensemble, FBD_OUT_OF_MEMORY, "out of memory");
                return;
            }
        }
    }
    if (count > 1 && ensemble->event_count > before)
        qsort(ensemble->events + before, ensemble->event_count - before, sizeof *ensemble->events, by_time);
}

/* ---- states within steps */

struct fbd_state *ensemble_probe(struct ensemble *ensemble, struct group *group)
{
    if (!group->probe) group->probe = state_make(group->model, NULL, &group->memory);
    if (!group->probe) ensemble_fail(ensemble, FBD_OUT_OF_MEMORY, "out of memory");
    return group->probe;
}

typedef bool look_at_run(struct run *run, double t, struct fbd_state *state);

static bool look_at_end(struct run *run, struct fbd_state *state)
{
    state_copy(state, run->state);
    state_evaluate(state);
    return true;
}

static bool look_run(struct run *run, double t, struct fbd_state *state)
{
    if (t == run->state->t) return look_at_end(run, state);
    return t >= run->step.from && t < run->state->t && run_look(run, time_dd_at(t), state);
}

static bool place_run(struct run *run, double t, struct fbd_state *state)
{
    if (t != run->state->t)
        return t >= run->step.from && t < run->state->t && run_place(run, time_dd_at(t), state);
    state_copy(state, run->state);
    return true;
}

/* The double nearest to the end of a step stands for the end, including its low part. */
static bool look_run_before(struct run *run, double t, struct fbd_state *state)
{
    return run_look(run, t == run->state->t ? run_end(run) : time_dd_at(t), state);
}

struct fbd_state *ensemble_look_group(struct ensemble *ensemble, size_t index, struct time_dd t, bool forces)
{
    struct group *group = &ensemble->groups[index];
    struct run *run = group->run;
    bool at_end = time_dd_equal(t, run_end(run)), within = t.t >= run->step.from && t.t <= run->state->t;
    if (!ensemble_probe(ensemble, group)) return NULL;
    if (!forces && within) {
        state_set_moment(group->probe, t);
        if (group->model->tree->ends) state_copy_lives(group->probe, run->during);
        return run_coordinates(run, t, group->probe->y) ? group->probe : NULL;
    }
    bool seen = at_end ? look_at_end(run, group->probe) : within && run_look(run, t, group->probe);
    return seen ? group->probe : NULL;
}

/* Copy coordinates and rates of an island to the whole. */
static void scatter_coordinates(const struct fbd_model *whole, const struct group *group, const double *part,
                                double *y)
{
    for (size_t b = 0; b < group->model->body_count; b++) {
        const struct model_body *from = &group->model->bodies[b];
        const struct model_body *to = &whole->bodies[group_body(group, (int)b)];
        for (int k = 0; k < from->count; k++) {
            y[to->first + k] = part[from->first + k];
            y[to->first_rate + k] = part[from->first_rate + k];
        }
    }
}

bool ensemble_group_coordinates(struct ensemble *ensemble, size_t group, struct time_dd t, double *y)
{
    if (!ensemble_look_group(ensemble, group, t, false)) return false;
    scatter_coordinates(ensemble->model, &ensemble->groups[group], ensemble->groups[group].probe->y, y);
    return true;
}

/* Those of an island whose run is freed. */
static void copy_coordinates(const struct ensemble *ensemble, const struct group *group, double *y)
{
    const double *from = ensemble->state->y;
    for (size_t i = 0; i < group->selection->body_count; i++) {
        const struct model_body *body = &ensemble->model->bodies[group->selection->bodies[i]];
        const size_t size = (size_t)body->count * sizeof *y;
        memmove(y + body->first, from + body->first, size);
        memmove(y + body->first_rate, from + body->first_rate, size);
    }
}

void ensemble_free_run(struct ensemble *ensemble, struct group *group)
{
    const struct run *run = group->run;
    if (!ensemble_frees_runs(ensemble) || !run->plain || run->log.count > 0 || *run->end.reason) return;
    group->past = run_totals(group->run);
    scatter_coordinates(ensemble->model, group, run->state->y, ensemble->state->y);
    free_run(group);
}

/* Copy the Filippov sliding modes of an island, with the kinks of the whole and separate surfaces. */
static void scatter_slides(const struct group *group, const struct fbd_state *part, struct fbd_state *state)
{
    if (!part->sliding || !state->sliding) return;
    const struct plan *whole = &state->model->plan;
    struct sliding *to = state->sliding;
    for (int i = 0; i < group->model->plan.branches; i++) to->slide_at[group_branch(group, i)] = 0;
    sliding_drop(to);
    int units = to->units;
    for (int j = 0; j < part->sliding->count; j++) {
        const struct slide *slide = &part->sliding->slides[j];
        int branch = group_branch(group, slide->branch), kink = 0;
        while (whole->kinks[kink].formula.branch + (int)whole->kinks[kink].count <= branch) kink++;
        sliding_add(to, &whole->kinks[kink], kink, branch - whole->kinks[kink].formula.branch,
                    units + slide->unit, slide->sign);
        to->slides[to->count - 1].slack = slide->slack;
    }
}

static void scatter_modes(const struct group *group, const struct fbd_state *part, struct fbd_state *state)
{
    const struct plan *plan = &group->model->plan;
    for (int i = 0; i < plan->branches; i++) state->branch[group_branch(group, i)] = part->branch[i];
    scatter_slides(group, part, state);
    for (size_t i = 0; i < plan->mode_count; i++) {
        size_t pair = group->selection ? (size_t)group->selection->modes[i] : i;
        state->slip[pair] = part->slip[i];
        state->pull[pair] = part->pull[i];
        if (plan->modes[i].kind == mode_contact) /* its feature */
            state->tree->couplings[state->model->plan.modes[pair].coupling] =
                part->tree->couplings[plan->modes[i].coupling];
    }
}

/* The forces and couplings that have begun or ended, with the references of couplings that begin. Those of one constraint
 * are successive, here and in the whole. */
static void scatter_ends(const struct group *group, const struct fbd_state *part, struct fbd_state *state)
{
    const struct tree *tree = group->model->tree, *whole = state->model->tree;
    for (size_t i = 0; whole->ends && i < group->model->plan.watch_count; i++) {
        const int lifetime = group->model->plan.watches[i].source->lifetime;
        if (lifetime > 0) state->tree->life[lifetime - 1] = part->tree->life[lifetime - 1];
    }
    for (int i = 0, k = 0; whole->ends && i < tree->coupling_count; i++) {
        const int local = tree->couplings[i].constraint;
        const int constraint = group->selection ? group->selection->constraints[local] : local;
        if (i == 0 || tree->couplings[i - 1].constraint != local) k = 0;
        while (whole->couplings[k].constraint != constraint) k++;
        if (tree->couplings[i].source->lifetime.begins) state->tree->couplings[k] = part->tree->couplings[i];
        k++;
    }
}

/* Copy the state of an island to that of the whole. */
static void scatter(const struct fbd_model *whole, const struct group *group, struct fbd_state *state)
{
    scatter_coordinates(whole, group, group->probe->y, state->y);
    scatter_modes(group, group->probe, state);
    scatter_ends(group, group->probe, state);
}

static bool run_covers(const struct run *run, double t)
{
    return t == run->state->t || (t >= run->step.from && t < run->state->t);
}

static bool coordinates_of(struct run *run, double t, double *y)
{
    return run_coordinates(run, t == run->state->t ? run_end(run) : time_dd_at(t), y);
}

bool ensemble_coordinates(struct ensemble *ensemble, double t, double *y)
{
    for (size_t p = 0; p < ensemble->count; p++) {
        struct group *group = &ensemble->groups[p];
        double *part = y;
        if (ensemble->count > 1) part = ensemble_probe(ensemble, group) ? group->probe->y : NULL;
        if (!part || !run_covers(group->run, t) || !coordinates_of(group->run, t, part)) return false;
        if (ensemble->count > 1) scatter_coordinates(ensemble->model, group, part, y);
    }
    return true;
}

size_t group_component(const struct fbd_model *whole, const struct group *group, size_t i)
{
    if (!group->selection) return i;
    size_t n = (size_t)group->model->plan.n, q = i % n;
    int b = group->model->scene->coordinates[q].body;
    const struct model_body *from = &group->model->bodies[b];
    const struct model_body *to = &whole->bodies[group_body(group, b)];
    return (size_t)(i < n ? to->first : to->first_rate) + q - (size_t)from->first;
}

void ensemble_pass_on(const struct ensemble *ensemble, size_t index, struct fbd_state *state)
{
    const struct group *group = &ensemble->groups[index];
    const struct run *run = group->run;
    for (size_t i = 0; i < plan_size(&group->model->plan); i++)
        state->y[group_component(ensemble->model, group, i)] += run->state->y[i] - run->work.y[i];
    scatter_modes(group, run->state, state);
    scatter_ends(group, run->state, state);
}

/* Place the state of each run, and that of the whole. */
static bool place(struct ensemble *ensemble, double t, look_at_run *look_at, struct fbd_state *state)
{
    if (ensemble->count == 1) return look_at(ensemble->groups[0].run, t, state);
    for (size_t p = 0; p < ensemble->count; p++) {
        struct group *group = &ensemble->groups[p];
        if (!group->run) {
            if (group->past.t != t) return false;
            copy_coordinates(ensemble, group, state->y);
            continue;
        }
        if (!ensemble_probe(ensemble, group) || !look_at(group->run, t, group->probe)) return false;
        scatter(ensemble->model, group, state);
    }
    state_set_moment(state, time_dd_at(t));
    state->settled = true;
    return true;
}

static bool look(struct ensemble *ensemble, double t, look_at_run *look_at, struct fbd_state *state)
{
    if (!place(ensemble, t, look_at, state)) return false;
    if (ensemble->count > 1) state_evaluate(state);
    return true;
}

bool ensemble_look(struct ensemble *ensemble, double t, struct fbd_state *state)
{
    return look(ensemble, t, look_run, state);
}

bool ensemble_look_before(struct ensemble *ensemble, double t, struct fbd_state *state)
{
    return look(ensemble, t, look_run_before, state);
}

const struct fbd_state *ensemble_placed(struct ensemble *ensemble)
{
    if (!ensemble->current) place(ensemble, ensemble->t, place_run, ensemble->state);
    return ensemble->state;
}

struct fbd_state *ensemble_state(struct ensemble *ensemble)
{
    if (!ensemble->current) {
        ensemble_rewind(ensemble, ensemble->t);
        ensemble_look(ensemble, ensemble->t, ensemble->state);
    }
    ensemble->current = true;
    return ensemble->state;
}

void ensemble_check_balance(struct ensemble *ensemble)
{
    struct text lack = {0};
    bool lacks = balance_lack(ensemble_state(ensemble), &lack);
    if (lack.failed)
        ensemble_fail(ensemble, FBD_OUT_OF_MEMORY, "out of memory");
    else if (lacks)
        ensemble_spoil(ensemble, "%s", lack.data);
    text_free(&lack);
}
