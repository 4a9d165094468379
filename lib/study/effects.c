/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/effects.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "fbd_study.h"
#include "study/cost.h"
#include "study/stopwatch.h"

enum { grid_intervals = 240 };

/* The changes are computed at a tolerance tighter than the default, and compared with the difference to a
 * still tighter run. */
static const struct setting measured = {.tolerance = 1e-11}, tighter = {.tolerance = 1e-13};
static const double default_budget = 6, longest_share = 0.1;

/* ---- the complete scene */

static bool run_scene(struct fbd_effects *effects, const fbd_cost_options *options)
{
    bool *chosen;
    if (!quantities_choose(effects->model, options, &effects->arena, &chosen, effects->errors)) return false;
    if (!study_until(effects->model, options, &effects->until, effects->errors)) return false;
    effects->grid = (struct grid){.until = effects->until, .count = grid_intervals + 1};
    struct track *runs[] = {&effects->track, &effects->tight};
    const struct setting *settings[] = {&measured, &tighter};
    for (int k = 0; k < 2; k++)
        if (!track_make(runs[k], effects->model, settings[k], &effects->grid, effects->budget,
                        &effects->arena, effects->errors))
            return false;
    if (!track_ended(&effects->track) && effects->track.outcome != FBD_BROKEN) {
        diag_add(effects->errors, FBD_ERROR, "no-reference", (struct pos){0, 0}, NULL,
                 "the scene itself does not run to its end: %s",
                 effects->track.outcome == FBD_GOING ? "it takes too long for the budget"
                                                     : effects->track.reason);
        return false;
    }
    size_t size = effects->track.size;
    effects->scale = ARENA_ARRAY(&effects->arena, size + 1, double);
    if (!effects->scale) return false;
    reference_scales(effects->scale, &effects->track, chosen, effects->model);
    size_t seen =
        effects->track.reached < effects->tight.reached ? effects->track.reached : effects->tight.reached;
    effects->floor = tracks_differ(&effects->track, &effects->tight, effects->scale, 0, seen, NULL);
    return true;
}

/* ---- the effects */

static bool list_effects(struct fbd_effects *effects)
{
    const struct track *track = &effects->track;
    double *times = ARENA_ARRAY(&effects->arena, track->reached + 1, double);
    if (!times) return false;
    for (size_t k = 0; k < track->reached; k++) times[k] = grid_time(&effects->grid, k);
    const fbd_motion motion = {track->reached, times, track->y};
    effects->simplifications = fbd_simplify(effects->model, &motion, effects->errors);
    effects->count = fbd_simplifications_count(effects->simplifications);
    effects->effects = ARENA_ARRAY(&effects->arena, effects->count + 1, fbd_effect);
    for (size_t i = 0; effects->effects && i < effects->count; i++) {
        fbd_simplification one = fbd_simplifications_get(effects->simplifications, i);
        effects->effects[i] = (fbd_effect){.body = one.body,
                                           .name = one.name,
                                           .change = one.change,
                                           .reason = one.reason,
                                           .change_end = NAN,
                                           .change_max = NAN,
                                           .worst = "",
                                           .time = NAN};
    }
    return effects->simplifications && effects->effects;
}

/* ---- the scene without an effect */

static const char *words(struct fbd_effects *effects, const char *reason)
{
    const char *copy = arena_text(&effects->arena, reason, strlen(reason));
    return copy ? copy : "";
}

static void compare(struct fbd_effects *effects, fbd_effect *effect, const struct track *without)
{
    const struct track *with = &effects->track;
    size_t seen = with->reached < without->reached ? with->reached : without->reached, worst = 0;
    if (without->outcome == FBD_GOING) {
        effect->reason = "without it the run takes too long for the budget";
        return;
    }
    if (!track_ended(without) && without->outcome != with->outcome) {
        effect->reason = words(effects, without->reason);
        return;
    }
    if (seen == 0) return;
    effect->change_max = tracks_differ(with, without, effects->scale, 0, seen, &worst);
    effect->change_end = tracks_differ(with, without, effects->scale, seen - 1, seen, NULL);
    effect->worst = quantity_name_of(effects->model, worst);
    effect->noise = effect->change_max <= effects->floor;
    effect->events = (long)without->event_count - (long)with->event_count;
}

static bool run_without(struct fbd_effects *effects, size_t index, fbd_model *model, double *seconds,
                        fbd_errors *errors)
{
    struct arena arena = {0};
    struct track track;
    bool done =
        track_make(&track, model, &measured, &effects->grid, longest_share * effects->budget, &arena, errors);
    if (done) {
        compare(effects, &effects->effects[index], &track);
        *seconds = track.seconds;
    }
    arena_free(&arena);
    return done;
}

/* Compile the scene without the effect and run it once. *model is NULL if the row has a reason instead.
 * Returns false when memory is out. */
static bool try_without(struct fbd_effects *effects, size_t index, fbd_model **model, double *seconds)
{
    fbd_effect *effect = &effects->effects[index];
    *model = NULL;
    if (effect->reason[0]) return true;
    fbd_errors *errors = fbd_errors_new();
    if (!errors) return false;
    *model = fbd_simplifications_model(effects->simplifications, index, errors);
    bool runs = *model && run_without(effects, index, *model, seconds, errors);
    for (size_t i = 0; !runs && i < fbd_errors_count(errors); i++)
        if (fbd_errors_get(errors, i).severity == FBD_ERROR)
            effect->reason = words(effects, fbd_errors_get(errors, i).message);
    bool done = !errors->out_of_memory && !effects->arena.failed;
    fbd_errors_free(errors);
    if (runs && done && !effect->reason[0]) return true;
    fbd_model_free(*model);
    *model = NULL;
    return done;
}

/* ---- all of them, and their times */

static void take_times(struct fbd_effects *effects, const struct timed *timed, fbd_model *const *models)
{
    const struct timed *one = timed;
    effects->seconds = one->seconds;
    for (size_t i = 0; i < effects->count; i++)
        if (models[i]) effects->effects[i].time = (++one)->seconds / effects->seconds;
}

static bool run_all(struct fbd_effects *effects, fbd_model **models, struct timed *timed)
{
    struct stopwatch watch = stopwatch_start();
    fbd_options options = FBD_OPTIONS_DEFAULT;
    size_t count = 1;
    options.until = effects->until;
    timed[0] =
        (struct timed){.model = effects->model, .options = options, .estimate = effects->track.seconds};
    for (size_t i = 0; i < effects->count; i++) {
        double seconds = 0;
        if (stopwatch_seconds(&watch) > effects->budget / 2)
            effects->effects[i].reason = "the budget is spent";
        if (!try_without(effects, i, &models[i], &seconds)) return false;
        if (models[i])
            timed[count++] = (struct timed){.model = models[i], .options = options, .estimate = seconds};
        if (!progress_report(&effects->progress, "effects", (double)i / (double)effects->count,
                             effects->errors))
            return false;
    }
    /* For times of some milliseconds a fraction of the budget is sufficient. */
    double seconds =
        fmin(effects->budget / 2, 0.05 * (double)count + 20 * effects->track.seconds * (double)count);
    if (!timing_in_turn(timed, count, seconds, &effects->progress, effects->errors)) return false;
    take_times(effects, timed, models);
    return !effects->arena.failed;
}

static bool study(struct fbd_effects *effects, const fbd_cost_options *options)
{
    if (!run_scene(effects, options) || !list_effects(effects)) return false;
    fbd_model **models = calloc(effects->count + 1, sizeof *models);
    struct timed *timed = calloc(effects->count + 1, sizeof *timed);
    bool done = models && timed && run_all(effects, models, timed);
    for (size_t i = 0; models && i < effects->count; i++) fbd_model_free(models[i]);
    free(models);
    free(timed);
    return done;
}

static fbd_effects *effects_new(const fbd_model *model, const fbd_cost_options *options, fbd_errors *errors)
{
    fbd_effects *effects = calloc(1, sizeof *effects);
    if (!effects) {
        diag_out_of_memory(errors);
        return NULL;
    }
    effects->model = model;
    effects->budget = options->budget > 0 ? options->budget : default_budget;
    effects->progress = (struct progress){options->progress, options->progress_context};
    effects->errors = errors;
    bool done = study(effects, options);
    effects->errors = NULL; /* the list is valid only during this call */
    if (done) return effects;
    if (fbd_errors_failed_count(errors) == 0) diag_out_of_memory(errors);
    fbd_effects_free(effects);
    return NULL;
}

fbd_effects *fbd_effects_new(const fbd_model *model, const fbd_cost_options *options, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_cost_options own;
    fbd_effects *effects =
        study_is_asked(model, options, &own, errors) ? effects_new(model, &own, errors) : NULL;
    diag_end(&call);
    return effects;
}

void fbd_effects_free(fbd_effects *effects)
{
    if (!effects) return;
    fbd_simplifications_free(effects->simplifications);
    arena_free(&effects->arena);
    free(effects);
}

size_t fbd_effects_count(const fbd_effects *effects)
{
    if (!effects) return 0;
    return effects->count;
}

fbd_effect fbd_effects_get(const fbd_effects *effects, size_t index)
{
    return effects && index < effects->count
               ? effects->effects[index]
               : (fbd_effect){.change_end = NAN, .change_max = NAN, .time = NAN};
}
