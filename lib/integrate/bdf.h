/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Backward differentiation with variable steps, with automatic choice of the order from 1 to 5, as a step
 * type of GSL; for stiff systems. It has the name of GSL's, msbdf, which allocates memory in every step and
 * crashes when that fails.
 *
 * With the points (t_0, y_0), (t_1, y_1), ... from the latest back, a step of order k to t puts y on the
 * polynomial of degree k through y and y_0 ... y_{k-1} whose slope at t is f(t, y) (Hairer, Norsett & Wanner
 * I, III.5). The predictor, the polynomial P of degree k through y_0 ... y_k, differs from it by a multiple
 * of (tau - t_0) ... (tau - t_{k-1}), so that
 *
 *     f(t, y) = P'(t) + alpha (y - P(t)),     alpha = sum_{i<k} 1 / (t - t_i).
 *
 * With D the divided difference of order k + 1, y differs from the solution by w D / alpha, w = prod_{i<k} (t
 * - t_i), and P by w (t - t_k) D: so the error is (y - P) / (1 + alpha (t - t_k)).
 *
 * It requires a driver (see newton.h) and the Jacobian. After an accepted step, the next one begins at its
 * end; any other start begins with order 1, as does gsl_odeiv2_step_reset.
 */
#ifndef FBD_INTEGRATE_BDF_H
#define FBD_INTEGRATE_BDF_H

#include <gsl/gsl_odeiv2.h>

extern const gsl_odeiv2_step_type *const step_msbdf;

#endif
