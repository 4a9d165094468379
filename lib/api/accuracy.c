/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Accuracy on request: the tolerance that delivers a global accuracy, found by runs with error bars.
 *
 * The global error follows the tolerance by a power, error = c tolerance^p, with p near 1 where rounding has
 * no say. Two runs tell p; the next tolerance is the one for which that law promises half of what is asked
 * for.
 */
#include <math.h>

#include "api/record.h"

/* Estimates are believed to this factor. */
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

/* The tolerance for which the law through the last two attempts promises half of the accuracy. */
static double next_tolerance(const struct attempt *attempts, int count, double accuracy)
{
    const double most = 0.3, least = 1e-4; /* of the last tolerance */
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

/* Rounding has taken over: a tolerance ten times smaller makes nothing better. */
static bool at_the_floor(const struct attempt *attempts, int count)
{
    const double reaches_down = 1e-12;
    const struct attempt *last = &attempts[count - 1];
    if (last->tolerance <= least_tolerance) return true;
    return count > 1 && last->tolerance < reaches_down && last->estimate > 0.5 * last[-1].estimate;
}

/* Of runs that are all as far off as the motion is large (chaos) none is better than the one with the
 * smallest tolerance, the last. */
static const struct attempt *best_of(const struct attempt *attempts, int count)
{
    const double all = 0.1;
    const struct attempt *best = attempts;
    for (int i = 1; i < count; i++)
        if (fmin(attempts[i].estimate, all) <= fmin(best->estimate, all)) best = &attempts[i];
    return best;
}

/* A method of low order may need more steps than anyone would wait for. Steps are as tolerance^(-1/k). */
static bool takes_too_long(const fbd_simulation *simulation, double tolerance)
{
    const double most = 3e7;
    const struct run_options *options = &simulation->ensemble->options;
    const int k = options->method->estimate_order > 0 ? options->method->estimate_order : 6;
    double steps = (double)fbd_simulation_stats(simulation).steps;
    return steps * pow(options->tolerance / tolerance, 1.0 / k) > most;
}

static bool begin_again(fbd_simulation *simulation, double tolerance)
{
    const struct fbd_model *model = simulation->ensemble->model;
    struct run_options options = simulation->ensemble->options;
    options.tolerance = tolerance;
    simulation_end(simulation);
    return simulation_begin(simulation, model, &options);
}

fbd_result *record_accurately(fbd_simulation *simulation, const fbd_recording *recording)
{
    enum { most_attempts = 12 };
    struct attempt attempts[most_attempts];
    int count = 0;
    bool written = recording && (recording->csv || recording->keep);
    fbd_recording attempt = {.progress = recording ? recording->progress : NULL,
                             .progress_context = recording ? recording->progress_context : NULL};
    for (;;) {
        fbd_result *result = record(simulation, &attempt);
        if (!result) return NULL;
        attempts[count++] = (struct attempt){simulation->ensemble->options.tolerance,
                                             companion_global(simulation->bars->companion)};
        const struct attempt *last = &attempts[count - 1], *best = best_of(attempts, count);
        double tolerance = next_tolerance(attempts, count, simulation->accuracy);
        bool enough = margin * last->estimate <= simulation->accuracy || at_the_floor(attempts, count) ||
                      count == most_attempts || simulation->ensemble->outcome == FBD_FAILED ||
                      simulation->ensemble->outcome == FBD_INTERRUPTED ||
                      takes_too_long(simulation, tolerance);
        bool stop = simulation->ensemble->outcome == FBD_INTERRUPTED; /* no other run comes any farther */
        if (enough && (best == last || stop) && !written) return result;
        if (stop) best = last;
        fbd_result_free(result);
        if (enough) tolerance = best->tolerance;
        if (!begin_again(simulation, tolerance)) return NULL;
        if (enough) return record(simulation, recording);
    }
}
