/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Belts, and ropes that rub on a drum, against solutions by hand.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "joined_checks.h"

static const double g = 9.81, pi = 3.141592653589793;

/* ---- belts */

static const char two_discs[] =
    "fbd: 1\n"
    "bodies:\n"
    "  motor: {shape: disc, mass: 1, radius: 0.05, motion: pivot, moments: [applied: {name: drive, value: "
    "%s}]}\n"
    "  fan: {shape: disc, mass: 4, radius: 0.15, motion: {pivot: {at: [0.5, 0.1]}}}\n"
    "couplings: [belt: {name: belt, between: [motor, fan], tension: 60, crossed: %s}]\n"
    "simulate: {until: 1}\n";

static struct trial belt_trial(const char *drive, bool crossed)
{
    char text[1024];
    snprintf(text, sizeof text, two_discs, drive, crossed ? "true" : "false");
    return trial_parse(text);
}

/* With the strands at +-gamma to the line of centres, sin(gamma) = (R +- r) / d, the axle bears T_1 + T_2 along it. */
static void a_belt_drives_in_the_ratio_of_its_discs(void **unused)
{
    (void)unused;
    const double r = 0.05, R = 0.15, I = r * r / 2, J = 4 * R * R / 2, M = 2, d = hypot(0.5, 0.1);
    const double alpha = M / (I + J * r * r / (R * R)), F = J * alpha * r / R / R;
    struct checks checks = {0};
    for (int crossed = 0; crossed < 2; crossed++) {
        struct trial trial = belt_trial("2 N*m", crossed);
        double c = sqrt(1 - pow((crossed ? R + r : R - r) / d, 2));
        trial_start(&trial, NULL);
        trial_to(&trial, 1);
        check_close(&checks, "motor", trial_get(&trial, "motor.theta"), alpha / 2, 1e-9);
        check_close(&checks, "fan", trial_get(&trial, "fan.omega"), (crossed ? -1 : 1) * alpha * r / R, 1e-9);
        fbd_arrow right = arrow_on(&trial, 0, "belt.right"), left = arrow_on(&trial, 0, "belt.left");
        fbd_arrow far = arrow_on(&trial, 1, "belt.left"), pin = arrow_on(&trial, 0, "pin");
        check_close(&checks, "slack strand", hypot(right.fx, right.fy), 60 - F / 2, 1e-10);
        check_close(&checks, "tight strand", hypot(left.fx, left.fy), 60 + F / 2, 1e-10);
        check_close(&checks, "one strand", hypot(left.fx + far.fx, left.fy + far.fy), 0, 1e-12);
        check_close(&checks, "moment", left.moment + right.moment, -F * r, 1e-12);
        check_close(&checks, "axle", -(pin.fx * 0.5 + pin.fy * 0.1) / d, 2 * 60 * c, 1e-10);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A disc that is welded to its shaft, itself by another: each weld bears both strands and the weights beyond it. */
static void a_weld_bears_both_strands(void **unused)
{
    (void)unused;
    static const char text[] =
        "fbd: 1\n"
        "bodies:\n"
        "  shaft: {shape: disc, mass: 1, radius: 0.02, motion: {pivot: {at: [0, 0]}}, forces: [gravity],\n"
        "    moments: [applied: {name: drive, value: 2 N*m}]}\n"
        "  hub: {shape: disc, mass: 2, radius: 0.03, motion: {weld: {on: shaft}}, forces: [gravity]}\n"
        "  motor: {shape: disc, mass: 3, radius: 0.05, motion: {weld: {on: hub}}, forces: [gravity]}\n"
        "  fan: {shape: disc, mass: 4, radius: 0.15, motion: {pivot: {at: [0.5, 0]}}, forces: [gravity]}\n"
        "couplings: [belt: {name: belt, between: [motor, fan], tension: 60}]\n"
        "simulate: {until: 1}\n";
    const double r = 0.05, R = 0.15, d = 0.5, pull = 2 * 60 * sqrt(1 - (R - r) * (R - r) / (d * d));
    const double I = (1 * 0.02 * 0.02 + 2 * 0.03 * 0.03 + 3 * r * r) / 2, J = 4 * R * R / 2;
    const double alpha = 2 / (I + J * r * r / (R * R)), F = J * alpha * r / R / R; /* tight less slack */
    const double across = F * (R - r) / d; /* strands lean by the sine of this */
    struct checks checks = {0};
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    fbd_arrow on_motor = arrow_on(&trial, 2, "weld"), on_hub = arrow_on(&trial, 1, "weld");
    check_close(&checks, "motor, along", on_motor.fx, -pull, 1e-10);
    check_close(&checks, "motor, up", on_motor.fy, 3 * g - across,
                1e-10); /* the upper strand is the tight one */
    check_close(&checks, "motor, moment", on_motor.moment, 3 * r * r / 2 * alpha + F * r, 1e-10);
    check_close(&checks, "hub, along", on_hub.fx, -pull, 1e-10);
    check_close(&checks, "hub, up", on_hub.fy, on_motor.fy + 2 * g, 1e-10);
    check_close(&checks, "hub, moment", on_hub.moment, on_motor.moment + 2 * 0.03 * 0.03 / 2 * alpha, 1e-10);
    trial_close(&trial);
    checks_end(&checks);
}

static void a_slack_strand_ends_the_run(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = belt_trial("\"40[N*m]*sin(3*t)\"", false);
    trial_start(&trial, NULL);
    double end = to_its_end(&trial);
    /* The difference of 120 N takes 7.5 N m. */
    check_that(&checks, "ends early", trial.outcome == FBD_BROKEN);
    check_close(&checks, "when", end, asin(7.5 / 40) / 3, 1e-10);
    check_that(&checks, "says so",
               strstr(fbd_simulation_reason(trial.simulation), "strand of the belt `belt` becomes slack") !=
                   NULL);
    trial_close(&trial);
    checks_end(&checks);
}

/* A weight that pulls a slider with the axle of a disc away: at rest both strands share it. */
static void a_tensioner_sets_the_tension(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "bodies:\n"
                    "  motor: {shape: disc, mass: 1, radius: 0.05, motion: pivot,\n"
                    "          moments: [applied: {name: drive, value: \"0.2[N*m]*sin(5*t)\"}]}\n"
                    "  slider: {mass: 2, motion: {slide: {through: [0.4, 0]}}, forces: [applied: {name: "
                    "pull, value: 50}]}\n"
                    "  fan: {shape: disc, mass: 4, radius: 0.15, motion: {pivot: {on: slider}}}\n"
                    "couplings: [belt: {name: belt, between: [motor, fan]}]\n"
                    "simulate: {until: 1}\n");
    const double I = 0.05 * 0.05 / 2, J = 4 * 0.15 * 0.15 / 2, c = sqrt(1 - 0.25 * 0.25);
    const double alpha = 0.2 * sin(5) / (I + J / 9), F = J * alpha / 3 / 0.15;
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    fbd_arrow right = arrow_on(&trial, 0, "belt.right"), left = arrow_on(&trial, 0, "belt.left");
    check_close(&checks, "slider", trial_get(&trial, "slider.x"), 0, 1e-12);
    check_close(&checks, "motor", trial_get(&trial, "motor.omega"), 0.2 * (1 - cos(5)) / 5 / (I + J / 9),
                1e-9);
    check_close(&checks, "both", hypot(right.fx, right.fy) + hypot(left.fx, left.fy), 50 / c, 1e-9);
    check_close(&checks, "difference", hypot(left.fx, left.fy) - hypot(right.fx, right.fy), F, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* Round a disc at rest of the same size, a disc on an arm never turns, however often the arm does. */
static void on_an_arm_a_belt_keeps_the_direction(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "bodies:\n"
        "  sun: {shape: disc, mass: 1, radius: 0.1, motion: {pivot: {theta: 0 rad}}}\n"
        "  arm: {shape: rod, mass: 1, length: 0.8, motion: {pivot: {point: left}}, initial: {omega: 9}}\n"
        "  planet: {shape: disc, mass: 2, radius: 0.1, motion: {pivot: {on: arm, at: right}},\n"
        "           initial: {omega: -9}}\n"
        "couplings: [belt: {name: belt, between: [sun, planet], tension: 200}]\n"
        "simulate: {until: 4}\n");
    trial_start(&trial, NULL);
    trial_to(&trial, 4);
    check_close(&checks, "arm", trial_get(&trial, "arm.theta"), 36, 1e-8);
    check_close(&checks, "planet", trial_get(&trial, "planet.theta"), -36, 1e-8);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- ropes that rub */

static const char two_weights[] =
    "fbd: 1\n"
    "ground: {points: {post: [0, 0]}}\n"
    "bodies:\n"
    "  light: {mass: 1, motion: {slide: {along: 90 deg, through: [-0.1, -2]}}, forces: [gravity]}\n"
    "  heavy: {mass: %s, motion: {slide: {along: 90 deg, through: [0.1, -2]}}, forces: [gravity]}\n"
    "couplings:\n"
    "  - rope: {name: cord, through: [light, ground.post, heavy],\n"
    "           around: {on: ground.post, radius: 0.1, static: 0.3, kinetic: 0.2}}\n"
    "simulate: {until: 1}\n";

static struct trial error_norm_trial(const char *heavy)
{
    char text[1024];
    snprintf(text, sizeof text, two_weights, heavy);
    return trial_parse(text);
}

/* Euler and Eytelwein: T_2 = T_1 exp(mu pi) while it slips. */
static void a_rope_slips_round_a_post(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const double E = exp(0.2 * pi), a = g * (3 - E) / (3 + E), T = g + a;
    struct trial trial = error_norm_trial("3");
    trial_run(&trial, NULL);
    check_close(&checks, "heavy", trial_get(&trial, "heavy.x"), -a / 2, 1e-10);
    check_close(&checks, "light", trial_get(&trial, "light.v"), a, 1e-10);
    check_close(&checks, "small tension", arrow_on(&trial, 0, "cord").fy, T, 1e-9);
    check_close(&checks, "large tension", arrow_on(&trial, 1, "cord").fy, T * E, 1e-9);
    fbd_energy energy = fbd_result_energy(trial.result);
    check_close(&checks, "lost", energy.work, -T * (E - 1) * a / 2, 1e-8);
    check_close(&checks, "residual", energy.residual, 0, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* It holds up to exp(mu_s pi) = 2.566 and not beyond; what holds does not creep. */
static void a_rope_holds_up_to_its_limit(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = error_norm_trial("2.56");
    trial_run(&trial, NULL);
    check_close(&checks, "at rest", trial_get(&trial, "heavy.x"), 0, 1e-13);
    check_close(&checks, "light", arrow_on(&trial, 0, "cord").fy, g, 1e-11);
    check_close(&checks, "heavy", arrow_on(&trial, 1, "cord").fy, 2.56 * g, 1e-11);
    trial_close(&trial);
    trial = error_norm_trial("2.57");
    trial_run(&trial, NULL);
    check_that(&checks, "slips", trial_get(&trial, "heavy.v") < -0.1);
    trial_close(&trial);
    checks_end(&checks);
}

static void a_barrel_is_let_down_round_a_bollard(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/capstan.yaml", NULL);
    const double beta = 2.5 * pi, F_0 = 37, T = 2, E = exp(0.3 * beta), t = 0.8;
    check_that(&checks, "too little to hold", F_0 < 60 * g * exp(-0.35 * beta));
    trial_run(&trial, NULL);
    /* (m + m_h E) a = m g - E F */
    double speed = 60 * g * t - E * F_0 * (t - t * t / 2 / T);
    check_close(&checks, "v", trial_get(&trial, "barrel.v"), -speed / (60 + 0.2 * E), 1e-9);
    fbd_arrow low = arrow_on(&trial, 0, "rope"), high = arrow_on(&trial, 1, "rope");
    check_close(&checks, "ratio", high.fy / low.fx, E, 1e-9);
    check_close(&checks, "residual", fbd_result_energy(trial.result).residual, 0, 1e-8);
    trial_close(&trial);
    checks_end(&checks);
}

/* The angle of contact goes with a load that swings: exact Jacobians, energy. */
static void methods_agree_on_a_load_that_swings_round_a_post(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    double first[2];
    for (int method = 0; method < 2; method++) {
        struct trial trial =
            trial_parse("fbd: 1\n"
                        "ground: {points: {post: [0, 0]}}\n"
                        "bodies:\n"
                        "  hand: {mass: 0.5, motion: {slide: {through: [-2, 0.1]}}, forces: [applied: {name: "
                        "hold, value: -2}]}\n"
                        "  load: {mass: 2, motion: particle, initial: {x: 0.6, y: -2}, forces: [gravity]}\n"
                        "couplings:\n"
                        "  - rope: {name: cord, through: [hand, ground.post, load],\n"
                        "           around: {on: ground.post, radius: 0.1, static: 0.35, kinetic: 0.25}}\n"
                        "simulate: {until: 0.7}\n");
        fbd_options options = FBD_OPTIONS_DEFAULT;
        options.method = method == 0 ? "dop853" : "rodas5p";
        trial_run(&trial, &options);
        fbd_arrow low = arrow_on(&trial, 0, "cord"), high = arrow_on(&trial, 1, "cord");
        /* The strand to the load is tangent to the post where it leaves it. */
        double angle = pi / 2 + atan2(high.fx, high.fy);
        check_close(&checks, "ratio", hypot(high.fx, high.fy) / hypot(low.fx, low.fy), exp(0.25 * angle),
                    1e-9);
        check_close(&checks, "residual", fbd_result_energy(trial.result).residual, 0, 1e-9);
        double values[2] = {trial_get(&trial, "load.x"), trial_get(&trial, "load.vy")};
        for (int i = 0; i < 2; i++) {
            if (method == 0) first[i] = values[i];
            check_close(&checks, "value", values[i], first[i], 1e-9);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Two weights over a post that fly up fall back on it: the blow is refused, and no event tells of one. */
static void a_jerk_round_a_post_is_refused(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "ground: {points: {post: [0, 1]}}\n"
                    "bodies:\n"
                    "  a: {mass: 1, motion: {slide: {along: 90 deg, through: [-0.1, 0]}}, initial: {v: 2}, "
                    "forces: [gravity]}\n"
                    "  b: {mass: 1, motion: {slide: {along: 90 deg, through: [0.1, 0]}}, initial: {v: 1}, "
                    "forces: [gravity]}\n"
                    "couplings:\n"
                    "  - rope: {name: cord, through: [a, ground.post, b], around: {on: ground.post, radius: "
                    "0.1, static: 0.35, kinetic: 0.3}}\n"
                    "simulate: {until: 1}\n");
    trial_start(&trial, NULL);
    double end = to_its_end(&trial);
    check_that(&checks, "it ends", trial.outcome == FBD_BROKEN);
    /* (2 + 1) t = g t^2 */
    check_close(&checks, "when", end, 3 / 9.81, 1e-9);
    check_that(&checks, "no blow", isnan(trial_event(&trial, FBD_EVENT_ROPE_TAUT, NULL, 0)));
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_belt_drives_in_the_ratio_of_its_discs),
        cmocka_unit_test(a_weld_bears_both_strands),
        cmocka_unit_test(a_slack_strand_ends_the_run),
        cmocka_unit_test(a_tensioner_sets_the_tension),
        cmocka_unit_test(on_an_arm_a_belt_keeps_the_direction),
        cmocka_unit_test(a_rope_slips_round_a_post),
        cmocka_unit_test(a_rope_holds_up_to_its_limit),
        cmocka_unit_test(a_barrel_is_let_down_round_a_bollard),
        cmocka_unit_test(methods_agree_on_a_load_that_swings_round_a_post),
        cmocka_unit_test(a_jerk_round_a_post_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
