/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data on which the next step of a switcher depends, for an integrator that makes steps in its place
 * (lib/batch), and their values after those steps. For systems of few coordinates and rates, q and v.
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
    /* q, v and accelerations of the last accepted state, and of the one before it */
    double last[3 * view_most_pairs], before[3 * view_most_pairs];
    double rest[2 * view_most_pairs]; /* rounding errors of q and v (pair8.h); of other methods 0 */
    double rate;                      /* the fastest that the method has detected lately */
    double steps;  /* largest number of steps before the next attempt of the implicit method */
    double growth; /* stepper_counts */
    unsigned long accepted,
        rejected; /* steps, and attempts with too large an error, since the copy was made */
};

#endif
