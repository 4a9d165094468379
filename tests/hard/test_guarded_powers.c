/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Balls that strike a cushion whose force is a power of the depth, as in Hertz' contact, f = k max(x, 0)^p, also written
 * with `if`; oscillators with f = k sign(x) abs(x)^p; and tanks that run empty by a root of their level.
 *
 * What makes it hard: beyond the switch the root or power is not there, where steps look that are on their way to it. Each
 * ended at its switch with "a force is not finite".
 *
 * Reference: with the energy m v^2/2 + k x^(p+1)/(p+1) the ball turns at X = ((p + 1) m v^2/(2 k))^(1/(p+1)) and leaves with
 * -v after (2 X/v) B(1/(p+1), 1/2)/(p + 1); the tank with rate -c sqrt(level) is empty after 2 sqrt(level)/c.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_sf_gamma.h>

#include "hard.h"
#include "random_numbers.h"

struct ball {
    double mass, k, power, gap, speed;
    double depth, duration; /* X, and how long it is in contact */
};

static struct ball random_ball(struct random_numbers *numbers)
{
    const double powers[] = {0.5, 1.5, 2.5, 1.2};
    struct ball ball = {.mass = pow(10, random_between(numbers, -2, 2)),
                        .k = pow(10, random_between(numbers, 0, 7)),
                        .power = powers[(int)random_between(numbers, 0, 4)],
                        .gap = random_between(numbers, 0.1, 2),
                        .speed = pow(10, random_between(numbers, -1, 1))};
    double p = ball.power;
    ball.depth = pow((p + 1) * ball.mass * ball.speed * ball.speed / (2 * ball.k), 1 / (p + 1));
    ball.duration = 2 * ball.depth / ball.speed * gsl_sf_beta(1 / (p + 1), 0.5) / (p + 1);
    return ball;
}

static struct trial trial_of(const struct ball *ball, const char *law, double start, double until)
{
    char text[600], force[200];
    snprintf(force, sizeof force, law, ball->k, ball->power);
    snprintf(
        text, sizeof text,
        "fbd: 1\nbodies: {b: {mass: %.17g, motion: slide, initial: {x: %.17g, v: %.17g}, forces: [applied: "
        "\"(%s)*1[N]\"]}}\nsimulate: {until: %.17g}\n",
        ball->mass, start, ball->speed, force, until);
    return trial_parse(text);
}

static const double tolerances[] = {1e-6, 1e-9, 1e-11};
enum { tolerance_count = 3 };
static const double most = 30; /* tolerances; 15 were measured in 400 draws */

static void check_cushion(struct checks *checks, const struct ball *ball, const char *law, int seed,
                          double tolerance)
{
    double strikes = ball->gap / ball->speed, flight = 0.3 * strikes;
    struct trial trial = trial_of(ball, law, -ball->gap, strikes + ball->duration + flight);
    hard_start(&trial, &(struct hard_method){.tolerance = tolerance}, NAN);
    char name[60];
    snprintf(name, sizeof name, "cushion, seed %d, power %g", seed, ball->power);
    if (hard_done(checks, &trial)) {
        double of_place = fabs(trial_get(&trial, "b.x") + flight * ball->speed) / (ball->gap + ball->depth);
        double of_speed = fabs(trial_get(&trial, "b.v") + ball->speed) / ball->speed;
        hard_case(checks, &trial, name, fmax(of_place, of_speed), most * tolerance);
    }
    trial_close(&trial);
}

/* From the middle to the middle, some times. */
static void check_oscillator(struct checks *checks, const struct ball *ball, int seed, double tolerance)
{
    enum { times = 5 };
    struct trial trial = trial_of(ball, "-%.17g*sign(x)*abs(x/1[m])^%g", 0, (times + 0.4) * ball->duration);
    char name[60];
    hard_start(&trial, &(struct hard_method){.tolerance = tolerance}, NAN);
    snprintf(name, sizeof name, "oscillator, seed %d, power %g", seed, ball->power);
    trial_to(&trial, times * ball->duration);
    double of_place = fabs(trial_get(&trial, "b.x")) / ball->depth;
    double of_speed = fabs(fabs(trial_get(&trial, "b.v")) - ball->speed) / ball->speed;
    if (hard_done(checks, &trial))
        hard_case(checks, &trial, name, fmax(of_place, of_speed), most * tolerance);
    trial_close(&trial);
}

static void powers_of_what_a_switch_keeps_above_zero(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    int first = number_of("FBD_POWERS_SEED", 1), many = number_of("FBD_POWERS", draws_of(25));
    for (int seed = first; seed < first + many; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct ball ball = random_ball(&numbers);
        for (int k = 0; k < tolerance_count; k++) {
            check_cushion(&checks, &ball, "-%.17g*max(x/1[m], 0)^%g", seed, tolerances[k]);
            check_cushion(&checks, &ball, "if(x > 0, -%.17g*(x/1[m])^%g, 0)", seed, tolerances[k]);
            check_oscillator(&checks, &ball, seed, tolerances[k]);
        }
    }
    checks_end(&checks);
}

static void tanks_run_empty(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    int first = number_of("FBD_POWERS_SEED", 1), many = number_of("FBD_POWERS", draws_of(25));
    for (int seed = first; seed < first + many; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        double level = pow(10, random_between(&numbers, -2, 2)), c = pow(10, random_between(&numbers, -2, 1));
        double empty = 2 * sqrt(level) / c;
        for (int k = 0; k < tolerance_count; k++) {
            char text[400], name[60];
            snprintf(
                text, sizeof text,
                "fbd: 1\nstates: {level: {rate: \"-%.17g*sqrt(max(states.level/1[m], 0))*1[m/s]\", initial: "
                "%.17g m}}\nbodies: {b: {mass: 1, motion: slide}}\nsimulate: {until: %.17g}\n",
                c, level, 2 * empty);
            struct trial trial = trial_parse(text);
            hard_start(&trial, &(struct hard_method){.tolerance = tolerances[k]}, NAN);
            trial_to(&trial, empty / 2);
            double half = fabs(trial_get(&trial, "states.level") / level - 0.25);
            snprintf(name, sizeof name, "tank, seed %d", seed);
            if (hard_done(&checks, &trial))
                hard_case(&checks, &trial, name, fmax(half, fabs(trial_get(&trial, "states.level")) / level),
                          most * tolerances[k]);
            trial_close(&trial);
        }
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_of_what_a_switch_keeps_above_zero),
        cmocka_unit_test(tanks_run_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
