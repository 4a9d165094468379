/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows of 2 to 12 blocks on springs and dampers at random, the last of them let go from beside its place.
 *
 * What makes it hard: block i of n starts as t^(2 (n - i)), or by rounding where it rests many metres from the
 * origin, and the springs have from 10 to 1e6 N/m. Nothing may follow that start to a share of itself: the stiff
 * method once ended with steps that underflow, and the others took millions of them.
 *
 * Reference: m x'' = -K x - C x' is linear; x(T) by the matrix exponential, scaling and squaring of its series in
 * long double.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hard.h"
#include "random_numbers.h"

enum { most = 12, size = 2 * most };

struct row {
    int n;
    double k[most], c[most]; /* between block i - 1, or the wall, and block i */
    double pulled;
};

static struct row draw_row(struct random_numbers *numbers)
{
    struct row row = {.n = 2 + (int)random_between(numbers, 0, most - 2 + 0.999), .pulled = 0.1};
    for (int i = 0; i < row.n; i++) {
        row.k[i] = pow(10, random_between(numbers, 1, 6));
        row.c[i] = pow(10, random_between(numbers, -1, 4));
    }
    return row;
}

static char *text_of(const struct row *row)
{
    static char text[8192];
    int at = snprintf(text, sizeof text, "fbd: 1\nground: {points: {W: [-1, 0]}}\nbodies:\n");
    for (int i = 0; i < row->n; i++)
        at += snprintf(text + at, sizeof text - (size_t)at,
                       "  b%d: {mass: 1, motion: {slide: {through: [%d, 0]}}, initial: {x: %.17g}}\n", i, i,
                       i == row->n - 1 ? row->pulled : 0);
    at += snprintf(text + at, sizeof text - (size_t)at, "couplings:\n");
    for (int i = 0; i < row->n; i++) {
        char before[16] = "ground.W";
        if (i > 0) snprintf(before, sizeof before, "b%d.G", i - 1);
        at += snprintf(text + at, sizeof text - (size_t)at,
                       "  - spring: {between: [%s, b%d.G], stiffness: %.17g, free_length: 1}\n"
                       "  - damper: {between: [%s, b%d.G], coefficient: %.17g}\n",
                       before, i, row->k[i], before, i, row->c[i]);
    }
    snprintf(text + at, sizeof text - (size_t)at, "simulate: {until: 2}\n");
    return text;
}

/* ---- reference */

static void fill(const struct row *row, long double A[size][size])
{
    const int n = row->n;
    memset(A, 0, sizeof(long double[size][size]));
    for (int i = 0; i < n; i++) {
        A[i][n + i] = 1;
        for (int j = 0; j < 2; j++) { /* the spring before it, and the one behind */
            int spring = i + j, other = j ? i + 1 : i - 1;
            if (spring == n) continue;
            A[n + i][i] -= row->k[spring];
            A[n + i][n + i] -= row->c[spring];
            if (other < 0) continue;
            A[n + i][other] += row->k[spring];
            A[n + i][n + other] += row->c[spring];
        }
    }
}

static void multiply(int n, long double A[size][size], long double B[size][size], long double C[size][size])
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            long double sum = 0;
            for (int k = 0; k < n; k++) sum += A[i][k] * B[k][j];
            C[i][j] = sum;
        }
}

/* exp(A T) = (exp(A T / 2^m))^(2^m), with a series where |A| T / 2^m is below 1. Of X = exp - 1, which keeps what is
 * small: (1 + X)^2 - 1 = 2 X + X^2. */
static void exponential(int n, long double A[size][size], long double T, long double E[size][size])
{
    static long double term[size][size], next[size][size];
    enum { halvings = 26, terms = 14 };
    memset(E, 0, sizeof(long double[size][size]));
    memset(term, 0, sizeof term);
    for (int i = 0; i < n; i++) {
        term[i][i] = 1;
        for (int j = 0; j < n; j++) A[i][j] *= ldexpl(T, -halvings);
    }
    for (int order = 1; order <= terms; order++) {
        multiply(n, term, A, next);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) E[i][j] += term[i][j] = next[i][j] / order;
    }
    for (int i = 0; i < halvings; i++) {
        multiply(n, E, E, next);
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++) E[j][k] = 2 * E[j][k] + next[j][k];
    }
    for (int i = 0; i < n; i++) E[i][i] += 1;
}

/* ---- claims */

static void check_row(struct checks *checks, const struct row *row, const struct hard_method *method)
{
    static long double A[size][size], E[size][size];
    struct trial trial = trial_parse(text_of(row));
    hard_start(&trial, method, NAN);
    if (hard_done(checks, &trial)) {
        double worst = 0;
        fill(row, A);
        exponential(2 * row->n, A, 2, E);
        for (int i = 0; i < row->n; i++) {
            char name[16];
            snprintf(name, sizeof name, "b%d.x", i);
            worst = fmax(worst, fabs(trial_get(&trial, name) - (double)(E[i][row->n - 1] * row->pulled)));
        }
        hard_case(checks, &trial, "a row of blocks", worst, 0.01 * hard_promise(&trial) * row->pulled);
        unsigned long steps = fbd_simulation_stats(trial.simulation).steps;
        if (!check_that(checks, "few steps", steps < 60000)) print_message("# %lu steps\n", steps);
    }
    trial_close(&trial);
}

static void rows_of_blocks(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {20261124};
    static const struct hard_method methods[] = {{.tolerance = 1e-6},
                                                 {.tolerance = 1e-10},
                                                 {.name = "rodas5p", .tolerance = 1e-6},
                                                 {.name = "rodas5p", .tolerance = 1e-10}};
    for (int draw = 0; draw < draws_of(3); draw++) {
        struct row row = draw_row(&numbers);
        for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) check_row(&checks, &row, &methods[i]);
        if (checks.failed) print_message("# draw %d, %d blocks\n%s", draw, row.n, text_of(&row));
        if (checks.failed) break;
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rows_of_blocks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
