/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The transitions of the modes. With v the velocity relative to the surface, H the friction for sticking, c =
 * mu |N| its limit, g the excess of a rope's path over its length or the penetration of a surface (g <= 0),
 * and F the force of a closed constraint:
 *
 *   kind               moving                           at rest, or just closed
 *   friction           slips to the side of v           sticks while |H| <= c; at |H| = c within rounding while
 *                                                         d|H|/dt <= dc/dt; else slips against H
 *   rope, surface      closes where g = 0 and g' > 0    closed while F >= 0; at F = 0 while F' >= 0
 *   contact            closes by an impact              likewise
 *   drive              as a function of time            always
 *
 * N, F and H depend on other modes, except for bodies that stand alone: these modes are decided
 * here, one by one. Constraints at rest between jointed bodies are decided together, as one complementarity
 * problem (tree_holds.c). Rates are those along the motion, d/dt = (1, v, a, z'), which depend on the modes:
 * so all is repeated until it is consistent.
 *
 * Checked by enumeration of all modes (tests/unit/test_holds.c), by random friction with known stops
 * (test_slip.c), and by starts at the limit (tests/hard/test_at_the_limit.c, test_coupled_friction.c).
 */
#include "dynamics/modes.h"

#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/journals.h"
#include "dynamics/plane_friction.h"
#include "dynamics/world_refs.h"
#include "numeric/tolerances.h"

/* Give friction that begins to slip at its limit a small acceleration in the slip direction. Its relative
 * acceleration is still rounding, which would choose the branches of expressions in its speed at random. */
static void lean(const struct fbd_state *state, double *dy)
{
    const struct fbd_model *model = state->model;
    const struct plan *plan = &model->plan;
    struct instant at = state_instant(state);
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        bool begins = mode_is_joint_friction(mode) && state->slip[pair] != stick &&
                      slip_velocity(model, pair, &at) == 0;
        if (!begins) continue;
        double *slots = state->scratch, surface, *a = &dy[plan->n + mode->coordinate];
        friction_surface_speed(mode, &at, &surface);
        force_balance(model, &at, slots);
        double limit =
            mode->kind == mode_joint ? 0 : friction_at(model, pair, &at, slots).limit / mode->inertia;
        double least = undecided_part * fmax(fmax(fabs(*a), fabs(surface)), limit);
        if (fabs(*a - surface) <= least) *a = surface + slip_side(state->slip[pair]) * least;
    }
}

/* The direction of motion of the state: (1, v, a, z'), in the scratch. */
static struct direction flow_of(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    struct direction flow = state_flow(state, state_scratch(state).dy);
    if (plan->kink_count > 0) lean(state, state_scratch(state).dy);
    if (!state->extended) return flow;
    struct instant at = state_instant(state), extended = instant_extend(state->model, &at);
    return direction_extend(state->model, &extended, &flow);
}

/* `around`: the passes cycle. A state z at its limit is at rest on the branch beyond, which is not chosen for
 * a state at rest, and returns on the other branch: it stays. */
static bool settle_branches(struct fbd_state *state, const struct decided *decided,
                            const struct direction *flow, bool around)
{
    const struct plan *plan = &state->model->plan;
    size_t size = (size_t)plan->branches * sizeof *state->branch;
    memcpy(state->branch_before, state->branch, size);
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct kink *kink = &plan->kinks[i];
        int first = kink->formula.branch;
        const bool *keep = state->sliding ? state->sliding->keep + first
                           : decided      ? decided->branches + first
                                          : NULL;
        (around ? expr_resolve_at_rest : expr_resolve)(kink->formula.expr, state_moment(state), state->y,
                                                       flow->dt, flow->dy, keep, state->branch + first);
    }
    return memcmp(state->branch_before, state->branch, size) == 0;
}

/* ---- decision of each kind of mode on its own */

struct settling {
    struct fbd_state *state;
    const struct decided *decided; /* or NULL */
    const struct direction *flow;
    const double *slots, *slots_along; /* the forces without friction, and their rates */
};

enum { together = loose }; /* left to tree_settle_holds */

/* Taut or slack, closed or open. A constraint that closes stays closed until its force ends. */
static int decide_one_sided(const struct settling *settling, int pair)
{
    const struct fbd_state *state = settling->state;
    struct instant at = state_instant(state);
    if (mode_has_ended(state, pair)) return slip_plus;
    struct one_sided now = one_sided_at(state->model, &at, pair);
    bool closed = state->slip[pair] == stick;
    bool near = fabs(now.excess) <= 1e3 * now.near && !now.parts;
    if (now.touches || (settling->decided && closed)) return together;
    if (closed && near) return stick;
    return now.rate > 0 && now.excess > -now.rounding ? stick : slip_plus;
}

/* Moving friction slips in its direction of motion. */
static int decide_friction(const struct settling *settling, int pair)
{
    if (friction_is_never(&settling->state->model->plan.modes[pair])) return slip_plus;
    if (mode_has_ended(settling->state, pair)) return slip_plus;
    double v = settling_velocity(settling->state, settling->decided, pair);
    int aside = settling->state->sliding ? settling->state->sliding->aside[pair] : 0;
    return v > 0 ? slip_plus : v < 0 ? slip_minus : aside != 0 ? aside : together;
}

/* At rest a body that stands alone sticks within the limit of its friction (friction_decide). */
static int decide_single(const struct settling *settling, int pair)
{
    const struct fbd_model *model = settling->state->model;
    struct instant at = state_instant(settling->state);
    int moving = decide_friction(settling, pair);
    if (moving != together) return moving;
    struct friction_values now = friction_at(model, pair, &at, settling->slots);
    struct friction_values rate =
        friction_along(model, pair, &at, settling->slots, settling->flow, settling->slots_along);
    return friction_decide(&now, &rate,
                           settling_slack(settling->state, settling->decided, pair, &now, &rate));
}

/* NULL: set by the time (a drive), or by impacts and tree_settle_holds (a contact). */
static int (*const decide[mode_kinds])(const struct settling *settling,
                                       int pair) = {[mode_single] = decide_single,
                                                    [mode_joint] = decide_friction,
                                                    [mode_tangent] = decide_friction,
                                                    [mode_rope] = decide_one_sided,
                                                    [mode_surface] = decide_one_sided};

/* Set the loaded side of a two-sided guide; false when it has changed and the guide slips. */
static bool settle_pull(const struct settling *settling, int pair)
{
    struct fbd_state *state = settling->state;
    const struct mode *mode = &state->model->plan.modes[pair];
    bool decided = settling->decided && settling->decided->pulls[pair];
    if (!mode->two_sided || mode->kind != mode_single || decided) return true;
    int pull = settling->slots[mode->normal_slot] > 0 ? -1 : 1;
    bool same = pull == state->pull[pair] || state->slip[pair] == stick;
    state->pull[pair] = pull;
    return same;
}

/* Are there modes that forces decide one by one? */
static bool has_singles(const struct fbd_model *model)
{
    for (size_t pair = 0; pair < model->plan.mode_count; pair++)
        if (model->plan.modes[pair].kind == mode_single) return true;
    return false;
}

/* `evaluated`: the forces of the state are those of its branches. `jointly`: constraints have been decided together, or
 * reactions are indeterminate. */
static bool settle_slips(struct fbd_state *state, const struct decided *decided, const struct direction *flow,
                         bool evaluated, bool *jointly)
{
    const struct fbd_model *model = state->model;
    const struct plan *plan = &model->plan;
    struct scratch scratch = state_scratch(state);
    struct settling settling = {state, decided, flow, scratch.slots, scratch.slots_along};
    struct instant at = state_instant(state);
    bool same = true;
    if (at.sliding) sliding_solve_along(model, &at, flow);
    if (has_singles(model)) {
        if (evaluated && !at.sliding && !tree_joins(model->tree))
            memcpy(scratch.slots, state->slots, (size_t)plan->slots * sizeof *scratch.slots);
        else
            force_balance(model, &at, scratch.slots);
        force_balance_along(model, &at, flow, scratch.slots, scratch.slots_along);
    }
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        enum mode_kind kind = plan->modes[pair].kind;
        same = settle_pull(&settling, pair) && same;
        if (!decide[kind] || (decided && decided->slips[pair])) continue;
        int next = decide[kind](&settling, pair);
        if (next == together) continue;
        same = same && state->slip[pair] == next;
        state->slip[pair] = next;
    }
    if (tree_joins(model->tree)) same = tree_settle_holds(state, decided, jointly) && same;
    if (model->tree->plane_count > 0) same = planes_settle(state, decided) && same;
    return same;
}

/* A pass without changes is final, with the forces of its evaluation, as the next one would repeat it; where
 * constraints are decided together, or switches may slide, the second one is. */
static bool settle(struct fbd_state *state, const struct decided *decided)
{
    enum { most_passes = 12, around = 6 };
    const struct plan *plan = &state->model->plan;
    bool first = true;
    state->settled = true;
    if (state->holds.found == holds_no_memory) return false; /* final */
    state->holds = (struct holds_trouble){.found = holds_decided, .pair = -1, .contradicts = -1};
    for (int pass = 0; pass < most_passes; pass++) {
        state_evaluate(state);
        if (plan->kink_count + plan->mode_count == 0) return state->holds.found < holds_none;
        struct direction flow = flow_of(state);
        bool same = settle_branches(state, decided, &flow, pass >= around), jointly = false;
        if (plan->mode_count > 0) same = settle_slips(state, decided, &flow, same, &jointly) && same;
        if (state->holds.found >= holds_none) return false;
        bool final = !jointly && !state->sliding;
        if (same && (!first || final)) {
            if (modes_hold_settling(state) || jointly || state_sliding(state)) state_evaluate(state);
            return state->holds.found < holds_none;
        }
        first = false;
    }
    return false;
}

/* Record sticking friction: if it begins to slip here it is at rest, and its velocity, with either sign, is
 * rounding. */
static void note_rests(struct fbd_state *state)
{
    for (size_t pair = 0; pair < state->model->plan.mode_count; pair++)
        state->slip_rests[pair] = state->slip[pair] == stick;
}

static bool settle_all(struct fbd_state *state, const struct decided *decided)
{
    struct sliding *sliding = state->sliding;
    note_rests(state);
    if (!sliding) return settle(state, decided);
    memset(sliding->aside, 0, state->model->plan.mode_count * sizeof *sliding->aside);
    for (int i = 0; i < state->model->plan.branches; i++)
        sliding->keep[i] = sliding->slide_at[i] > 0 || (decided && decided->branches[i]);
    sliding_keep_rest(state);
    return sliding_settle(state, decided, settle(state, decided), settle);
}

/* The largest force between two links, or of a coupling. */
static double largest_force(const struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    double largest = 0;
    for (int i = 1; i < tree->count; i++) largest = fmax(largest, vec_norm(state->tree->links[i].F.force));
    for (int j = 0; j < tree->row_count; j++) largest = fmax(largest, fabs(state->tree->rows[j].lambda));
    return largest;
}

/* A rope that is taut without tension lets a body without mass move as it likes: with one side of a light pulley
 * the other one becomes slack, since their tensions are equal. Open such ropes if no inertia resists a
 * motion then; the state says so. */
static void release_idle_ropes(struct fbd_state *state)
{
    const double rounding = negligible_sum; /* of the forces */
    const struct plan *plan = &state->model->plan;
    const struct tree *tree = state->model->tree;
    state_evaluate(state);
    const double negligible = rounding * largest_force(state);
    memcpy(state->slip_before, state->slip, plan->mode_count * sizeof *state->slip);
    for (size_t pair = 0; pair < plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        if (mode->kind != mode_rope || state->slip[pair] != stick) continue;
        const int row = tree->couplings[mode->coupling].first_row;
        if (fabs(state->tree->rows[row].lambda) <= negligible) state->slip[pair] = slip_plus;
    }
    state_evaluate(state);
    if (state->tree->unmoved) return;
    memcpy(state->slip, state->slip_before, plan->mode_count * sizeof *state->slip);
    state_evaluate(state);
}

bool modes_settle(struct fbd_state *state, const struct decided *decided)
{
    const struct tree *tree = state->model->tree;
    state->tree->tentative = true;
    const bool settled = settle_all(state, decided);
    state->tree->tentative = false;
    if (settled && tree->massless_count > 0 && state->model->plan.mode_count > 0) release_idle_ropes(state);
    return settled && journals_determined(state);
}
