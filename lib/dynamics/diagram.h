/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The free-body diagram as numbers: every named force and moment on a body at an instant, with its point,
 * components, share of each equation and power, and the reaction that the motion's guide adds.
 *
 * This is the by-name view of the physics; the plan's terms (forces.h) are the fast view. Both are held
 * against each other by tests: the shares add up to inertia times acceleration.
 */
#ifndef FBD_DYNAMICS_DIAGRAM_H
#define FBD_DYNAMICS_DIAGRAM_H

#include "dynamics/forward.h"

/* One arrow of the diagram. */
struct arrow {
    const char *name;
    int load; /* index into model.loads, -1 for a reaction; on the body that feels the opposite, too */
    struct vec force;                         /* in the world */
    struct vec point;                         /* where it acts, in the world */
    double couple;                            /* a moment by itself */
    double share[most_coordinates_of_a_body]; /* of the generalized force of each of the body's coordinates */
    double power;
};

/* The most arrows that a body of this model can have, reactions included. */
size_t diagram_arrows(const struct fbd_model *model, int body);

/* The most that any body of it can have, at least 1. */
size_t diagram_most_arrows(const struct fbd_model *model);

/* Fill `arrows` for body `index`; returns their number. `slots` (plan.slots) and `a` (n) are the results of
 * accelerations() at the same instant. The reaction, if any, comes last:
 * `pin` of a pivot, `guide` of a slide without a normal force. */
size_t diagram_fill(const struct fbd_model *model, int index, const struct instant *at, const double *a,
                    const double *slots, struct arrow *arrows);

/* The power of one load, as diagram_fill has it: of a body on the ground, and not of a reaction (`normal`). */
double load_power(const struct fbd_model *model, int index, const struct pose *pose, const struct instant *at,
                  const double *slots);

/* As diagram_fill without shares and powers, for who asks for forces, points and couples alone. */
size_t diagram_list(const struct fbd_model *model, int index, const struct instant *at, const double *a,
                    const double *slots, struct arrow *arrows);

/* The world components of an applied force. */
/* Where a load acts: `point`, the place of its point of the body, or beside it. */
struct vec load_place(const struct model_load *load, struct vec point, const struct instant *at);

/* The drag on a point that moves at `v`. */
struct vec drag_of_load(const struct model_load *load, struct vec v, const struct instant *at);

struct vec applied_force(const struct model_load *load, const struct pose *pose, const struct instant *at);

/* The sums of a jointed body's diagram, about its centre of mass, beside what they are to be. */
struct balance {
    struct vec force, m_a;
    double moment, I_alpha;
    double residual; /* the largest difference, as a share of the largest force, or moment */
};

struct balance balance_of(const struct model_body *body, const struct instant *at, const struct arrow *arrows,
                          size_t count);

/* Where the other end of a spring or damper is, and how it moves. */
struct motion_of_point other_end(const struct fbd_model *model, const struct model_load *load,
                                 const struct instant *at);

/* For a jointed body, behind what it lists (tree_diagram.c): the couplings that hold it, the force of its
 * joint, and the opposite of what acts in the joints of the bodies that move on it; a listed `normal` gets its
 * force. Returns the number of all arrows. */
size_t tree_diagram_add(const struct fbd_model *model, int index, const struct instant *at,
                        const double *slots, struct arrow *arrows);

/* A load as an arrow on the body that has it; of a reaction only name and point. */
struct arrow load_arrow(const struct fbd_model *model, int index, const struct instant *at,
                        const double *slots);

/* The direction of +x of its motion in the world; (1, 0) on the ground for what is on no line. */
struct vec body_direction(const struct model_body *body, const struct instant *at);

/* Is it what the joint of body b itself gives, its `normal` included? It does nothing along the coordinates. */
bool arrow_is_of_joint(const struct fbd_model *model, int b, const struct arrow *arrow);

/* The acceleration of the body's centre of mass. */
struct vec mass_center_acceleration(const struct model_body *body, const struct instant *at, const double *a);

/* That of a point of its frame, in the world; and of its angle. */
struct vec point_acceleration(const struct model_body *body, struct vec point, const struct instant *at,
                              const double *a);
double body_angular_acceleration(const struct model_body *body, const struct instant *at, const double *a);

/* The moment of an arrow about a point. */
double arrow_moment(const struct arrow *arrow, struct vec about);

/* The load whose work is told with arrow i of body b, or -1. The first of those that share a load has it. A rope does no
 * work in all, so that its force is a reaction; but it takes energy where it becomes taut with a jerk. */
int diagram_account(const struct fbd_model *model, int b, const struct arrow *arrows, size_t i);

/* That which stands in a column with arrow i, or -1: each in one column of all bodies', so that they add up. */
int diagram_work_column(const struct fbd_model *model, int b, const struct arrow *arrows, size_t i);

/* The load of the rope whose force on body b the arrow is, or -1 (tree_diagram.c). */
int rope_load(const struct fbd_model *model, int b, const struct arrow *arrow);

/* Does it follow from the others, as what a surface, a joint or a rope gives? */
bool arrow_is_reaction(const struct fbd_model *model, const struct arrow *arrow);

/* The direction that the surface of a body pushes to, in the world. */
struct vec surface_normal(const struct fbd_model *model, const struct model_body *body,
                          const struct instant *at);

#endif
