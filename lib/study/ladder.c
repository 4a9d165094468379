/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ladder: each method from loose to tight settings, within the budget.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "fbd_study.h"
#include "study/cost.h"
#include "study/stopwatch.h"

enum { tolerance_rungs = 11, step_rungs = 14, most_series = 40 };

static const double tolerances[tolerance_rungs] = {1e-3, 1e-4,  1e-5,  1e-6,  1e-7, 1e-8,
                                                   1e-9, 1e-10, 1e-11, 1e-12, 1e-13};

static const char automatic[] = "auto", students[] = "rk4";

/* ---- plan */

static bool wanted(const fbd_cost_options *options, const char *name)
{
    if (!options->methods) return true;
    for (size_t i = 0; i < options->method_count; i++)
        if (strcmp(options->methods[i], name) == 0) return true;
    return false;
}

/* Check the names of methods, with the messages of a run. */
static bool check_methods(const struct fbd_cost *cost, const fbd_cost_options *options)
{
    for (size_t i = 0; options->methods && i < options->method_count; i++) {
        const struct setting setting = {.method = options->methods[i], .tolerance = tolerances[0]};
        fbd_options run = setting_options(&setting, cost->until);
        fbd_simulation *simulation = fbd_simulation_new(cost->model, &run, cost->errors);
        if (!simulation) return false;
        fbd_simulation_free(simulation);
    }
    return true;
}

static void add_series(struct fbd_cost *cost, const char *method, bool fixed)
{
    size_t rungs = fixed ? step_rungs : tolerance_rungs;
    cost->series[cost->series_count++] = (fbd_series){
        .method = method, .fixed = fixed, .first = cost->point_count, .count = rungs, .order = NAN};
    for (size_t r = 0; r < rungs; r++) {
        struct setting *setting = &cost->settings[cost->point_count];
        *setting =
            (struct setting){.method = method, .tolerance = fixed ? 0 : tolerances[r], .automatic = true};
        cost->points[cost->point_count++] = (fbd_point){.method = method,
                                                        .tolerance = setting->tolerance,
                                                        .state = FBD_POINT_SKIPPED,
                                                        .reason = ""};
    }
}

/* Plan tolerances for all methods, and fixed steps for rk4, which students program with these; or fixed steps
 * for all methods that allow them. A multistep method does not: it starts with small steps. */
bool ladder_plan(struct fbd_cost *cost, const fbd_cost_options *options)
{
    if (!check_methods(cost, options)) return false;
    const size_t most_points = (size_t)most_series * step_rungs;
    cost->series = ARENA_ARRAY(&cost->arena, most_series, fbd_series);
    cost->points = ARENA_ARRAY(&cost->arena, most_points, fbd_point);
    cost->settings = ARENA_ARRAY(&cost->arena, most_points, struct setting);
    if (cost->arena.failed) return false;
    if (!options->fixed_steps && wanted(options, automatic)) add_series(cost, automatic, false);
    for (size_t i = 0; i < fbd_method_count() && cost->series_count + 1 < most_series; i++) {
        fbd_method method = fbd_method_get(i);
        if (wanted(options, method.name) && !(options->fixed_steps && method.multistep))
            add_series(cost, method.name, options->fixed_steps);
    }
    if (!options->fixed_steps && wanted(options, students)) add_series(cost, students, true);
    if (cost->series_count > 0) return true;
    diag_add(cost->errors, FBD_ERROR, "no-method", (struct pos){0, 0},
             "name a one-step method, or leave out the fixed steps", "none of these methods has fixed steps");
    return false;
}

/* ---- fixed steps */

/* The largest of ..., 0.1, 0.2, 0.5, 1, ... not above `size`, as the double that its decimal text denotes. */
static double round_step(double size)
{
    int decade = (int)floor(log10(size));
    double digits = size / pow(10, decade);
    const double slack = 1 + 1e-9;
    char text[32];
    snprintf(text, sizeof text, "%de%d", digits * slack >= 5 ? 5 : digits * slack >= 2 ? 2 : 1, decade);
    return strtod(text, NULL);
}

/* Fixed steps in the sequence 5, 2, 1, starting at a size that is too coarse: four times the mean step at a
 * loose tolerance. */
static bool plan_steps(struct fbd_cost *cost)
{
    struct track track;
    const struct setting loose = {.method = automatic, .tolerance = tolerances[0], .automatic = true};
    if (!track_make(&track, cost->model, &loose, &cost->reference.grid, cost->budget, &cost->arena,
                    cost->errors))
        return false;
    double size = cost->until / fmax(4, (double)track.stats.steps / 4);
    for (size_t r = 0; r < step_rungs; r++) {
        size = round_step(size);
        for (size_t s = 0; s < cost->series_count; s++)
            if (cost->series[s].fixed) {
                cost->settings[cost->series[s].first + r].step = size;
                cost->points[cost->series[s].first + r].step = size;
            }
        size /= 2;
    }
    return true;
}

/* ---- runs */

/* The position of a series on its ladder. */
struct climber {
    size_t rung;     /* the next one */
    double last;     /* seconds of the previous one, ... */
    double expected; /* ... and of the next one */
};

/* The expected time of the next rung: at least by work ~ tolerance^(-1/(p + 1)), or by twice as many steps. */
static double next_seconds(const fbd_series *series, const struct climber *climber, double seconds)
{
    fbd_method method = fbd_method_find(series->method);
    double order = method.name ? method.order : 8;
    double least = series->fixed ? 2 : pow(10, 1 / (order + 1));
    double ratio = climber->last > 0 ? seconds / climber->last : least;
    return seconds * fmin(fmax(ratio, least), 12);
}

static const char *other_end(struct fbd_cost *cost, const struct track *track)
{
    static const char *const words[] = {
        [FBD_GOING] = "is given up", [FBD_DONE] = "gets to the end", [FBD_STOPPED] = "is stopped",
        [FBD_BROKEN] = "breaks off", [FBD_FAILED] = "fails",         [FBD_OUT_OF_MEMORY] = "is out of memory",
    };
    if (track->reason[0]) return track->reason;
    return arena_printf(&cost->arena, "it %s at t = %.6g s, where the reference %s", words[track->outcome],
                        track->t_end, words[cost->reference.track.outcome]);
}

static void judge(struct fbd_cost *cost, fbd_point *point, const struct track *track)
{
    const struct certified_reference *reference = &cost->reference;
    point->stats = track->stats;
    point->seconds = track->seconds;
    if (track->outcome != reference->track.outcome) {
        point->state = FBD_POINT_FAILED;
        point->reason = other_end(cost, track);
        return;
    }
    struct errors_of_a_run errors = reference_errors(reference, track);
    point->state = FBD_POINT_MEASURED;
    point->error = errors.max;
    point->error_end = errors.end;
    point->worst = isnan(errors.max) ? "" : quantity_name_of(cost->model, errors.worst);
    point->floor = errors.max <= reference->floor;
    point->event_error = errors.event;
    point->same_events = errors.same_events;
}

/* Skip a ladder from `rung` on. */
static void skip_rest(struct fbd_cost *cost, const fbd_series *series, size_t rung, const char *reason)
{
    for (size_t r = rung; r < series->count; r++)
        cost->points[series->first + r].reason = reason ? reason : "";
}

static bool run_point(struct fbd_cost *cost, size_t index, double most_seconds)
{
    struct track track;
    struct arena arena = {0};
    bool done = track_make(&track, cost->model, &cost->settings[index], &cost->reference.grid, most_seconds,
                           &arena, cost->errors);
    fbd_point *point = &cost->points[index];
    if (done && track.outcome == FBD_GOING) {
        const char *reason =
            arena_printf(&cost->arena, "given up after %.2g s at t = %.3g s", track.seconds, track.t_end);
        point->reason = reason ? reason : "";
        point->seconds = track.seconds;
    } else if (done) {
        judge(cost, point, &track);
        /* The text of the track is freed with it. */
        point->reason = arena_text(&cost->arena, point->reason, strlen(point->reason));
    }
    arena_free(&arena);
    return done && !cost->arena.failed;
}

/* The series with the cheapest next rung, so that fast methods complete their ladders; series_count when all
 * are done. */
static size_t next_series(const struct fbd_cost *cost, const struct climber *climbers)
{
    size_t best = cost->series_count;
    for (size_t s = 0; s < cost->series_count; s++)
        if (climbers[s].rung < cost->series[s].count &&
            (best == cost->series_count || climbers[s].expected < climbers[best].expected))
            best = s;
    return best;
}

static bool climb_rung(struct fbd_cost *cost, const fbd_series *series, struct climber *climber,
                       double most_seconds)
{
    size_t index = series->first + climber->rung;
    if (climber->expected > most_seconds) {
        skip_rest(cost, series, climber->rung,
                  arena_printf(&cost->arena, "would take about %.2g s", climber->expected));
        climber->rung = series->count;
        return !cost->arena.failed;
    }
    if (!run_point(cost, index, most_seconds)) return false;
    const fbd_point *point = &cost->points[index];
    climber->rung++;
    climber->expected = next_seconds(series, climber, point->seconds);
    climber->last = point->seconds;
    if (point->state == FBD_POINT_SKIPPED) { /* abandoned: tighter settings take longer */
        skip_rest(cost, series, climber->rung, point->reason);
        climber->rung = series->count;
    }
    return true;
}

bool ladder_climb(struct fbd_cost *cost)
{
    const double longest_share = 1.0 / 30;
    struct stopwatch watch = stopwatch_start();
    struct climber *climbers = arena_array(&cost->arena, cost->series_count, sizeof *climbers);
    if (!climbers || !plan_steps(cost)) return false;
    for (size_t s; (s = next_series(cost, climbers)) < cost->series_count;) {
        double spent = stopwatch_seconds(&watch) / (LADDER_SHARE * cost->budget);
        if (!progress_report(&cost->progress, "errors", fmin(spent, 1), cost->errors)) return false;
        if (spent > 1) break;
        if (!climb_rung(cost, &cost->series[s], &climbers[s], longest_share * cost->budget)) return false;
    }
    for (size_t s = 0; s < cost->series_count; s++)
        if (climbers[s].rung < cost->series[s].count)
            skip_rest(cost, &cost->series[s], climbers[s].rung, "the budget is spent");
    return true;
}
