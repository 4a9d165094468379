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

#include "fbd_study.h"
#include "gallery.h"
#include "integrate/method.h"
#include "scenes.h"

/* A method of order p needs about tolerance^(-1/(p + 1)) steps, times what its error constant says: the
 * limits are twice what was measured at the finer tolerance, so that a method which creeps is seen. The
 * pendulum has four events in this time, after which multistep methods start anew with order 1. */
static const struct {
    const char *name;
    double coarse, fine; /* tolerances */
    unsigned long most_pendulum, most_oscillator;
} methods[] = {
    {"dop853", 1e-6, 1e-11, 90, 260},     {"rk8pd", 1e-6, 1e-11, 90, 250},
    {"rkf45", 1e-5, 1e-9, 210, 960},      {"rkck", 1e-5, 1e-9, 160, 680},
    {"rk4", 1e-5, 1e-9, 260, 1060},       {"rk2", 1e-4, 1e-8, 3300, 13400},
    {"msadams", 1e-6, 1e-10, 1500, 1200}, {"msbdf", 1e-6, 1e-9, 900, 2000},
    {"bsimp", 1e-6, 1e-10, 150, 30},      {"rk4imp", 1e-5, 1e-9, 180, 740},
    {"rk2imp", 1e-4, 1e-7, 1200, 5000},   {"rk1imp", 1e-4, 1e-6, 12500, 46000},
};

enum { method_count = sizeof methods / sizeof *methods };

/* What is looked at: a coordinate of a model at the time of a reference number. */
struct task {
    const char *path, *reference, *coordinate;
    double size; /* of the motion */
    bool pendulum;
};

/* The error relative to the size of the motion, and the steps made. */
static double error_of(const struct task *task, const char *method, double tolerance, unsigned long *steps)
{
    const struct reference *want = &references[reference_find(task->reference)];
    struct trial trial = trial_open(task->path, NULL);
    trial_start(&trial, &(fbd_options){.until = want->t, .tolerance = tolerance, .method = method});
    trial_finish(&trial);
    assert_string_equal(fbd_simulation_stats(trial.simulation).method, method);
    double error = fabs(trial_get(&trial, task->coordinate) - want->value) / task->size;
    *steps = fbd_simulation_stats(trial.simulation).steps;
    trial_close(&trial);
    return error;
}

static double promised(double tolerance, unsigned long steps)
{
    return 2 * tolerance * (double)steps;
}

/* The motion holds at one tolerance, in a sensible number of steps. Returns its error. */
static double check_tolerance(struct checks *checks, const struct task *task, const char *method,
                              double tolerance, unsigned long most)
{
    char what[160];
    unsigned long steps;
    double error = error_of(task, method, tolerance, &steps);
    snprintf(what, sizeof what, "%s at %g: %s", method, tolerance, task->reference);
    check_close(checks, what, error, 0, promised(tolerance, steps));
    snprintf(what, sizeof what, "%s at %g: %lu steps are no more than %lu", method, tolerance, steps, most);
    check_that(checks, what, steps <= most);
    return error;
}

/* Both tolerances of all methods; the finer one, by a factor of 100 at least, has to show. */
static void check_methods(struct checks *checks, const struct task *task)
{
    for (size_t i = 0; i < method_count; i++) {
        const char *name = methods[i].name;
        unsigned long most = task->pendulum ? methods[i].most_pendulum : methods[i].most_oscillator;
        double coarse = check_tolerance(checks, task, name, methods[i].coarse, most);
        double fine = check_tolerance(checks, task, name, methods[i].fine, most);
        char what[160];
        snprintf(what, sizeof what, "%s: finer is more accurate (%.3g, %.3g)", name, coarse, fine);
        check_that(checks, what, fine < coarse / 5 || fine < 1e-12);
    }
}

static void every_method_swings_the_pendulum(void **unused)
{
    (void)unused;
    const struct task task = {"rotation/compound_pendulum.yaml", "A07.theta_2.0", "theta",
                              3.14159265358979323846 / 3, true};
    struct checks checks = {0};
    check_methods(&checks, &task);
    checks_end(&checks);
}

static void every_method_moves_the_oscillator(void **unused)
{
    (void)unused;
    const struct task task = {"vibration/damped_oscillator.yaml", "D06.U_x_3", "x", 1, false};
    struct checks checks = {0};
    check_methods(&checks, &task);
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
    assert_string_equal(fbd_errors_get(errors, 0).id, "unknown-method");
    assert_non_null(fbd_errors_get(errors, 0).hint);
    fbd_errors_free(errors);
    trial_close(&trial);
}

/* The language has the names in a table of its own (lib/scene/language.c). */
static void a_file_may_name_every_method_and_no_other(void **unused)
{
    (void)unused;
    enum { longest_text = 300 };
    char text[longest_text];
    for (size_t i = 0; method_at(i); i++) {
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies: {b: {mass: 1 kg, motion: slide, initial: {v: 1 m/s}}}\n"
                 "simulate: {until: 1 s, method: %s}\n",
                 method_at(i)->name);
        fbd_model *model = model_from(text);
        fbd_simulation *simulation = fbd_simulation_new(model, &(fbd_options)FBD_OPTIONS_DEFAULT, NULL);
        assert_non_null(simulation);
        assert_string_equal(fbd_simulation_stats(simulation).method, method_at(i)->name);
        fbd_simulation_free(simulation);
        fbd_model_free(model);
    }
    fbd_model *model = model_from("fbd: 1\nbodies: {b: {mass: 1 kg, motion: slide}}\n"
                                  "simulate: {until: 1 s, method: auto}\n");
    fbd_model_free(model);
    const char none[] = "fbd: 1\nbodies: {b: {mass: 1 kg, motion: slide}}\n"
                        "simulate: {until: 1 s, method: rk45}\n";
    assert_null(fbd_model_parse(none, sizeof none - 1, "none.yaml", NULL, 0, NULL));
}

static void the_methods_are_listed_with_their_properties(void **unused)
{
    (void)unused;
    assert_true(fbd_method_count() >= method_count);
    for (size_t i = 0; i < fbd_method_count(); i++) {
        const fbd_method method = fbd_method_get(i), same = fbd_method_find(method.name);
        assert_true(method.order >= 1 && method.description[0]);
        assert_string_equal(same.name, method.name);
        assert_int_equal(method.multistep, strncmp(method.name, "ms", 2) == 0);
    }
    assert_true(fbd_method_find("rodas5p").implicit && !fbd_method_find("rk4").implicit);
    assert_int_equal(fbd_method_find("rk4").order, 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_swings_the_pendulum),
        cmocka_unit_test(every_method_moves_the_oscillator),
        cmocka_unit_test(every_method_is_blind_to_the_scale),
        cmocka_unit_test(an_unknown_method_is_refused_with_the_nearest_name),
        cmocka_unit_test(the_methods_are_listed_with_their_properties),
        cmocka_unit_test(a_file_may_name_every_method_and_no_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
