/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The last step repeated in as many parts as the tolerance requires: used where one interpolant over the step
 * is inaccurate, as where the mechanism passes a singular position inside. The parts are made once and kept,
 * so that another sample costs one part, and does not depend on the order of samples.
 */
#ifndef FBD_INTEGRATE_SUBSTEPS_H
#define FBD_INTEGRATE_SUBSTEPS_H

#include <stddef.h>

struct substeps;

/* Source of the parts. `part` integrates y and the slopes f from the time `from` after the start of the step
 * over h, by one step of the method, and returns the error ratio (at most 1 is accepted), infinite if it
 * fails. */
struct substeps_source {
    void *context;
    double (*part)(void *context, double from, double h, double *y, double *f);
};

/* For states of n numbers; NULL when memory is out. */
struct substeps *substeps_alloc(size_t n);
void substeps_free(struct substeps *substeps);

/* Another step; nothing is computed. */
void substeps_forget(struct substeps *substeps);

/* y and f at the time `to` after the start of a step of length `whole`, 0 < to < whole, from y0 and f0.
 * GSL_SUCCESS; GSL_EFAILED if 500 attempts do not reach `to`; GSL_ENOMEM. */
int substeps_to(struct substeps *substeps, const struct substeps_source *source, double whole,
                const double *y0, const double *f0, double to, double *y, double *f);

#endif
