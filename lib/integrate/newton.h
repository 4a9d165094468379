/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Termination of the iterations of an implicit method: corrections that decrease by a factor each time,
 * relative to the allowed error (Hairer & Wanner II, IV.8).
 */
#ifndef FBD_INTEGRATE_NEWTON_H
#define FBD_INTEGRATE_NEWTON_H

#include <gsl/gsl_odeiv2.h>

enum newton_verdict { newton_go_on, newton_done, newton_diverges };

struct newton {
    int count;   /* of corrections */
    double last; /* the one before, in units of the allowed error */
    double rate; /* measured last, or that of a similar iteration; 1: unknown */
};

/* Error levels of n components for a step of size h from (y, f). */
void newton_levels(const gsl_odeiv2_control *control, size_t n, const double *y, const double *f, double h,
                   double *level);

/* The size of a correction `dy` of y, in units of the levels. Corrections within the rounding of y count as
 * zero. */
double newton_size(size_t n, const double *dy, const double *y, const double *level);

/* After a correction of this size. */
enum newton_verdict newton_judge(struct newton *newton, double size);

#endif
