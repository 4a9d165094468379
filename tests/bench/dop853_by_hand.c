/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dop853_by_hand.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "integrate/dop853_table.h"

struct pair {
    rates_by_hand *rates;
    void *params;
    size_t n;
    double t, h, tolerance;
    const double *scale;
    double *y, *u, *next, *k[14]; /* stage i of the book is k[i] */
};

#define A(i, j) dop853_a[i][j] * k[j][c]
#define STAGE(i, sum)                                                                                        \
    do {                                                                                                     \
        for (size_t c = 0; c < n; c++) u[c] = y[c] + h * (sum);                                              \
        if (p->rates(p->t + dop853_c[i] * h, u, k[i], p->params)) return -1;                                 \
    } while (0)

/* k[1] is there; makes the others and y1 in `next`. */
static int stages(struct pair *p)
{
    double *const *k = p->k, *y = p->y, *u = p->u, h = p->h;
    const size_t n = p->n;
    STAGE(2, A(2, 1));
    STAGE(3, A(3, 1) + A(3, 2));
    STAGE(4, A(4, 1) + A(4, 3));
    STAGE(5, A(5, 1) + A(5, 3) + A(5, 4));
    STAGE(6, A(6, 1) + A(6, 4) + A(6, 5));
    STAGE(7, A(7, 1) + A(7, 4) + A(7, 5) + A(7, 6));
    STAGE(8, A(8, 1) + A(8, 4) + A(8, 5) + A(8, 6) + A(8, 7));
    STAGE(9, A(9, 1) + A(9, 4) + A(9, 5) + A(9, 6) + A(9, 7) + A(9, 8));
    STAGE(10, A(10, 1) + A(10, 4) + A(10, 5) + A(10, 6) + A(10, 7) + A(10, 8) + A(10, 9));
    STAGE(11, A(11, 1) + A(11, 4) + A(11, 5) + A(11, 6) + A(11, 7) + A(11, 8) + A(11, 9) + A(11, 10));
    STAGE(12,
          A(12, 1) + A(12, 4) + A(12, 5) + A(12, 6) + A(12, 7) + A(12, 8) + A(12, 9) + A(12, 10) + A(12, 11));
    for (size_t c = 0; c < n; c++)
        p->next[c] = y[c] + h * (A(13, 1) + A(13, 6) + A(13, 7) + A(13, 8) + A(13, 9) + A(13, 10) +
                                 A(13, 11) + A(13, 12));
    return 0;
}

static double size_of(const struct pair *p, size_t c, double a, double b)
{
    return p->tolerance * ((p->scale ? p->scale[c] : 1) + fmax(fabs(a), fabs(b)));
}

/* Of the step, over what is allowed. */
static double error_of(const struct pair *p)
{
    double *const *k = p->k, sum5 = 0, sum3 = 0;
    const double *e5 = dop853_e5, *e3 = dop853_e3;
    for (size_t c = 0; c < p->n; c++) {
        double size = size_of(p, c, p->y[c], p->next[c]);
        double fifth = e5[1] * k[1][c] + e5[6] * k[6][c] + e5[7] * k[7][c] + e5[8] * k[8][c] +
                       e5[9] * k[9][c] + e5[10] * k[10][c] + e5[11] * k[11][c] + e5[12] * k[12][c];
        double third = e3[1] * k[1][c] + e3[6] * k[6][c] + e3[7] * k[7][c] + e3[8] * k[8][c] +
                       e3[9] * k[9][c] + e3[10] * k[10][c] + e3[11] * k[11][c] + e3[12] * k[12][c];
        sum5 += fifth / size * (fifth / size);
        sum3 += third / size * (third / size);
    }
    double below = sum5 + 0.01 * sum3;
    return sum5 == 0 ? 0 : fabs(p->h) * sum5 / sqrt(below * (double)p->n);
}

/* HNW I, II.4: from the sizes of y, y' and y''. */
static int first_step(struct pair *p)
{
    double f = 0, y = 0, second = 0;
    for (size_t c = 0; c < p->n; c++) {
        double size = size_of(p, c, p->y[c], p->y[c]);
        f += p->k[1][c] / size * (p->k[1][c] / size);
        y += p->y[c] / size * (p->y[c] / size);
    }
    double h = f <= 1e-10 || y <= 1e-10 ? 1e-6 : 0.01 * sqrt(y / f);
    for (size_t c = 0; c < p->n; c++) p->u[c] = p->y[c] + h * p->k[1][c];
    if (p->rates(p->t + h, p->u, p->k[2], p->params)) return -1;
    for (size_t c = 0; c < p->n; c++) {
        double by = (p->k[2][c] - p->k[1][c]) / size_of(p, c, p->y[c], p->y[c]);
        second += by * by;
    }
    double most = fmax(sqrt(second) / h, sqrt(f));
    p->h = fmin(100 * h, most <= 1e-15 ? fmax(1e-6, 1e-3 * h) : pow(0.01 / most, 1.0 / 8));
    return 0;
}

static int walk(struct pair *p, double until)
{
    double most = 6;
    if (p->rates(p->t, p->y, p->k[1], p->params) || first_step(p)) return -1;
    while (p->t < until) {
        double left = until - p->t;
        if (p->h > left) p->h = left;
        if (p->h < 1e-15 * fabs(p->t) || stages(p)) return -1;
        double error = error_of(p),
               factor = fmin(fmax(0.9 * pow(fmax(error, 1e-300), -1.0 / 8), 1.0 / 3), most);
        if (!(error <= 1)) {
            p->h *= isfinite(error) ? fmin(factor, 1) : 0.1;
            most = 1;
            continue;
        }
        p->t = p->h == left ? until : p->t + p->h;
        memcpy(p->y, p->next, p->n * sizeof *p->y);
        if (p->t < until && p->rates(p->t, p->y, p->k[1], p->params)) return -1;
        p->h *= factor;
        most = 6;
    }
    return 0;
}

int dop853_by_hand(rates_by_hand *rates, void *params, size_t n, double t, double until, double *y,
                   double tolerance, const double *scale)
{
    struct pair pair = {
        .rates = rates, .params = params, .n = n, .t = t, .tolerance = tolerance, .scale = scale, .y = y};
    double *memory = malloc(14 * n * sizeof *memory);
    if (!memory) return -1;
    pair.u = memory;
    pair.next = memory + n;
    for (size_t i = 1; i <= 12; i++) pair.k[i] = memory + (i + 1) * n;
    int status = walk(&pair, until);
    free(memory);
    return status;
}
