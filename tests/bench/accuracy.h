/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the files of bench_accuracy share: problems with known solutions, and the programs that solve them.
 *
 * A solver makes one whole run of a problem from nothing, as a program would that wants its end (allocating,
 * integrating, freeing), and says what error is left. The hand-written ones have the right-hand side, the
 * exact Jacobian and the events of the problem in C.
 */
#ifndef FBD_TESTS_BENCH_ACCURACY_H
#define FBD_TESTS_BENCH_ACCURACY_H

#include <stdbool.h>
#include <stddef.h>

#include "fbd.h"

enum { most_times = 4, most_size = 6 };

enum problem_kind {
    smooth,
    belt,   /* sticks and slips */
    square, /* a force that changes its sign at multiples of half a period */
    bounce, /* falls, and goes back up from the floor with a share of its speed */
};

struct problem {
    const char *name, *model, *options; /* the model file, and what fbd-run is told beside it */
    fbd_setting settings[3];
    size_t setting_count;
    size_t size;                  /* of the state */
    const char *names[most_size]; /* its components in fbd */
    enum problem_kind kind;
    bool stiff;
    double times[most_times]; /* where the error is measured, ascending; the last one ends the run */
    size_t time_count;
    double y0[most_size], scale[most_size];
    double c; /* of the oscillator */
    void (*exact)(const struct problem *problem, double t, double *y);
    int (*rhs)(double t, const double y[], double f[], void *context);
    int (*jacobian)(double t, const double y[], double *dfdy, double dfdt[], void *context);
};

extern const struct problem problems[];
extern const size_t problem_count;

/* What the right-hand sides get. */
struct mode {
    const struct problem *problem;
    bool sticking; /* belt */
    double force;  /* square */
};

/* Belt: m = 1 kg, k = 100 N/m, mu_s = 0.4, mu_k = 0.25, 0.2 m/s. Square wave: 10 N on 2 kg, period 0.7 s. */
#define BELT_SPEED   0.2
#define BELT_K       100.0
#define BELT_STATIC  (0.4 * 9.81)
#define BELT_KINETIC (0.25 * 9.81)
#define WAVE_SIZE    5.0 /* m/s^2 */
#define WAVE_HALF    0.35

/* Ball: r = 0.05 m from 1 m above the floor, e = 0.8. */
#define BALL_RADIUS      0.05
#define BALL_RESTITUTION 0.8

double problem_error(const struct problem *problem, double t, const double *y);

/* What is above zero until the mode ends, and its rate: friction left, or velocity left to the belt's. */
double belt_event(const struct mode *mode, const double *y, double *rate);

/* What is above zero until the ball is at the floor, and its rate. */
double ball_event(const struct mode *mode, const double *y, double *rate);

struct solver {
    const char *name;
    bool for_stiff, for_others;
    bool ours;
    bool smooth_only; /* knows no events and no pieces */
    /* The error, or NAN when the run failed. `model` is for ours. */
    double (*run)(const struct problem *problem, const fbd_model *model, double tolerance);
};

extern const struct solver gsl_solvers[], sundials_solvers[];
extern const size_t gsl_solver_count, sundials_solver_count;
extern const char sundials_version[];

#endif
