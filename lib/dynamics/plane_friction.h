/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dry friction of a point on a horizontal plane, seen from above: isotropic, of at most c = mu N with N known.
 * With u the velocity of the point relative to the plane below it, which may be that of a body,
 *
 *     slip    f = -c_k u / |u|
 *     stick   u = 0, f a reaction with |f| <= c_s
 *
 * The rows of the coupling are e . u and (k x e) . u, constraints of velocities while the point sticks. While it
 * slips e is the direction of u at the start of the slip, renewed where u has turned by 60 degrees, and the force is
 *
 *     f = -c_k s w / |w|,   w = u + nu e,   s = sign(e . w)
 *
 * with nu the speed that f gives the body in 1e-10 of the run, at a start from rest at least the error of the run, and the part
 * of w across e zero where it is round-off. Without both the direction of u at a start from rest, or shortly before a stop, would be
 * that of errors, and the stages of an explicit step, however short, would amplify it by c over the acceleration, or by the
 * speed at the start over that at the end. So along a straight path the right-hand side continues smoothly through u = 0, and
 * e . u crosses zero there. With other forces u approaches zero along a curve, whose direction near its end is that of these
 * forces: e . u is zero where u has turned by a right angle as well, and then e is renewed only.
 *
 * A point whose force reaches its limit continuously sets out without an acceleration: its velocity then follows the direction
 * of the force that it lacks, at a rate c/(m |u|) without bound. Such a start is made by the implicit method where the run may
 * choose one, and velocities against e below a part of nu do not end it. A point that sets out with a jump, from static to
 * kinetic friction, has the direction of its acceleration. In the microseconds of a start an explicit method may still turn u:
 * where that could break other friction away the scene is refused (model/plane_check.c).
 *
 * At rest the forces of the points that may stick minimize 1/2 lambda . W lambda + b . lambda with |lambda_i| <= c_i, by the
 * principle of Gauss with dissipation (numeric/disc_forces.h; J. J. Moreau, in Nonsmooth Mechanics and Applications, Springer
 * 1988): with W the accelerations by unit forces and b those without them. Those inside of their disc stick. The acceleration of
 * the others is opposite to their force, which is the direction in which they begin to slip.
 *
 * An impact has no impulse of this friction, which is bounded.
 */
#ifndef FBD_DYNAMICS_PLANE_FRICTION_H
#define FBD_DYNAMICS_PLANE_FRICTION_H

#include "dynamics/constraint_view.h"

struct fbd_state;
struct decided;

/* constraint_forms */
void plane_rows(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
                struct row *rows);
void plane_follow(const struct view *view, const struct coupling *coupling, struct coupling_state *state);

/* Does any point stick? */
bool planes_stick(const struct tree *tree, const struct instant *at);

/* Subtract the forces of slipping planes from the bias forces of the links. */
void planes_load(const struct fbd_model *model, const struct instant *at);

/* Set the multipliers of their rows to these forces. */
void planes_take_multipliers(const struct fbd_model *model, const struct instant *at);

/* Their variations, where the rows have theirs: subtracted from the forces of the links, and, after a solution, as the
 * variations of the multipliers in work->z. */
void planes_apply_variations(const struct fbd_model *model, const struct instant *at,
                             const struct direction *along);
void planes_take_variations(const struct fbd_model *model, const struct instant *at,
                            const struct direction *along);

/* The relative speed at the positions and velocities of the links, and the speeds of which it is the difference. */
struct plane_speed {
    double slip, size;
};
struct plane_speed plane_speed(const struct fbd_model *model, const struct tree_work *work, int index);

/* Does a point begin to slip without an acceleration of its own, or a body at several points? The directions of their forces
 * then follow that of the motion at rates that are unlimited. */
bool planes_set_out(struct fbd_state *state);

/* Are both couplings points of one body on one plane? */
bool planes_are_one(const struct tree *tree, int one, int other);

/* Let a point begin to slip with a velocity along both rows; `gently`: without an acceleration of its own. */
void plane_set_out(struct fbd_state *state, int pair, struct vec along, bool gently);

/* Let the path of a point begin in the direction e, or in that of its velocity, with nu of its speeds at the instant. */
void plane_begin(const struct fbd_model *model, const struct instant *at, int index, struct vec e);
void plane_aim(const struct fbd_model *model, const struct instant *at, int index);

/* Decide all of them at an evaluated state; true when the modes stay as they are. Sets state->holds when memory is
 * out. */
bool planes_settle(struct fbd_state *state, const struct decided *decided);

/* After an impact, which has no impulse of it: let a point slip that stuck and has got a velocity. */
void plane_unstick(struct fbd_state *state, int pair);

/* Direct all of them along the velocities of a state that is not settled. */
void planes_aim(struct fbd_state *state);

#endif
