/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "dynamics/forward.h"
#include "dynamics/friction.h"
#include "dynamics/modes.h"
#include "dynamics/plane_friction.h"
#include "dynamics/state.h"
#include "dynamics/tree_system.h"
#include "numeric/disc_forces.h"
#include "numeric/tolerances.h"

/* The points at rest relative to their planes, without their forces. */
struct at_rest {
    struct fbd_state *state;
    struct instant at; /* with all of them loose */
    int count;
    int *pair;                   /* count */
    double *radius, *b, *W;      /* count: c; 2 count; its square */
    struct disc_problem problem; /* with these; forces along e and k x e */
};

/* ---- the problem */

static const struct coupling *coupling_of(const struct at_rest *rest, int i)
{
    const struct mode *mode = mode_of(rest->state, rest->pair[i]);
    return &rest->state->model->tree->couplings[mode->coupling];
}

/* Does it slip already? */
static bool moves(const struct fbd_state *state, const struct decided *decided, int pair)
{
    const int index = mode_of(state, pair)->coupling;
    const struct instant at = state_instant(state);
    if (friction_is_never(mode_of(state, pair))) return true;
    if (decided && (state->slip[pair] == stick || state->slip_rests[pair])) return false;
    if (decided && state->tree->couplings[index].gently) return true;
    return plane_speed(state->model, state->tree, index).slip >
           coupling_slip_rounding(state->model, &at, index);
}

/* Let it slip in the direction of its velocity, or on in that of its start; true when its force stays as it is. */
static bool follow(struct fbd_state *state, const struct decided *decided, int pair)
{
    const int index = mode_of(state, pair)->coupling;
    const struct vec before = state->tree->couplings[index].e;
    const bool same = state->slip[pair] == slip_plus;
    const struct instant at = state_instant(state);
    const bool slow =
        plane_speed(state->model, state->tree, index).slip <= state->tree->couplings[index].slow;
    if (decided && same && slow) return true;
    state->slip[pair] = slip_plus;
    plane_aim(state->model, &at, index);
    return same && vec_norm(vec_sub(before, state->tree->couplings[index].e)) <= negligible_sum;
}

static bool make_room(struct at_rest *rest, struct arena *arena)
{
    const size_t pairs = rest->state->model->plan.mode_count, count = (size_t)rest->count;
    rest->radius = ARENA_ARRAY(arena, count, double);
    rest->b = ARENA_ARRAY(arena, 2 * count, double);
    rest->W = ARENA_ARRAY(arena, 4 * count * count, double);
    rest->problem = (struct disc_problem){
        .count = count,
        .W = rest->W,
        .b = rest->b,
        .c = rest->radius,
        .f = ARENA_ARRAY(arena, count, struct vec),
        .slips = ARENA_ARRAY(arena, count, bool),
        .room = ARENA_ARRAY(arena, disc_forces_room(count), double),
        .pivot = ARENA_ARRAY(arena, 2 * count, size_t),
    };
    int *trial = ARENA_ARRAY(arena, pairs, int);
    if (arena->failed) return false;
    memcpy(trial, rest->state->slip, pairs * sizeof *trial);
    for (int i = 0; i < rest->count; i++) trial[rest->pair[i]] = loose;
    rest->at.slip = trial;
    return true;
}

/* Accelerations without the forces. */
static void set_free(struct at_rest *rest)
{
    struct fbd_state *state = rest->state;
    accelerations(state->model, &rest->at, state->scratch, state->a);
    for (int i = 0; i < rest->count; i++)
        for (int k = 0; k < 2; k++)
            rest->b[2 * i + k] = state->tree->rows[coupling_of(rest, i)->first_row + k].g.x2;
}

static void add_answers(struct at_rest *rest, int column)
{
    const int size = 2 * rest->count;
    for (int i = 0; i < size; i++)
        rest->W[i * size + column] +=
            tree_row_answer(rest->state->tree, coupling_of(rest, i / 2)->first_row + i % 2);
}

/* Accelerations by a unit force. */
static void add_column(struct at_rest *rest, int column)
{
    const struct fbd_model *model = rest->state->model;
    const struct tree *tree = model->tree;
    struct tree_work *work = rest->state->tree;
    memset(work->x, 0, (size_t)tree->count * sizeof *work->x);
    row_apply(&work->rows[coupling_of(rest, column / 2)->first_row + column % 2], 1, work->x);
    tree_inward(tree, work, 1, tree->count);
    tree_outward(tree, work, 1, tree->count, work->unit);
    add_answers(rest, column);
    for (int j = 0; j < tree_unknowns(tree); j++)
        work->z[j] = j < tree->row_count ? -tree_row_answer(work, j) : 0;
    tree_want_massless(tree, work, work->unit, work->z);
    tree_system_solve(model, &rest->at, work->z);
    add_answers(rest, column);
}

/* ---- its solution */

/* Points that are at their limit slip with kinetic friction, by which others may exceed theirs. */
static void solve(struct at_rest *rest, const struct decided *decided)
{
    bool more = true;
    for (int round = 0; more && round <= rest->count; round++) {
        more = false;
        disc_forces_find(&rest->problem);
        for (int i = 0; i < rest->count; i++) {
            const int pair = rest->pair[i];
            const double kinetic =
                friction_coefficient(rest->state->model, pair, &mode_of(rest->state, pair)->mu_k, &rest->at,
                                     NULL, NULL);
            const bool breaks = rest->problem.slips[i] || (decided && decided->slips[pair]);
            if (!breaks || !(kinetic < rest->radius[i])) continue;
            rest->radius[i] = fmax(0, kinetic);
            more = true;
        }
    }
}

/* ---- modes */

static void set_radii(struct at_rest *rest)
{
    for (int i = 0; i < rest->count; i++)
        rest->radius[i] = friction_at(rest->state->model, rest->pair[i], &rest->at, rest->state->slots).limit;
}

void plane_set_out(struct fbd_state *state, int pair, struct vec along, bool gently)
{
    const struct instant at = state_instant(state);
    const int index = mode_of(state, pair)->coupling;
    const struct vec e = state->tree->couplings[index].e;
    if (vec_norm(along) > 0)
        plane_begin(state->model, &at, index, vec_turn(e, vec_scale(1 / vec_norm(along), along)));
    struct coupling_state *starts = &state->tree->couplings[index];
    starts->nu =
        fmax(starts->soft, state->tree->tolerance * plane_speed(state->model, state->tree, index).size);
    starts->gently = gently;
}

/* The acceleration of point i by its own force. */
static struct vec own_acceleration(const struct at_rest *rest, int i)
{
    const size_t size = 2 * rest->problem.count;
    const double *W = rest->W + 2 * (size_t)i * (size + 1);
    const struct vec f = rest->problem.f[i];
    return (struct vec){W[0] * f.x + W[1] * f.y, W[size] * f.x + W[size + 1] * f.y};
}

/* Set the mode and direction of point i; true when the mode stays. */
static bool set_mode(struct at_rest *rest, int i, const struct decided *decided)
{
    struct fbd_state *state = rest->state;
    const int pair = rest->pair[i], before = state->slip[pair];
    const struct vec by_others = disc_forces_by_others(&rest->problem, (size_t)i),
                     a = vec_add(by_others, own_acceleration(rest, i));
    const bool gently = vec_norm(a) <= distinct_part * vec_norm(by_others);
    const struct vec way = !gently ? a : vec_scale(-1, rest->problem.f[i]);
    const bool slips = rest->problem.slips[i] || (decided && decided->slips[pair]);
    state->slip[pair] = slips ? slip_plus : stick;
    if (slips) plane_set_out(state, pair, way, gently);
    return state->slip[pair] == before;
}

static bool settle_at_rest(struct at_rest *rest, const struct decided *decided, struct arena *arena)
{
    bool same = true;
    if (!make_room(rest, arena)) {
        rest->state->holds.found = holds_no_memory;
        return true;
    }
    set_radii(rest);
    set_free(rest);
    for (int k = 0; k < 2 * rest->count; k++) add_column(rest, k);
    solve(rest, decided);
    for (int i = 0; i < rest->count; i++) same &= set_mode(rest, i, decided);
    return same;
}

bool planes_settle(struct fbd_state *state, const struct decided *decided)
{
    struct arena arena = state_lend(state);
    struct at_rest rest = {.state = state, .at = state_instant(state)};
    bool same = true;
    rest.pair = ARENA_ARRAY(&arena, state->model->plan.mode_count, int);
    if (!rest.pair) state->holds.found = holds_no_memory;
    for (int pair = 0; rest.pair && pair < (int)state->model->plan.mode_count; pair++) {
        if (mode_of(state, pair)->kind != mode_plane) continue;
        if (decided && decided->aims[pair]) continue;
        if (!mode_has_ended(state, pair) && !moves(state, decided, pair)) {
            rest.pair[rest.count++] = pair;
            continue;
        }
        same &= follow(state, decided, pair);
    }
    if (rest.count > 0) same &= settle_at_rest(&rest, decided, &arena);
    state_take_back(state, &arena);
    if (rest.count > 0 && same) state_evaluate(state);
    return same;
}

void planes_aim(struct fbd_state *state)
{
    const struct instant at = state_instant(state);
    tree_move(state->model, &at);
    for (int i = 0; i < state->model->tree->coupling_count; i++)
        if (state->model->tree->couplings[i].kind == constraint_plane) plane_aim(state->model, &at, i);
}

void plane_unstick(struct fbd_state *state, int pair)
{
    const int index = mode_of(state, pair)->coupling;
    const struct instant at = state_instant(state);
    const double slip = plane_speed(state->model, state->tree, index).slip;
    if (state->slip[pair] != stick || slip <= coupling_slip_rounding(state->model, &at, index)) return;
    plane_aim(state->model, &at, index);
    state->slip[pair] = slip_plus;
}

static bool sets_out(const struct fbd_state *state, int index)
{
    const struct coupling *coupling = &state->model->tree->couplings[index];
    return coupling->kind == constraint_plane && state->slip[coupling->pair] != stick &&
           !coupling_is_gone(state->tree, coupling) &&
           plane_speed(state->model, state->tree, index).slip <= state->tree->couplings[index].slow;
}

bool planes_set_out(struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    bool any = false;
    for (int i = 0; i < tree->coupling_count; i++) {
        any |= sets_out(state, i) && state->tree->couplings[i].gently;
        for (int j = 0; j < i; j++)
            any |= planes_are_one(tree, i, j) && sets_out(state, i) && sets_out(state, j);
    }
    return any;
}
