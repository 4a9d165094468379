/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Every method on every model: what the default one costs beside the best of the others that are as exact, and
 * whether ten times less tolerance was ever a worse answer.
 *
 * The error of a run is the largest of all coordinates and rates at 64 times, each over the largest that it is, against
 * the run of the default method at 1e-13. Time is that of the processor, the least of some runs, of the simulation
 * alone.
 *
 * Usage: bench_methods [--quick] MODEL...; --quick leaves out what takes longer than 50 ms, for `make bench`.
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "claim.h"
#include "fbd.h"
#include "timing.h"

enum { times = 64, tolerances = 4, least_repetitions = 3, most_repetitions = 60 };

static const double tolerance[tolerances] = {1e-5, 1e-7, 1e-9, 1e-11};
static const char *const methods[] = {"auto",  "dop853", "rodas5p", "rk8pd",
                                      "rkf45", "rkck",   "msadams", "msbdf"};

enum { method_count = sizeof methods / sizeof *methods };

/* The least of some runs is that of an undisturbed one, if there is time for one: as many as go into so long. */
static double enough_seconds = 0.02;

/* Beyond this a run is no answer to the question which method is the quickest. */
static double most_seconds = 0.5;

struct motion {
    size_t size; /* numbers at one time */
    double until, *values;
    double seconds;
    bool known;
};

static void note(fbd_simulation *simulation, fbd_state *state, const fbd_model *model, struct motion *motion,
                 int k)
{
    double t = motion->until * (k + 1) / times;
    double *at = motion->values + (size_t)k * motion->size;
    if (!fbd_simulation_state(simulation, t, state)) return;
    for (size_t i = 0; i < fbd_model_coordinate_count(model); i++) {
        fbd_coordinate c = fbd_model_coordinate(model, i);
        if (!fbd_state_get(state, c.name, &at[2 * i]) || !fbd_state_get(state, c.rate_name, &at[2 * i + 1]))
            exit(1);
    }
}

/* One run; with `looks` its motion is noted, else its time. */
static void carry(const fbd_model *model, const fbd_options *options, struct motion *motion, bool looks)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_simulation *simulation = fbd_simulation_new(model, options, errors);
    fbd_state *state = fbd_state_new(model);
    double start = processor_seconds();
    fbd_outcome outcome = FBD_GOING;
    double from = 0, to = 0;
    int next = 0;
    while (simulation && outcome == FBD_GOING && processor_seconds() - start < most_seconds) {
        outcome = fbd_simulation_advance(simulation);
        fbd_simulation_interval(simulation, &from, &to);
        for (; looks && next < times && motion->until * (next + 1) / times <= to; next++)
            note(simulation, state, model, motion, next);
    }
    motion->known = outcome == FBD_DONE && (!looks || next == times);
    if (!looks) motion->seconds = fmin(motion->seconds, processor_seconds() - start);
    if (!looks) motion->until = to;
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_errors_free(errors);
}

/* What is as small beside all else is rounding, as the speed across its line of a wheel that rolls. */
static const double nothing = 1e-12;

static double distance(const struct motion *a, const struct motion *b)
{
    double worst = 0, most = 0;
    for (size_t i = 0; i < times * b->size; i++) most = fmax(most, fabs(b->values[i]));
    for (size_t i = 0; i < a->size; i++) {
        double size = 0, apart = 0;
        for (size_t k = 0; k < times; k++) {
            double x = a->values[k * a->size + i], y = b->values[k * a->size + i];
            size = fmax(size, fabs(y));
            apart = fmax(apart, fabs(x - y));
        }
        if (size > nothing * most) worst = fmax(worst, apart / size);
    }
    return worst;
}

/* What rounding may do: the references' own uncertainty, and events that two methods take by different sides. */
static const double floor_of_errors = 1e-10;

struct outcome {
    double seconds, error;
};

/* Of all models and tolerances. */
static const double most_ratio = 1.3;
static double worst_ratio;
static int compared, over;

static void compare(const char *path, struct outcome table[method_count][tolerances])
{
    for (int t = 0; t < tolerances; t++) {
        int best = 0;
        for (int m = 1; m < method_count; m++)
            if (table[m][t].error <= fmax(3 * table[0][t].error, floor_of_errors) &&
                table[m][t].seconds < table[best][t].seconds)
                best = m;
        double ratio = table[0][t].seconds / table[best][t].seconds;
        printf("| %s | %.0e | %.1e | %.3g ms | %s | %.2f |%s\n", path, tolerance[t], table[0][t].error,
               1e3 * table[0][t].seconds, methods[best], ratio, ratio > most_ratio ? " over" : "");
        compared++;
        over += ratio > most_ratio;
        worst_ratio = fmax(worst_ratio, ratio);
    }
    for (int m = 0; m < method_count; m++)
        for (int t = 1; t < tolerances; t++)
            if (isfinite(table[m][t].error) &&
                table[m][t].error > fmax(table[m][t - 1].error, floor_of_errors))
                printf("worse: %s, %s: %.1e at %.0e, %.1e at %.0e\n", path, methods[m], table[m][t - 1].error,
                       tolerance[t - 1], table[m][t].error, tolerance[t]);
    fflush(stdout);
}

static struct motion motion_of(const fbd_model *model)
{
    size_t size = 2 * fbd_model_coordinate_count(model);
    return (
        struct motion){.size = size, .values = calloc(times * size + 1, sizeof(double)), .seconds = HUGE_VAL};
}

static void measure(const fbd_model *model, const fbd_options *options, struct motion *motion)
{
    double start = processor_seconds();
    for (int i = 0; i < most_repetitions; i++) {
        carry(model, options, motion, false);
        if (i + 1 >= least_repetitions && processor_seconds() - start > enough_seconds) break;
    }
}

static void study(const char *path, const fbd_model *model)
{
    struct outcome table[method_count][tolerances];
    struct motion reference = motion_of(model), motion = motion_of(model);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = 1e-13;
    if (!reference.values || !motion.values) exit(1);
    carry(model, &options, &reference, false);
    motion.until = reference.until;
    if (reference.known) carry(model, &options, &reference, true);
    for (int m = 0; reference.known && m < method_count; m++)
        for (int t = 0; t < tolerances; t++) {
            options.method = methods[m];
            options.tolerance = tolerance[t];
            motion.seconds = HUGE_VAL;
            carry(model, &options, &motion, true);
            double error = motion.known ? distance(&motion, &reference) : HUGE_VAL;
            if (motion.known) measure(model, &options, &motion);
            table[m][t] = (struct outcome){motion.seconds, error};
        }
    if (reference.known) compare(path, table);
    if (!reference.known) printf("left out, no reference within %g s: %s\n", most_seconds, path);
    free(reference.values);
    free(motion.values);
}

int main(int argc, char **argv)
{
    gsl_set_error_handler_off();
    bool quick = argc > 1 && strcmp(argv[1], "--quick") == 0;
    if (quick) most_seconds = 0.05, enough_seconds = 0.004;
    printf("| model | tolerance | error | auto | best as exact | auto / best |\n| --- | --- | --- | --- | "
           "--- | --- |\n");
    for (int i = quick ? 2 : 1; i < argc; i++) {
        fbd_errors *errors = fbd_errors_new();
        fbd_model *model = fbd_model_read(argv[i], NULL, 0, errors);
        if (model) study(argv[i], model);
        fbd_model_free(model);
        fbd_errors_free(errors);
    }
    printf("%d of %d are over %.1f\n", over, compared, most_ratio);
    claim_at_most("auto beside the best method as exact, worst over the gallery", worst_ratio, most_ratio);
    return 0;
}
