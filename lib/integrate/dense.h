/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dense output over one step of any method: the state at every t0 <= t <= t1.
 *
 * GSL's steppers have none, so a polynomial is fitted to the data that every step provides: state and slope
 * at both ends. For pairs (q, v) with q' = v these are q, v, a at both ends, which determine a quintic; its
 * derivative is the only quartic through the same data, and one order better than the cubic of (v, a).
 * Further accelerations, evaluated on the present polynomial, raise the order one by one (bootstrapping:
 * Enright, Jackson, Norsett, Thomsen, Interpolants for Runge-Kutta formulas, ACM TOMS 12 (1986) 193). The
 * points are chosen where the polynomial is more accurate than elsewhere, which saves most of the
 * evaluations; dense.c has the derivation.
 *
 *                                          error of q, v    of other components    evaluations
 *     level 0: the ends only               h^6, h^5         h^4                    0
 *     level 1: one acceleration inside     h^7, h^6         as level 2             1, with others 4
 *     level 2: three accelerations inside  h^9, h^8         h^5; h^6 if they only  4
 *                                                           depend on q and v
 *
 * A method of order p gets the level whose v errs by h^p at most, like the method itself over many steps: 0
 * up to order 4, 1 for order 5, 2 above. A system without pairs has cubic Hermite with errors h^4, h^5 and
 * h^6 for 0, 2 and 4 evaluations. dop853 has its own extension (error h^8, three evaluations).
 *
 * The evaluations are made at the first request of a point inside the step, never for the ends: a step that
 * is not sampled costs no evaluation. They do not affect the stepper, so output does not change a trajectory.
 *
 * Limit: slopes and inner evaluations magnify an error in y along a stiff direction by h |lambda|, and no
 * polynomial of these degrees approximates a step of bsimp, which may be longer than a period. So implicit
 * methods use other means: see stepper_dense. The v of levels 0 to 2 contains the difference of two q over h,
 * and with it their errors over h: in the neighbourhood of a short step of low order (the first ones of
 * msadams) v may be ten times worse than at its ends. So where the difference is within these errors, it is
 * dropped.
 */
#ifndef FBD_INTEGRATE_DENSE_H
#define FBD_INTEGRATE_DENSE_H

#include <gsl/gsl_odeiv2.h>

#include "base/time_dd.h"
#include "integrate/layout.h"

struct dense;

/* Dense output for states of this layout, not yet set. NULL when memory is out. */
struct dense *dense_alloc(const struct layout *layout);
void dense_free(struct dense *dense);

/* Set the step from (t0, y0) with slopes f0 to (t1, y1) with slopes f1, t1 after t0, made by a method of
 * order `order`. `step` is the stepper that made it, used if it has a dense output of its own (dop853 and the
 * methods of structure.h), or NULL. Nothing is computed or copied: all arguments must remain valid and
 * unchanged until the next dense_set. */
void dense_set(struct dense *dense, int order, struct time_dd t0, const double *y0, const double *f0,
               struct time_dd t1, const double *y1, const double *f1, const gsl_odeiv2_system *sys,
               gsl_odeiv2_step *step);

/* For steps of a multistep method, whose errors of q and v are independent of each other: `errors`, which
 * must remain valid, holds those of y1 from now on. */
void dense_set_errors(struct dense *dense, const double *errors);

/* y at time t; bit for bit y0 at t0 and y1 at t1. GSL_SUCCESS, or the code of a right-hand side that failed
 * inside the step; then y is unchanged. */
int dense_eval(struct dense *dense, struct time_dd t, double *y);

/* Component i from `from` to `to` within the step as a polynomial, c[k] the coefficient of s^k, -1 <= s <= 1
 * between them. Returns its degree, at most dense_most_degree; -1 if it is not a polynomial, or a right-hand
 * side has failed. */
enum { dense_most_degree = 14 };
int dense_powers(struct dense *dense, struct time_dd from, struct time_dd to, size_t i, double *c);

/* The same of a coordinate or its rate by level 0, whatever the method, without an evaluation: for a coarse
 * search. -1 if the dense output itself costs no evaluation, or no further one. */
int dense_powers_of_ends(struct dense *dense, struct time_dd from, struct time_dd to, size_t i, double *c);

/* As dense_eval, at level 0, whatever the method: used when evaluations inside the step fail. */
void dense_eval_plain(struct dense *dense, struct time_dd t, double *y);

#endif
