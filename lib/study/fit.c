/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "fbd_view.h"

/* ---- the parameters */

static bool is_chosen(const fbd_fit_plan *plan, const fbd_parameter *parameter)
{
    for (size_t i = 0; i < plan->parameter_count; i++)
        if (strcmp(plan->parameters[i], parameter->name) == 0) return true;
    return plan->parameter_count == 0 && !parameter->derived && !parameter->input;
}

static bool check_names(struct fbd_fit *fit, const fbd_model *model)
{
    const char *names[200];
    size_t count = 0;
    for (; count < fbd_model_parameter_count(model) && count < sizeof names / sizeof *names; count++)
        names[count] = fbd_model_parameter(model, count).name;
    for (size_t i = 0; i < fit->plan->parameter_count; i++) {
        bool known = false;
        for (size_t k = 0; k < count; k++) known |= strcmp(names[k], fit->plan->parameters[i]) == 0;
        if (known) continue;
        diag_in_file(fit->errors, "--parameters");
        diag_add(fit->errors, FBD_ERROR, "unknown-parameter", (struct pos){0, 0},
                 diag_nearest(fit->errors, fit->plan->parameters[i], names, count),
                 "the model has no parameter `%.40s`", fit->plan->parameters[i]);
        return false;
    }
    return true;
}

static bool choose(struct fbd_fit *fit, const fbd_model *model)
{
    const size_t count = fbd_model_parameter_count(model);
    fit->fitted = ARENA_ARRAY(&fit->arena, count + 1, fbd_fitted);
    if (!fit->fitted || !check_names(fit, model)) return false;
    for (size_t i = 0; i < count; i++) {
        const fbd_parameter parameter = fbd_model_parameter(model, i);
        if (!is_chosen(fit->plan, &parameter)) continue;
        fit->fitted[fit->count++] =
            (fbd_fitted){.name = arena_text(&fit->arena, parameter.name, strlen(parameter.name)),
                         .unit = arena_text(&fit->arena, parameter.unit, strlen(parameter.unit)),
                         .value = parameter.value};
    }
    return !fit->arena.failed;
}

static bool check_counts(struct fbd_fit *fit)
{
    const char *why = fit->count == 0                ? "the model has no parameter to fit"
                      : fit->data.count < fit->count ? "the data have fewer values than there are parameters"
                                                     : NULL;
    if (!why) return true;
    diag_in_file(fit->errors, fit->data_name);
    diag_add(fit->errors, FBD_ERROR, "bad-data", (struct pos){0, 0}, "choose parameters by --parameters",
             "%s", why);
    return false;
}

/* ---- the fit */

static void set_tolerance(struct fbd_fit *fit, const fbd_model *model)
{
    const double usual = 1e-10;
    fbd_options file;
    fbd_model_options(model, &file, sizeof file);
    fit->tolerance = fit->plan->run->tolerance > 0 ? fit->plan->run->tolerance
                     : file.tolerance > 0          ? file.tolerance
                                                   : usual;
}

static bool make(struct fbd_fit *fit, const char *data, size_t length)
{
    fbd_model *model = fbd_model_parse(fit->source, fit->source_length, fit->name, fit->plan->settings,
                                       fit->plan->setting_count, fit->errors);
    bool fine = model && choose(fit, model) &&
                fit_data_read(&fit->data, &fit->arena, data, length, fit->data_name, model, fit->errors);
    if (fine) {
        fbd_options run = *fit->plan->run;
        run.until = 1; /* any: the other options are checked */
        fbd_simulation *simulation = fbd_simulation_new(model, &run, fit->errors);
        fine = simulation != NULL;
        fbd_simulation_free(simulation);
        set_tolerance(fit, model);
    }
    fbd_model_free(model);
    return fine && check_counts(fit) && fit_solve(fit);
}

static bool is_asked(fbd_fit_plan *plan, fbd_options *run, const char *text, const char *data,
                     const fbd_fit_plan *given, fbd_errors *errors)
{
    *plan = (fbd_fit_plan){0};
    *run = (fbd_options)FBD_OPTIONS_DEFAULT;
    if (!api_take_options(plan, sizeof *plan, given, errors) ||
        !api_take_options(run, sizeof *run, plan->run, errors))
        return false;
    plan->run = run;
    if (!text || !data)
        api_refuse(errors, text ? "there are no data" : "there is no text");
    else if (!api_has_settings(plan->settings, plan->setting_count) ||
             !api_has_texts(plan->parameters, plan->parameter_count))
        api_refuse(errors, "a text of the plan is missing");
    else
        return true;
    return false;
}

fbd_fit *fbd_fit_parse(const char *text, size_t length, const char *name, const char *data,
                       size_t data_length, const char *data_name, const fbd_fit_plan *given, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_fit_plan plan;
    fbd_options run;
    struct fbd_fit *fit = is_asked(&plan, &run, text, data, given, errors) ? calloc(1, sizeof *fit) : NULL;
    bool made = false;
    if (fit) {
        fit->source = arena_text(&fit->arena, text, length);
        fit->name = name ? arena_text(&fit->arena, name, strlen(name)) : NULL;
        fit->data_name = data_name ? arena_text(&fit->arena, data_name, strlen(data_name)) : "data";
        fit->source_length = length;
        fit->plan = &plan;
        fit->errors = errors;
        made = fit->source && make(fit, data, data_length);
        fbd_errors_free(fit->run_errors);
        fit->run_errors = fit->errors = NULL;
        fit->plan = NULL;
    }
    if (!made && fbd_errors_failed_count(errors) == 0) diag_out_of_memory(errors);
    diag_end(&call);
    if (made) return fit;
    fbd_fit_free(fit);
    return NULL;
}

void fbd_fit_free(fbd_fit *fit)
{
    if (!fit) return;
    arena_free(&fit->arena);
    free(fit);
}

size_t fbd_fit_count(const fbd_fit *fit)
{
    return fit ? fit->count : 0;
}

fbd_fitted fbd_fit_get(const fbd_fit *fit, size_t index)
{
    if (fit && index < fit->count) return fit->fitted[index];
    return (fbd_fitted){.value = NAN, .error = NAN, .low = NAN, .high = NAN};
}

double fbd_fit_correlation(const fbd_fit *fit, size_t a, size_t b)
{
    if (!fit || a >= fit->count || b >= fit->count) return NAN;
    const double *C = fit->covariance;
    const size_t n = fit->count;
    return C[a * n + b] / sqrt(C[a * n + a] * C[b * n + b]);
}

fbd_fit_quality fbd_fit_summary(const fbd_fit *fit)
{
    if (!fit) return (fbd_fit_quality){.squares = NAN, .deviation = NAN};
    const size_t freedom = fit->data.count - fit->count;
    return (fbd_fit_quality){.values = fit->data.count,
                             .freedom = freedom,
                             .weighted = fit->data.weighted,
                             .squares = fit->squares,
                             .deviation = freedom > 0 ? sqrt(fit->squares / (double)freedom) : NAN,
                             .unit = fit->data.unit,
                             .iterations = fit->iterations,
                             .runs = fit->runs};
}
