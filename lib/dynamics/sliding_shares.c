/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The surfaces of sliding modes, and the weights that keep the motion on them.
 */
#include "dynamics/sliding.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/forward.h"
#include "dynamics/modes.h"
#include "dynamics/state.h"
#include "dynamics/tree.h"
#include "dynamics/user_states.h"
#include "dynamics/world_refs.h"
#include "numeric/tolerances.h"

/* ---- the surfaces */

/* u of a switch, and its rate along (dt, dy). */
static double switching(struct sliding *s, const struct fbd_model *model, const struct instant *given,
                        const struct kink *kink, int part, double dt, const double *dy, double *rate)
{
    const struct instant at = instant_extend(model, given);
    const struct direction own = {.dt = dt, .dy = dy}, along = direction_extend(model, &at, &own);
    expr_switchings(kink->formula.expr, at.t, at.y, along.dt, along.dy, at.branch + kink->formula.branch,
                    s->u, s->rate, s->rounding);
    *rate = s->rate[part];
    return s->u[part];
}

double sliding_watched(struct sliding *s, const struct fbd_model *model, const struct instant *given,
                       const struct kink *kink, int part)
{
    double unused;
    return switching(s, model, given, kink, part, 0, s->zero, &unused);
}

double sliding_rounding(const struct fbd_state *state, const struct kink *kink, int part)
{
    const struct instant given = state_instant(state), at = instant_extend(state->model, &given);
    double *u = calloc(3 * kink->count, sizeof *u); /* the state has no room for non-sliding switches */
    if (!u) return 0;
    double *rates = u + kink->count, *roundings = rates + kink->count;
    expr_switchings(kink->formula.expr, at.t, at.y, 0, NULL, at.branch + kink->formula.branch, u, rates,
                    roundings);
    double rounding = roundings[part];
    free(u);
    return rounding;
}

double sliding_surface(struct sliding *s, const struct fbd_model *model, const struct instant *given,
                       const struct kink *kink, int part)
{
    double rate;
    size_t n = (size_t)model->plan.n;
    memcpy(s->moved, given->y + n, n * sizeof *s->moved);
    double u = switching(s, model, given, kink, part, 0, s->moved, &rate);
    return kink_watches_places(kink, part) ? rate : u;
}

double sliding_surface_rate(struct sliding *s, const struct fbd_model *model, const struct instant *given,
                            const struct kink *kink, int part, double dt, const double *dy)
{
    double rate;
    size_t n = (size_t)model->plan.n;
    if (kink_watches_places(kink, part)) {
        memcpy(s->moved, dy + n, n * sizeof *s->moved);
        switching(s, model, given, kink, part, 0, s->moved, &rate);
    } else {
        switching(s, model, given, kink, part, dt, dy, &rate);
    }
    return rate;
}

/* The first switch of a unit defines the surface. */
void sliding_rates(const struct fbd_model *model, const struct instant *given, double dt, const double *dy,
                   double *rates)
{
    struct sliding *s = given->sliding;
    for (int j = s->count - 1; j >= 0; j--) {
        const struct slide *slide = &s->slides[j];
        rates[slide->unit] =
            sliding_surface_rate(s, model, given, &model->plan.kinks[slide->kink], slide->part, dt, dy);
    }
}

/* The values of the surfaces, one for each unit. Zero within rounding is set to zero: a projection would move
 * a body at rest off its surface of friction. */
static void surfaces(struct sliding *s, const struct fbd_model *model, const struct instant *given,
                     double *values)
{
    for (int j = s->count - 1; j >= 0; j--) {
        const struct slide *slide = &s->slides[j];
        double u = sliding_surface(s, model, given, &model->plan.kinks[slide->kink], slide->part);
        values[slide->unit] = !slide->places && fabs(u) <= s->rounding[slide->part] ? 0 : u;
    }
}

/* ---- the small system M x = r, by elimination with pivots */

static void factor(struct sliding *s)
{
    int m = s->units;
    memcpy(s->lu, s->M, (size_t)(m * m) * sizeof *s->lu);
    s->failed = false;
    for (int k = 0; k < m; k++) {
        int best = k;
        for (int i = k + 1; i < m; i++)
            if (fabs(s->lu[i * m + k]) > fabs(s->lu[best * m + k])) best = i;
        s->pivot[k] = best;
        double before = 0;
        for (int j = 0; j < m; j++) before = fmax(before, fabs(s->M[j * m + k]));
        if (!(fabs(s->lu[best * m + k]) > negligible_sum * before)) {
            s->failed = true;
            return;
        }
        for (int j = 0; best != k && j < m; j++) {
            double swap = s->lu[k * m + j];
            s->lu[k * m + j] = s->lu[best * m + j];
            s->lu[best * m + j] = swap;
        }
        for (int i = k + 1; i < m; i++) {
            double f = s->lu[i * m + k] /= s->lu[k * m + k];
            for (int j = k + 1; j < m; j++) s->lu[i * m + j] -= f * s->lu[k * m + j];
        }
    }
}

static void solve(const struct sliding *s, double *x)
{
    int m = s->units;
    for (int k = 0; k < m; k++) {
        double swap = x[k];
        x[k] = x[s->pivot[k]];
        x[s->pivot[k]] = swap;
    }
    for (int k = 0; k < m; k++)
        for (int i = k + 1; i < m; i++) x[i] -= s->lu[i * m + k] * x[k];
    for (int k = m - 1; k >= 0; k--) {
        for (int j = k + 1; j < m; j++) x[k] -= s->lu[k * m + j] * x[j];
        x[k] /= s->lu[k * m + k];
    }
}

/* ---- weights */

static void set_shares(struct sliding *s)
{
    for (int j = 0; j < s->count; j++) {
        s->slides[j].share = 0.5 + s->slides[j].sign * s->delta[s->slides[j].unit];
        s->slides[j].along = 0;
    }
}

bool sliding_is_friction_of(const struct sliding *s, const struct mode *mode, int coordinate)
{
    if (!mode_is_joint_friction(mode)) return false;
    return mode->coordinate == coordinate ||
           (!mode->moving && s->with[mode->coordinate] == s->with[coordinate]);
}

int sliding_holder(const struct sliding *s, const struct fbd_model *model, const struct instant *at,
                   int coordinate)
{
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++)
        if (at->slip[pair] == stick && sliding_is_friction_of(s, &model->plan.modes[pair], coordinate))
            return pair;
    return -1;
}

int sliding_rest(const struct sliding *s, const struct fbd_model *model, const struct instant *at,
                 int coordinate)
{
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++)
        if (sliding_is_friction_of(s, &model->plan.modes[pair], coordinate) &&
            slip_velocity(model, pair, at) == 0)
            return pair;
    return -1;
}

/* Find the friction that keeps the coordinates of a surface at rest. If there is one coordinate, the switch
 * provides the holding force: its weight is that for which friction is zero. Of several the weight is 1/2,
 * and each friction provides the rest. As soon as one coordinate is free, the equation is that of the
 * surface. */
static int held_coordinate(const struct fbd_model *model, const struct instant *at, int unit)
{
    struct sliding *s = at->sliding;
    int n = model->plan.n, first = 0, count = 0, held = not_held;
    while (s->slides[first].unit != unit) first++;
    const struct kink *kink = &model->plan.kinks[s->slides[first].kink];
    memset(s->flow, 0, plan_size(&model->plan) * sizeof *s->flow);
    for (int i = 0; i < n; i++) {
        s->flow[n + i] = 1;
        double slope = sliding_surface_rate(s, model, at, kink, s->slides[first].part, 0, s->flow);
        s->flow[n + i] = 0;
        if (slope == 0) continue;
        int holder = sliding_holder(s, model, at, i);
        if (holder < 0) return not_held;
        held = model->plan.modes[holder].hold_slot;
        count++;
    }
    return count > 1 ? all_held : held;
}

int sliding_parted(const struct fbd_model *model, const struct instant *given, const struct kink *kink,
                   int part)
{
    static const double later[] = {1e-6, 1e-3, 0.1, 3.7}; /* s, incommensurate with usual periods */
    struct sliding *s = given->sliding;
    size_t n = (size_t)model->plan.n, size = plan_size(&model->plan);
    for (size_t k = 0; k < sizeof later / sizeof *later; k++) {
        struct instant at = *given;
        double speeds = 0, acceleration;
        memcpy(s->shifted, given->y, size * sizeof *s->shifted);
        at.t += later[k];
        for (size_t i = 0; i < n; i++) {
            memset(s->flow, 0, size * sizeof *s->flow);
            s->flow[n + i] = 1;
            double slope = sliding_surface_rate(s, model, given, kink, part, 0, s->flow);
            int holder = slope == 0 ? -1 : sliding_holder(s, model, &at, (int)i);
            if (holder >= 0)
                s->shifted[n + i] = friction_surface_speed(&model->plan.modes[holder], &at, &acceleration);
            speeds += fabs(slope * s->shifted[n + i]);
        }
        for (size_t i = 0; i < n; i++) s->shifted[i] += later[k] * (given->y[n + i] + s->shifted[n + i]) / 2;
        at.y = s->shifted;
        double u = sliding_surface(s, model, &at, kink, part);
        if (fabs(u) > undecided_part * speeds) return u > 0 ? 1 : -1;
    }
    return 0;
}

static void find_held(const struct fbd_model *model, const struct instant *at)
{
    struct sliding *s = at->sliding;
    for (int unit = 0; unit < s->units; unit++) s->held[unit] = held_coordinate(model, at, unit);
}

/* For a unit with one held coordinate replace the rate of its surface by the force of the friction; with
 * several, by the deviation of the weight from 1/2, `off`. */
static void put_held(const struct sliding *s, const double *slots, const double *off, double *rates)
{
    for (int unit = 0; unit < s->units; unit++) {
        if (s->held[unit] >= 0) rates[unit] = slots[s->held[unit]];
        if (s->held[unit] == all_held) rates[unit] = off ? off[unit] : 0;
    }
}

/* Set the direction of motion from the accelerations in the scratch. */
static void take_flow(const struct fbd_model *model, const struct instant *at)
{
    struct sliding *s = at->sliding;
    size_t n = (size_t)model->plan.n;
    memcpy(s->flow, at->y + n, n * sizeof *s->flow);
    memcpy(s->flow + n, s->a, n * sizeof *s->flow);
    if (model->plan.own > 0) user_state_rates(model, at, s->flow + 2 * n);
}

/* c: the rates of the surfaces at the present weights. */
static void residuals(const struct fbd_model *model, const struct instant *at)
{
    struct sliding *s = at->sliding;
    accelerations_at_shares(model, at, s->slots, s->a);
    take_flow(model, at);
    sliding_rates(model, at, 1, s->flow, s->c);
    put_held(s, s->slots, s->delta, s->c);
}

/* The response of the accelerations to the weight of each unit, and of the surfaces to these. */
static void responses(const struct fbd_model *model, const struct instant *at)
{
    struct sliding *s = at->sliding;
    size_t n = (size_t)model->plan.n;
    const struct direction none = {.dy = s->zero};
    for (int unit = 0; unit < s->units; unit++) {
        for (int j = 0; j < s->count; j++)
            s->slides[j].along = s->slides[j].unit == unit ? s->slides[j].sign : 0;
        accelerations_along_at_shares(model, at, &none, s->slots, s->slots_along, s->a_along);
        memset(s->flow, 0, plan_size(&model->plan) * sizeof *s->flow);
        memcpy(s->flow + n, s->a_along, n * sizeof *s->flow);
        memcpy(s->B + (size_t)unit * n, s->a_along, n * sizeof *s->B);
        sliding_rates(model, at, 0, s->flow, s->step);
        put_held(s, s->slots_along, NULL, s->step);
        if (s->held[unit] == all_held) s->step[unit] = 1;
        for (int i = 0; i < s->units; i++) s->M[i * s->units + unit] = s->step[i];
    }
    for (int j = 0; j < s->count; j++) s->slides[j].along = 0;
    factor(s);
}

/* Starts from 1/2 always, so that the result depends on the instant only. */
void sliding_solve(const struct fbd_model *model, const struct instant *at)
{
    enum { most_steps = 12 };
    struct sliding *s = at->sliding;
    assert(s); /* called in sliding modes only */
    memset(s->delta, 0, (size_t)s->units * sizeof *s->delta);
    set_shares(s);
    find_held(model, at);
    for (int step = 0; step < most_steps; step++) {
        residuals(model, at);
        if (step != 1) responses(model, at); /* affine: the second step corrects rounding of the first */
        if (s->failed) return;
        solve(s, s->c);
        double largest = 0;
        for (int k = 0; k < s->units; k++) {
            s->delta[k] -= s->c[k];
            largest = fmax(largest, fabs(s->c[k]));
        }
        set_shares(s);
        if (!(largest > round_off(4, 1))) return;
        if (step > 0 && largest < evaluation_rounding) return;
    }
}

void sliding_answer(const struct sliding *s, double *rates)
{
    for (int unit = 0; unit < s->units; unit++) rates[unit] = s->held[unit] == not_held ? -rates[unit] : 0;
    solve(s, rates);
}

void sliding_shift(struct sliding *s, int unit, double by)
{
    for (int j = 0; j < s->count; j++)
        if (s->slides[j].unit == unit) s->slides[j].share += s->slides[j].sign * by;
}

/* Set accelerations to zero that are within the rounding of their parts, by the weights of switches and by
 * couplings. */
static void clear_rounding(const struct fbd_model *model, const struct instant *at, bool along, double *a)
{
    const double rounding = round_off(8, model->tree->joined);
    const struct sliding *s = at->sliding;
    const double *coupled = tree_joins(model->tree) ? tree_rounding(model, at, along) : NULL;
    for (int i = 0; i < model->plan.n && !s->failed; i++) {
        double reach = 0;
        for (int unit = 0; unit < s->units; unit++) {
            double own = fabs(s->B[(size_t)unit * (size_t)model->plan.n + (size_t)i]);
            reach += along ? own * fabs(s->c[unit]) : own;
        }
        if (fabs(a[i]) <= rounding * reach + (coupled ? coupled[i] : 0)) a[i] = 0;
    }
}

void sliding_clear_rounding(const struct fbd_model *model, const struct instant *at, double *a)
{
    clear_rounding(model, at, false, a);
}

void sliding_clear_rounding_along(const struct fbd_model *model, const struct instant *at, double *a_along)
{
    clear_rounding(model, at, true, a_along);
}

/* Move an instant by h along a direction. */
static void shift(struct sliding *s, const struct fbd_model *model, const struct direction *along, double h,
                  const struct instant *at, struct instant *beside)
{
    for (size_t i = 0; i < plan_size(&model->plan); i++) s->shifted[i] = at->y[i] + h * along->dy[i];
    beside->y = s->shifted;
    beside->t = at->t + h * along->dt;
    if (!along->held) return;
    for (size_t i = 0; i < model->scene->parameter_count; i++)
        s->shifted_held[i] = at->held[i] + h * along->held[i];
    beside->held = s->shifted_held;
}

static double size_of_direction(const struct fbd_model *model, const struct direction *along)
{
    double size = fabs(along->dt);
    for (size_t i = 0; i < plan_size(&model->plan); i++) size = fmax(size, fabs(along->dy[i]));
    for (size_t i = 0; along->held && i < model->scene->parameter_count; i++)
        size = fmax(size, fabs(along->held[i]));
    return size;
}

/* D^2 u [f, d] for the motion f: the change of the rates with position, by central differences; exactly zero
 * for affine u, the usual case. */
static void add_curvature(const struct fbd_model *model, const struct instant *at,
                          const struct direction *along, double *sum)
{
    struct sliding *s = at->sliding;
    double size = size_of_direction(model, along), place = 1 + fabs(at->t);
    if (size == 0) return;
    double h = 1e-5 * place / size;
    struct instant beside = *at;
    for (int side = 1; side >= -1; side -= 2) {
        shift(s, model, along, side * h, at, &beside);
        sliding_rates(model, &beside, 1, s->flow, s->step);
        for (int k = 0; k < s->units; k++) sum[k] += side * s->step[k] / (2 * h);
    }
}

void sliding_solve_along(const struct fbd_model *model, const struct instant *given,
                         const struct direction *direction)
{
    struct sliding *s = given->sliding;
    size_t n = (size_t)model->plan.n;
    for (int j = 0; j < s->count; j++) s->slides[j].along = 0;
    if (s->failed) return;
    /* Both may be in the extended vectors, which functions below overwrite. */
    size_t size = plan_size(&model->plan);
    memcpy(s->own_y, given->y, size * sizeof *s->own_y);
    memcpy(s->own_dy, direction->dy, size * sizeof *s->own_dy);
    struct instant at = *given;
    at.y = s->own_y;
    const struct direction along = {direction->dt, s->own_dy, direction->held};
    accelerations_along_at_shares(model, &at, &along, s->slots, s->slots_along, s->a_along);
    memcpy(s->flow, along.dy + n, n * sizeof *s->flow);
    memcpy(s->flow + n, s->a_along, n * sizeof *s->flow);
    if (model->plan.own > 0) user_state_rates_along(model, &at, &along, s->flow + 2 * n);
    sliding_rates(model, &at, 0, s->flow, s->c);
    put_held(s, s->slots_along, NULL, s->c);
    accelerations_at_shares(model, &at, s->slots, s->a);
    take_flow(model, &at);
    add_curvature(model, &at, &along, s->c);
    solve(s, s->c);
    for (int j = 0; j < s->count; j++) s->slides[j].along = -s->slides[j].sign * s->c[s->slides[j].unit];
    const struct instant extended = instant_extend(model, &at);
    direction_extend(model, &extended, &along);
}

/* ---- projection onto the surfaces */

/* Remove the velocities across the surfaces. A remainder within rounding is set to zero. */
static void project_velocities(struct fbd_state *state, bool settling)
{
    struct sliding *s = state->sliding;
    const struct instant at = state_instant(state);
    size_t n = (size_t)state->model->plan.n;
    double *v = state->y + n;
    for (size_t i = 0; i < n; i++) {
        if (settling && sliding_rest(s, state->model, &at, (int)i) >= 0) continue;
        double before = v[i];
        for (int unit = 0; unit < s->units; unit++) v[i] -= s->B[(size_t)unit * n + i] * s->c[unit];
        if (fabs(v[i]) <= evaluation_rounding * fabs(before)) v[i] = 0;
    }
}

/* Along the accelerations by the unit's weight, one slide after the other. */
static void project_places(struct fbd_state *state)
{
    struct sliding *s = state->sliding;
    size_t n = (size_t)state->model->plan.n;
    for (int j = 0; j < s->count; j++) {
        const struct slide *slide = &s->slides[j];
        const struct kink *kink = &state->model->plan.kinks[slide->kink];
        const double *B = s->B + (size_t)slide->unit * n;
        const struct instant at = state_instant(state);
        double unused;
        if (!slide->places || s->held[slide->unit] != not_held) continue;
        memset(s->flow, 0, plan_size(&state->model->plan) * sizeof *s->flow);
        memcpy(s->flow + n, B, n * sizeof *B);
        double reach = sliding_surface_rate(s, state->model, &at, kink, slide->part, 0, s->flow);
        double u = switching(s, state->model, &at, kink, slide->part, 0, s->zero, &unused);
        for (size_t i = 0; i < n; i++) state->y[i] -= B[i] * u / reach;
    }
}

void sliding_project(struct fbd_state *state, bool settling)
{
    enum { passes = 2 }; /* the second for rounding, and for nonlinear u */
    struct sliding *s = state->sliding;
    for (int pass = 0; pass < passes; pass++) {
        struct instant at = state_instant(state);
        sliding_solve(state->model, &at);
        if (s->failed) return;
        surfaces(s, state->model, &at, s->c);
        for (int unit = 0; unit < s->units; unit++)
            if (s->held[unit] != not_held) s->c[unit] = 0;
        solve(s, s->c);
        project_velocities(state, settling);
        project_places(state);
    }
}
