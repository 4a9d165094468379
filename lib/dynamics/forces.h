/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The plan's terms summed into slots, body by body: all forces except dry friction.
 */
#ifndef FBD_DYNAMICS_FORCES_H
#define FBD_DYNAMICS_FORCES_H

#include "dynamics/kinematics.h"

/* The slots of body `b`. `turn` is cosine and sine of its angle if its terms need both (see body_turn). */
void body_forces(const struct fbd_model *model, int b, const struct instant *at, struct vec turn,
                 double *slots);

/* Cosine and sine of the angle of body `b` if its terms need them. */
static inline struct vec body_turn(const struct fbd_model *model, int b, const struct instant *at)
{
    const struct model_body *body = &model->bodies[b];
    return model->plan.bodies[b].turns ? vec_cos_sin(at->y[body->first + body->count - 1])
                                       : (struct vec){1, 0};
}

/* slots[plan.slots]: generalized forces of the coordinates, then the sums of forces across slides. */
void force_slots(const struct fbd_model *model, const struct instant *at, double *slots);

/* Their variation along a direction (exact, no differences). */
void force_slots_along(const struct fbd_model *model, const struct instant *at, const struct direction *along,
                       double *variation);

/* Add a force f at a point with the given motion to the generalized forces `own` of its body's coordinates.
 */
void add_force(const struct model_body *body, const struct pose *pose, struct motion_of_point point,
               struct vec f, double *own);

#endif
