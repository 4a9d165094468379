/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Steps near places where a force is infinite.
 *
 * A force K/x^2 with a small K is nothing but for a needle at x = 0, and a step that passes it between two of
 * its stages looks perfect. So the divisors d of all forces are asked how near the needle is: a step takes at
 * most half of the time |d/d'| after which d would be zero, and one that has had a zero or a deep minimum of
 * d inside is cut. Towards a pole the steps halve until the error control sees the force.
 *
 * What has a limit at d = 0, as sin(x)/x, is passed after some 40 steps. It is told apart by the part of the
 * force F that changes with d: for F = A + c/d^p it is p c/d^p = |F' d/d'| but for what A adds, which falls
 * with d. Where it still falls at 1e-12 of the largest d, there is no pole, or none that numbers could tell
 * of; where it grows, steps go on halving, and if no time is left for them the pole is reached and the run
 * ends.
 */
#ifndef FBD_EVENTS_POLES_H
#define FBD_EVENTS_POLES_H

#include <stdbool.h>

#include "dynamics/state.h"

struct poles {
    size_t count;          /* of all formulas together */
    double *most;          /* largest size of each divisor so far */
    double *before, *part; /* at the last step that came nearer: the divisor, and the part above */
    bool *grows;           /* that part, as the divisor falls */
    double *start, *rate;  /* divisors and their rates at the start of the step */
    double *end, *end_rate;
    double *dy; /* 2 n: the direction of the motion */
};

/* For a model, made of `memory`; false when that is out. A model without poles takes nothing. */
bool poles_init(struct poles *poles, const struct fbd_model *model, struct arena *memory);

/* The longest step from an evaluated state that is within reach of no pole, and the pole that bounds it;
 * infinite and NULL where none is approached. */
double poles_longest_step(struct poles *poles, const struct fbd_state *state, const struct pole **nearest);

/* After poles_longest_step, for a step of size h that led to (t, y) with slopes f: has it passed a pole, or
 * come and gone near to it? `during` has the modes of the step. */
bool poles_passed(struct poles *poles, const struct fbd_state *during, double h, double t, const double *y,
                  const double *f);

#endif
