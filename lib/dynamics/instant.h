/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Instant: the configuration of a scene and its discrete modes.
 *
 * y = [q_1 .. q_n, v_1 .. v_n, z_1 .. z_m] with the user states z. Between events the modes are fixed and all
 * functions of (t, y) are smooth; the modes change at located events only.
 */
#ifndef FBD_DYNAMICS_INSTANT_H
#define FBD_DYNAMICS_INSTANT_H

#include "expr/parts.h"
#include "model/model.h"

struct tree_work;
struct sliding;

/* The mode of a friction constraint; a one-sided constraint is `stick` while closed. `loose` is for trials:
 * neither sticking nor with friction. */
enum slip { slip_minus = -1, stick = 0, slip_plus = 1, loose = 2 };

/* The side on which a constraint slips: 0 when it sticks or is loose. */
static inline int slip_side(int slip)
{
    return slip == loose ? 0 : slip;
}

struct instant {
    double t;
    const double *y;
    const int *branch;      /* plan.branches: of the switches in formulas; NULL for plain values */
    const int *slip;        /* plan.mode_count: enum slip */
    const int *pull;        /* plan.mode_count: sign of the normal force of a two-sided guide, +1 otherwise */
    struct tree_work *tree; /* scratch and results */
    double *extended; /* scratch of world_refs.h; NULL when no expression refers to positions in the world */
    struct sliding *sliding; /* switches in a sliding mode; NULL when there are none */
    bool moved;              /* the links have just been moved to it (world_refs.h) */
    const double *held;      /* values of inputs, by parameter; NULL when states have none */
};

/* A direction of variation: (dt, dy, d held). */
struct direction {
    double dt;
    const double *dy;
    const double *held; /* variations of the inputs that states hold, by parameter; NULL: 0 */
};

static inline const int *formula_branches(const struct formula *formula, const struct instant *at)
{
    return formula->branch < 0 || !at->branch ? NULL : at->branch + formula->branch;
}

/* Of a formula with switches in a sliding mode: sliding.h. */
double sliding_value(const struct formula *formula, const struct instant *at);
double sliding_value_along(const struct formula *formula, const struct instant *at,
                           const struct direction *along, double *variation);

static inline double formula_value(const struct formula *formula, const struct instant *at)
{
    if (!formula->expr) return formula->constant;
    if (formula->expr->parts) return parts_run(formula->expr, at->t, at->y);
    if (at->sliding && formula->branch >= 0) return sliding_value(formula, at);
    return expr_eval(formula->expr, at->t, at->y, formula_branches(formula, at));
}

/* The value, and its variation along a direction. */
static inline double formula_along(const struct formula *formula, const struct instant *at,
                                   const struct direction *along, double *variation)
{
    *variation = 0;
    if (!formula->expr) return formula->constant;
    if (at->sliding && formula->branch >= 0) return sliding_value_along(formula, at, along, variation);
    return expr_eval_along(formula->expr, at->t, at->y, along->dt, along->dy, formula_branches(formula, at),
                           variation);
}

#endif
