/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Steps near positions at which a force is infinite.
 *
 * A force K/x^2 with a small K is negligible except for a narrow peak at x = 0, and a step that passes it
 * between two of its stages has a small estimated error. So the divisors d of all forces limit the step: it
 * is at most half of the time |d/d'| in which d would become zero, and a step inside which d has a zero or a
 * deep minimum is cut. Towards a pole the steps halve until the force dominates the error estimate.
 *
 * A removable singularity at d = 0, as of sin(x)/x, is passed after some 40 steps. It is distinguished by the
 * part of the force F that changes with d: for F = A + c/d^p this is p c/d^p = |F' d/d'| up to the
 * contribution of A, which falls with d. If it still falls at 1e-12 of the largest d, there is no pole, or
 * none within double precision; if it grows, steps are halved further, and when they underflow the pole is
 * reached and the run ends.
 */
#ifndef FBD_EVENTS_POLES_H
#define FBD_EVENTS_POLES_H

#include <stdbool.h>

#include "dynamics/state.h"

struct poles {
    size_t count;          /* of all formulas together */
    double *most;          /* largest size of each divisor so far */
    double *before, *part; /* at the last step that came nearer: the divisor, and the part defined above */
    bool *grows;           /* that part grows as the divisor falls */
    double *start, *rate;  /* divisors and their rates at the start of the step */
    double *end, *end_rate;
    double *dy; /* 2 n: the direction of the motion */
};

/* Allocate in `memory`; false when that is out. A model without poles requires none. */
bool poles_init(struct poles *poles, const struct fbd_model *model, struct arena *memory);

/* The longest step from an evaluated state that does not reach a pole, and the pole that limits it; infinite
 * and NULL if none is approached. */
double poles_longest_step(struct poles *poles, const struct fbd_state *state, const struct pole **nearest);

/* After poles_longest_step, for a step of size h that led to (t, y) with slopes f: has it passed a pole, or
 * had a near minimum inside? `during` has the modes of the step. */
bool poles_passed(struct poles *poles, const struct fbd_state *during, double h, double t, const double *y,
                  const double *f);

#endif
