/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Programs by hand on GSL's own driver, as its manual has them.
 *
 * The belt cannot be done by gsl_odeiv2_driver_apply: the loop is on gsl_odeiv2_evolve_apply, and a step over
 * an event is redone from its start with the length that Newton finds.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

#include "accuracy.h"
#include "dop853_by_hand.h"

/* ---- smooth, and pieces between known times */

static int apply(gsl_odeiv2_driver *driver, struct mode *mode, double *t, double until, double *y)
{
    if (mode->problem->kind != square) return gsl_odeiv2_driver_apply(driver, t, until, y);
    while (*t < until) {
        double half = floor(*t / WAVE_HALF + 0.5), next = fmin((half + 1) * WAVE_HALF, until);
        mode->force = fmod(half, 2) == 0 ? WAVE_SIZE : -WAVE_SIZE;
        gsl_odeiv2_driver_reset(driver);
        int status = gsl_odeiv2_driver_apply(driver, t, next, y);
        if (status != GSL_SUCCESS) return status;
    }
    return GSL_SUCCESS;
}

static double by_driver(const struct problem *problem, const gsl_odeiv2_step_type *type, double tolerance)
{
    struct mode mode = {.problem = problem};
    gsl_odeiv2_system system = {problem->rhs, problem->jacobian, problem->size, &mode};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_scaled_new(&system, type, 1e-4, tolerance, tolerance, 1, 0, problem->scale);
    double t = 0, y[most_size], error = 0;
    if (!driver) return NAN;
    memcpy(y, problem->y0, sizeof y);
    for (size_t i = 0; i < problem->time_count; i++) {
        if (apply(driver, &mode, &t, problem->times[i], y) != GSL_SUCCESS) error = NAN;
        error = fmax(error, problem_error(problem, t, y));
    }
    gsl_odeiv2_driver_free(driver);
    return error;
}

/* ---- events */

struct loop {
    gsl_odeiv2_step *step;
    gsl_odeiv2_control *control;
    gsl_odeiv2_evolve *evolve;
};

static double event(const struct mode *mode, const double *y, double *rate)
{
    return mode->problem->kind == bounce ? ball_event(mode, y, rate) : belt_event(mode, y, rate);
}

static void happen(struct mode *mode, double *y)
{
    if (mode->problem->kind == bounce) {
        y[0] = BALL_RADIUS;
        y[1] *= -BALL_RESTITUTION;
        return;
    }
    mode->sticking = !mode->sticking;
    y[1] = BELT_SPEED;
}

/* From (t0, y0) to where the event function is zero: Newton on the length of the step. */
static int locate(struct loop *loop, const gsl_odeiv2_system *system, double t0, const double *y0, double *t,
                  double *y)
{
    enum { most = 20 };
    double length = *t - t0, rate, errors[2];
    double g = event(system->params, y, &rate);
    for (int i = 0; i < most; i++) {
        double move = -g / rate;
        length = fmin(fmax(length + move, 0), *t - t0);
        memcpy(y, y0, 2 * sizeof *y);
        int status = gsl_odeiv2_step_apply(loop->step, t0, length, y, errors, NULL, NULL, system);
        if (status != GSL_SUCCESS) return status;
        if (fabs(move) <= 4e-16 * (t0 + length)) break;
        g = event(system->params, y, &rate);
    }
    *t = t0 + length;
    return GSL_SUCCESS;
}

static int run_events(struct loop *loop, const gsl_odeiv2_system *system, double until, double *y)
{
    struct mode *mode = system->params;
    double t = 0, h = 1e-3, rate;
    while (t < until) {
        double t0 = t, y0[2] = {y[0], y[1]};
        int status =
            gsl_odeiv2_evolve_apply(loop->evolve, loop->control, loop->step, system, &t, until, &h, y);
        if (status != GSL_SUCCESS) return status;
        /* At the start of a slip the velocity leaves that of the belt: zero, but not an event. */
        if (event(mode, y, &rate) > 0 || t == t0) continue;
        status = locate(loop, system, t0, y0, &t, y);
        if (status != GSL_SUCCESS) return status;
        happen(mode, y);
        gsl_odeiv2_evolve_reset(loop->evolve);
        gsl_odeiv2_step_reset(loop->step);
    }
    return GSL_SUCCESS;
}

static double by_events(const struct problem *problem, const gsl_odeiv2_step_type *type, double tolerance)
{
    struct mode mode = {.problem = problem, .sticking = true};
    gsl_odeiv2_system system = {problem->rhs, problem->jacobian, 2, &mode};
    struct loop loop = {gsl_odeiv2_step_alloc(type, 2),
                        gsl_odeiv2_control_scaled_new(tolerance, tolerance, 1, 0, problem->scale, 2),
                        gsl_odeiv2_evolve_alloc(2)};
    double y[2] = {problem->y0[0], problem->y0[1]}, error = NAN, end = problem->times[0];
    if (run_events(&loop, &system, end, y) == GSL_SUCCESS) error = problem_error(problem, end, y);
    gsl_odeiv2_evolve_free(loop.evolve);
    gsl_odeiv2_control_free(loop.control);
    gsl_odeiv2_step_free(loop.step);
    return error;
}

/* ---- the solvers */

static double run_rk8pd(const struct problem *problem, const fbd_model *model, double tolerance)
{
    (void)model;
    return problem->kind == belt || problem->kind == bounce
               ? by_events(problem, gsl_odeiv2_step_rk8pd, tolerance)
               : by_driver(problem, gsl_odeiv2_step_rk8pd, tolerance);
}

static double run_rkf45(const struct problem *problem, const fbd_model *model, double tolerance)
{
    (void)model;
    return problem->kind == belt || problem->kind == bounce
               ? by_events(problem, gsl_odeiv2_step_rkf45, tolerance)
               : by_driver(problem, gsl_odeiv2_step_rkf45, tolerance);
}

static double run_bsimp(const struct problem *problem, const fbd_model *model, double tolerance)
{
    (void)model;
    return by_driver(problem, gsl_odeiv2_step_bsimp, tolerance);
}

static double run_msbdf(const struct problem *problem, const fbd_model *model, double tolerance)
{
    (void)model;
    return by_driver(problem, gsl_odeiv2_step_msbdf, tolerance);
}

static double run_dop853(const struct problem *problem, const fbd_model *model, double tolerance)
{
    (void)model;
    struct mode mode = {.problem = problem};
    double t = 0, y[most_size], error = 0;
    memcpy(y, problem->y0, sizeof y);
    for (size_t i = 0; i < problem->time_count; t = problem->times[i++]) {
        if (dop853_by_hand(problem->rhs, &mode, problem->size, t, problem->times[i], y, tolerance,
                           problem->scale))
            return NAN;
        error = fmax(error, problem_error(problem, problem->times[i], y));
    }
    return error;
}

const struct solver gsl_solvers[] = {
    {.name = "C by hand, dop853", .for_others = true, .smooth_only = true, .run = run_dop853},
    {.name = "C by hand, GSL rk8pd", .for_stiff = true, .for_others = true, .run = run_rk8pd},
    {.name = "C by hand, GSL rkf45", .for_others = true, .run = run_rkf45},
    {.name = "C by hand, GSL bsimp", .for_stiff = true, .run = run_bsimp},
    {.name = "C by hand, GSL msbdf", .for_stiff = true, .run = run_msbdf},
};
const size_t gsl_solver_count = sizeof gsl_solvers / sizeof *gsl_solvers;
