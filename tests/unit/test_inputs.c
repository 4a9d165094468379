/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Inputs of a file, and motions that go on from a state: what a simulation of its own says of the whole, and closed
 * forms of what is pushed differently on the way.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_study.h"
#include "fbd_view.h"
#include "gallery.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_numbers = 400 };

/* ---- what a file has */

static void a_model_lists_parameters_then_inputs(void **unused)
{
    (void)unused;
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "inputs: {F: {value: 2 kN, description: push}, n: 3}\n"
                    "parameters: {w: m*g, m: {value: 3 kg, range: [1, 5000 g], description: load}}\n"
                    "bodies: {b: {mass: m, motion: slide, forces: [applied: {value: n*F - w}]}}\n"
                    "simulate: {until: 1 s}\n");
    static const fbd_parameter want[] = {
        {"w", "N", "", 3 * 9.81, false, true, NAN, NAN},
        {"m", "kg", "load", 3, false, false, 1, 5},
        {"F", "N", "push", 2000, true, false, NAN, NAN},
        {"n", "", "", 3, true, false, NAN, NAN},
    };
    assert_int_equal(fbd_model_parameter_count(trial.model), 4);
    for (size_t i = 0; i < 4; i++) {
        fbd_parameter got = fbd_model_parameter(trial.model, i);
        assert_string_equal(got.name, want[i].name);
        assert_string_equal(got.unit, want[i].unit);
        assert_string_equal(got.description, want[i].description);
        assert_true(fabs(got.value - want[i].value) < 1e-12 * want[i].value);
        assert_true(isnan(want[i].low) ? isnan(got.low) && isnan(got.high)
                                       : got.low == want[i].low && got.high == want[i].high);
        assert_int_equal(got.input, want[i].input);
        assert_int_equal(got.derived, want[i].derived);
    }
    assert_null(fbd_model_parameter(trial.model, 4).name);
    trial_close(&trial);
}

/* ---- pushed differently on the way */

/* x'' = (F - k x - c v)/m for `h`, from (x, v). */
static void swing(double F, double h, double *x, double *v)
{
    const double m = 2, k = 50, c = 3, decay = c / (2 * m), w = sqrt(k / m - decay * decay);
    double A = *x - F / k, B = (*v + decay * A) / w, e = exp(-decay * h);
    *x = F / k + e * (A * cos(w * h) + B * sin(w * h));
    *v = e * ((w * B - decay * A) * cos(w * h) - (w * A + decay * B) * sin(w * h));
}

/* The trial of the same file under another push, at the state that `trial` has come to, which it takes the place of. */
static void push(struct trial *trial, double F)
{
    char setting[60];
    double numbers[most_numbers];
    size_t count = fbd_state_pack(trial->state, numbers, most_numbers);
    snprintf(setting, sizeof setting, "push=%.17g", F);
    struct trial next = trial_open("forcing/pushed_oscillator.yaml", SET(setting));
    assert_true(fbd_state_unpack(next.state, numbers, count));
    trial_close(trial);
    *trial = next;
    trial->simulation = fbd_simulation_from(trial->state, NULL, NULL);
    assert_non_null(trial->simulation);
    trial->outcome = FBD_GOING;
}

static void a_push_may_change_on_the_way(void **unused)
{
    (void)unused;
    static const struct {
        double t, F;
    } pushes[] = {{0.7, -20}, {0.9, 3}, {2.5, 40}, {2.50001, 0}, {4, 0}};
    struct checks checks = {0};
    struct trial trial = trial_open("forcing/pushed_oscillator.yaml", NULL);
    double t = 0, F = 5, x = 0, v = 0;
    trial_start(&trial, NULL);
    for (size_t i = 0; i < sizeof pushes / sizeof *pushes; i++) {
        trial_to(&trial, pushes[i].t);
        swing(F, pushes[i].t - t, &x, &v);
        check_close(&checks, "x", trial_get(&trial, "block.x"), x, 1e-12);
        check_close(&checks, "v", trial_get(&trial, "block.v"), v, 1e-11);
        t = pushes[i].t;
        push(&trial, F = pushes[i].F);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- the state as numbers */

static const char *const texts[] = {
    /* a memory */
    "fbd: 1\nbodies: {b: {mass: 1 kg, motion: slide, initial: {v: 1 m/s}, forces: [applied: {value: "
    "\"-4[N]*hysteresis(v, "
    "-0.5[m/s], 0.4[m/s])\"}]}}\nsimulate: {until: 3 s}\n",
    /* a rope as long as it is at the start */
    "fbd: 1\nground: {points: {P: [0, 2 m]}}\nbodies:\n  a: {mass: 2 kg, motion: {slide: {along: 90 deg}}, "
    "initial: {x: "
    "-1 m}, forces: [gravity]}\n  b: {mass: 3 kg, motion: {slide: {along: 90 deg, through: [1 m, 0]}}, "
    "initial: {x: 0.2 m}, "
    "forces: [gravity]}\ncouplings: [rope: {name: r, through: [a.G, ground.P, b.G]}]\nsimulate: {until: 0.5 "
    "s}\n",
    /* friction that sticks */
    "fbd: 1\nbodies: {b: {mass: 1 kg, motion: slide, initial: {v: 1 m/s}, forces: [gravity, normal, "
    "friction: {static: "
    "0.5, kinetic: 0.4}, applied: {value: \"5[N]*sin(3*t)\"}]}}\nsimulate: {until: 3 s}\n",
};

enum { text_count = sizeof texts / sizeof *texts };

static void check_numbers(struct checks *checks, const char *what, const fbd_state *got,
                          const fbd_state *want)
{
    double a[most_numbers], b[most_numbers];
    size_t count = fbd_state_pack(want, b, most_numbers);
    check_that(checks, "as many numbers",
               fbd_state_pack(got, a, most_numbers) == count && count <= most_numbers);
    for (size_t i = 0; i < count; i++) check_close(checks, what, a[i], b[i], 1e-7 * (1 + fabs(b[i])));
}

/* Half way, then on by a simulation of its own, ends where one that goes all the way does. */
static void check_halves(struct checks *checks, struct trial *whole, struct trial *half, double until)
{
    trial_start(whole, NULL);
    trial_finish(whole);
    trial_start(half, NULL);
    trial_to(half, 0.4 * until);
    fbd_simulation_free(half->simulation);
    half->simulation = fbd_simulation_from(half->state, NULL, NULL);
    check_that(checks, "goes on", half->simulation != NULL);
    half->outcome = FBD_GOING;
    if (!half->simulation) return;
    trial_finish(half);
    check_numbers(checks, "the end", half->state, whole->state);
}

static void a_motion_goes_on_from_a_state(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const double until[text_count] = {3, 0.5, 3};
    for (int i = 0; i < text_count; i++) {
        struct trial whole = trial_parse(texts[i]), half = trial_parse(texts[i]);
        check_halves(&checks, &whole, &half, until[i]);
        if (checks.failed) print_message("# %s\n", texts[i]);
        trial_close(&whole);
        trial_close(&half);
    }
    checks_end(&checks);
}

static void models_of_the_gallery_go_on_from_a_state(void **unused)
{
    (void)unused;
    static const struct {
        const char *path;
        double until;
    } runs[] = {
        {"couplings/slider_crank.yaml", 1},
        {"couplings/block_over_pulley.yaml", 1},
        {"couplings/four_bar.yaml", 1},
        {"couplings/rolling_on_incline.yaml", 0.5},
        {"trees/double_pendulum.yaml", 2},
        {"kinetics/incline.yaml", 1},
        {"rotation/damped_pendulum.yaml", 2},
        {"forcing/square_wave_with_friction.yaml", 3},
        {"couplings/rope_pendulum.yaml", 1},
        {"couplings/eccentric_wheel.yaml", 1},
        {"energy/cubic_spring_potential.yaml", 1},
    };
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        fbd_options options = FBD_OPTIONS_DEFAULT;
        struct trial whole = trial_open(runs[i].path, NULL), half = trial_open(runs[i].path, NULL);
        options.until = runs[i].until;
        trial_start(&whole, &options);
        trial_finish(&whole);
        trial_start(&half, &options);
        trial_to(&half, 0.4 * runs[i].until);
        fbd_simulation_free(half.simulation);
        half.simulation = fbd_simulation_from(half.state, &options, NULL);
        half.outcome = FBD_GOING;
        if (check_that(&checks, "goes on", half.simulation != NULL)) {
            trial_finish(&half);
            check_numbers(&checks, runs[i].path, half.state, whole.state);
        }
        trial_close(&whole);
        trial_close(&half);
    }
    checks_end(&checks);
}

static void numbers_go_round(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int i = 0; i < text_count; i++) {
        struct trial trial = trial_parse(texts[i]), other = trial_parse(texts[i]);
        double numbers[most_numbers], again[most_numbers];
        trial_start(&trial, NULL);
        trial_to(&trial, 0.3);
        size_t count = fbd_state_pack(trial.state, NULL, 0);
        assert_true(count > 0 && count <= most_numbers);
        assert_int_equal(fbd_state_pack(trial.state, numbers, most_numbers), count);
        assert_true(fbd_state_unpack(other.state, numbers, count));
        assert_int_equal(fbd_state_pack(other.state, again, most_numbers), count);
        assert_memory_equal(numbers, again, count * sizeof *numbers);
        assert_false(fbd_state_unpack(other.state, numbers, count - 1));
        assert_false(fbd_state_unpack(other.state, numbers, count + 1));
        for (size_t k = 0; k < count; k++) {
            double kept = numbers[k];
            numbers[k] = NAN;
            assert_false(fbd_state_unpack(other.state, numbers, count));
            numbers[k] = kept;
        }
        assert_int_equal(fbd_state_pack(other.state, again, most_numbers), count);
        assert_memory_equal(numbers, again, count * sizeof *numbers);
        assert_true(fbd_state_copy(other.state, other.state));
        trial_close(&trial);
        trial_close(&other);
    }
    checks_end(&checks);
}

static void a_memory_is_one_or_the_other(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse(texts[0]);
    double numbers[most_numbers];
    size_t count = fbd_state_pack(trial.state, numbers, most_numbers);
    assert_int_equal(count, 4);
    numbers[3] = -numbers[3];
    assert_true(fbd_state_unpack(trial.state, numbers, count));
    numbers[3] = 0.5;
    assert_false(fbd_state_unpack(trial.state, numbers, count));
    trial_close(&trial);
}

/* ---- and once more */

static void a_run_from_a_state_may_be_gone_through_again(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(texts[1]);
    trial_start(&trial, NULL);
    trial_to(&trial, 0.2);
    fbd_simulation *from = fbd_simulation_from(trial.state, NULL, NULL);
    fbd_errors *errors = fbd_errors_new();
    assert_null(fbd_simulation_again(from, true, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, "bad-option");
    fbd_errors_free(errors);
    fbd_simulation *again = fbd_simulation_again(from, false, NULL);
    assert_non_null(again);
    fbd_simulation_free(from);
    fbd_simulation_free(trial.simulation);
    trial.simulation = again;
    trial.outcome = FBD_GOING;
    double a, b;
    fbd_simulation_interval(again, &a, &b);
    assert_true(a == 0.2 && b == 0.2);
    trial_finish(&trial);
    struct trial whole = trial_parse(texts[1]);
    trial_start(&whole, NULL);
    trial_finish(&whole);
    check_numbers(&checks, "the end", trial.state, whole.state);
    trial_close(&trial);
    trial_close(&whole);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_model_lists_parameters_then_inputs),
        cmocka_unit_test(a_push_may_change_on_the_way),
        cmocka_unit_test(a_motion_goes_on_from_a_state),
        cmocka_unit_test(models_of_the_gallery_go_on_from_a_state),
        cmocka_unit_test(numbers_go_round),
        cmocka_unit_test(a_memory_is_one_or_the_other),
        cmocka_unit_test(a_run_from_a_state_may_be_gone_through_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
