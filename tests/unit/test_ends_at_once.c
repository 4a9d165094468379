/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces and couplings whose conditions are exactly at their limits, or become true by another event, against closed
 * forms.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "run_checks.h"

/* A block of 2 kg is at the limit at t = 0 and passes it at once: 3 N act against 1 N for the whole run, or never. */
static void a_limit_is_passed_at_the_start(void **unused)
{
    static const struct {
        const char *start, *condition;
        double x, v;
    } scenes[] = {{"v: 1", "x > 0", 0, 1},
                  {"v: 1", "t > 0 s", 0, 1},
                  {"v: -1", "x < 0 m", 0, -1},
                  {"x: 0.3, v: 1", "x > 0.3", 0.3, 1},
                  {"x: 0", "v < 0", 0, 0}};
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        for (int ends = 0; ends < 2; ends++) {
            char text[text_room];
            snprintf(text, sizeof text,
                     "fbd: 1\nbodies: {b: {mass: 2, motion: slide, initial: {%s}, forces: [applied: -3 N, "
                     "applied: "
                     "{name: d, value: 1, %s: %s}]}}\nsimulate: {until: 1}\n",
                     scenes[i].start, ends ? "until" : "from", scenes[i].condition);
            const double a = ends ? -1.5 : -1;
            struct trial trial = run_of(text);
            check_close(&checks, "t",
                        trial_event(&trial, ends ? FBD_EVENT_FORCE_ENDS : FBD_EVENT_FORCE_BEGINS, "d", 0), 0,
                        same);
            check_close(&checks, "v", trial_get(&trial, "v"), scenes[i].v + a, same);
            check_close(&checks, "x", trial_get(&trial, "x"), scenes[i].x + scenes[i].v + a / 2, same);
            check_energy(&checks, &trial);
            trial_close(&trial);
        }
    checks_end(&checks);
}

/* x = t^2/4 leaves the limit without a rate: refused. */
static void a_limit_left_without_a_rate_is_refused(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial =
        run_of("fbd: 1\nbodies: {b: {mass: 2, motion: slide, forces: [applied: 1 N, applied: {name: d, "
               "value: -3, from: x > 0}]}}\nsimulate: {until: 1}\n");
    check_that(&checks, "broken", trial.outcome == FBD_BROKEN);
    check_that(&checks, "reason", strstr(fbd_simulation_reason(trial.simulation), "`x > 0` of `d`") != NULL);
    trial_close(&trial);
    checks_end(&checks);
}

/* A rod that begins at the start takes the velocity along it, 3/sqrt(10) of 1 m/s: its impact is before the start of
 * the energies. */
static void a_coupling_begins_at_the_start(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial =
        run_of("fbd: 1\nground: {points: {A: [3, 0]}}\nbodies: {b: {mass: 2, motion: particle, initial: "
               "{vx: 1, y: 1}}}\ncouplings: [rod: {name: c, between: [b, ground.A], from: b.x > 0}]\n"
               "simulate: {until: 1}\n");
    check_close(&checks, "kinetic", fbd_result_energy(trial.result).kinetic, 0.1, same);
    check_close(&checks, "work", fbd_result_work(trial.result, "b", "c"), 0, same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* The wind ends as the ball lands, by the reaction there: it has acted over t = sqrt(2 0.9/g). The states within the
 * step before that have its force, and no normal force. */
static void a_force_ends_at_a_landing(void **unused)
{
    const double t = sqrt(2 * 0.9 / g);
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse(
        "fbd: 1\nground: {lines: {floor: {along: 0 deg}}}\nbodies: {b: {mass: 1, shape: sphere, radius: 0.1, "
        "motion: "
        "planar, initial: {y: 1, vx: 1}, forces: [gravity, applied: {name: wind, value: [2, 0], until: "
        "c.normal > 1 "
        "N}]}}\ncontacts: [{name: c, between: [b, ground.floor], restitution: 0, static: 0, kinetic: 0}]\n"
        "simulate: {until: 2}\n");
    trial_run(&trial, NULL);
    check_close(&checks, "t", trial_event(&trial, FBD_EVENT_FORCE_ENDS, "wind", 0), t, same);
    check_close(&checks, "vx", trial_get(&trial, "vx"), 1 + 2 * t, same);
    check_close(&checks, "work", fbd_result_work(trial.result, "b", "wind"), 2 * (t + t * t), same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* A power ends at 20 m/s, and its division by v is none when the brake brings the body to rest. */
static void a_power_that_has_ended_divides_by_nothing(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial =
        run_of("fbd: 1\nbodies: {r: {mass: 1000, motion: slide, initial: {v: 1}, forces: [power: {name: "
               "e, value: 50 kW, until: v > 20}, applied: {name: br, value: -4000, from: v > 20, until: "
               "v < 0}]}}\nsimulate: {until: 12}\n");
    check_close(&checks, "t", trial_event(&trial, FBD_EVENT_FORCE_ENDS, "br", 0), 399 / 100.0 + 5, same);
    check_close(&checks, "v", trial_get(&trial, "v"), 0, same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* V = 50 x^2 of 1 kg until t = 1: x = 0.1 cos 10 t, and on with v = -sin 10; from t = 1 on: x = 0.1 cos 10(t - 1). On a
 * pivot as on a slide, and on a particle with V(x, y); also with another body on it. The energy V is that of the ledger. */
static void a_potential_begins_and_ends(void **unused)
{
    static const struct {
        const char *body, *x;
    } scenes[] = {
        {"motion: slide, initial: {x: 0.1}, forces: [potential: {name: p, V: 50*x^2, %s}]", "x"},
        {"motion: particle, initial: {x: 0.1}, forces: [potential: {name: p, V: 50*(x^2 + y^2), %s}]", "b.x"},
        {"inertia: 1 kg*m^2, motion: pivot, initial: {theta: 0.1}, moments: [potential: {name: p, V: "
         "50*theta^2, %s}]",
         "theta"},
        {"motion: slide, initial: {x: 0.1}, forces: [potential: {name: p, V: 50*x^2, %s}]}, c: {mass: 2, "
         "motion: "
         "{slide: {on: b, along: 90 deg}}",
         "b.x"}};
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        for (int ends = 0; ends < 2; ends++) {
            char body[text_room / 2], text[text_room];
            const double m = i == 3 ? 3 : 1, w = sqrt(100 / m), x = ends ? 0.1 * cos(w) : 0.1,
                         v = ends ? -0.1 * w * sin(w) : 0, V = 50 * x * x;
            snprintf(body, sizeof body, scenes[i].body, ends ? "until: t > 1" : "from: t > 1");
            snprintf(text, sizeof text,
                     "fbd: 1\nbodies: {b: {mass: 1, %s}}\nsimulate: {until: 2, tolerance: 1e-12}\n", body);
            struct trial trial = run_of(text);
            check_close(&checks, "x", trial_get(&trial, scenes[i].x), ends ? x + v : 0.1 * cos(w), 1e-8);
            check_close(&checks, "work", fbd_result_work(trial.result, "b", "p"),
                        ends ? 0.5 - V : V - 50 * pow(0.1 * cos(w), 2), 1e-8);
            check_energy(&checks, &trial);
            trial_close(&trial);
        }
    checks_end(&checks);
}

/* 2 N on 1 kg for the first second, or for the second one. */
static void a_load_along_a_line_begins_and_ends(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int ends = 0; ends < 2; ends++) {
        char text[text_room];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies: {b: {mass: 1, shape: rod, length: 1, motion: planar, forces: [distributed: "
                 "{from: "
                 "left, to: right, value: 2 N/m, angle: 90 deg, %s: t > 1 s}]}}\nsimulate: {until: 2}\n",
                 ends ? "until" : "since");
        struct trial trial = run_of(text);
        check_close(&checks, "y", trial_get(&trial, "b.y"), ends ? 3 : 1, same);
        check_close(&checks, "vy", trial_get(&trial, "b.vy"), 2, same);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_limit_is_passed_at_the_start),
        cmocka_unit_test(a_limit_left_without_a_rate_is_refused),
        cmocka_unit_test(a_coupling_begins_at_the_start),
        cmocka_unit_test(a_force_ends_at_a_landing),
        cmocka_unit_test(a_power_that_has_ended_divides_by_nothing),
        cmocka_unit_test(a_potential_begins_and_ends),
        cmocka_unit_test(a_load_along_a_line_begins_and_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
