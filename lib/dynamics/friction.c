/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/friction.h"

#include "dynamics/constraint_view.h"
#include "numeric/tolerances.h"

double friction_surface_speed(const struct mode *mode, const struct instant *at, double *acceleration)
{
    *acceleration = 0;
    if (mode->kind == mode_drive) {
        double speed, same;
        if (!mode->position.expr) return 0;
        expr_eval_second(mode->position.expr, at->t, at->y, 0, 0, formula_branches(&mode->position, at),
                         &speed, &same, acceleration);
        return speed;
    }
    if (!mode->surface_speed.expr) return mode->surface_speed.constant;
    return expr_eval_slot(mode->surface_speed.expr, at->t, at->y, 0,
                          formula_branches(&mode->surface_speed, at), acceleration);
}

double friction_coefficient(const struct fbd_model *model, int pair, const struct formula *mu,
                            const struct instant *at, const struct direction *along, double *variation)
{
    int coupling = model->plan.modes[pair].coupling;
    if (coupling < 0 && !mu->expr) { /* a number, in most scenes */
        if (variation) *variation = 0;
        return mu->constant;
    }
    double d_mu = 0, d_wrap, value = along ? formula_along(mu, at, along, &d_mu) : formula_value(mu, at);
    if (variation) *variation = d_mu;
    if (coupling >= 0 && model->tree->couplings[coupling].kind == constraint_plane) {
        const struct coupling *plane = &model->tree->couplings[coupling];
        double d_N = 0,
               N = along ? formula_along(&plane->normal, at, along, &d_N) : formula_value(&plane->normal, at);
        if (variation) *variation = plane->share * (d_mu * N + value * d_N);
        return plane->share * value * N;
    }
    const struct constraint_form *form =
        coupling < 0 ? NULL : &constraint_forms[model->tree->couplings[coupling].kind];
    if (!form || !form->wrap) return value;
    double wrap = fmax(0, form->wrap(model, at, coupling, along != NULL, &d_wrap)),
           share = tanh(value * wrap / 2);
    if (variation) *variation = (1 - share * share) * (d_mu * wrap + value * d_wrap) / 2;
    return share;
}

double formula_third(const struct formula *formula, const struct instant *at)
{
    double d_a, d_b, h = 1e-4 * fmax(1, fabs(at->t)), low, high;
    const int *branch = formula_branches(formula, at);
    expr_eval_second(formula->expr, at->t - h, at->y, 0, 0, branch, &d_a, &d_b, &low);
    expr_eval_second(formula->expr, at->t + h, at->y, 0, 0, branch, &d_a, &d_b, &high);
    return (high - low) / (2 * h);
}

double friction_surface_jerk(const struct mode *mode, const struct instant *at)
{
    double d_a, d_b, jerk = 0;
    if (mode->kind == mode_drive && mode->position.expr) return formula_third(&mode->position, at);
    if (mode->surface_speed.expr)
        expr_eval_second(mode->surface_speed.expr, at->t, at->y, 0, 0,
                         formula_branches(&mode->surface_speed, at), &d_a, &d_b, &jerk);
    return jerk;
}

struct friction_coefficients friction_coefficients_at(const struct fbd_model *model, int pair,
                                                      const struct instant *at, const struct direction *along)
{
    const struct mode *mode = &model->plan.modes[pair];
    struct friction_coefficients mu = {0};
    mu.resting = friction_coefficient(model, pair, &mode->mu_s, at, along, along ? &mu.d_resting : NULL);
    mu.slipping = friction_coefficient(model, pair, &mode->mu_k, at, along, along ? &mu.d_slipping : NULL);
    return mu;
}

bool friction_is_idle(const struct fbd_model *model, int pair, const struct instant *at,
                      const struct direction *along)
{
    const struct mode *mode = &model->plan.modes[pair];
    if (!mode_is_friction(mode) || !mode_friction_varies(mode)) return false;
    const struct friction_coefficients mu = friction_coefficients_at(model, pair, at, along);
    return mu.resting == 0 && mu.d_resting == 0 && mu.slipping == 0 && mu.d_slipping == 0;
}

double friction_below_zero(const struct fbd_model *model, int pair, const struct instant *at)
{
    const double rounding = negligible_sum; /* of coefficients of 1, or of a bearing's limit of 1 N m */
    const struct mode *mode = &model->plan.modes[pair];
    if (!mode_is_friction(mode) || !mode_friction_varies(mode)) return 0;
    const struct friction_coefficients mu = friction_coefficients_at(model, pair, at, NULL);
    const double least = fmin(mu.resting, mu.slipping);
    return least < -rounding ? least : 0;
}

struct friction_values friction_at(const struct fbd_model *model, int pair, const struct instant *at,
                                   const double *slots)
{
    const struct mode *mode = &model->plan.modes[pair];
    struct friction_values values = {0};
    if (mode_is_one_sided(mode)) return values;
    double press = 1; /* the limits of a bearing are moments */
    if (mode->normal_slot >= 0) {
        values.N = -slots[mode->normal_slot];
        press = fmax(0, at->pull[pair] * values.N); /* a surface cannot pull */
    }
    const struct friction_coefficients mu = friction_coefficients_at(model, pair, at, NULL);
    values.limit_static = mu.resting * press;
    values.limit_kinetic = mu.slipping * press;
    double acceleration;
    friction_surface_speed(mode, at, &acceleration);
    values.hold = mode->inertia * acceleration - slots[mode->hold_slot];
    /* A coefficient that vanishes may be slightly negative by rounding. */
    values.limit = fmax(0, fmax(values.limit_static, values.limit_kinetic));
    values.force = at->slip[pair] == stick ? values.hold : -at->slip[pair] * values.limit_kinetic;
    if (mode->kind == mode_plane) values.force = fabs(values.force); /* its size */
    return values;
}

struct friction_values friction_along(const struct fbd_model *model, int pair, const struct instant *at,
                                      const double *slots, const struct direction *along,
                                      const double *slots_along)
{
    const struct mode *mode = &model->plan.modes[pair];
    struct friction_values rate = {0};
    if (mode_is_one_sided(mode)) return rate;
    double press = 1, d_press = 0;
    if (mode->normal_slot >= 0) {
        rate.N = -slots_along[mode->normal_slot];
        press = fmax(0, -at->pull[pair] * slots[mode->normal_slot]);
        d_press = at->pull[pair] * rate.N;
    }
    const struct friction_coefficients mu = friction_coefficients_at(model, pair, at, along);
    rate.limit_static = mu.d_resting * press + mu.resting * d_press;
    rate.limit_kinetic = mu.d_slipping * press + mu.slipping * d_press;
    double jerk = friction_surface_jerk(mode, at);
    rate.hold = mode->inertia * jerk * along->dt - slots_along[mode->hold_slot];
    rate.force = at->slip[pair] == stick ? rate.hold : -at->slip[pair] * rate.limit_kinetic;
    return rate;
}

double friction_rounding(const struct friction_values *now)
{
    return round_off(8, fabs(now->hold) + now->limit);
}

static double rate_of_limit(const struct friction_values *now, const struct friction_values *rate)
{
    return now->limit_static >= now->limit_kinetic ? rate->limit_static : rate->limit_kinetic;
}

double friction_rounding_of_time(const struct friction_values *now, const struct friction_values *rate,
                                 double t)
{
    return round_off(64, fabs(t)) * (fabs(rate->hold) + fabs(rate_of_limit(now, rate)));
}

double friction_return(const struct friction_values *now)
{
    return now->limit_kinetic == 0 ? distinct_part * now->limit_static : 0;
}

enum slip friction_decide(const struct friction_values *now, const struct friction_values *rate, double slack)
{
    /* With mu_k > mu_s, unphysical but possible in a file, slipping would reverse at once: the larger limit
     * is used. */
    double limit = now->limit,
           hold = now->hold != 0 ? now->hold : rate->hold; /* if zero, its rate gives the side */
    double excess = fabs(now->hold) - limit;
    if (fabs(excess) <= friction_rounding(now) + slack)
        excess = (hold > 0 ? rate->hold : -rate->hold) - rate_of_limit(now, rate);
    if (excess <= 0) return stick;
    return hold < 0 ? slip_plus : slip_minus; /* the sum of the other forces is -hold */
}

bool friction_takes_impulses(const struct fbd_model *model, const struct mode *mode)
{
    const bool guided = mode->kind == mode_tangent
                            ? coupling_is_guide(&model->tree->couplings[mode->coupling])
                            : mode->kind == mode_joint && mode->normal_slot >= 0 && !mode->moment;
    return guided && friction_rubs(mode);
}
