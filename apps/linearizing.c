/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "linearizing.h"

#include <stdlib.h>
#include <string.h>

#include "deliver.h"
#include "fbd_linear.h"
#include "fbd_view.h"

/* ---- the system */

enum { most_signals = 100 };

static fbd_linear_system *make_system(const struct options *options, const fbd_linearization *linear,
                                      fbd_errors *errors)
{
    const char *inputs[most_signals], *outputs[most_signals];
    char *input_list = options->inputs ? strdup(options->inputs) : NULL,
         *output_list = options->outputs ? strdup(options->outputs) : NULL;
    const fbd_linear_plan plan = {.size = sizeof plan,
                                  .inputs = inputs,
                                  .input_count = cut_list(input_list, inputs, most_signals),
                                  .outputs = outputs,
                                  .output_count = cut_list(output_list, outputs, most_signals)};
    fbd_linear_system *system = fbd_linear_system_new(linear, &plan, errors);
    free(input_list);
    free(output_list);
    return system;
}

/* True for options that need inputs. */
static bool needs_inputs(const struct options *options)
{
    return options->inputs || options->outputs || options->csv || options->plot || options->gnuplot;
}

static bool has_inputs(const fbd_model *model)
{
    for (size_t i = 0; i < fbd_model_parameter_count(model); i++)
        if (fbd_model_parameter(model, i).input) return true;
    return false;
}

/* ---- outputs */

static bool write_responses(const struct options *options, const fbd_linear_system *system)
{
    if (options->csv && !deliver_text(options->csv, fbd_linear_system_csv(system))) return false;
    if (options->gnuplot && !deliver_text(options->gnuplot, fbd_linear_system_gnuplot(system, options->plot)))
        return false;
    return !options->plot || deliver_plot(options->plot, fbd_linear_system_gnuplot(system, options->plot));
}

/* `system` may be NULL. */
static bool write_all(const struct options *options, const fbd_linearization *linear,
                      const fbd_linear_system *system)
{
    const bool quiet = options->quiet || options_use_stdout(options);
    if (!quiet &&
        !deliver_text(NULL, system ? fbd_linear_system_text(system) : fbd_linearization_text(linear)))
        return false;
    if (options->json) {
        *options->json_written = true;
        if (!deliver_text(options->json,
                          system ? fbd_linear_system_json(system) : fbd_linearization_json(linear)))
            return false;
    }
    if (options->svg && !deliver_picture(options->svg, fbd_linearization_svg(linear))) return false;
    return !system || write_responses(options, system);
}

/* A wrong name is one of the command line. */
static enum exit_code blame(fbd_errors *errors)
{
    static const char *const of_command_line[] = {"no-inputs", "unknown-input", "unknown-output"};
    for (size_t i = 0; i < fbd_errors_count(errors); i++)
        for (size_t k = 0; k < sizeof of_command_line / sizeof *of_command_line; k++)
            if (strcmp(fbd_errors_get(errors, i).id, of_command_line[k]) == 0) return exit_usage;
    return exit_failed;
}

enum exit_code linearizing(const struct options *options, fbd_state *state, fbd_errors *errors)
{
    fbd_linearization *linear = fbd_linearize(state, errors);
    if (!linear) return exit_failed;
    const bool needed = needs_inputs(options), wanted = needed || has_inputs(fbd_linearization_model(linear));
    /* a scene that has a linear motion, and none by its inputs, is linearized without them */
    fbd_linear_system *system = wanted ? make_system(options, linear, needed ? errors : NULL) : NULL;
    enum exit_code code = needed && !system ? blame(errors) : exit_done;
    if (code == exit_done && !write_all(options, linear, system)) code = exit_failed;
    fbd_linear_system_free(system);
    fbd_linearization_free(linear);
    return code;
}
