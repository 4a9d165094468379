/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/cost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "fbd_study.h"
#include "fbd_view.h"
#include "study/stopwatch.h"

static const double default_budget = 6;

/* ---- quantities */

const char *quantity_name_of(const fbd_model *model, size_t quantity)
{
    size_t n = fbd_model_coordinate_count(model);
    if (quantity >= 2 * n) return fbd_model_state(model, quantity - 2 * n).name;
    fbd_coordinate coordinate = fbd_model_coordinate(model, quantity < n ? quantity : quantity - n);
    return quantity < n ? coordinate.name : coordinate.rate_name;
}

const char *quantity_unit_of(const fbd_model *model, size_t quantity)
{
    size_t n = fbd_model_coordinate_count(model);
    if (quantity >= 2 * n) return fbd_model_state(model, quantity - 2 * n).unit;
    fbd_coordinate coordinate = fbd_model_coordinate(model, quantity < n ? quantity : quantity - n);
    return quantity < n ? coordinate.unit : coordinate.rate_unit;
}

/* Is quantity `quantity` called so? In a scene of one body the name of the body may be left out. */
static bool is_called(const fbd_model *model, size_t quantity, const char *name)
{
    const char *full = quantity_name_of(model, quantity), *dot = strchr(full, '.');
    bool alone = fbd_model_body_count(model) == 1 && quantity < 2 * fbd_model_coordinate_count(model);
    return strcmp(full, name) == 0 || (alone && dot && strcmp(dot + 1, name) == 0);
}

static bool choose_quantity(const fbd_model *model, const char *name, bool *chosen, fbd_errors *errors)
{
    enum { most_names = 40 };
    size_t size = quantity_count(model), count = 0;
    const char *names[most_names];
    for (size_t i = 0; i < size; i++) {
        if (!is_called(model, i, name)) continue;
        chosen[i] = true;
        return true;
    }
    for (; count < size && count < most_names; count++) names[count] = quantity_name_of(model, count);
    diag_add(errors, FBD_ERROR, "unknown-quantity", (struct pos){0, 0},
             diag_nearest(errors, name, names, count), "the scene has no coordinate or rate `%s`", name);
    return false;
}

bool quantities_choose(const fbd_model *model, const fbd_cost_options *options, struct arena *arena,
                       bool **chosen, fbd_errors *errors)
{
    *chosen = NULL;
    diag_in_file(errors, fbd_model_file(model));
    if (!options->quantities) return true;
    *chosen = ARENA_ARRAY(arena, quantity_count(model) + 1, bool);
    if (!*chosen) {
        diag_out_of_memory(errors);
        return false;
    }
    for (size_t i = 0; i < options->quantity_count; i++)
        if (!choose_quantity(model, options->quantities[i], *chosen, errors)) return false;
    return true;
}

/* ---- construction */

static const fbd_cost_options no_options = FBD_COST_OPTIONS_DEFAULT;

void fbd_cost_options_init(fbd_cost_options *options, size_t size)
{
    if (options) api_fill_options(options, size, &no_options, sizeof no_options);
}

bool study_is_asked(const fbd_model *model, const fbd_cost_options *options, fbd_cost_options *own,
                    fbd_errors *errors)
{
    const fbd_cost_options *asked = own;
    *own = no_options;
    if (!api_take_options(own, sizeof *own, options, errors)) return false;
    if (!model)
        api_refuse(errors, "there is no model");
    else if ((asked->methods && !api_has_texts(asked->methods, asked->method_count)) ||
             (asked->quantities && !api_has_texts(asked->quantities, asked->quantity_count)))
        api_refuse(errors, "the name of a method or quantity is missing");
    else
        return true;
    return false;
}

bool study_until(const fbd_model *model, const fbd_cost_options *options, double *until, fbd_errors *errors)
{
    fbd_options run = FBD_OPTIONS_DEFAULT;
    run.until = options->until;
    fbd_simulation *simulation = fbd_simulation_new(model, &run, errors);
    if (!simulation) return false;
    fbd_simulation_free(simulation);
    fbd_model_options(model, &run, sizeof run);
    *until = isnan(options->until) ? run.until : options->until;
    if (*until > 0) return true;
    diag_add(errors, FBD_ERROR, "bad-option", (struct pos){0, 0}, "give --until a time above 0",
             "the run has zero duration and cannot be studied");
    return false;
}

static bool time_points(struct fbd_cost *cost, double seconds)
{
    struct timed *timed = calloc(cost->point_count + 1, sizeof *timed);
    size_t count = 0;
    if (!timed) return false;
    for (size_t i = 0; i < cost->point_count; i++)
        if (cost->points[i].state == FBD_POINT_MEASURED)
            timed[count++] = (struct timed){.model = cost->model,
                                            .options = setting_options(&cost->settings[i], cost->until),
                                            .estimate = cost->points[i].seconds};
    bool done = timing_in_turn(timed, count, seconds, &cost->progress, cost->errors);
    count = 0;
    for (size_t i = 0; done && i < cost->point_count; i++) {
        if (cost->points[i].state != FBD_POINT_MEASURED) continue;
        const struct timed *one = &timed[count++];
        cost->points[i].seconds = one->seconds;
        cost->points[i].low = one->low;
        cost->points[i].high = one->high;
        cost->points[i].repeats = one->repeats;
    }
    free(timed);
    return done;
}

static bool study(struct fbd_cost *cost, const fbd_cost_options *options)
{
    struct stopwatch watch = stopwatch_start();
    if (!quantities_choose(cost->model, options, &cost->arena, &cost->chosen, cost->errors)) return false;
    if (!study_until(cost->model, options, &cost->until, cost->errors)) return false;
    if (!ladder_plan(cost, options)) return false;
    if (!progress_report(&cost->progress, "reference", 0, cost->errors)) return false;
    if (!reference_make(&cost->reference, cost->model, cost->until, cost->chosen,
                        REFERENCE_SHARE * cost->budget, &cost->arena, cost->errors))
        return false;
    cost->says = reference_says(&cost->arena, &cost->reference, cost->model);
    if (!cost->says || !ladder_climb(cost)) return false;
    if (!time_points(cost, fmax(cost->budget - stopwatch_seconds(&watch), 0.3 * cost->budget))) return false;
    cost_analyse(cost);
    return true;
}

static fbd_cost *cost_new(const fbd_model *model, const fbd_cost_options *options, fbd_errors *errors)
{
    struct fbd_cost *cost = calloc(1, sizeof *cost);
    if (!cost) {
        diag_out_of_memory(errors);
        return NULL;
    }
    cost->model = model;
    cost->budget = options->budget > 0 ? options->budget : default_budget;
    cost->progress = (struct progress){options->progress, options->progress_context};
    cost->errors = errors;
    bool done = study(cost, options);
    cost->errors = NULL; /* the list is valid only during this call */
    if (done) return cost;
    if (fbd_errors_failed_count(errors) == 0) diag_out_of_memory(errors);
    fbd_cost_free(cost);
    return NULL;
}

fbd_cost *fbd_cost_new(const fbd_model *model, const fbd_cost_options *options, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_cost_options own;
    fbd_cost *cost = study_is_asked(model, options, &own, errors) ? cost_new(model, &own, errors) : NULL;
    diag_end(&call);
    return cost;
}

void fbd_cost_free(fbd_cost *cost)
{
    if (!cost) return;
    arena_free(&cost->arena);
    free(cost);
}

/* ---- access */

fbd_reference fbd_cost_reference(const fbd_cost *cost)
{
    if (!cost)
        return (fbd_reference){
            "", {"", ""}, {NAN, NAN}, false, false, NAN, NAN, NAN, NAN, false, NAN,
        };
    const struct certified_reference *r = &cost->reference;
    return (fbd_reference){.says = cost->says,
                           .method = {r->settings[0].method, r->settings[1].method},
                           .tolerance = {r->settings[0].tolerance, r->settings[1].tolerance},
                           .exact = r->any_exact && !r->exact_differs,
                           .exact_differs = r->exact_differs,
                           .floor = r->floor,
                           .floor_end = r->floor_end,
                           .until = cost->until,
                           .known = r->known,
                           .complete = !r->cut,
                           .tenfold = r->tenfold};
}

size_t fbd_cost_series_count(const fbd_cost *cost)
{
    if (!cost) return 0;
    return cost->series_count;
}

fbd_series fbd_cost_series(const fbd_cost *cost, size_t index)
{
    return cost && index < cost->series_count ? cost->series[index] : (fbd_series){.order = NAN};
}

size_t fbd_cost_point_count(const fbd_cost *cost)
{
    if (!cost) return 0;
    return cost->point_count;
}

const fbd_point no_point = {.tolerance = NAN,
                            .step = NAN,
                            .error = NAN,
                            .error_end = NAN,
                            .event_error = NAN,
                            .seconds = NAN,
                            .low = NAN,
                            .high = NAN};

fbd_point fbd_cost_point(const fbd_cost *cost, size_t index)
{
    return cost && index < cost->point_count ? cost->points[index] : no_point;
}
