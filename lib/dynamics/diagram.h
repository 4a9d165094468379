/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The free-body diagram as numbers: every named force and moment on a body at an instant, with its point,
 * components, generalized forces and power, and the reaction of the joint.
 *
 * This is the view of the forces by name; the plan's terms (forces.h) are the fast view. Tests compare both:
 * the generalized forces add up to inertia times acceleration.
 */
#ifndef FBD_DYNAMICS_DIAGRAM_H
#define FBD_DYNAMICS_DIAGRAM_H

#include "dynamics/forward.h"

/* One force or moment of the diagram. */
struct arrow {
    const char *name;
    int load; /* index into model.loads, -1 for a reaction; also on the body with the opposite force */
    struct vec force;                         /* in the world */
    struct vec point;                         /* of application, in the world */
    double couple;                            /* a pure moment */
    double share[most_coordinates_of_a_body]; /* its generalized force for each of the body's coordinates */
    double power;
};

/* The most arrows that a body of this model can have, reactions included. */
size_t diagram_arrows(const struct fbd_model *model, int body);

/* The most that any body of it can have, at least 1. */
size_t diagram_most_arrows(const struct fbd_model *model);

/* Fill `arrows` for body `index`; returns their number. `slots` (plan.slots) are the results of
 * accelerations() at the same instant. The reaction, if any, comes last:
 * `pin` of a pivot, `guide` of a slide without a normal force. */
size_t diagram_fill(const struct fbd_model *model, int index, const struct instant *at, const double *slots,
                    struct arrow *arrows);

/* Does the force of a load follow from positions and velocities, without accelerations? */
bool load_is_of_motion(const struct fbd_model *model, int index);

/* The power of such a load, of one between two bodies the sum of those on both; or of friction on a body that stands
 * alone, with the slots of diagram_fill. The links have been moved. */
double load_power(const struct fbd_model *model, int index, const struct instant *at, const double *slots);

/* As diagram_fill, with forces, points and couples only. */
size_t diagram_list(const struct fbd_model *model, int index, const struct instant *at, const double *slots,
                    struct arrow *arrows);

struct vec applied_force(const struct model_load *load, const struct pose *pose, const struct instant *at);

/* The sums of a jointed body's diagram, about its centre of mass, and the values they must have. */
struct balance {
    struct vec force, m_a;
    double moment, I_alpha;
    double residual; /* the largest difference, relative to the largest force, or moment */
};

struct balance balance_of(const struct model_body *body, const struct instant *at, const struct arrow *arrows,
                          size_t count);

/* Position and velocity of the other end of a spring, damper or actuator, where the opposite of its force acts. */
struct motion_of_point other_end(const struct fbd_model *model, const struct model_load *load,
                                 const struct instant *at);

/* Add to the listed loads of a body (tree_diagram.c): the forces of its couplings, the reaction of
 * its joint, and the opposites of the forces in the joints of the bodies that move on it; a listed `normal`
 * gets its force. Returns the total number of arrows. */
size_t tree_diagram_add(const struct fbd_model *model, int index, const struct instant *at,
                        const double *slots, struct arrow *arrows);

/* A load as an arrow on the body that has it; of a reaction only name and point. */
struct arrow load_arrow(const struct fbd_model *model, int index, const struct instant *at,
                        const double *slots);

/* The direction of +x of its motion in the world; (1, 0) on the ground for bodies without a line. */
struct vec body_direction(const struct model_body *body, const struct instant *at);

/* Is it a reaction of the joint of body b, its `normal` included? Its generalized forces are zero. */
bool arrow_is_of_joint(const struct fbd_model *model, int b, const struct arrow *arrow);

/* The body's centre of mass in the world, and its acceleration. */
struct vec mass_center(const struct model_body *body, const struct instant *at);
struct vec mass_center_acceleration(const struct model_body *body, const struct instant *at);

/* The acceleration of a point of its frame, in the world; and of its angle. */
struct vec point_acceleration(const struct model_body *body, struct vec point, const struct instant *at);
double body_angular_acceleration(const struct model_body *body, const struct instant *at);

/* The moment of an arrow about a point. */
double arrow_moment(const struct arrow *arrow, struct vec about);

/* The load whose work includes arrow i of body b, or -1. Of arrows with one load the first has it. A rope
 * does no net work, so that its force is a reaction; but it dissipates energy in the impact as it becomes
 * taut. */
int diagram_account(const struct fbd_model *model, int b, const struct arrow *arrows, size_t i);

/* The load whose column has the work of arrow i, or -1: each arrow is in one column of all bodies, so that
 * they add up. */
int diagram_work_column(const struct fbd_model *model, int b, const struct arrow *arrows, size_t i);

/* The load of the rope whose force on body b the arrow is, or -1 (tree_diagram.c). */
int rope_load(const struct fbd_model *model, int b, const struct arrow *arrow);

/* Is it a reaction, as the force of a surface, joint or rope? */
bool arrow_is_reaction(const struct fbd_model *model, const struct arrow *arrow);

/* The outward normal of the surface of a body, in the world. */
struct vec surface_normal(const struct fbd_model *model, const struct model_body *body,
                          const struct instant *at);

#endif
