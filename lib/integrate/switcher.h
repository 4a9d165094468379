/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A stepper that adapts to stiffness: it switches between an explicit and an implicit method, or uses one
 * method alone.
 *
 * The interface is that of stepper.h. The choice of the method depends on the trajectory only (stiffness.h),
 * never on evaluations of dense output.
 */
#ifndef FBD_INTEGRATE_SWITCHER_H
#define FBD_INTEGRATE_SWITCHER_H

#include "integrate/stepper.h"

struct switcher;

/* `options` for the method that starts, whose layout must remain valid; `stiff` takes over where the motion is stiff, NULL
 * for never. */
struct switcher *switcher_alloc(const struct stepper_options *options, const struct method *stiff);
void switcher_free(struct switcher *switcher);

/* Add a method that is exact in some modes of the system, and select it for the steps in them, before the reset that
 * begins them; without it the method is that of the last other step. False when memory is out. */
bool switcher_add_exact(struct switcher *switcher, const struct stepper_options *options,
                        const struct method *method);
void switcher_use_exact(struct switcher *switcher, bool exact);

/* Begin with the implicit method, where the choice is free: the motion after the next reset starts as a stiff one. */
void switcher_expect_stiff(struct switcher *switcher);

int switcher_reset(struct switcher *switcher, struct counted_system *system, struct time_dd t,
                   const double *y, double *f, struct time_dd t_limit, double *h);

/* The same for an exact method in use, with the slopes f given. */
int switcher_restart(struct switcher *switcher, struct time_dd t, const double *y, const double *f,
                     struct time_dd t_limit, double *h);

enum stepper_status switcher_step(struct switcher *switcher, struct counted_system *system, struct time_dd *t,
                                  double *y, double *f, double *h, struct time_dd t_limit);

/* Of the last step, whichever method made it. */
int switcher_dense(struct switcher *switcher, struct time_dd t, double *y);
int switcher_powers(struct switcher *switcher, struct time_dd from, struct time_dd to, size_t i, double *c);
int switcher_powers_of_ends(struct switcher *switcher, struct time_dd from, struct time_dd to, size_t i,
                            double *c);
int switcher_degree(const struct switcher *switcher, double *negligible);
int switcher_partial(struct switcher *switcher, struct time_dd t, double *y, double *f);
int switcher_shorten(struct switcher *switcher, struct time_dd *t, double *y, double *f);
int switcher_walk(struct switcher *switcher, struct time_dd t, double *y, double *f);

/* stepper_lend for the explicit method, while it makes the steps; the number of steps is limited by the next
 * attempt of the implicit one. */
bool switcher_lend(const struct switcher *switcher, struct stepper_state_view *view);
void switcher_settle(struct switcher *switcher, const struct stepper_state_view *view);

/* Counts of both methods together, or one of them. */
struct stepper_counts switcher_counts(const struct switcher *switcher);
unsigned long switcher_rejected(const struct switcher *switcher, enum rejection why);

/* Has an implicit method made the last step? */
bool switcher_made_implicitly(const struct switcher *switcher);

/* Steps that the stiff method has made. */
unsigned long switcher_stiff_steps(const struct switcher *switcher);

/* linear_set_matrix if the method is linear. */
void switcher_set_linear(struct switcher *switcher, const double *A, double rho);

/* See error_norm_set_floor, where a floor that is not positive and finite has no effect, and
 * error_norm_set_roundoff. The other method takes over both with the states, when it is tried. */
void switcher_set_floor(struct switcher *switcher, size_t component, double floor);
void switcher_set_noise(struct switcher *switcher, size_t rate, double noise, double passing);

/* error_norm_roundoff_counts for the method that makes the steps. */
bool switcher_noise_counts(const struct switcher *switcher, double h);

#endif
