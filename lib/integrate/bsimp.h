/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Implicit extrapolation: the semi-implicit midpoint rule of Bader and Deuflhard (Numer. Math. 41, 1983),
 * with 2, 6, 10, ... 50 steps, extrapolated in h^2 to order 12, as a step type of GSL. It replaces GSL's
 * bsimp, which allocates memory in every step and crashes when that fails. It requires the Jacobian.
 */
#ifndef FBD_INTEGRATE_BSIMP_H
#define FBD_INTEGRATE_BSIMP_H

#include <gsl/gsl_odeiv2.h>

extern const gsl_odeiv2_step_type *const step_bsimp;

#endif
