/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pulses that are much shorter than the steps would be without them: bells and windows of exp, tanh, cosh and powers of a
 * constant, in time, in place and along a beam, of random width, place and size. What they do has a closed form.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fbd_study.h"
#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

/* f(u), with $ for u, and its integral over all u. */
struct bell {
    const char *text;
    double integral;
};

static const struct bell bells[] = {
    {"exp(-($)^2)", 1.7724538509055160},
    {"2^(-($)^2)", 2.1289340388624525}, /* sqrt(pi/ln 2) */
    {"pow(10, -($)^2)", 1.1680652181457340},
    {"($)^2*exp(-($)^2)", 0.8862269254527580},
    {"exp(-abs($))", 2},
    {"1/cosh($)", 3.14159265358979323846},
    {"1/cosh($)^2", 2},
    {"(tanh(($) + 3) - tanh(($) - 3))/2", 6},
    {"(1/(1 + exp(-($))) - 1/(1 + exp(7 - ($))))", 7},
    {"exp(-($)^2)*(1 - tanh($)^2 + 1/cosh($)^2)/2", 1.2873752250014305},
};

enum { bell_count = sizeof bells / sizeof *bells, room = 2000 };

/* Simpson's rule: the integrals above are not taken on trust. */
static double value_of(int k, double u)
{
    double sech = 1 / cosh(u);
    switch (k) {
    case 0: return exp(-u * u);
    case 1: return pow(2, -u * u);
    case 2: return pow(10, -u * u);
    case 3: return u * u * exp(-u * u);
    case 4: return exp(-fabs(u));
    case 5: return sech;
    case 6: return sech * sech;
    case 7: return (tanh(u + 3) - tanh(u - 3)) / 2;
    case 8: return 1 / (1 + exp(-u)) - 1 / (1 + exp(7 - u));
    default: return exp(-u * u) * (1 - tanh(u) * tanh(u) + sech * sech) / 2;
    }
}

static void integrals_are_right(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    enum { panels = 40000 };
    const double end = 50, h = 2 * end / panels;
    for (int k = 0; k < bell_count; k++) {
        double sum = 0;
        for (int i = 0; i < panels; i++) {
            double u = -end + i * h;
            sum += h / 6 * (value_of(k, u) + 4 * value_of(k, u + h / 2) + value_of(k, u + h));
        }
        check_close(&checks, bells[k].text, bells[k].integral, sum, 1e-7);
    }
    checks_end(&checks);
}

/* The text of a bell with its argument put in. */
static void put_in(const struct bell *bell, const char *argument, char *text)
{
    size_t length = 0;
    for (const char *c = bell->text; *c; c++)
        length += (size_t)snprintf(text + length, room - length, "%.*s",
                                   *c == '$' ? (int)strlen(argument) : 1, *c == '$' ? argument : c);
}

/* FBD_PULSES=100000 looks at that many of each kind. */
static int count_of(int usual)
{
    const char *wanted = getenv("FBD_PULSES");
    return wanted ? (int)strtol(wanted, NULL, 10) : draws_of(usual);
}

struct pulse {
    const struct bell *bell;
    double width, at, impulse; /* the impulse is that in time, the work that in place */
    const char *method;
};

static struct pulse draw(struct random_numbers *numbers)
{
    static const char *const methods[] = {"auto", "auto", "auto", "rk8pd", "rk8pd", "auto"};
    struct pulse pulse = {.bell = &bells[random_bits(numbers) % bell_count]};
    pulse.width = pow(10, random_between(numbers, -7, -1.5));
    pulse.at = random_between(numbers, 2, 8);
    pulse.impulse = random_between(numbers, -0.4, 2);
    pulse.method = methods[random_bits(numbers) % 6];
    return pulse;
}

/* Each body has 2 of mass or inertia and the speed 1. */
static struct trial pulse_trial(const struct pulse *pulse, const char *variable, const char *unit, int body)
{
    static const char *const bodies[] = {
        "mass: 2, motion: slide, initial: {v: 1}, forces: [applied: {name: p, value: \"%s\"}]",
        ("mass: 2, inertia: 2, motion: {pivot: {at: [0, 0]}}, initial: {omega: 1}, "
         "moments: [applied: {name: p, value: \"%s\"}]"),
        "mass: 2, motion: particle, initial: {vx: 1}, forces: [applied: {name: p, angle: 0, value: \"%s\"}]",
    };
    char argument[200], bell[room], value[2 * room], text[4 * room], whole[5 * room];
    snprintf(argument, sizeof argument, "(%s - %.17g[%s])/%.17g[%s]", variable, pulse->at, unit, pulse->width,
             unit);
    put_in(pulse->bell, argument, bell);
    snprintf(value, sizeof value, "%.17g*%s", pulse->impulse / pulse->width / pulse->bell->integral, bell);
    snprintf(text, sizeof text, bodies[body], value);
    snprintf(whole, sizeof whole,
             "fbd: 1\nbodies: {b: {%s}}\nsimulate: {until: 10, method: %s, tolerance: 1e-9}\n", text,
             pulse->method);
    return trial_parse(whole);
}

static double final_speed(struct trial *trial, int body)
{
    return trial_get(trial, body == 0 ? "b.v" : body == 1 ? "b.omega" : "b.vx");
}

/* The least by which numbers at `at` differ, as a share of the width, is what the pulse is known to. */
static double known_to(const struct pulse *pulse)
{
    double method = strcmp(pulse->method, "auto") == 0 ? 1e-7 : 2e-6;
    return method + 100 * 2e-16 * pulse->at / pulse->width;
}

static void pulses_in_time_are_met(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {7};
    for (int i = 0; i < count_of(300); i++) {
        struct pulse pulse = draw(&numbers);
        int body = (int)(random_bits(&numbers) % 3);
        struct trial trial = pulse_trial(&pulse, "t", "s", body);
        trial_run(&trial, NULL);
        check_close(&checks, pulse.bell->text, final_speed(&trial, body), 1 + pulse.impulse / 2,
                    known_to(&pulse));
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* What a formula of the time does to what rests: F(t) alone, against a damper, or at a spring; on a pivot; on a slide that
 * carries a pivot at its centre of mass; as the rate of a state. All have 2 of mass or inertia, and the state has half of F. */
enum waking { wakes_free, wakes_damped, wakes_spring, wakes_pivot, wakes_carrier, wakes_state, wakings };

static struct trial waking_trial(enum waking kind, const char *value, const char *method)
{
    static const char *const scenes[wakings] = {
        "bodies: {b: {mass: 2, motion: slide, forces: [applied: \"%s\"]}}",
        "bodies: {b: {mass: 2, motion: slide, forces: [applied: \"%s\", damper: 0.4]}}",
        "bodies: {b: {mass: 2, motion: slide, forces: [applied: \"%s\", spring: 8]}}",
        "bodies: {b: {mass: 2, inertia: 2, motion: {pivot: {at: [0, 0]}}, moments: [applied: \"%s\"]}}",
        ("bodies: {b: {mass: 1, motion: slide, forces: [applied: \"%s\"]}, c: {mass: 1, inertia: 1, motion: "
         "{pivot: {on: b}}}}"),
        "states: {speed: {rate: \"(%s)/2\"}}\nbodies: {b: {mass: 1, motion: slide}}",
    };
    char text[4 * room], whole[5 * room];
    snprintf(text, sizeof text, scenes[kind], value);
    snprintf(whole, sizeof whole, "fbd: 1\n%s\nsimulate: {until: 10, method: %s, tolerance: 1e-9}\n", text,
             method);
    return trial_parse(whole);
}

static const char *waking_speed(enum waking kind)
{
    return kind == wakes_pivot ? "b.omega" : kind == wakes_state ? "states.speed" : "b.v";
}

/* What follows each stair of a rounding takes hundreds of thousands. */
static void check_steps(struct checks *checks, const struct trial *trial)
{
    check_that(checks, "in few steps", fbd_simulation_stats(trial->simulation).steps < 20000);
}

/* The far end of a bell drives with 1e-300 N. The velocity after a blow of 2 at the middle of the bell; what its width
 * changes is of the order of (width/T)^2. */
static void pulses_wake_what_rests(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {20261127};
    for (int i = 0; i < count_of(150); i++) {
        struct pulse pulse = draw(&numbers);
        pulse.width = fmin(pulse.width, random_bits(&numbers) % 2 ? 1e-6 : 1e-4);
        enum waking kind = (enum waking)(random_bits(&numbers) % wakings);
        char argument[200], bell[room], value[2 * room];
        snprintf(argument, sizeof argument, "(t - %.17g[s])/%.17g[s]", pulse.at, pulse.width);
        put_in(pulse.bell, argument, bell);
        snprintf(value, sizeof value, "%.17g*%s", 2 / pulse.width / pulse.bell->integral, bell);
        struct trial trial = waking_trial(kind, value, pulse.method);
        trial_run(&trial, NULL);
        double left = 10 - pulse.at - (pulse.bell == &bells[8] ? 3.5 * pulse.width : 0);
        double v = kind == wakes_damped ? exp(-0.2 * left) : kind == wakes_spring ? cos(2 * left) : 1;
        check_close(&checks, pulse.bell->text, trial_get(&trial, waking_speed(kind)), v,
                    known_to(&pulse) + 20 * pulse.width * pulse.width);
        check_steps(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* F = 2 from `at` on, which comes within `width`: speeds by the integrals in closed form, of u/sqrt(1 + u^2) from t = 0. */
static void smooth_steps_wake_what_rests(void **unused)
{
    static const char *const steps[] = {"(1 + tanh($))/2", "1/(1 + exp(-($)))",
                                        "(1 + ($)/sqrt(1 + ($)^2))/2"};
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {20261128};
    for (int i = 0; i < count_of(100); i++) {
        struct pulse pulse = draw(&numbers);
        int step = (int)(random_bits(&numbers) % 3);
        enum waking kind = (enum waking)(random_bits(&numbers) % wakings);
        if (kind == wakes_damped || kind == wakes_spring) kind = wakes_free;
        char argument[200], smooth[room], value[2 * room];
        snprintf(argument, sizeof argument, "(t - %.17g[s])/%.17g[s]", pulse.at, pulse.width);
        put_in(&(struct bell){steps[step], 0}, argument, smooth);
        snprintf(value, sizeof value, "2*%s", smooth);
        struct trial trial = waking_trial(kind, value, pulse.method);
        trial_run(&trial, NULL);
        double w = pulse.width, after = (10 - pulse.at) / w, before = pulse.at / w, v = 10 - pulse.at;
        if (step == 0) v += w / 2 * (log1p(exp(-2 * after)) - log1p(exp(-2 * before)));
        if (step == 1) v += w * (log1p(exp(-after)) - log1p(exp(-before)));
        if (step == 2) v = (10 + w * (hypot(1, after) - hypot(1, before))) / 2;
        check_close(&checks, steps[step], trial_get(&trial, waking_speed(kind)), v, 10 * known_to(&pulse));
        check_steps(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* v^2 = 1 + W, with the mass 2; of the particle the work is not that of a potential, and the energy is to agree in any
 * case. */
static void pulses_in_place_are_met(void **unused)
{
    static const char *const places[] = {"x", "theta", "x"}, *const units[] = {"m", "rad", "m"};
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {8};
    for (int i = 0; i < count_of(300); i++) {
        struct pulse pulse = draw(&numbers);
        int body = (int)(random_bits(&numbers) % 3);
        struct trial trial = pulse_trial(&pulse, places[body], units[body], body);
        trial_run(&trial, NULL);
        check_close(&checks, pulse.bell->text, final_speed(&trial, body), sqrt(1 + pulse.impulse),
                    known_to(&pulse));
        double residual = fbd_result_energy(trial.result).residual;
        check_close(&checks, "energy", residual, 0,
                    fbd_result_residual_explained(trial.result) + known_to(&pulse));
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Two along a beam, one of them with ends, by their moment about where it turns. */
static void pulses_along_a_beam_are_met(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {9};
    for (int i = 0; i < count_of(200); i++) {
        struct pulse pulse = draw(&numbers);
        double start = random_between(&numbers, 1, 8), wide = pow(10, random_between(&numbers, -7, -1)),
               w = 3 / wide;
        char argument[200], bell[room], text[4 * room];
        snprintf(argument, sizeof argument, "(s - %.17g[m])/%.17g[m]", pulse.at, pulse.width);
        put_in(pulse.bell, argument, bell);
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies: {b: {mass: 1, inertia: 2, points: {A: [0, 0], B: [10, 0]}, motion: {pivot: "
                 "{at: [0, 0]}}, "
                 "forces: [distributed: {name: p, from: A, to: B, angle: 90 deg, value: \"%.17g*%s\"}, "
                 "distributed: {name: q, from: A, to: B, angle: 90 deg, value: \"%.17g*pulse(s, %.17g, "
                 "%.17g)\"}]}}\n"
                 "simulate: {until: 1}\n",
                 1 / pulse.width, bell, w, start, wide);
        struct trial trial = trial_parse(text);
        /* The middle of each bell; those of the window and of the logistic are 0 and 3.5. */
        double middle = pulse.at + (pulse.bell == &bells[8] ? 3.5 * pulse.width : 0);
        double moment = pulse.bell->integral * middle + 3 * (start + wide / 2);
        check_close(&checks, pulse.bell->text, 2 * trial_acceleration(&trial, "b.theta"), moment,
                    1e-7 * moment);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A rope that holds a block against a bell in place: accelerations are rounding, which is no reason for shorter steps. */
static void what_a_rope_holds_beside_a_bell_rests(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {19112513};
    for (int i = 0; i < draws_of(20); i++) {
        char text[room];
        double d[9];
        for (int k = 0; k < 9; k++) d[k] = random_between(&numbers, 0.5, 2);
        snprintf(
            text, sizeof text,
            "fbd: 1\nground: {points: {Q: [%.17g, %.17g], R: [%.17g, %.17g]}}\nbodies:\n"
            "  block: {mass: 1, motion: slide, initial: {x: -1}, forces: [applied: \"-%.17g - "
            "%.17g*exp(-((x - %.17g)/%.17g[m])^2)\"]}\n"
            "  drum: {mass: \"2 + 0.2*cos(%.17g*t)\", shape: disc, radius: 0.3, motion: {pivot: {at: [1, "
            "-1]}}}\n"
            "couplings: [rope: {through: [block, ground.Q, drum, ground.R]}]\nsimulate: {until: 1}\n",
            d[0], d[1], -d[2], -d[3], d[4], d[5], d[6], d[7], d[8]);
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_close(&checks, "x", trial_get(&trial, "block.x"), -1, 1e-12);
        check_that(&checks, "in few steps", fbd_simulation_stats(trial.simulation).steps < 100);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integrals_are_right),
        cmocka_unit_test(pulses_in_time_are_met),
        cmocka_unit_test(pulses_wake_what_rests),
        cmocka_unit_test(smooth_steps_wake_what_rests),
        cmocka_unit_test(pulses_in_place_are_met),
        cmocka_unit_test(pulses_along_a_beam_are_met),
        cmocka_unit_test(what_a_rope_holds_beside_a_bell_rests),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
