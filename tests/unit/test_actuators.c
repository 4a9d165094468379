/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies on slides with friction, stops and winches, which motors, controllers, relays, tables, winds, loads along lines and masses
 * that vary drive (actuators.h), against a time stepping that knows no events (moreau.h). FBD_ACTUATORS=1000 tries so many;
 * stepped.h has the other variables.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "actuators.h"
#include "gallery.h"
#include "stepped.h"

static struct act_scene scene;
static const struct stepped_kind kind = {
    .name = "FBD_ACTUATORS",
    .scenes = 12,
    .scene = &scene,
    .until = &scene.until,
    .draw = act_draw,
    .write = act_write,
    .step = act_step_to,
};

static void time_stepping_says_the_same(void **unused)
{
    (void)unused;
    stepped_try(&kind);
}

/* Scenes that went wrong, and why. */
static void what_went_wrong_does_not(void **unused)
{
    static const unsigned seeds[] = {
        144, /* a block that slides on sign(x + T v) comes to the speed of its belt, which took it off the switch */
        609,   943, /* what sticks on a belt that shakes passes a switch: it stays there, and friction slips */
        436,   1265, /* an integral at its limit, a rounding before it */
        43,          /* a belt carries what sticks on it onto a switch, a rounding off it, and lets go */
        50205, 53485, 60645, /* a rope lets go of what a switch holds, beside friction */
    };
    (void)unused;
    stepped_try_each(&kind, seeds, sizeof seeds / sizeof *seeds);
}

/* z' = A sin(w t + p) + c within limits, by steps that are cut off there: it stands at one until its rate turns. */
static double limited_integral(double A, double w, double p, double c, double most, double until)
{
    enum { steps = 200000 };
    const double h = until / steps;
    double z = 0;
    for (int i = 0; i < steps; i++) z = fmin(fmax(z + h * (A * sin(w * (i + 0.5) * h + p) + c), -most), most);
    return z;
}

/* An integral that stands at its limit leaves it as what drives it turns, when its rate is rounding of either sign, and
 * stays there whatever else happens, as a force that is switched on and off. It comes to its limit to a rounding. */
static void a_limit_on_an_integral_is_left_as_its_rate_turns(void **unused)
{
    struct random_numbers numbers = {5};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 300; i++) {
        double A = random_between(&numbers, 0.1, 0.4), w = random_between(&numbers, 2, 12);
        double c = random_between(&numbers, -0.1, 0.1), most = random_between(&numbers, 0.005, 0.05);
        const char *strictly = random_bits(&numbers) % 2 ? "" : "=";
        char text[1200], e[200];
        snprintf(e, sizeof e, "(%.17g*sin(%.17g[1/s]*t + %.17g) + %.17g)/1[s]", A, w, 30 * c, c);
        snprintf(text, sizeof text,
                 "fbd: 1\nstates:\n  z: {unit: 1, rate: \"if(states.z >%s %.17g, min(%s, 0[1/s]), "
                 "if(states.z <%s -%.17g, max(%s, 0[1/s]), %s))\"}\n"
                 "bodies:\n  b: {mass: 1, motion: slide, forces: [applied: \"1[N]*states.z\", "
                 "applied: {name: hum, value: \"1[N]*step(sin(%.17g[1/s]*t))\"}]}\n"
                 "simulate: {until: 3}\n",
                 strictly, most, e, strictly, most, e, e, random_between(&numbers, 20, 60));
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        double z = trial_get(&trial, "states.z");
        check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
        check_close(&checks, "within its limits", fmax(0, fabs(z) - most), 0, 1e-12);
        check_close(&checks, "where steps come to", z, limited_integral(A, w, 30 * c, c, most, 3), 1e-7);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_limit_on_an_integral_is_left_as_its_rate_turns),
        cmocka_unit_test(what_went_wrong_does_not),
        cmocka_unit_test(time_stepping_says_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
