/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Static friction at its limit: a block holds at exactly mu_s N and slips 1e-6 of it above, with mu_k from then on, and one that
 * needs a force between mu_k N and mu_s N holds: alone, and below a block that sticks, or slips, on it. Gravity is 10 m/s^2 and
 * masses are 1 kg, so that limits are round numbers.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

#include "gallery.h"
#include "holds/holds.h"

enum top { no_top, top_sticks, top_slips };

/* mu_s = 0.5, mu_k = 0.4 below. On the top one 5 N are more than 0.2 * 10 N, and 0.1 * 10 N rub. */
static void check_push(struct checks *checks, enum top top, double push, double a0, double a1)
{
    static const char *const tops[] = {"",
                                       "  b1: {mass: 1, motion: {slide: {on: b0}}, forces: [gravity, normal, "
                                       "friction: {static: 0.9, kinetic: 0.8}]}\n",
                                       "  b1: {mass: 1, motion: {slide: {on: b0}}, forces: [gravity, normal, "
                                       "friction: {static: 0.2, kinetic: 0.1}, applied: "
                                       "5 N]}\n"};
    char text[1000], label[100];
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: 10\nbodies:\n  b0: {mass: 1, motion: slide, forces: [gravity, normal, "
             "friction: {static: 0.5, "
             "kinetic: 0.4}, applied: %.17g]}\n%ssimulate: {until: 1}\n",
             push, tops[top]);
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    snprintf(label, sizeof label, "top %d, pushed by %.9g N", top, push);
    check_that(checks, label, trial.outcome == FBD_DONE && fbd_simulation_event_count(trial.simulation) == 0);
    check_close(checks, label, trial_get(&trial, "b0.v"), a0, 1e-9);
    if (top != no_top) check_close(checks, label, trial_get(&trial, "b1.v"), a1, 1e-9);
    trial_close(&trial);
}

static void a_block_holds_up_to_its_limit(void **unused)
{
    const double above = 1 + 1e-6;
    struct checks checks = {0};
    (void)unused;
    check_push(&checks, no_top, 4.5, 0, 0);
    check_push(&checks, no_top, 5, 0, 0);
    check_push(&checks, no_top, 5 * above, 5 * above - 4, 0);
    check_push(&checks, top_sticks, 9, 0, 0);
    check_push(&checks, top_sticks, 10, 0, 0);
    check_push(&checks, top_sticks, 10 * above, (10 * above - 8) / 2, 0);
    /* 1 N comes from the top one: 8.5 N of 10 N */
    check_push(&checks, top_slips, 7.5, 0, 4);
    checks_end(&checks);
}

/* The same of one hold by itself: 10 N keep it, 1e-6 more do not. */
static void a_hold_breaks_above_its_limit(void **unused)
{
    struct hold_problem problem;
    (void)unused;
    assert_true(holds_new(&problem, 1, 0));
    problem.A[0] = 1;
    problem.holds[0] =
        (struct hold){.kind = hold_friction, .free = 10, .mu_s = 10, .mu_k = 8, .press = press_constant};
    assert_int_equal(holds_decide(&problem), holds_decided);
    assert_true(problem.holds[0].mode == hold_keeps && fabs(problem.holds[0].force + 10) < 1e-14);
    problem.holds[0].free = 10.00001;
    assert_int_equal(holds_decide(&problem), holds_decided);
    assert_true(problem.holds[0].mode == hold_gives && problem.holds[0].force == -8);
    holds_free(&problem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_block_holds_up_to_its_limit),
                                       cmocka_unit_test(a_hold_breaks_above_its_limit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
