/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Accuracy on request: the tolerance that gives a requested global accuracy, found by runs with error bars.
 *
 * The global error depends on the tolerance by a power law, error = c tolerance^p, with p near 1 if rounding
 * is insignificant. Two runs determine p; the next tolerance is the one for which the law predicts half of
 * the requested accuracy.
 *
 * The best complete run is kept, with its rows, during further attempts: so none is made twice, and an
 * interrupted search has a result.
 */
#include <math.h>
#include <stdlib.h>

#include "api/record.h"

/* Safety factor of the estimates. */
static const double margin = 1.25;

static const double least_tolerance = 1e-14;

struct attempt {
    double tolerance, estimate;
};

double accuracy_first_guess(double accuracy)
{
    const double share = 0.3;
    return fmax(share * accuracy, least_tolerance);
}

/* The tolerance for which the power law through the last two attempts predicts half of the accuracy. */
static double next_tolerance(const struct attempt *attempts, int count, double accuracy)
{
    const double most = 0.3, least = 1e-4; /* relative to the last tolerance */
    const struct attempt *last = &attempts[count - 1], *before = count > 1 ? last - 1 : NULL;
    double p = 1;
    if (before) {
        double slope = log(last->estimate / before->estimate) / log(last->tolerance / before->tolerance);
        if (isfinite(slope)) p = fmin(fmax(slope, 0.5), 2);
    }
    double share = pow(accuracy / (2 * last->estimate), 1 / p);
    share = isfinite(last->estimate) ? fmin(fmax(share, least), most) : least;
    return fmax(share * last->tolerance, least_tolerance);
}

/* True if rounding dominates: a smaller tolerance no longer improves the estimate. */
static bool at_the_floor(const struct attempt *attempts, int count)
{
    const double reaches_down = 1e-12;
    const struct attempt *last = &attempts[count - 1];
    if (last->tolerance <= least_tolerance) return true;
    return count > 1 && last->tolerance < reaches_down && last->estimate > 0.5 * last[-1].estimate;
}

/* Errors as large as the motion (chaos) count as equal; the later run, with the smaller tolerance, is then
 * preferred. */
static bool is_better(double estimate, double before)
{
    const double all = 0.1;
    return fmin(estimate, all) <= fmin(before, all);
}

/* True if a method of low order would need too many steps; their number is proportional to tolerance^(-1/k). */
static bool takes_too_long(const fbd_simulation *simulation, double tolerance)
{
    const double most = 3e7;
    const struct run_options *options = &simulation->ensemble->options;
    const int k = options->method->estimate_order > 0 ? options->method->estimate_order : 6;
    double steps = (double)fbd_simulation_stats(simulation).steps;
    return steps * pow(options->tolerance / tolerance, 1.0 / k) > most;
}

/* ---- rows kept until the end of the search */

enum { most_rows = 64 << 20 }; /* bytes; a run with more is repeated at the end */

struct rows {
    struct text text;
    bool lost; /* there were too many */
};

static int keep_rows(void *context, const char *rows, size_t length)
{
    struct rows *kept = context;
    if (kept->lost) return 0;
    kept->lost = kept->text.length + length > most_rows;
    if (kept->lost)
        text_free(&kept->text);
    else
        text_add_bytes(&kept->text, rows, length);
    return kept->text.failed;
}

static void drop_rows(struct rows *rows)
{
    text_free(&rows->text);
    *rows = (struct rows){0};
}

/* ---- the search */

struct search {
    fbd_simulation *simulation;
    struct run_options options;
    fbd_recording recording; /* of a tentative run */
    struct rows rows;        /* its rows */
    struct attempt attempts[12];
    int count;
    fbd_result *best; /* NULL before the first; its run is in the simulation or in `aside` */
    double best_estimate;
    struct rows best_rows;
    struct fbd_simulation aside; /* the ensemble is NULL if it is empty */
};

enum { most_attempts = sizeof((struct search *)0)->attempts / sizeof(struct attempt) };

static void drop_aside(struct search *search)
{
    simulation_end(&search->aside);
    free(search->aside.bars);
    search->aside = (struct fbd_simulation){0};
}

static void drop_best(struct search *search)
{
    fbd_result_free(search->best);
    search->best = NULL;
    drop_rows(&search->best_rows);
    drop_aside(search);
}

/* Remove the run from the simulation; if it is the best one it is moved to `aside`. Returns false when memory
 * is out. */
static bool make_room(struct search *search)
{
    fbd_simulation *simulation = search->simulation;
    if (search->aside.ensemble) {
        simulation_end(simulation);
        return true;
    }
    struct bars *bars = calloc(1, sizeof *bars);
    if (!bars) return false;
    search->aside = *simulation;
    *simulation = (struct fbd_simulation){.bars = bars,
                                          .accuracy = search->aside.accuracy,
                                          .runs = search->aside.runs,
                                          .seconds_spent = search->aside.seconds_spent};
    return true;
}

/* Put the run of the best attempt into the simulation. */
static void bring_back(struct search *search)
{
    fbd_simulation *simulation = search->simulation;
    if (!search->aside.ensemble) return;
    search->aside.runs = simulation->runs;
    search->aside.seconds_spent = simulation->seconds_spent;
    simulation_end(simulation);
    free(simulation->bars);
    *simulation = search->aside;
    search->aside = (struct fbd_simulation){0};
}

static bool begin_attempt(struct search *search, double tolerance)
{
    const struct fbd_model *model = search->simulation->ensemble->model;
    search->options.tolerance = tolerance;
    return make_room(search) && simulation_begin(search->simulation, model, &search->options);
}

/* Make a run of the simulation, from its start. Returns false when memory is out. */
static bool attempt(struct search *search)
{
    fbd_simulation *simulation = search->simulation;
    drop_rows(&search->rows);
    fbd_result *result = record(simulation, &search->recording);
    if (!result) return false;
    double estimate = companion_global(simulation->bars->companion);
    search->attempts[search->count++] = (struct attempt){search->options.tolerance, estimate};
    bool whole = simulation->ensemble->outcome != FBD_INTERRUPTED;
    if (search->best && !(whole && is_better(estimate, search->best_estimate))) {
        fbd_result_free(result);
        return true;
    }
    drop_best(search);
    search->best = result;
    search->best_estimate = estimate;
    search->best_rows = search->rows;
    search->rows = (struct rows){0};
    return true;
}

static bool is_enough(const struct search *search, double next)
{
    const fbd_simulation *simulation = search->simulation;
    fbd_outcome outcome = simulation->ensemble->outcome;
    const struct attempt *last = &search->attempts[search->count - 1];
    return margin * last->estimate <= simulation->accuracy || at_the_floor(search->attempts, search->count) ||
           search->count == most_attempts || outcome == FBD_FAILED || outcome == FBD_INTERRUPTED ||
           takes_too_long(simulation, next);
}

/* Make attempts until one suffices or the search must end. Returns false when memory is out. */
static bool seek(struct search *search)
{
    for (;;) {
        if (!attempt(search)) return false;
        double next = next_tolerance(search->attempts, search->count, search->simulation->accuracy);
        if (is_enough(search, next)) return true;
        if (!begin_attempt(search, next)) return false;
    }
}

/* Write the kept rows, or repeat the run if they were too many to be kept. */
static fbd_result *deliver(struct search *search, const fbd_recording *recording)
{
    fbd_simulation *simulation = search->simulation;
    fbd_result *result = search->best;
    const struct text *rows = &search->best_rows.text;
    search->best = NULL;
    if (!recording || !recording->csv) return result;
    if (!search->best_rows.lost && recording->csv(recording->csv_context, rows->data, rows->length) == 0)
        return result;
    bool again = search->best_rows.lost;
    fbd_result_free(result);
    if (!again) return NULL;
    const struct fbd_model *model = simulation->ensemble->model;
    search->options.tolerance = simulation->ensemble->options.tolerance;
    simulation_end(simulation);
    return simulation_begin(simulation, model, &search->options) ? record(simulation, recording) : NULL;
}

fbd_result *record_accurately(fbd_simulation *simulation, const fbd_recording *recording)
{
    struct search search = {.simulation = simulation, .options = simulation->ensemble->options};
    if (recording) search.recording = *recording;
    if (search.recording.csv) {
        search.recording.csv = keep_rows;
        search.recording.csv_context = &search.rows;
    }
    fbd_result *result = NULL;
    if (seek(&search)) {
        bool cut = simulation->ensemble->outcome == FBD_INTERRUPTED;
        bring_back(&search);
        simulation->cut = cut && simulation->ensemble->outcome != FBD_INTERRUPTED;
        result = deliver(&search, recording);
    }
    drop_best(&search);
    drop_rows(&search.rows);
    return result;
}
