/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/options.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "loop/structure.h"

static const double default_tolerance = 1e-10;

static const char automatic[] = "auto";

static const struct method *choose_method(const struct fbd_model *model, const fbd_options *given,
                                          fbd_errors *errors)
{
    const char *name = given->method ? given->method : model->scene->simulate.method;
    if (!name || strcmp(name, automatic) == 0) return structure_method(model, structure_general);
    const struct method *method = method_find(name);
    if (method) return method;
    const char *names[32];
    size_t count = 0;
    for (; count < sizeof names / sizeof *names && method_at(count); count++)
        names[count] = method_at(count)->name;
    diag_add(errors, FBD_ERROR, "unknown-method", (struct pos){0, 0},
             diag_nearest(errors, name, names, count), "there is no method `%s`", name);
    return NULL;
}

static void bad_option(fbd_errors *errors, const char *id, const char *hint, const char *message)
{
    diag_add(errors, FBD_ERROR, id, (struct pos){0, 0}, hint, "%s", message);
}

bool options_choose(const struct fbd_model *model, const fbd_options *given, struct run_options *chosen,
                    fbd_errors *errors)
{
    const struct simulate *file = &model->scene->simulate;
    size_t before = fbd_errors_failed_count(errors);
    diag_in_file(errors, model->scene->file);
    const char *name = given->method ? given->method : file->method;
    *chosen = (struct run_options){.method = choose_method(model, given, errors),
                                   .automatic = !name || strcmp(name, automatic) == 0,
                                   .structure = !given->no_structure};
    chosen->until = !isnan(given->until) ? given->until
                    : file->until.expr   ? expr_value(file->until.expr)
                                         : NAN;
    chosen->tolerance = given->tolerance != 0 ? given->tolerance
                        : file->tolerance > 0 ? file->tolerance
                                              : default_tolerance;
    chosen->step = given->step != 0 ? given->step : given->automatic_step ? 0 : file->step;
    if (!isnan(given->until)) diag_in_file(errors, NULL); /* not in the file */
    if (isnan(chosen->until))
        bad_option(errors, "no-end-time", "write `simulate: {until: 2 s}` or give --until",
                   "the model has no end time");
    else if (!(chosen->until >= 0) || isinf(chosen->until))
        bad_option(errors, "bad-option", "runs start at t = 0",
                   "the end time lies before the start or is not finite");
    diag_in_file(errors, given->tolerance != 0 ? NULL : model->scene->file);
    if (!(chosen->tolerance > 0 && chosen->tolerance <= 0.1))
        bad_option(errors, "bad-option", "1e-10 is the default",
                   "the tolerance must be above 0 and at most 0.1");
    else if (chosen->tolerance < DBL_EPSILON)
        bad_option(errors, "bad-option", "the smallest useful tolerance is about 1e-13; 1e-10 is the default",
                   "the tolerance is below the resolution of numbers (2.2e-16)");
    diag_in_file(errors, given->step != 0 ? NULL : model->scene->file);
    if (!(chosen->step >= 0) || isinf(chosen->step))
        bad_option(errors, "bad-option", NULL, "the step size must be positive");
    return fbd_errors_failed_count(errors) == before;
}

const char *options_method(const struct run_options *options)
{
    return options->automatic ? automatic : options->method->name;
}
