/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sliding on switches: closed forms, and friction written by sign(v) against friction.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "dynamics/modes.h"
#include "gallery.h"
#include "random_numbers.h"
#include "scenes.h"
#include "thorough.h"
#include "waves.h"

#include <stdlib.h>
#include <string.h>

static const char *const methods[] = {NULL,    "dop853", "rkf45",  "rk8pd", "rodas5p",
                                      "msbdf", "bsimp",  "rk4imp", "rk4",   "msadams"};

enum { method_count = sizeof methods / sizeof *methods };

static void run_with(struct trial *trial, const char *method, double tolerance)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = method;
    options.tolerance = tolerance;
    trial_start(trial, &options);
    trial_finish(trial);
    if (fbd_simulation_reason(trial->simulation)[0])
        print_message("# %s at %g: %s\n", method ? method : "auto", tolerance,
                      fbd_simulation_reason(trial->simulation));
}

/* ---- a sliding mode
 *
 * x'' = -f sign(x + c v) from (1, 0), f = 2, c = 1/2. First x = 1 - t^2 until t^2 + t = 1; there |v| > f c,
 * so that it is passed. From there with +f until s^2 + (v_1 + 2 c f/2) s = 0 again, s = -(v_1 + f c); now |v|
 * < f c, and x = -c v from there on: both decay with exp(-t/c). */

static const char sliding_mode[] =
    "fbd: 1\nparameters: {F: 4, c: 0.5}\nbodies:\n  cart:\n    mass: 2\n    motion: slide\n"
    "    initial: {x: 1}\n    forces: [applied: {name: relay, value: \"-F*sign(x + c*v)\"}]\n"
    "simulate: {until: 6 s}\n";

static void a_sliding_mode_decays_on_its_surface(void **unused)
{
    (void)unused;
    static const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
    struct checks checks = {0};
    double first = (sqrt(5) - 1) / 2, v1 = -2 * first, s = -(v1 + 1), entry = first + s;
    double x = 1 - first * first + v1 * s + s * s;
    for (int m = 0; m < method_count; m++)
        for (int k = 0; k < 5; k++) {
            double tolerance = m == 0 ? tolerances[k] : tolerances[2];
            if (m > 0 && k > 0) break;
            struct trial trial = trial_parse(sliding_mode);
            run_with(&trial, methods[m], tolerance);
            /* Steps of 1e-8 of sizes 1 add up over some ten of them; a multistep method is off by more. */
            double room = fmax(1e-13, 100 * tolerance);
            check_close(&checks, "passed", trial_event(&trial, FBD_EVENT_SWITCH, "relay", 0), first, room);
            check_close(&checks, "slides", trial_event(&trial, FBD_EVENT_SLIDING, "relay", 0), entry, room);
            check_that(&checks, "two events", fbd_simulation_event_count(trial.simulation) == 2);
            double end = x * exp(-(6 - entry) / 0.5);
            check_close(&checks, "x", trial_get(&trial, "x"), end, room * 0.01);
            check_close(&checks, "x = -c v", trial_get(&trial, "x") + 0.5 * trial_get(&trial, "v"), 0, 1e-16);
            trial_close(&trial);
        }
    checks_end(&checks);
}

/* ---- friction by sign(v) is friction */

/* A block under a spring, a wave and rubbing of size R on a belt: once declared with mu N = R, once a share of it
 * written. What is both is written in up to two parts. */
static void write_pair(struct random_numbers *numbers, bool both, char *written, char *declared, size_t size)
{
    double R = random_between(numbers, 0.5, 3), k = random_between(numbers, 0, 20),
           P = random_between(numbers, 0, 5), w = random_between(numbers, 0.5, 6),
           phase = random_between(numbers, 0, 6.28), v = random_between(numbers, -2, 2);
    double by_sign = both ? random_between(numbers, 0, R) : R,
           second = both ? by_sign * fmax(0, random_between(numbers, -1, 1)) : 0,
           belt = both ? fmax(0, random_between(numbers, -1, 1)) : 0;
    static const char scene[] =
        "fbd: 1\ngravity: 1\nbodies:\n  block:\n    mass: 1\n    motion: slide\n    initial: {v: %.17g}\n"
        "    forces:\n      - spring: {stiffness: %.17g}\n      - gravity\n      - normal\n"
        "      - applied: {name: wave, value: \"%.17g*sin(%.17g*t + %.17g)\"}\n%s"
        "simulate: {until: 10 s}\n";
    static const char dry[] = "      - friction: {coefficient: %.17g, surface_speed: %.17g}\n";
    char rub[400];
    int length =
        snprintf(rub, sizeof rub, "      - applied: {name: rub, value: \"-%.17g*sign(v - %.17g)\"}\n",
                 by_sign - second, belt);
    if (second > 0)
        length +=
            snprintf(rub + length, sizeof rub - (size_t)length,
                     "      - applied: {name: rub_2, value: \"%.17g*sign(%.17g - v)\"}\n", second, belt);
    if (both) snprintf(rub + length, sizeof rub - (size_t)length, dry, R - by_sign, belt);
    snprintf(written, size, scene, v, k, P, w, phase, rub);
    snprintf(rub, sizeof rub, dry, R, belt);
    snprintf(declared, size, scene, v, k, P, w, phase, rub);
}

static void friction_by_sign_is_friction(void **unused)
{
    (void)unused;
    enum { seed = 1785 };
    const char *given = getenv("FBD_RUBBING");
    int draws = given ? atoi(given) : draws_of(16);
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws; draw++) {
        char written[1200], declared[1200];
        bool both = draw % 4 > 1; /* friction, and rubbing that is written */
        write_pair(&numbers, both, written, declared, sizeof written);
        struct trial one = trial_parse(written), two = trial_parse(declared);
        const double tolerance = draw % 2 ? 1e-8 : 1e-10;
        run_with(&one, methods[draw % method_count], tolerance);
        run_with(&two, NULL, 1e-12);
        check_that(&checks, "it gets to the end", trial_get(&one, "t") == 10 && trial_get(&two, "t") == 10);
        /* Each of some twenty events hands an error on; they do not grow. */
        check_close(&checks, "x", trial_get(&one, "x"), trial_get(&two, "x"), 3000 * tolerance);
        check_close(&checks, "v", trial_get(&one, "v"), trial_get(&two, "v"), 3000 * tolerance);
        double sticks = trial_event(&two, FBD_EVENT_STICK, NULL, 0),
               slides = trial_event(&one, FBD_EVENT_SLIDING, NULL, 0);
        if (!isnan(sticks) && !both) check_close(&checks, "sticks", slides, sticks, 3000 * tolerance);
        if (checks.failed) print_message("# draw %d\n%s", draw, written);
        trial_close(&one);
        trial_close(&two);
        if (checks.failed) break;
    }
    checks_end(&checks);
}

/* ---- no end of a slide is lost: pushes whose peaks are within a share of 1e-4 to 1e-2 of what holds */

static void write_near(const struct waves *waves, char *text, size_t size)
{
    char sum[300];
    waves_write(waves, "t", "rad/s", sum, sizeof sum);
    snprintf(text, size, "      - applied: {name: wave, value: \"%s\"}\n", sum);
}

static size_t count_of(const struct trial *trial, fbd_event_kind kind)
{
    size_t count = 0, events = fbd_simulation_event_count(trial->simulation);
    for (size_t i = 0; i < events; i++) count += fbd_simulation_event(trial->simulation, i).kind == kind;
    return count;
}

/* Declared friction has the same ends. */
static void a_short_end_of_rubbing_is_not_lost(void **unused)
{
    (void)unused;
    enum { seed = 1779 };
    const int draws = draws_of(12);
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws; draw++) {
        double R = random_between(&numbers, 1, 3), m = random_between(&numbers, 0.5, 2), v = draw % 2;
        const struct waves waves = waves_near(&numbers, R);
        char wave[360], rub[200], texts[2][900];
        write_near(&waves, wave, sizeof wave);
        struct trial trials[2];
        for (int i = 0; i < 2; i++) {
            if (i == 0)
                snprintf(rub, sizeof rub, "      - applied: {name: rub, value: \"-%.17g*sign(v)\"}\n", R);
            else
                snprintf(rub, sizeof rub, "      - gravity\n      - normal\n      - friction: %.17g\n",
                         R / m);
            snprintf(
                texts[i], sizeof texts[i],
                "fbd: 1\ngravity: 1\nbodies:\n  b:\n    mass: %.17g\n    motion: slide\n    initial: {v: "
                "%.17g}\n    forces:\n%s%ssimulate: {until: 20 s}\n",
                m, v, wave, rub);
            trials[i] = trial_parse(texts[i]);
            run_with(&trials[i], i == 0 ? methods[draw % method_count] : NULL, 1e-10);
        }
        size_t slides = count_of(&trials[0], FBD_EVENT_SLIDING_ENDS),
               breaks = count_of(&trials[1], FBD_EVENT_BREAKAWAY);
        check_that(&checks, "as many ends", slides == breaks);
        for (int k = 0; k < (int)breaks; k++)
            check_close(&checks, "end", trial_event(&trials[0], FBD_EVENT_SLIDING_ENDS, "rub", k),
                        trial_event(&trials[1], FBD_EVENT_BREAKAWAY, NULL, k), 1e-6);
        if (checks.failed) print_message("# draw %d, %zu ends of %zu\n%s", draw, slides, breaks, texts[0]);
        for (int i = 0; i < 2; i++) trial_close(&trials[i]);
        if (checks.failed) break;
    }
    checks_end(&checks);
}

/* What the relay of a sliding mode x = -c v has left: F less the size of m x/c^2 - P(t). */
static double left_of(const struct waves *p, double F, double m, double x, double c, double t)
{
    double slope, most, push = F + waves_value(p, t, &slope, &most);
    return F - fabs(m * x * exp(-t / c) / (c * c) - push);
}

static void a_short_end_of_a_sliding_mode_is_not_lost(void **unused)
{
    (void)unused;
    enum { seed = 1932 };
    const int draws = draws_of(12);
    const double step = 1e-4, until = 20;
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws; draw++) {
        double F = random_between(&numbers, 1, 3), m = random_between(&numbers, 0.5, 2),
               c = random_between(&numbers, 0.3, 1),
               x = random_between(&numbers, -1, 1) * 0.3 * F * c * c / m;
        const struct waves waves = waves_near(&numbers, F);
        char wave[360], text[900];
        write_near(&waves, wave, sizeof wave);
        double end = 0;
        if (left_of(&waves, F, m, x, c, 0) < 0.01 * F) continue;
        while (end < until && left_of(&waves, F, m, x, c, end) > 0) end += step;
        double low = end - step, high = end;
        for (int k = 0; k < 60 && end < until; k++) {
            double middle = low + (high - low) / 2;
            *(left_of(&waves, F, m, x, c, middle) > 0 ? &low : &high) = middle;
        }
        snprintf(
            text, sizeof text,
            "fbd: 1\nbodies:\n  b:\n    mass: %.17g\n    motion: slide\n    initial: {x: %.17g, v: %.17g}\n"
            "    forces:\n%s      - applied: {name: relay, value: \"-%.17g*sign(x + %.17g*v)\"}\nsimulate: "
            "{until: 20 s}\n",
            m, x, -x / c, wave, F, c);
        struct trial trial = trial_parse(text);
        run_with(&trial, methods[draw % method_count], 1e-10);
        size_t ends = count_of(&trial, FBD_EVENT_SLIDING_ENDS);
        check_that(&checks, "whether it ends", (ends > 0) == (end < until));
        if (ends > 0 && end < until)
            check_close(&checks, "first end", trial_event(&trial, FBD_EVENT_SLIDING_ENDS, "relay", 0), low,
                        1e-7);
        if (checks.failed) print_message("# draw %d, first end at %.9g\n%s", draw, low, text);
        trial_close(&trial);
        if (checks.failed) break;
    }
    checks_end(&checks);
}

/* ---- two at once: a block on a block on the ground, both rubbing */

static void two_that_rub_on_each_other_are_a_stack(void **unused)
{
    (void)unused;
    enum { seed = 1699 };
    const int draws = draws_of(6);
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws; draw++) {
        double R = random_between(&numbers, 0.2, 2), S = random_between(&numbers, 0.2, 2),
               P = random_between(&numbers, 0, 8), w = random_between(&numbers, 0.5, 5),
               u = random_between(&numbers, -2, 2), v = random_between(&numbers, -2, 2);
        char written[1000], declared[1000];
        snprintf(
            written, sizeof written,
            "fbd: 1\nbodies:\n  low:\n    mass: 2\n    motion: slide\n    initial: {v: %.17g}\n    forces:\n"
            "      - applied: {name: ground, value: \"-%.17g*sign(v)\"}\n"
            "      - applied: {name: rub, value: \"%.17g*sign(high.v - v)\"}\n"
            "  high:\n    mass: 1\n    motion: slide\n    initial: {v: %.17g}\n    forces:\n"
            "      - applied: {name: rub, value: \"if(v > low.v, -%.17g[N], %.17g[N])\"}\n"
            "      - applied: {name: wave, value: \"%.17g*sin(%.17g*t)\"}\nsimulate: {until: 8 s}\n",
            u, R, S, v, S, S, P, w);
        snprintf(
            declared, sizeof declared,
            "fbd: 1\ngravity: 1\nbodies:\n  low:\n    mass: 2\n    motion: slide\n    initial: {v: %.17g}\n"
            "    forces: [gravity, normal, friction: %.17g]\n  high:\n    mass: 1\n"
            "    motion: {slide: {on: low}}\n    initial: {v: %.17g}\n    forces:\n      - gravity\n"
            "      - normal\n      - friction: %.17g\n"
            "      - applied: {name: wave, value: \"%.17g*sin(%.17g*t)\", angle: 0 deg}\n"
            "simulate: {until: 8 s}\n",
            u, R / 3, v - u, S, P, w);
        struct trial one = trial_parse(written), two = trial_parse(declared);
        run_with(&one, methods[draw % 5], 1e-9);
        run_with(&two, NULL, 1e-11);
        check_that(&checks, "it gets to the end", trial_get(&one, "t") == 8);
        check_close(&checks, "low.x", trial_get(&one, "low.x"), trial_get(&two, "low.x"), 1e-6);
        check_close(&checks, "low.v", trial_get(&one, "low.v"), trial_get(&two, "low.v"), 1e-6);
        check_close(&checks, "high.v", trial_get(&one, "high.v"),
                    trial_get(&two, "low.v") + trial_get(&two, "high.v"), 1e-6);
        if (checks.failed) print_message("# draw %d\n%s%s", draw, written, declared);
        trial_close(&one);
        trial_close(&two);
        if (checks.failed) break;
    }
    checks_end(&checks);
}

/* ---- the exact Jacobian while it slides: of a surface that is linear, and of one that is not */

static void the_jacobian_of_a_slide_is_that_of_differences(void **unused)
{
    (void)unused;
    static const char *const laws[] = {"-40*sign(x + 0.5[s]*v)",
                                       "-40*sign(x + 0.1[s^2/m]*v*abs(v) + 0.3[s]*v)",
                                       "if(v + 0.3[m/s]*sin(2[rad/m]*x) > 0[m/s], -60[N], 20[N])"};
    struct checks checks = {0};
    for (size_t law = 0; law < sizeof laws / sizeof *laws; law++) {
        char text[600];
        snprintf(
            text, sizeof text,
            "fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: slide\n    initial: {x: 0, v: 0}\n    forces:\n"
            "      - applied: {name: relay, value: \"%s\"}\n      - damper: 0.3\n"
            "      - applied: {name: wave, value: \"1[N]*sin(3*t)*cos(x/1[m])\"}\nsimulate: {until: 1}\n",
            laws[law]);
        fbd_model *model = model_from(text);
        struct fbd_state *state = fbd_state_new(model);
        assert_true(modes_settle(state, NULL));
        assert_int_equal(state->sliding->count, 1);
        double y[2], low[2], high[2], dfdy[4], dfdt[2], scratch[64];
        const double h = 1e-5;
        for (int point = 0; point < 5; point++) {
            y[0] = 0.1 * point;
            y[1] = 0.05 * point * point - 0.1;
            struct instant at = state_instant_at(state, 0.2 * point, y);
            state_jacobian(model, &at, scratch, dfdy, dfdt);
            for (int j = 0; j < 2; j++) {
                y[j] += h;
                state_rates(model, &at, scratch, high);
                y[j] -= 2 * h;
                state_rates(model, &at, scratch, low);
                y[j] += h;
                for (int i = 0; i < 2; i++)
                    check_close(&checks, laws[law], dfdy[2 * i + j], (high[i] - low[i]) / (2 * h), 1e-7);
            }
            at.t += h;
            state_rates(model, &at, scratch, high);
            at.t -= 2 * h;
            state_rates(model, &at, scratch, low);
            check_close(&checks, "with time", dfdt[1], (high[1] - low[1]) / (2 * h), 1e-7);
        }
        fbd_state_free(state);
        fbd_model_free(model);
    }
    checks_end(&checks);
}

/* ---- from rest, and what does not slide */

static void it_rests_until_the_push_is_too_large(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: slide\n    forces:\n"
                    "      - applied: {name: rub, value: \"-4[N]*sign(v)\"}\n"
                    "      - applied: {name: push, value: \"1[N/s]*t\"}\nsimulate: {until: 8}\n");
    run_with(&trial, NULL, 1e-10);
    check_that(&checks, "one event", fbd_simulation_event_count(trial.simulation) == 1);
    check_close(&checks, "leaves", trial_event(&trial, FBD_EVENT_SLIDING_ENDS, "rub", 0), 4, 1e-12);
    check_close(&checks, "v", trial_get(&trial, "v"), 4, 1e-11);
    check_close(&checks, "x", trial_get(&trial, "x"), 16.0 / 3, 1e-11);
    trial_close(&trial);
    checks_end(&checks);
}

/* A force that drives away from v = 0, and a switch by the place alone: passed as ever. */
static void what_is_passed_is_no_slide(void **unused)
{
    (void)unused;
    static const char *const laws[] = {"1[N]*sign(v) - 3[N]", "-2[N]*sign(x) - 0.1[N*s/m]*v"};
    struct checks checks = {0};
    for (size_t i = 0; i < 2; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    initial: {x: 0.5, v: 1}\n    "
                 "forces:\n"
                 "      - applied: {name: f, value: \"%s\"}\nsimulate: {until: 3}\n",
                 laws[i]);
        struct trial trial = trial_parse(text);
        run_with(&trial, NULL, 1e-10);
        check_that(&checks, "it gets to the end", trial_get(&trial, "t") == 3);
        check_that(&checks, "no slide", isnan(trial_event(&trial, FBD_EVENT_SLIDING, NULL, 0)));
        check_that(&checks, "a switch", !isnan(trial_event(&trial, FBD_EVENT_SWITCH, NULL, 0)));
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A potential that is found by quadrature, of a body beside the one that slides on its switch. */
static void energy_beside_a_slide_is_that_of_plain_values(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nbodies:\n"
        "  a: {mass: 1, motion: slide, initial: {x: 0.1}, forces: [applied: \"-2*sign(x + 1[s]*v)\"]}\n"
        "  b: {mass: 1, motion: slide, initial: {x: 0.1}, forces: [applied: \"-3[N/m^2]*x*abs(x)\"]}\n"
        "simulate: {until: 5 s}\n");
    trial_run(&trial, NULL);
    fbd_energy energy = fbd_result_energy(trial.result);
    check_close(&checks, "V at the start, F/3 x^3", energy.initial_potential, 1e-3, 1e-15);
    check_close(&checks, "residual", energy.residual, 0, 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

/* mu = 0.3 - c t: below zero it would push, which ends the run; `max(0, ...)` goes on, at v_0 - g (0.3 t - c t^2/2). */
static void friction_does_not_push(void **unused)
{
    static const char scene[] =
        "fbd: 1\nbodies:\n  b: {mass: 1, motion: slide, initial: {v: 3}, forces: [gravity, normal, "
        "friction: {coefficient: \"%s(0%s %.17g - %.17g[1/s]*t)\"}]}\nsimulate: {until: 2}\n";
    struct random_numbers numbers = {20261125};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 20; i++) {
        double c = random_between(&numbers, 0.3, 3), end = 0.3 / c;
        char text[400];
        snprintf(text, sizeof text, scene, "max", ",", 0.3, c);
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_that(&checks, "it goes on", trial.outcome == FBD_DONE);
        check_close(&checks, "v", trial_get(&trial, "b.v"), 3 - 9.81 * 0.3 * end / 2, 1e-9);
        trial_close(&trial);
        snprintf(text, sizeof text, scene, "", " +", 0.3, c);
        trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_that(&checks, "it ends", trial.outcome == FBD_FAILED);
        check_that(&checks, "by name", strstr(fbd_simulation_reason(trial.simulation), "below zero") != NULL);
        trial_close(&trial);
        snprintf(text, sizeof text, scene, "", " +", -0.3, -c);
        trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_that(&checks, "it does not start", trial.outcome == FBD_FAILED);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sliding_mode_decays_on_its_surface),
        cmocka_unit_test(friction_by_sign_is_friction),
        cmocka_unit_test(a_short_end_of_rubbing_is_not_lost),
        cmocka_unit_test(a_short_end_of_a_sliding_mode_is_not_lost),
        cmocka_unit_test(two_that_rub_on_each_other_are_a_stack),
        cmocka_unit_test(the_jacobian_of_a_slide_is_that_of_differences),
        cmocka_unit_test(it_rests_until_the_push_is_too_large),
        cmocka_unit_test(what_is_passed_is_no_slide),
        cmocka_unit_test(friction_does_not_push),
        cmocka_unit_test(energy_beside_a_slide_is_that_of_plain_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
