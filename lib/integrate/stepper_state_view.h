/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lent: what a switcher goes by from one step to the next, in the hands of somebody who makes steps in its place
 * (lib/batch), and what has become of it. Of systems of few coordinates and their rates, q and v.
 */
#ifndef FBD_INTEGRATE_STEPPER_STATE_VIEW_H
#define FBD_INTEGRATE_STEPPER_STATE_VIEW_H

#include <gsl/gsl_odeiv2.h>

enum { view_most_pairs = 2 };

struct stepper_state_view {
    const gsl_odeiv2_step_type *type; /* of the method that makes the steps */
    size_t pairs;
    /* error_norm.c: of q and of v, and of the pairs */
    double scale[2 * view_most_pairs], cap[view_most_pairs], noise[view_most_pairs], floor[view_most_pairs];
    double tolerance;
    /* q, v and accelerations that are reached, and those one step before */
    double last[3 * view_most_pairs], before[3 * view_most_pairs];
    double rest[2 * view_most_pairs]; /* what q and v have lost by rounding: pair8.h; of other methods 0 */
    double rate;                      /* the fastest that the method has seen lately */
    double steps;                     /* most of them, before the stiff method is to be asked */
    double growth;                    /* stepper_counts */
    unsigned long accepted, rejected; /* steps, and attempts that erred too much, since it was lent */
};

#endif
