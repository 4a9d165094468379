/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dry (Coulomb) friction as modes.
 *
 * A friction constraint slips (+1, -1: the sign of the velocity relative to its surface) or sticks (0). With
 * N the normal force of a slide:
 *
 *     slip    f = -slip mu_k |N|                      while slip (v - s) > 0
 *     stick   f = H = m s' - sum of the other forces  while |H| <= mu_s |N|
 *
 * with s(t) the velocity of the surface. On a straight fixed line N = -sum f . n follows from the forces
 * across it only, so that friction and normal force are not coupled. For a bearing the limits are moments and
 * I_O takes the place of m.
 */
#ifndef FBD_DYNAMICS_FRICTION_H
#define FBD_DYNAMICS_FRICTION_H

#include "dynamics/forces.h"

/* The forces of a friction constraint at an instant, from the slots without friction. */
struct friction_values {
    double N;             /* signed normal force [N]; 0 for a bearing */
    double limit_static;  /* mu_s |N| or the static moment */
    double limit_kinetic; /* mu_k |N| or the kinetic moment */
    double limit;         /* up to which it sticks: the larger of the two */
    double hold;          /* H: the friction for sticking */
    double force;         /* the friction force (moment) along +x in the present mode */
};

double friction_surface_speed(const struct mode *mode, const struct instant *at, double *acceleration);

/* A coefficient of friction at an instant, and its variation along a direction, with the links varied. Of a
 * capstan rope it is tanh(mu beta / 2), relative to the sum of its tensions; on a plane mu N. */
double friction_coefficient(const struct fbd_model *model, int pair, const struct formula *mu,
                            const struct instant *at, const struct direction *along, double *variation);

/* Both coefficients of a friction constraint, and their variations along a direction, or NULL. */
struct friction_coefficients {
    double resting, slipping, d_resting, d_slipping;
};

struct friction_coefficients friction_coefficients_at(const struct fbd_model *model, int pair,
                                                      const struct instant *at,
                                                      const struct direction *along);

/* The third derivative of a formula of t, by differences: expressions have two, and the third only enters the
 * variation of accelerations with time. */
double formula_third(const struct formula *formula, const struct instant *at);

/* The rate of change of that acceleration with time. */
double friction_surface_jerk(const struct mode *mode, const struct instant *at);

struct friction_values friction_at(const struct fbd_model *model, int pair, const struct instant *at,
                                   const double *slots);

/* The variations of N, limits and hold along a direction, and of `force`. */
struct friction_values friction_along(const struct fbd_model *model, int pair, const struct instant *at,
                                      const double *slots, const struct direction *along,
                                      const double *slots_along);

/* Is there friction while it slips? */
static inline bool friction_rubs(const struct mode *mode)
{
    return mode->mu_k.expr || mode->mu_k.constant > 0;
}

/* Is it friction of a guide, a slide or a slot, which has an impulse where an impact loads the guide? That of a bearing is
 * a moment and has none. */
bool friction_takes_impulses(const struct fbd_model *model, const struct mode *mode);

/* A coefficient that is identically zero: the force is 0 in each mode, so that no mode is to be decided. It
 * slips, by convention forwards, and has no events. */
static inline bool friction_is_never(const struct mode *mode)
{
    return mode_is_friction(mode) && !mode_friction_varies(mode) && mode->mu_s.constant == 0 &&
           mode->mu_k.constant == 0;
}

/* Coefficients by expressions that are zero and remain so: the force is 0 in each mode until they change, and
 * a stop or reversal of the body is no event of friction. */
bool friction_is_idle(const struct fbd_model *model, int pair, const struct instant *at,
                      const struct direction *along);

/* The lower one of the coefficients if it is negative by more than the rounding of sums that reach zero, as 1
 * + cos(x) does; else 0. Negative friction would drive the body. */
double friction_below_zero(const struct fbd_model *model, int pair, const struct instant *at);

/* The rounding of the force needed and of its limit: a smaller excess is none. */
double friction_rounding(const struct friction_values *now);

/* The change of both within the rounding of the time t of an event, at which coefficients may begin at zero. */
double friction_rounding_of_time(const struct friction_values *now, const struct friction_values *rate,
                                 double t);

/* The tolerance of the limit after slipping without friction. Such a body returns exactly to the limit at
 * which it broke away, up to the errors of a run: within them rates decide, as at the limit. */
double friction_return(const struct friction_values *now);

/* The next mode of a friction constraint at zero relative velocity: it sticks while the force needed is
 * within the static limit, else it slips in the direction of the other forces. `rate` is the variation along
 * the motion: it decides when the force needed is at the limit within rounding, or within `slack`. */
enum slip friction_decide(const struct friction_values *now, const struct friction_values *rate,
                          double slack);

#endif
