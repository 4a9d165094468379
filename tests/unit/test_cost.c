/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What fbd-cost says: its errors are true errors, its reference is as good as its floor says, its answers
 * keep what they promise. Times are not tested: machines are noisy.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fbd_study.h"
#include "fbd_view.h"
#include "gallery.h"
#include "study/reference.h"

enum { times = 241 }; /* of the grid, as documented */

#define SCENE(BODY, UNTIL) "fbd: 1\nbodies:\n  b: {" BODY "}\nsimulate: {until: " UNTIL "}\n"
#define OSCILLATOR         "mass: 1 kg, motion: slide, initial: {x: 2 m}, forces: [{spring: {stiffness: 9 N/m}}]"
#define PENDULUM           "mass: 1 kg, center: [0, -1 m], motion: pivot, initial: {theta: 2 rad}, forces: [gravity]"

static const char oscillator[] = SCENE(OSCILLATOR, "10 s");

struct study {
    fbd_model *model;
    fbd_errors *errors;
    fbd_cost *cost;
};

static struct study study(const char *text, fbd_cost_options options)
{
    struct study study = {.errors = fbd_errors_new()};
    assert_non_null(study.errors);
    study.model = fbd_model_parse(text, strlen(text), "scene", NULL, 0, study.errors);
    assert_non_null(study.model);
    study.cost = fbd_cost_new(study.model, &options, study.errors);
    return study;
}

static void end_study(struct study *study)
{
    fbd_cost_free(study->cost);
    fbd_model_free(study->model);
    fbd_errors_free(study->errors);
}

static fbd_cost_options some_methods(const char *const *names, size_t count)
{
    fbd_cost_options options = FBD_COST_OPTIONS_DEFAULT;
    options.methods = names;
    options.method_count = count;
    options.budget = 2; /* enough under valgrind; fast methods need little of it */
    return options;
}

#define METHODS(...)                                                                                         \
    some_methods((const char *const[]){__VA_ARGS__},                                                         \
                 sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))

/* ---- errors */

/* The same run again, held against x = 2 cos(3 t): its largest scaled error at the times of the grid. */
static double closed_form_error(const fbd_model *model, const fbd_point *point, double *end)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = point->method;
    options.tolerance = point->tolerance;
    options.step = point->step;
    fbd_errors *errors = fbd_errors_new();
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_state *state = fbd_state_new(model);
    double largest = 0, from, to, x = NAN, v = NAN;
    assert_non_null(simulation);
    for (int k = 0; k < times; k++) {
        double t = 10.0 * k / (times - 1);
        fbd_simulation_interval(simulation, &from, &to);
        while (to < t && fbd_simulation_advance(simulation) == FBD_GOING)
            fbd_simulation_interval(simulation, &from, &to);
        assert_true(fbd_simulation_state(simulation, t, state));
        fbd_state_get(state, "b.x", &x);
        fbd_state_get(state, "b.v", &v);
        /* On the grid x has its largest magnitude, 2, at t = 0; v does not hit 6 quite. */
        *end = fmax(fabs(x - 2 * cos(3 * t)) / 2, fabs(v + 6 * sin(3 * t)) / 6);
        largest = fmax(largest, *end);
    }
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_errors_free(errors);
    return largest;
}

static void errors_are_those_against_the_closed_form(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct study s = study(oscillator, METHODS("rk4", "dop853", "msbdf"));
    assert_non_null(s.cost);
    double floor = fbd_cost_reference(s.cost).floor;
    size_t looked = 0;
    for (size_t i = 0; i < fbd_cost_point_count(s.cost); i++) {
        const fbd_point point = fbd_cost_point(s.cost, i);
        if (point.state != FBD_POINT_MEASURED) continue;
        double end, error = closed_form_error(s.model, &point, &end);
        /* 1e-3: the size of v on the grid; the floor is what the reference is in doubt by. */
        check_close(&checks, point.method, point.error, error, 1e-3 * error + 2 * floor);
        check_close(&checks, "at the end", point.error_end, end, 1e-3 * end + 2 * floor);
        looked++;
    }
    check_that(&checks, "a dozen points were looked at", looked > 12);
    end_study(&s);
    checks_end(&checks);
}

static void pendulum_motion(double t, double *y)
{
    double k = sin(1.0), w = sqrt(9.81), K = gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE), sn, cn, dn;
    gsl_sf_elljac_e(fmod(K + w * t, 4 * K), k * k, &sn, &cn, &dn);
    y[0] = 2 * asin(k * sn);
    y[1] = 2 * k * w * cn;
}

static void oscillator_motion(double t, double *y)
{
    y[0] = 2 * cos(3 * t);
    y[1] = -6 * sin(3 * t);
}

/* From rest under quadratic drag: v = -vt tanh(g t/vt), x = -(vt^2/g) ln cosh(g t/vt), vt^2 = m g/c. */
static void fall_motion(double t, double *y)
{
    double vt = sqrt(2 * 9.81 / 0.1);
    y[0] = -vt * vt / 9.81 * log(cosh(9.81 * t / vt));
    y[1] = -vt * tanh(9.81 * t / vt);
}

static void a_reference_is_as_good_as_its_floor_says(void **unused)
{
    static const struct {
        const char *text;
        double until;
        void (*motion)(double t, double *y);
    } scenes[] = {
        {SCENE(PENDULUM, "20 s"), 20, pendulum_motion},
        {SCENE(OSCILLATOR, "10 s"), 10, oscillator_motion},
        {SCENE("mass: 2 kg, motion: {slide: {along: 90 deg}}, forces: [gravity, {drag: {quadratic: 0.1}}]",
               "10 s"),
         10, fall_motion},
    };
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct trial trial = trial_parse(scenes[i].text);
        struct arena arena = {0};
        struct certified_reference reference;
        fbd_errors *errors = fbd_errors_new();
        assert_true(reference_make(&reference, trial.model, scenes[i].until, NULL, 5, &arena, errors));
        double largest = 0;
        for (size_t k = 0; k < reference.track.reached; k++) {
            double known[2];
            scenes[i].motion(grid_time(&reference.grid, k), known);
            for (size_t q = 0; q < 2; q++)
                largest = fmax(largest, fabs(reference.track.y[2 * k + q] - known[q]) / reference.scale[q]);
        }
        /* Two runs may by chance err alike: ten times; 1e-14 is the rounding of the closed form. */
        check_that(&checks, "error of the reference", largest <= 10 * reference.floor + 1e-14);
        check_that(&checks, "the floor is low", reference.floor < 1e-11 && !reference.cut);
        arena_free(&arena);
        fbd_errors_free(errors);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void observed_orders_are_those_of_the_methods(void **unused)
{
    /* dop853 and rk8pd choose steps by their lower-order estimates; over few decades 8 comes out between 7
     * and 10 (the mean step is not the step that made the error). */
    static const struct {
        const char *method;
        double least, most;
    } orders[] = {{"rk2", 2.8, 3.2},
                  {"rk4", 3.8, 4.2},
                  {"rkf45", 4.7, 5.3},
                  {"rodas5p", 4.5, 5.5},
                  {"dop853", 7, 10.5}};
    struct checks checks = {0};
    (void)unused;
    fbd_cost_options options = METHODS("rk2", "rk4", "rkf45", "rodas5p", "dop853");
    options.budget = 5;
    struct study s = study(SCENE(PENDULUM, "5 s"), options);
    assert_non_null(s.cost);
    for (size_t i = 0; i < fbd_cost_series_count(s.cost); i++) {
        fbd_series series = fbd_cost_series(s.cost, i);
        for (size_t k = 0; k < sizeof orders / sizeof *orders; k++)
            if (strcmp(orders[k].method, series.method) == 0) {
                double middle = (orders[k].least + orders[k].most) / 2;
                check_close(&checks, series.method, series.order, middle, orders[k].most - middle);
            }
    }
    end_study(&s);
    checks_end(&checks);
}

/* ---- the front and the answers */

static void nothing_beats_the_front(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct study s = study(SCENE(PENDULUM, "5 s"), METHODS("auto", "rkf45", "rk8pd", "rk4"));
    assert_non_null(s.cost);
    double floor = fbd_cost_reference(s.cost).floor;
    size_t front = 0;
    for (size_t i = 0; i < fbd_cost_point_count(s.cost); i++) {
        const fbd_point a = fbd_cost_point(s.cost, i);
        if (a.state != FBD_POINT_MEASURED || a.error >= 1) continue;
        bool beaten = false;
        for (size_t k = 0; k < fbd_cost_point_count(s.cost); k++) {
            const fbd_point b = fbd_cost_point(s.cost, k);
            if (b.state == FBD_POINT_MEASURED && fmax(b.error, floor) < fmax(a.error, floor) &&
                b.seconds < a.seconds)
                beaten = true;
        }
        if (a.front) check_that(&checks, "a point of the front is not beaten", !beaten);
        front += a.front;
    }
    check_that(&checks, "there is a front", front > 1);
    end_study(&s);
    checks_end(&checks);
}

static void the_cheapest_point_keeps_its_promise(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct study s = study(SCENE(PENDULUM, "5 s"), METHODS("auto", "rkf45", "rk8pd"));
    assert_non_null(s.cost);
    for (int decade = 2; decade <= 10; decade++) {
        double target = pow(10, -decade);
        const fbd_point best = fbd_cost_cheapest(s.cost, target);
        assert_non_null(best.method);
        check_that(&checks, "the error is met", best.error <= target);
        for (size_t i = 0; i < fbd_cost_point_count(s.cost); i++) {
            const fbd_point other = fbd_cost_point(s.cost, i);
            bool same = other.state == FBD_POINT_MEASURED && strcmp(other.method, best.method) == 0;
            if (same && other.tolerance < best.tolerance)
                check_that(&checks, "and at all tighter settings", other.error <= target);
        }
    }
    check_that(&checks, "nothing reaches 0", !fbd_cost_cheapest(s.cost, 0).method);
    end_study(&s);
    checks_end(&checks);
}

/* ---- exact solutions */

static void the_files_solution_is_taken_when_it_is_one(void **unused)
{
    (void)unused;
    struct study s = study(SCENE(OSCILLATOR ", exact: {x: '2[m]*cos(3[rad/s]*t)'}", "10 s"), METHODS("auto"));
    assert_non_null(s.cost);
    fbd_reference reference = fbd_cost_reference(s.cost);
    assert_true(reference.exact && !reference.exact_differs && reference.complete);
    assert_true(reference.floor < 1e-13); /* 4 eps (|x| + |v| t) / scale: some 1e-14 */
    end_study(&s);
}

static void a_solution_that_is_none_is_said_and_not_used(void **unused)
{
    (void)unused;
    struct study s =
        study(SCENE(OSCILLATOR ", exact: {x: '2[m]*cos(3.0001[rad/s]*t)'}", "10 s"), METHODS("auto"));
    assert_non_null(s.cost);
    fbd_reference reference = fbd_cost_reference(s.cost);
    assert_true(reference.exact_differs && !reference.exact);
    assert_non_null(strstr(reference.says, "is not that of the scene"));
    const fbd_point tight = fbd_cost_point(s.cost, 7);
    assert_true(tight.error < 1e-8); /* measured against the runs: the wrong solution is off by 1e-3 */
    end_study(&s);
}

/* ---- scenes that are hard */

/* A driven pendulum, chaotic (Baker and Gollub, Chaotic Dynamics, chapter 3: q = 2, w = 2/3, g = 1.15). */
static const char chaotic[] =
    "fbd: 1\nbodies:\n  p: {mass: 1 kg, center: [0, -9.81 m], motion: pivot, initial: {theta: 0.2}, forces: "
    "[gravity], moments: [{damper: {coefficient: 48.11805}}, {applied: {value: "
    "'110.671515[N*m]*cos(2/3[rad/s]*t)'}}]}\nsimulate: {until: 600 s}\n";

static void a_chaotic_scene_is_recognised(void **unused)
{
    (void)unused;
    fbd_cost_options options = METHODS("dop853");
    options.budget = 20; /* of which it takes little, but under valgrind */
    struct study s = study(chaotic, options);
    assert_non_null(s.cost);
    fbd_reference reference = fbd_cost_reference(s.cost);
    assert_false(reference.complete);
    assert_true(reference.known > 20 && reference.known < 400);
    assert_true(reference.tenfold > 2 && reference.tenfold < 60);
    assert_non_null(strstr(reference.says, "chaotic"));
    assert_true(reference.floor <= 1e-6);
    end_study(&s);
}

static void a_method_that_fails_is_a_row_with_its_reason(void **unused)
{
    (void)unused;
    /* Explicit steps of more than 2.8/lambda = 0.3 ms blow up. */
    static const char stiff[] =
        SCENE("mass: 1 kg, motion: slide, initial: {x: 1}, forces: [{spring: {stiffness: "
              "1e6 N/m}}, {damper: {coefficient: 1e4 N*s/m}}]",
              "1 s");
    struct study s = study(stiff, METHODS("rk4"));
    assert_non_null(s.cost);
    size_t failed = 0;
    for (size_t i = 0; i < fbd_cost_point_count(s.cost); i++) {
        const fbd_point point = fbd_cost_point(s.cost, i);
        bool blown =
            point.state == FBD_POINT_FAILED || (point.state == FBD_POINT_MEASURED && !(point.error < 1e3));
        if (point.step >= 0.01) assert_true(blown);
        if (point.state == FBD_POINT_FAILED) assert_true(point.reason[0] && !point.front);
        failed += point.state == FBD_POINT_FAILED;
    }
    assert_true(failed > 0);
    end_study(&s);
}

static void what_does_not_fit_the_budget_is_skipped_and_said(void **unused)
{
    (void)unused;
    fbd_cost_options options = METHODS("rk1imp");
    options.budget = 1;
    struct study s = study(SCENE(PENDULUM, "20 s"), options);
    assert_non_null(s.cost);
    const fbd_point last = fbd_cost_point(s.cost, fbd_cost_point_count(s.cost) - 1);
    assert_int_equal(last.state, FBD_POINT_SKIPPED); /* order 1 at 1e-13 */
    assert_true(last.reason[0] != '\0');
    end_study(&s);
}

static void a_scene_where_nothing_moves_has_no_error(void **unused)
{
    (void)unused;
    struct study s = study(SCENE("mass: 1 kg, motion: slide", "1 s"), METHODS("auto"));
    assert_non_null(s.cost);
    assert_true(fbd_cost_point(s.cost, 0).error == 0);
    char *svg = fbd_cost_svg(s.cost), *text = fbd_cost_text(s.cost);
    assert_true(svg && text);
    free(svg);
    free(text);
    end_study(&s);
}

static void a_step_of_the_file_does_not_hide_the_tolerances(void **unused)
{
    (void)unused;
    struct study s = study(SCENE(PENDULUM, "5 s, step: 0.1"), METHODS("dop853"));
    assert_non_null(s.cost);
    const fbd_point loose = fbd_cost_point(s.cost, 0), tight = fbd_cost_point(s.cost, 8);
    assert_true(loose.error > 1e3 * tight.error);
    end_study(&s);
}

static void wrong_options_are_answered(void **unused)
{
    (void)unused;
    struct study s = study(oscillator, METHODS("rk99"));
    assert_null(s.cost);
    assert_string_equal(fbd_errors_get(s.errors, 0).id, "unknown-method");
    end_study(&s);
    fbd_cost_options options = METHODS("auto");
    options.quantities = (const char *const[]){"b.y"};
    options.quantity_count = 1;
    s = study(oscillator, options);
    assert_null(s.cost);
    assert_string_equal(fbd_errors_get(s.errors, 0).id, "unknown-quantity");
    end_study(&s);
}

#define EXACT                                                                                                \
    "mass: 1 kg, motion: slide, initial: {v: 1 m/s}, exact: {x: '1[m]*sin(1[rad/s]*t)'}, "                   \
    "forces: [spring: {stiffness: 1 N/m}]"

static void the_exact_solution_of_a_file_is_given_with_its_derivative(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse(SCENE(EXACT, "1 s, step: 0.1 s, method: rk4"));
    const double t = 0.5, values[][2] = {{sin(t), cos(t)}, {cos(t), -sin(t)}};
    double value, derivative;
    for (size_t i = 0; i < 2; i++) {
        assert_true(fbd_model_exact(trial.model, i, t, &value, &derivative));
        assert_float_equal(value, values[i][0], 1e-14);
        assert_float_equal(derivative, values[i][1], 1e-14);
    }
    fbd_options options;
    fbd_model_options(trial.model, &options, sizeof options);
    assert_true(options.until == 1 && options.step == 0.1 && options.tolerance == 0);
    assert_string_equal(options.method, "rk4");
    trial_close(&trial);
    trial = trial_parse(SCENE(PENDULUM, "1 s"));
    assert_false(fbd_model_exact(trial.model, 0, t, &value, &derivative));
    trial_close(&trial);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_are_those_against_the_closed_form),
        cmocka_unit_test(a_reference_is_as_good_as_its_floor_says),
        cmocka_unit_test(observed_orders_are_those_of_the_methods),
        cmocka_unit_test(nothing_beats_the_front),
        cmocka_unit_test(the_cheapest_point_keeps_its_promise),
        cmocka_unit_test(the_files_solution_is_taken_when_it_is_one),
        cmocka_unit_test(a_solution_that_is_none_is_said_and_not_used),
        cmocka_unit_test(a_chaotic_scene_is_recognised),
        cmocka_unit_test(a_method_that_fails_is_a_row_with_its_reason),
        cmocka_unit_test(what_does_not_fit_the_budget_is_skipped_and_said),
        cmocka_unit_test(a_scene_where_nothing_moves_has_no_error),
        cmocka_unit_test(a_step_of_the_file_does_not_hide_the_tolerances),
        cmocka_unit_test(the_exact_solution_of_a_file_is_given_with_its_derivative),
        cmocka_unit_test(wrong_options_are_answered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
