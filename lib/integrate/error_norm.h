/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Error control that does not depend on units, as a control type for GSL's odeiv2.
 *
 * GSL's controls compare the error of a component with eps_abs + eps_rel |y_i|. An absolute tolerance is a
 * number with a unit, and a purely relative one demands infinite accuracy where a component passes through
 * zero. Here the error of component i is compared with tolerance * S_i, where the scale S_i is the largest of
 *
 *   - the running maximum of |y_i| over all accepted states (error_norm_update),
 *   - a floor that the caller may give,
 *   - |y_i| at the end of the step,
 *
 * and only if these are zero the motion within the step: |h v_i| + |h^2 a_i| for a coordinate q_i, |h y'_i|
 * for any other. That motion is not used otherwise, because a step that has gone wrong in a stiff direction
 * has huge slopes at its end and would be accepted for them.
 *
 * The running maximum of a rate is too large a scale where the rate peaks briefly: a cart of 1e-6 kg under a
 * pole of 1 kg has 4,400 m/s for a millisecond each half second, and 4 m/s else. So the scale of a rate is at
 * most its amplitude in the harmonic motion through both ends of the step, which equals the maximum as long
 * as it oscillates, and at least a thousandth of the running maximum, as a body that has come to rest has no
 * amplitude.
 *
 * The scale of an angle is at most 1 rad: an angle has a natural unit, and 1e6 revolutions do not excuse an
 * error of a radian. Its rate has no such bound.
 *
 * Rounding limits the accuracy. A step computes y_i to eps (DBL_EPSILON) times |y_i| plus its change, so the
 * level is at least that. And an error dv of v_i that moves q_i by less than its rounding, h dv < eps |q_i|,
 * is invisible within the step, so the level of v_i is at least eps |q_i| / h (angles count up to 1 rad
 * here). Without this bound a body at rest under large forces in balance, whose acceleration is round-off,
 * would take ever smaller steps.
 *
 * Errors of steps add up. Where the steps of a method are short because of its truncation error in stiff
 * components, they are many, and all err in the same direction. For such a method the law has a share,
 * by_time, of the time S_q / S_v in which a pair moves by its scale (of other components by the running
 * maximum of |y'_i|): the tolerance of a shorter step is reduced in proportion to its size, down to a
 * thousandth and to 1e-12. Measured for rodas5p and a share of a third (random stiff motions,
 * tests/hard/test_stiff_motions.c): one to three times as many steps, a tenth to a thousandth of the error.
 *
 * The norm is the maximum over the components, not a root mean square: independent bodies do not dilute each
 * other's errors, and adding a body at rest changes no step.
 *
 * Step size law (HNW I, II.4): with the largest ratio r of error to level and an estimate that is O(h^k),
 * h_new = h min(grow, max(shrink, safety r^(-1/k))). The step is accepted for r <= 1.
 *
 * With any GSL evolve or driver: hadjust returns GSL_ODEIV_HADJ_DEC for a step to be rejected, INC or NIL for
 * an accepted one; the step size proposed after an accepted one may be a little smaller (NIL, factor safety
 * at most). Values that are not finite count as an infinite error: DEC with h / 10.
 */
#ifndef FBD_INTEGRATE_ERROR_NORM_H
#define FBD_INTEGRATE_ERROR_NORM_H

#include <gsl/gsl_odeiv2.h>
#include <stdbool.h>

#include "integrate/layout.h"
#include "integrate/stepper_state_view.h"

/* Numbers of the step size law, without units. */
struct step_law {
    double safety;      /* below 1 */
    double shrink;      /* smallest factor after a rejection, below safety */
    double grow;        /* largest factor */
    double keep_below;  /* after an accepted step, smaller factors leave h unchanged; 0: none */
    double doubles;     /* the ratio of error to level after which a step may double */
    int estimate_order; /* k; 0 stands for the order that the stepper reports, plus 1 */
    double by_time;     /* share of the motion's time below which the tolerance goes with h; 0: none */
};

/* The law for an estimate of this order (as in struct method; 0 for a method of variable order). */
struct step_law step_law_for(int estimate_order);

/* A control for states of this layout, all scales zero; `tolerance` is relative to the scales and above 0.
 * To be freed with gsl_odeiv2_control_free. NULL when memory is out or an argument is unusable. */
gsl_odeiv2_control *error_norm_alloc(const struct layout *layout, double tolerance, struct step_law law);

/* Raise the scale of component i to `floor` (in its own unit) permanently: the size below which it is not of
 * interest. Useful where a coordinate is zero but for round-off of larger ones, as y of a body that moves
 * along x. */
void error_norm_set_floor(gsl_odeiv2_control *control, size_t i, double floor);

/* The acceleration of pair i (for indices beyond the pairs: the rate of a component outside the pairs) has
 * the round-off level `noise` (the difference of large forces, or a force at a late time). Errors of noise h
 * in v_i, and of noise h^2 in q_i, cannot be reduced by a smaller step and are allowed. Without this a body
 * that starts to move out of a balance of large forces would take ever smaller steps. The part `passing` of
 * it is proportional to the acceleration: rounding of a time-dependent force. */
void error_norm_set_roundoff(gsl_odeiv2_control *control, size_t i, double noise, double passing);

/* Does the round-off level allow a larger error of a rate, in a step of size h, than the tolerance does? Then
 * the caller must set it for the present state: a light cart whose pole passes the vertical has 1e9 times the
 * forces, and round-off, of one step later. */
bool error_norm_roundoff_counts(const gsl_odeiv2_control *control, double h);

/* Take an accepted state y with f = f(t, y) into the running maxima. */
void error_norm_update(gsl_odeiv2_control *control, const double *y, const double *f);

/* Largest ratio of |yerr_i| to its error level, for a step of size h that ended in y with slopes f. 0 for a
 * component without error, whatever its scale; INFINITY when anything is not finite. */
double error_norm_ratio(const gsl_odeiv2_control *control, double h, const double *y, const double *yerr,
                        const double *f);

/* Factor for the step size after a step with this error ratio; `order` is that reported by the stepper. */
double error_norm_factor(const gsl_odeiv2_control *control, double ratio, unsigned order);

/* A rate r [1/s] of the system from the difference df of the slopes of two states at one time that differ by
 * dy; y is one of them. Where accelerations differ as by a spring, da = w^2 dq, r is w, and as by a damper,
 * da = c dv, c: r is the root of r^2 |dq| + r |dv| = |da|, summed over the pairs in units of their speeds.
 * Mostly within a factor of two below the fastest rate of the components that differ; 0 where all of da is
 * round-off. */
double error_norm_rate(const gsl_odeiv2_control *control, const double *y, const double *dy,
                       const double *df);

/* Scales S_i (not multiplied by the tolerance) of a state y with slopes f for a step of size h. */
void error_norm_scales(const gsl_odeiv2_control *control, double h, const double *y, const double *f,
                       double *scales);

double error_norm_tolerance(const gsl_odeiv2_control *control);

/* Fill the control's part of `view`; false if there are more pairs than it has room for, or components
 * outside the pairs. */
bool error_norm_view(const gsl_odeiv2_control *control, struct stepper_state_view *view);

/* Copy the control's part back from `view`. */
void error_norm_settle(gsl_odeiv2_control *control, const struct stepper_state_view *view);

/* Copy scales, round-off levels and the last states from another control of the same layout; both keep their
 * tolerances and laws. */
void error_norm_follow(gsl_odeiv2_control *control, const gsl_odeiv2_control *other);

#endif
