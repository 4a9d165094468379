/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dense.h"

#include <math.h>

static double norm_below(const double *column, int from, int n)
{
    double sum = 0;
    for (int i = from; i < n; i++) sum += column[i] * column[i];
    return sqrt(sum);
}

static void exchange(struct dense *dense, int j, int k)
{
    if (j == k) return;
    for (int i = 0; i < dense->n; i++) {
        double keep = dense->a[j][i];
        dense->a[j][i] = dense->a[k][i];
        dense->a[k][i] = keep;
    }
    int keep = dense->order[j];
    dense->order[j] = dense->order[k];
    dense->order[k] = keep;
}

static void reflect(const double *v, double vv, int from, int n, double *column)
{
    double dot = 0;
    for (int i = from; i < n; i++) dot += v[i] * column[i];
    for (int i = from; i < n; i++) column[i] -= 2 * dot / vv * v[i];
}

/* Column j onto its diagonal entry. */
static void eliminate(struct dense *dense, int j)
{
    int n = dense->n;
    double *column = dense->a[j], v[dense_room] = {0}, vv = 0, size = norm_below(column, j, n);
    for (int i = j; i < n; i++) v[i] = column[i];
    v[j] += v[j] < 0 ? -size : size;
    for (int i = j; i < n; i++) vv += v[i] * v[i];
    if (vv == 0) return;
    for (int k = j; k < n; k++) reflect(v, vv, j, n, dense->a[k]);
    reflect(v, vv, j, n, dense->b);
}

void dense_solve(struct dense *dense, double *x)
{
    int n = dense->n;
    double first = 0, rest, whole = norm_below(dense->b, 0, n);
    for (int j = 0; j < n; j++) dense->order[j] = j;
    dense->rank = n;
    dense->condition = 1;
    dense->gap = 0;
    for (int j = 0; j < n; j++) {
        int best = j;
        double most = -1;
        for (int k = j; k < n; k++) {
            double size = norm_below(dense->a[k], j, n);
            if (size > most * (1 + 1e-14)) most = size, best = k;
        }
        if (j == 0) first = most;
        if (most <= 1e-10 * first) {
            dense->rank = j;
            dense->gap = most / first;
            break;
        }
        dense->condition = first / most;
        exchange(dense, j, best);
        eliminate(dense, j);
    }
    rest = norm_below(dense->b, dense->rank, n);
    dense->leftover = whole > 0 ? rest / whole : 0;
    double y[dense_room] = {0};
    for (int j = dense->rank - 1; j >= 0; j--) {
        double sum = dense->b[j];
        for (int k = j + 1; k < dense->rank; k++) sum -= dense->a[k][j] * y[k];
        y[j] = sum / dense->a[j][j];
    }
    for (int j = 0; j < n; j++) x[dense->order[j]] = y[j];
}

void dense_null(const struct dense *dense, int k, double *x)
{
    double y[dense_room] = {0};
    int free = dense->rank + k;
    y[free] = 1;
    for (int j = dense->rank - 1; j >= 0; j--) {
        double sum = -dense->a[free][j];
        for (int i = j + 1; i < dense->rank; i++) sum -= dense->a[i][j] * y[i];
        y[j] = sum / dense->a[j][j];
    }
    for (int j = 0; j < dense->n; j++) x[dense->order[j]] = y[j];
}

void dense_solve_regular(struct dense *dense, double *x)
{
    int n = dense->n;
    for (int j = 0; j < n; j++) {
        int best = j;
        for (int i = j + 1; i < n; i++)
            if (fabs(dense->a[j][i]) > fabs(dense->a[j][best])) best = i;
        for (int k = j; k < n && best != j; k++) {
            double keep = dense->a[k][j];
            dense->a[k][j] = dense->a[k][best];
            dense->a[k][best] = keep;
        }
        double keep = dense->b[j];
        dense->b[j] = dense->b[best];
        dense->b[best] = keep;
        double *l = dense->a[j];
        for (int i = j + 1; i < n; i++) l[i] /= l[j];
        for (int k = j + 1; k < n; k++) {
            double *column = dense->a[k], top = column[j];
            if (top == 0) continue;
            for (int i = j + 1; i < n; i++) column[i] -= l[i] * top;
        }
        for (int i = j + 1; i < n; i++) dense->b[i] -= l[i] * dense->b[j];
    }
    for (int j = n - 1; j >= 0; j--) {
        double sum = dense->b[j];
        for (int k = j + 1; k < n; k++) sum -= dense->a[k][j] * x[k];
        x[j] = sum / dense->a[j][j];
    }
}
