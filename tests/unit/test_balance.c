/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A run is held to m a = sum of f and I alpha = sum of M: no right motion is taken for a wrong one, and what
 * is off by a part in a million is seen and named.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "dynamics/constraint.h"
#include "dynamics/modes.h"
#include "model/model.h"
#include "random_trees.h"
#include "rest/balance.h"
#include "scene_fixture.h"

#include <stdlib.h>

struct subject {
    fbd_model *model;
    struct fbd_state *state;
};

/* A random tree somewhere near its start, in motion. */
static struct subject subject_of(struct random_numbers *numbers)
{
    struct random_tree tree = {.bodies = 2 + (int)(random_bits(numbers) % 7),
                               .friction = random_bits(numbers) % 2 == 0,
                               .loops = (int)(random_bits(numbers) % 4)};
    char *text = random_tree_text(numbers, &tree);
    struct reading reading = read_right(text);
    struct subject subject = {.model = model_compile(reading.scene, reading.errors)};
    reading.scene = NULL;
    assert_non_null(subject.model);
    subject.state = state_new(subject.model);
    assert_non_null(subject.state);
    int n = subject.model->plan.n;
    for (int i = 0; i < 2 * n; i++) subject.state->y[i] += random_between(numbers, -1e-3, 1e-3);
    modes_settle(subject.state, NULL);
    end_reading(&reading);
    free(text);
    return subject;
}

static void release(struct subject *subject)
{
    state_free(subject->state);
    fbd_model_free(subject->model);
}

/* Slides that slip with friction: where there are two, the normal force of one may go with that of the other,
 * and modes that agree with the forces are not found at every place (tests/faults/holds). Those alarms are
 * right. */
static int slipping(const struct subject *subject)
{
    int count = 0;
    for (size_t i = 0; i < subject->model->plan.mode_count; i++)
        if (subject->model->plan.modes[i].normal_slot >= 0) count += subject->state->slip[i] != stick;
    return count;
}

static void random_trees_balance(void **unused)
{
    (void)unused;
    int alarms = 0;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        struct random_numbers numbers = {seed};
        struct subject subject = subject_of(&numbers);
        struct text lack = {0};
        if (balance_lack(subject.state, &lack) && slipping(&subject) < 2) {
            print_error("seed %d: %s\n", (int)seed, lack.data);
            alarms++;
        }
        text_free(&lack);
        release(&subject);
    }
    assert_int_equal(alarms, 0);
}

/* The jointed link that moves on from where the mechanics has it: its body, and whatever hangs on it, has
 * other accelerations than its forces make. */
static void a_millionth_is_noticed(void **unused)
{
    (void)unused;
    int missed = 0;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        struct random_numbers numbers = {seed};
        struct subject subject = subject_of(&numbers);
        struct fbd_state *state = subject.state;
        if (!subject.model->tree) {
            release(&subject);
            continue;
        }
        int link = 1 + (int)(random_bits(&numbers) % (unsigned)(subject.model->tree->count - 1));
        double most =
            1; /* the largest force there is, over the mass of the link: what it is a millionth of */
        for (int i = 1; i < subject.model->tree->count; i++)
            most = fmax(most, vec_norm(state->tree->links[i].F.force));
        for (int j = 0; j < subject.model->tree->row_count; j++)
            most = fmax(most, fabs(state->tree->rows[j].lambda));
        state->tree->links[link].A.a.x += 1e-6 * most / subject.model->tree->links[link].mass;
        struct text lack = {0};
        if (!balance_lack(state, &lack)) {
            print_error("seed %d: link %d\n", (int)seed, link);
            missed++;
        } else {
            assert_non_null(strstr(lack.data, "do not account for its motion: "));
        }
        text_free(&lack);
        release(&subject);
    }
    assert_int_equal(missed, 0);
}

static void what_is_not_a_number_is_off(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {7};
    struct subject subject = subject_of(&numbers);
    struct text lack = {0};
    subject.state->tree->links[1].A.a.y = NAN;
    assert_true(balance_lack(subject.state, &lack));
    text_free(&lack);
    release(&subject);
}

/* Is the scene held to be out of balance where all its coordinates and rates are `beside` the start? */
static bool raises_alarm(int scene, const char *text, double beside)
{
    struct reading reading = read_right(text);
    struct subject subject = {.model = model_compile(reading.scene, reading.errors)};
    reading.scene = NULL;
    assert_non_null(subject.model);
    subject.state = state_new(subject.model);
    assert_non_null(subject.state);
    for (int k = 0; k < 2 * subject.model->plan.n; k++) subject.state->y[k] += beside;
    modes_settle(subject.state, NULL);
    struct text lack = {0};
    bool alarm = balance_lack(subject.state, &lack);
    if (alarm) print_error("scene %d: %s\n", scene, lack.data);
    text_free(&lack);
    end_reading(&reading);
    release(&subject);
    return alarm;
}

/* A free body on a moving one has m a = 0 as a difference of accelerations that are none: what is left is
 * their rounding, and no force of its own is there to measure that against. */
static void free_bodies_on_moving_ones_balance(void **unused)
{
    (void)unused;
    static const char *const scenes[] = {
        "fbd: 1\ngravity: [0, 1]\nbodies:\n  a: {mass: 1, shape: rod, length: 1, motion: planar, "
        "initial: {omega: 1}}\n  b: {mass: 1.2, shape: disc, radius: 1, motion: {planar: {on: a}}, "
        "initial: {vy: %d}}\n",
        "fbd: 1\ngravity: [0, 1]\nbodies:\n  a: {mass: 1, motion: {slide: {along: 1.993}}, "
        "forces: [gravity]}\n  b:\n    parts: {p: {mass: 2}, q: {mass: 1.7, center: [0, -0.2]}}\n"
        "    motion: {planar: {on: a}}\n    initial: {theta: -%d.3 rad, omega: 1}\n",
    };
    int alarms = 0;
    for (int i = 0; i < 40; i++) {
        char text[600];
        snprintf(text, sizeof text, scenes[i % 2], i / 2);
        alarms += raises_alarm(i, text, 0.1 * i);
    }
    assert_int_equal(alarms, 0);
}

/* A body on which nothing acts goes straight on above a table that is driven: what the table's turning adds, from
 * its rate or from its square, is taken back by the acceleration on the table, whatever the speeds are. */
static void nothing_acts_above_a_table(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {1};
    int alarms = 0;
    for (int i = 0; i < 300; i++) {
        char text[600];
        bool rests = i % 3 == 0; /* in the world */
        double omega = i % 3 == 1 ? 0 : random_between(&numbers, -3, 3),
               alpha = rests ? 0 : random_between(&numbers, -3, 3);
        double x = random_between(&numbers, -1, 1), y = random_between(&numbers, -1, 1);
        double vx = rests ? omega * y : random_between(&numbers, -2, 2),
               vy = rests ? -omega * x : random_between(&numbers, -2, 2);
        snprintf(
            text, sizeof text,
            "fbd: 1\nbodies:\n  table: {mass: 1, inertia: 1, motion: {pivot: {theta: \"%.17g[rad/s]*t + "
            "%.17g[rad/s^2]*t^2/2\"}}}\n  b: {mass: %.17g, %smotion: {%s: {on: table}}, initial: {x: %.17g, "
            "y: %.17g, vx: %.17g, vy: %.17g}}\n",
            omega, alpha, random_between(&numbers, 0.3, 3), i % 2 ? "shape: disc, radius: 0.2, " : "",
            i % 2 ? "planar" : "particle", x, y, vx, vy);
        alarms += raises_alarm(i, text, 0);
    }
    assert_int_equal(alarms, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_trees_balance),        cmocka_unit_test(free_bodies_on_moving_ones_balance),
        cmocka_unit_test(nothing_acts_above_a_table),  cmocka_unit_test(a_millionth_is_noticed),
        cmocka_unit_test(what_is_not_a_number_is_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
