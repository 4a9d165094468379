/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The residual of the energy as a witness. A body is pushed in pulses, while a point of a rotor, which turns ever faster,
 * has a small velocity across. A step that goes over a pulse has no error that it could see; where the work is looked at
 * in the pulse the energy shows it. A run that is right is never accused.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "joined_checks.h"

struct rotor {
    double theta, omega, alpha, sharp, force;
};

static double pushed(const struct rotor *rotor, double t)
{
    double theta = rotor->theta + t * (rotor->omega + rotor->alpha * t / 2);
    double u = rotor->sharp * (rotor->omega + rotor->alpha * t) * cos(theta);
    return rotor->force * exp(-u * u);
}

/* v(1) of 1 kg: Simpson's rule, twenty panels in the shortest pulse. */
static double speed_after_a_second(const struct rotor *rotor)
{
    double rate = rotor->omega + rotor->alpha, width = 1 / (rate * (1 + rotor->sharp * rate));
    int panels = (int)(20 / width) + 1000;
    double h = 1.0 / panels, sum = 0;
    for (int i = 0; i < panels; i++)
        sum += pushed(rotor, i * h) + 4 * pushed(rotor, (i + 0.5) * h) + pushed(rotor, (i + 1) * h);
    return sum * h / 6;
}

/* With `ones` the pulse is multiplied by a table that is 1 everywhere: its points are found in the argument. */
static struct trial rotor_trial(const struct rotor *rotor, bool ones)
{
    static const char scene[] =
        "fbd: 1\n"
        "%s"
        "bodies:\n"
        "  rotor: {inertia: 1, mass: 1, points: {P: [1, 0]}, motion: {pivot: {at: [0, 0]}},\n"
        "    initial: {theta: \"%.17g[rad]\", omega: %.17g}, moments: [applied: {name: drive, value: "
        "%.17g}]}\n"
        "  block: {mass: 1, motion: {slide: {along: 0 deg}},\n"
        "    forces: [applied: {name: push, value: \"%.17g*exp(-(%.17g*rotor.P.vy/1[m/s])^2)%s\"}]}\n"
        "simulate: {until: 1}\n";
    static const char table[] =
        "tables: {ones: {points: [[-30, 1], [-8, 1], [-1, 1]], interpolation: cubic}}\n";
    char text[1024], factor[80] = "";
    if (ones) snprintf(factor, sizeof factor, "*ones(-(%.17g*rotor.P.vy/1[m/s])^2)", rotor->sharp);
    snprintf(text, sizeof text, scene, ones ? table : "", rotor->theta, rotor->omega, rotor->alpha,
             rotor->force, rotor->sharp, factor);
    return trial_parse(text);
}

static double drawn(uint64_t *seed, double from, double to)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return from + (to - from) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* Where the motion is wrong the energy says so, or does not; where it is right it never does. Returns how many runs are
 * wrong, and how many of these are told. */
static int draw(struct checks *checks, double least, double most, int count, bool ones, int *told)
{
    uint64_t seed = 20261124;
    int wrong = 0;
    for (int i = 0; i < count; i++) {
        struct rotor rotor = {drawn(&seed, -3, 3), drawn(&seed, 1, 20), drawn(&seed, 50, 100),
                              drawn(&seed, least, most), drawn(&seed, 1, 10)};
        struct trial trial = rotor_trial(&rotor, ones);
        trial_run(&trial, NULL);
        double residual = fbd_result_energy(trial.result).residual;
        bool is_told = fabs(residual) > fbd_result_residual_explained(trial.result);
        double v = speed_after_a_second(&rotor), error = fabs(trial_get(&trial, "block.v") - v);
        bool is_wrong =
            error > 1e-7 * rotor.force; /* a thousand tolerances, of the speed that the force gives at most */
        check_that(checks, "accused of what it is", is_wrong || !is_told);
        wrong += is_wrong;
        *told += is_told;
        trial_close(&trial);
    }
    return wrong;
}

static void the_energy_tells_of_pulses(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    int told = 0, wrong = draw(&checks, 0.1, 0.6, 30, false, &told);
    check_that(&checks, "some go over pulses, and some of these are told", wrong > 0 && told > 0);
    checks_end(&checks);
}

static void a_smooth_run_is_not_accused(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    int told = 0, wrong = draw(&checks, 1e-4, 3e-3, 20, false, &told);
    check_that(&checks, "all are right", wrong == 0);
    checks_end(&checks);
}

static void beside_a_table_of_ones_no_pulse_is_lost(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    int told = 0, wrong = draw(&checks, 0.1, 100, 10, true, &told);
    check_that(&checks, "all are right", wrong == 0);
    checks_end(&checks);
}

/* Held by a rod at the origin, where a rounding of its place is no share of that place. */
static void what_rests_at_the_origin_is_not_accused(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse("fbd: 1\nground: {points: {A: [-1, 0]}}\nbodies:\n  block:\n    mass: "
                                     "2\n    motion: slide\n    forces: [gravity, "
                                     "normal, friction: {coefficient: 0.3, surface_speed: "
                                     "\"1[m/s]*sin(3*t)\"}]\ncouplings: [rod: {between: "
                                     "[ground.A, block.G]}]\nsimulate: {until: 3 s}\n");
    trial_run(&trial, NULL);
    check_that(&checks, "no residual that is not explained",
               fabs(fbd_result_energy(trial.result).residual) <= fbd_result_residual_explained(trial.result));
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_energy_tells_of_pulses),
        cmocka_unit_test(a_smooth_run_is_not_accused),
        cmocka_unit_test(beside_a_table_of_ones_no_pulse_is_lost),
        cmocka_unit_test(what_rests_at_the_origin_is_not_accused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
