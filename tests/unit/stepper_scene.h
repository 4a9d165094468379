/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * An oscillator with a stepper, for the tests of the integration loop. To be included after cmocka.h.
 */
#ifndef FBD_TESTS_STEPPER_SCENE_H
#define FBD_TESTS_STEPPER_SCENE_H

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>

#include "integrate/stepper.h"

/* q'' = -omega^2 q - c v + g + force cos(2 t), and what may go wrong with it. */
struct scene {
    double omega, c, g, force;
    double trouble;  /* from this time on (if above 0) */
    int code;        /* ... the right-hand side returns this, */
    bool not_finite; /* ... or a NaN */
    long calls;
};

static inline int rhs(double t, const double y[], double f[], void *params)
{
    struct scene *scene = params;
    scene->calls++;
    bool trouble = scene->trouble > 0 && t >= scene->trouble;
    f[0] = y[1];
    f[1] = -scene->omega * scene->omega * y[0] - scene->c * y[1] + scene->g + scene->force * cos(2 * t);
    if (trouble && scene->not_finite) f[1] = NAN;
    return trouble ? scene->code : GSL_SUCCESS;
}

static inline int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    const struct scene *scene = params;
    (void)y;
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -scene->omega * scene->omega;
    dfdy[3] = -scene->c;
    dfdt[0] = 0;
    dfdt[1] = -2 * scene->force * sin(2 * t);
    return GSL_SUCCESS;
}

/* A stepper with its system and present state. */
struct run {
    gsl_odeiv2_system inner;
    struct counted_system system;
    struct stepper *stepper;
    double t, h, y[2], f[2];
};

static inline void start_with(struct run *run, struct scene *scene, const struct stepper_options *options,
                              double t, double q, double v, double t_limit)
{
    run->inner = (gsl_odeiv2_system){rhs, jacobian, 2, scene};
    counted_system_init(&run->system, &run->inner);
    run->stepper = stepper_alloc(options);
    assert_non_null(run->stepper);
    run->t = t;
    run->y[0] = q;
    run->y[1] = v;
    assert_int_equal(stepper_reset(run->stepper, &run->system, time_dd_at(t), run->y, run->f,
                                   time_dd_at(t_limit), &run->h),
                     GSL_SUCCESS);
}

static inline void start(struct run *run, struct scene *scene, const struct method *method, double tolerance,
                         double q, double v, double t_limit)
{
    struct stepper_options options = {.method = method, .layout = {.pairs = 1}, .tolerance = tolerance};
    start_with(run, scene, &options, 0, q, v, t_limit);
}

static inline enum stepper_status step(struct run *run, double t_limit)
{
    struct time_dd t = time_dd_at(run->t);
    enum stepper_status status =
        stepper_step(run->stepper, &run->system, &t, run->y, run->f, &run->h, time_dd_at(t_limit));
    assert_true(t.rest == 0);
    run->t = t.t;
    return status;
}

static inline void run_to(struct run *run, double t_limit)
{
    while (run->t < t_limit) assert_int_equal(step(run, t_limit), stepper_ok);
    assert_true(run->t == t_limit);
}

/* q'' = -q + cos 2t from q = 1, v = 0. */
static inline double forced_q(double t)
{
    return (4 * cos(t) - cos(2 * t)) / 3;
}

static inline double forced_v(double t)
{
    return (-4 * sin(t) + 2 * sin(2 * t)) / 3;
}

static inline double deviation(const double y[2], double t)
{
    return fmax(fabs(y[0] - forced_q(t)), fabs(y[1] - forced_v(t)));
}

/* Tolerances for which each method takes a bearable number of steps. */
static inline double tolerance_for(const struct method *method)
{
    return method->order >= 4 ? 1e-8 : method->order >= 2 ? 1e-6 : 1e-4;
}

#endif
