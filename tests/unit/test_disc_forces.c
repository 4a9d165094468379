/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dry friction of a rigid body at rest on several points of a plane: against the conditions of the minimum, and against the
 * loads at which the body begins to slip, which follow from a motion.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "numeric/disc_forces.h"
#include "random_numbers.h"

enum { most_points = 5 };

struct body {
    size_t count;
    double m, I, c[most_points];
    struct vec r[most_points];
};

struct forces {
    struct vec f[most_points], a[most_points]; /* and the accelerations with them */
    bool slips[most_points];
};

static struct body draw_body(struct random_numbers *numbers)
{
    struct body body = {.count = 1 + (size_t)random_between(numbers, 0, most_points - 1e-6)};
    body.m = random_between(numbers, 0.3, 3);
    body.I = body.m * random_between(numbers, 0.05, 0.5);
    for (size_t i = 0; i < body.count; i++) {
        body.c[i] = random_between(numbers, 0.1, 5);
        body.r[i] = (struct vec){random_between(numbers, -1, 1), random_between(numbers, -1, 1)};
    }
    return body;
}

static struct vec acceleration(const struct body *body, struct vec F, double M, size_t i)
{
    return vec_add(vec_scale(1 / body->m, F), vec_scale(M / body->I, vec_perp(body->r[i])));
}

static struct forces solve(const struct body *body, struct vec F, double M)
{
    enum { most = 2 * most_points };
    double W[most * most], b[most], room[4 * most_points * most_points + 8 * most_points];
    size_t pivot[most], n = 2 * body->count;
    struct forces forces = {0};
    for (size_t j = 0; j < n; j++) {
        const struct vec unit = {j % 2 == 0, j % 2 == 1};
        for (size_t i = 0; i < body->count; i++) {
            const struct vec a = acceleration(body, unit, vec_cross(body->r[j / 2], unit), i);
            W[2 * i * n + j] = a.x;
            W[(2 * i + 1) * n + j] = a.y;
        }
    }
    for (size_t i = 0; i < body->count; i++) {
        const struct vec a = acceleration(body, F, M, i);
        b[2 * i] = a.x;
        b[2 * i + 1] = a.y;
    }
    assert_true(disc_forces_room(body->count) <= sizeof room / sizeof *room);
    disc_forces_find(&(struct disc_problem){body->count, W, b, body->c, forces.f, forces.slips, room, pivot});
    for (size_t i = 0; i < body->count; i++) {
        F = vec_add(F, forces.f[i]);
        M += vec_cross(body->r[i], forces.f[i]);
    }
    for (size_t i = 0; i < body->count; i++) forces.a[i] = acceleration(body, F, M, i);
    return forces;
}

/* A point at rest has no acceleration; the force of one that slips is its limit against the acceleration. */
static void forces_are_those_of_the_minimum(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {7301};
    for (int draw = 0; draw < 1000; draw++) {
        const struct body body = draw_body(&numbers);
        const struct vec F = {random_between(&numbers, -9, 9), random_between(&numbers, -9, 9)};
        const double M = random_between(&numbers, -5, 5);
        const struct forces found = solve(&body, F, M);
        for (size_t i = 0; i < body.count; i++) {
            const double f = vec_norm(found.f[i]), a = vec_norm(found.a[i]);
            assert_true(f <= body.c[i] * (1 + 1e-11));
            if (found.slips[i])
                assert_true(fabs(f - body.c[i]) <= 1e-11 * f &&
                            fabs(vec_dot(found.f[i], found.a[i]) + f * a) <= 1e-8 * f);
            else
                assert_true(a <= 1e-8);
        }
    }
}

/* A motion v of the body has the friction -c_i u_i/|u_i| at velocities u_i of its points. Less than the opposite load lets the
 * body rest, more sets it in motion. */
static void a_body_slips_at_its_limit(void **unused)
{
    (void)unused;
    const double near = 1e-7;
    struct random_numbers numbers = {7302};
    for (int draw = 0; draw < 1000; draw++) {
        const struct body body = draw_body(&numbers);
        const struct vec V = {random_between(&numbers, -1, 1), random_between(&numbers, -1, 1)};
        const double omega = random_between(&numbers, -2, 2);
        struct vec F = {0, 0};
        double M = 0;
        for (size_t i = 0; i < body.count; i++) {
            const struct vec u = vec_add(V, vec_scale(omega, vec_perp(body.r[i])));
            const struct vec f = vec_scale(body.c[i] / vec_norm(u), u);
            F = vec_add(F, f);
            M += vec_cross(body.r[i], f);
        }
        const struct forces below = solve(&body, vec_scale(1 - near, F), (1 - near) * M),
                            above = solve(&body, vec_scale(1 + near, F), (1 + near) * M);
        for (size_t i = 0; i < body.count; i++) {
            const struct vec u = vec_add(V, vec_scale(omega, vec_perp(body.r[i])));
            assert_false(below.slips[i]);
            assert_true(above.slips[i]);
            assert_true(vec_dot(above.a[i], u) > 0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_are_those_of_the_minimum),
        cmocka_unit_test(a_body_slips_at_its_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
