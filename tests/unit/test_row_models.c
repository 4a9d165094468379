/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that strike each other in rows, one scene each, against closed forms; test_rows.c has random ones.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "gallery.h"

/* A disc on a slope strikes three that touch, with v_n after = -0.9 v_n before, and these go on together. Their places are
 * rounded, but there is no way across their line, and no friction there. */
static void there_is_no_friction_across_a_slide(void **unused)
{
    static const char *const laws[2] = {"newton", "moreau"};
    const double m[2] = {2.8181311997336382, 0.48545927863000032}, v = 0.50429885839865074, e = 0.9,
                 together = m[0] + m[1] + 1, P = (1 + e) * v / (1 + 1 / together);
    struct checks checks = {0};
    (void)unused;
    for (int law = 0; law < 2; law++) {
        char text[1500];
        snprintf(
            text, sizeof text,
            "fbd: 1\nbodies:\n"
            "  b0: {shape: disc, radius: 0.22100665033844885, mass: 1, motion: {slide: {along: "
            "-1.3085464257359627}}, initial: {v: %.17g}}\n"
            "  b1: {shape: disc, radius: 0.083565125651902813, mass: %.17g, motion: {slide: {along: "
            "-1.3085464257359627}}, initial: {x: 0.30457177599035168}}\n"
            "  b2: {shape: disc, radius: 0.06436325441161371, mass: %.17g, motion: {slide: {along: "
            "-1.3085464257359627}}, initial: {x: 0.45250015605386817}}\n"
            "  b3: {shape: prism, a: 0.11474860722328981, b: 0.3455672920152385, mass: 1, motion: {slide: "
            "{along: -1.3085464257359627}}, initial: {x: 0.57423771407712676}}\ncontacts:\n"
            "  - {between: [b0, b1], restitution: %g, static: 0.4, law: %s}\n"
            "  - {between: [b1, b2], restitution: 0.1, static: 0.9}\n"
            "  - {between: [b2, b3], restitution: 0.1}\nsimulate: {until: 0.2}\n",
            v, m[0], m[1], e, laws[law]);
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_that(&checks, "it is done", trial.outcome == FBD_DONE);
        check_close(&checks, "b0", trial_get(&trial, "b0.v"), v - P, 1e-12);
        check_close(&checks, "b1", trial_get(&trial, "b1.v"), P / together, 1e-12);
        check_close(&checks, "b2", trial_get(&trial, "b2.v"), P / together, 1e-12);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Two rods strike the floor at once, each of which has a law of its own: as if it were alone. */
static void each_contact_has_its_law(void **unused)
{
    static const char *const laws[2] = {"poisson", "newton"};
    double omega[2][2];
    struct checks checks = {0};
    (void)unused;
    for (int both = 0; both < 2; both++)
        for (int one = 0; one < 2; one++) {
            char text[1200], name[12];
            int length =
                snprintf(text, sizeof text, "fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n");
            for (int i = 0; i < 2; i++)
                length +=
                    snprintf(text + length, sizeof text - (size_t)length,
                             "  b%d: {shape: rod, length: 1, mass: 1, motion: planar, forces: [gravity], "
                             "initial: {x: %d, y: %.17g, theta: 45 deg, vx: 2, vy: -3}}\n",
                             i, 3 * i, both || i == one ? sin(acos(-1) / 4) / 2 : 9);
            length += snprintf(text + length, sizeof text - (size_t)length, "contacts:\n");
            for (int i = 0; i < 2; i++)
                length +=
                    snprintf(text + length, sizeof text - (size_t)length,
                             "  - {between: [b%d, ground.floor], restitution: 0.5, static: 0.4, law: %s}\n",
                             i, laws[i]);
            snprintf(text + length, sizeof text - (size_t)length, "simulate: {until: 0.1}\n");
            struct trial trial = trial_parse(text);
            trial_run(&trial, NULL);
            snprintf(name, sizeof name, "b%d.omega", one);
            omega[both][one] = trial_get(&trial, name);
            trial_close(&trial);
        }
    for (int one = 0; one < 2; one++) check_close(&checks, laws[one], omega[1][one], omega[0][one], 1e-9);
    check_that(&checks, "the laws differ", fabs(omega[0][0] - omega[0][1]) > 1e-3);
    checks_end(&checks);
}

/* Two discs that touch fly into a wall that takes all of their motion: what each is left with is rounding, and nothing happens
 * from there on. */
static void what_comes_to_rest_in_turn_stays_so(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse(
        "fbd: 1\nground: {lines: {wall: {through: [0.10847565605447586, 0.55717274762081082], along: "
        "2.9493085670288655}}}\nbodies:\n"
        "  b0: {shape: disc, radius: 0.063110237060116051, mass: 3.6328090582482728, motion: planar,\n"
        "    initial: {vx: 0.31373412789280963, vy: 1.6114593118724256}}\n"
        "  b1: {shape: disc, radius: 0.22420481512144141, mass: 0.69217838286333522, motion: planar,\n"
        "    initial: {x: 0.05490630384566355, y: 0.28201992306945045, vx: 0.31373412789280963, vy: "
        "1.6114593118724256}}\ncontacts:\n"
        "  - {between: [b0, b1], restitution: 0.49625956108241814, law: moreau}\n"
        "  - {between: [b1, ground.wall], restitution: 0.23819820106685857, static: 0.68907668224065166, "
        "law: "
        "moreau}\nsimulate: {until: 2, tolerance: 1e-11, impacts: propagate}\n");
    trial_run(&trial, NULL);
    check_that(&checks, "it is done", trial.outcome == FBD_DONE);
    check_close(&checks, "b0", trial_get(&trial, "b0.vy"), 0, 1e-12);
    check_close(&checks, "b1", trial_get(&trial, "b1.vy"), 0, 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_is_no_friction_across_a_slide),
        cmocka_unit_test(each_contact_has_its_law),
        cmocka_unit_test(what_comes_to_rest_in_turn_stays_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
