/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Quadrature piece by piece: Gauss and Kronrod's 21 points, halved where their error is too large for the
 * size of the whole (at a kink or a jump some fifty times).
 *
 * GSL's adaptive rules do the same, but call the error handler, which by default ends the program, if
 * rounding prevents their tolerance; the rule of 21 points does not.
 */
#ifndef FBD_NUMERIC_QUADRATURE_H
#define FBD_NUMERIC_QUADRATURE_H

#include <gsl/gsl_math.h>

struct quadrature {
    double integral;
    double error; /* sum of the rules' error estimates */
    double size;  /* of the integral of |f| */
};

/* Integrate over `pieces` stretches from ends[0] to ends[pieces], to some 13 digits of the size of the whole;
 * with at most `halves` divisions in all. NAN where f has no value. */
struct quadrature quadrature_over(const gsl_function *f, const double *ends, int pieces, int halves);

#endif
