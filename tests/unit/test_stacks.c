/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random stacks of boxes: they fall on each other, settle, and rest at no cost. What each presses on those below follows
 * from weights and levers; what the impacts take from the heights. FBD_STACK=50 has that many boxes fall.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { most_boxes = 60, room = 40000 };
static const double g = 9.81;

struct stack {
    int count;
    double m[most_boxes], a[most_boxes], b[most_boxes], x[most_boxes];
    double drops; /* of all weights together [J] */
};

/* One above the other, each apart from the one below by up to `gap`, narrow ones within the middle of wide ones. */
static void draw_stack(struct random_numbers *numbers, int count, double gap, double until,
                       struct stack *stack, char *text)
{
    double y = 0, fallen = 0;
    *stack = (struct stack){.count = count};
    int length = snprintf(text, room, "fbd: 1\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n");
    for (int i = 0; i < count; i++) {
        stack->m[i] = random_between(numbers, 0.5, 2);
        stack->a[i] = random_between(numbers, 0.8, 1.2);
        stack->b[i] = random_between(numbers, 0.2, 0.8);
        stack->x[i] = random_between(numbers, -0.05, 0.05);
        double apart = gap * random_between(numbers, 0.2, 1);
        fallen += apart;
        stack->drops += stack->m[i] * g * fallen;
        y += apart + stack->b[i];
        length += snprintf(text + length, (size_t)(room - length),
                           "  b%d: {shape: prism, a: %.17g, b: %.17g, c: 1, mass: %.17g, motion: planar, "
                           "initial: {x: %.17g, y: %.17g, theta: 0}, forces: [gravity]}\n",
                           i, stack->a[i], stack->b[i], stack->m[i], stack->x[i], y - stack->b[i] / 2);
    }
    length += snprintf(text + length, (size_t)(room - length), "contacts:\n");
    for (int i = 0; i < count; i++) {
        char with[20] = "ground.floor";
        if (i > 0) snprintf(with, sizeof with, "b%d", i - 1);
        length += snprintf(text + length, (size_t)(room - length),
                           "  - {name: c%d, between: [b%d, %s], static: 0.5, restitution: 0}\n", i, i, with);
    }
    snprintf(text + length, (size_t)(room - length), "simulate: {until: %.17g s}\n", until);
}

/* What comes from below, as a force and a moment about the origin. */
static void support(struct trial *trial, int body, double *force, double *moment)
{
    enum { most_arrows = 40 };
    char own[20];
    fbd_arrow arrows[most_arrows];
    size_t count = fbd_diagram(trial->state, (size_t)body, arrows, most_arrows);
    int length = snprintf(own, sizeof own, "c%d.normal", body);
    *force = *moment = 0;
    for (size_t i = 0; i < count; i++) {
        if (strncmp(arrows[i].name, own, (size_t)length) != 0) continue;
        *force += arrows[i].fy;
        *moment += arrows[i].x * arrows[i].fy;
    }
}

/* All above weighs on it, and where that weight is. */
static void check_supports(struct checks *checks, struct trial *trial, const struct stack *stack)
{
    double weight = 0, turning = 0;
    for (int i = stack->count - 1; i >= 0; i--) {
        double force, moment;
        weight += stack->m[i] * g;
        turning += stack->m[i] * g * stack->x[i];
        support(trial, i, &force, &moment);
        check_close(checks, "weight above", force, weight, 1e-9 * weight);
        check_close(checks, "its moment", moment, turning, 1e-9 * weight);
    }
}

static fbd_stats run_stack(struct checks *checks, const struct stack *stack, const char *text)
{
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    assert_int_equal(trial.outcome, FBD_DONE);
    fbd_energy energy = fbd_result_energy(trial.result);
    fbd_stats stats = fbd_simulation_stats(trial.simulation);
    check_close(checks, "at rest", energy.kinetic, 0, 1e-25);
    check_close(checks, "what has fallen", energy.initial_potential - energy.potential, stack->drops,
                1e-8 * (stack->drops + 1));
    check_supports(checks, &trial, stack);
    trial_close(&trial);
    return stats;
}

static void a_stack_settles_and_then_rests_at_no_cost(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int seed = 0; seed < draws_of(2); seed++) {
        unsigned long steps[2];
        for (int far = 0; far < 2; far++) {
            struct random_numbers numbers = {20261125u + (uint64_t)seed};
            struct stack stack;
            char text[room];
            draw_stack(&numbers, number_of("FBD_STACK", thorough() ? 12 : 6), 0.02, far ? 1e6 : 1, &stack,
                       text);
            steps[far] = run_stack(&checks, &stack, text).steps;
        }
        check_that(&checks, "a million seconds take no step more than one second", steps[1] <= steps[0] + 2);
    }
    checks_end(&checks);
}

static void fifty_boxes_at_rest_take_few_steps(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {7};
    struct stack stack;
    char text[room];
    draw_stack(&numbers, thorough() ? 50 : 20, 0, 1e6, &stack, text);
    check_that(&checks, "few steps", run_stack(&checks, &stack, text).steps < 10);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stack_settles_and_then_rests_at_no_cost),
        cmocka_unit_test(fifty_boxes_at_rest_take_few_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
