/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A trial's scene at rest, its reactions and limits by name, and checks of them.
 *
 * Forces here are of some 1000 N: 1e-9 N is rounding of the sums (1e-16 of them, times the arms and their
 * number), and far below any digit that a derivation by hand has.
 */
#ifndef FBD_TESTS_REST_CHECKS_H
#define FBD_TESTS_REST_CHECKS_H

#include "fbd_study.h"
#include "gallery.h"

#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

static const double rounding = 1e-9, g = 9.81, pi = 3.14159265358979323846;

/* ---- a trial's scene at rest */

struct rest {
    struct trial trial;
    fbd_errors *errors;
    fbd_statics *statics;
};

static inline struct rest rest_of(struct trial trial)
{
    struct rest rest = {.trial = trial, .errors = fbd_errors_new()};
    assert_non_null(rest.errors);
    rest.statics = fbd_statics_new(trial.state, rest.errors);
    assert_non_null(rest.statics);
    return rest;
}

static inline struct rest rest_open(const char *path, const char *const *settings)
{
    return rest_of(trial_open(path, settings));
}

static inline void rest_close(struct rest *rest)
{
    fbd_statics_free(rest->statics);
    fbd_errors_free(rest->errors);
    trial_close(&rest->trial);
}

static inline size_t body_index(const struct rest *rest, const char *name)
{
    for (size_t b = 0; b < fbd_model_body_count(rest->trial.model); b++)
        if (strcmp(fbd_model_body_name(rest->trial.model, b), name) == 0) return b;
    fail_msg("no body `%s`", name);
    return 0;
}

static inline fbd_arrow arrow(const struct rest *rest, const char *body, const char *name)
{
    enum { most = 32 };
    fbd_arrow arrows[most];
    size_t count = fbd_statics_diagram(rest->statics, body_index(rest, body), arrows, most);
    assert_true(count <= most);
    for (size_t i = 0; i < count; i++)
        if (strcmp(arrows[i].name, name) == 0) return arrows[i];
    fail_msg("no force `%s` on `%s`", name, body);
    return arrows[0];
}

static inline void check_arrow(struct checks *checks, const struct rest *rest, const char *body,
                               const char *name, double fx, double fy)
{
    char what[100];
    fbd_arrow got = arrow(rest, body, name);
    snprintf(what, sizeof what, "%s.%s in x", body, name);
    check_close(checks, what, got.fx, fx, rounding);
    snprintf(what, sizeof what, "%s.%s in y", body, name);
    check_close(checks, what, got.fy, fy, rounding);
}

/* Newton and Euler at rest, for every body; moments about the origin, which does for all of them. */
static inline void check_sums(struct checks *checks, const struct rest *rest)
{
    enum { most = 32 };
    fbd_arrow arrows[most];
    for (size_t b = 0; b < fbd_model_body_count(rest->trial.model); b++) {
        size_t count = fbd_statics_diagram(rest->statics, b, arrows, most);
        double fx = 0, fy = 0, moment = 0;
        for (size_t i = 0; i < count; i++) {
            fx += arrows[i].fx;
            fy += arrows[i].fy;
            moment += arrows[i].couple + arrows[i].x * arrows[i].fy - arrows[i].y * arrows[i].fx;
        }
        const char *name = fbd_model_body_name(rest->trial.model, b);
        check_close(checks, name, fx, 0, rounding);
        check_close(checks, name, fy, 0, rounding);
        check_close(checks, name, moment, 0, 10 * rounding);
    }
}

static inline void check_holds(struct checks *checks, const struct rest *rest, size_t indeterminacy)
{
    check_that(checks, "in equilibrium", fbd_statics_holds(rest->statics));
    check_that(checks, "indeterminate to the degree",
               fbd_statics_indeterminacy(rest->statics) == indeterminacy);
    check_sums(checks, rest);
}

static inline fbd_limit limit(const struct rest *rest, const char *name)
{
    for (size_t i = 0; i < fbd_statics_limit_count(rest->statics); i++)
        if (strcmp(fbd_statics_limit(rest->statics, i).name, name) == 0)
            return fbd_statics_limit(rest->statics, i);
    fail_msg("no limit `%s`", name);
    return fbd_statics_limit(rest->statics, 0);
}

static inline fbd_unbalanced unbalanced(const struct rest *rest, const char *coordinate)
{
    for (size_t i = 0; i < fbd_statics_unbalanced_count(rest->statics); i++)
        if (strcmp(fbd_statics_unbalanced(rest->statics, i).coordinate, coordinate) == 0)
            return fbd_statics_unbalanced(rest->statics, i);
    fail_msg("nothing is said of `%s`", coordinate);
    return fbd_statics_unbalanced(rest->statics, 0);
}

static inline int no_handler(void **unused)
{
    (void)unused;
    gsl_set_error_handler_off();
    return 0;
}

#endif
