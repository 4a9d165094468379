/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A spring of 1e8 N/m beside one of 1 N/m, with a critical damper and without.
 *
 * What makes it hard: time scales of 1e-4 s and 1 s. With the damper the fast one is gone at once, and only a
 * stiff method may then forget it; an explicit one stays at its stability limit. Without it nothing is
 * forgotten: whatever moves at 1e4 rad/s is followed by every method, since each component is held to a
 * tolerance relative to its own size, and a moves by 1e-8 m.
 *
 * Reference: the matrix exponential of the four equations, by eigenvalues with 60 digits (mpmath).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

#include <limits.h>
#include <string.h>

struct motion {
    const char *name;
    const char *const *settings;
    double until, a, b, size_a;
    int least_order;      /* of the methods that take part */
    double low_estimates; /* by how much those of msbdf and bsimp are low */
};

static void check_motion(struct checks *checks, const struct motion *motion, unsigned long most_implicit)
{
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        if (method.order < motion->least_order) continue;
        struct trial trial = trial_open("hard/stiff_springs.yaml", motion->settings);
        hard_start(&trial, &method, motion->until);
        if (hard_done(checks, &trial)) {
            double a = fabs(trial_get(&trial, "a.x") - motion->a) / motion->size_a;
            double b = fabs(trial_get(&trial, "b.x") - motion->b), promise = hard_promise(&trial);
            unsigned long steps = fbd_simulation_stats(trial.simulation).steps;
            printf("# %s:\n", motion->name);
            bool low =
                method.name && (strcmp(method.name, "msbdf") == 0 || strcmp(method.name, "bsimp") == 0);
            hard_case(checks, &trial, "  a, relative to its size", a,
                      low ? motion->low_estimates * promise : promise);
            hard_case(checks, &trial, "  b", b, promise);
            check_that(checks, "a stiff method takes steps that fit the slow motion",
                       !method.implicit || steps <= most_implicit);
        }
        trial_close(&trial);
    }
}

/* Explicit methods need 1e4/s times 10 s over their stability interval, some 2e4 steps; implicit Euler is
 * limited by its order instead. */
static void with_a_damper(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const struct motion motion = {"with damper, 10 s",   NULL, 10, -8.39180326914601004e-9,
                                  -0.839071556268571443, 1e-8, 2,  1};
    check_motion(&checks, &motion, 4000);
    checks_end(&checks);
}

/* 160 vibrations of a with 1 mm. */
static void without_a_damper_and_in_fast_motion(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const struct motion motion = {"without damper, fast motion, 0.1 s",
                                  SET("c=0", "xa=1e-3"),
                                  0.1,
                                  5.62379268178174065e-4,
                                  0.995004165332268723,
                                  1e-3,
                                  2,
                                  1};
    check_motion(&checks, &motion, ULONG_MAX);
    checks_end(&checks);
}

/* a starts at rest 1e-8 m from its balance and vibrates with that for ever, in a motion of 2e-8 m. In 1600
 * vibrations of constant size the errors of all steps add up with one sign, so that what an estimate is low
 * by shows in full: msbdf has some 100 steps in a vibration and bsimp 3, and both compare results of
 * different orders, as if the higher one were exact. Theirs are low by a factor of two to six. */
static void without_a_damper_and_in_slow_motion(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const struct motion motion = {"without damper, slow motion, 1 s",
                                  SET("c=0"),
                                  1,
                                  1.49244239642476232e-8,
                                  0.540302310075494496,
                                  2e-8,
                                  4,
                                  6};
    check_motion(&checks, &motion, ULONG_MAX);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(with_a_damper),
        cmocka_unit_test(without_a_damper_and_in_fast_motion),
        cmocka_unit_test(without_a_damper_and_in_slow_motion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
