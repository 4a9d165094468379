/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Accuracy on request: it is delivered, or what is delivered says that it is not; and what a search leaves
 * that is interrupted.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "exact_motions.h"
#include "fbd_export.h"
#include "fbd_study.h"
#include "gallery.h"
#include "rows.h"
#include "scenes.h"

/* The largest error over the run, each coordinate and rate by its size. */
static double true_error(struct trial *trial, const char *path, double x_size, double v_size)
{
    double worst = 0, exact[2];
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_stats stats = fbd_simulation_stats(trial->simulation);
    options.tolerance = stats.tolerance;
    options.method = stats.method;
    struct trial again = trial_open(path, NULL);
    trial_start(&again, &options);
    double until = 0;
    fbd_state_get(fbd_result_state(trial->result), "t", &until);
    for (int k = 1; k <= 300; k++) {
        trial_to(&again, until * k / 300);
        exact_motion_of(path)(until * k / 300, exact);
        worst = fmax(worst, fabs(trial_get(&again, x_size > 0 ? "x" : "theta") - exact[0]) / fabs(x_size));
        worst = fmax(worst, fabs(trial_get(&again, x_size > 0 ? "v" : "omega") - exact[1]) / v_size);
    }
    trial_close(&again);
    return worst;
}

static void an_accuracy_that_is_asked_for_is_delivered(void **unused)
{
    static const double accuracies[] = {1e-3, 1e-6, 1e-9, 1e-12};
    static const char *const methods[] = {"auto", "dop853", "rkf45", "rk8pd", "msadams", "rodas5p"};
    static const char path[] = "vibration/damped_oscillator.yaml";
    (void)unused;
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof accuracies / sizeof *accuracies; i++)
        for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
            struct trial trial = trial_open(path, NULL);
            fbd_options options = FBD_OPTIONS_DEFAULT;
            options.accuracy = accuracies[i];
            options.method = methods[m];
            trial_run(&trial, &options);
            fbd_stats stats = fbd_simulation_stats(trial.simulation);
            assert_string_equal(stats.method, methods[m]);
            check_that(&checks, "the estimate says so", fbd_result_accurate(trial.result));
            check_that(&checks, "few runs", stats.runs <= 4);
            /* largest x: x0 = 1 m; largest v: 9.3 m/s at the first passage */
            double error = true_error(&trial, path, 1, 9.3);
            printf("# %s, %g asked for: %.2g at tolerance %.2g, %lu runs\n", methods[m], accuracies[i], error,
                   stats.tolerance, stats.runs);
            check_close(&checks, methods[m], error, 0, accuracies[i]);
            trial_close(&trial);
        }
    checks_end(&checks);
}

/* An accuracy below the rounding of a number cannot be had; the best is delivered and says what it is. */
static void an_accuracy_below_rounding_is_refused_with_the_best(void **unused)
{
    (void)unused;
    struct trial trial = trial_open("vibration/damped_oscillator.yaml", NULL);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.accuracy = 1e-16;
    trial_run(&trial, &options);
    assert_false(fbd_result_accurate(trial.result));
    fbd_stats stats = fbd_simulation_stats(trial.simulation);
    double error = true_error(&trial, "vibration/damped_oscillator.yaml", 1, 9.3);
    assert_true(stats.error_estimate < 1e-13 && error < 1e-13);
    assert_true(stats.runs <= 8);
    trial_close(&trial);
}

static int stop_at_one(void *unused, const fbd_progress *progress)
{
    (void)unused;
    return progress->t >= 1;
}

/* What was computed is shown, but nobody knows whether the whole run would have been as accurate as it was to
 * be. */
static void an_interrupted_run_has_not_reached_its_accuracy(void **unused)
{
    (void)unused;
    struct trial trial = trial_open("vibration/damped_oscillator.yaml", NULL);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.accuracy = 1e-3; /* that of the first run, if it came to its end */
    const fbd_recording recording = {.progress = stop_at_one};
    trial_start(&trial, &options);
    fbd_result *result = fbd_simulation_run(trial.simulation, &recording);
    assert_int_equal(fbd_result_outcome(result), FBD_INTERRUPTED);
    assert_false(fbd_result_accurate(result));
    char *report = fbd_result_report(result, false);
    assert_non_null(strstr(report, "requested accuracy 0.001: NOT known"));
    free(report);
    fbd_result_free(result);
    trial_close(&trial);
}

/* Rows of a table: how many begin so. */
static size_t count_lines(const struct rows *rows, const char *beginning)
{
    size_t count = 0;
    for (const char *line = rows->text; line && *line; line = strchr(line, '\n')) {
        line += *line == '\n';
        count += strncmp(line, beginning, strlen(beginning)) == 0;
    }
    return count;
}

/* Watches the runs of a search, which begin at 0 again; stops the `stop`th of them, from 1, half way. */
struct watch {
    unsigned long runs, stop;
    double t;
};

static int watch_runs(void *context, const fbd_progress *progress)
{
    struct watch *watch = context;
    watch->runs += watch->runs == 0 || progress->t < watch->t;
    watch->t = progress->t;
    return watch->runs == watch->stop && progress->t > progress->until / 2;
}

struct searched {
    struct trial trial;
    struct rows rows;
    struct watch watch;
    fbd_result *result;
    fbd_stats stats;
};

/* An accuracy that takes rkf45 two runs. */
static struct searched search(unsigned long stop)
{
    struct searched searched = {.trial = trial_open("vibration/damped_oscillator.yaml", NULL),
                                .watch = {.stop = stop}};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.accuracy = 1e-9;
    options.method = "rkf45";
    const fbd_recording recording = {.csv = append,
                                     .csv_context = &searched.rows,
                                     .every = 0.01,
                                     .progress = watch_runs,
                                     .progress_context = &searched.watch};
    trial_start(&searched.trial, &options);
    searched.result = fbd_simulation_run(searched.trial.simulation, &recording);
    assert_non_null(searched.result);
    searched.stats = fbd_simulation_stats(searched.trial.simulation);
    return searched;
}

static void end_search(struct searched *searched)
{
    free(searched->rows.text);
    fbd_result_free(searched->result);
    trial_close(&searched->trial);
}

static void the_rows_are_those_of_the_run_that_was_accurate(void **unused)
{
    (void)unused;
    struct searched searched = search(0);
    assert_true(fbd_result_accurate(searched.result));
    assert_int_equal(searched.stats.runs, 2);
    assert_int_equal(searched.watch.runs, 2); /* none is made twice */
    assert_int_equal(count_lines(&searched.rows, "t [s]"), 1);
    assert_int_equal(count_lines(&searched.rows, "0,"), 1);
    end_search(&searched);
}

/* What was interrupted is the second run; the first one is there, with its bits. */
static void a_search_that_is_interrupted_leaves_the_best_whole_run(void **unused)
{
    (void)unused;
    struct rows alone = {0};
    struct searched searched = search(2);
    assert_int_equal(fbd_result_outcome(searched.result), FBD_DONE);
    assert_false(fbd_result_accurate(searched.result));
    assert_true(isfinite(searched.stats.error_estimate) && searched.stats.error_estimate > 1e-9);
    char *report = fbd_result_report(searched.result, false);
    assert_non_null(strstr(report, ": NOT reached when it was interrupted"));
    free(report);

    struct trial trial = trial_open("vibration/damped_oscillator.yaml", NULL);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = searched.stats.tolerance;
    options.method = "rkf45";
    options.error_bars = true;
    trial_start(&trial, &options);
    const fbd_recording recording = {.csv = append, .csv_context = &alone, .every = 0.01};
    fbd_result *result = fbd_simulation_run(trial.simulation, &recording);
    assert_string_equal(searched.rows.text, alone.text);
    assert_true(fbd_simulation_stats(trial.simulation).error_estimate == searched.stats.error_estimate);
    free(alone.text);
    fbd_result_free(result);
    trial_close(&trial);
    end_search(&searched);
}

static void a_first_run_that_is_interrupted_leaves_what_it_has(void **unused)
{
    (void)unused;
    struct searched searched = search(1);
    double until, from;
    fbd_simulation_interval(searched.trial.simulation, &from, &until);
    assert_int_equal(fbd_result_outcome(searched.result), FBD_INTERRUPTED);
    assert_int_equal(searched.watch.runs, 1);
    assert_true(count_lines(&searched.rows, "") > (size_t)(until / 0.01));
    end_search(&searched);
}

static void check_refused(const fbd_model *model, fbd_options options, const char *id)
{
    fbd_errors *errors = fbd_errors_new();
    assert_null(fbd_simulation_new(model, &options, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, id);
    fbd_errors_free(errors);
}

static void an_accuracy_excludes_what_it_chooses(void **unused)
{
    (void)unused;
    struct trial trial = trial_open("kinetics/incline.yaml", NULL);
    check_refused(trial.model, (fbd_options){.until = NAN, .accuracy = 1e-8, .tolerance = 1e-9},
                  "bad-option");
    check_refused(trial.model, (fbd_options){.until = NAN, .accuracy = 1e-8, .step = 0.1}, "bad-option");
    check_refused(trial.model, (fbd_options){.until = NAN, .accuracy = 0.5}, "bad-option");
    check_refused(trial.model, (fbd_options){.until = NAN, .accuracy = -1}, "bad-option");
    check_refused(trial.model, (fbd_options){.until = NAN, .accuracy = NAN}, "bad-option");
    trial_close(&trial);
}

static void an_option_stands_before_the_file(void **unused)
{
    static const char text[] = "fbd: 1\nbodies:\n  b: {mass: 1 kg, motion: slide, initial: {x: 1 m}, "
                               "forces: [{spring: {stiffness: 1 N/m}}]}\n"
                               "simulate: {until: 20 s, accuracy: 1e-6}\n";
    (void)unused;
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    assert_true(fbd_simulation_stats(trial.simulation).accuracy == 1e-6);
    assert_true(fbd_simulation_stats(trial.simulation).error_estimate <= 1e-6);
    trial_close(&trial);
    trial = trial_parse(text);
    trial_run(&trial, &(fbd_options){.until = NAN, .tolerance = 1e-3});
    assert_true(fbd_simulation_stats(trial.simulation).tolerance == 1e-3);
    assert_true(fbd_simulation_stats(trial.simulation).accuracy == 0);
    assert_true(isnan(fbd_simulation_stats(trial.simulation).error_estimate));
    trial_close(&trial);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_accuracy_that_is_asked_for_is_delivered),
        cmocka_unit_test(an_accuracy_below_rounding_is_refused_with_the_best),
        cmocka_unit_test(an_interrupted_run_has_not_reached_its_accuracy),
        cmocka_unit_test(the_rows_are_those_of_the_run_that_was_accurate),
        cmocka_unit_test(a_search_that_is_interrupted_leaves_the_best_whole_run),
        cmocka_unit_test(a_first_run_that_is_interrupted_leaves_what_it_has),
        cmocka_unit_test(an_accuracy_excludes_what_it_chooses),
        cmocka_unit_test(an_option_stands_before_the_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
