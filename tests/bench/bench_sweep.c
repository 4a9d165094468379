/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A sweep of 10,000 runs, by one thread and by two in turn: runs in a second, what the second thread gains,
 * how much of a run is the run itself and how much is making its model, and runs of a single step. Processor time beside wall time:
 * on a machine with other work, twice the runs per second of processor time is what two free processors give.
 *
 * Usage: bench_sweep MODEL VARY SMOOTH_MODEL VARY
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "claim.h"
#include "fbd.h"
#include "fbd_study.h"
#include "open_sweep.h"
#include "timing.h"

enum { pairs = 15 };

static int swallow(void *context, const char *rows, size_t length)
{
    size_t *bytes = context;
    (void)rows;
    *bytes += length;
    return 0;
}

struct cost {
    double wall, processor;
};

static struct cost measure(const fbd_sweep *sweep, size_t jobs)
{
    size_t bytes = 0;
    fbd_sweep_counts counts;
    const fbd_sweep_work work = {.end = fbd_sweep_run_count(sweep),
                                 .jobs = jobs,
                                 .write = swallow,
                                 .write_context = &bytes};
    double wall = wall_seconds(), processor = processor_seconds();
    fbd_sweep_end end = fbd_sweep_run(sweep, &work, &counts);
    struct cost cost = {wall_seconds() - wall, processor_seconds() - processor};
    if (end == FBD_SWEEP_DONE && counts.failed == 0) return cost;
    fputs("the sweep failed\n", stderr);
    exit(1);
}

/* Processor time of the same run alone, its model made from the text each time. */
static double measure_alone(const char *text, size_t length, int repetitions)
{
    const fbd_options options = FBD_OPTIONS_DEFAULT;
    double start = processor_seconds();
    for (int i = 0; i < repetitions; i++) {
        fbd_errors *errors = fbd_errors_new();
        fbd_model *model = fbd_model_parse(text, length, "model", NULL, 0, errors);
        fbd_simulation *simulation = model ? fbd_simulation_new(model, &options, errors) : NULL;
        if (!simulation) exit(1);
        while (fbd_simulation_advance(simulation) == FBD_GOING) continue;
        fbd_simulation_free(simulation);
        fbd_model_free(model);
        fbd_errors_free(errors);
    }
    return (processor_seconds() - start) / repetitions;
}

/* Runs of one step: what setting one up, writing its row and freeing it takes. */
static void measure_short(const char *path, const char *vary, double until)
{
    static double rate[pairs];
    const double enough = 200000, longest = 5;
    fbd_sweep *sweep = open_sweep(path, vary, until);
    for (int i = 0; i < pairs; i++)
        rate[i] = (double)fbd_sweep_run_count(sweep) / measure(sweep, 1).processor;
    double runs = median(rate, pairs);
    printf("%s, %s, until %g s: %.0f runs in a second of processor time, %.1f us each\n", path, vary, until,
           runs, 1e6 / runs);
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    char what[160];
    snprintf(what, sizeof what, "sweep: very short runs of %s (%s) in a second and core", name, vary);
    claim_at_least(what, runs, enough);
    snprintf(what, sizeof what, "sweep: such a run in all, set-up and row, us (bound of the set-up)");
    claim_at_most(what, 1e6 / runs, longest);
    fbd_sweep_free(sweep);
}

int main(int argc, char **argv)
{
    static double rate[pairs], busy[pairs], gain[pairs], loss[pairs];
    gsl_set_error_handler_off();
    if (argc != 5) return 2;
    fbd_sweep *sweep = open_sweep(argv[1], argv[2], NAN);
    double runs = (double)fbd_sweep_run_count(sweep);
    measure(sweep, 2); /* to warm up */
    for (int i = 0; i < pairs; i++) {
        struct cost one = measure(sweep, 1), two = measure(sweep, 2);
        rate[i] = runs / one.wall;
        busy[i] = runs / one.processor;
        gain[i] = one.wall / two.wall;
        loss[i] = two.processor / one.processor;
    }
    size_t length;
    const char *text = fbd_sweep_source(sweep, &length);
    double alone = measure_alone(text, length, 2000), busy_rate = median(busy, pairs),
           lost = median(loss, pairs), gained = median(gain, pairs);
    printf("%.0f runs, medians of %d pairs of one thread and two\n", runs, pairs);
    printf("one thread: %.0f runs/s of wall time, %.0f of processor time (bound: 20000)\n",
           median(rate, pairs), busy_rate);
    printf("two threads: %.2f times as fast (bound: 1.8; quartiles %.2f to %.2f)\n", gained, gain[pairs / 4],
           gain[3 * pairs / 4]);
    printf("    and %.3f times the processor time: %.2f times as fast on two processors that are free\n",
           lost, 2 / lost);
    printf("a run of the sweep: %.1f us; read, compiled and run by itself: %.1f us\n", 1e6 / busy_rate,
           1e6 * alone);
    measure_short(argv[1], argv[2], 1e-6);
    measure_short(argv[3], argv[4], 1e-3);
    fbd_sweep_free(sweep);
    return 0;
}
