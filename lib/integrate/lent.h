/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lent: what a switcher goes by from one step to the next, in the hands of somebody who makes steps in its place
 * (lib/batch), and what has become of it. Of systems of one coordinate and its rate, q and v.
 */
#ifndef FBD_INTEGRATE_LENT_H
#define FBD_INTEGRATE_LENT_H

#include <gsl/gsl_odeiv2.h>

/* A state, with its acceleration. */
struct lent_state {
    double q, v, a;
};

struct lent {
    const gsl_odeiv2_step_type *type; /* of the method that makes the steps */
    double tolerance;
    double scale_q, scale_v, cap, noise, floor; /* weights.c */
    struct lent_state last, before;             /* the state that is reached, and that one step before it */
    double steps;                               /* most of them, before the stiff method is to be asked */
    double growth;                              /* stepper_counts */
    unsigned long accepted, rejected;           /* steps, and attempts that erred too much, since it was lent */
};

#endif
