/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A chain of 64 rods in one line, let go from the horizontal, for 1 s: whole runs of ours at every tolerance beside
 * C by hand (the recursion of chain_by_hand.c in dop853) at the same error.
 *
 * The program by hand climbs a ladder of tolerances, and its time at our error is interpolated (log-log) between the
 * rungs beside. Errors are those of all angles and rates at the end, over the largest angle and the largest rate,
 * against the program by hand at 1e-15. Times are those of the processor, the least of some runs, in turn.
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"
#include "claim.h"
#include "dop853_by_hand.h"
#include "fbd.h"
#include "timing.h"

enum { rods = 64, size = 2 * rods, rungs = 23, tolerances = 10, rounds = 5 };

static const double until = 1, bound = 1.3, right_angle = 1.5707963267948966;

/* ---- by hand */

static int rates(double t, const double y[], double dydt[], void *chain)
{
    (void)t;
    chain_by_hand.rates(chain, y, dydt);
    return 0;
}

static bool run_by_hand(double tolerance, double *y)
{
    void *chain = chain_by_hand.open(rods);
    memset(y, 0, size * sizeof *y);
    y[0] = right_angle;
    bool done = chain && dop853_by_hand(rates, chain, size, 0, until, y, tolerance, NULL) == 0;
    if (chain) chain_by_hand.close(chain);
    return done;
}

/* ---- ours */

static fbd_model *make_model(void)
{
    char *text = NULL;
    size_t length;
    FILE *file = open_memstream(&text, &length);
    if (!file) exit(1);
    fputs("fbd: 1\nbodies:\n", file);
    for (int i = 1; i <= rods; i++) {
        fprintf(file, "  rod%d:\n    shape: rod\n    mass: %.17g kg\n    forces: [gravity]\n", i, CHAIN_MASS);
        fprintf(file, "    from: [0, 0]\n    to: [0, %.17g m]\n", -CHAIN_LENGTH);
        if (i == 1) fputs("    motion: pivot\n    initial: {theta: 90 deg}\n", file);
        if (i > 1) fprintf(file, "    motion: {pivot: {on: rod%d, at: right, point: left}}\n", i - 1);
    }
    fclose(file);
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, length, "chain", NULL, 0, errors);
    fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    free(text);
    if (!model) exit(1);
    return model;
}

static void read_end(fbd_simulation *simulation, const fbd_model *model, double *y)
{
    fbd_state *state = fbd_state_new(model);
    if (!state || !fbd_simulation_state(simulation, until, state)) exit(1);
    for (size_t i = 0; i < rods; i++) {
        fbd_coordinate c = fbd_model_coordinate(model, i);
        if (!fbd_state_get(state, c.name, &y[i]) || !fbd_state_get(state, c.rate_name, &y[rods + i])) exit(1);
    }
    fbd_state_free(state);
}

static bool run_ours(const fbd_model *model, double tolerance, double *y)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = until;
    options.tolerance = tolerance;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_outcome outcome = FBD_GOING;
    while (simulation && outcome == FBD_GOING) outcome = fbd_simulation_advance(simulation);
    if (outcome == FBD_DONE && y) read_end(simulation, model, y);
    fbd_simulation_free(simulation);
    fbd_errors_free(errors);
    return outcome == FBD_DONE;
}

/* ---- side by side */

struct point {
    double tolerance, error, seconds;
};

static double distance(const double *y, const double *known)
{
    double worst = 0;
    for (int part = 0; part < 2; part++) {
        double most = 0, apart = 0;
        for (int i = part * rods; i < (part + 1) * rods; i++) {
            most = fmax(most, fabs(known[i]));
            apart = fmax(apart, fabs(y[i] - known[i]));
        }
        worst = fmax(worst, apart / most);
    }
    return worst;
}

/* The least time of the program by hand for an error; NAN where it is not reached. */
static double seconds_at(const struct point *ladder, double error)
{
    double least = NAN;
    for (int k = 0; k < rungs; k++) {
        if (!(ladder[k].error <= error)) continue;
        double seconds = ladder[k].seconds;
        if (k > 0 && ladder[k - 1].error > error) {
            double share = log(ladder[k - 1].error / error) / log(ladder[k - 1].error / ladder[k].error);
            seconds = ladder[k - 1].seconds * pow(ladder[k].seconds / ladder[k - 1].seconds, share);
        }
        least = fmin(least, seconds);
    }
    return least;
}

static void note_time(struct point *point, double start)
{
    point->seconds = fmin(point->seconds, processor_seconds() - start);
}

int main(void)
{
    static struct point ladder[rungs], ours[tolerances];
    static double known[size], y[size];
    gsl_set_error_handler_off();
    fbd_model *model = make_model();
    if (!run_by_hand(1e-15, known)) return 1;
    for (int round = 0; round < rounds; round++) {
        for (int k = 0; k < rungs; k++) {
            if (round == 0) ladder[k] = (struct point){pow(10, -2 - 0.5 * k), 0, HUGE_VAL};
            double start = processor_seconds();
            if (!run_by_hand(ladder[k].tolerance, y)) return 1;
            note_time(&ladder[k], start);
            ladder[k].error = distance(y, known);
        }
        for (int k = 0; k < tolerances; k++) {
            if (round == 0) ours[k] = (struct point){pow(10, -3 - k), 0, HUGE_VAL};
            double start = processor_seconds();
            if (!run_ours(model, ours[k].tolerance, NULL)) return 1;
            note_time(&ours[k], start);
        }
    }
    printf("chain of %d rods, %g s\n tolerance      error       time   by hand at that error\n", rods, until);
    for (int k = 0; k < tolerances; k++) {
        if (!run_ours(model, ours[k].tolerance, y)) return 1;
        ours[k].error = distance(y, known);
        double hand = seconds_at(ladder, fmax(ours[k].error, ladder[rungs - 1].error));
        char what[120];
        printf("%10.0e %10.1e %7.2f ms %7.2f ms\n", ours[k].tolerance, ours[k].error, 1e3 * ours[k].seconds,
               1e3 * hand);
        snprintf(what, sizeof what, "whole run: chain of 64 rods, 1 s, tolerance %.0e, beside C by hand",
                 ours[k].tolerance);
        claim_at_most(what, ours[k].seconds / hand, bound);
    }
    fbd_model_free(model);
    return 0;
}
