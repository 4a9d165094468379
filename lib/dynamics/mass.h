/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The mass of a body at an instant. Where it varies the body keeps its shape and its density changes everywhere alike:
 * G stays, and moments of inertia go with m. What is at the body moves with it, so that its own equations have the mass
 * of the instant and no more,
 *
 *     m a_G = sum of forces,   I_G alpha = sum of moments,
 *
 * among the forces the thrust dm/dt u of mass that leaves or comes at a velocity u relative to the body. With them
 * the kinetic energy changes by their power and by what that mass has at the velocity of the body,
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

/* Of its mass at the start. */
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

/* dm/dt, at an instant that has its places (world_refs.h); and its variation along a direction that has them. */
double body_mass_rate(const struct fbd_model *model, const struct model_body *body, const struct instant *at);
double body_mass_rate_along(const struct fbd_model *model, const struct model_body *body,
                            const struct instant *at, const struct direction *along);

/* The power of what comes: dm/dt v_G^2 / 2 + dI_G/dt omega^2 / 2. */
double body_carried_power(const struct fbd_model *model, const struct model_body *body,
                          const struct instant *at);

#endif
