/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Backward differentiation with variable steps, of the orders 1 to 5 that it chooses by itself, as a step
 * type of GSL; for stiff systems. It goes by the name of GSL's, msbdf, which takes memory in every step and
 * crashes when there is none.
 *
 * With the points (t_0, y_0), (t_1, y_1), ... from the latest back, a step of order k to t puts y on the
 * polynomial of degree k through y and y_0 ... y_{k-1} whose slope at t is f(t, y) (Hairer, Norsett & Wanner
 * I, III.5). The polynomial P of degree k through y_0 ... y_k, which predicts, differs from it by a multiple
 * of (tau - t_0) ... (tau - t_{k-1}), so that
 *
 *     f(t, y) = P'(t) + alpha (y - P(t)),     alpha = sum_{i<k} 1 / (t - t_i).
 *
 * With D the divided difference of order k + 1, y misses the solution by w D / alpha, w = prod_{i<k} (t -
 * t_i), and P misses it by w (t - t_k) D: so the error is (y - P) / (1 + alpha (t - t_k)).
 *
 * It needs a driver (see newton.h) and the Jacobian. After a step that has been accepted, the next one begins
 * where that one has ended; anything else begins anew with order 1, as does gsl_odeiv2_step_reset.
 */
#ifndef FBD_INTEGRATE_BDF_H
#define FBD_INTEGRATE_BDF_H

#include <gsl/gsl_odeiv2.h>

extern const gsl_odeiv2_step_type *const step_msbdf;

#endif
