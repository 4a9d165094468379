/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which values the runs of a sweep get.
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
#include "sweep_table.h"

static void assert_plan_refused(const fbd_sweep_plan *plan, const char *id)
{
    struct sweep_table table = open_table(projectile, plan);
    assert_null(table.sweep);
    const fbd_error note = fbd_errors_get(table.errors, 0);
    assert_non_null(note.id);
    assert_string_equal(note.id, id);
    close_table(&table);
}

static void assert_refused(const char *const *vary, const char *const *outputs, const char *id)
{
    const fbd_sweep_plan plan = plan_of(vary, outputs);
    assert_plan_refused(&plan, id);
}

static void a_grid_has_its_ends_and_values_as_people_write_them(void **state)
{
    (void)state;
    struct sweep_table table = sweep_of(projectile, TEXTS("v0=0.1:0.6:6"), TEXTS("t"));
    const char *const want[] = {"0.1", "0.2", "0.3", "0.4", "0.5", "0.6"};
    assert_int_equal(table.counts.written, 6);
    for (size_t i = 0; i < 6; i++) assert_field(&table, i, 1, want[i]);
    close_table(&table);
    table = sweep_of(projectile, TEXTS("v0=-0.1:0.5:7"), TEXTS("t"));
    assert_field(&table, 1, 1, "0");
    close_table(&table);
    table = sweep_of(projectile, TEXTS("v0=0.30000000000000004:1:1"), TEXTS("t"));
    assert_field(&table, 0, 1, "0.30000000000000004");
    close_table(&table);
}

static void a_logarithmic_grid_has_equal_ratios(void **state)
{
    (void)state;
    struct sweep_table table = sweep_of(projectile, TEXTS("m=1:1000:4:log"), TEXTS("t"));
    const char *const want[] = {"1", "10", "100", "1000"};
    for (size_t i = 0; i < 4; i++) assert_field(&table, i, 1, want[i]);
    close_table(&table);
}

static void a_unit_holds_for_all_values_and_stands_in_the_header(void **state)
{
    (void)state;
    struct sweep_table table = sweep_of(projectile, TEXTS("v0=1,2 km/h"), TEXTS("ball.vx"));
    assert_string_equal(fbd_sweep_header(table.sweep), "run,v0 [km/h],ball.vx [m/s],events,status,reason\n");
    assert_field(&table, 1, 1, "2");
    /* 2/3.6 rounds once, and so does the conversion of the unit */
    assert_true(fabs(number(&table, 1, 2) - 2 / 3.6) <= 2.3e-16);
    close_table(&table);
    table = sweep_of(projectile, TEXTS("v0=1 km/h,2 km/h"), TEXTS("ball.vx"));
    assert_field(&table, 0, 1, "1");
    close_table(&table);
    table = sweep_of(projectile, TEXTS("v0=1,2"), TEXTS("t"));
    assert_string_equal(fbd_sweep_header(table.sweep), "run,v0 [m/s],t [s],events,status,reason\n");
    close_table(&table);
}

static void the_last_axis_changes_fastest(void **state)
{
    (void)state;
    struct sweep_table table = sweep_of(projectile, TEXTS("m=1,2", "v0=5,6,7"), TEXTS("t"));
    assert_int_equal(table.counts.written, 6);
    for (size_t i = 0; i < 6; i++) {
        assert_true(number(&table, i, 0) == (double)(i + 1));
        assert_true(number(&table, i, 1) == (i < 3 ? 1 : 2));
        assert_true(number(&table, i, 2) == (double)(5 + i % 3));
    }
    close_table(&table);
}

static void members_of_an_axis_go_side_by_side_and_so_does_all_with_zip(void **state)
{
    (void)state;
    struct sweep_table table = sweep_of(projectile, TEXTS("m=1,2; v0=5,6", "h=0,1,2"), TEXTS("t"));
    assert_int_equal(table.counts.written, 6);
    assert_field(&table, 3, 1, "2");
    assert_field(&table, 3, 2, "6");
    assert_field(&table, 3, 3, "0");
    close_table(&table);
    fbd_sweep_plan plan = plan_of(TEXTS("m=1,2,3", "v0=5:7:3"), TEXTS("t"));
    plan.zip = true;
    table = sweep_by(projectile, &plan, 0, 1);
    assert_int_equal(table.counts.written, 3);
    assert_field(&table, 1, 1, "2");
    assert_field(&table, 1, 2, "6");
    close_table(&table);
    plan = plan_of(TEXTS("m=1,2,3", "v0=5,6"), TEXTS("t"));
    plan.zip = true;
    table = open_table(projectile, &plan);
    assert_null(table.sweep);
    close_table(&table);
}

static void draws_are_of_their_distribution(void **state)
{
    (void)state;
    enum { n = 2000 };
    struct sweep_table table =
        sweep_of(projectile,
                 TEXTS("m=uniform(1,3) kg:2000; v0=normal(5,0.5) m/s:2000; h=loguniform(1,100):2000"),
                 TEXTS("t"));
    double sum[3] = {0}, squares[3] = {0};
    for (size_t i = 0; i < n; i++) {
        double x[3] = {number(&table, i, 1), number(&table, i, 2), log(number(&table, i, 3))};
        assert_true(x[0] >= 1 && x[0] < 3);
        assert_true(x[2] >= 0 && x[2] <= log(100) * (1 + 1e-15));
        for (int k = 0; k < 3; k++) {
            sum[k] += x[k];
            squares[k] += x[k] * x[k];
        }
    }
    const double mean[3] = {2, 5, log(100) / 2}, deviation[3] = {2 / sqrt(12), 0.5, log(100) / sqrt(12)};
    for (int k = 0; k < 3; k++) {
        /* The mean of n draws varies by deviation/sqrt(n), the standard deviation by less than that: five of
         * them happen by chance once in a million seeds, and the seed is fixed. */
        double spread = 5 * deviation[k] / sqrt(n), m = sum[k] / n;
        assert_true(fabs(m - mean[k]) < spread);
        assert_true(fabs(sqrt(squares[k] / n - m * m) - deviation[k]) < spread);
    }
    close_table(&table);
}

static void a_draw_depends_on_seed_name_and_number_alone(void **state)
{
    (void)state;
    char a[64], b[64];
    struct sweep_table few = sweep_of(projectile, TEXTS("m=uniform(1,2):10"), TEXTS("t"));
    struct sweep_table many = sweep_of(projectile, TEXTS("h=normal(0,1):2", "m=uniform(1,2):20"), TEXTS("t"));
    for (size_t i = 0; i < 10; i++) {
        assert_string_equal(field(&few, i, 1, a, sizeof a), field(&many, i, 2, b, sizeof b));
        assert_string_equal(a, field(&many, 20 + i, 2, b, sizeof b));
    }
    fbd_sweep_plan plan = plan_of(TEXTS("m=uniform(1,2):10"), TEXTS("t"));
    plan.seed = 2;
    struct sweep_table other = sweep_by(projectile, &plan, 0, 1);
    for (size_t i = 0; i < 10; i++)
        assert_string_not_equal(field(&few, i, 1, a, sizeof a), field(&other, i, 1, b, sizeof b));
    close_table(&few);
    close_table(&many);
    close_table(&other);
}

static void what_is_no_sweep_is_refused(void **state)
{
    (void)state;
    static const char *const wrong[] = {"m",
                                        "m=",
                                        "=1",
                                        "m=1:2",
                                        "m=1:2:0",
                                        "m=1:2:x",
                                        "m=1:2:3:4",
                                        "m=a,b",
                                        "m=1,,2",
                                        "m=uniform(1):3",
                                        "m=uniform(1,2)",
                                        "m=gamma(1,2):3",
                                        "m=loguniform(0,1):3",
                                        "m=normal(1,-1):3",
                                        "m=0:1:3:log",
                                        "m=1 kg:2 g:3",
                                        "m=1,2; v0=1",
                                        "m=1; m=2",
                                        "m=1:2:99999999999999999999",
                                        "m=inf",
                                        "m=nan",
                                        "m=1:2:3x",
                                        "m=1e999"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_refused(TEXTS(wrong[i]), NULL, "bad-vary");
    assert_refused(TEXTS("m=1:2:9000000000", "v0=1:2:9000000000"), NULL, "bad-vary");
    assert_refused(TEXTS("x=1"), NULL, "unknown-parameter");
    assert_refused(TEXTS("m=1 m"), NULL, "wrong-dimension");
    assert_refused(TEXTS("m=1 kilo"), NULL, "unknown-unit");
    assert_refused(TEXTS("m=1"), TEXTS("ball.z"), "unknown-output");
    fbd_sweep_plan plan = plan_of(TEXTS("m=1"), NULL);
    fbd_options bars = FBD_OPTIONS_DEFAULT, accurate = FBD_OPTIONS_DEFAULT;
    bars.error_bars = true;
    plan.run = &bars;
    assert_plan_refused(&plan, "bad-option");
    accurate.accuracy = 1e-6;
    plan.run = &accurate;
    assert_plan_refused(&plan, "bad-option");
    assert_refused(TEXTS("m=1"), TEXTS("t,time(nothing)"), "unknown-output");
    assert_refused(TEXTS("m=1"), TEXTS("max(t)"), "unknown-output");
    assert_refused(TEXTS("m=1"), TEXTS("ball.drag.work"), "unknown-output");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_grid_has_its_ends_and_values_as_people_write_them),
        cmocka_unit_test(a_logarithmic_grid_has_equal_ratios),
        cmocka_unit_test(a_unit_holds_for_all_values_and_stands_in_the_header),
        cmocka_unit_test(the_last_axis_changes_fastest),
        cmocka_unit_test(members_of_an_axis_go_side_by_side_and_so_does_all_with_zip),
        cmocka_unit_test(draws_are_of_their_distribution),
        cmocka_unit_test(a_draw_depends_on_seed_name_and_number_alone),
        cmocka_unit_test(what_is_no_sweep_is_refused),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
