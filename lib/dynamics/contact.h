/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Contacts at an instant: the gap between two shapes, their touching features, and the ends of these.
 *
 * Lengths are signed: a negative gap is a penetration, which in a state is only rounding. The gap of two
 * polygons is the largest over all sides of both of the smallest distance of a corner of the other (the best
 * separating axis of convex polygons: Gottschalk, Lin and Manocha, SIGGRAPH 1996): at contact that is their
 * distance, and else a lower bound of it, zero at the same instant.
 *
 * All functions require positions and velocities of the links, as after tree_move().
 */
#ifndef FBD_DYNAMICS_CONTACT_H
#define FBD_DYNAMICS_CONTACT_H

#include "dynamics/constraint.h"
#include "dynamics/instant.h"
#include "dynamics/state.h"
#include "dynamics/tree.h"

struct gap {
    double x, rate;
    int feature;
};

/* Has the contact of this pair ended? */
static inline bool meeting_is_gone(const struct tree_work *work, const struct meeting *meeting)
{
    return !is_there(work, meeting->lifetime);
}

/* The gap of one feature of contact pair `index`, which is also the argument of the functions below. */
struct gap feature_gap(const struct fbd_model *model, const struct tree_work *work, int index, int feature);

/* The position of the moving point of a feature along its side, from 0 to `length`; not for circles. */
struct place_on_side {
    double foot, rate, length;
};
struct place_on_side feature_foot(const struct fbd_model *model, const struct tree_work *work, int index,
                                  int feature);

/* The function of a probe of the contact pair: it reaches zero with a new touching feature. HUGE_VAL if the
 * closed features exclude one. Modes are those of the instant. */
struct gap meeting_probe(const struct fbd_model *model, const struct instant *at, int index, int probe);

/* Can no further feature touch, as the closed ones exclude it or the contact has ended? */
bool meeting_is_closed(const struct fbd_model *model, const struct instant *at, int index);

/* The penetration of the shapes by features that are not closed; 0 without one. */
double meeting_depth(const struct fbd_model *model, const struct instant *at, int index);

/* Find the touching features of two shapes, at most two, within the distance `near`; returns their number. Of
 * more on one side the outermost. */
int meeting_touching(const struct fbd_model *model, const struct tree_work *work, int index, double near,
                     int features[2]);

/* The height of a step against which two polygons hit with `speed`, if it is below the level of surfaces: a
 * corner lies behind a side, along which they move and the impact with this normal pushes, by that much. 0 without
 * one. */
double meeting_low_step(const struct fbd_model *model, const struct tree_work *work, int index, double speed,
                        struct vec normal);

/* Set the sides of the corners of a thin contact pair (dynamics/contact_thin.h) as they enter the circle
 * round the bar; corners outside have none. */
void meeting_turn_sides(const struct fbd_model *model, struct tree_work *work, int index, double near);

/* The distance within which features count as touching: the rounding of positions. */
double meeting_near(const struct fbd_model *model, const struct tree_work *work, int index);

/* The distance between the circumscribed circles of both shapes, and their relative speed. */
struct distance {
    double apart, speed;
};
struct distance meeting_distance(const struct fbd_model *model, const struct tree_work *work, int index);

/* A bound for the speed of points of its shapes. */
double meeting_speed(const struct tree_work *work, const struct meeting *meeting);

/* The rounding of a gap; and by how much the gap of two shapes may jump, twice at most. */
double meeting_rounding(const struct fbd_model *model, const struct tree_work *work, int index);
double meeting_jump(const struct fbd_model *model, const struct tree_work *work, int index);

/* The distance of a closed feature from each of two ends, at an edge, positive until it ends there; HUGE_VAL
 * without. */
struct gap feature_end(const struct fbd_model *model, const struct tree_work *work, int index, int feature,
                       int end);

/* A negligible contact force, the rounding of the weights of two bodies: at smaller forces a contact does not
 * open or slip. */
double contact_slack(const struct fbd_model *model, int coupling);

/* Is the contact of coupling `coupling` closed? */
bool coupling_is_closed(const struct fbd_model *model, const struct instant *at, int coupling);

/* The position of a feature in the world. */
struct vec feature_place(const struct fbd_model *model, const struct tree_work *work, int index, int feature);

/* Close all touching contacts at rest at the start, and open all others. */
void contacts_start(struct fbd_state *state);

/* A contact pair in which a corner starts exactly on a bar and moves to the side from which its forces pull
 * it; -1 if none. The state is evaluated. */
int contacts_side_in_doubt(struct fbd_state *state);

/* Do shapes penetrate each other at the start, by more than rounding? Leaves contacts as contacts_start sets
 * them. */
bool contacts_are_deep(struct fbd_state *state);

/* Move shapes with small penetrations at the start, by rounded numbers in a file, out until they touch. The
 * state satisfies its couplings, which move along. */
void contacts_lift_out(struct fbd_state *state);

/* The contact pair with the deepest penetration beyond rounding, and its depth; -1 without one. */
int contacts_overlap(struct fbd_state *state, double *depth);

#endif
