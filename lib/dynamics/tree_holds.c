/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The unilateral constraints between jointed bodies, decided together (holds/holds.h).
 *
 * While the present modes are consistent with the forces no problem is solved. Else all closed ones are
 * released, and the accelerations by a unit force along each are computed by the recursion and the system of
 * the constraints: a column of Delassus' matrix. Slipping friction is released too, since it depends on a
 * normal force that is still unknown.
 *
 * At a limit, within rounding, the rates of change decide instead of the forces. A redundant load has a
 * distribution within all limits or not (rest_system.h); if it just exceeds them, all constraints at their
 * limits change their modes.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/modes.h"
#include "dynamics/tree_driven.h"
#include "dynamics/tree_gather.h"
#include "dynamics/tree_shared.h"
#include "dynamics/tree_system.h"
#include "numeric/tolerances.h"

/* ---- are the modes consistent with the forces? */

/* The acceleration of a body by the friction of its joint: the scale of its rounding. */
static double accelerated(const struct fbd_state *state, int pair)
{
    const struct tree_state *link = &state->tree->links[link_of(state, pair)];
    const struct mode *mode = mode_of(state, pair);
    struct instant at = state_instant(state);
    double inertia = mode->moment ? link->I_O : link->mass;
    return inertia > 0 ? friction_at(state->model, pair, &at, state->scratch).limit / inertia : 0;
}

/* Does a slipping constraint reverse at once? */
static bool turns_back(const struct fbd_state *state, int pair)
{
    const double rounding = round_off(64, 1);
    const struct mode *mode = mode_of(state, pair);
    struct instant at = state_instant(state);
    double surface;
    if (mode->coupling >= 0)
        return state->slip[pair] * coupling_slip_acceleration(state->model, &at, mode->coupling) < 0;
    friction_surface_speed(mode, &at, &surface);
    double a = state->a[mode->coordinate];
    double least = round_off(8, fabs(a) + fabs(surface)) + rounding * accelerated(state, pair);
    return slip_side(state->slip[pair]) * (a - surface) < -least;
}

/* The scale of the forces of constraints, with which zero is compared. */
static double largest_force(const struct fbd_state *state)
{
    double most = 0;
    for (int j = 0; j < state->model->tree->row_count; j++)
        most = fmax(most, fabs(state->tree->rows[j].lambda));
    for (int i = 1; i < state->model->tree->count; i++) /* a contact that just touches has no force */
        most = fmax(most, vec_norm(state->model->tree->links[i].force));
    return most;
}

static bool is_on_contact(const struct fbd_state *state, const struct mode *hold)
{
    return hold->coupling >= 0 && state->model->tree->couplings[hold->coupling].meeting >= 0;
}

/* Friction of a contact that has just opened has no force, whatever its mode. */
static bool is_on_open_contact(const struct fbd_state *state, const struct mode *hold)
{
    return mode_is_friction(hold) && is_on_contact(state, hold) &&
           state->slip[state->model->tree->couplings[hold->coupling].surface] != stick;
}

/* Does row j act on link i, or on one that it carries? */
static bool acts_beyond(const struct fbd_state *state, int j, int i)
{
    const struct row *row = &state->tree->rows[j];
    for (int k = 0; k < row->port_count; k++)
        if (row->ports[k].link >= i && row->ports[k].link < state->model->tree->links[i].end) return true;
    return false;
}

/* Does the momentum of a mechanism in its dead centre move a joint that sticks? A row on it is then redundant,
 * and has an acceleration. */
static bool joint_moves_on(const struct fbd_state *state, int link)
{
    const struct instant at = state_instant(state);
    for (int j = 0; j < state->model->tree->row_count; j++)
        if (state->tree->rows[j].redundant && tree_takes_part(state->model->tree, &at, j) &&
            acts_beyond(state, j, link) && tree_seen_acceleration(state, state->tree->rows[j].g.x2))
            return true;
    return false;
}

/* Does sticking friction have an acceleration? As a mechanism passes its dead centre no force along the row
 * moves it: the row is redundant, without a force, and the momentum moves it. If drives move it some row is
 * redundant, this one or a later one, and the forces are meaningless. */
static bool moves_on(const struct fbd_state *state, int pair)
{
    const struct instant at = state_instant(state);
    const struct mode *hold = mode_of(state, pair);
    if (mode_is_joint_friction(hold)) return joint_moves_on(state, link_of(state, pair));
    if (hold->kind != mode_tangent) return false;
    bool driven = model_has_speeds_given(state->model) && rest_is_open(state->model, &at);
    return (driven || hold_row(state, hold)->redundant) &&
           tree_seen_acceleration(state, hold_row(state, hold)->g.x2);
}

/* The next mode of a constraint that is to be decided: the same if it is consistent. At its limit, within
 * rounding, the rate decides, and `by_rate` is set: there the solution may be on either side. A solved mode
 * may exceed its limit by the accuracy of the solution. */
static int next_mode(const struct fbd_state *state, const struct decided *decided, const double *slots,
                     const double *slots_along, int pair, bool solved, bool *by_rate)
{
    const double rounding = negligible_sum, slacks = 4, beyond = solved ? 100 : 1;
    const struct fbd_model *model = state->model;
    const struct mode *hold = mode_of(state, pair);
    struct instant at = state_instant(state);
    *by_rate = false;
    if (mode_is_one_sided(hold)) {
        struct one_sided now = one_sided_at(model, &at, pair);
        /* Without loads but the rounding of a sliding mode, the rounding of forces is no scale. */
        if (is_on_contact(state, hold)) now.slack = fmax(now.slack, contact_slack(model, hold->coupling));
        double small = rounding * largest_force(state);
        if (state->slip[pair] != stick) return now.acceleration > 0 ? stick : state->slip[pair];
        double rate = hold_sign(hold) * state->tree->z[model->tree->couplings[hold->coupling].first_row];
        double least = now.force < -now.slack / 2 ? 0 : now.slack * now.turning;
        double nothing = fmax(small, slacks * now.slack); /* its event function has the same tolerance */
        *by_rate = now.force <= nothing && now.force >= -beyond * nothing && rate < -least;
        return now.force < -beyond * nothing || *by_rate ? slip_plus : stick;
    }
    if (state->slip[pair] != stick) return turns_back(state, pair) ? stick : state->slip[pair];
    struct direction flow = {.dt = 1, .dy = state_scratch(state).dy};
    struct friction_values now = friction_at(model, pair, &at, slots);
    struct friction_values rate = friction_along(model, pair, &at, slots, &flow, slots_along);
    double excess = fabs(now.hold) - now.limit;
    if (is_on_contact(state, hold) && excess <= contact_slack(model, hold->coupling)) return stick;
    double slack = settling_slack(state, decided, pair, &now, &rate);
    *by_rate = excess <= beyond * rounding * (fabs(now.hold) + now.limit) + slack;
    return friction_decide(&now, &rate, slack);
}

/* Does a slide with friction, or a slot, have a normal force of the wrong sign? While it sticks, a guide
 * takes the side of its normal force. A one-sided surface that pulls is solved as one without a normal force:
 * its loss is detected elsewhere. */
static bool pulls(struct fbd_state *state, const double *slots, const struct decided *decided, bool solved,
                  int pair)
{
    const struct mode *hold = mode_of(state, pair);
    if (!(mode_is_joint_friction(hold) || hold->two_sided) || hold->normal_slot < 0) return false;
    double N = -slots[hold->normal_slot];
    if (!hold->two_sided) return N < 0 && !solved;
    if (decided && decided->pulls[pair]) return false;
    double nothing =
        press_slack(state->model, state->tree, hold->body) / 2; /* its event function has twice that */
    if (state->slip[pair] == stick && fabs(N) > nothing) hold_set_pull(state, pair, N);
    return state->pull[pair] * N < -nothing;
}

/* ---- all constraints */

/* Find sticking friction that contradicts a closed constraint: its surface accelerates, or a drive moves the
 * other body away, as a receding cam. Both have rows, and the forces of such rows are meaningless. Returns
 * the friction, or -1. */
static int pulled_against(const struct fbd_state *state, const struct decided *decided, const int *forced)
{
    const struct instant at = state_instant(state);
    int count = (int)state->model->plan.mode_count, against = -1;
    const bool given = model_has_speeds_given(state->model);
    for (int pair = 0; pair < count && against < 0; pair++) {
        double surface = 0;
        const struct mode *hold = mode_of(state, pair);
        if (!mode_is_joint_friction(hold) || state->slip[pair] != stick) continue;
        friction_surface_speed(hold, &at, &surface);
        if ((surface != 0 || given) && hold_in_question(state, decided, forced, pair)) against = pair;
    }
    for (int pair = 0; pair < count && against >= 0; pair++) {
        const struct mode *hold = mode_of(state, pair);
        if (!mode_is_one_sided(hold) || state->slip[pair] != stick ||
            !hold_in_question(state, decided, forced, pair))
            continue;
        if (tree_seen_acceleration(state, hold_row(state, hold)->g.x2)) return against;
    }
    return -1;
}

/* `at_limit`: inconsistent by rates only, or by a negligible amount; the changed modes are in `forced`. */
static enum agreement look(struct fbd_state *state, const struct decided *decided, int *forced, bool solved)
{
    double *slots = state_scratch(state).slots, *slots_along = state_scratch(state).slots_along;
    enum agreement found = agrees;
    struct direction flow = tree_evaluate(state);
    struct instant at = state_instant(state);
    if (!solved && rest_is_open(state->model, &at) && tree_choose_sides(state, slots))
        flow = tree_evaluate(state);
    struct arena arena = state_lend(state);
    struct rest_margin margin = {0};
    bool shared =
        tree_find_margin(state, &at, rest_without_planes, &flow, slots, slots_along, &arena, &margin);
    if (shared && margin.value < 0) /* the loss of a slide's surface is detected elsewhere */
        shared =
            tree_find_margin(state, &at, rest_without_guides, &flow, slots, slots_along, &arena, &margin);
    int which = pulled_against(state, decided, forced), next = 0;
    if (which >= 0 || (!solved && tree_is_locked(state))) found = differs;
    for (int pair = 0; found != differs && pair < (int)state->model->plan.mode_count; pair++) {
        bool by_rate;
        const struct mode *hold = mode_of(state, pair);
        if (!hold_in_question(state, decided, forced, pair)) continue;
        if (state->slip[pair] == stick && moves_on(state, pair)) {
            found = differs;
            which = pair;
            continue;
        }
        bool shares = shared && margin.of[pair];
        if (shares && state->slip[pair] == stick) continue;
        if (!shares && pulls(state, slots, decided, solved, pair)) {
            found = differs;
            which = pair;
            continue;
        }
        if (mode_is_friction(hold) && hold_slips_already(state, decided, forced, pair) != 0) continue;
        if (is_on_open_contact(state, hold)) continue;
        int mode = next_mode(state, decided, slots, slots_along, pair, solved, &by_rate);
        if (mode == state->slip[pair]) continue;
        found = by_rate ? at_limit : differs;
        which = pair;
        next = mode;
    }
    if (found == at_limit) forced[which] = state->slip[which] = next;
    if (found == differs && solved && which >= 0) state->holds.contradicts = which;
    if (found == agrees && shared) found = tree_judge(state, &margin, forced);
    state_take_back(state, &arena);
    return found;
}

/* The contact of a friction, whose normal force may be negligible; -1 without one. */
static int surface_under(const struct fbd_state *state, int pair)
{
    if (pair < 0 || !is_on_contact(state, mode_of(state, pair))) return -1;
    return state->model->tree->couplings[mode_of(state, pair)->coupling].surface;
}

/* Check the solved modes. Friction that slips only by rounding and contradicts its mode is set to stick:
 * friction that sticks along the same line prevents its motion. */
static enum agreement look_at_solved(struct fbd_state *state, const struct decided *decided, int *forced)
{
    enum agreement found = look(state, decided, forced, true);
    for (size_t k = 0; k < state->model->plan.mode_count && found == differs; k++) {
        int pair = state->holds.contradicts;
        if (pair < 0 || state->slip_barely[pair] != keeps_still) break;
        state->slip_barely[pair] = 0;
        state->slip[pair] = stick;
        state->holds.contradicts = -1;
        found = look(state, decided, forced, true);
    }
    return found;
}

/* Open constraints at their limit, where modes are consistent but no reactions are within the limits: if
 * slipping friction depends on redundant normal forces, reactions with the same modes have other
 * accelerations, and the solution is one of many. It has no force at the constraints in `barely`, which are
 * opened to exclude the others. */
static bool open_what_barely_holds(struct fbd_state *state, int *forced)
{
    const int *barely = state->slip_barely;
    bool any = false;
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++) {
        if (barely[pair] == 0 || barely[pair] == keeps_still || !mode_is_one_sided(mode_of(state, pair)))
            continue;
        forced[pair] = state->slip[pair] = barely[pair];
        any = true;
    }
    return any;
}

/* Close constraints that were opened and close again after later changes. Returns true if there are any. */
static bool close_again(struct fbd_state *state, int *forced)
{
    const struct instant at = state_instant(state);
    bool any = false;
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++) {
        if (!mode_is_one_sided(mode_of(state, pair)) || forced[pair] == 0 || forced[pair] == keeps_still ||
            state->slip[pair] == stick)
            continue;
        double closing = one_sided_at(state->model, &at, pair).acceleration;
        if (closing <= 0 || !tree_seen_acceleration(state, closing)) continue;
        state->slip[pair] = stick;
        forced[pair] = 0;
        any = true;
    }
    return any;
}

/* Are consistent modes still so after closing again those that close, each once? */
static enum agreement keep_closed(struct fbd_state *state, const struct decided *decided, int *forced)
{
    enum agreement found = agrees;
    while (found == agrees && close_again(state, forced)) found = look(state, decided, forced, true);
    return found;
}

/* Solve, and let rates decide constraints at their limit, one after the other. False where the resulting
 * forces contradict the solution. */
static bool decide(struct fbd_state *state, const struct decided *decided, int *forced, enum gathering how)
{
    int count = (int)state->model->plan.mode_count, *barely = state->slip_barely;
    for (int round = 0; round <= count; round++) {
        memset(barely, 0, (size_t)count * sizeof *barely);
        if (gathered_solve(state, decided, forced, barely, how) >= holds_none) return false;
        enum agreement found = look_at_solved(state, decided, forced);
        if (found == agrees) found = keep_closed(state, decided, forced);
        if (found == agrees) return true;
        bool more = found == at_limit;
        int on = found == differs ? surface_under(state, state->holds.contradicts) : -1;
        for (int pair = 0; pair < count && found == differs; pair++) {
            bool contradicts = pair == state->holds.contradicts || pair == on;
            if (barely[pair] == 0 || barely[pair] == keeps_still ||
                (mode_is_one_sided(mode_of(state, pair)) && !contradicts))
                continue;
            forced[pair] = state->slip[pair] = barely[pair];
            more = true;
        }
        if (!more && found == differs) more = open_what_barely_holds(state, forced);
        if (!more) return false;
    }
    return false;
}

/* The same from the start, in another way. */
static bool decide_again(struct fbd_state *state, const struct decided *decided, int *forced,
                         enum gathering how)
{
    state->holds = (struct holds_trouble){.found = holds_decided, .pair = -1, .contradicts = -1};
    tree_find_frictionless(state, decided, forced);
    return decide(state, decided, forced, how);
}

/* Forces contradict their modes where rows are nearly dependent, as of a disc between two others in one line: its normal
 * forces there are below the resolution of the equations of motion. */
static bool decide_coarsely(struct fbd_state *state, const struct decided *decided, int *forced)
{
    const struct holds_trouble trouble = state->holds;
    if (trouble.found != holds_decided || trouble.contradicts < 0) return false;
    if (decide_again(state, decided, forced, coarsely)) return true;
    state->holds = trouble;
    return false;
}

/* Do all switches in sliding modes have weights within their range? Closed constraints may make the branches
 * ineffective, or too weak. */
static bool shares_fit(const struct sliding *s)
{
    bool fit = !s->failed;
    for (int j = 0; j < s->count; j++)
        fit &= s->slides[j].share >= -solved_rounding && s->slides[j].share <= 1 + solved_rounding;
    return fit;
}

/* Where switches in sliding modes have no weights in range, or no modes are found: solve again with the
 * weights as unknowns. A taut rope makes the switch along it ineffective, and may have to become slack. */
static bool decide_with_shares(struct fbd_state *state, const struct decided *decided, int *forced,
                               bool agreed)
{
    const struct sliding *s = state_sliding(state);
    if (!s || (agreed && shares_fit(s)) || state->holds.found == holds_no_memory) return agreed;
    return decide_again(state, decided, forced, with_shares);
}

/* Set friction at rest that has no force to the side of the beginning motion. */
static void turn_idle(struct fbd_state *state, const struct decided *decided)
{
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++)
        if (state->slip_idle[pair] != 0 && settling_velocity(state, decided, pair) == 0 &&
            turns_back(state, pair))
            state->slip[pair] = -state->slip[pair];
}

/* Does sticking friction contradict a motion by drives, by surfaces, or by momentum in a dead centre, which
 * no force prevents? (Friction along a coupling in a dead centre is found by its row, see moves_on.) */
static bool holds_what_is_driven(struct fbd_state *state, const struct decided *decided, int *forced)
{
    struct gathered all;
    struct instant at = state_instant(state);
    bool may = false, moves = false;
    const bool given = model_has_speeds_given(state->model);
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++)
        may |= state->slip[pair] == stick && (given || mode_is_joint_friction(mode_of(state, pair))) &&
               hold_in_question(state, decided, forced, pair);
    if (!may) return false;
    state_evaluate_unshared(state);
    if (!rest_is_open(state->model, &at)) return false;
    bool gathered = gathered_find(&all, state, decided, forced, false);
    if (!gathered) state->holds.found = holds_no_memory;
    for (size_t i = 0; gathered && i < all.problem.count; i++)
        moves |= all.still[i] == still_stays && all.problem.holds[i].slip != 0 &&
                 state->slip[all.pair[i]] == stick;
    memcpy(forced, state->slip_idle, state->model->plan.mode_count * sizeof *forced);
    if (gathered) tree_find_unpressed(&all, decided, forced);
    gathered_free(&all);
    return moves;
}

/* ---- second order */

/* At rest, and about to turn: a time T after which the motion changes the rows by 1e-4 of the accelerations;
 * 0 if second order is irrelevant. */
static double moment_later(const struct fbd_state *state)
{
    const double share = 1e-2;
    const struct instant at = state_instant(state);
    double turning = 0;
    if (state->model->tree->meeting_count == 0 || !tree_rests(state) || !rest_is_open(state->model, &at))
        return 0;
    for (int i = 1; i < state->model->tree->count; i++)
        turning = fmax(turning, fabs(state->tree->links[i].A.alpha));
    return turning > 0 ? share / sqrt(turning) : 0;
}

/* Set contacts and their friction to their modes after that time, if different. */
static bool take_later_modes(struct fbd_state *state, const struct fbd_state *later,
                             const struct decided *decided, int *forced)
{
    bool any = false;
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++) {
        const struct mode *hold = mode_of(state, pair);
        if (!is_on_contact(state, hold) || !hold_in_question(state, decided, forced, pair)) continue;
        if (state->slip[pair] != stick || later->slip[pair] == stick || forced[pair] != 0) continue;
        forced[pair] = state->slip[pair] = later->slip[pair];
        any = true;
    }
    return any;
}

/* Redundant rows do not prevent a small rotation of a body, and are independent after it: then contacts open,
 * and friction slips, to second order. */
static bool look_later(struct fbd_state *state, const struct decided *decided, int *forced)
{
    const size_t n = (size_t)state->model->plan.n, count = state->model->plan.mode_count;
    const double T = moment_later(state);
    if (T == 0) return true;
    struct fbd_state *later = state_new(state->model);
    bool *none = calloc(3 * count + (size_t)state->model->plan.branches + 1, sizeof *none);
    bool agreed = true;
    if (later && none) {
        const struct decided nothing = {none + 3 * count, none, none + count, none + 2 * count, true};
        state_copy(later, state);
        for (size_t i = 0; i < n; i++) later->y[n + i] = T * state->a[i];
        if (modes_settle(later, &nothing) && take_later_modes(state, later, decided, forced))
            agreed =
                look(state, decided, forced, true) == agrees && keep_closed(state, decided, forced) == agrees;
    } else {
        state->holds.found = holds_no_memory;
    }
    free(none);
    state_free(later);
    return agreed;
}

/* Is there a constraint to be decided, or an indeterminate reaction? */
static bool any_in_question(const struct fbd_state *state, const struct decided *decided, const int *forced)
{
    const struct instant at = state_instant(state);
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++)
        if (hold_in_question(state, decided, forced, pair)) return true;
    return rest_is_open(state->model, &at);
}

bool tree_settle_holds(struct fbd_state *state, const struct decided *decided, bool *jointly)
{
    int *before = state->slip_before;
    size_t count = state->model->plan.mode_count, bytes = count * sizeof *before;
    int *forced = state->slip_forced;
    memcpy(before, state->slip, bytes);
    tree_find_frictionless(state, decided, forced);
    *jointly = any_in_question(state, decided, forced);
    if (!*jointly) return true;
    for (int pair = 0; pair < (int)count; pair++) {
        if (state->slip[pair] == stick || !hold_in_question(state, decided, forced, pair)) continue;
        const struct mode *hold = mode_of(state, pair);
        bool rests = !mode_is_friction(hold) || hold_slips_already(state, decided, forced, pair) == 0;
        if (rests) state->slip[pair] = stick; /* tried first */
    }
    bool agreed = !holds_what_is_driven(state, decided, forced) &&
                  look(state, decided, forced, false) == agrees && !tree_is_doubtful(state);
    agreed = agreed || decide(state, decided, forced, as_it_is) || decide_coarsely(state, decided, forced);
    agreed = decide_with_shares(state, decided, forced, agreed);
    agreed = agreed && ((decided && decided->later) || look_later(state, decided, forced));
    turn_idle(state, decided);
    return agreed && memcmp(before, state->slip, bytes) == 0;
}
