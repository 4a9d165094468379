/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Error bars: estimates against true errors, the same bits with and without, and events that only one of the
 * two runs has. `make error-bars` does the same for all models, methods and six tolerances.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "error_ratio.h"
#include "fbd_study.h"
#include "fbd_view.h"
#include "gallery.h"
#include "random_numbers.h"
#include "rows.h"
#include "scenes.h"
#include "thorough.h"

#include <stdlib.h>
#include <string.h>

/* ---- estimates against truth */

/* One of each kind: smooth, damped, with drag and a stop, sticking at once, stick-slip, a rotating body. */
static const char *const validated[] = {"rotation/simple_pendulum.yaml",   "vibration/damped_oscillator.yaml",
                                        "kinetics/falling_with_drag.yaml", "kinetics/incline.yaml",
                                        "hard/stick_slip_belt.yaml",       "plane/spring_pendulum.yaml"};

static void estimates_are_within_0_3_to_10_times_the_true_error_in_95_of_100_cases(void **unused)
{
    static const char *const methods[] = {"auto", "rodas5p", "rk8pd", "rkf45", "rk4", "msbdf"};
    static const double tolerances[] = {1e-4, 1e-7, 1e-10, 1e-12};
    (void)unused;
    struct ratio_table table = {.verbose = true};
    for (size_t i = 0; i < sizeof validated / sizeof *validated; i++) {
        struct trial trial = trial_open(validated[i], NULL);
        struct truth *truth = truth_new(trial.model, exact_motion_of(validated[i]));
        assert_non_null(truth);
        for (size_t m = 0; m < sizeof methods / sizeof *methods; m++)
            for (size_t k = 0; k < sizeof tolerances / sizeof *tolerances; k++)
                if (is_in_turn(i + m, k)) ratio_add(&table, truth, methods[m], tolerances[k], 0);
        truth_free(truth);
        trial_close(&trial);
    }
    if (!thorough()) return; /* too few to be counted */
    for (int k = 0; k < ratio_kinds; k++) {
        printf("# %s: %.1f %% of %lu determined cases, %.1f %% of all\n", ratio_names[k],
               100 * ratio_determined_share(&table.counts[k]), ratio_determined(&table.counts[k]),
               100 * ratio_share(&table.counts[k]));
        assert_true(ratio_determined(&table.counts[k]) >= 40);
        assert_true(ratio_determined_share(&table.counts[k]) >= 0.95);
        assert_true(ratio_share(&table.counts[k]) >= 0.95);
    }
}

/* Steps of a fixed size have no tolerance that could be made smaller. */
static void fixed_steps_have_error_bars_too(void **unused)
{
    static const double steps[] = {0.04, 0.01, 0.0025};
    (void)unused;
    struct ratio_table table = {.verbose = true};
    struct trial trial = trial_open("vibration/damped_oscillator.yaml", NULL);
    struct truth *truth = truth_new(trial.model, exact_motion_of("vibration/damped_oscillator.yaml"));
    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
        assert_true(ratio_add(&table, truth, "rk4", 0, steps[k]));
        assert_true(ratio_add(&table, truth, "rk2", 0, steps[k]));
    }
    assert_int_equal(table.counts[ratio_global].good, 6);
    truth_free(truth);
    trial_close(&trial);
}

/* Those of a scene by `auto`. */
static void add_ratios(struct ratio_table *table, const char *text, const double *tolerances, size_t count)
{
    struct trial trial = trial_parse(text);
    struct truth *truth = truth_new(trial.model, NULL);
    assert_non_null(truth);
    for (size_t k = 0; k < count; k++) assert_true(ratio_add(table, truth, "auto", tolerances[k], 0));
    truth_free(truth);
    trial_close(&trial);
}

/* ---- runs of few steps */

static const char pendulum[] =
    "bodies: {a: {mass: %.3f, inertia: %.3f, motion: {pivot: {point: [%.3f, %.3f]}},\n"
    "  initial: {theta: %.3f, omega: %.3f}, forces: [gravity]}}\n";
static const char on_a_spring[] =
    "bodies: {a: {mass: %.3f, motion: particle, initial: {x: 1, y: %.3f, vx: %.3f, vy: %.3f}, forces:\n"
    "  [gravity, drag: {quadratic: %.3f}, spring: {stiffness: %.3f, to: [0, 1], free_length: 0.5}]}}\n";
static const char two_pendulums[] =
    "bodies:\n  a: {mass: 1, inertia: %.3f, motion: {pivot: {point: [0, 0.5]}}, initial: {theta: %.3f}, "
    "forces: "
    "[gravity]}\n  b: {mass: %.3f, inertia: %.3f, motion: {pivot: {on: a, at: [0, -0.5], point: [0, 0.5]}},\n"
    "    initial: {theta: %.3f, omega: %.3f}, forces: [gravity]}\n";

/* Which of them, and the limits of its numbers. */
static const struct {
    const char *text;
    double low[6], high[6];
} short_scenes[] = {
    {pendulum, {0.5, 0.1, -1, -1, -3, -2}, {3, 1, 1, 1, 3, 2}},
    {on_a_spring, {0.5, -1, -2, -2, 0, 1}, {3, 1, 2, 2, 0.3, 20}},
    {two_pendulums, {0.1, -2, 0.5, 0.1, -2, -2}, {1, 2, 3, 1, 2, 2}},
};

/* The first step of a run is a guess and the last one is what is left: with two or three of them a companion that chose
 * its steps alike had the same errors, and told a tenth of them. */
static void short_runs_have_error_bars_too(void **unused)
{
    static const double tolerances[] = {1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13};
    enum { kinds = sizeof short_scenes / sizeof *short_scenes };
    const int scenes = draws_of(60);
    (void)unused;
    struct random_numbers numbers = {5};
    struct ratio_table table = {0};
    for (int scene = 0; scene < scenes; scene++) {
        char text[1024], body[800];
        double x[6], until = random_between(&numbers, 0.2, 2.5);
        for (int i = 0; i < 6; i++)
            x[i] = random_between(&numbers, short_scenes[scene % kinds].low[i],
                                  short_scenes[scene % kinds].high[i]);
        snprintf(body, sizeof body, short_scenes[scene % kinds].text, x[0], x[1], x[2], x[3], x[4], x[5]);
        snprintf(text, sizeof text, "fbd: 1\n%ssimulate: {until: %.3f}\n", body, until);
        add_ratios(&table, text, tolerances, sizeof tolerances / sizeof *tolerances);
    }
    for (int k = 0; k < ratio_kinds; k++)
        printf("# short runs, %s: %.1f %% of %lu determined cases\n", ratio_names[k],
               100 * ratio_determined_share(&table.counts[k]), ratio_determined(&table.counts[k]));
    if (!thorough()) return;
    assert_true(ratio_determined(&table.counts[ratio_global]) >= 250);
    assert_true(ratio_determined_share(&table.counts[ratio_global]) >= 0.985);
    assert_true(ratio_determined_share(&table.counts[ratio_end]) >= 0.96);
}

/* ---- errors between two samples */

/* A block that rests most of the time, and slips for less than what lies between two looks into a long step of rest. */
static const char slips[] =
    "fbd: 1\ngravity: 9.81\nbodies: {a: {mass: 1, motion: slide, forces: [gravity, normal, friction: %.3f,\n"
    "  {applied: {name: pull, value: \"%.4f[N]*sin(%.3f[rad/s]*t)\"}}]}}\nsimulate: {until: %.3f}\n";

static void errors_between_two_samples_are_seen(void **unused)
{
    static const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10};
    const int scenes = draws_of(80);
    (void)unused;
    struct random_numbers numbers = {11};
    struct ratio_table table = {.verbose = true};
    for (int scene = 0; scene < scenes; scene++) {
        char text[1024];
        double mu = random_between(&numbers, 0.2, 0.8), over = random_between(&numbers, 1.005, 1.025);
        double rate = random_between(&numbers, 1, 5), until = random_between(&numbers, 4, 16);
        snprintf(text, sizeof text, slips, mu, mu * 9.81 * over, rate, until);
        add_ratios(&table, text, tolerances, sizeof tolerances / sizeof *tolerances);
    }
    const struct ratio_counts *global = &table.counts[ratio_global];
    printf("# between samples, global error: %lu low, %lu good, %lu high\n", global->low, global->good,
           global->high);
    if (!thorough()) return;
    assert_true(ratio_determined(global) >= 120);
    assert_true(ratio_determined_share(global) >= 0.95);
}

/* ---- the first run is left alone */

/* Take out every column whose name has a plus-minus sign. */
static void drop_bars(char *text)
{
    static const char sign[] = "±";
    enum { most_columns = 2000 };
    bool bar[most_columns] = {false}, first = true;
    char *to = text;
    for (char *from = text; *from;) {
        size_t column = 0;
        for (bool more = true; more; column++) {
            size_t width = strcspn(from, ",\n");
            assert_true(column < most_columns);
            const char *found = first ? strstr(from, sign) : NULL;
            if (found && found < from + width) bar[column] = true;
            more = from[width] == ',';
            if (!bar[column]) {
                if (column > 0) *to++ = ',';
                memmove(to, from, width);
                to += width;
            }
            from += width + 1;
        }
        *to++ = '\n';
        first = false;
    }
    *to = '\0';
}

static struct rows record_rows(const fbd_model *model, bool error_bars, bool ledger)
{
    struct rows rows = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.error_bars = error_bars;
    fbd_errors *errors = fbd_errors_new();
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    const fbd_recording recording = {.ledger = ledger, .csv = append, .csv_context = &rows};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    assert_non_null(result);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_errors_free(errors);
    return rows;
}

static void check_same_rows(const fbd_model *model)
{
    for (int ledger = 0; ledger < 2; ledger++) {
        struct rows plain = record_rows(model, false, ledger), bars = record_rows(model, true, ledger);
        assert_non_null(strstr(bars.text, "±"));
        drop_bars(bars.text);
        assert_string_equal(plain.text, bars.text);
        free(plain.text);
        free(bars.text);
    }
}

static void every_bit_of_the_motion_is_the_same_with_error_bars_and_without(void **unused)
{
    static const char *const paths[] = {"hard/stick_slip_belt.yaml", "hard/coupled_friction.yaml",
                                        "hard/stiff_springs.yaml", "plane/projectile_with_drag.yaml"};
    (void)unused;
    for (size_t i = 0; i < all_scenes_count; i++) {
        fbd_model *model = model_from(all_scenes[i].text);
        check_same_rows(model);
        fbd_model_free(model);
    }
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        struct trial trial = trial_open(paths[i], NULL);
        check_same_rows(trial.model);
        trial_close(&trial);
    }
}

/* The estimate belongs to the run, not to what is written of it. */
static void the_estimate_is_the_same_whatever_is_written(void **unused)
{
    (void)unused;
    double estimates[3];
    for (int i = 0; i < 3; i++) {
        struct rows rows = {0};
        fbd_options options = FBD_OPTIONS_DEFAULT;
        options.error_bars = true;
        fbd_recording recording = {.every = i == 1 ? 0.011 : 0, .ledger = i == 2, .csv_context = &rows};
        if (i > 0) recording.csv = append;
        struct trial trial = trial_open("hard/stick_slip_belt.yaml", NULL);
        trial_start(&trial, &options);
        trial.result = fbd_simulation_run(trial.simulation, &recording);
        assert_non_null(trial.result);
        estimates[i] = fbd_simulation_stats(trial.simulation).error_estimate;
        trial_close(&trial);
        free(rows.text);
    }
    assert_true(estimates[0] > 0 && estimates[0] == estimates[1] && estimates[0] == estimates[2]);
}

/* ---- events */

/* A method of low order loses energy, so that it meets a threshold that the better run never comes to. */
static void an_event_that_only_one_run_has_is_not_known(void **unused)
{
    (void)unused;
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "bodies:\n"
                    "  p: {mass: 1 kg, center: [0, -1 m], motion: pivot,\n"
                    "      initial: {theta: 1 rad}, forces: [gravity]}\n"
                    "simulate:\n"
                    "  until: 30 s\n"
                    "  events:\n"
                    "    - {name: lost, when: 'omega^2/2 - 9.81[1/s^2]*cos(theta) < -5.301[1/s^2]'}\n"
                    "    - {name: low, when: theta = 0}\n");
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.error_bars = true;
    options.method = "rk2";
    options.step = 0.02;
    trial_run(&trial, &options);
    size_t lost = 0, low = 0;
    for (size_t i = 0; i < fbd_simulation_event_count(trial.simulation); i++) {
        fbd_event event = fbd_simulation_event(trial.simulation, i);
        bool is_lost = strcmp(event.name, "lost") == 0;
        if (is_lost) assert_true(isinf(event.t_error));
        if (!is_lost) assert_true(event.t_error > 0 && event.t_error < 1);
        lost += is_lost;
        low += !is_lost;
    }
    assert_true(lost > 0 && low > 20);
    trial_close(&trial);
}

/* The companion may stop before the run or after it; the end has error bars in both cases. x(t) = 30 - 16.1
 * t^2 stops at x = 10; with drag the time is not exact. */
static void a_run_that_an_event_stops_has_error_bars_at_its_end(void **unused)
{
    static const char *const methods[] = {"auto", "rkf45", "rk4", "msadams", "msbdf", "rodas5p"};
    (void)unused;
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        struct trial trial = trial_open("kinetics/falling_with_drag.yaml", NULL);
        fbd_options options = FBD_OPTIONS_DEFAULT;
        options.error_bars = true;
        options.tolerance = 1e-8;
        options.method = methods[i];
        trial_run(&trial, &options);
        double y[2], t = trial_event(&trial, FBD_EVENT_USER, "ground", 0);
        exact_motion_of("kinetics/falling_with_drag.yaml")(t, y);
        double x, v;
        fbd_state_get(fbd_result_state(trial.result), "ball.x", &x);
        fbd_state_get(fbd_result_state(trial.result), "ball.v", &v);
        double error = fabs(v - y[1]), x_error = fabs(x - y[0]);
        double bar = fbd_result_error(trial.result, "ball.v"),
               x_bar = fbd_result_error(trial.result, "ball.x");
        check_that(&checks, methods[i], bar >= 0.3 * error - 1e-14 && bar <= 10 * error + 1e-13);
        check_that(&checks, methods[i], x_bar >= 0.3 * x_error - 1e-14 && x_bar <= 10 * x_error + 1e-13);
        double true_t = acosh(exp(100 * 9.81 / (0.4 * 9.81 / 0.01))) * sqrt(0.4 * 9.81 / 0.01) / 9.81;
        printf("# %s: v off by %.2g, bar %.2g; x by %.2g, bar %.2g\n", methods[i], error, bar, x_error,
               x_bar);
        double t_error = fbd_simulation_event(trial.simulation, 0).t_error, off = fabs(t - true_t);
        check_that(&checks, "its time", t_error >= 0.3 * off - 1e-14 && t_error <= 10 * off + 1e-13);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- step by step */

static void who_advances_by_hand_sees_the_errors_within_each_step(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("vibration/damped_oscillator.yaml", NULL);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.error_bars = true;
    options.tolerance = 1e-6;
    options.method = "rkf45";
    trial_start(&trial, &options);
    double from, to, errors[2], exact[2], worst = 0, estimated = 0;
    while (fbd_simulation_advance(trial.simulation) == FBD_GOING) {
        fbd_simulation_interval(trial.simulation, &from, &to);
        const double times[] = {from + 0.3 * (to - from), from + 0.8 * (to - from), to};
        for (int k = 0; k < 3; k++) {
            assert_true(fbd_simulation_state(trial.simulation, times[k], trial.state));
            assert_true(fbd_simulation_errors(trial.simulation, times[k], errors));
            exact_motion_of("vibration/damped_oscillator.yaml")(times[k], exact);
            worst = fmax(worst, fabs(trial_get(&trial, "x") - exact[0]));
            estimated = fmax(estimated, errors[0]);
        }
        assert_false(fbd_simulation_errors(trial.simulation, to + 1, errors));
    }
    check_close(&checks, "largest error", estimated, worst, 0.2 * worst);
    check_that(&checks, "there is one", worst > 1e-7);
    trial_close(&trial);
    checks_end(&checks);
}

/* What is the file's own has errors behind those of coordinates and rates. */
static void states_of_the_file_have_errors_too(void **unused)
{
    (void)unused;
    struct trial trial = trial_open("control/dc_motor.yaml", NULL);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.error_bars = true;
    trial_start(&trial, &options);
    size_t first = 2 * fbd_model_coordinate_count(trial.model),
           count = first + fbd_model_state_count(trial.model);
    double from, to, errors[16], worst = 0;
    assert_true(count > first && count < 16);
    while (fbd_simulation_advance(trial.simulation) == FBD_GOING) {
        errors[first] = -1;
        errors[count] = -1;
        fbd_simulation_interval(trial.simulation, &from, &to);
        assert_true(fbd_simulation_errors(trial.simulation, to, errors));
        assert_true(errors[first] >= 0 && errors[count] == -1);
        worst = fmax(worst, errors[first]);
    }
    assert_true(worst > 0);
    trial_close(&trial);
}

static void without_error_bars_there_are_none(void **unused)
{
    (void)unused;
    struct trial trial = trial_open("kinetics/incline.yaml", NULL);
    double errors[2];
    fbd_arrow arrow;
    trial_run(&trial, NULL);
    assert_true(isnan(fbd_simulation_stats(trial.simulation).error_estimate));
    assert_true(isnan(fbd_simulation_event(trial.simulation, 0).t_error));
    assert_true(isnan(fbd_result_error(trial.result, "block.x")));
    assert_true(isnan(fbd_result_work_error(trial.result, "block", "push")));
    assert_true(isnan(fbd_result_energy_error(trial.result).kinetic));
    assert_int_equal(fbd_result_force_errors(trial.result, 0, &arrow, 1), 0);
    assert_false(fbd_simulation_errors(trial.simulation, 3, errors));
    assert_true(fbd_result_accurate(trial.result));
    trial_close(&trial);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(estimates_are_within_0_3_to_10_times_the_true_error_in_95_of_100_cases),
        cmocka_unit_test(fixed_steps_have_error_bars_too),
        cmocka_unit_test(short_runs_have_error_bars_too),
        cmocka_unit_test(errors_between_two_samples_are_seen),
        cmocka_unit_test(every_bit_of_the_motion_is_the_same_with_error_bars_and_without),
        cmocka_unit_test(the_estimate_is_the_same_whatever_is_written),
        cmocka_unit_test(an_event_that_only_one_run_has_is_not_known),
        cmocka_unit_test(a_run_that_an_event_stops_has_error_bars_at_its_end),
        cmocka_unit_test(who_advances_by_hand_sees_the_errors_within_each_step),
        cmocka_unit_test(states_of_the_file_have_errors_too),
        cmocka_unit_test(without_error_bars_there_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
