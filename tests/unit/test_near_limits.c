/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What holds a body, under two waves whose sizes add up to its limit R and a share of 1e-4 to 1e-2 more or less:
 * the first time beyond it is found by a search with bounds (waves.h). A program that looks at samples misses such
 * peaks, which are over within a hundredth of a period.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "thorough.h"
#include "waves.h"

#include <stdio.h>
#include <stdlib.h>

static const double until = 20, g = 10;

/* ---- scenes: of a mass m, a wave of forces, and the limit */

struct hold {
    const char *name;
    double limit; /* per m g, of the wave */
    bool both;    /* to both sides */
    fbd_event_kind event;
    void (*write)(char *text, size_t size, double m, const char *wave);
};

/* A block under another that sticks to it. */
static void write_stack(char *text, size_t size, double m, const char *wave)
{
    snprintf(text, size,
             "  low:\n    mass: %.17g\n    motion: slide\n    forces:\n      - gravity\n      - normal\n"
             "      - friction: 0.3\n      - applied: {name: wave, value: \"%s\"}\n"
             "  high:\n    mass: %.17g\n    motion: {slide: {on: low}}\n    forces: [gravity, normal, "
             "friction: 5]\n",
             0.4 * m, wave, 0.6 * m);
}

/* Rubbing written by sign(v), with a pendulum that hangs. */
static void write_cart(char *text, size_t size, double m, const char *wave)
{
    snprintf(
        text, size,
        "  low:\n    mass: 1\n    motion: slide\n    forces:\n"
        "      - applied: {name: rub, value: \"-%.17g*sign(v)\"}\n      - applied: {name: wave, value: "
        "\"%s\"}\n"
        "  rod: {mass: 2, shape: rod, length: 1, motion: {pivot: {on: low, point: left}}, initial: {theta: "
        "-90 deg}, forces: [gravity]}\n",
        0.3 * m * g, wave);
}

static void write_box(char *text, size_t size, double m, const char *wave, const char *direction, double mu)
{
    snprintf(text, size,
             "  low:\n    mass: %.17g\n    shape: prism\n    a: 2\n    b: 0.1\n    c: 1\n    motion: planar\n"
             "    initial: {y: 0.05}\n    forces:\n      - gravity\n"
             "      - applied: {name: wave, value: \"%s\", angle: %s}\n"
             "contacts:\n  - {between: [low, ground.floor], static: %.17g}\n",
             m, wave, direction, mu);
}

static void write_pushed_box(char *text, size_t size, double m, const char *wave)
{
    write_box(text, size, m, wave, "0 deg", 0.3);
}

static void write_lifted_box(char *text, size_t size, double m, const char *wave)
{
    write_box(text, size, m, wave, "90 deg", 0.3);
}

static void write_rope(char *text, size_t size, double m, const char *wave)
{
    snprintf(
        text, size,
        "  low:\n    mass: %.17g\n    motion: particle\n    initial: {y: -1}\n    forces:\n      - gravity\n"
        "      - applied: {name: wave, value: \"%s\", angle: 90 deg}\n"
        "couplings:\n  - rope: {through: [low, ground.O], length: 1}\n",
        m, wave);
}

static void write_wheel(char *text, size_t size, double m, const char *wave)
{
    snprintf(text, size,
             "  low:\n    mass: %.17g\n    shape: disc\n    radius: 0.5\n    motion: planar\n    initial: "
             "{y: 0.5}\n"
             "    forces:\n      - gravity\n      - applied: {name: wave, value: \"%s\", angle: 90 deg}\n"
             "couplings:\n  - roll: {body: low, on: floor, static: 0.5, kinetic: 0.4}\n",
             m, wave);
}

static void write_bearing(char *text, size_t size, double m, const char *wave)
{
    snprintf(text, size,
             "  low:\n    mass: 2\n    shape: disc\n    radius: 0.5\n    motion: {pivot: {at: O}}\n    "
             "forces: [gravity]\n"
             "    moments:\n      - friction: {coefficient: %.17g N*m}\n"
             "      - applied: {name: wave, value: \"1[m]*(%s)\"}\n",
             0.3 * m * g, wave);
}

static const struct hold holds[] = {
    {"friction under a stack", 0.3, true, FBD_EVENT_BREAKAWAY, write_stack},
    {"rubbing of a cart with a pendulum", 0.3, true, FBD_EVENT_SLIDING_ENDS, write_cart},
    {"friction of a contact", 0.3, true, FBD_EVENT_BREAKAWAY, write_pushed_box},
    {"a contact's normal force", 1, false, FBD_EVENT_LIFT_OFF, write_lifted_box},
    {"the tension of a rope", 1, false, FBD_EVENT_ROPE_SLACK, write_rope},
    {"the normal force of a wheel", 1, false, FBD_EVENT_LIFT_OFF, write_wheel},
    {"friction of a bearing", 0.3, true, FBD_EVENT_BREAKAWAY, write_bearing},
};

static double first_event(const struct trial *trial, fbd_event_kind kind)
{
    size_t count = fbd_simulation_event_count(trial->simulation);
    for (size_t i = 0; i < count; i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        if (event.kind == kind) return event.t;
    }
    return HUGE_VAL;
}

static void check_hold(struct checks *checks, const struct hold *hold, struct random_numbers *numbers)
{
    double m = random_between(numbers, 0.5, 3), R = hold->limit * m * g;
    const struct waves waves = waves_near(numbers, R);
    double slope, most, push = R + waves_value(&waves, 0, &slope, &most),
                        want = waves_first(&waves, until, hold->both);
    char sum[300], wave[320], bodies[1400], text[2000];
    if (fabs(push) > 0.99 * R) return;
    waves_write(&waves, "t", "rad/s", sum, sizeof sum);
    snprintf(wave, sizeof wave, "1[N]*(%s)", sum);
    hold->write(bodies, sizeof bodies, m, wave);
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: %g\nground: {points: {O: [0, 0]}, lines: {floor: {along: 0 deg}}}\nbodies:\n%s"
             "simulate: {until: %.17g s}\n",
             g, bodies, fmin(want + 1e-3, until));
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double got = first_event(&trial, hold->event);
    bool right = want < HUGE_VAL ? fabs(got - want) <= 1e-7 : got == HUGE_VAL;
    check_that(checks, hold->name, right);
    if (!right) print_message("# wanted at %.12g, got %.12g\n%s", want, got, text);
    trial_close(&trial);
}

static void a_short_peak_beyond_a_limit_is_not_lost(void **unused)
{
    (void)unused;
    enum { seed = 1821 };
    const char *wanted = getenv("FBD_LIMITS");
    const int draws = wanted ? atoi(wanted) : draws_of(40);
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws && !checks.failed; draw++)
        for (size_t k = 0; k < sizeof holds / sizeof *holds; k++) check_hold(&checks, &holds[k], &numbers);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_short_peak_beyond_a_limit_is_not_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
