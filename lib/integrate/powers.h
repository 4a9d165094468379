/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Polynomials in the relative time theta of a step, given as nested products, as powers of s over a piece of
 * the step: theta = middle + radius s, -1 <= s <= 1. c[k] is the coefficient of s^k.
 */
#ifndef FBD_INTEGRATE_POWERS_H
#define FBD_INTEGRATE_POWERS_H

struct powers_piece {
    double middle, radius;
};

/* c (a + b s); returns the degree, which is one higher. c has room for it. */
static inline int powers_times(int degree, double *c, double a, double b)
{
    c[degree + 1] = b * c[degree];
    for (int k = degree; k > 0; k--) c[k] = a * c[k] + b * c[k - 1];
    c[0] *= a;
    return degree + 1;
}

/* c theta, c (1 - theta), c (theta - 1/2) */
static inline int powers_times_theta(int degree, double *c, const struct powers_piece *piece)
{
    return powers_times(degree, c, piece->middle, piece->radius);
}

static inline int powers_times_rest(int degree, double *c, const struct powers_piece *piece)
{
    return powers_times(degree, c, 1 - piece->middle, -piece->radius);
}

static inline int powers_times_centred(int degree, double *c, const struct powers_piece *piece)
{
    return powers_times(degree, c, piece->middle - 0.5, piece->radius);
}

#endif
