/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The mass of a body at an instant. A body of variable mass keeps its shape, and its density changes
 * uniformly: G is fixed, and moments of inertia are proportional to m. Added mass moves with the body, so
 * that its equations contain the mass of the instant only,
 *
 *     m a_G = sum of forces,   I_G alpha = sum of moments,
 *
 * with the thrust dm/dt u among the forces, of mass that leaves or arrives with the velocity u relative to
 * the body. The kinetic energy changes by their power and by that of the added mass at the velocity of the
 * body,
 *
 *     dT/dt = sum of f . v + dm/dt v_G^2 / 2 + dI_G/dt omega^2 / 2.
 */
#ifndef FBD_DYNAMICS_MASS_H
#define FBD_DYNAMICS_MASS_H

#include "dynamics/kinematics.h"

static inline double body_mass(const struct model_body *body, const struct instant *at)
{
    return body->varies ? formula_value(&body->mass, at) : body->inertia.mass;
}

/* Relative to its mass at the start. */
static inline double body_share(const struct model_body *body, const struct instant *at)
{
    return body->varies ? formula_value(&body->mass, at) / body->inertia.mass : 1;
}

struct inertia body_inertia(const struct model_body *body, const struct instant *at);

/* About the axis of a pivot. */
static inline double body_I_O(const struct model_body *body, const struct instant *at)
{
    return body->varies ? body->I_O * body_share(body, at) : body->I_O;
}

/* The inertia in the equation of motion of coordinate k: I_O, I_G or the mass. */
static inline double coordinate_inertia_at(const struct model_body *body, int k, const struct instant *at)
{
    if (!body->varies) return coordinate_inertia(body, k);
    return coordinate_is_angle(body, k) ? coordinate_inertia(body, k) * body_share(body, at)
                                        : body_mass(body, at);
}

/* dm/dt, at an extended instant (world_refs.h); and its variation along an extended direction. */
double body_mass_rate(const struct fbd_model *model, const struct model_body *body, const struct instant *at);
double body_mass_rate_along(const struct fbd_model *model, const struct model_body *body,
                            const struct instant *at, const struct direction *along);

/* The power of the added mass: dm/dt v_G^2 / 2 + dI_G/dt omega^2 / 2. */
double body_carried_power(const struct fbd_model *model, const struct model_body *body,
                          const struct instant *at);

#endif
