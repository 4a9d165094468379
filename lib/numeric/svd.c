/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "numeric/svd.h"
#include "numeric/tolerances.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double dot(const double *a, const double *b, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static void turn(double *a, double *b, size_t n, double c, double s)
{
    for (size_t i = 0; i < n; i++) {
        double x = a[i], y = b[i];
        a[i] = c * x - s * y;
        b[i] = s * x + c * y;
    }
}

/* Rotate columns p and q to make them orthogonal; false if they are so already, to rounding, or if one is
 * negligible compared with the largest. */
static bool rotate(struct svd *svd, size_t p, size_t q, double nothing)
{
    double *a = svd->U + p * svd->rows, *b = svd->U + q * svd->rows;
    double aa = 0, bb = 0, ab = 0;
    for (size_t i = 0; i < svd->rows; i++) {
        aa += a[i] * a[i];
        bb += b[i] * b[i];
        ab += a[i] * b[i];
    }
    double rounding = round_off(1, sqrt((double)svd->rows));
    if (aa <= nothing || bb <= nothing || fabs(ab) <= rounding * sqrt(aa * bb)) return false;
    double zeta = (bb - aa) / (2 * ab), t = (zeta >= 0 ? 1 : -1) / (fabs(zeta) + hypot(1, zeta));
    double c = 1 / hypot(1, t), s = c * t;
    turn(a, b, svd->rows, c, s);
    turn(svd->V + p * svd->cols, svd->V + q * svd->cols, svd->cols, c, s);
    return true;
}

static void swap(double *a, double *b, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        double x = a[i];
        a[i] = b[i];
        b[i] = x;
    }
}

/* Sort by decreasing singular values. */
static void sort(struct svd *svd)
{
    for (size_t k = 0; k < svd->cols; k++) {
        size_t most = k;
        for (size_t j = k + 1; j < svd->cols; j++)
            if (svd->S[j] > svd->S[most]) most = j;
        if (most == k) continue;
        swap(&svd->S[k], &svd->S[most], 1);
        swap(svd->U + k * svd->rows, svd->U + most * svd->rows, svd->rows);
        swap(svd->V + k * svd->cols, svd->V + most * svd->cols, svd->cols);
    }
}

bool svd_decompose(struct svd *svd, size_t rows, size_t cols, const double *a)
{
    enum { most_sweeps = 60 }; /* six to ten suffice */
    *svd = (struct svd){.rows = rows, .cols = cols, .U = calloc(cols * (rows + cols + 1) + 1, sizeof *a)};
    if (!svd->U) return false;
    svd->V = svd->U + rows * cols;
    svd->S = svd->V + cols * cols;
    double size = 0;
    for (size_t j = 0; j < cols; j++) {
        for (size_t i = 0; i < rows; i++) {
            svd->U[j * rows + i] = a[i * cols + j];
            size += a[i * cols + j] * a[i * cols + j];
        }
        svd->V[j * cols + j] = 1;
    }
    double nothing = round_off(1, round_off(1, size));
    bool turned = true;
    for (int sweep = 0; turned && sweep < most_sweeps; sweep++) {
        turned = false;
        for (size_t p = 0; p < cols; p++)
            for (size_t q = p + 1; q < cols; q++) turned |= rotate(svd, p, q, nothing);
    }
    for (size_t j = 0; j < cols; j++) svd->S[j] = sqrt(dot(svd->U + j * rows, svd->U + j * rows, rows));
    sort(svd);
    while (svd->rank < cols && svd->S[svd->rank] > singular_value_zero * svd->S[0]) svd->rank++;
    return true;
}

void svd_free(struct svd *svd)
{
    free(svd->U);
    svd->U = NULL;
}

void svd_add_solution(const struct svd *svd, const double *b, double *x)
{
    for (size_t k = 0; k < svd->rank; k++) {
        double share = dot(svd->U + k * svd->rows, b, svd->rows) / (svd->S[k] * svd->S[k]);
        for (size_t j = 0; j < svd->cols; j++) x[j] += share * svd->V[k * svd->cols + j];
    }
}
