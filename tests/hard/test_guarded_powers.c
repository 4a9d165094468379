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

/* A way that ends with the speed turned round. */
struct way {
    const char *what, *law;
    double start, time, end, size; /* of the place */
};

static void check_way(struct checks *checks, const struct ball *ball, const struct way *way, int seed,
                      double tolerance)
{
    struct trial trial = trial_of(ball, way->law, way->start, way->time + 0.4 * ball->duration);
    char name[60];
    hard_start(&trial, &(struct hard_method){.tolerance = tolerance}, NAN);
    snprintf(name, sizeof name, "%s, seed %d, power %g", way->what, seed, ball->power);
    trial_to(&trial, way->time);
    double of_place = fabs(trial_get(&trial, "b.x") - way->end) / way->size;
    double of_speed = fabs(trial_get(&trial, "b.v") + ball->speed) / ball->speed;
    if (hard_done(checks, &trial))
        hard_case(checks, &trial, name, fmax(of_place, of_speed), most * tolerance);
    trial_close(&trial);
}

static struct way onto_cushion(const struct ball *ball, const char *law)
{
    double strikes = ball->gap / ball->speed, flight = 0.3 * strikes;
    return (struct way){"cushion",
                        law,
                        -ball->gap,
                        strikes + ball->duration + flight,
                        -flight * ball->speed,
                        ball->gap + ball->depth};
}

/* From the middle to the middle, an odd number of times. */
static struct way to_and_fro(const struct ball *ball)
{
    enum { times = 5 };
    return (struct way){"oscillator", "-%.17g*sign(x)*abs(x/1[m])^%g", 0, times * ball->duration, 0,
                        ball->depth};
}

static void powers_of_what_a_switch_keeps_above_zero(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    int first = number_of("FBD_POWERS_SEED", 1), many = number_of("FBD_POWERS", draws_of(25));
    for (int seed = first; seed < first + many; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct ball ball = random_ball(&numbers);
        const struct way ways[] = {onto_cushion(&ball, "-%.17g*max(x/1[m], 0)^%g"),
                                   onto_cushion(&ball, "if(x > 0, -%.17g*(x/1[m])^%g, 0)"),
                                   to_and_fro(&ball)};
        for (int k = 0; k < tolerance_count; k++)
            for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
                check_way(&checks, &ball, &ways[i], seed, tolerances[k]);
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
