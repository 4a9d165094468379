/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Jets: a quantity along the motion, with its first and second rate of change, and the variations of all
 * three along a direction. A constraint g written with jets has its velocity g', its acceleration g'' and
 * their exact Jacobians by the chain rule, without further formulas.
 */
#ifndef FBD_DYNAMICS_JET_H
#define FBD_DYNAMICS_JET_H

#include "base/vec.h"

struct jet {
    double x, x1, x2; /* value and rates */
    double d, d1, d2; /* their variations */
};

struct jet_vec {
    struct jet x, y;
};

static inline struct jet jet_constant(double x)
{
    return (struct jet){.x = x};
}

static inline struct jet jet_add(struct jet a, struct jet b)
{
    return (struct jet){a.x + b.x, a.x1 + b.x1, a.x2 + b.x2, a.d + b.d, a.d1 + b.d1, a.d2 + b.d2};
}

static inline struct jet jet_scale(double s, struct jet a)
{
    return (struct jet){s * a.x, s * a.x1, s * a.x2, s * a.d, s * a.d1, s * a.d2};
}

static inline struct jet jet_sub(struct jet a, struct jet b)
{
    return jet_add(a, jet_scale(-1, b));
}

static inline struct jet jet_mul(struct jet a, struct jet b)
{
    return (struct jet){a.x * b.x,
                        a.x1 * b.x + a.x * b.x1,
                        a.x2 * b.x + 2 * a.x1 * b.x1 + a.x * b.x2,
                        a.d * b.x + a.x * b.d,
                        a.d1 * b.x + a.x1 * b.d + a.d * b.x1 + a.x * b.d1,
                        a.d2 * b.x + a.x2 * b.d + 2 * (a.d1 * b.x1 + a.x1 * b.d1) + a.d * b.x2 + a.x * b.d2};
}

/* f(a), given the value of f and its first three derivatives there. */
static inline struct jet jet_apply(struct jet a, double f, double f1, double f2, double f3)
{
    return (struct jet){f,
                        f1 * a.x1,
                        f2 * a.x1 * a.x1 + f1 * a.x2,
                        f1 * a.d,
                        f2 * a.d * a.x1 + f1 * a.d1,
                        f3 * a.d * a.x1 * a.x1 + 2 * f2 * a.x1 * a.d1 + f2 * a.d * a.x2 + f1 * a.d2};
}

static inline struct jet jet_sqrt(struct jet a)
{
    double f = sqrt(a.x), f1 = 1 / (2 * f), f2 = -f1 / (2 * a.x);
    return jet_apply(a, f, f1, f2, -3 * f2 / (2 * a.x));
}

static inline struct jet jet_inverse(struct jet a)
{
    double f = 1 / a.x;
    return jet_apply(a, f, -f * f, 2 * f * f * f, -6 * f * f * f * f);
}

/* ---- vectors */

static inline struct jet_vec jet_vec_sub(struct jet_vec a, struct jet_vec b)
{
    return (struct jet_vec){jet_sub(a.x, b.x), jet_sub(a.y, b.y)};
}

static inline struct jet jet_dot(struct jet_vec a, struct jet_vec b)
{
    return jet_add(jet_mul(a.x, b.x), jet_mul(a.y, b.y));
}

static inline struct jet_vec jet_vec_times(struct jet s, struct jet_vec a)
{
    return (struct jet_vec){jet_mul(s, a.x), jet_mul(s, a.y)};
}

static inline struct jet_vec jet_perp(struct jet_vec a)
{
    return (struct jet_vec){jet_scale(-1, a.y), a.x};
}

static inline struct jet jet_norm(struct jet_vec a)
{
    return jet_sqrt(jet_dot(a, a));
}

/* The angle of a vector from the x axis, between -pi and pi: turned to that axis it is atan(y / x) = y / x to
 * second order. */
static inline struct jet jet_angle(struct jet_vec a)
{
    double r = hypot(a.x.x, a.y.x), c = a.x.x / r, s = a.y.x / r;
    struct jet along = jet_add(jet_scale(c, a.x), jet_scale(s, a.y));
    struct jet across = jet_sub(jet_scale(c, a.y), jet_scale(s, a.x));
    struct jet ratio = jet_mul(across, jet_inverse(along));
    return jet_apply(ratio, atan2(a.y.x, a.x.x), 1, 0, -2);
}

static inline struct vec jet_value(struct jet_vec a)
{
    return (struct vec){a.x.x, a.y.x};
}

static inline struct vec jet_variation(struct jet_vec a)
{
    return (struct vec){a.x.d, a.y.d};
}

#endif
