/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A block at rest in stick for 1e6 s against the same for 1 s, each with 500 rows of output: the times of
 * whole runs made in turn, and their ratio. It should be 1 to within a tenth.
 */
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "fbd.h"
#include "timing.h"

enum { pairs = 2001 };

static const char scene[] =
    "fbd: 1\nbodies:\n  block: {mass: 2 kg, motion: {slide: {along: 20 deg}}, forces: [gravity, normal, "
    "{friction: {static: 0.5, kinetic: 0.4}}]}\n";

static int count(void *context, const char *text, size_t length)
{
    size_t *bytes = context;
    (void)text;
    *bytes += length;
    return 0;
}

/* Seconds of a run of `until` seconds; *steps is what it took. */
static double run(const fbd_model *model, double until, unsigned long *steps, fbd_errors *errors)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = until;
    size_t bytes = 0;
    fbd_recording recording = {.every = until / 500, .csv = count, .csv_context = &bytes};
    double start = wall_seconds();
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_result *result = simulation ? fbd_simulation_run(simulation, &recording) : NULL;
    double seconds = wall_seconds() - start;
    if (!result || fbd_result_outcome(result) != FBD_DONE || bytes == 0) exit(1);
    *steps = fbd_simulation_stats(simulation).steps;
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    return seconds;
}

int main(void)
{
    static double ratio[pairs], brief[pairs];
    gsl_set_error_handler_off();
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(scene, strlen(scene), "at rest", NULL, 0, errors);
    if (!model) {
        fbd_errors_print(errors, stderr);
        return 1;
    }
    unsigned long few = 0, many = 0;
    for (int k = 0; k < pairs; k++) {
        brief[k] = run(model, 1, &few, errors);
        ratio[k] = run(model, 1e6, &many, errors) / brief[k];
    }
    printf("block at rest: 1 s takes %.1f us in %lu steps; 1e6 s takes %.3f times that in %lu steps\n",
           1e6 * median(brief, pairs), few, median(ratio, pairs), many);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return 0;
}
