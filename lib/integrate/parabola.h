/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The exact motion under constant accelerations, as a step type for GSL's odeiv2:
 *
 *     q(t + h) = q + h v + h^2 a / 2,   v(t + h) = v + h a,   a = a(t, y) at the start of the step.
 *
 * One step reaches to the next event, whatever the distance; it evaluates nothing, as a is given in dydt_in
 * and is the same at the end. The error estimate is zero. Like nystrom.h, this method is chosen only by
 * structure.h, for systems y = (q, v) whose accelerations are constant between events.
 *
 * Event functions along such a motion that are linear in q and v are quadratic or linear in t; the cubics of
 * scan.h represent them exactly, so that their zeros are found at the first attempt.
 */
#ifndef FBD_INTEGRATE_PARABOLA_H
#define FBD_INTEGRATE_PARABOLA_H

#include <gsl/gsl_odeiv2.h>

#include "integrate/powers.h"

extern const gsl_odeiv2_step_type *const step_parabola;

/* As those of dop853, but at the time `since` the start of the step [s]; exact, without evaluations. */
int parabola_dense_prepare(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys);
void parabola_dense_eval(const gsl_odeiv2_step *step, double since, double *y);

/* The slopes at a state y within the last step, of its velocities and its constant accelerations. */
void parabola_slopes(const gsl_odeiv2_step *step, const double *y, double *f);
int parabola_dense_powers(const gsl_odeiv2_step *step, size_t i, const struct powers_piece *piece, double *c);

#endif
