/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rodas5P, a Rosenbrock method of order 5(4) for stiff systems with dense output of order 4, as a step type
 * for GSL's odeiv2.
 *
 * It may be used in any GSL program whose system has a Jacobian: gsl_odeiv2_step_alloc(step_rodas5p, dim),
 * with evolve or driver and any control. It is L-stable: components that decay fast are damped at once,
 * however large the step. It is linearly implicit, so there is no iteration that could fail. A step costs 8
 * evaluations of the right-hand side when f(t, y) is given in dydt_in, the last of which is f(t + h, y1) =
 * dydt_out, one Jacobian and one LU decomposition. It requires no driver. No memory is allocated after the
 * allocation of the step.
 *
 * Jacobian. It must be exact, df/dt included: with an approximate one the order falls. It is kept for further
 * attempts from the same t and y with the same functions and parameters pointer; so, as GSL requires for a
 * step that is not the continuation of the one before, gsl_odeiv2_step_reset is needed when the contents of
 * the parameters have changed.
 *
 * Error estimate. yerr = y1 minus the embedded solution of order 4, O(h^5), itself a solution of the linear
 * system, and so without the exaggeration of stiff components in differences of slopes.
 *
 * Order. Local errors O(h^6), global O(h^5). Where a stiff component follows a forcing (Prothero and
 * Robinson), with h |lambda| >> 1, they fall with h^3 / |lambda|, which is small already.
 *
 * Failure. If the right-hand side or the Jacobian returns a code other than GSL_SUCCESS, the step returns
 * that code; if the matrix of the linear system is singular or y1 is not finite, GSL_FAILURE, upon which
 * GSL's evolve shortens the step; without a Jacobian function GSL_EINVAL. In all cases y is unchanged.
 *
 * Source: rodas5p_table.h; E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd edition,
 * Springer 1996, IV.7.
 */
#ifndef FBD_INTEGRATE_RODAS5P_H
#define FBD_INTEGRATE_RODAS5P_H

#include <gsl/gsl_odeiv2.h>

extern const gsl_odeiv2_step_type *const step_rodas5p;

/* Make the dense output of the last successful step of `step`; no evaluations. The control may have rejected
 * the step since. GSL_SUCCESS, or GSL_EINVAL when `step` is of another type or has made no step. The result
 * stays valid until the next step or reset. */
int rodas5p_dense_prepare(gsl_odeiv2_step *step);

/* y(t0 + theta h), 0 <= theta <= 1, of the prepared step [t0, t0 + h]; error O(h^5), O(h^4) for components
 * forced by a stiff system; continuous from step to step, its slope up to O(h^4). */
void rodas5p_dense_eval(const gsl_odeiv2_step *step, double theta, double *y);

/* The Jacobian at the start of the last attempted step, row by row, for a measure of stiffness; NULL without
 * one. Valid until the next step or reset. */
const double *rodas5p_jacobian(const gsl_odeiv2_step *step);

#endif
