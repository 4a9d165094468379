/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A gsl_odeiv2_system that counts its evaluations and rejects NaN and infinity.
 *
 * GSL's steppers and controls treat a NaN as success (a comparison with NaN is never true), and a Newton
 * iteration with one ends in a misleading message. So the wrapper turns a result that is not finite into the
 * return code `system_not_finite`, which every stepper passes on, and records its place.
 */
#ifndef FBD_INTEGRATE_SYSTEM_H
#define FBD_INTEGRATE_SYSTEM_H

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

/* Beyond all codes of gsl_errno.h. */
enum { system_not_finite = 1024 };

struct counted_system {
    gsl_odeiv2_system gsl;   /* passed to steppers; its params point to this object, so do not copy it */
    gsl_odeiv2_system inner; /* the wrapped system */
    unsigned long rhs, jacobians;
    int last_code;       /* of the last evaluation that failed; 0 when none did */
    double last_time;    /* t of that evaluation */
    size_t last_element; /* of the first element that was not finite, if that was the reason: index into dydt,
                            or row times dimension plus column of the Jacobian */
    double last_value;   /* value of that element */
};

/* Wrap `inner`; all counters zero. */
void counted_system_init(struct counted_system *system, const gsl_odeiv2_system *inner);

/* f(t, y), counted and checked like the evaluations of a stepper. */
int counted_system_rhs(struct counted_system *system, double t, const double *y, double *dydt);

/* The function of a counted system's `gsl`. */
int counted_system_function(double t, const double y[], double dydt[], void *params);

/* Record an evaluation that failed, or whose slopes have a sum that is not finite; returns its code. */
int counted_system_note(struct counted_system *system, int code, double t, const double *dydt);

/* f(t, y) of a system of dimension n, for the stages of the usual methods: without the call in between, which
 * would take a third of the time of a pendulum's function. */
static inline int counted_system_eval(const gsl_odeiv2_system *sys, size_t n, double t, const double *y,
                                      double *dydt)
{
    if (sys->function != counted_system_function) return GSL_ODEIV_FN_EVAL(sys, t, y, dydt);
    struct counted_system *system = (struct counted_system *)sys->params;
    double sum = 0;
    system->rhs++;
    int code = system->inner.function(t, y, dydt, system->inner.params);
    for (size_t i = 0; i < n; i++) sum += dydt[i];
    return code == GSL_SUCCESS && isfinite(sum) ? GSL_SUCCESS : counted_system_note(system, code, t, dydt);
}

#endif
