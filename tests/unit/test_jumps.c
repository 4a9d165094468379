/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces that jump with the sign of a slip, beside friction: to hold what rests, or to drive it away.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

/* A force that jumps with the sign of the slip, by steps in which friction takes what it can: its place. */
struct jump {
    double m, mu, A, w, p, above, below, belt, v;
    bool or_equal; /* at v = belt what is above holds, else what is below */
};

static double stepped_place(const struct jump *jump, double until)
{
    enum { steps = 60000 };
    double h = until / steps, x = 0, u = jump->v - jump->belt, most = h * jump->mu * 9.81;
    for (int i = 0; i < steps; i++) {
        bool above = jump->or_equal ? u >= 0 : u > 0;
        double f = jump->A * sin(jump->w * (i + 0.5) * h + jump->p) + (above ? jump->above : jump->below),
               free = u + h * f / jump->m, next = free > most ? free - most : fmin(free + most, 0);
        if (u * next < 0) next = 0;
        x += h * ((u + next) / 2 + jump->belt);
        u = next;
    }
    return x;
}

/* Of attracting ones both branches hold what rests, of repelling ones the value there: on the ground, and jointed. */
static void what_rests_on_a_repelling_switch_has_its_value(void **unused)
{
    struct random_numbers numbers = {1693};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(60); i++) {
        struct jump j = {.or_equal = i % 2};
        double *parts[] = {&j.m, &j.mu, &j.A, &j.w, &j.p, &j.above, &j.below, &j.belt, &j.v};
        static const double low[] = {0.5, 0.1, 2, 3, -3, -2, -2, -0.5, -1},
                            high[] = {2, 0.5, 12, 10, 3, 2, 2, 0.5, 1};
        for (int k = 0; k < 9; k++) *parts[k] = random_between(&numbers, low[k], high[k]);
        char text[900];
        snprintf(
            text, sizeof text,
            "fbd: 1\nbodies: {b: {mass: %.17g, motion: {slide: {%s}}, initial: {v: %.17g}, forces: [gravity, "
            "normal, friction: {coefficient: %.17g, surface_speed: %.17g}, applied: {name: e, value: "
            "\"%.17g*sin(%.17g*t + %.17g)\"}, applied: {name: s, value: \"if(v >%s %.17g, %.17g, "
            "%.17g)\"}]}}\n"
            "simulate: {until: 1.5}\n",
            j.m, i % 3 ? "" : "max: 1000", j.v, j.mu, j.belt, j.A, j.w, j.p, j.or_equal ? "=" : "", j.belt,
            j.above, j.below);
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
        check_close(&checks, "where steps come to", trial_get(&trial, "b.x"), stepped_place(&j, 1.5), 1e-3);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_rests_on_a_repelling_switch_has_its_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
