/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/tree_gather.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/journals.h"
#include "dynamics/modes.h"
#include "dynamics/tree_driven.h"
#include "dynamics/tree_system.h"
#include "numeric/tolerances.h"

/* ---- the constraints to be decided */

/* Is the surface of the friction, if it has one, closed or to be decided? */
static bool is_on_surface(const struct fbd_state *state, const struct decided *decided, const int *forced,
                          const struct mode *mode)
{
    if (mode->coupling < 0) return true;
    int surface = state->model->tree->couplings[mode->coupling].surface;
    struct instant at = state_instant(state);
    if (surface >= 0 && (forced[surface] || (decided && decided->slips[surface])) &&
        state->slip[surface] != stick)
        return false;
    if (surface >= 0 && mode_of(state, surface)->kind == mode_contact)
        return state->tree->couplings[mode->coupling].feature != no_feature;
    return surface < 0 || state->slip[surface] == stick || one_sided_at(state->model, &at, surface).touches;
}

bool hold_in_question(const struct fbd_state *state, const struct decided *decided, const int *forced,
                      int pair)
{
    const struct mode *hold = mode_of(state, pair);
    struct instant at = state_instant(state);
    if (hold->kind == mode_single || hold->kind == mode_plane || hold->kind == mode_drive) return false;
    if (friction_is_never(hold) || mode_has_ended(state, pair)) return false;
    if (mode_is_friction(hold)) return is_on_surface(state, decided, forced, hold);
    if (forced[pair] || (decided && decided->slips[pair])) return false;
    if (hold->kind == mode_contact) return state->tree->couplings[hold->coupling].feature != no_feature;
    struct one_sided now = one_sided_at(state->model, &at, pair);
    return now.touches || (state->slip[pair] == stick && (decided || !(now.parts || now.meets)));
}

int hold_slips_already(const struct fbd_state *state, const struct decided *decided, const int *forced,
                       int pair)
{
    if (forced[pair]) return forced[pair] == keeps_still ? 0 : forced[pair];
    if (decided && decided->slips[pair]) return state->slip[pair];
    double v = settling_velocity(state, decided, pair);
    int aside = state->sliding ? state->sliding->aside[pair] : 0;
    return v > 0 ? 1 : v < 0 ? -1 : aside;
}

/* ---- a unit force along a constraint, and the response */

static void apply_unit(struct fbd_state *state, int pair)
{
    const struct mode *hold = mode_of(state, pair);
    memset(state->tree->x, 0, (size_t)state->model->tree->count * sizeof *state->tree->x);
    if (hold->coupling >= 0)
        row_apply(hold_row(state, hold), hold_sign(hold), state->tree->x);
    else
        state->tree->x[link_of(state, pair)].g = 1;
}

/* The reactions of guide g, if it is a journal. */
static struct vec *reactions_of(const struct gathered *all, size_t g)
{
    const struct mode *mode = mode_of(all->state, all->guide[g]);
    return all->reactions && mode->moment ? all->reactions + g * (all->problem.count + 1) : NULL;
}

static void add_reactions(struct gathered *all, size_t k)
{
    for (size_t g = 0; g < all->problem.guide_count; g++) {
        struct vec *reactions = reactions_of(all, g);
        if (!reactions) continue;
        const int i = link_of(all->state, all->guide[g]);
        const struct tree_rhs *x = &all->state->tree->x[i];
        const struct wrench F = inertia_wrench(&all->state->tree->links[i].I, x->A, x->p);
        reactions[1 + k] = vec_add(reactions[1 + k], F.force);
    }
}

/* Add to column k the response in work->x and work->unit: accelerations along the constraints and normal
 * forces of the guides. */
static void add_answers(struct gathered *all, size_t k)
{
    struct fbd_state *state = all->state;
    const struct tree *tree = state->model->tree;
    size_t count = all->problem.count;
    if (all->shares.units > 0) tree_add_unit(tree, state->tree, state->sliding->flow + state->model->plan.n);
    for (size_t i = 0; i < count; i++) {
        const struct mode *hold = mode_of(state, all->pair[i]);
        all->problem.A[i * count + k] +=
            hold->coupling < 0
                ? state->tree->unit[hold->coordinate]
                : hold_sign(hold) *
                      tree_row_answer(state->tree, (int)(hold_row(state, hold) - state->tree->rows));
    }
    for (size_t g = 0; g < all->problem.guide_count; g++)
        if (mode_of(state, all->guide[g])->coupling < 0)
            all->problem.B[g * count + k] += tree_normal_in(tree, state->tree, link_of(state, all->guide[g]));
    if (all->reactions) add_reactions(all, k);
}

/* The relative response below which the couplings make a constraint immovable: it moves by rounding only. */
static const double immovable = negligible_sum;

static void hold_still(struct gathered *all, size_t k)
{
    struct fbd_state *state = all->state;
    const struct mode *hold = mode_of(state, all->pair[k]);
    struct hold *still = &all->problem.holds[k];
    size_t count = all->problem.count;
    double surface, driven = tree_driven(state, all->trial, all->pair[k]);
    /* The momentum of a mechanism moves it through its dead centre. */
    if (driven == 0 && mode_is_friction(hold) && tree_seen_acceleration(state, still->free))
        driven = still->free;
    if (driven == 0 && mode_is_friction(hold)) {
        driven = tree_sets_out(state, all->trial, all->pair[k]);
        if (driven != 0) all->still[k] = still_sets_out;
    }
    still->free = still->kind == hold_one_sided ? driven : 0;
    for (size_t i = 0; i < count; i++) all->problem.A[i * count + k] = all->problem.A[k * count + i] = 0;
    if (driven != 0) still->slip = driven > 0 ? 1 : -1;
    if (driven != 0 && mode_is_friction(hold))
        all->forced[all->pair[k]] = state->slip_driven[all->pair[k]] = still->slip;
    if (hold->moving || driven != 0) return; /* the rest is for immovable friction */
    still->slip = 0;
    if (all->forced[all->pair[k]] == 0) all->forced[all->pair[k]] = keeps_still;
    if (mode_is_joint_friction(hold))
        state->y[state->model->plan.n + hold->coordinate] = friction_surface_speed(hold, &all->at, &surface);
}

/* A lower bound of the response to a unit force between two points of the links [m/s^2], except in a dead
 * centre: 1 over the total mass. */
static double least_answer(const struct fbd_state *state, int pair)
{
    double mass = 0;
    const struct mode *mode = mode_of(state, pair);
    if (mode->kind != mode_tangent ||
        state->model->tree->couplings[mode->coupling].kind == constraint_resistance)
        return 0;
    for (int i = 1; i < state->model->tree->count; i++) mass += fabs(state->tree->links[i].mass);
    return mass > 0 ? 1 / mass : 0;
}

/* Add the responses of the links and of the couplings to a unit force. True when the couplings make the
 * constraint immovable. */
static bool answers_alone(struct gathered *all, size_t k)
{
    struct fbd_state *state = all->state;
    const struct tree *tree = state->model->tree;
    struct tree_work *work = state->tree;
    apply_unit(state, all->pair[k]);
    tree_inward(tree, work, 1, tree->count);
    tree_outward(tree, work, 1, tree->count, work->unit);
    add_answers(all, k);
    double alone = fmax(all->problem.A[k * all->problem.count + k], least_answer(state, all->pair[k]));
    if (tree->coupling_count == 0 && !tree_lacks_inertia(tree, work)) return false;
    for (int j = 0; j < tree_unknowns(tree); j++)
        work->z[j] = j < tree->row_count ? -tree_row_answer(work, j) : 0;
    tree_want_massless(tree, work, work->unit, work->z);
    tree_system_solve(state->model, &all->at, work->z);
    add_answers(all, k);
    for (size_t g = 0; g < all->problem.guide_count; g++) { /* of a slot: the multiplier of its normal row */
        const int coupling = mode_of(state, all->guide[g])->coupling;
        if (coupling >= 0)
            all->problem.B[g * all->problem.count + k] = work->z[tree->couplings[coupling].normal_row];
    }
    return all->problem.A[k * all->problem.count + k] <= immovable * alone;
}

/* The same, with the rates of the surfaces of sliding modes. */
static bool add_column(struct gathered *all, size_t k)
{
    struct sliding *s = all->state->sliding;
    const struct shared_out *shares = &all->shares;
    if (shares->units == 0) return answers_alone(all, k);
    memset(s->flow, 0, plan_size(&all->state->model->plan) * sizeof *s->flow);
    bool still = answers_alone(all, k);
    sliding_rates(all->state->model, &all->at, 0, s->flow, shares->rates + k * (size_t)shares->units);
    return still;
}

/* Along constraint i and at guide g, by the last accelerations and forces. */
static double hold_answer(const struct gathered *all, size_t i)
{
    return tree_hold_acceleration(all->state, &all->at, all->pair[i]);
}

static double guide_answer(const struct gathered *all, size_t g)
{
    return -all->state->scratch[mode_of(all->state, all->guide[g])->normal_slot];
}

/* The response to the weight of a unit. */
static void find_share_answers(struct gathered *all, int unit)
{
    struct fbd_state *state = all->state;
    const struct hold_problem *problem = &all->problem;
    double *c = all->shares.c + (size_t)unit * problem->count,
           *N = all->shares.N + (size_t)unit * problem->guide_count;
    sliding_shift(state->sliding, unit, 1);
    accelerations_at_shares(state->model, &all->at, state->scratch, state->a);
    sliding_shift(state->sliding, unit, -1);
    for (size_t i = 0; i < problem->count; i++) c[i] = hold_answer(all, i) - problem->holds[i].free;
    for (size_t g = 0; g < problem->guide_count; g++) N[g] = guide_answer(all, g) - problem->guides[g].free;
}

/* Without forces of the constraints. */
static void set_free(struct gathered *all)
{
    struct fbd_state *state = all->state;
    accelerations(state->model, &all->at, state->scratch, state->a);
    for (size_t i = 0; i < all->problem.count; i++) all->problem.holds[i].free = hold_answer(all, i);
    for (size_t g = 0; g < all->problem.guide_count; g++) {
        struct vec *reactions = reactions_of(all, g);
        all->problem.guides[g].free = guide_answer(all, g);
        if (reactions) reactions[0] = state->tree->links[link_of(state, all->guide[g])].F.force;
    }
    if (all->shares.units == 0) return;
    if (state->sliding->failed) all->shares.units = 0;
    for (int unit = 0; unit < all->shares.units; unit++) find_share_answers(all, unit);
    accelerations_at_shares(state->model, &all->at, state->scratch, state->a);
}

/* Add the response of the weights of sliding modes, which keep their surfaces. If that cancels the response
 * of the constraint itself, as of a rope along which a switch holds, the latter is kept: its mode is then
 * decided without the switch. */
static void let_shares_answer(struct gathered *all, size_t k)
{
    struct hold_problem *problem = &all->problem;
    const struct shared_out *shares = &all->shares;
    double *step = shares->rates + k * (size_t)shares->units;
    sliding_answer(all->state->sliding, step);
    for (size_t i = 0; i < problem->count; i++) {
        double *A = &problem->A[i * problem->count + k], taken = 0;
        for (int unit = 0; unit < shares->units; unit++)
            taken += shares->c[(size_t)unit * problem->count + i] * step[unit];
        bool all_of_it = fabs(*A + taken) <= undecided_part * fabs(taken);
        if (!all_of_it || i != k) *A = all_of_it ? 0 : *A + taken;
    }
    for (size_t g = 0; g < problem->guide_count; g++)
        for (int unit = 0; unit < shares->units; unit++)
            problem->B[g * problem->count + k] +=
                shares->N[(size_t)unit * problem->guide_count + g] * step[unit];
}

/* ---- the problem */

void gathered_free(struct gathered *all)
{
    holds_free(&all->problem);
    free(all->pair);
    free(all->reactions);
    free(all->shares.c);
}

static bool make_room_for_shares(struct gathered *all)
{
    struct shared_out *shares = &all->shares;
    size_t units = (size_t)all->at.sliding->units, count = all->problem.count,
           guides = all->problem.guide_count;
    shares->c = calloc(units * (2 * count + guides) + 1, sizeof *shares->c);
    if (!shares->c) return false;
    shares->units = (int)units;
    shares->N = shares->c + units * count;
    shares->rates = shares->N + units * guides;
    return true;
}

/* Is the normal force of a friction that of a guide: a slide, or a slot with two sides? */
static bool has_guide(const struct fbd_model *model, const struct mode *mode)
{
    return mode->normal_slot >= 0 &&
           (mode->coupling < 0 || model->tree->couplings[mode->coupling].surface < 0);
}

/* Set the source of the normal force of friction i: a constraint on the same line, or a guide, which is
 * added. */
static void set_press(struct gathered *all, size_t i, size_t *guides)
{
    struct hold *hold = &all->problem.holds[i];
    const struct mode *mode = mode_of(all->state, all->pair[i]);
    hold->press = press_constant;
    if (mode->normal_slot < 0) return;
    if (!has_guide(all->state->model, mode)) {
        int surface = all->state->model->tree->couplings[mode->coupling].surface;
        hold->press = press_hold;
        hold->presses = all->hold[surface];
        if (hold->presses >= 0) return;
        /* Closed and decided: the present normal force, which look() checks. */
        double N = fmax(0, one_sided_at(all->state->model, &all->at, surface).force);
        hold->press = press_constant;
        hold->mu_s *= N;
        hold->mu_k *= N;
        return;
    }
    hold->press = press_guide;
    hold->presses = (int)*guides;
    all->guide[*guides] = all->pair[i];
    all->problem.guides[(*guides)++].two_sided = mode->two_sided;
}

bool gathered_find(struct gathered *all, struct fbd_state *state, const struct decided *decided, int *forced,
                   bool shares_answer)
{
    const struct plan *plan = &state->model->plan;
    size_t pairs = plan->mode_count, count = 0, guides = 0;
    struct instant at = state_instant(state);
    *all = (struct gathered){.state = state,
                             .at = at,
                             .forced = forced,
                             .pair = calloc(5 * pairs + 1, sizeof *all->pair)};
    if (!all->pair) return false;
    all->hold = all->pair + pairs;
    all->guide = all->hold + pairs;
    all->trial = all->guide + pairs;
    all->still = all->trial + pairs;
    memcpy(all->trial, state->slip, pairs * sizeof *all->trial);
    for (size_t p = 0; p < pairs; p++) {
        all->hold[p] = -1;
        if (!hold_in_question(state, decided, forced, (int)p)) continue;
        const struct mode *hold = &plan->modes[p];
        guides += mode_is_friction(hold) && has_guide(state->model, hold);
        all->hold[p] = (int)count;
        all->pair[count++] = (int)p;
        all->trial[p] = loose;
    }
    if (!holds_new(&all->problem, count, guides)) return false;
    if (state->model->tree->journal_count > 0 &&
        !at.sliding) { /* else their directions are those at the start */
        all->reactions = calloc(guides * (count + 1) + 1, sizeof *all->reactions);
        if (!all->reactions) return false;
    }
    if (at.sliding && shares_answer && !make_room_for_shares(all)) return false;
    guides = 0;
    for (size_t i = 0; i < count; i++) {
        const struct mode *mode = mode_of(state, all->pair[i]);
        struct hold *hold = &all->problem.holds[i];
        hold->kind = mode_is_friction(mode) ? hold_friction : hold_one_sided;
        if (hold->kind == hold_one_sided) continue;
        const struct friction_coefficients mu =
            friction_coefficients_at(state->model, all->pair[i], &at, NULL);
        hold->mu_s = mu.resting;
        hold->mu_k = mu.slipping;
        hold->slip = hold_slips_already(state, decided, forced, all->pair[i]);
        set_press(all, i, &guides);
    }
    all->at.slip = all->trial;
    set_free(all);
    for (size_t k = 0; k < count; k++) all->still[k] = add_column(all, k) ? still_stays : 0;
    for (size_t k = 0; k < count && all->shares.units > 0; k++)
        if (!all->still[k]) let_shares_answer(all, k);
    for (size_t k = 0; k < count; k++) {
        state->slip_driven[all->pair[k]] = 0;
        if (all->still[k]) hold_still(all, k);
    }
    return true;
}

bool gathered_turn_journals(struct gathered *all)
{
    struct hold_problem *problem = &all->problem;
    double change = 0;
    for (size_t g = 0; g < problem->guide_count; g++) {
        const struct vec *reactions = reactions_of(all, g);
        if (!reactions) continue;
        const int i = link_of(all->state, all->guide[g]);
        struct vec F = reactions[0];
        for (size_t k = 0; k < problem->count; k++)
            F = vec_add(F, vec_scale(problem->holds[k].force, reactions[1 + k]));
        change = fmax(change, journal_aim(all->state->model->tree, all->state->tree, i, F));
        const struct vec n = tree_normal(all->state->model->tree, all->state->tree, i);
        problem->guides[g].free = vec_dot(n, reactions[0]);
        for (size_t k = 0; k < problem->count; k++)
            problem->B[g * problem->count + k] = vec_dot(n, reactions[1 + k]);
    }
    return change > journal_negligible_turn;
}

void gathered_set_out(struct fbd_state *state, const int *gives)
{
    struct gathered all = {0};
    int *forced = tree_rests(state) ? calloc(state->model->plan.mode_count, sizeof *forced) : NULL;
    if (!forced) return;
    if (!gathered_find(&all, state, NULL, forced, false)) state->holds.found = holds_no_memory;
    for (size_t i = 0; i < all.problem.count; i++)
        if (all.still[i] == still_sets_out && gives[all.pair[i]] != 0)
            state->slip[all.pair[i]] = all.problem.holds[i].slip;
    gathered_free(&all);
    free(forced);
}
