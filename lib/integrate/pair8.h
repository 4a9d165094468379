/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Explicit Runge-Kutta pairs of order 8 as step types for GSL's odeiv2: rk8pd of Prince and Dormand, 8(7) in
 * 13 stages, and dop853 of Dormand and Prince, 8(5,3) in 12 stages, with its dense output of order 7. Their
 * stages are sums over the same earlier stages, so there is one stepper for both.
 *
 * They may be used in any GSL program: gsl_odeiv2_step_alloc(step_rk8pd, dim), with evolve or driver and any
 * control. A step costs 13 or 12 evaluations of the right-hand side when f(t, y) is given in dydt_in, the
 * last of which is f(t + h, y1) = dydt_out. They require neither Jacobian nor driver. No memory is allocated
 * after the allocation of the step. In addition to GSL's rk8pd, this one compensates rounding and estimates
 * the fastest rate of the system.
 *
 * Choice. With equal steps both have the same error, for as many evaluations. With step size control dop853
 * takes up to half as many evaluations more for the same error, as its estimate varies within an oscillation
 * (`fbd-cost` shows it on any scene, as models/trees/double_pendulum.yaml), so rk8pd is the default.
 *
 * Error estimates. That of rk8pd is the difference to its embedded formula of order 7, O(h^8). For dop853
 * Hairer combines two embedded formulas of order 5 and 3 with differences e5 = O(h^5) and e3 = O(h^3) (both
 * divided by h) to
 *     err = h |e5|^2 / sqrt(|e5|^2 + 0.01 |e3|^2) = O(h^8),
 * which is large where the formula of order 5 happens to agree by accident. A GSL control takes a number for
 * each component, so the same expression is returned for each: yerr_i = h e5_i |e5_i| / sqrt(e5_i^2 + 0.01
 * e3_i^2). For one component it is Hairer's formula; for several the maximum of |yerr_i| / scale_i, which a
 * control forms, is as dimension-free as his root mean square, and one component does not dilute the error of
 * another. As the estimates are O(h^8) = O(h^order), the exponent of a step size law is 1/8.
 *
 * Rounding. The rounding error of y1 = y0 + (...) is kept and added in the next step, and to the arguments of
 * its stages (compensated summation: O. Moller, BIT 5 (1965) 37; E. Hairer, C. Lubich, G. Wanner, Geometric
 * Numerical Integration, VIII.5). It is used for a component if the next step starts from the same y, bit for
 * bit, whether the step is repeated or continues from its end; a reset discards it. A pendulum from 1e-6 rad
 * beside the upright to the same on the other side, where 1e-15 of the energy are 1e-4 s, is 3 to 4 times
 * more accurate with it at tolerances of 1e-14 and below; the remaining error is the rounding of the slopes.
 * It costs one sum for each stage and component.
 *
 * Failure. If the right-hand side returns a code other than GSL_SUCCESS, the step returns that code; if y1 is
 * not finite, GSL_FAILURE (GSL's own steppers would return success). In both cases y is unchanged.
 *
 * Sources: P. J. Prince, J. R. Dormand, J. Comput. Appl. Math. 7 (1981) 67 (rk8pd); E. Hairer, S. P. Norsett,
 * G. Wanner, Solving Ordinary Differential Equations I, 2nd edition, Springer 1993, II.5 (dop853), II.10
 * (error estimate), II.6 (dense output); J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19;
 * coefficients in rk8pd_table.h and dop853_table.h.
 */
#ifndef FBD_INTEGRATE_PAIR8_H
#define FBD_INTEGRATE_PAIR8_H

#include <gsl/gsl_odeiv2.h>
#include <stdbool.h>

#include "integrate/powers.h"
#include "integrate/stepper_state_view.h"

extern const gsl_odeiv2_step_type *const step_dop853, *const step_rk8pd;

/* Make the dense output of the last successful step of `step`, of dop853: three evaluations of the right-hand
 * side (four if the step was made without dydt_out), at the first call only. The control may have rejected
 * the step since. GSL_SUCCESS, the code of a failed right-hand side, or GSL_EINVAL when `step` is of another
 * type or has made no step. The result stays valid until the next step or reset. */
int dop853_dense_prepare(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys);

/* y(t0 + theta h), 0 <= theta <= 1, of the prepared step [t0, t0 + h]; error O(h^8), continuous with its
 * first derivative from step to step. */
void dop853_dense_eval(const gsl_odeiv2_step *step, double theta, double *y);

/* The same of component i as a polynomial over a piece of the step; its degree, 7. */
int dop853_dense_powers(const gsl_odeiv2_step *step, size_t i, const struct powers_piece *piece, double *c);

/* Two states that the last step has evaluated for one time, its end y1 and the argument of its last stage,
 * differ by dy, their slopes by df: so df = J dy with a mean J of the Jacobian, without further evaluations
 * (HNW II, IV.2, uses it to detect stiffness). False, with both pointers unchanged, unless the last step was
 * made with dydt_out, is of one of these types and has no dense output yet. The numbers are valid until the
 * dense output is made or the next step. */
bool pair8_differences(const gsl_odeiv2_step *step, const double **dy, const double **df);

/* Copy the accumulated rounding errors of the last state of `view`, for a step of one of these types, to the
 * view and back. */
void pair8_lend(const gsl_odeiv2_step *step, struct stepper_state_view *view);
void pair8_settle(gsl_odeiv2_step *step, const struct stepper_state_view *view);

#endif
