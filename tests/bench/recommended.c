/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recommended.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "accuracy.h"
#include "fbd_study.h"

static const double targets[] = {1e-3, 1e-6, 1e-9};

enum { target_count = sizeof targets / sizeof *targets };

static double wall(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static fbd_model *read_model(const char *source, const char *name, const fbd_setting *settings, size_t count)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", source, name);
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_read(path, settings, count, errors);
    fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    if (!model) exit(1);
    return model;
}

static fbd_cost *study(const fbd_model *model, double until, double budget)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_cost_options options = FBD_COST_OPTIONS_DEFAULT;
    options.until = until;
    options.budget = budget;
    fbd_cost *cost = fbd_cost_new(model, &options, errors);
    fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    if (!cost) exit(1);
    return cost;
}

/* The same setting in another study; without a method when it was not measured there. */
static fbd_point same_point(const fbd_cost *cost, const fbd_point *point)
{
    for (size_t i = 0; i < fbd_cost_point_count(cost); i++) {
        const fbd_point other = fbd_cost_point(cost, i);
        if (other.state == FBD_POINT_MEASURED && other.tolerance == point->tolerance &&
            other.step == point->step && strcmp(other.method, point->method) == 0)
            return other;
    }
    return (fbd_point){0};
}

static void name_setting(char *text, size_t size, const fbd_point *point)
{
    bool fixed = point->step > 0;
    snprintf(text, size, "%s %s %.0e", point->method, fixed ? "--step" : "--tolerance",
             fixed ? point->step : point->tolerance);
}

static void advise(struct recommended *recommended, const char *scene, const fbd_cost *first,
                   const fbd_cost *second)
{
    for (int k = 0; k < target_count && recommended->count < most_advice; k++) {
        const fbd_point taken = fbd_cost_cheapest(first, targets[k]),
                        best = fbd_cost_cheapest(second, targets[k]);
        const fbd_point again = taken.method ? same_point(second, &taken) : taken;
        if (!again.method || !best.method) continue;
        struct advice *advice = &recommended->advice[recommended->count++];
        *advice = (struct advice){.scene = scene,
                                  .target = targets[k],
                                  .seconds = again.seconds,
                                  .ratio = again.seconds / best.seconds};
        name_setting(advice->setting, sizeof advice->setting, &taken);
        name_setting(advice->best, sizeof advice->best, &best);
        recommended->worst_ratio = fmax(recommended->worst_ratio, advice->ratio);
    }
}

static void repeat(struct recommended *recommended, const fbd_cost *first, const fbd_cost *second)
{
    for (int k = 0; k < target_count; k++) {
        const fbd_point one = fbd_cost_cheapest(first, targets[k]),
                        other = fbd_cost_cheapest(second, targets[k]);
        if (one.method && other.method)
            recommended->repeat = fmax(recommended->repeat, fabs(one.seconds / other.seconds - 1));
    }
}

void recommended_measure(struct recommended *recommended, const char *source)
{
    *recommended = (struct recommended){0};
    fprintf(stderr, "recommendations of fbd-cost\n");
    fbd_model *model = read_model(source, "models/rotation/compound_pendulum.yaml", NULL, 0);
    double start = wall();
    fbd_cost *first = study(model, NAN, 0);
    recommended->seconds = wall() - start;
    fbd_cost *second = study(model, NAN, 0);
    advise(recommended, "compound pendulum, 10 s", first, second);
    repeat(recommended, first, second);
    fbd_cost_free(first);
    fbd_cost_free(second);
    fbd_model_free(model);
    for (size_t i = 0; i < problem_count; i++) {
        const struct problem *problem = &problems[i];
        double until = problem->times[problem->time_count - 1], budget = until > 10000 ? 60 : 6;
        model = read_model(source, problem->model, problem->settings, problem->setting_count);
        first = study(model, until, budget);
        second = study(model, until, budget);
        advise(recommended, problem->name, first, second);
        fbd_cost_free(first);
        fbd_cost_free(second);
        fbd_model_free(model);
    }
}

void recommended_write(FILE *out, const struct recommended *recommended)
{
    fprintf(out,
            "\n## Recommendations of fbd-cost\n\nEach scene is studied twice; the time of the first study's "
            "recommendation in the second study is compared\nwith the best time there.\n\n"
            "| scene | error over the run | recommended | best of the second study | time | time / best |\n"
            "| --- | --- | --- | --- | --- | --- |\n");
    for (size_t i = 0; i < recommended->count; i++) {
        const struct advice *advice = &recommended->advice[i];
        fprintf(out, "| %s | %.0e | `%s` | `%s` | %.3f ms | %.2f |\n", advice->scene, advice->target,
                advice->setting, advice->best, 1e3 * advice->seconds, advice->ratio);
    }
}
