/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the structure of a scene buys, as ratios of processor times of runs taken in turn (medians of pairs).
 *
 *   pendulum    100 s against hand-written C on GSL's rk8pd driver, both as fast as they can be with an error
 *               of 1e-9 at the end (closed form)
 *   orbit       a particle on a spring to a point of the ground, 1,000 periods, with gravity and without:
 *               error 1e-9 with structure against without (references: tolerance 1e-15)
 *   thousand    1,000 independent pendulums against 1,000 times one
 *   one stiff   1,000 pendulums and a stiff slide against the sum of both
 *
 * A run is made of fbd_simulation_new, all steps, and fbd_simulation_free; the model is compiled before.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fbd.h"
#include "timing.h"

enum { pairs = 41 };

/* ---- a side of a comparison: something that runs, and says where it ended */

struct side {
    const fbd_model *model; /* NULL: the hand-written pendulum */
    double tolerance;
    bool no_structure;
    int times; /* the run is made so often */
    const char *names[4];
    double end[4];
    double seconds; /* of the last run */
};

static int pendulum(double t, const double y[], double f[], void *context)
{
    (void)t, (void)context;
    f[0] = y[1];
    f[1] = -9.81 * sin(y[0]);
    return GSL_SUCCESS;
}

static void run_by_hand(struct side *side)
{
    gsl_odeiv2_system system = {pendulum, NULL, 2, NULL};
    double t = 0, y[2] = {1, 0};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, side->tolerance, 0);
    if (gsl_odeiv2_driver_apply(driver, &t, 100, y) != GSL_SUCCESS) abort();
    gsl_odeiv2_driver_free(driver);
    memcpy(side->end, y, sizeof y);
}

static void run_ours(struct side *side)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = side->tolerance;
    options.no_structure = side->no_structure;
    fbd_errors *errors = fbd_errors_new();
    fbd_simulation *simulation = fbd_simulation_new(side->model, &options, errors);
    fbd_result *result = simulation ? fbd_simulation_run(simulation, NULL) : NULL;
    if (!result || fbd_result_outcome(result) != FBD_DONE) abort();
    for (int i = 0; i < 4 && side->names[i]; i++)
        if (!fbd_state_get(fbd_result_state(result), side->names[i], &side->end[i])) abort();
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_errors_free(errors);
}

static void run(struct side *side)
{
    double before = processor_seconds();
    for (int i = 0; i < side->times; i++) {
        if (side->model)
            run_ours(side);
        else
            run_by_hand(side);
    }
    side->seconds = processor_seconds() - before;
}

static double error_of(const struct side *side, const double *exact, int count)
{
    double error = 0;
    for (int i = 0; i < count; i++) error = fmax(error, fabs(side->end[i] - exact[i]));
    return error;
}

/* The loosest tolerance for which the error is at most 1e-9, and stays so for the stricter ones. */
static double tune(struct side *side, const double *exact, int count)
{
    double tuned = NAN;
    for (int rung = 0; rung < 36; rung++) {
        side->tolerance = pow(10, -6 - 0.25 * rung);
        run(side);
        bool good = error_of(side, exact, count) <= 1e-9;
        if (!good)
            tuned = NAN;
        else if (isnan(tuned))
            tuned = side->tolerance;
    }
    side->tolerance = tuned;
    run(side);
    return error_of(side, exact, count);
}

/* The median of the ratios of times of pairs of runs. */
static double ratio_of(struct side *one, struct side *other)
{
    double ratios[pairs];
    for (int i = 0; i < pairs; i++) {
        run(one);
        run(other);
        ratios[i] = one->seconds / other->seconds;
    }
    return median(ratios, pairs);
}

/* ---- the scenes */

static const char pendulum_text[] =
    "fbd: 1\nbodies:\n  p:\n    motion: {pivot: {at: [0, 0]}}\n    mass: 1 kg\n    center: [0, -1 m]\n"
    "    initial: {theta: 1 rad}\n    forces: [gravity]\nsimulate: {until: 100 s}\n";

static fbd_model *read_model(const char *text)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, strlen(text), "bench", NULL, 0, errors);
    if (!model) fbd_errors_print(errors, stderr), abort();
    fbd_errors_free(errors);
    return model;
}

/* sin(theta/2) = k sn(K + w t, k), k = sin(1/2), w = sqrt(g/L) */
static void pendulum_exact(double t, double *exact)
{
    double k = sin(0.5), w = sqrt(9.81), K = gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE), sn, cn, dn;
    gsl_sf_elljac_e(fmod(K + w * t, 4 * K), k * k, &sn, &cn, &dn);
    exact[0] = 2 * asin(k * sn);
    exact[1] = 2 * k * w * cn;
}

static void bench_pendulum(void)
{
    fbd_model *model = read_model(pendulum_text);
    struct side ours = {.model = model, .times = 1, .names = {"p.theta", "p.omega"}};
    struct side general = ours, hand = {.times = 1};
    general.no_structure = true;
    double exact[2];
    pendulum_exact(100, exact);
    double error = tune(&ours, exact, 2), error_general = tune(&general, exact, 2);
    double error_hand = tune(&hand, exact, 2);
    printf("pendulum, 100 s, hand-written on rk8pd: error %.1e, %.3f ms\n", error_hand, 1e3 * hand.seconds);
    printf("  with structure: error %.1e, time ratio %.2f\n", error, ratio_of(&ours, &hand));
    printf("  without:        error %.1e, time ratio %.2f\n", error_general, ratio_of(&general, &hand));
    fbd_model_free(model);
}

/* With gravity the motion starts from rest, where it is regular: others are chaotic, and an error of 1e-9
 * after 1,000 periods is beyond the rounding of their start. Radial oscillations have the period 2 pi /
 * sqrt(k/m): 1,000 of them. */
static void bench_orbit(bool gravity)
{
    char text[600];
    snprintf(text, sizeof text,
             "fbd: 1\nground: {points: {P: [0, 0]}}\nbodies:\n  p:\n    motion: particle\n    mass: 1 kg\n"
             "    initial: {x: 0.7 m, y: -0.7 m, vx: %s m/s}\n    forces:\n%s"
             "      - spring: {stiffness: 50 N/m, free_length: 0.8 m, to: P}\nsimulate: {until: %.17g s}\n",
             gravity ? "0" : "3", gravity ? "      - gravity\n" : "", 1000 * 2 * acos(-1) / sqrt(50));
    fbd_model *model = read_model(text);
    struct side with = {.model = model, .times = 1, .names = {"p.x", "p.y", "p.vx", "p.vy"}};
    struct side without = with, reference = with;
    without.no_structure = true;
    reference.tolerance = 1e-15;
    run(&reference);
    double exact[4];
    memcpy(exact, reference.end, sizeof exact);
    double error = tune(&with, exact, 4), error_without = tune(&without, exact, 4);
    printf("orbit%s, 1,000 periods: errors %.1e with structure and %.1e without; %.2f times faster\n",
           gravity ? " with gravity" : "", error, error_without, ratio_of(&without, &with));
    fbd_model_free(model);
}

/* `count` pendulums, each started 0.001 rad further out, and `tail` behind them. */
static fbd_model *many(int count, const char *tail)
{
    char *text = malloc(400 * (size_t)count + 1000), *end = text;
    if (!text) abort();
    end += sprintf(end, "fbd: 1\nsimulate: {until: 100 s}\nbodies:\n");
    for (int i = 0; i < count; i++)
        end += sprintf(end,
                       "  p%d:\n    motion: {pivot: {at: [0, 0]}}\n    mass: 1 kg\n    center: [0, -1 m]\n"
                       "    initial: {theta: %.3f rad}\n    forces: [gravity]\n",
                       i, count == 1 ? 1 : 0.5 + 0.001 * i);
    sprintf(end, "%s", tail);
    fbd_model *model = read_model(text);
    free(text);
    return model;
}

static void bench_thousand(void)
{
    static const char stiff[] =
        "  stiff:\n    motion: {slide: {along: 0 deg}}\n    mass: 1 kg\n"
        "    initial: {x: 0.1 m}\n    forces:\n      - spring: {stiffness: 1e8 N/m}\n"
        "      - damper: {coefficient: 3e4 N*s/m}\n      - applied: {value: \"5[N]*sin(3[1/s]*t)\"}\n";
    char alone[600];
    snprintf(alone, sizeof alone, "fbd: 1\nsimulate: {until: 100 s}\nbodies:\n%s", stiff);
    fbd_model *one = many(1, ""), *thousand = many(1000, ""), *mixed = many(1000, stiff),
              *stiff_one = read_model(alone);
    struct side all = {.model = thousand, .tolerance = 1e-10, .times = 1};
    struct side single = {.model = one, .tolerance = 1e-10, .times = 1000};
    struct side with_stiff = {.model = mixed, .tolerance = 1e-10, .times = 1};
    struct side only_stiff = {.model = stiff_one, .tolerance = 1e-10, .times = 1};
    printf("1,000 independent pendulums against 1,000 times one: ratio %.3f\n", ratio_of(&all, &single));
    run(&only_stiff);
    double extra = only_stiff.seconds;
    run(&all);
    double sum = all.seconds + extra;
    run(&with_stiff);
    printf("  and one stiff body: %.3f s, the sum of both is %.3f s\n", with_stiff.seconds, sum);
    fbd_model_free(one);
    fbd_model_free(thousand);
    fbd_model_free(mixed);
    fbd_model_free(stiff_one);
}

int main(void)
{
    setvbuf(stdout, NULL, _IOLBF, 0);
    gsl_set_error_handler_off();
    bench_pendulum();
    bench_orbit(false);
    bench_orbit(true);
    bench_thousand();
    return 0;
}
