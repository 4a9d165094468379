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

#include "fbd_study.h"
#include "joined_checks.h"
#include "thorough.h"

/* Bells are found by the levels of exp. Powers of a cosine have none: steps go over them. */
enum shape { bell, power };

struct rotor {
    double theta, omega, alpha, sharp, force;
};

static double pushed(const struct rotor *rotor, enum shape shape, double t)
{
    double theta = rotor->theta + t * (rotor->omega + rotor->alpha * t / 2);
    double u = rotor->sharp * (rotor->omega + rotor->alpha * t) * cos(theta);
    return rotor->force * (shape == bell ? exp(-u * u) : pow(cos(u), 400));
}

/* v(1) of 1 kg: Simpson's rule, twenty panels in the shortest pulse. */
static double speed_after_a_second(const struct rotor *rotor, enum shape shape)
{
    double rate = rotor->omega + rotor->alpha, width = 1 / (rate * (1 + rotor->sharp * rate));
    int panels = (int)((shape == bell ? 20 : 400) / width) + 1000;
    double h = 1.0 / panels, sum = 0;
    for (int i = 0; i < panels; i++)
        sum += pushed(rotor, shape, i * h) + 4 * pushed(rotor, shape, (i + 0.5) * h) +
               pushed(rotor, shape, (i + 1) * h);
    return sum * h / 6;
}

static struct trial rotor_trial(const struct rotor *rotor, enum shape shape)
{
    static const char scene[] =
        "fbd: 1\n"
        "bodies:\n"
        "  rotor: {inertia: 1, mass: 1, points: {P: [1, 0]}, motion: {pivot: {at: [0, 0]}},\n"
        "    initial: {theta: \"%.17g[rad]\", omega: %.17g}, moments: [applied: {name: drive, value: "
        "%.17g}]}\n"
        "  block: {mass: 1, motion: {slide: {along: 0 deg}},\n"
        "    forces: [applied: {name: push, value: \"%.17g*%s\"}]}\n"
        "simulate: {until: 1}\n";
    char text[1024], pulse[200];
    const char *form =
        shape == bell ? "exp(-(%.17g*rotor.P.vy/1[m/s])^2)" : "pow(cos(%.17g*rotor.P.vy/1[m/s])^2, 200)";
    snprintf(pulse, sizeof pulse, form, rotor->sharp);
    snprintf(text, sizeof text, scene, rotor->theta, rotor->omega, rotor->alpha, rotor->force, pulse);
    return trial_parse(text);
}

static double drawn(uint64_t *seed, double from, double to)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return from + (to - from) * (double)(*seed >> 11) / 9007199254740992.0;
}

/* Where the motion is wrong the energy says so, or does not; where it is right it never does. Returns how many runs are
 * wrong, and how many of these are told. */
static int draw(struct checks *checks, double least, double most, int count, enum shape shape, int *told)
{
    uint64_t seed = 20261124;
    int wrong = 0;
    for (int i = 0; i < count; i++) {
        struct rotor rotor = {drawn(&seed, -3, 3), drawn(&seed, 1, 20), drawn(&seed, 50, 100),
                              drawn(&seed, least, most), drawn(&seed, 1, 10)};
        struct trial trial = rotor_trial(&rotor, shape);
        trial_run(&trial, NULL);
        double residual = fbd_result_energy(trial.result).residual;
        bool is_told = fabs(residual) > fbd_result_residual_explained(trial.result);
        double v = speed_after_a_second(&rotor, shape), error = fabs(trial_get(&trial, "block.v") - v);
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
    int told = 0, wrong = draw(&checks, 0.1, 0.6, draws_of(6), power, &told);
    check_that(&checks, "some go over pulses, and some of these are told",
               (wrong > 0 && told > 0) || !thorough());
    checks_end(&checks);
}

static void a_smooth_run_is_not_accused(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    int told = 0, wrong = draw(&checks, 1e-4, 3e-3, draws_of(4), bell, &told);
    check_that(&checks, "all are right", wrong == 0);
    checks_end(&checks);
}

static void no_bell_is_lost(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    int told = 0, wrong = draw(&checks, 0.1, 100, draws_of(2), bell, &told);
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

/* A particle passes a step of its potential, over 1e-7 m of its path where it is sharp: no step sees that. */
static double passed(struct checks *checks, const char *width, bool ask, bool right)
{
    char text[400];
    double residual = NAN, explained = NAN;
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: 0\nbodies:\n  b: {mass: 1, motion: slide, initial: {v: 10}, forces: "
             "[potential: {V: \"-1[J]*atan((x - 1[m])/%s)/pi\"}]}\nsimulate: {until: 1}\n",
             width);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    bool balanced = true;
    fbd_outcome outcome = FBD_GOING;
    while (outcome == FBD_GOING) {
        outcome = fbd_simulation_advance(trial.simulation);
        if (ask) balanced = fbd_simulation_balanced(trial.simulation, &residual, &explained);
    }
    check_that(checks, "it comes to its end", outcome == FBD_DONE);
    if (ask) {
        check_that(checks, "the energy tells which run is right", balanced == right);
        check_that(checks, "by its numbers", (fabs(residual) <= explained) == right);
        if (!right) check_close(checks, "what is missing", residual, -1, 1e-6);
    }
    double from, to;
    fbd_simulation_interval(trial.simulation, &from, &to);
    check_that(checks, "the end can be looked at", fbd_simulation_state(trial.simulation, to, trial.state));
    double v = trial_get(&trial, "b.v");
    trial_close(&trial);
    return v;
}

static void who_advances_by_steps_is_told(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    passed(&checks, "1e-7[m]", true, false);
    double v = passed(&checks, "0.1[m]", true, true);
    check_that(&checks, "to ask changes no bit", v == passed(&checks, "0.1[m]", false, true));
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_energy_tells_of_pulses),
        cmocka_unit_test(a_smooth_run_is_not_accused),
        cmocka_unit_test(no_bell_is_lost),
        cmocka_unit_test(what_rests_at_the_origin_is_not_accused),
        cmocka_unit_test(who_advances_by_steps_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
