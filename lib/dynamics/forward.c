/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From forces to accelerations, and their variations.
 *
 * The forces in the joints are summed here, all others by tree_accelerations. With Q the sum of the forces along a
 * coordinate, positive along +q, and N the normal force of a slide:
 *
 *     slips    Q -= slip mu_k |N|, slip = +1 or -1, the sign of the velocity: against the motion
 *     sticks   q'' = s', the acceleration of the surface; the friction is H = m s' - Q (friction.h)
 *
 * On the line of a body that stands alone N does not depend on friction. Between jointed bodies it does, so
 * that both come from one solution.
 *
 * Along a direction (dt, dq, dv, dz) all of this is linear and is varied term by term; a column of the
 * Jacobian is the variation along one component.
 *
 * Checked by the forces of the diagrams, which are computed by other formulas: m a_G and I_G alpha of each
 * body, and by differences of the rates (tests/unit/test_dynamics.c).
 */
#include "dynamics/forward.h"

#include <string.h>

#include "dynamics/sliding.h"
#include "dynamics/state.h"
#include "dynamics/tree.h"
#include "dynamics/user_states.h"
#include "dynamics/world_refs.h"

/* ---- the stages */

void force_balance(const struct fbd_model *model, const struct instant *given, double *slots)
{
    struct instant room;
    const struct instant *at = instant_with_places(model, given, &room);
    force_slots(model, at, slots);
    tree_accelerations(model, at, slots, at->tree->a);
}

void force_balance_of(const struct fbd_model *model, int b, const struct instant *given, double *slots)
{
    if (!model->bodies[b].alone) {
        force_balance(model, given, slots);
        return;
    }
    struct instant room;
    const struct instant *at = instant_with_places(model, given, &room);
    force_slots_alone(model, at, model->bodies[b].place.link, slots);
    tree_accelerate_alone(model, at, model->bodies[b].place.link, slots, at->tree->a);
}

void force_balance_along(const struct fbd_model *model, const struct instant *given,
                         const struct direction *direction, const double *slots, double *slots_along)
{
    struct instant room;
    const struct instant *at = instant_with_places(model, given, &room);
    const struct direction extended_along = direction_extend(model, at, direction), *along = &extended_along;
    force_slots_along(model, at, along, slots_along);
    tree_accelerations_along(model, at, along, slots, at->tree->a, slots_along, at->tree->a_along);
}

/* Does the mode hold a coordinate by sticking? (A rolling body is held by a row.) */
static bool holds_coordinate(const struct plan *plan, const struct instant *at, int pair)
{
    return at->slip[pair] == stick && plan->modes[pair].coupling < 0;
}

void accelerations_at_shares(const struct fbd_model *model, const struct instant *given, double *slots,
                             double *a)
{
    struct instant extended;
    const struct instant *at = instant_with_places(model, given, &extended);
    force_slots(model, at, slots);
    tree_accelerations(model, at, slots, at->tree->a);
    memcpy(a, at->tree->a, (size_t)model->plan.n * sizeof *a);
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++)
        if (holds_coordinate(&model->plan, at, pair))
            friction_surface_speed(&model->plan.modes[pair], at, &a[model->plan.modes[pair].coordinate]);
}

void accelerations(const struct fbd_model *model, const struct instant *at, double *slots, double *a)
{
    if (at->sliding) sliding_solve(model, at);
    accelerations_at_shares(model, at, slots, a);
    if (at->sliding) sliding_clear_rounding(model, at, a);
}

/* Right after force_balance at the same instant, which is extended. */
static void vary_balance(const struct fbd_model *model, const struct instant *at,
                         const struct direction *direction, double *slots, double *slots_along,
                         double *a_along)
{
    const struct plan *plan = &model->plan;
    const struct direction extended_along = direction_extend(model, at, direction), *along = &extended_along;
    force_balance_along(model, at, along, slots, slots_along);
    memcpy(a_along, at->tree->a_along, (size_t)plan->n * sizeof *a_along);
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        if (!holds_coordinate(plan, at, pair)) continue;
        const struct mode *mode = &plan->modes[pair];
        double jerk = friction_surface_jerk(mode, at);
        a_along[mode->coordinate] = jerk * along->dt;
    }
}

void accelerations_along_at_shares(const struct fbd_model *model, const struct instant *given,
                                   const struct direction *direction, double *slots, double *slots_along,
                                   double *a_along)
{
    const struct instant at = instant_extend(model, given);
    force_balance(model, &at, slots);
    vary_balance(model, &at, direction, slots, slots_along, a_along);
}

void accelerations_along(const struct fbd_model *model, const struct instant *at,
                         const struct direction *along, double *slots, double *slots_along, double *a_along)
{
    if (at->sliding) {
        sliding_solve(model, at);
        sliding_solve_along(model, at, along);
    }
    accelerations_along_at_shares(model, at, along, slots, slots_along, a_along);
    if (at->sliding) sliding_clear_rounding_along(model, at, a_along);
}

void state_rates(const struct fbd_model *model, const struct instant *at, double *slots, double *dydt)
{
    const struct plan *plan = &model->plan;
    size_t n = (size_t)plan->n;
    memcpy(dydt, at->y + n, n * sizeof *dydt);
    accelerations(model, at, slots, dydt + n);
    double acceleration;
    for (int pair = 0; pair < (int)plan->mode_count; pair++)
        if (holds_coordinate(plan, at, pair))
            dydt[plan->modes[pair].coordinate] =
                friction_surface_speed(&plan->modes[pair], at, &acceleration);
}

/* The variation of accelerations along a direction; for sliding modes with a new solution of the weights each
 * time. */
typedef void vary_function(const struct fbd_model *model, const struct instant *at,
                           const struct direction *along, double *slots, double *slots_along,
                           double *a_along);

void state_jacobian(const struct fbd_model *model, const struct instant *given, double *scratch, double *dfdy,
                    double *dfdt)
{
    const struct plan *plan = &model->plan;
    const struct instant extended = instant_extend(model, given), *at = &extended;
    vary_function *vary = at->sliding ? accelerations_along : vary_balance;
    size_t n = (size_t)plan->n, size = plan_size(plan);
    struct scratch of = scratch_of(plan, scratch);
    double *slots = of.slots, *slots_along = of.slots_along, *dy = of.dy, *column = of.column;
    memset(dfdy, 0, size * size * sizeof *dfdy);
    memset(dy, 0, size * sizeof *dy);
    if (!at->sliding) force_balance(model, at, slots); /* once for all directions */
    for (size_t j = 0; j < size; j++) {
        struct direction along = {.dy = dy};
        dy[j] = 1;
        vary(model, at, &along, slots, slots_along, column);
        if (plan->own > 0) user_state_rates_along(model, at, &along, column + n);
        dy[j] = 0;
        for (size_t i = 0; i < size - n; i++) dfdy[(n + i) * size + j] = column[i];
        if (j >= n && j < 2 * n) dfdy[(j - n) * size + j] = 1;
    }
    struct direction in_time = {.dt = 1, .dy = dy};
    memset(dfdt, 0, n * sizeof *dfdt);
    vary(model, at, &in_time, slots, slots_along, dfdt + n);
    if (plan->own > 0) user_state_rates_along(model, at, &in_time, dfdt + 2 * n);
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        if (!holds_coordinate(plan, at, pair)) continue;
        size_t i = (size_t)plan->modes[pair].coordinate;
        dfdy[i * size + n + i] = 0;
        friction_surface_speed(&plan->modes[pair], at, &dfdt[i]);
    }
}

void state_held_slopes(const struct fbd_model *model, const struct instant *at, double *scratch,
                       const double *held, double *dfdu)
{
    const struct plan *plan = &model->plan;
    const struct scratch of = scratch_of(plan, scratch);
    const size_t n = (size_t)plan->n;
    const struct direction along = {.dy = of.dy, .held = held};
    memset(of.dy, 0, plan_size(plan) * sizeof *of.dy);
    memset(dfdu, 0, n * sizeof *dfdu);
    accelerations_along(model, at, &along, of.slots, of.slots_along, dfdu + n);
    if (plan->own > 0) user_state_rates_along(model, at, &along, dfdu + 2 * n);
}
