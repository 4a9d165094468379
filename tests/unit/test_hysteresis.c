/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Relays with hysteresis: the lists of their switches in closed form.
 *
 * By the speed, -F h(v): the speed goes to and fro between the thresholds at a = F/m. By the place, -F h(x): what
 * passes a threshold outwards with v comes back to the other one, w away, after (v + sqrt(v^2 + 2 a w))/a, faster by
 * 2 a w in v^2: it swings up for ever. By time, h(sin(w t)).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "random_numbers.h"

#include <stdio.h>

static const char *const methods[] = {NULL,    "dop853", "rkf45",  "rk8pd", "rodas5p",
                                      "msbdf", "bsimp",  "rk4imp", "rk4",   "msadams"};

enum { method_count = sizeof methods / sizeof *methods };

static struct trial run_scene(const char *text, const char *method, double tolerance)
{
    struct trial trial = trial_parse(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = method;
    options.tolerance = tolerance;
    trial_start(&trial, &options);
    trial_finish(&trial);
    return trial;
}

static size_t switches_of(const struct trial *trial)
{
    size_t count = 0, events = fbd_simulation_event_count(trial->simulation);
    for (size_t i = 0; i < events; i++)
        count += fbd_simulation_event(trial->simulation, i).kind == FBD_EVENT_SWITCH;
    return count;
}

static void check_switch(struct checks *checks, struct trial *trial, int k, double t, double room)
{
    check_close(checks, "switch", trial_event(trial, FBD_EVENT_SWITCH, "relay", k), t, room);
}

static const char scene[] =
    "fbd: 1\nbodies:\n  b:\n    mass: %.17g\n    motion: slide\n    initial: {x: %.17g, v: "
    "%.17g}\n    forces:\n      - applied: {name: relay, value: \"-%.17g*hysteresis(%s, "
    "%.17g[%s], %.17g[%s])\"}\nsimulate: {until: 10 s}\n";

static void by_speed_it_goes_to_and_fro(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {1923};
    for (int draw = 0; draw < 40 && !checks.failed; draw++) {
        double m = random_between(&numbers, 0.5, 3), F = random_between(&numbers, 0.5, 5), a = F / m,
               low = random_between(&numbers, -2, 0.5), high = low + random_between(&numbers, 0.05, 1),
               v = draw % 3 == 0 ? high + 0.3 : low + random_between(&numbers, 0, 1) * (high - low);
        bool on = v > high;
        char text[600];
        snprintf(text, sizeof text, scene, m, 0.3, v, F, "v", low, "m/s", high, "m/s");
        struct trial trial = run_scene(text, methods[draw % method_count], 1e-10);
        double t = on ? (v - low) / a : (high - v) / a;
        int k = 0;
        for (; t < 10; t += (high - low) / a) check_switch(&checks, &trial, k++, t, 1e-8);
        check_that(&checks, "as many", switches_of(&trial) == (size_t)k);
        if (checks.failed) print_message("# draw %d\n%s", draw, text);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void by_place_it_swings_up(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {1924};
    for (int draw = 0; draw < 40 && !checks.failed; draw++) {
        double m = random_between(&numbers, 0.5, 3), F = random_between(&numbers, 0.5, 5), a = F / m,
               low = random_between(&numbers, -1, 1), high = low + random_between(&numbers, 0.05, 1),
               x = low + random_between(&numbers, 0, 1) * (high - low), v = random_between(&numbers, 0, 1);
        char text[600];
        snprintf(text, sizeof text, scene, m, x, v, F, "x", low, "m", high, "m");
        struct trial trial = run_scene(text, methods[draw % method_count], 1e-10);
        double speed = sqrt(v * v + 2 * a * (high - x)), t = (speed - v) / a, w = high - low;
        int k = 0;
        while (t < 10) {
            check_switch(&checks, &trial, k++, t, 1e-7);
            double next = sqrt(speed * speed + 2 * a * w);
            t += (speed + next) / a;
            speed = next;
        }
        check_that(&checks, "as many", switches_of(&trial) == (size_t)k);
        if (checks.failed) print_message("# draw %d\n%s", draw, text);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A wave of time, and what an `if` hides for a while is remembered. */
static void by_time_and_behind_an_if(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int m = 0; m < method_count; m++) {
        struct trial trial =
            run_scene("fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    forces:\n"
                      "      - applied: {name: relay, value: \"1[N]*hysteresis(sin(20*t), -0.1, 0.3)\"}\n"
                      "simulate: {until: 100 s}\n",
                      methods[m], 1e-8);
        const double pi = 3.14159265358979323846;
        int k = 0;
        for (; k < 600; k++) {
            double up = (2 * pi * (k / 2) + asin(0.3)) / 20, down = (2 * pi * (k / 2) + pi + asin(0.1)) / 20;
            check_switch(&checks, &trial, k, k % 2 ? down : up, 1e-12);
        }
        check_that(&checks, "as many", switches_of(&trial) >= 636 && switches_of(&trial) <= 637);
        trial_close(&trial);
        /* On from t = sqrt(2) on, when x is 1; hidden between 2 s and 3 s, it is still on when it comes back. */
        struct trial hidden = run_scene("fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    forces:\n"
                                        "      - applied: {name: relay, value: \"if(t < 2[s] or t > 3[s], "
                                        "-1[N]*hysteresis(x, 0.5[m], 1[m]), "
                                        "0[N])\"}\nsimulate: {until: 3.5 s}\n",
                                        methods[m], 1e-10);
        double s = sqrt(2), v2 = s - (2 - s), x2 = 1 + s * (2 - s) - (2 - s) * (2 - s) / 2;
        check_close(&checks, "v", trial_get(&hidden, "v"), v2 - 0.5, 1e-7);
        check_close(&checks, "x", trial_get(&hidden, "x"), x2 + v2 * 1.5 - 0.125, 1e-7);
        trial_close(&hidden);
    }
    checks_end(&checks);
}

/* Thresholds may vary, but not cross. */
static void thresholds_that_cross_end_the_run(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int crosses = 0; crosses < 2; crosses++) {
        char text[600];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    initial: {x: 0.5}\n    forces:\n"
                 "      - applied: \"-2*hysteresis(x, -0.1[m]*(%d + cos(1[1/s]*t)), 0.1[m]*(%d + "
                 "cos(1[1/s]*t)))\"\n"
                 "simulate: {until: 3 s}\n",
                 crosses ? 0 : 2, crosses ? 0 : 2);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        fbd_outcome outcome;
        do outcome = fbd_simulation_advance(trial.simulation);
        while (outcome == FBD_GOING);
        check_that(&checks, crosses ? "they cross" : "they do not",
                   outcome == (crosses ? FBD_FAILED : FBD_DONE));
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void its_force_is_not_conservative(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    char text[600];
    snprintf(text, sizeof text, scene, 2.0, 0.0, 1.0, 3.0, "x", -0.1, "m", 0.1, "m");
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    fbd_energy energy = fbd_result_energy(trial.result);
    check_that(&checks, "no potential", energy.potential == 0 && energy.initial_potential == 0);
    check_close(&checks, "residual", energy.residual, 0, 1e-10 * energy.kinetic);
    check_that(&checks, "work is done", energy.work != 0);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_speed_it_goes_to_and_fro),   cmocka_unit_test(by_place_it_swings_up),
        cmocka_unit_test(by_time_and_behind_an_if),      cmocka_unit_test(thresholds_that_cross_end_the_run),
        cmocka_unit_test(its_force_is_not_conservative),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
