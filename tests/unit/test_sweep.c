/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The rows of a sweep: what they show, and that nothing changes them.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gsl/gsl_errno.h>

#include "fbd_study.h"
#include "fbd_workers.h"
#include "sweep_table.h"

static void rows_show_what_happened(void **state)
{
    (void)state;
    /* From y = h up and down to h - 1: top at 4/g and h + 16/(2 g); land at (4 + sqrt(16 + 2 g))/g. The
     * tolerance of a step is 1e-10, and the motion is a polynomial that dop853 integrates exactly. */
    const double g = 9.81, land = (4 + sqrt(16 + 2 * g)) / g, tolerance = 1e-12;
    struct sweep_table table =
        sweep_of(projectile, TEXTS("h=0,7"),
                 TEXTS("t,ball.x,max(ball.y)", "min(ball.y),max(ball.vy),time(top),time(land),count(land),"
                                               "energy.kinetic,ball.gravity.work,time(stick)"));
    for (size_t i = 0; i < 2; i++) {
        double h = i ? 7 : 0;
        const double want[] = {land, 3 * land, h + 8 / g, h - 1, 4, 4 / g, land, 1, 0.5 * 2 * 25 + 2 * g,
                               2 * g};
        for (size_t k = 0; k < sizeof want / sizeof *want; k++)
            assert_true(fabs(number(&table, i, 2 + k) - want[k]) <= tolerance * fmax(1, fabs(want[k])));
        assert_field(&table, i, 12, "");
        assert_field(&table, i, 13, "2");
        assert_field(&table, i, 14, "stopped");
        assert_field(&table, i, 15, "");
    }
    close_table(&table);
}

static void the_amplitude_of_a_pendulum_is_found_between_the_steps(void **state)
{
    (void)state;
    static const char pendulum[] = "fbd: 1\n"
                                   "parameters: {start: 1 rad}\n"
                                   "bodies:\n"
                                   "  p:\n"
                                   "    parts: {bob: {mass: 1, center: [0, -1]}}\n"
                                   "    motion: {pivot: {at: [0, 0]}}\n"
                                   "    initial: {theta: start}\n"
                                   "    forces: [gravity]\n"
                                   "simulate: {until: 20 s}\n";
    struct sweep_table table =
        sweep_of(pendulum, TEXTS("start=0.1,1,2,3"), TEXTS("min(theta),max(theta),max(omega)"));
    for (size_t i = 0; i < 4; i++) {
        /* Without loss it swings as far on the other side, and below omega^2/2 = g/l (1 - cos(start)). Near
         * the top an error of the step, 1e-10, grows by the long time there. */
        double start = number(&table, i, 1), tolerance = 1e-7;
        assert_true(fabs(number(&table, i, 2) + start) <= tolerance);
        assert_true(fabs(number(&table, i, 3) - start) <= tolerance);
        assert_true(fabs(number(&table, i, 4) - sqrt(2 * 9.81 * (1 - cos(start)))) <= tolerance);
    }
    close_table(&table);
}

static void a_point_moves_with_the_dimensions_of_its_body(void **state)
{
    (void)state;
    static const char pendulum[] =
        "fbd: 1\n"
        "parameters: {l: 1 m}\n"
        "bodies:\n"
        "  p:\n"
        "    {mass: 1, center: [0, -l], points: {tip: [0, -2*l]}, forces: [gravity],\n"
        "     motion: {pivot: {at: [0, 0]}}, initial: {theta: 60 deg}}\n"
        "simulate: {until: 20 s, events: [{name: low, when: theta = 0}]}\n";
    struct sweep_table table =
        sweep_of(pendulum, TEXTS("l=0.5,1,2"),
                 TEXTS("max(p.G.x),max(p.tip.x),at(low,p.tip.y),min(p.O.y),max(p.G.proper_ay)"));
    for (size_t i = 0; i < 3; i++) {
        /* The amplitude is the start; at the lowest point omega^2 = g/l, so a - g = 2 g. */
        const double l = number(&table, i, 1), tolerance = 1e-7;
        const double want[] = {l * sqrt(3) / 2, l * sqrt(3), -2 * l, 0, 2 * 9.81};
        for (size_t k = 0; k < sizeof want / sizeof *want; k++)
            assert_true(fabs(number(&table, i, 2 + k) - want[k]) <= tolerance * fmax(1, fabs(want[k])));
    }
    close_table(&table);
}

static void runs_that_fail_are_rows_and_stop_no_others(void **state)
{
    (void)state;
    static const char lost[] = "fbd: 1\n"
                               "parameters: {m: 2 kg, lift: 10 N}\n"
                               "bodies:\n"
                               "  block:\n"
                               "    mass: m\n"
                               "    motion: slide\n"
                               "    initial: {x: 1, v: -1}\n"
                               "    forces:\n"
                               "      - gravity\n"
                               "      - normal\n"
                               "      - applied: {name: up, value: lift, angle: 90 deg}\n"
                               "      - applied: {name: pull, value: '-1[N*m^2]/x^2'}\n"
                               "simulate: {until: 0.1 s}\n";
    struct sweep_table table = sweep_of(lost, TEXTS("m=-1,2", "lift=10,30"), NULL);
    assert_int_equal(table.end, FBD_SWEEP_DONE);
    assert_int_equal(table.counts.written, 4);
    assert_int_equal(table.counts.failed, 3);
    assert_field(&table, 0, 7, "wrong");
    assert_field(&table, 0, 3, "");
    assert_non_null(strstr(table.rows.data, "test.yaml:5:11: the `mass` of a body cannot be below zero"));
    assert_field(&table, 2, 7, "done");
    assert_field(&table, 3, 7, "broken");
    close_table(&table);
    fbd_sweep_plan plan = plan_of(TEXTS("lift=0,1"), NULL);
    const fbd_options into_the_singularity = {.until = 5}; /* at x = 0 */
    plan.run = &into_the_singularity;
    table = sweep_by(lost, &plan, 0, 1);
    assert_int_equal(table.counts.failed, 2);
    assert_field(&table, 0, 6, "failed");
    close_table(&table);
}

static void rows_do_not_depend_on_the_number_of_workers_or_where_one_starts(void **state)
{
    (void)state;
    const fbd_sweep_plan plan = plan_of(TEXTS("m=-1:2:31", "v0=normal(1,1):17"), TEXTS("final,times,max(y)"));
    struct sweep_table one = sweep_by(projectile, &plan, 0, 1);
    assert_int_equal(one.counts.written, 31 * 17);
    for (size_t jobs = 2; jobs <= 7; jobs += 5) {
        struct sweep_table more = sweep_by(projectile, &plan, 0, jobs);
        assert_int_equal(more.counts.written, one.counts.written);
        assert_int_equal(more.counts.failed, one.counts.failed);
        assert_string_equal(more.rows.data, one.rows.data);
        close_table(&more);
    }
    const char *tail = one.rows.data;
    for (int i = 0; i < 100; i++) tail = strchr(tail, '\n') + 1;
    struct sweep_table rest = sweep_by(projectile, &plan, 100, 2);
    assert_string_equal(rest.rows.data, tail);
    close_table(&rest);
    close_table(&one);
}

/* ---- stopping */

static int stop_later(void *context)
{
    size_t *left = context;
    if (*left == 0) return 1;
    --*left;
    return 0;
}

static void a_sweep_that_is_stopped_leaves_its_first_rows(void **state)
{
    (void)state;
    const fbd_sweep_plan plan = plan_of(TEXTS("v0=1:9:500"), NULL);
    struct sweep_table whole = sweep_by(projectile, &plan, 0, 1), part = open_table(projectile, &plan);
    size_t steps = 100; /* of two that a run takes */
    const fbd_sweep_work work = {.end = 500,
                                 .jobs = 1,
                                 .write = append,
                                 .write_context = &part.rows,
                                 .stop = stop_later,
                                 .stop_context = &steps};
    assert_int_equal(fbd_sweep_run(part.sweep, &work, &part.counts), FBD_SWEEP_STOPPED);
    assert_in_range(part.counts.written, 1, 499);
    assert_int_equal(part.rows.data[part.rows.length - 1], '\n');
    assert_memory_equal(part.rows.data, whole.rows.data, part.rows.length);
    struct sweep_table rest = sweep_by(projectile, &plan, part.counts.written, 2);
    assert_string_equal(rest.rows.data, whole.rows.data + part.rows.length);
    close_table(&rest);
    close_table(&part);
    close_table(&whole);
}

static int refuse_later(void *context, const char *rows, size_t length)
{
    (void)rows;
    (void)length;
    return stop_later(context);
}

static void a_table_that_cannot_be_written_ends_the_sweep(void **state)
{
    (void)state;
    for (size_t jobs = 1; jobs <= 3; jobs++) {
        const fbd_sweep_plan plan = plan_of(TEXTS("v0=1:9:500"), NULL);
        struct sweep_table table = open_table(projectile, &plan);
        size_t left = 3;
        const fbd_sweep_work work = {.end = 500, .jobs = jobs, .write = refuse_later, .write_context = &left};
        assert_int_equal(fbd_sweep_run(table.sweep, &work, &table.counts), FBD_SWEEP_REFUSED);
        assert_true(table.counts.written < 500);
        close_table(&table);
    }
}

/* ---- with the help of others */

static void shares_that_others_make_take_their_place_in_the_order(void **state)
{
    (void)state;
    const fbd_sweep_plan plan = plan_of(TEXTS("v0=1:9:200"), NULL);
    struct sweep_table alone = sweep_by(projectile, &plan, 0, 1), led = open_table(projectile, &plan);
    const fbd_sweep_work work = {.end = 200, .jobs = 1, .write = append, .write_context = &led.rows};
    fbd_sweep_workers *crew = fbd_sweep_start(led.sweep, &work, 1);
    assert_non_null(crew);
    fbd_sweep_share share;
    for (int claimed; (claimed = fbd_sweep_claim(crew, 1, &share)) >= 0;) {
        if (claimed == 0) continue;
        struct text rows = {0};
        fbd_sweep_counts counts;
        const fbd_sweep_work mine = {
            .first = share.first, .end = share.end, .jobs = 1, .write = append, .write_context = &rows};
        assert_int_equal(fbd_sweep_run(alone.sweep, &mine, &counts), FBD_SWEEP_DONE);
        fbd_sweep_deliver(crew, &share, rows.data, rows.length, &counts);
        text_free(&rows);
    }
    assert_int_equal(fbd_sweep_finish(crew, &led.counts), FBD_SWEEP_DONE);
    assert_int_equal(led.counts.written, 200);
    assert_string_equal(led.rows.data, alone.rows.data);
    close_table(&led);
    close_table(&alone);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_show_what_happened),
        cmocka_unit_test(the_amplitude_of_a_pendulum_is_found_between_the_steps),
        cmocka_unit_test(a_point_moves_with_the_dimensions_of_its_body),
        cmocka_unit_test(runs_that_fail_are_rows_and_stop_no_others),
        cmocka_unit_test(rows_do_not_depend_on_the_number_of_workers_or_where_one_starts),
        cmocka_unit_test(a_sweep_that_is_stopped_leaves_its_first_rows),
        cmocka_unit_test(a_table_that_cannot_be_written_ends_the_sweep),
        cmocka_unit_test(shares_that_others_make_take_their_place_in_the_order),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
