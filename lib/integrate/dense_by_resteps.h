/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The inside of a step that its method can only make again, up to the time asked for: the implicit methods
 * without an interpolant of their own, and explicit ones where there are states that are no pairs. Made again for each
 * sample, an event function that is followed closely, or a ledger integrated over the step, costs hundreds of
 * steps. So the step is made again up to
 * Chebyshev points, of degree 8, then 16 and 32, until the last three coefficients of the series are below a
 * hundredth of the error that a step may have; every sample is then one of that polynomial, whichever was
 * asked for first. As in series.h it is ASSUMED that what is left out is no more than the last terms. Where
 * they do not fall for the rounding of the step, which is seen by making it again to shares that differ by next
 * to nothing, the polynomial is as good as the step is. Where they do not fall for another reason (a layer at
 * the start of a stiff step), or the method fails inside, there is none and the samples are steps.
 */
#ifndef FBD_INTEGRATE_DENSE_BY_RESTEPS_H
#define FBD_INTEGRATE_DENSE_BY_RESTEPS_H

#include <stdbool.h>
#include <stddef.h>

struct resteps;

/* What the points are taken from and what the tail is measured by. */
struct resteps_source {
    void *context;
    bool (*sample)(void *context, double share,
                   double *y); /* y at this share of the step; false: it failed */
    double (*excess)(void *context,
                     const double *error); /* of n errors: the largest in units of what is allowed */
};

/* For states of n numbers; NULL when memory is out. */
struct resteps *resteps_alloc(size_t n);
void resteps_free(struct resteps *inside);

/* Another step, from y0 to y1; both stay where they are. Nothing is computed. */
void resteps_set(struct resteps *inside, const double *y0, const double *y1);

/* y at a share of the step in [0, 1]. False: there is no polynomial, and y is not touched. */
bool resteps_eval(struct resteps *inside, const struct resteps_source *source, double share, double *y);

#endif
