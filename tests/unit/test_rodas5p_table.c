/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The coefficients of Rodas5P: order conditions of the step, the embedded formula and the dense output, and
 * stability.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <complex.h>
#include <math.h>
#include <string.h>

#include "integrate/rodas5p_table.h"

enum { stages = rodas5p_stages };

/* The method as HNW II, IV.7 defines it: k_i = h f(y0 + sum alpha_ij k_j) + h J sum gamma_ij k_j, and beta =
 * alpha + gamma. Indices from 1. */
struct classical {
    double alpha[stages + 1][stages + 1], beta[stages + 1][stages + 1], gamma[stages + 1][stages + 1];
    double b[stages + 1], embedded[stages + 1]; /* weights of k */
};

/* gamma = (I / gamma - C)^-1, as u = gamma k; both are lower triangular. */
static void invert(double gamma[stages + 1][stages + 1])
{
    for (int j = 1; j <= stages; j++) {
        for (int i = j; i <= stages; i++) {
            double sum = i == j;
            for (int m = j; m < i; m++) sum += rodas5p_C[i][m] * gamma[m][j];
            gamma[i][j] = sum * rodas5p_gamma;
        }
    }
}

/* out = row gamma: weights of the u turned into weights of the k. */
static void to_classical(const struct classical *c, const double row[stages + 1], double out[stages + 1])
{
    for (int j = 1; j <= stages; j++) {
        out[j] = 0;
        for (int m = j; m <= stages; m++) out[j] += row[m] * c->gamma[m][j];
    }
}

static struct classical classical_form(void)
{
    struct classical c = {0};
    invert(c.gamma);
    double row[stages + 1] = {0};
    for (int i = 1; i <= stages; i++) {
        if (i <= 6) memcpy(row, rodas5p_a[i], sizeof row);
        if (i > 6) row[i - 1] = 1;
        to_classical(&c, row, c.alpha[i]);
        for (int j = 1; j <= stages; j++) c.beta[i][j] = c.alpha[i][j] + c.gamma[i][j];
    }
    memcpy(c.embedded, c.alpha[stages], sizeof c.embedded);
    row[stages] = 1;
    to_classical(&c, row, c.b);
    return c;
}

static double row_sum(const double row[stages + 1])
{
    double sum = 0;
    for (int j = 1; j <= stages; j++) sum += row[j];
    return sum;
}

static void every_row_sums_to_its_node(void **state)
{
    (void)state;
    struct classical c = classical_form();
    /* The numbers of a row of C reach 147, and the rows are inverted: 147 * 8 roundings. */
    for (int i = 1; i <= stages; i++) {
        assert_true(fabs(row_sum(c.alpha[i]) - rodas5p_c[i]) < 3e-13);
        assert_true(fabs(row_sum(c.gamma[i]) - rodas5p_d[i]) < 3e-13);
    }
}

/* out_i = sum_j matrix_ij x_j, times factor_i if that is given. */
static void apply(const double matrix[stages + 1][stages + 1], const double *x, const double *factor,
                  double out[stages + 1])
{
    for (int i = 1; i <= stages; i++) {
        out[i] = 0;
        for (int j = 1; j <= stages; j++) out[i] += matrix[i][j] * x[j];
        if (factor) out[i] *= factor[i];
    }
}

/* The vectors of the trees up to order 5 (HNW II, IV.7, table 7.1), the sum of whose products with the
 * weights is theta^order / density. */
enum { trees = 17, trees_to_order_4 = 8 };

static const struct {
    int order;
    double density;
} tree[trees] = {{1, 1},  {2, 2},  {3, 3},  {3, 6},  {4, 4},  {4, 8},  {4, 12}, {4, 24}, {5, 5},
                 {5, 10}, {5, 20}, {5, 15}, {5, 30}, {5, 20}, {5, 40}, {5, 60}, {5, 120}};

static void tree_vectors(const struct classical *c, double v[trees][stages + 1])
{
    double al[stages + 1], work[stages + 1], one[stages + 1];
    for (int i = 0; i <= stages; i++) one[i] = v[0][i] = 1;
    apply(c->alpha, one, NULL, al);
    apply(c->beta, one, NULL, v[1]);
    for (int i = 1; i <= stages; i++) {
        v[2][i] = al[i] * al[i];
        v[4][i] = al[i] * v[2][i];
        v[8][i] = v[2][i] * v[2][i];
    }
    apply(c->beta, v[1], NULL, v[3]);
    apply(c->alpha, v[1], al, v[5]);
    apply(c->beta, v[2], NULL, v[6]);
    apply(c->beta, v[3], NULL, v[7]);
    apply(c->alpha, v[1], v[2], v[9]);
    apply(c->alpha, v[1], NULL, work);
    for (int i = 1; i <= stages; i++) v[10][i] = work[i] * work[i];
    apply(c->alpha, v[2], al, v[11]);
    apply(c->alpha, v[3], al, v[12]);
    apply(c->beta, v[4], NULL, v[13]);
    apply(c->beta, v[5], NULL, v[14]);
    apply(c->beta, v[6], NULL, v[15]);
    apply(c->beta, v[7], NULL, v[16]);
}

/* By how much weights miss the condition of a tree for a step of theta h. */
static double residual(const double *vector, const double *weights, int k, double theta)
{
    double sum = 0;
    for (int i = 1; i <= stages; i++) sum += weights[i] * vector[i];
    return sum - pow(theta, tree[k].order) / tree[k].density;
}

/* Limit of what is rounding: as for the rows, and products of up to four matrices add little. */
static const double rounding = 1e-12;

static void all_order_conditions_hold(void **state)
{
    (void)state;
    struct classical c = classical_form();
    double v[trees][stages + 1], missed = 0;
    tree_vectors(&c, v);
    for (int k = 0; k < trees; k++) assert_true(fabs(residual(v[k], c.b, k, 1)) < rounding);
    for (int k = 0; k < trees; k++) {
        double r = fabs(residual(v[k], c.embedded, k, 1));
        if (k < trees_to_order_4) assert_true(r < rounding);
        missed = fmax(missed, r);
    }
    assert_true(missed > 1e-4); /* the embedded formula is not of order 5 */
}

static void dense_output_satisfies_the_conditions_of_order_4(void **state)
{
    (void)state;
    struct classical c = classical_form();
    double v[trees][stages + 1];
    tree_vectors(&c, v);
    for (int p = 1; p < 8; p++) {
        double theta = p / 8.0, row[stages + 1] = {0}, bend[stages + 1], weights[stages + 1];
        for (int j = 1; j <= stages; j++)
            row[j] = rodas5p_h[0][j] + theta * (rodas5p_h[1][j] + theta * rodas5p_h[2][j]);
        to_classical(&c, row, bend);
        for (int j = 1; j <= stages; j++) weights[j] = theta * (c.b[j] + (1 - theta) * bend[j]);
        for (int k = 0; k < trees_to_order_4; k++)
            assert_true(fabs(residual(v[k], weights, k, theta)) < rounding);
    }
}

/* The stability function y1 / y0 for y' = lambda y, z = h lambda: x = 1 + z beta x, y1 = x_8 as the last row
 * of beta is b. Of the embedded formula likewise, whose weights are the row 7 of beta. */
static void stability(const struct classical *c, double complex z, double *result, double *embedded)
{
    double complex x[stages + 1];
    for (int i = 1; i <= stages; i++) {
        x[i] = 1;
        for (int j = 1; j < i; j++) x[i] += z * c->beta[i][j] * x[j];
        x[i] /= 1 - z * rodas5p_gamma;
    }
    *result = cabs(x[stages]);
    *embedded = cabs(x[stages - 1]);
}

static void it_is_stiffly_accurate_and_L_stable(void **state)
{
    (void)state;
    struct classical c = classical_form();
    double result, embedded;
    for (int j = 1; j <= stages; j++) {
        assert_true(fabs(c.beta[stages][j] - c.b[j]) < rounding);
        assert_true(fabs(c.beta[stages - 1][j] - c.embedded[j]) < rounding);
    }
    for (int decade = 3; decade < 12; decade++) {
        double z = pow(10, decade);
        stability(&c, -z, &result, &embedded);
        assert_true(result < 100 / z && embedded < 100 / z);
    }
    /* A rational function without poles on the left is largest on the imaginary axis. There 1 is reached at 0
     * only, where the tolerance is for the rounding. */
    for (int i = 0; i < 2083; i++) { /* 1e-3 ... 1e6 */
        stability(&c, 1e-3 * pow(1.01, i) * I, &result, &embedded);
        assert_true(result <= 1 + rounding && embedded <= 1 + rounding);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_sums_to_its_node),
        cmocka_unit_test(all_order_conditions_hold),
        cmocka_unit_test(dense_output_satisfies_the_conditions_of_order_4),
        cmocka_unit_test(it_is_stiffly_accurate_and_L_stable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
