/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Holds that depend on each other, decided by pivoting, against all modes tried one after the other.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "holds_by_modes.h"
#include "random_numbers.h"

enum { most_holds = 6, most_guides = 2, freedom = 8 };

/* Bodies with `freedom` coordinates, holds along random directions, and guides whose force answers to
 * whatever the holds do. */
static void fill(struct random_numbers *numbers, struct hold_problem *problem)
{
    double J[most_holds][freedom], a[freedom];
    size_t n = problem->count;
    for (size_t l = 0; l < freedom; l++) a[l] = random_between(numbers, -1, 1);
    for (size_t i = 0; i < n; i++) {
        struct hold *hold = &problem->holds[i];
        for (size_t l = 0; l < freedom; l++) J[i][l] = random_between(numbers, -1, 1);
        bool friction = i > 0 && random_between(numbers, 0, 1) < 0.6;
        hold->kind = friction ? hold_friction : hold_one_sided;
        for (size_t l = 0; l < freedom; l++) hold->free += J[i][l] * a[l];
        if (!friction) continue;
        hold->mu_s = hold->mu_k = random_between(numbers, 0, 0.5);
        hold->press = press_constant;
        if (problem->holds[i - 1].kind == hold_one_sided) {
            hold->press = press_hold;
            hold->presses = (int)i - 1;
        } else if (problem->guide_count > 0) {
            hold->press = press_guide;
            hold->presses = (int)random_between(numbers, 0, (double)problem->guide_count);
        }
        if (random_between(numbers, 0, 1) < 0.3) hold->slip = random_between(numbers, -1, 1) < 0 ? -1 : 1;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            for (size_t l = 0; l < freedom; l++) problem->A[i * n + j] += J[i][l] * J[j][l];
    for (size_t g = 0; g < problem->guide_count; g++) {
        problem->guides[g].free = random_between(numbers, -1, 1);
        problem->guides[g].two_sided = random_between(numbers, -1, 1) < 0;
        for (size_t j = 0; j < n; j++) problem->B[g * n + j] = random_between(numbers, -0.3, 0.3);
    }
}

static void what_is_decided_is_the_solution(void **unused)
{
    (void)unused;
    int several = 0, decided = 0;
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        struct random_numbers numbers = {seed};
        struct hold_problem problem;
        double c[most_holds] = {0};
        assert_true(holds_new(&problem, 1 + (size_t)random_between(&numbers, 0, most_holds),
                              (size_t)random_between(&numbers, 0, most_guides + 1)));
        fill(&numbers, &problem);
        enum holds_found found = holds_decide(&problem);
        for (size_t i = 0; i < problem.count; i++) c[i] = problem.holds[i].c;
        int solutions = holds_by_modes(&problem);
        if (solutions == 0 && found != holds_none) fail_msg("seed %d: %d, but none exists", (int)seed, found);
        if (solutions > 0 && found == holds_none)
            fail_msg("seed %d: none, but %d exist", (int)seed, solutions);
        several += solutions > 1;
        decided += found == holds_decided;
        for (size_t i = 0; solutions == 1 && i < problem.count; i++)
            if (!(fabs(c[i] - problem.holds[i].c) < 1e-7))
                fail_msg("seed %d: hold %zu accelerates by %g, not %g", (int)seed, i, c[i],
                         problem.holds[i].c);
        holds_free(&problem);
    }
    assert_true(decided > 2500);
    assert_true(several < 300);
}

/* Painleve's rod: N answers to its own friction by 1 + s, s < -1; nothing agrees with N_0 > 0, two
 * accelerations do with N_0 < 0. */
static void painleves_paradox_is_told(void **unused)
{
    (void)unused;
    for (int side = -1; side <= 1; side += 2) {
        struct hold_problem problem;
        assert_true(holds_new(&problem, 1, 1));
        problem.holds[0] = (struct hold){
            .kind = hold_friction, .free = 1, .mu_s = 2, .mu_k = 2, .press = press_guide, .slip = -1};
        problem.guides[0] = (struct hold_guide){.free = side * 10.0};
        problem.A[0] = 1;
        problem.B[0] = 0.7;
        assert_int_equal(holds_decide(&problem), side > 0 ? holds_none : holds_several);
        holds_free(&problem);
    }
}

/* A block on two feet, pushed at its floor by 20 N of 24.5 + 24.5: the feet are redundant. */
static void redundant_feet_hold(void **unused)
{
    (void)unused;
    struct hold_problem problem;
    assert_true(holds_new(&problem, 2, 0));
    for (int i = 0; i < 2; i++)
        problem.holds[i] = (struct hold){
            .kind = hold_friction, .free = 2, .mu_s = 14.5, .mu_k = 12, .press = press_constant};
    for (int i = 0; i < 4; i++) problem.A[i] = 0.1;
    assert_int_equal(holds_decide(&problem), holds_decided);
    assert_true(fabs(problem.holds[0].force + problem.holds[1].force + 20) < 1e-12);
    assert_true(problem.holds[0].mode == hold_keeps && problem.holds[1].mode == hold_keeps);
    problem.holds[0].free = problem.holds[1].free = 3; /* 30 N are too much */
    assert_int_equal(holds_decide(&problem), holds_decided);
    assert_true(problem.holds[0].mode == hold_gives && problem.holds[1].mode == hold_gives);
    assert_true(fabs(problem.holds[0].c - 0.6) < 1e-12);
    holds_free(&problem);
}

/* ---- more than can be tried */

enum { many_points = 14, many_bodies = 5, many = 2 * many_points, many_freedom = 3 * many_bodies };

/* The forces of a pile that keeps still, or slips at even speed: many of them nothing, or at their limits. */
static void draw_forces(struct random_numbers *numbers, struct hold *normal, struct hold *along)
{
    double share = random_between(numbers, -1.5, 1.5);
    normal->force = random_between(numbers, 0, 1) < 0.4 ? 0 : exp(random_between(numbers, -3, 3));
    along->mu_s = along->mu_k = random_between(numbers, 0.2, 0.9);
    if (random_between(numbers, 0, 1) < 0.2) along->slip = share < 0 ? -1 : 1;
    if (along->slip != 0) share = -along->slip;
    along->force = along->mu_s * normal->force * fmax(-1, fmin(1, share));
}

/* Points at which two bodies of several, or one and the ground, touch with friction, by twos on one face, so that they slip
 * alike: more of them than the bodies have freedom, and what is redundant is so to rounding only. Accelerations without
 * forces are those for which the drawn forces are a solution. */
static void touch_at_many_points(struct random_numbers *numbers, struct hold_problem *problem)
{
    const double rounding = 1e-13;
    double J[many][many_freedom] = {{0}}, a[many_freedom] = {0};
    for (int i = 0; i < many; i++) {
        struct hold *hold = &problem->holds[i];
        int body = i / 4 % many_bodies, other = body - (i < 4 * many_bodies ? 1 : 2);
        bool twin = i % 4 == 3;
        if (i % 2 == 1) {
            hold->kind = hold_friction;
            hold->press = press_hold;
            hold->presses = i - 1;
            draw_forces(numbers, hold - 1, hold);
        }
        for (int l = 0; l < 6; l++) {
            int column = 3 * (l < 3 ? body : other) + l % 3;
            if (l >= 3 && other < 0) continue;
            J[i][column] = twin ? J[i - 2][column] * (1 + rounding * random_between(numbers, -1, 1))
                                : random_between(numbers, -1, 1);
        }
    }
    for (int i = 0; i < many; i++)
        for (int l = 0; l < many_freedom; l++) a[l] -= J[i][l] * problem->holds[i].force;
    for (int i = 0; i < many; i++)
        for (int l = 0; l < many_freedom; l++) problem->holds[i].free += J[i][l] * a[l];
    for (int i = 0; i < many; i++)
        for (int j = 0; j < many; j++)
            for (int l = 0; l < many_freedom; l++) problem->A[i * many + j] += J[i][l] * J[j][l];
}

/* By how much the laws are broken, by forces alone. */
static double broken(const struct hold_problem *problem)
{
    double worst = 0;
    for (int i = 0; i < many; i++) {
        const struct hold *hold = &problem->holds[i];
        double c = hold->free, f = hold->force;
        for (int j = 0; j < many; j++) c += problem->A[i * many + j] * problem->holds[j].force;
        if (i % 2 == 0) {
            worst = fmax(worst, fmax(fmax(-f, -c), fmin(f, c)));
            continue;
        }
        double limit = hold->mu_s * fmax(0, problem->holds[i - 1].force);
        worst = fmax(worst, fabs(f) - limit);
        if (hold->slip != 0) worst = fmax(worst, fabs(f + hold->slip * limit));
        if (hold->slip == 0) worst = fmax(worst, fmin(fabs(c), fabs(f + copysign(limit, c))));
    }
    return worst;
}

/* There are some by the way that problems are made; with friction nothing finds them always. */
static void of_many_forces_are_found(void **unused)
{
    enum { count = 2000 };
    int lost = 0;
    (void)unused;
    for (uint64_t seed = 1; seed <= count; seed++) {
        struct random_numbers numbers = {seed};
        struct hold_problem problem;
        double size = 1;
        assert_true(holds_new(&problem, many, 0));
        touch_at_many_points(&numbers, &problem);
        enum holds_found found = holds_decide(&problem);
        for (int i = 0; i < many; i++) size = fmax(size, fabs(problem.holds[i].force));
        if (found != holds_decided)
            lost++;
        else if (broken(&problem) > 1e-8 * size)
            fail_msg("seed %d: laws are broken by %g", (int)seed, broken(&problem));
        holds_free(&problem);
    }
    print_message("# none found for %d of %d\n", lost, count);
    assert_true(100 * lost < count);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_decided_is_the_solution),
        cmocka_unit_test(painleves_paradox_is_told),
        cmocka_unit_test(redundant_feet_hold),
        cmocka_unit_test(of_many_forces_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
