/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/state.h"

#include "base/block_alloc.h"
#include "dynamics/diagram.h"
#include "dynamics/rest_memo.h"
#include "dynamics/tree_system.h"
#include "dynamics/world_refs.h"
#include "numeric/tolerances.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t coupling_bytes(const struct fbd_model *model)
{
    return (size_t)model->tree->coupling_count * sizeof(struct coupling_state);
}

static size_t scratch_size(const struct plan *plan)
{
    return 2 * (size_t)plan->slots + 3 * (size_t)plan->n + 2 * (size_t)plan->own;
}

struct fbd_state *state_allocate(const struct fbd_model *model, struct arena *memory)
{
    const struct plan *plan = &model->plan;
    size_t rates = plan_rates(plan), extended = extended_size(model);
    size_t extra = model->absolute_count > 0 ? 2 * extended : 0;
    size_t held = scene_holds_inputs(model->scene) ? model->scene->parameter_count : 0;
    size_t doubles = extended + rates + (size_t)plan->slots + held + scratch_size(plan) + extra;
    size_t ints = 2 * (size_t)plan->branches + 8 * plan->mode_count;
    size_t tree = sizeof(struct tree_work) + tree_work_size(model);
    size_t sliding = plan->slide_count > 0 ? sizeof(struct sliding) + sliding_size(model) : 0;
    size_t arrows = diagram_most_arrows(model) * sizeof(struct arrow);
    size_t bytes =
        sizeof(struct fbd_state) + tree + sliding + arrows + doubles * sizeof(double) + ints * sizeof(int);
    struct fbd_state *state = memory ? arena_array(memory, 1, bytes) : block_alloc(bytes);
    if (!state) return NULL;
    state->in_arena = memory != NULL;
    state->model = model;
    char *behind = (char *)(state + 1);
    state->tree = (void *)behind;
    tree_work_init(state->tree, model, behind + sizeof *state->tree);
    if (sliding > 0) {
        state->sliding = (void *)(behind + tree);
        sliding_init(state->sliding, model, behind + tree + sizeof *state->sliding);
    }
    state->arrows = (void *)(behind + tree + sliding);
    state->y = (void *)(behind + tree + sliding + arrows);
    state->a = state->y + extended;
    state->slots = state->a + rates;
    state->held = held > 0 ? state->slots + plan->slots : NULL;
    for (size_t i = 0; i < held; i++) state->held[i] = model->scene->parameters[i].value;
    state->scratch = state->slots + plan->slots + held;
    state->extended = extra > 0 ? state->scratch + scratch_size(plan) : NULL;
    void *behind_doubles = state->scratch + scratch_size(plan) + extra; /* aligned for an int as well */
    state->branch = behind_doubles;
    state->slip = state->branch + plan->branches;
    state->pull = state->slip + plan->mode_count;
    state->slip_driven = state->pull + plan->mode_count;
    state->branch_before = state->slip_driven + plan->mode_count;
    state->slip_before = state->branch_before + plan->branches;
    state->slip_forced = state->slip_before + plan->mode_count;
    state->slip_barely = state->slip_forced + plan->mode_count;
    state->slip_idle = state->slip_barely + plan->mode_count;
    state->slip_rests = state->slip_idle + plan->mode_count;
    for (size_t i = 0; i < plan->mode_count; i++) state->pull[i] = 1;
    return state;
}

struct arena state_lend(struct fbd_state *state)
{
    struct arena lent = state->kept;
    state->kept = (struct arena){0};
    return lent;
}

void state_take_back(struct fbd_state *state, struct arena *arena)
{
    if (arena->failed) state->holds.found = holds_no_memory;
    arena_free(&state->kept); /* of a look within the look */
    arena_empty(arena);
    state->kept = *arena;
}

void state_free(struct fbd_state *state)
{
    if (!state) return;
    arena_free(&state->kept);
    rest_memo_free(state->tree->memo);
    if (!state->in_arena) free(state);
}

void state_copy_lives(struct fbd_state *to, const struct fbd_state *from)
{
    memcpy(to->tree->life, from->tree->life,
           (size_t)from->model->scene->lifetime_count * sizeof *from->tree->life);
}

void state_let_forces_act(struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    for (size_t i = 0; i < model->load_count; i++) {
        const int lifetime = model->loads[i].source->lifetime.number;
        if (lifetime > 0) state->tree->life[lifetime - 1] = life_there;
    }
    state->settled = false;
}

void state_copy(struct fbd_state *to, const struct fbd_state *from)
{
    const struct plan *plan = &from->model->plan;
    size_t modes = (size_t)plan->branches + 3 * plan->mode_count; /* branch, slip, pull and slip_driven */
    state_set_moment(to, state_moment(from));
    to->settled = from->settled;
    to->degrees = from->degrees;
    memcpy(to->y, from->y, (size_t)(from->scratch - from->y) * sizeof *to->y); /* with a, slots, held */
    if (modes > 0) memcpy(to->branch, from->branch, modes * sizeof *to->branch);
    if (to->sliding) sliding_copy(from->model, to->sliding, from->sliding);
    if (from->model->scene->lifetime_count > 0) state_copy_lives(to, from);
    if (from->model->tree->coupling_count > 0)
        memcpy(to->tree->couplings, from->tree->couplings, coupling_bytes(from->model));
}

void state_still(struct fbd_state *state, double until)
{
    size_t n = (size_t)state->model->plan.n;
    /* The time that is left may be zero, or a rounding of the time. */
    const double duration = fmax(fabs(state->t), fabs(until));
    if (duration == 0) return;
    const struct coordinate *coordinates = state->model->scene->coordinates;
    double size[2] = {0, 1}; /* of lengths, and of angles */
    for (size_t i = 0; i < n; i++) {
        double *most = &size[coordinates[i].angle];
        *most = fmax(*most, fabs(state->y[i]));
    }
    for (size_t i = 0; i < n; i++)
        if (fabs(state->y[n + i]) * duration < round_off(1, size[coordinates[i].angle])) state->y[n + i] = 0;
}
