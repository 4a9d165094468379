/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lanes: pendulums that advance together in the vectors of the processor, each with its own time, step size
 * and error control.
 *
 * Steps without events are made by the same operations in the same order as in a run: one attempt of all
 * lanes at a time (nystrom.c, pair8.c), its error relative to the tolerance (error_norm.c), the size of the
 * next one (stepper.c), and the test whether the rounding of accelerations is significant (roundoff.c). There
 * is no branch per lane. A lane that needs anything else keeps its state before that step, which the run
 * itself makes.
 *
 * The functions are one text (lanes_step.h) for registers of two, four and eight numbers.
 */
#ifndef FBD_BATCH_LANES_H
#define FBD_BATCH_LANES_H

enum { most_lanes = 8, most_pairs = 2 };

/* Constants of the equations of motion: of a simple pendulum (rates_row.h), */
enum { swing_inverse, swing_s, swing_kv };

/* and of the two links of a double pendulum (tree_bare.c), with the torques in their joints. */
enum {
    first_along,
    first_sine,
    first_cosine,
    first_I_O,
    first_g,
    last_along,
    last_sine,
    last_cosine,
    last_g,
    last_at_x,
    last_at_y,
    last_moment_x,
    last_moment_y,
    last_force_x,
    last_force_y,
    last_D,
    last_across,
    most_constants
};

/* A number for each lane. */
typedef double each_lane[most_lanes];

/* Components as in the state of a run: coordinates, then rates, then accelerations. */
struct lanes {
    /* constants of the runs */
    each_lane until, tolerance, cap[most_pairs], noise[most_pairs], floor[most_pairs];
    each_lane constants[most_constants];
    each_lane pause; /* steps from `since` = 0 until the round-off level is updated */
    /* after the last step */
    each_lane t, h; /* h: proposed size of the next step */
    each_lane y[3 * most_pairs], before[3 * most_pairs];
    each_lane rest[2 * most_pairs];
    each_lane scale[2 * most_pairs];
    each_lane most[2 * most_pairs]; /* largest magnitudes at the starts of steps */
    each_lane rate;
    each_lane since;
    each_lane steps_left; /* remaining number of steps permitted here */
    each_lane growth;     /* step size factor of the last step: stepper_counts */
    each_lane accepted, rejected;
    /* of the step in progress */
    each_lane tried, tried_rate; /* size of the next attempt, and its estimate of the fastest rate */
    each_lane attempts;          /* rejected attempts */
};

/* Make steps in the lanes of the mask `active` until some of them need something else; returns these. */
typedef unsigned lanes_function(struct lanes *lanes, unsigned active);

/* The equations of motion and the method. */
enum lane_motion { swings, swings_damped, swings_double, motions };

extern lanes_function *const lanes_by_two[motions], *const lanes_by_four[motions],
                                                        *const lanes_by_eight[motions];

#endif
