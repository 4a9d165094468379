/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A force of exactly mu m g on a block with friction mu.
 *
 * What makes it hard: one rounding more or less than the limit, with numbers that are not exact in binary.
 *
 * Reference: at rest it stays. Thrown against the force it stops at |v0|/(2 mu g) and stays; along the force
 * it goes on at constant speed.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"
#include "random_numbers.h"

static const double g = 9.81, mu = 0.3;

static void at_rest_it_stays(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    char setting[32];
    for (size_t i = 0; hard_method_at(i, &method); i++)
        for (int k = 1; k < 40; k += thorough() ? 1 : 6) {
            snprintf(setting, sizeof setting, "mu=%g", 0.017 * k);
            struct trial trial = trial_open("hard/at_the_limit.yaml", SET(setting));
            hard_start(&trial, &method, NAN);
            hard_done(&checks, &trial);
            double moved = fabs(trial_get(&trial, "x")) + fabs(trial_get(&trial, "v"));
            check_that(&checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
            if (k == 1) hard_case(&checks, &trial, "at rest: motion", moved, 1e-300);
            check_that(&checks, "at rest: motion", moved == 0);
            trial_close(&trial);
        }
    checks_end(&checks);
}

static void thrown_against_the_force_it_stops_and_stays(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/at_the_limit.yaml", SET("v0=-3"));
        hard_start(&trial, &method, NAN);
        hard_done(&checks, &trial);
        double stops = 3 / (2 * mu * g), x = -3 * stops / 2;
        /* The motion is a parabola: exact for order 2 and above but for roundings. */
        double tolerance = fmax(1e-13, 3 * hard_promise(&trial));
        hard_case(&checks, &trial, "thrown against it: time of the stop",
                  fabs(trial_event(&trial, FBD_EVENT_STICK, NULL, 0) - stops), tolerance);
        hard_case(&checks, &trial, "thrown against it: place", fabs(trial_get(&trial, "x") - x), tolerance);
        check_that(&checks, "it stays",
                   trial_get(&trial, "v") == 0 && fbd_simulation_event_count(trial.simulation) == 1);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void thrown_along_the_force_it_goes_on(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/at_the_limit.yaml", SET("v0=3"));
        hard_start(&trial, &method, NAN);
        hard_done(&checks, &trial);
        /* 100 s with an acceleration that is one rounding of mu g at most. */
        hard_case(&checks, &trial, "thrown along it: velocity", fabs(trial_get(&trial, "v") - 3), 1e-13);
        check_that(&checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A trillionth more than the limit moves it: 1e-12 mu g, known to 4 roundings of mu g, for 100 s. */
static void a_trillionth_more_moves_it(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("hard/at_the_limit.yaml", SET("share=1+1e-12"));
    hard_start(&trial, NULL, NAN);
    hard_done(&checks, &trial);
    double v = 1e-12 * mu * g * 100;
    hard_case(&checks, &trial, "1e-12 above: velocity", fabs(trial_get(&trial, "v") - v), 1e-3 * v);
    trial_close(&trial);
    trial = trial_open("hard/at_the_limit.yaml", SET("share=1-1e-12"));
    hard_start(&trial, NULL, NAN);
    hard_done(&checks, &trial);
    hard_case(&checks, &trial, "1e-12 below: velocity", fabs(trial_get(&trial, "v")), 1e-300);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- a block on a spring and on a belt, without friction where it slips
 *
 * From x_0 = mu m g/k it slips with v = V, and by energy comes back to that speed at -x_0, where the spring pulls with mu m g
 * again, and ever less from there on: it sticks, and is carried to x_0. With w^2 = k/m and tan phi = w x_0/V,
 *
 *     slips for (2 pi - 2 phi)/w, x = x_0 cos w t + V/w sin w t;     sticks for 2 x_0/V.
 */

struct belt {
    double m, k, mu, V, until;
    bool joined; /* to a wheel, that the block is one of several */
};

static struct belt draw_belt(struct random_numbers *numbers)
{
    struct belt belt = {.m = random_between(numbers, 0.3, 5),
                        .k = random_between(numbers, 10, 200),
                        .mu = random_between(numbers, 0.1, 0.8),
                        .V = random_between(numbers, 0.05, 1),
                        .joined = random_chance(numbers, 0.5)};
    belt.until = random_between(numbers, 2, 20) * belt.mu * belt.m * g / belt.k / belt.V;
    return belt;
}

/* m of all that moves; the wheel counts as half of its own. */
static double moved_by(const struct belt *belt)
{
    return belt->joined ? 1.5 * belt->m : belt->m;
}

static struct trial trial_of_belt(const struct belt *belt)
{
    char text[1200];
    int length = snprintf(text, sizeof text,
                          "fbd: 1\ngravity: 9.81\nbodies:\n  b:\n    mass: %.17g\n    motion: slide\n    "
                          "initial: {v: %.17g}\n    forces:\n"
                          "      - gravity\n      - normal\n      - friction: {static: %.17g, kinetic: 0, "
                          "surface_speed: %.17g}\n"
                          "      - spring: {stiffness: %.17g}\n",
                          belt->m, belt->V, belt->mu, belt->V, belt->k);
    if (belt->joined)
        length += snprintf(
            text + length, sizeof text - (size_t)length,
            "  w:\n    mass: %.17g\n    shape: disc\n    radius: 1\n    motion: {pivot: {at: [0, -1]}}\n"
            "    initial: {omega: %.17g}\n    forces: [gravity]\ncouplings: [rack: {between: [w, b], radius: "
            "1}]\n",
            belt->m, -belt->V);
    snprintf(text + length, sizeof text - (size_t)length, "simulate: {until: %.17g}\n", belt->until);
    return trial_parse(text);
}

static double place_on_belt(const struct belt *belt)
{
    double x0 = belt->mu * belt->m * g / belt->k, w = sqrt(belt->k / moved_by(belt));
    double phi = atan2(w * x0, belt->V), slips = (2 * acos(-1) - 2 * phi) / w, t = belt->until - x0 / belt->V;
    if (t < 0) return belt->V * belt->until;
    t = fmod(t, slips + 2 * x0 / belt->V);
    return t < slips ? x0 * cos(w * t) + belt->V / w * sin(w * t) : -x0 + belt->V * (t - slips);
}

static void what_slips_without_loss_sticks_where_it_comes_back(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    struct random_numbers numbers = {20261125};
    for (size_t i = 0; hard_method_at(i, &method); i++)
        for (int draw = 0; draw < (thorough() ? 4 : 1); draw++) {
            struct belt belt = draw_belt(&numbers);
            struct trial trial = trial_of_belt(&belt);
            hard_start(&trial, &method, NAN);
            hard_done(&checks, &trial);
            double size = belt.mu * belt.m * g / belt.k + belt.V * sqrt(moved_by(&belt) / belt.k);
            hard_case(&checks, &trial, "without loss: place",
                      fabs(trial_get(&trial, "b.x") - place_on_belt(&belt)) / size,
                      fmin(3 * hard_promise(&trial), 0.05));
            trial_close(&trial);
        }
    checks_end(&checks);
}

/* Of what has not slipped: a push that sets in beyond the limit by 5e-7 of it moves the block, on ice as well. */
static void what_rests_on_ice_gives_way_beyond_its_limit(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int side = -1; side <= 1; side += 2) {
        char text[400];
        snprintf(
            text, sizeof text,
            "fbd: 1\ngravity: 10\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    forces:\n"
            "      - gravity\n      - normal\n      - friction: {static: 0.5, kinetic: 0}\n"
            "      - applied: {name: push, value: \"if(t < 1, 1, 5*(1 + %d*5e-7))\"}\nsimulate: {until: 2}\n",
            side);
        struct trial trial = trial_parse(text);
        hard_start(&trial, NULL, NAN);
        hard_done(&checks, &trial);
        double v = side > 0 ? 5 * (1 + 5e-7) : 0;
        hard_case(&checks, &trial, "on ice: velocity", fabs(trial_get(&trial, "v") - v), 1e-12);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_rest_it_stays),
        cmocka_unit_test(thrown_against_the_force_it_stops_and_stays),
        cmocka_unit_test(thrown_along_the_force_it_goes_on),
        cmocka_unit_test(a_trillionth_more_moves_it),
        cmocka_unit_test(what_slips_without_loss_sticks_where_it_comes_back),
        cmocka_unit_test(what_rests_on_ice_gives_way_beyond_its_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
