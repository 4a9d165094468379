/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Implicit Runge-Kutta methods by collocation: Euler (order 1), the midpoint rule (2) and Gauss's of two
 * stages (4), as step types of GSL. The same methods, by the same names and with the same estimate of the
 * error, as those of GSL 2.7, which take memory in every step and crash when there is none.
 *
 * The estimate is by doubling: one step of h and two of h/2 differ by (2^p - 1) times the error of the
 * latter, and four times that is reported. They need a driver, whose control says how small the corrections
 * of an iteration have to be (as GSL's do), and the Jacobian.
 */
#ifndef FBD_INTEGRATE_IMPLICIT_RK_H
#define FBD_INTEGRATE_IMPLICIT_RK_H

#include <gsl/gsl_odeiv2.h>

extern const gsl_odeiv2_step_type *const step_rk1imp, *const step_rk2imp, *const step_rk4imp;

#endif
