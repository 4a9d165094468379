/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Error scales of components that start from zero.
 */
#include <float.h>
#include <gsl/gsl_errno.h>
#include <string.h>

#include "loop/error_scale_init.h"

#include "dynamics/constraint.h"
#include "dynamics/tree_bare.h"
#include "dynamics/tree_system.h"
#include "dynamics/user_states.h"
#include "loop/run.h"
#include "model/coupling.h"
#include "numeric/tolerances.h"

/* The acceleration of coordinate i (or the rate of a user state), or its change within the time tau where
 * that is larger, since drives start without an acceleration. A change below the round-off level of the
 * acceleration is ignored. */
static double starting(const struct run *run, size_t i, double tau)
{
    double a = run->state->a[i], later = tau * run->roundoff.along[i];
    bool changes = isfinite(later) && fabs(later) > fmax(fabs(a), run->roundoff.accelerations[i]);
    return changes ? later : a;
}

/* Does it not start, or by rounding only? Such a number changes from state to state, and lasts for no time. */
static bool starts_by_rounding(const struct run *run, size_t i, double a)
{
    return fabs(a) <= run->roundoff.accelerations[i];
}

static void vary(struct run *run, const struct instant *at, const double *dy, double *along)
{
    struct scratch scratch = state_scratch(run->state);
    const struct direction direction = {.dy = dy};
    accelerations_along(run->model, at, &direction, scratch.slots, scratch.slots_along, along);
    if (run->model->plan.own > 0)
        user_state_rates_along(run->model, at, &direction, along + run->model->plan.n);
}

/* ---- the time for which each acceleration, and rate of a user state, keeps its initial size */

/* Accelerations, and rates of user states, at another time or state; false where they are not finite. */
static bool accelerations_there(const struct run *run, double t, const double *y, double *f)
{
    const gsl_odeiv2_system *system = &run->system.inner;
    return system->function(t, y, f, system->params) == GSL_SUCCESS;
}

/* Forces may decay or change sign as functions of time: a force of 1 kN that falls with (t + 1 us)^-2 moves 1
 * kg at 1e-3 m/s, not at 100 m/s, after a tenth of a second. `along` is the derivative by time alone. */
static void end_with_forces(struct run *run, double tau, double *times)
{
    const double most = 0.75;
    const size_t n = (size_t)run->model->plan.n, rates = (size_t)plan_rates(&run->model->plan);
    double *f = run->work.sample;
    double t = tau;
    bool ends = !tree_is_bare(run->model);
    while (ends && run->state->t + t > run->state->t) {
        ends = false;
        bool known = accelerations_there(run, run->state->t + t, run->state->y, f);
        for (size_t i = 0; i < rates; i++) {
            double a = starting(run, i, t);
            if (times[i] < t || starts_by_rounding(run, i, a) ||
                (known && fabs(f[n + i] - a) <= most * fabs(a)))
                continue;
            times[i] = t / 2;
            ends = true;
        }
        t /= 2;
    }
}

/* Springs and dampers reverse the acceleration when its effect on positions and speeds changes it by as much
 * as itself: a spring of 3e8 N/m whose end moves at 0.4 m/s would otherwise give a block of 0.2 kg a speed of
 * 10 km/s in 4 ms. */
static void end_with_springs(struct run *run, const struct instant *at, double *times)
{
    const struct plan *plan = &run->model->plan;
    const size_t n = (size_t)plan->n, size = plan_size(plan), rates = (size_t)plan_rates(plan);
    double *dy = run->work.sample, *by_place = run->work.aside, *by_speed = by_place + size;
    memset(dy, 0, size * sizeof *dy);
    for (size_t i = 0; i < n; i++)
        dy[i] = times[i] * (run->state->y[n + i] + times[i] * starting(run, i, times[i]));
    vary(run, at, dy, by_place);
    memset(dy, 0, n * sizeof *dy);
    for (size_t i = 0; i < rates; i++) dy[n + i] = times[i] * starting(run, i, times[i]);
    vary(run, at, dy, by_speed);
    for (size_t i = 0; i < rates; i++) {
        double a = fabs(starting(run, i, times[i])), springs = sqrt(fabs(by_place[i]) / a),
               dampers = fabs(by_speed[i]) / a;
        double share = fmax(isfinite(springs) ? springs : 0, isfinite(dampers) ? dampers : 0);
        times[i] /= fmax(1, share);
    }
}

/* The state with the displacements and velocities reached in these times. */
static void set_off(const struct run *run, const double *times, double *y)
{
    const size_t n = (size_t)run->model->plan.n, rates = (size_t)plan_rates(&run->model->plan);
    memcpy(y, run->state->y, plan_size(&run->model->plan) * sizeof *y);
    for (size_t i = 0; i < rates; i++) {
        double tau = times[i], gain = tau * starting(run, i, tau);
        if (i < n) y[i] += tau * (y[n + i] + gain);
        y[n + i] += gain;
    }
}

/* The estimate before is linear. A spring that stiffens, or quadratic drag, has no effect on it at the start:
 * halve the times until accelerations change by no more than twice their size. */
static void end_with_bends(struct run *run, double *times)
{
    enum { most_halvings = 60 };
    const double most = 2;
    const size_t n = (size_t)run->model->plan.n, rates = (size_t)plan_rates(&run->model->plan);
    double *y = run->work.aside, *f = run->work.sample;
    bool bent = true;
    for (int halving = 0; bent && halving < most_halvings; halving++) {
        bent = false;
        set_off(run, times, y);
        bool known = accelerations_there(run, run->state->t, y, f);
        for (size_t i = 0; i < rates; i++) {
            double a = starting(run, i, times[i]);
            if (starts_by_rounding(run, i, a) || (known && fabs(f[n + i] - a) <= most * fabs(a))) continue;
            times[i] /= 2;
            bent = true;
        }
    }
}

/* Sizes of a coordinate and its rate after a short time, and the arm that converts an angle to a length: the
 * radius of gyration of a turning body. */
struct motion_size {
    double place, rate, arm;
};

static struct motion_size motion_size(const struct run *run, const struct model_body *body, int k,
                                      const double *times)
{
    int i = body->first + k;
    double tau = times[i], v = fabs(run->state->y[i + run->model->plan.n]),
           a = fabs(starting(run, (size_t)i, tau));
    double arm =
        coordinate_is_angle(body, k) ? 1 / sqrt(run->model->plan.inverse_inertia[i] * body->inertia.mass) : 1;
    return (struct motion_size){v * tau + a * tau * tau, fmax(v, a * tau), arm};
}

/* The largest of all, as lengths and speeds: from present velocities, or from accelerations if all velocities
 * are zero, since near singular positions accelerations overestimate the motion by far. */
static struct motion_size largest_motion(const struct run *run, const double *times)
{
    const int n = run->model->plan.n;
    struct motion_size all = {.arm = 1};
    bool moves = false;
    for (int i = 0; i < n; i++) moves |= run->state->y[n + i] != 0;
    for (size_t b = 0; b < run->model->body_count; b++) {
        const struct model_body *body = &run->model->bodies[b];
        for (int k = 0; k < body->count; k++) {
            struct motion_size one = motion_size(run, body, k, times);
            double tau = times[body->first + k];
            double v = fabs(run->state->y[n + body->first + k]);
            if (!isfinite(one.arm)) continue;
            if (moves) one.place = v * tau, one.rate = v;
            if (!moves && !(one.rate > tau * run->roundoff.accelerations[body->first + k]))
                continue; /* it rests */
            all.place = fmax(all.place, one.place * one.arm);
            all.rate = fmax(all.rate, one.rate * one.arm);
        }
    }
    return all;
}

/* Couplings are projected to the rounding of a radian, or of the size of the scene: the scale whose allowed
 * error is that. */
static double unseen_place(const struct run *run, const struct model_body *body, int k)
{
    const struct tree *tree = run->model->tree;
    double reach = 0;
    for (int i = 1; i < tree->joined; i++) reach = fmax(reach, vec_norm(run->state->tree->links[i].p));
    for (int i = 0; i < tree->coupling_count; i++) reach = fmax(reach, coupling_extent(&tree->couplings[i]));
    return round_off(1, 1) / run->options.tolerance * (coordinate_is_angle(body, k) ? 1 : reach);
}

/* A coordinate or rate that is exactly zero has no scale for its error, and a method of low order needs one
 * (Euler's first step from rest has an error as large as the displacement). The scale is the displacement by
 * the acceleration in a thousandth of the run, limited to the time for which the acceleration lasts
 * (end_with_forces and the functions after it): a force that is switched on may be large and short, and a
 * stiff spring reverses it. In a row of blocks on springs, the block farthest from the force starts as a high
 * power of time, or by rounding, which no step resolves relative to its size: components below a billionth of
 * the largest motion have that as their scale. */
static void set_floors(struct run *run, double tau, const double *times)
{
    const struct tree *tree = run->model->tree;
    /* Touching bodies rest or separate by roundings of their gaps: each keeps its own scale. */
    const double negligible = tree && tree->meeting_count > 0 ? 0 : undecided_part;
    struct motion_size all = largest_motion(run, times);
    for (size_t b = 0; b < run->model->body_count; b++) {
        const struct model_body *body = &run->model->bodies[b];
        for (int k = 0; k < body->count; k++) {
            size_t position = (size_t)body->first + (size_t)k, rate = position + (size_t)run->model->plan.n;
            struct motion_size own = motion_size(run, body, k, times);
            bool sized = own.arm > 0 && isfinite(own.arm); /* a driven body may have no mass */
            double place = sized ? negligible * all.place / own.arm : 0;
            double speed = sized ? negligible * all.rate / own.arm : 0;
            run->roundoff.nothing[position] = fmax(run->roundoff.nothing[position], place);
            run->roundoff.nothing[rate] = fmax(run->roundoff.nothing[rate], speed);
            if (run->state->y[position] == 0) place = fmax(place, own.place);
            if (run->state->y[rate] == 0) speed = fmax(speed, own.rate);
            if (tree && tree->row_count > 0 && tree->meeting_count == 0) {
                /* Couplings hold coordinates to this accuracy; a load may begin from zero. */
                double held = unseen_place(run, body, k);
                if (run->state->y[position] == 0) place = fmax(place, held);
                if (run->state->y[rate] == 0) speed = fmax(speed, held / tau);
            }
            switcher_set_floor(run->stepper, position, place);
            switcher_set_floor(run->stepper, rate, speed);
        }
    }
}

/* Is there a number that is zero, or at round-off level of the largest? */
static bool any_is_small(const struct run *run)
{
    const int n = run->model->plan.n;
    double most = 0, least = INFINITY;
    for (int i = 0; i < 2 * n; i++) {
        most = fmax(most, fabs(run->state->y[i]));
        least = fmin(least, fabs(run->state->y[i]));
    }
    return n > 0 && least <= round_off(1, most);
}

/* The same for a user state that starts from zero. */
static void set_own_floor(struct run *run, int i, const double *times)
{
    const struct plan *plan = &run->model->plan;
    size_t state = 2 * (size_t)plan->n + (size_t)i, rate = (size_t)plan->n + (size_t)i;
    double tau = times[rate], change = fabs(run->roundoff.along[rate]);
    if (run->state->y[state] != 0) return;
    switcher_set_floor(run->stepper, state,
                       tau * fabs(run->state->a[rate]) + (isfinite(change) ? tau * tau * change : 0));
}

void error_scale_init(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    bool coordinates = any_is_small(run), own = false;
    for (int i = 2 * plan->n; i < (int)plan_size(plan); i++) own |= run->state->y[i] == 0;
    if (!coordinates && !own) return;
    const double share = 1e-3, tau = share * run_time_to_switch(run);
    double *times = run->work.kept;
    for (size_t i = 0; i < plan_rates(plan); i++) times[i] = tau;
    end_with_forces(run, tau, times); /* `along` is the derivative by time alone here */
    struct instant at = state_instant(run->state);
    roundoff_changes(run, &at, false, run->roundoff.along);
    end_with_springs(run, &at, times);
    end_with_bends(run, times);
    if (coordinates) set_floors(run, tau, times);
    for (int i = 0; i < plan->own; i++) set_own_floor(run, i, times);
}
