/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Runs of scenes that a test writes, and the same equations, written out anew, by GSL.
 */
#ifndef FBD_TESTS_RUN_CHECKS_H
#define FBD_TESTS_RUN_CHECKS_H

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gallery.h"

enum { text_room = 2000, trials = 25 };

static const double g = 9.81;

/* Two integrations at tolerances of 1e-12 and below: errors of some thousand steps of each. */
static const double same = 1e-9;

/* ---- runs */

static inline struct trial run_of(const char *text)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = 1e-12;
    struct trial trial = trial_parse(text);
    trial_run(&trial, &options);
    return trial;
}

static inline double get(const struct trial *trial, const char *name)
{
    double value = NAN;
    if (!fbd_state_get(trial->state, name, &value)) fail_msg("there is no %s", name);
    return value;
}

static inline void check_energy(struct checks *checks, struct trial *trial)
{
    fbd_energy energy = fbd_result_energy(trial->result);
    double size = 1 + fabs(energy.kinetic) + fabs(energy.potential) + fabs(energy.work);
    check_close(checks, "energy", energy.residual / size, 0, same);
}

static inline fbd_arrow arrow_of(struct trial *trial, size_t body, const char *name)
{
    fbd_arrow arrows[20];
    size_t count = fbd_diagram(trial->state, body, arrows, 20);
    for (size_t i = 0; i < count; i++)
        if (strcmp(arrows[i].name, name) == 0) return arrows[i];
    fail_msg("there is no force %s", name);
    return arrows[0];
}

typedef int rates(double t, const double *y, double *dydt, void *context);

/* By GSL's pair of order 8 from 0 to t. */
static inline void integrate(rates *function, void *context, size_t size, double t, double *y)
{
    gsl_odeiv2_system system = {function, NULL, size, context};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-13, 1e-13);
    double from = 0;
    assert_non_null(driver);
    assert_int_equal(gsl_odeiv2_driver_apply(driver, &from, t, y), GSL_SUCCESS);
    gsl_odeiv2_driver_free(driver);
}

#endif
