/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lanes: pendulums that advance together, each with a time, a step size and a judgement of its own, by the vectors of the
 * processor.
 *
 * What a run does in a step in which nothing happens is done here by the same operations in the same order: one attempt of
 * all lanes at a time (nystrom.c, pair8.c), its error relative to the tolerance (error_norm.c), the size of the next one
 * (stepper.c), and whether the rounding of accelerations counts (roundoff.c). There is no branch for a lane. One in which
 * anything else is due keeps what it had before that step, and the run itself makes it.
 *
 * The functions are one text (lanes_step.h) for registers of two, four and eight numbers.
 */
#ifndef FBD_BATCH_LANES_H
#define FBD_BATCH_LANES_H

enum { most_lanes = 8, most_pairs = 2 };

/* The constants of the equations of motion: of the row of a pendulum (rates_row.h), */
enum { swing_inverse, swing_s, swing_kv };

/* and of the links of a double one (tree_short.c), first and last; what acts in their joints. */
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
    /* what stays as it is */
    each_lane until, tolerance, cap[most_pairs], noise[most_pairs], floor[most_pairs];
    each_lane constants[most_constants];
    each_lane pause; /* steps from `since` = 0 until the noise is looked at */
    /* after the last step */
    each_lane t, h; /* h: proposed for the next one */
    each_lane y[3 * most_pairs], before[3 * most_pairs];
    each_lane rest[2 * most_pairs];
    each_lane scale[2 * most_pairs];
    each_lane most[2 * most_pairs]; /* the largest from which a step has begun */
    each_lane rate;
    each_lane since;
    each_lane steps_left; /* that may be made here */
    each_lane growth;     /* the factor of the last step: stepper_counts */
    each_lane accepted, rejected;
    /* of the step that is being made */
    each_lane tried, tried_rate; /* size of the next attempt, and the rate that it knows */
    each_lane attempts;          /* that were rejected */
};

/* Make steps in the lanes of the mask `active` until some of them are due to do something else; those. */
typedef unsigned lanes_function(struct lanes *lanes, unsigned active);

/* What moves, and by which method. */
enum lane_motion { swings, swings_damped, swings_double, motions };

extern lanes_function *const lanes_by_two[motions], *const lanes_by_four[motions],
                                                        *const lanes_by_eight[motions];

#endif
