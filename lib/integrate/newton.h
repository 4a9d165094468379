/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * When to end the iterations of an implicit method: corrections that get smaller by a factor each time, seen
 * in units of the error that is allowed (Hairer & Wanner II, IV.8).
 */
#ifndef FBD_INTEGRATE_NEWTON_H
#define FBD_INTEGRATE_NEWTON_H

#include <gsl/gsl_odeiv2.h>

enum newton_verdict { newton_go_on, newton_done, newton_diverges };

struct newton {
    int count;   /* of corrections */
    double last; /* the one before, in units of the allowed error */
    double rate; /* last seen, or what an iteration like this one has been seen to do; 1: nothing is known */
};

/* Error levels of n components for a step of size h from (y, f). */
void newton_levels(const gsl_odeiv2_control *control, size_t n, const double *y, const double *f, double h,
                   double *level);

/* The size of a correction `dy` of y, in units of the levels. What is no more than rounding of y does not
 * count. */
double newton_size(size_t n, const double *dy, const double *y, const double *level);

/* After a correction of this size. */
enum newton_verdict newton_judge(struct newton *newton, double size);

#endif
