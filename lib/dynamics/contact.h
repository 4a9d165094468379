/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Contacts at an instant: how far apart two shapes are, where they touch, and which features last.
 *
 * Lengths are signed: a gap below zero is a penetration, which no state has beyond rounding. The gap of two
 * sets of corners is the largest over all sides of both of the smallest distance of a corner of the other
 * (the axis that separates convex polygons best: Gottschalk, Lin and Manocha, SIGGRAPH 1996): where they
 * touch that is their distance, and apart it is a lower bound of it, zero at the same instant.
 *
 * All of it needs the links where they are and how they move, as after tree_move().
 */
#ifndef FBD_DYNAMICS_CONTACT_H
#define FBD_DYNAMICS_CONTACT_H

#include "dynamics/instant.h"
#include "dynamics/state.h"

struct gap {
    double x, rate;
    int feature;
};

/* Of one feature of the meeting `index`, as all that follows. */
struct gap feature_gap(const struct fbd_model *model, const struct tree_work *work, int index, int feature);

/* Where the moving point of a feature is along its side, from 0 to `length`; circles: nothing. */
struct place_on_side {
    double foot, rate, length;
};
struct place_on_side feature_foot(const struct fbd_model *model, const struct tree_work *work, int index,
                                  int feature);

/* What a probe of the meeting sees: a function of the motion that reaches zero with a feature that is not
 * there yet. HUGE_VAL where the ones that are there leave none. `slip` are the modes. */
struct gap meeting_probe(const struct fbd_model *model, const struct instant *at, int index, int probe);

/* How deep shapes are in each other by features that are not closed; 0 when they are not. */
double meeting_depth(const struct fbd_model *model, const struct instant *at, int index);

/* The features within `near` of touching that two shapes can have at a time; returns their number. Of more on
 * one side the outermost. */
int meeting_touching(const struct fbd_model *model, const struct tree_work *work, int index, double near,
                     int features[2]);

/* The height of a step that two shapes with corners strike with `speed`, where it is lower than the level of surfaces: a side
 * along which they move has a corner behind it by that much. 0 where there is none. */
double meeting_low_step(const struct fbd_model *model, const struct tree_work *work, int index, double speed);

/* Corners of a thin contact pair (dynamics/contact_thin.h) that come into the circle round the bar get the side on which they
 * are; those outside have none. */
void meeting_turn_sides(const struct fbd_model *model, struct tree_work *work, int index, double near);

/* How far features are apart that count as touching: the rounding of the places that they are made of. */
double meeting_near(const struct fbd_model *model, const struct tree_work *work, int index);

/* How far apart the circles round both shapes are, and how fast they move against each other. */
struct distance {
    double apart, speed;
};
struct distance meeting_distance(const struct fbd_model *model, const struct tree_work *work, int index);

/* The largest speed of a place of its shapes, about. */
double meeting_speed(const struct tree_work *work, const struct meeting *meeting);

/* What a gap may be off by. */
double meeting_rounding(const struct fbd_model *model, const struct tree_work *work, int index);

/* A closed feature may end at an edge: a function for each of two ends that is positive until it does;
 * HUGE_VAL without. */
struct gap feature_end(const struct fbd_model *model, const struct tree_work *work, int index, int feature,
                       int end);

/* A force that is nothing where two bodies touch: a rounding of their weights. What only just touches is not
 * left, and does not slip, by that. */
double contact_slack(const struct fbd_model *model, int coupling);

/* The contact of coupling `coupling`: is it closed? */
bool coupling_is_closed(const struct fbd_model *model, const struct instant *at, int coupling);

/* Where a feature is, in the world. */
struct vec feature_place(const struct fbd_model *model, const struct tree_work *work, int index, int feature);

/* Close what touches and rests on each other at the start, and open all else. */
void contacts_start(struct fbd_state *state);

/* A contact pair in which something starts exactly on a bar and moves to the side from which its forces pull it; -1: none.
 * The state is evaluated. */
int contacts_side_in_doubt(struct fbd_state *state);

/* Are shapes in each other at the start, by more than rounding? Contacts are then as contacts_start has them. */
bool contacts_are_deep(struct fbd_state *state);

/* Move shapes that are in each other at the start, by no more than what a file rounds, out until they touch. The
 * state fits its couplings, which move along. */
void contacts_lift_out(struct fbd_state *state);

/* The meeting whose shapes are deepest in each other, beyond rounding, and how deep; -1 without one. */
int contacts_overlap(struct fbd_state *state, double *depth);

#endif
