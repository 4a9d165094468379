/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Every method by its name moves the pendulum and the oscillator as the reference says, to the accuracy that
 * its tolerance promises and in a sensible number of steps.
 *
 * What a tolerance promises: a step errs by at most the tolerance times the size of the motion. Neither
 * system magnifies errors (the period of the pendulum depends on its energy, which over one period is
 * harmless), so after n steps the motion is off by at most n times that; and an estimate of an error is right
 * to a factor of two at best, in the longest steps of bsimp no better. Methods whose estimate is one of a
 * lower order, as the explicit pairs, do far better.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

/* A method of order p needs about tolerance^(-1/(p + 1)) steps, times what its error constant says: the
 * limits are twice what was measured, so that a method which creeps is seen. */
static const struct {
    const char *name;
    double coarse, fine; /* tolerances */
    unsigned long most_pendulum, most_oscillator;
} methods[] = {
    {"dop853", 1e-6, 1e-11, 100, 250},    {"rk8pd", 1e-6, 1e-11, 100, 250},
    {"rkf45", 1e-5, 1e-9, 300, 1000},     {"rkck", 1e-5, 1e-9, 200, 700},
    {"rk4", 1e-5, 1e-9, 350, 1200},       {"rk2", 1e-4, 1e-8, 4000, 16000},
    {"msadams", 1e-6, 1e-10, 1500, 1000}, {"msbdf", 1e-6, 1e-9, 1200, 2000},
    {"bsimp", 1e-6, 1e-10, 80, 40},       {"rk4imp", 1e-5, 1e-9, 250, 800},
    {"rk2imp", 1e-4, 1e-7, 1500, 6000},   {"rk1imp", 1e-4, 1e-6, 13000, 60000},
};

enum { method_count = sizeof methods / sizeof *methods };

/* The error of `name` at the time of a reference number, relative to the size of the motion; *steps made. */
static double error_of(const char *path, const char *method, double tolerance, const char *reference,
                       const char *name, double size, unsigned long *steps)
{
    const struct reference *want = &references[reference_find(reference)];
    struct trial trial = trial_open(path, NULL);
    trial_start(&trial, &(fbd_options){.until = want->t, .tolerance = tolerance, .method = method});
    trial_finish(&trial);
    assert_string_equal(fbd_simulation_stats(trial.simulation).method, method);
    double error = fabs(trial_get(&trial, name) - want->value) / size;
    *steps = fbd_simulation_stats(trial.simulation).steps;
    trial_close(&trial);
    return error;
}

static double promised(double tolerance, unsigned long steps)
{
    return 2 * tolerance * (double)steps;
}

static void check_method(struct checks *checks, size_t i, const char *path, const char *reference,
                         const char *coordinate, double size, unsigned long most)
{
    char what[160];
    unsigned long steps;
    double coarse = error_of(path, methods[i].name, methods[i].coarse, reference, coordinate, size, &steps);
    snprintf(what, sizeof what, "%s at %g: %s", methods[i].name, methods[i].coarse, reference);
    check_close(checks, what, coarse, 0, promised(methods[i].coarse, steps));
    double fine = error_of(path, methods[i].name, methods[i].fine, reference, coordinate, size, &steps);
    snprintf(what, sizeof what, "%s at %g: %s", methods[i].name, methods[i].fine, reference);
    check_close(checks, what, fine, 0, promised(methods[i].fine, steps));
    snprintf(what, sizeof what, "%s at %g: %lu steps are no more than %lu", methods[i].name, methods[i].fine,
             steps, most);
    check_that(checks, what, steps <= most);
    /* A tolerance that is smaller by 100 or more has to show. */
    snprintf(what, sizeof what, "%s: a finer tolerance is more accurate (%.3g, %.3g)", methods[i].name,
             coarse, fine);
    check_that(checks, what, fine < coarse / 5 || fine < 1e-12);
}

static void every_method_swings_the_pendulum(void **unused)
{
    (void)unused;
    const double size = 3.14159265358979323846 / 3;
    struct checks checks = {0};
    for (size_t i = 0; i < method_count; i++)
        check_method(&checks, i, "rotation/compound_pendulum.yaml", "A07.theta_2.0", "theta", size,
                     methods[i].most_pendulum);
    checks_end(&checks);
}

static void every_method_moves_the_oscillator(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (size_t i = 0; i < method_count; i++)
        check_method(&checks, i, "vibration/damped_oscillator.yaml", "D06.U_x_3", "x", 1,
                     methods[i].most_oscillator);
    checks_end(&checks);
}

/* Sizes of 1e-6 m and 1e3 m: no method may have a tolerance in metres. */
static void every_method_is_blind_to_the_scale(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (size_t i = 0; i < method_count; i++) {
        double x[2];
        const fbd_options options = {.until = 1, .tolerance = methods[i].coarse, .method = methods[i].name};
        for (int k = 0; k < 2; k++) {
            struct trial trial = k == 0 ? trial_open("vibration/damped_oscillator.yaml", NULL)
                                        : trial_open("vibration/damped_oscillator.yaml",
                                                     SET("mass=1e-9", "c=1e-9", "k=1e-7", "x0=1e-6"));
            trial_start(&trial, &options);
            trial_finish(&trial);
            x[k] = trial_get(&trial, "x") / (k == 0 ? 1 : 1e-6);
            trial_close(&trial);
        }
        /* The same steps up to rounding, which a method of many steps adds up. */
        check_close(&checks, methods[i].name, x[1], x[0], 1e-9);
    }
    checks_end(&checks);
}

static void an_unknown_method_is_refused_with_the_nearest_name(void **unused)
{
    (void)unused;
    struct trial trial = trial_open("vibration/damped_oscillator.yaml", NULL);
    fbd_errors *errors = fbd_errors_new();
    assert_null(fbd_simulation_new(trial.model, &(fbd_options){.until = NAN, .method = "rk45"}, errors));
    assert_int_equal(fbd_errors_count(errors), 1);
    assert_string_equal(fbd_errors_get(errors, 0)->id, "unknown-method");
    assert_non_null(fbd_errors_get(errors, 0)->hint);
    fbd_errors_free(errors);
    trial_close(&trial);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_swings_the_pendulum),
        cmocka_unit_test(every_method_moves_the_oscillator),
        cmocka_unit_test(every_method_is_blind_to_the_scale),
        cmocka_unit_test(an_unknown_method_is_refused_with_the_nearest_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
