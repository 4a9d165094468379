/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Planar vectors by value: x to the right, y up, angles counter-clockwise.
 */
#ifndef FBD_BASE_VEC_H
#define FBD_BASE_VEC_H

#include <math.h>

/* The larger one, or NaN if one of them is: fmax would ignore a NaN, which must count as too large in every
 * comparison of the form !(x <= most). */
static inline double larger(double a, double b)
{
    return a > b || isnan(a) ? a : b;
}

struct vec {
    double x, y;
};

static inline struct vec vec_of(const double pair[static 2])
{
    return (struct vec){pair[0], pair[1]};
}

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

/* omega k x a: the rate of change of a vector that turns at omega. */
static inline struct vec vec_turning(double omega, struct vec a)
{
    return vec_scale(omega, vec_perp(a));
}

/* sqrt(x^2 + y^2), by hypot only where the squares would overflow or lose digits; the zero vector needs
 * neither. */
static inline double vec_norm(struct vec a)
{
    const double least = 1e-280, most = 1e280;
    double square = a.x * a.x + a.y * a.y;
    if (square > least && square < most) return sqrt(square);
    return a.x != 0 || a.y != 0 ? hypot(a.x, a.y) : 0;
}

/* Cosine and sine of `angle` [rad]. */
static inline struct vec vec_cos_sin(double angle)
{
    return (struct vec){cos(angle), sin(angle)};
}

/* Set a component of a unit vector to zero if it is the rounding of a quarter turn, so that a vertical force
 * has no horizontal component of 1e-16. */
static inline struct vec vec_without_rounding(struct vec u)
{
    const double rounding = 2.5e-16;
    return (struct vec){fabs(u.x) < rounding ? 0 : u.x, fabs(u.y) < rounding ? 0 : u.y};
}

/* The unit vector at `angle` [rad] from the x axis. */
static inline struct vec vec_unit(double angle)
{
    return vec_without_rounding(vec_cos_sin(angle));
}

/* `a` rotated by the rotation whose cosine and sine are the components of `r`. */
static inline struct vec vec_turn(struct vec r, struct vec a)
{
    return (struct vec){r.x * a.x - r.y * a.y, r.y * a.x + r.x * a.y};
}

#endif
