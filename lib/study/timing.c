/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/timing.h"

#include <math.h>
#include <stdlib.h>

#include "base/diag.h"
#include "study/stopwatch.h"

bool progress_report(const struct progress *progress, const char *what, double share, fbd_errors *errors)
{
    const fbd_progress now = {.what = what, .share = share};
    if (!progress->watch || progress->watch(progress->context, &now) == 0) return true;
    diag_add(errors, FBD_ERROR, "stopped", (struct pos){0, 0}, NULL, "the study was stopped");
    return false;
}

static bool run_once(const struct timed *timed, fbd_errors *errors)
{
    fbd_simulation *simulation = fbd_simulation_new(timed->model, &timed->options, errors);
    if (!simulation) return false;
    fbd_outcome outcome;
    do outcome = fbd_simulation_advance(simulation);
    while (outcome == FBD_GOING);
    fbd_simulation_free(simulation);
    return outcome != FBD_OUT_OF_MEMORY;
}

/* Take one reading of at least 100 microseconds, a thousand times the resolution of the clock. */
static bool read_once(struct timed *timed, fbd_errors *errors)
{
    const double least = 100e-6;
    double wanted = timed->estimate > 0 ? ceil(least / timed->estimate) : 1;
    unsigned turns = (unsigned)fmin(fmax(wanted, 1), 100);
    struct stopwatch watch = stopwatch_start();
    for (unsigned i = 0; i < turns; i++)
        if (!run_once(timed, errors)) return false;
    double seconds = stopwatch_seconds(&watch) / turns;
    timed->samples[timed->repeats++] = seconds;
    /* The first estimate included cold caches and sampling. */
    timed->estimate = timed->estimate > 0 ? fmin(timed->estimate, seconds) : seconds;
    return true;
}

static int ascending(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static void summarize(struct timed *timed)
{
    size_t n = timed->repeats;
    if (n == 0) return;
    qsort(timed->samples, n, sizeof *timed->samples, ascending);
    timed->seconds = (timed->samples[(n - 1) / 2] + timed->samples[n / 2]) / 2;
    timed->low = timed->samples[n / 4];
    timed->high = timed->samples[n - 1 - n / 4];
}

/* The number of repeats within an equal share of the time, limited for short runs. */
static unsigned wanted_repeats(const struct timed *timed, double share)
{
    double cost = fmax(timed->estimate, 110e-6);
    return (unsigned)fmin(fmax(floor(share / cost), 1), most_repeats);
}

bool timing_in_turn(struct timed *timed, size_t count, double seconds, const struct progress *progress,
                    fbd_errors *errors)
{
    enum { turn = 7 }; /* stride of the first run of a round */
    struct stopwatch watch = stopwatch_start();
    bool going = count > 0;
    for (unsigned round = 0; going && round < most_repeats; round++) {
        going = false;
        for (size_t k = 0; k < count; k++) {
            struct timed *one = &timed[(k + (size_t)round * turn) % count];
            double passed = stopwatch_seconds(&watch);
            bool late = round > 0 && passed + one->estimate > seconds;
            if (late || round >= wanted_repeats(one, seconds / (double)count)) continue;
            if (!read_once(one, errors)) return false;
            going = true;
            if (!progress_report(progress, "timing", fmin(passed / seconds, 1), errors)) return false;
        }
    }
    for (size_t i = 0; i < count; i++) summarize(&timed[i]);
    return true;
}
