/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/newton.h"
#include "numeric/tolerances.h"

#include <math.h>
#include <stdbool.h>

void newton_levels(const gsl_odeiv2_control *control, size_t n, const double *y, const double *f, double h,
                   double *level)
{
    /* GSL declares arguments that it only reads without const. */
    gsl_odeiv2_control *own = (gsl_odeiv2_control *)control;
    for (size_t i = 0; i < n; i++) gsl_odeiv2_control_errlevel(own, y[i], f[i], h, i, &level[i]);
}

double newton_size(size_t n, const double *dy, const double *y, const double *level)
{
    const double roundings = 8;
    double size = 0;
    for (size_t i = 0; i < n; i++) {
        double beyond = fabs(dy[i]) - round_off(roundings, fabs(y[i]));
        if (!(beyond <= 0)) size = fmax(size, beyond / level[i]);
        if (isnan(beyond)) return INFINITY; /* fmax would ignore it */
    }
    return size;
}

/* The error remaining after a correction of size s, each being `rate` times the one before, is s rate / (1 -
 * rate): it must be a hundredth of the allowed error, so that the estimate of the step's error is valid.
 * Corrections that are small and do not decrease are roundings of the slopes. */
enum newton_verdict newton_judge(struct newton *newton, double size)
{
    const double share = 0.01, little = 0.1, slow = 0.9;
    enum { most = 12 };
    bool first = newton->count++ == 0;
    double rate = first ? newton->rate : size / newton->last;
    newton->last = size;
    newton->rate = rate;
    if (size == 0) return newton_done;
    if (!isfinite(size)) return newton_diverges;
    if (!first && rate >= slow) return size <= little ? newton_done : newton_diverges;
    if (rate < slow && size * rate / (1 - rate) <= share) return newton_done;
    return newton->count < most ? newton_go_on : newton_diverges;
}
