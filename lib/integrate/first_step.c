/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/first_step.h"

#include <gsl/gsl_errno.h>
#include <math.h>

#include "integrate/error_norm.h"
#include "numeric/tolerances.h"

/* a / b where both are positive, else no bound. */
static double time_of(double a, double b)
{
    return a > 0 && b > 0 ? a / b : INFINITY;
}

/* tau_1 of the header for all components; scales for a step of size zero. */
static double time_of_slopes(const struct layout *layout, const double *y, const double *f,
                             const double *scale)
{
    size_t n = layout->pairs, size = layout_size(layout);
    double tau = INFINITY;
    for (size_t i = 0; i < n; i++) {
        double v = fabs(y[n + i]), a = fabs(f[n + i]);
        double distance = a > 0 ? fmax(scale[i], v * v / a) : scale[i];
        tau = fmin(tau, fmin(time_of(distance, v), sqrt(time_of(distance, a))));
    }
    for (size_t i = 2 * n; i < size; i++) tau = fmin(tau, time_of(scale[i], fabs(f[i])));
    return tau;
}

/* tau_2 of the header for all components, with slopes f and f1 a time h apart. Slope and scale are those of
 * the start: an Euler step far too long makes both large. */
static double time_of_change(const struct layout *layout, double h, const double *f, const double *f1,
                             const double *scale)
{
    size_t size = layout_size(layout);
    double tau = INFINITY;
    for (size_t i = layout->pairs; i < size; i++) {
        double change = fabs(f1[i] - f[i]) / h;
        if (change > 0 && (f[i] != 0 || scale[i] > 0))
            tau = fmin(tau, fmax(fabs(f[i]) / change, sqrt(scale[i] / change)));
    }
    return tau;
}

/* f1 at the end of an Euler step of size *h, which is shortened until that succeeds. */
static int euler_slopes(struct counted_system *system, double t, const double *y, const double *f, double *h,
                        double *y1, double *f1)
{
    enum { attempts = 12 };
    int code = GSL_SUCCESS;
    for (int k = 0; k < attempts; k++) {
        for (size_t i = 0; i < system->gsl.dimension; i++) y1[i] = y[i] + *h * f[i];
        code = counted_system_rhs(system, t + *h, y1, f1);
        if (code == GSL_SUCCESS || code == GSL_EBADFUNC) break;
        *h *= 0.1;
    }
    return code;
}

/* tau_2 by an Euler step of *probe, which is shortened while the slopes change so much within it that the
 * change is unrelated to the start: an exponential may overflow there. */
static int probe_change(struct counted_system *system, const struct layout *layout, double t, const double *y,
                        const double *f, const double *scale, double *y1, double *f1, double *probe,
                        double *tau)
{
    enum { attempts = 8 };
    for (int k = 0;; k++) {
        int code = euler_slopes(system, t, y, f, probe, y1, f1);
        if (code != GSL_SUCCESS) return code;
        *tau = time_of_change(layout, *probe, f, f1, scale);
        double shorter = fmax(least_change_time * *probe, round_off(time_roundings, fabs(t)));
        if (*tau >= least_change_time * *probe || shorter >= *probe || k == attempts) return GSL_SUCCESS;
        *probe = shorter;
    }
}

int first_step(struct counted_system *system, const struct layout *layout, const gsl_odeiv2_control *control,
               int order, double t, const double *y, const double *f, double h_max, double *work, double *h)
{
    size_t size = layout_size(layout);
    double *y1 = work, *f1 = work + size, *scale = work + 2 * size;
    error_norm_scales(control, 0, y, f, scale);
    double tau = time_of_slopes(layout, y, f, scale);
    /* Bounded below, as a coordinate that is zero up to rounding may still give too short a time. */
    double shortest = fmax(shortest_probe * h_max, round_off(time_roundings, fabs(t)));
    double probe = fmin(h_max, tau < INFINITY ? fmax(0.01 * tau, shortest) : usual_probe * h_max);
    double change;
    int code = probe_change(system, layout, t, y, f, scale, y1, f1, &probe, &change);
    if (code != GSL_SUCCESS) return code;
    tau = fmin(fmax(tau, probe), change);
    double part = pow(0.01 * error_norm_tolerance(control), 1.0 / (order + 1));
    *h = fmin(h_max, 100 * probe);
    /* Slopes that are round-off, as of a box that has come to rest, change at once: not below the resolution of t. */
    if (tau < INFINITY) *h = fmin(*h, fmax(tau * part, round_off(time_roundings, fabs(t))));
    return GSL_SUCCESS;
}
