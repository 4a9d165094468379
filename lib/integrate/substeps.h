/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The last step made again, in as many parts as the tolerance asks for: where the curve through one step is
 * no good, the mechanism passes a singular position inside say. The parts are made once and kept, so that
 * another sample costs one part, and is the same whichever was asked for first.
 */
#ifndef FBD_INTEGRATE_SUBSTEPS_H
#define FBD_INTEGRATE_SUBSTEPS_H

#include <stddef.h>

struct substeps;

/* What a step is made of. `part` takes y and the slopes f at the time `from` after its start on by h, by
 * steps of the method, and returns the error in units of what is allowed (at most 1 is accepted), infinite
 * where it cannot be made. */
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
 * GSL_SUCCESS; GSL_EFAILED when 500 parts do not come there; GSL_ENOMEM. */
int substeps_to(struct substeps *substeps, const struct substeps_source *source, double whole,
                const double *y0, const double *f0, double to, double *y, double *f);

#endif
