/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What error bars cost: library time of a run with them over that of the same run without, in interleaved
 * pairs, for every model given; in memory, with CSV written to nowhere, and by counted right-hand sides.
 *
 * Usage: bench_error_bars MODEL...
 */
#include <string.h>

#include <gsl/gsl_errno.h>

#include "fbd.h"
#include "timing.h"

enum { pairs = 41, few_pairs = 5, most_models = 500 };

static int nowhere(void *context, const char *text, size_t length)
{
    (void)context, (void)text, (void)length;
    return 0;
}

/* Seconds of a whole run, making and freeing included. */
static double run(const fbd_model *model, bool error_bars, bool csv, fbd_stats *stats)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.error_bars = error_bars;
    fbd_recording recording = {.ledger = true, .csv = csv ? nowhere : NULL};
    fbd_errors *errors = fbd_errors_new();
    double start = processor_seconds();
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_result *result = simulation ? fbd_simulation_run(simulation, &recording) : NULL;
    if (result) *stats = fbd_simulation_stats(simulation);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    double seconds = processor_seconds() - start;
    fbd_errors_free(errors);
    return seconds;
}

/* The median ratio of pairs; of a few where one run takes long. */
static double ratio(const fbd_model *model, bool csv, fbd_stats *stats)
{
    double ratios[pairs];
    fbd_stats plain = {0};
    const double is_long = 0.05;
    size_t count = run(model, true, csv, stats) > is_long ? few_pairs : pairs;
    for (size_t i = 0; i < count; i++) {
        double without = run(model, false, csv, &plain);
        ratios[i] = run(model, true, csv, stats) / without;
    }
    return median(ratios, count);
}

int main(int argc, char **argv)
{
    static double in_memory[most_models], with_csv[most_models];
    size_t count = 0;
    gsl_set_error_handler_off();
    printf("time with error bars / time without, medians of %d interleaved pairs (%d of long runs)\n", pairs,
           few_pairs);
    printf("%-42s %10s %10s %12s %10s\n", "", "no output", "CSV", "RHS", "companion");
    for (int i = 1; i < argc && count < most_models; i++) {
        fbd_errors *errors = fbd_errors_new();
        fbd_model *model = fbd_model_read(argv[i], NULL, 0, errors);
        fbd_stats stats = {0};
        const char *name = strstr(argv[i], "models/");
        if (model) {
            in_memory[count] = ratio(model, false, &stats);
            with_csv[count] = ratio(model, true, &stats);
            printf("%-42s %10.2f %10.2f %12lu %10lu\n", name ? name : argv[i], in_memory[count],
                   with_csv[count], stats.rhs, stats.companion_rhs);
            fflush(stdout);
            count++;
        }
        fbd_model_free(model);
        fbd_errors_free(errors);
    }
    if (count == 0) return 2;
    double middle = median(in_memory, count), middle_csv = median(with_csv, count);
    printf("median %.2f, largest %.2f; with CSV median %.2f, largest %.2f\n", middle, in_memory[count - 1],
           middle_csv, with_csv[count - 1]);
    return 0;
}
