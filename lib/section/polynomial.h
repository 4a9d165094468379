/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Polynomials on -1 <= t <= 1 by their coefficients, of low degree.
 */
#ifndef FBD_SECTION_POLYNOMIAL_H
#define FBD_SECTION_POLYNOMIAL_H

#include <stdbool.h>

enum {
    polynomial_fitted = 8,                   /* degree of an interpolation */
    polynomial_most = polynomial_fitted + 4, /* largest degree */
};

/* The sum of a[i] t^i. */
struct polynomial {
    double a[polynomial_most + 1];
};

double polynomial_at(const struct polynomial *p, double t);

/* Add a polynomial times a number; of a product those terms that have room. */
void polynomial_add(struct polynomial *p, double factor, const struct polynomial *q);
struct polynomial polynomial_product(const struct polynomial *p, const struct polynomial *q);

struct polynomial polynomial_derivative(const struct polynomial *p);

/* The integral, with the value `start` at t = -1. */
struct polynomial polynomial_integral(const struct polynomial *p, double start);

/* Interpolate f at Chebyshev's nodes of `polynomial_fitted`. */
struct polynomial polynomial_fit(double (*f)(double t, void *context), void *context);

/* The roots in -1 < t < 1 at which p changes its sign, in ascending order; returns their number. They are isolated by
 * those of the derivative, so that none is missed, and found by bisection to rounding. */
int polynomial_roots(const struct polynomial *p, double roots[polynomial_most]);

#endif
