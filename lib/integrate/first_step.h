/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Size of the first step, from the state and one more evaluation of the right-hand side.
 *
 * The idea is that of HNW I, II.4 (starting step size): compare state, slope and, through a small Euler step,
 * second derivative. The formulas there add lengths to numbers without dimension (1e-6, 1e-15, and the
 * (p+1)-th root of a rate), so that another unit of time gives another step. Here everything is a
 * characteristic time. With S the scales of error_norm.h at the start, and j the change of acceleration per
 * time over the Euler step, for each pair (q, v),
 *
 *     L = max(S_q, v^2 / |a|)                         distance over which the motion changes
 *     tau_1 = min(L / |v|, sqrt(L / |a|))
 *     tau_2 = max(|a| / |j|, sqrt(S_v / |j|))         the first for damping, the second for springs
 *
 * and likewise with (x, x', change of x') for other components. If derivatives grow like S / tau^k, the local
 * error of a method of order p is S (h / tau)^(p+1), which should be 0.01 tolerance S:
 *
 *     h = min(tau_1, tau_2) (0.01 tolerance)^(1 / (p+1)),   at most h_max and 100 Euler steps,
 *                                                           and at least the resolution of t.
 *
 * v^2 / |a| in L is for a body that leaves the origin: a coordinate near zero by accident is not a short
 * distance. If all of these are zero, the Euler step is h_max / 1000.
 */
#ifndef FBD_INTEGRATE_FIRST_STEP_H
#define FBD_INTEGRATE_FIRST_STEP_H

#include "integrate/layout.h"
#include "integrate/system.h"

/* Choose *h > 0 for a step from (t, y) with f = f(t, y) by a method of order `order`, forward in time; *h <=
 * h_max, which has to be finite and positive. `control` is one of error_norm.h. `work` has room for three
 * states. If the right-hand side cannot be evaluated at the end of the Euler step, the step is shortened;
 * GSL_EBADFUNC is returned at once, any other code if even a very short step fails. */
int first_step(struct counted_system *system, const struct layout *layout, const gsl_odeiv2_control *control,
               int order, double t, const double *y, const double *f, double h_max, double *work, double *h);

#endif
