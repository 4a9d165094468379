/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Implicit Runge-Kutta methods by collocation: Euler (order 1), the midpoint rule (2) and Gauss's of two
 * stages (4), as step types of GSL. They are the methods of GSL 2.7, with the same names and error estimate;
 * GSL's versions allocate memory in every step and crash when that fails.
 *
 * The estimate is by doubling: one step of h and two of h/2 differ by (2^p - 1) times the error of the
 * latter, and four times that is reported. They require a driver, whose control gives the tolerance of the
 * iterations (as GSL's do), and the Jacobian.
 */
#ifndef FBD_INTEGRATE_IMPLICIT_RK_H
#define FBD_INTEGRATE_IMPLICIT_RK_H

#include <gsl/gsl_odeiv2.h>

extern const gsl_odeiv2_step_type *const step_rk1imp, *const step_rk2imp, *const step_rk4imp;

#endif
