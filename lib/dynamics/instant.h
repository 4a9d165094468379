/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Instant: where a scene is, and in which discrete modes.
 *
 * y = [q_1 .. q_n, v_1 .. v_n, z_1 .. z_m] with the states z of the file's own. Between events the modes are fixed and everything is a smooth function of (t,
 * y); the modes change at located events only.
 */
#ifndef FBD_DYNAMICS_INSTANT_H
#define FBD_DYNAMICS_INSTANT_H

#include "expr/parts.h"
#include "model/model.h"

struct tree_work;
struct sliding;

/* What a friction pair does; what is one-sided sticks while it is closed. `loose` is for trials: neither held
 * nor rubbing. */
enum slip { slip_minus = -1, stick = 0, slip_plus = 1, loose = 2 };

/* The side on which a pair slips: 0 when it sticks or is loose. */
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
    struct tree_work *tree; /* scratch and results of the jointed bodies; NULL when there are none */
    double *extended;       /* scratch of world_refs.h; NULL when no expression names a place in the world */
    struct sliding *sliding; /* switches that the motion slides on; NULL when there are none */
};

/* A direction in which everything varies: (dt, dy). */
struct direction {
    double dt;
    const double *dy;
};

static inline const int *formula_branches(const struct formula *formula, const struct instant *at)
{
    return formula->branch < 0 || !at->branch ? NULL : at->branch + formula->branch;
}

/* In a formula with switches that are slid on: sliding.h. */
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
