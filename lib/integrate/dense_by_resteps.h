/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dense output of a step by repeating it up to the requested time: for implicit methods without an
 * interpolant, and for explicit ones with components outside the pairs. A repeated step for each sample would
 * cost hundreds of steps where an event function is followed closely or a ledger is integrated. So the step
 * is repeated up to Chebyshev points, of degree 8, then 16 and 32, until the last three coefficients of the
 * series are below a hundredth of the allowed error; all samples are then evaluated on that polynomial, in
 * any order. As in series.h it is ASSUMED that the truncation error is no more than the last terms. If they
 * do not fall because of the rounding of the step, which is detected by repeating it to slightly different
 * times, the polynomial is as good as the step. If they do not fall for another reason (a layer at the start
 * of a stiff step), or the method fails inside, there is no polynomial and the samples are repeated steps.
 */
#ifndef FBD_INTEGRATE_DENSE_BY_RESTEPS_H
#define FBD_INTEGRATE_DENSE_BY_RESTEPS_H

#include <stdbool.h>
#include <stddef.h>

struct resteps;

/* Source of the samples and norm of the tail. */
struct resteps_source {
    void *context;
    bool (*sample)(void *context, double share,
                   double *y);                            /* y at this share of the step; false: it failed */
    double (*excess)(void *context, const double *error); /* norm of n errors relative to the allowed error */
};

/* For states of n numbers; NULL when memory is out. */
struct resteps *resteps_alloc(size_t n);
void resteps_free(struct resteps *inside);

/* Another step, from y0 to y1; both must remain valid. Nothing is computed. */
void resteps_set(struct resteps *inside, const double *y0, const double *y1);

/* y at a share of the step in [0, 1]. False: there is no polynomial, and y is not touched. */
bool resteps_eval(struct resteps *inside, const struct resteps_source *source, double share, double *y);

#endif
