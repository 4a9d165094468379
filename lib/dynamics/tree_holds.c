/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The holds between jointed bodies, decided together (holds/holds.h).
 *
 * While the modes that there are agree with the forces nothing is solved. Else all holds that touch are let
 * loose, and what each of them does when it pushes with one unit is found by the recursion and the system of
 * the constraints: a column of Delassus' matrix. What slips already is let loose with the others, since its
 * friction goes with a normal force that is still to be found.
 *
 * At a limit to rounding the rates of change decide: the forces do not tell. Of a load that several share
 * there is a share within all limits or not (rest_system.h); just beyond, all those that are at theirs give.
 */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/modes.h"
#include "dynamics/tree_driven.h"
#include "dynamics/tree_shared.h"
#include "dynamics/tree_system.h"

/* ---- which holds are in question */

struct gathered {
    struct fbd_state *state;
    struct instant at; /* with all of them loose */
    struct hold_problem problem;
    int *pair, *hold; /* of a hold; of a pair, or -1 */
    int *link;        /* of a guide: whose slide */
    int *trial;       /* modes with all of them loose */
    int *still;       /* of a hold: the constraints alone let nothing move along it */
    int *forced;
};

static const struct friction *pair_of(const struct fbd_state *state, int pair)
{
    return &state->model->plan.frictions[pair];
}

/* Is the surface that the friction is on, if it is on one, closed or to be decided? */
static bool is_on_surface(const struct fbd_state *state, const struct decided *decided, const int *forced,
                          const struct friction *friction)
{
    if (friction->tie < 0) return true;
    int surface = state->model->tree->ties[friction->tie].surface;
    struct instant at = state_instant(state);
    if (surface >= 0 && (forced[surface] || (decided && decided->slips[surface])) &&
        state->slip[surface] != stick)
        return false;
    if (surface >= 0 && pair_of(state, surface)->kind == mode_contact)
        return state->tree->ties[friction->tie].feature != no_feature;
    return surface < 0 || state->slip[surface] == stick || one_sided_at(state->model, &at, surface).touches;
}

/* `forced`: modes that rates have decided, 0 where they have not. */
static bool is_in_question(const struct fbd_state *state, const struct decided *decided, const int *forced,
                           int pair)
{
    const struct friction *hold = pair_of(state, pair);
    struct instant at = state_instant(state);
    if (!hold->jointed || hold->kind == mode_drive) return false;
    if (hold->kind == mode_friction) return is_on_surface(state, decided, forced, hold);
    if (forced[pair] || (decided && decided->slips[pair])) return false;
    if (hold->kind == mode_contact) return state->tree->ties[hold->tie].feature != no_feature;
    struct one_sided now = one_sided_at(state->model, &at, pair);
    return now.touches || (state->slip[pair] == stick && (decided || !(now.parts || now.meets)));
}

enum { keeps_still = 2 }; /* beside the modes that rates decide: see immovable */

/* The side on which a friction slips whatever the forces are, 0 for one at rest. */
static int slips_already(const struct fbd_state *state, const struct decided *decided, const int *forced,
                         int pair)
{
    if (forced[pair]) return forced[pair] == keeps_still ? 0 : forced[pair];
    if (decided && decided->slips[pair]) return state->slip[pair];
    double v = settling_velocity(state, decided, pair);
    return v > 0 ? 1 : v < 0 ? -1 : 0;
}

/* ---- one unit of a hold, and what answers */

static int link_of(const struct fbd_state *state, int pair)
{
    return state->model->bodies[pair_of(state, pair)->body].place.link;
}

static void apply_unit(struct fbd_state *state, int pair)
{
    const struct friction *hold = pair_of(state, pair);
    memset(state->tree->x, 0, (size_t)state->model->tree->count * sizeof *state->tree->x);
    if (hold->tie >= 0)
        row_apply(hold_row(state, hold), hold_sign(hold), state->tree->x);
    else
        state->tree->x[link_of(state, pair)].g = 1;
}

/* Add what the accelerations in work->x and work->unit are along hold i and to the guides, to column k. */
static void add_answers(struct gathered *all, size_t k)
{
    struct fbd_state *state = all->state;
    const struct tree *tree = state->model->tree;
    size_t count = all->problem.count;
    for (size_t i = 0; i < count; i++) {
        const struct friction *hold = pair_of(state, all->pair[i]);
        all->problem.A[i * count + k] +=
            hold->tie < 0
                ? state->tree->unit[hold->coordinate]
                : hold_sign(hold) *
                      tree_row_answer(state->tree, (int)(hold_row(state, hold) - state->tree->rows));
    }
    for (size_t g = 0; g < all->problem.guide_count; g++)
        all->problem.B[g * count + k] += tree_normal_in(tree, state->tree, all->link[g]);
}

/* What the constraints alone do not let move slips by rounding only, and no force along it moves anything. */
static const double immovable = 1e-12;

static void hold_still(struct gathered *all, size_t k)
{
    struct fbd_state *state = all->state;
    const struct friction *hold = pair_of(state, all->pair[k]);
    struct hold *still = &all->problem.holds[k];
    size_t count = all->problem.count;
    double surface, driven = tree_driven(state, all->trial, all->pair[k]);
    still->free = still->kind == hold_one_sided ? driven : 0;
    for (size_t i = 0; i < count; i++) all->problem.A[i * count + k] = all->problem.A[k * count + i] = 0;
    if (driven != 0) still->slip = driven > 0 ? 1 : -1;
    if (driven != 0 && hold->kind == mode_friction)
        all->forced[all->pair[k]] = state->slip_driven[all->pair[k]] = still->slip;
    if (hold->moving || driven != 0) return; /* below what stands still */
    still->slip = 0;
    if (all->forced[all->pair[k]] == 0) all->forced[all->pair[k]] = keeps_still;
    if (hold->kind == mode_friction && hold->tie < 0)
        state->y[state->model->plan.n + hold->coordinate] = friction_surface_speed(hold, &all->at, &surface);
}

/* The links answer, and then the constraints that do not let them. True when these hold it still. */
static bool add_column(struct gathered *all, size_t k)
{
    struct fbd_state *state = all->state;
    const struct tree *tree = state->model->tree;
    struct tree_work *work = state->tree;
    apply_unit(state, all->pair[k]);
    tree_inward(tree, work, 1, tree->count);
    tree_outward(tree, work, 1, tree->count, work->unit);
    add_answers(all, k);
    double alone = all->problem.A[k * all->problem.count + k];
    if (tree->tie_count == 0) return false;
    for (int j = 0; j < tree_unknowns(tree); j++)
        work->z[j] = j < tree->row_count ? -tree_row_answer(work, j) : 0;
    tree_system_solve(state->model, &all->at, work->z);
    add_answers(all, k);
    return all->problem.A[k * all->problem.count + k] <= immovable * alone;
}

/* Without any hold. */
static void set_free(struct gathered *all)
{
    struct fbd_state *state = all->state;
    double *slots = state->scratch;
    accelerations(state->model, &all->at, slots, state->a);
    for (size_t i = 0; i < all->problem.count; i++)
        all->problem.holds[i].free = tree_hold_acceleration(state, &all->at, all->pair[i]);
    for (size_t g = 0; g < all->problem.guide_count; g++)
        all->problem.guides[g].free = -slots[state->model->tree->links[all->link[g]].normal_slot];
}

/* ---- the problem */

static void gathered_free(struct gathered *all)
{
    holds_free(&all->problem);
    free(all->pair);
}

/* What presses on friction i: a hold of the same line, or the guide of its slide, which is noted. */
static void set_press(struct gathered *all, size_t i, size_t *guides)
{
    struct hold *hold = &all->problem.holds[i];
    const struct friction *friction = pair_of(all->state, all->pair[i]);
    hold->press = press_constant;
    if (friction->normal_slot < 0) return;
    if (friction->tie >= 0) {
        int surface = all->state->model->tree->ties[friction->tie].surface;
        hold->press = press_hold;
        hold->presses = all->hold[surface];
        if (hold->presses >= 0) return;
        /* Closed already: with the force that it has, and look() says whether it keeps that. */
        double N = fmax(0, one_sided_at(all->state->model, &all->at, surface).force);
        hold->press = press_constant;
        hold->mu_s *= N;
        hold->mu_k *= N;
        return;
    }
    hold->press = press_guide;
    hold->presses = (int)*guides;
    all->link[*guides] = link_of(all->state, all->pair[i]);
    all->problem.guides[(*guides)++].two_sided = friction->two_sided;
}

static bool gather(struct gathered *all, struct fbd_state *state, const struct decided *decided, int *forced)
{
    const struct plan *plan = &state->model->plan;
    size_t pairs = plan->friction_count, count = 0, guides = 0;
    struct instant at = state_instant(state);
    *all = (struct gathered){.state = state,
                             .at = at,
                             .forced = forced,
                             .pair = calloc(5 * pairs + 1, sizeof *all->pair)};
    if (!all->pair) return false;
    all->hold = all->pair + pairs;
    all->link = all->hold + pairs;
    all->trial = all->link + pairs;
    all->still = all->trial + pairs;
    memcpy(all->trial, state->slip, pairs * sizeof *all->trial);
    for (size_t p = 0; p < pairs; p++) {
        all->hold[p] = -1;
        if (!is_in_question(state, decided, forced, (int)p)) continue;
        const struct friction *hold = &plan->frictions[p];
        guides += hold->tie < 0 && hold->normal_slot >= 0;
        all->hold[p] = (int)count;
        all->pair[count++] = (int)p;
        all->trial[p] = loose;
    }
    if (!holds_new(&all->problem, count, guides)) return false;
    guides = 0;
    for (size_t i = 0; i < count; i++) {
        const struct friction *friction = pair_of(state, all->pair[i]);
        struct hold *hold = &all->problem.holds[i];
        hold->kind = friction->kind == mode_friction ? hold_friction : hold_one_sided;
        if (hold->kind == hold_one_sided) continue;
        hold->mu_s = formula_value(&friction->mu_s, &at);
        hold->mu_k = formula_value(&friction->mu_k, &at);
        hold->slip = slips_already(state, decided, forced, all->pair[i]);
        set_press(all, i, &guides);
    }
    all->at.slip = all->trial;
    set_free(all);
    for (size_t k = 0; k < count; k++) all->still[k] = add_column(all, k);
    for (size_t k = 0; k < count; k++) {
        state->slip_driven[all->pair[k]] = 0;
        if (all->still[k]) hold_still(all, k);
    }
    return true;
}

/* Painleve's paradox has a friction by which its own normal force grows: the one that does so most. */
static struct holds_trouble trouble_of(const struct gathered *all, enum holds_found found)
{
    struct holds_trouble trouble = {.found = found, .pair = -1, .contradicts = -1};
    const struct hold_problem *problem = &all->problem;
    for (size_t i = 0; i < problem->count; i++) {
        const struct hold *hold = &problem->holds[i];
        if (hold->kind != hold_friction || hold->press == press_constant) continue;
        double answer = 0, own = problem->A[(size_t)hold->presses * problem->count + (size_t)hold->presses];
        if (hold->press == press_guide) answer = problem->B[(size_t)hold->presses * problem->count + i];
        if (hold->press == press_hold && own > 0)
            answer = -problem->A[(size_t)hold->presses * problem->count + i] / own;
        if (fabs(answer) * hold->mu_k <= fabs(trouble.answer)) continue;
        trouble.answer = fabs(answer) * hold->mu_k;
        trouble.pair = all->pair[i];
    }
    return trouble;
}

/* The side on which a guide with two sides presses. */
static void set_pull(struct fbd_state *state, int pair, double N)
{
    if (pair_of(state, pair)->two_sided) state->pull[pair] = N < 0 ? -1 : 1;
}

/* Set the modes by pivoting. */
static enum holds_found solve(struct fbd_state *state, const struct decided *decided, int *forced)
{
    struct gathered all;
    enum holds_found found = holds_no_memory;
    if (gather(&all, state, decided, forced)) {
        found = holds_decide(&all.problem);
        if (found != holds_decided) state->holds = trouble_of(&all, found);
    }
    for (size_t i = 0; found <= holds_several && i < all.problem.count; i++) {
        const struct hold *hold = &all.problem.holds[i];
        state->slip[all.pair[i]] = hold->mode;
        if (hold->press == press_guide && !(decided && decided->pulls[all.pair[i]]))
            set_pull(state, all.pair[i], all.problem.guides[hold->presses].N);
    }
    if (found == holds_no_memory) state->holds.found = found;
    gathered_free(&all);
    return found;
}

/* ---- do the modes agree with the forces? */

/* What the friction of a joint alone does to its body: an acceleration that is left of sums of such sizes. */
static double accelerated(const struct fbd_state *state, int pair)
{
    const struct tree_link *link = &state->model->tree->links[link_of(state, pair)];
    const struct friction *friction = pair_of(state, pair);
    struct instant at = state_instant(state);
    double inertia = friction->normal_slot >= 0 ? link->mass : link->I_O;
    return inertia > 0 ? friction_at(state->model, pair, &at, state->scratch).limit / inertia : 0;
}

/* Does a slipping pair turn back at once? */
static bool turns_back(const struct fbd_state *state, int pair)
{
    const double rounding = 64 * DBL_EPSILON;
    const struct friction *friction = pair_of(state, pair);
    struct instant at = state_instant(state);
    double surface;
    if (friction->tie >= 0)
        return state->slip[pair] * tie_slip_acceleration(state->model, &at, friction->tie) < 0;
    friction_surface_speed(friction, &at, &surface);
    double a = state->a[friction->coordinate];
    double least = 8 * DBL_EPSILON * (fabs(a) + fabs(surface)) + rounding * accelerated(state, pair);
    return slip_side(state->slip[pair]) * (a - surface) < -least;
}

/* The size that forces of constraints have: what zero is measured against. */
static double largest_force(const struct fbd_state *state)
{
    double most = 0;
    for (int j = 0; j < state->model->tree->row_count; j++)
        most = fmax(most, fabs(state->tree->rows[j].lambda));
    for (int i = 1; i < state->model->tree->count; i++) /* what only just touches has none of its own */
        most = fmax(most, vec_norm(state->model->tree->links[i].force));
    return most;
}

static bool is_on_contact(const struct fbd_state *state, const struct friction *hold)
{
    return hold->tie >= 0 && state->model->tree->ties[hold->tie].meeting >= 0;
}

/* Friction of what has just opened has nothing to hold or to slip on, whatever its mode. */
static bool is_on_open_contact(const struct fbd_state *state, const struct friction *hold)
{
    return hold->kind == mode_friction && is_on_contact(state, hold) &&
           state->slip[state->model->tree->ties[hold->tie].surface] != stick;
}

/* What a hold that is in question has to become: itself where it agrees. At its limit to rounding the rate
 * decides, and `by_rate` is set: there what is solved is as likely to have it hold as to have it give. */
static int next_mode(const struct fbd_state *state, const double *slots, const double *slots_along, int pair,
                     bool *by_rate)
{
    const double rounding = 1e-12, slacks = 4;
    const struct fbd_model *model = state->model;
    const struct friction *hold = pair_of(state, pair);
    struct instant at = state_instant(state);
    *by_rate = false;
    if (mode_is_one_sided(hold)) {
        struct one_sided now = one_sided_at(model, &at, pair);
        double small = rounding * largest_force(state);
        if (state->slip[pair] != stick) return now.acceleration > 0 ? stick : state->slip[pair];
        double rate = hold_sign(hold) * state->tree->z[model->tree->ties[hold->tie].first_row];
        double least = now.force < -now.slack / 2 ? 0 : now.slack * now.turning;
        double nothing = fmax(small, slacks * now.slack); /* its event function lets it pull, too */
        *by_rate = fabs(now.force) <= nothing && rate < -least;
        return now.force < -nothing || *by_rate ? slip_plus : stick;
    }
    if (state->slip[pair] != stick) return turns_back(state, pair) ? stick : state->slip[pair];
    double *dy = state->scratch + 2 * (size_t)model->plan.slots;
    struct direction flow = {1, dy};
    struct friction_values now = friction_at(model, pair, &at, slots);
    struct friction_values rate = friction_along(model, pair, &at, slots, &flow, slots_along);
    double excess = fabs(now.hold) - now.limit;
    if (is_on_contact(state, hold) && excess <= contact_slack(model, hold->tie)) return stick;
    *by_rate = excess <= rounding * (fabs(now.hold) + now.limit);
    return friction_decide(&now, &rate);
}

/* Does a slide that rubs press the wrong way? Where it sticks a guide takes the side on which it presses. A
 * surface with one side that pulls is solved as one that does not press: that it is lost is for others to
 * say. */
static bool pulls(struct fbd_state *state, const double *slots, const struct decided *decided, bool solved,
                  int pair)
{
    const struct friction *hold = pair_of(state, pair);
    if (hold->kind != mode_friction || hold->tie >= 0 || hold->normal_slot < 0) return false;
    double N = -slots[hold->normal_slot];
    if (!hold->two_sided) return N < 0 && !solved;
    if (decided && decided->pulls[pair]) return false;
    if (state->slip[pair] == stick) set_pull(state, pair, N);
    return state->pull[pair] * N < 0;
}

/* ---- all of them */

/* `at_limit`: it differs by rates alone, or by next to nothing; what has to give is in `forced`, and does. */
static enum agreement look(struct fbd_state *state, const struct decided *decided, int *forced, bool solved)
{
    double *slots = state->scratch, *slots_along = slots + state->model->plan.slots;
    enum agreement found = agrees;
    tree_evaluate(state, slots, slots_along);
    struct instant at = state_instant(state);
    if (!solved && rest_is_open(state->model, &at) && tree_choose_sides(state, slots))
        tree_evaluate(state, slots, slots_along);
    struct arena arena = {0};
    struct rest_margin margin = {0};
    struct direction flow = {1, slots_along + state->model->plan.slots};
    bool shared = tree_find_margin(state, &at, true, &flow, slots, slots_along, &arena, &margin);
    if (shared && margin.value < 0) /* that a slide has lost its surface is for others to say */
        shared = tree_find_margin(state, &at, false, &flow, slots, slots_along, &arena, &margin);
    int which = -1, next = 0;
    for (int pair = 0; found != differs && pair < (int)state->model->plan.friction_count; pair++) {
        bool by_rate;
        const struct friction *hold = pair_of(state, pair);
        if (!is_in_question(state, decided, forced, pair)) continue;
        if (shared && margin.of[pair] && state->slip[pair] == stick) continue;
        if (pulls(state, slots, decided, solved, pair)) {
            found = differs;
            which = pair;
            continue;
        }
        if (hold->kind == mode_friction && slips_already(state, decided, forced, pair) != 0) continue;
        if (is_on_open_contact(state, hold)) continue;
        int mode = next_mode(state, slots, slots_along, pair, &by_rate);
        if (mode == state->slip[pair]) continue;
        found = by_rate ? at_limit : differs;
        which = pair;
        next = mode;
    }
    if (found == at_limit) forced[which] = state->slip[which] = next;
    if (found == differs && solved && which >= 0) state->holds.contradicts = which;
    if (found == agrees && shared) found = tree_judge(state, &margin, forced);
    arena_free(&arena);
    return found;
}

/* Solve, and let rates decide what is at its limit, one after the other. False where the forces do not agree
 * with what was solved. */
static bool decide(struct fbd_state *state, const struct decided *decided, int *forced)
{
    int count = (int)state->model->plan.friction_count;
    for (int round = 0; round <= count; round++) {
        if (solve(state, decided, forced) >= holds_none) return false;
        enum agreement found = look(state, decided, forced, true);
        if (found != at_limit) return found == agrees;
    }
    return false;
}

/* Does friction hold what drives move, whatever the forces are? No friction is enough for that. */
static bool holds_what_is_driven(struct fbd_state *state, const struct decided *decided, int *forced)
{
    struct gathered all;
    struct instant at = state_instant(state);
    bool may = false, moves = false;
    for (int pair = 0; pair < (int)state->model->plan.friction_count; pair++)
        may |= state->slip[pair] == stick && is_in_question(state, decided, forced, pair);
    if (!may || !tree_has_drives(state->model)) return false;
    state_evaluate_unshared(state);
    if (!rest_is_open(state->model, &at)) return false;
    bool gathered = gather(&all, state, decided, forced);
    if (!gathered) state->holds.found = holds_no_memory;
    for (size_t i = 0; gathered && i < all.problem.count; i++)
        moves |= all.still[i] && all.problem.holds[i].slip != 0 && state->slip[all.pair[i]] == stick;
    memset(forced, 0, state->model->plan.friction_count * sizeof *forced);
    gathered_free(&all);
    return moves;
}

bool tree_settle_holds(struct fbd_state *state, const struct decided *decided)
{
    int *before = state->slip_before;
    size_t count = state->model->plan.friction_count, bytes = count * sizeof *before;
    int *forced = state->slip_forced;
    memcpy(before, state->slip, bytes);
    memset(forced, 0, bytes);
    for (int pair = 0; pair < (int)count; pair++) {
        if (state->slip[pair] == stick || !is_in_question(state, decided, forced, pair)) continue;
        const struct friction *hold = pair_of(state, pair);
        bool rests = hold->kind != mode_friction || slips_already(state, decided, forced, pair) == 0;
        if (rests) state->slip[pair] = stick; /* tried first */
    }
    bool agreed =
        !holds_what_is_driven(state, decided, forced) && look(state, decided, forced, false) == agrees;
    agreed = agreed || decide(state, decided, forced);
    return agreed && memcmp(before, state->slip, bytes) == 0;
}
