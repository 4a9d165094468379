/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The Runge-Kutta-Nystrom pair 12(10) of Dormand, El-Mikkawy and Prince, with dense output, as a step type
 * for GSL's odeiv2: for systems y = (q, v), q' = v, v' = a(t, q), whose accelerations do not depend on
 * velocities.
 *
 * Such a system needs no stage values of v, so the order conditions are far fewer and a step of order 12
 * takes 17 evaluations, where a general method of order 8 takes 12. In the stages the right-hand side
 * receives the v of the start of the step; a system whose a depends on v gets wrong results, so this method
 * is chosen by structure.h and not by name.
 *
 * Error estimate: the difference to the embedded formulas of order 10, O(h^11). `y` of GSL is (q_1 .. q_n,
 * v_1 .. v_n); the allocation fails for an odd dimension. With f(t, y) in dydt_in a step costs 17
 * evaluations, the last of which is f(t + h, y1) = dydt_out. Failures as in pair8.h.
 *
 * Dense output. The accelerations of the stages are close to those of the motion, at nine times distributed
 * like Chebyshev points. Their polynomial P (with the true accelerations at both ends), integrated twice,
 * gives a first curve: v(theta) = v0 + h int P,   q(theta) = q0 + theta h v0 + h^2 int int P. Nine
 * evaluations on it give the accelerations at Lobatto's eleven points, and these a better P and the final
 * curve, as a round of fixed-point iteration does for a collocation method. Its q errs by h^12, its v by
 * h^11, and by no more than a few times the error estimate of the step.
 *
 * Source: nystrom_table.h; E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I,
 * 2nd edition, Springer 1993, II.14.
 */
#ifndef FBD_INTEGRATE_NYSTROM_H
#define FBD_INTEGRATE_NYSTROM_H

#include <gsl/gsl_odeiv2.h>

extern const gsl_odeiv2_step_type *const step_nystrom;

/* As dop853_dense_prepare and dop853_dense_eval. */
int nystrom_dense_prepare(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys);
void nystrom_dense_eval(const gsl_odeiv2_step *step, double theta, double *y);

#endif
