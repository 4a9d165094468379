/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dry (Coulomb) friction as modes.
 *
 * A pair slips (+1, -1: the sign of the velocity relative to its surface) or sticks (0). With N the normal
 * force of a slide:
 *
 *     slip    f = -slip mu_k |N|                      while slip (v - s) > 0
 *     stick   f = H = m s' - sum of the other forces  while |H| <= mu_s |N|: whatever holds it on the surface
 *
 * with s(t) the velocity of the surface. On a straight fixed line N follows from the forces across it alone,
 * N = -sum f . n, so that friction and normal force are not coupled. For a bearing the limits are moments and
 * I_O takes the place of m.
 */
#ifndef FBD_DYNAMICS_FRICTION_H
#define FBD_DYNAMICS_FRICTION_H

#include "dynamics/forces.h"

/* What a pair does at an instant, from the slots without friction. */
struct friction_values {
    double N;             /* signed normal force [N]; 0 for a bearing */
    double limit_static;  /* mu_s |N| or the static moment */
    double limit_kinetic; /* mu_k |N| or the kinetic moment */
    double limit;         /* what holds takes up to this: the larger of the two */
    double hold;          /* H: the friction that would hold the body on its surface */
    double force;         /* the friction force (moment) along +x in the present mode */
};

double friction_surface_speed(const struct mode *mode, const struct instant *at, double *acceleration);

/* A coefficient of friction at an instant, and its variation along a direction that the links follow. Of a rope round a
 * drum it is tanh(mu beta / 2), of the sum of its tensions. */
double friction_coefficient(const struct fbd_model *model, int pair, const struct formula *mu,
                            const struct instant *at, const struct direction *along, double *variation);

/* The third derivative of a formula of t: expressions know two, and this one only enters how accelerations
 * vary with time. */
double formula_third(const struct formula *formula, const struct instant *at);

/* The rate of change of that acceleration with time. */
double friction_surface_jerk(const struct mode *mode, const struct instant *at);

struct friction_values friction_at(const struct fbd_model *model, int pair, const struct instant *at,
                                   const double *slots);

/* The variations of N, limits and hold along a direction; `force` varies accordingly. */
struct friction_values friction_along(const struct fbd_model *model, int pair, const struct instant *at,
                                      const double *slots, const struct direction *along,
                                      const double *slots_along);

/* Is there any, where it slips? */
static inline bool friction_rubs(const struct mode *mode)
{
    return mode->mu_k.expr || mode->mu_k.constant > 0;
}

/* A coefficient that is zero whatever happens: the force is 0 in each of its modes, so that there is none to decide. It
 * slips, by convention forwards, and has no events. */
static inline bool friction_is_never(const struct mode *mode)
{
    return mode_is_friction(mode) && !mode->mu_s.expr && !mode->mu_k.expr && mode->mu_s.constant == 0 &&
           mode->mu_k.constant == 0;
}

/* Coefficients by expressions that are zero for now and go on so: the force is 0 in each mode until they do not, and that
 * the body stops or turns back is no event of friction. */
bool friction_is_idle(const struct fbd_model *model, int pair, const struct instant *at,
                      const struct direction *along);

/* Is a coefficient below zero, by more than sums round that come to zero, as 1 + cos(x) does? Friction would push then. The
 * lower one of the two, else 0. */
double friction_below_zero(const struct fbd_model *model, int pair, const struct instant *at);

/* The rounding of the force needed and of its limit: less than this beyond the limit is not beyond it. */
double friction_rounding(const struct friction_values *now);

/* By how much both change within the rounding of the time t of an event: coefficients that begin at zero begin there. */
double friction_rounding_of_time(const struct friction_values *now, const struct friction_values *rate,
                                 double t);

/* What slips without any loss, on ice, comes back to the very limit that it left. How far beyond that errors of a run may
 * have it: there rates decide as at the limit, or it would stick by chance. */
double friction_return(const struct friction_values *now);

/* The mode that follows for a pair whose relative velocity is zero: it sticks while the force needed is within the
 * static limit, else it slips the way the other forces push. `rate` is the variation along the motion: it decides when
 * the force needed is at the limit to rounding, or to `slack`. */
enum slip friction_decide(const struct friction_values *now, const struct friction_values *rate,
                          double slack);

#endif
