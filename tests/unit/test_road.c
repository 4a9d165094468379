/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A quarter car on a measured road of 1e5 points, straight between them: each piece is a linear system under an input
 * that is straight in time, whose solution is one matrix exponential for all pieces. And a table of 1e5 points costs a
 * run no more steps than the part of it that the run sees.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmocka.h>
#include <gsl/gsl_linalg.h>

#include "random_numbers.h"
#include "run_checks.h"
#include "thorough.h"

enum { points = 100000, sides = 6 };

static const double apart = 0.05, V = 10; /* m, m/s: a corner each 5 ms */
static const double m_b = 320, m_w = 40, k = 22e3, c = 1600, k_t = 190e3;

static char folder[] = "/tmp/fbd-road-XXXXXX";
static double height[points]; /* mm */

/* Waves of three lengths and what no wave explains, with four decimals as a profilometer writes them. */
static void make_road(void)
{
    struct random_numbers numbers = {11};
    for (int i = 0; i < points; i++) {
        double s = apart * i, h = 10 * sin(0.3 * s) + 4 * sin(1.7 * s) + 1.5 * sin(5.1 * s);
        height[i] = round(1e4 * (h + random_between(&numbers, -0.5, 0.5))) / 1e4;
    }
}

static void write_road(const char *name, int count)
{
    char path[100];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "s [m],h [mm]\n");
    for (int i = 0; i < count; i++) fprintf(file, "%.2f,%.4f\n", apart * i, height[i]);
    assert_int_equal(fclose(file), 0);
}

static int set_up(void **unused)
{
    (void)unused;
    make_road();
    assert_non_null(mkdtemp(folder));
    write_road("all.csv", points);
    write_road("part.csv", 2002);
    return 0;
}

static int tear_down(void **unused)
{
    static const char *const names[] = {"all.csv", "part.csv"};
    char path[100];
    (void)unused;
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        remove(path);
    }
    return rmdir(folder);
}

static struct trial drive(const char *road, int corners)
{
    char text[text_room];
    snprintf(text, sizeof text,
             "fbd: 1\n"
             "tables: {h: {file: %s/%s}}\n"
             "bodies:\n"
             "  body:\n"
             "    mass: %g\n"
             "    motion: {slide: {along: 90 deg}}\n"
             "    forces: [applied: {value: -%g*(x - wheel.x) - %g*(v - wheel.v)}]\n"
             "  wheel:\n"
             "    mass: %g\n"
             "    motion: {slide: {along: 90 deg}}\n"
             "    forces:\n"
             "      - applied: {name: up, value: %g*(body.x - x) + %g*(body.v - v)}\n"
             "      - applied: {name: tyre, value: -%g*(x - h(%g*t))}\n"
             "simulate: {until: %.17g, tolerance: 1e-11}\n",
             folder, road, m_b, k, c, m_w, k, c, k_t, V, corners * apart / V);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    return trial;
}

/* z = [y_b, y_w, v_b, v_w, h, h'], z' = M z from corner to corner. */
static void solve(int corners, double *z)
{
    const double dt = apart / V;
    double M[sides * sides] = {0}, E[sides * sides];
    const double rows[2][sides] = {{-k / m_b, k / m_b, -c / m_b, c / m_b, 0, 0},
                                   {k / m_w, -(k + k_t) / m_w, c / m_w, -c / m_w, k_t / m_w, 0}};
    M[0 * sides + 2] = M[1 * sides + 3] = M[4 * sides + 5] = dt;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < sides; j++) M[(2 + i) * sides + j] = dt * rows[i][j];
    gsl_matrix_view from = gsl_matrix_view_array(M, sides, sides),
                    to = gsl_matrix_view_array(E, sides, sides);
    assert_int_equal(gsl_linalg_exponential_ss(&from.matrix, &to.matrix, GSL_PREC_DOUBLE), 0);
    for (int i = 0; i < corners; i++) {
        double next[sides] = {0};
        z[4] = height[i] / 1e3;
        z[5] = (height[i + 1] - height[i]) / 1e3 / dt;
        for (int r = 0; r < sides; r++)
            for (int j = 0; j < sides; j++) next[r] += E[r * sides + j] * z[j];
        memcpy(z, next, sizeof next);
    }
}

static void a_quarter_car(void **unused)
{
    const int corners = thorough() ? points - 1 : 3000;
    const double near = 1e-9; /* m and m/s of 0.01 and 0.3: errors die out with the springs */
    struct checks checks = {0};
    double z[sides] = {0};
    (void)unused;
    struct trial trial = drive("all.csv", corners);
    solve(corners, z);
    check_close(&checks, "body.x", get(&trial, "body.x"), z[0], near);
    check_close(&checks, "wheel.x", get(&trial, "wheel.x"), z[1], near);
    check_close(&checks, "body.v", get(&trial, "body.v"), z[2], 10 * near);
    check_close(&checks, "wheel.v", get(&trial, "wheel.v"), z[3], 100 * near);
    trial_close(&trial);
    checks_end(&checks);
}

static void what_is_not_seen_costs_nothing(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial all = drive("all.csv", 2000), part = drive("part.csv", 2000);
    fbd_stats long_one = fbd_simulation_stats(all.simulation),
              short_one = fbd_simulation_stats(part.simulation);
    check_that(&checks, "right-hand sides", long_one.rhs == short_one.rhs);
    check_that(&checks, "samples", long_one.event_samples == short_one.event_samples);
    check_that(&checks, "bits", get(&all, "wheel.v") == get(&part, "wheel.v"));
    trial_close(&all);
    trial_close(&part);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_quarter_car),
        cmocka_unit_test(what_is_not_seen_costs_nothing),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
