/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Planar vectors by value: x to the right, y up, angles counter-clockwise.
 */
#ifndef FBD_BASE_VEC_H
#define FBD_BASE_VEC_H

#include <math.h>

struct vec {
    double x, y;
};

static inline struct vec vec_add(struct vec a, struct vec b)
{
    return (struct vec){a.x + b.x, a.y + b.y};
}

static inline struct vec vec_sub(struct vec a, struct vec b)
{
    return (struct vec){a.x - b.x, a.y - b.y};
}

static inline struct vec vec_scale(double s, struct vec a)
{
    return (struct vec){s * a.x, s * a.y};
}

static inline double vec_dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y;
}

/* The out-of-plane component of a x b. */
static inline double vec_cross(struct vec a, struct vec b)
{
    return a.x * b.y - a.y * b.x;
}

/* k x a: `a` turned a quarter turn counter-clockwise. */
static inline struct vec vec_perp(struct vec a)
{
    return (struct vec){-a.y, a.x};
}

static inline double vec_norm(struct vec a)
{
    return hypot(a.x, a.y);
}

/* The unit vector at `angle` [rad] from the x axis. A component that is the rounding of a quarter turn is
 * zero: what acts straight up does not push sideways by 1e-16. */
static inline struct vec vec_unit(double angle)
{
    const double rounding = 2.5e-16;
    double c = cos(angle), s = sin(angle);
    return (struct vec){fabs(c) < rounding ? 0 : c, fabs(s) < rounding ? 0 : s};
}

/* `a` turned by the rotation whose cosine and sine are the components of `r`. */
static inline struct vec vec_turn(struct vec r, struct vec a)
{
    return (struct vec){r.x * a.x - r.y * a.y, r.y * a.x + r.x * a.y};
}

#endif
