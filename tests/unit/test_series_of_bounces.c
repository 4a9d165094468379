/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A particle bounces on a floor until its flights are less high than the errors of the steps, by a method whose steps are known by
 * their ends alone. In closed form: it falls for T = sqrt(2 h/g), flies for 2 T e, 2 T e^2, ..., and rests from
 * T (1 + e)/(1 - e) on.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

#include <stdio.h>

static const double g = 9.81;

struct drop {
    double h, e, vx, mass;
};

/* To the end, in no more steps than so many. */
static bool finish(struct trial *trial)
{
    enum { most_steps = 20000 };
    int steps = 0;
    double from, to;
    while (steps++ < most_steps &&
           (trial->outcome = fbd_simulation_advance(trial->simulation)) == FBD_GOING) {
    }
    fbd_simulation_interval(trial->simulation, &from, &to);
    return trial->outcome == FBD_DONE && fbd_simulation_state(trial->simulation, to, trial->state);
}

/* When it has come to rest, by what was too small to see or by a flight that was none; or NAN. */
static double rests_at(const struct trial *trial)
{
    size_t count = fbd_simulation_event_count(trial->simulation);
    double t = NAN;
    for (size_t i = 0; i < count; i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        if (event.kind == FBD_EVENT_REST || event.kind == FBD_EVENT_CONTACT) t = event.t;
    }
    return t;
}

static void check_drop(struct checks *checks, const struct drop *drop, const char *method, double tolerance)
{
    const double T = sqrt(2 * drop->h / g), rest = T * (1 + drop->e) / (1 - drop->e), until = rest + T;
    const double late = 30 * sqrt(tolerance) * rest;
    char text[1000];
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: %.17g\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n"
             "  ball: {mass: %.17g, motion: particle, initial: {y: %.17g, vx: %.17g}, forces: [gravity]}\n"
             "contacts:\n  - {name: c, between: [ball, ground.floor], restitution: %.17g}\n"
             "simulate: {until: %.17g}\n",
             g, drop->mass, drop->h, drop->vx, drop->e, until);
    const size_t failed = checks->failed;
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = method;
    options.tolerance = tolerance;
    struct trial trial = trial_parse(text);
    trial_start(&trial, &options);
    if (check_that(checks, "comes to its end", finish(&trial))) {
        check_close(checks, "rests at", rests_at(&trial), rest, late);
        check_close(checks, "x", trial_get(&trial, "ball.x"), drop->vx * until,
                    1e-9 * (1 + fabs(drop->vx) * until));
        check_close(checks, "y", trial_get(&trial, "ball.y"), 0, 1e-12);
        check_close(checks, "vy", trial_get(&trial, "ball.vy"), 0, 1e-12);
    }
    if (checks->failed > failed)
        print_message("# %s at %g: %s\n%s", method, tolerance, fbd_simulation_reason(trial.simulation), text);
    trial_close(&trial);
}

static void flights_below_the_errors_come_to_an_end(void **unused)
{
    (void)unused;
    enum { seed = 215 };
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int left = draws_of(60); left > 0 && !checks.failed; left--) {
        struct drop drop = {.h = pow(10, random_between(&numbers, -2, 1)),
                            .e = random_between(&numbers, 0.2, 0.8)};
        drop.vx = random_perhaps(&numbers, 0.5, -1, 1);
        drop.mass = random_between(&numbers, 0.5, 3);
        double tolerance = pow(10, random_between(&numbers, -9, -3));
        check_drop(&checks, &drop, "msbdf", tolerance);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flights_below_the_errors_come_to_an_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
