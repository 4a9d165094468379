/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows whose runs go abreast are those that are made one after the other, byte for byte, whatever becomes of some of them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <gsl/gsl_errno.h>

#include "batch/rows_simd.h"
#include "fbd_study.h"
#include "study/sweep.h"
#include "sweep_table.h"

static const char pendulum[] =
    "fbd: 1\n"
    "parameters: {L: 1 m, m: 2 kg, theta0: 1 rad, omega0: 0 rad/s, T: 12 s, c: 0 N*m*s/rad}\n"
    "bodies:\n"
    "  b:\n"
    "    mass: m\n"
    "    center: [0, -L]\n"
    "    motion: pivot\n"
    "    initial: {theta: theta0, omega: omega0}\n"
    "    forces: [gravity]\n"
    "    moments: [{damper: {coefficient: c}}]\n"
    "simulate: {until: T}\n";

static const char double_pendulum[] = "fbd: 1\n"
                                      "parameters: {m: 1 kg, theta_1: 1 rad, theta_2: 2 rad}\n"
                                      "bodies:\n"
                                      "  a:\n"
                                      "    {shape: rod, mass: 1, from: [0, 0], to: [0, -1], motion: pivot, "
                                      "initial: {theta: theta_1}, forces: [gravity]}\n"
                                      "  b:\n"
                                      "    shape: rod\n"
                                      "    mass: m\n"
                                      "    from: [0, 0]\n"
                                      "    to: [0, -1]\n"
                                      "    motion: {pivot: {on: a, at: right, point: left}}\n"
                                      "    initial: {theta: theta_2}\n"
                                      "    forces: [gravity]\n"
                                      "simulate: {until: 6 s}\n";

/* The rows one after the other, up to `count` of them. */
static void add_alone(const fbd_sweep *sweep, size_t count, struct text *rows)
{
    struct row_maker *maker = row_maker_new(sweep->rows, NULL, NULL);
    assert_non_null(maker);
    for (size_t run = 0; run < count; run++) row_make(maker, run, rows);
    row_maker_free(maker);
}

static void check_table(const char *text, const fbd_sweep_plan *plan, size_t first, size_t jobs)
{
    struct sweep_table table = sweep_by(text, plan, first, jobs);
    struct text alone = {0};
    assert_int_equal(table.end, FBD_SWEEP_DONE);
    assert_true(rows_simd_suits(table.sweep->rows));
    add_alone(table.sweep, fbd_sweep_run_count(table.sweep), &alone);
    const char *rest = alone.data;
    for (size_t i = 0; i < first; i++) rest = strchr(rest, '\n') + 1;
    assert_string_equal(table.rows.data, rest);
    text_free(&alone);
    close_table(&table);
}

static void check_sweep(const char *text, const char *const *vary, const char *outputs)
{
    fbd_sweep_plan plan = {
        .vary = vary, .vary_count = vary[1] ? 2 : 1, .outputs = &outputs, .output_count = 1, .seed = 7};
    for (size_t jobs = 1; jobs <= 3; jobs++) check_table(text, &plan, jobs - 1, jobs);
    const fbd_options rough = {.tolerance = 1e-5, .until = NAN}, exact = {.tolerance = 1e-14, .until = NAN};
    plan.run = &rough;
    check_table(text, &plan, 0, 1);
    plan.run = &exact;
    check_table(text, &plan, 0, 2);
}

static void rows_abreast_are_those_of_single_runs(void **unused)
{
    static const char *const sweeps[][2] = {
        {"theta0=uniform(-3,3):150"},
        {"theta0=0:3.14:40", "L=0.2:3:5:log"},
        {"T=uniform(0,3):60; theta0=uniform(-3,3):60; m=normal(1,0.7):60"},
        {"L=normal(0.3,0.4):50", "omega0=0,0.5,30"},
        {"c=0:1:50"}, /* without a damper, and with one */
        {"theta0=1,2,3"},
        {"theta0=0,1e-9,0,3.141592653589793,1e-300,-0,2", "T=40,1e-6"},
    };
    static const char *const of_double[][2] = {{"theta_1=uniform(-3,3):50", "m=0.1,1,3"},
                                               {"theta_2=0,1,-0,3,2,2,1", "m=-1,0.2,1"}};
    (void)unused;
    for (size_t i = 0; i < sizeof sweeps / sizeof *sweeps; i++)
        check_sweep(pendulum, sweeps[i], "final,times,steps,rhs,b.G.x,b.G.ay,count(stick)");
    for (size_t i = 0; i < sizeof of_double / sizeof *of_double; i++)
        check_sweep(double_pendulum, of_double[i], "final,times,steps,rhs,b.G.x,b.G.ay");
}

/* ---- stopped */

struct patience {
    int left;
};

static int lose_patience(void *context)
{
    struct patience *patience = context;
    return patience->left-- <= 0;
}

static void a_stop_leaves_the_first_rows(void **unused)
{
    const char *vary = "theta0=0.1:3:200";
    const fbd_sweep_plan plan = {.vary = &vary, .vary_count = 1, .seed = 1};
    struct sweep_table table = open_table(pendulum, &plan);
    struct text alone = {0};
    size_t stopped = 0;
    (void)unused;
    assert_non_null(table.sweep);
    add_alone(table.sweep, 200, &alone);
    for (int patience = 0; patience < 4000; patience = 2 * patience + 1) {
        struct patience left = {patience};
        struct rows_simd *abreast = rows_simd_new(table.sweep->rows, 4, lose_patience, &left);
        struct text rows = {0};
        assert_non_null(abreast);
        const struct rows_made made = rows_simd_make(abreast, 0, 200, &rows);
        size_t lines = 0;
        for (size_t i = 0; i < rows.length; i++) lines += rows.data[i] == '\n';
        assert_int_equal(lines, made.made);
        assert_true(rows.length == 0 || memcmp(rows.data, alone.data, rows.length) == 0);
        stopped += made.made > 0 && made.made < 200;
        text_free(&rows);
        rows_simd_free(abreast);
    }
    assert_true(stopped > 2); /* amid the rows */
    text_free(&alone);
    close_table(&table);
}

/* ---- what does not suit */

static void check_suits(bool suits, const char *text, const char *vary, const char *output)
{
    const fbd_sweep_plan plan = {
        .vary = &vary, .vary_count = 1, .outputs = &output, .output_count = 1, .seed = 1};
    struct sweep_table table = open_table(text, &plan);
    if (!table.sweep) fbd_errors_print(table.errors, stderr);
    assert_non_null(table.sweep);
    assert_int_equal(rows_simd_suits(table.sweep->rows), suits);
    close_table(&table);
}

static void columns_that_ask_for_more_do_not_suit(void **unused)
{
    (void)unused;
    check_suits(true, pendulum, "m=1,2", "final");
    check_suits(false, pendulum, "m=1,2", "final,max(b.theta)");
    check_suits(false, pendulum, "m=1,2", "energy.kinetic");
    check_suits(false, projectile, "m=1,2", "final");
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_abreast_are_those_of_single_runs),
        cmocka_unit_test(a_stop_leaves_the_first_rows),
        cmocka_unit_test(columns_that_ask_for_more_do_not_suit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
