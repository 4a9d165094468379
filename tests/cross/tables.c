/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Functions by points, each as its author wrote it down: the natural or periodic cubic spline from its second
 * derivatives, by one full system; Akima (J. ACM 17, 1970) and Steffen (A&A 239, 1990) from slopes at the points.
 */
#include <math.h>
#include <string.h>

#include "scene.h"

enum { most = most_table_points };

static double chord(const struct table *table, int i)
{
    return (table->y[i + 1] - table->y[i]) / (table->x[i + 1] - table->x[i]);
}

/* ---- splines of second derivatives M: for each inner point
 *
 *     h0 M0 + 2 (h0 + h1) M1 + h1 M2 = 6 (chord1 - chord0) */

static void eliminate(int n, double a[most][most + 1], double *x)
{
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(a[i][k]) > fabs(a[best][k])) best = i;
        for (int j = 0; j <= n; j++) {
            double keep = a[k][j];
            a[k][j] = a[best][j];
            a[best][j] = keep;
        }
        for (int i = k + 1; i < n; i++)
            for (int j = n; j >= k; j--) a[i][j] -= a[i][k] / a[k][k] * a[k][j];
    }
    for (int k = n - 1; k >= 0; k--) {
        x[k] = a[k][n];
        for (int j = k + 1; j < n; j++) x[k] -= a[k][j] * x[j];
        x[k] /= a[k][k];
    }
}

static void second_derivatives(const struct table *table, double *M)
{
    int n = table->count, last = n - 1;
    double a[most][most + 1];
    memset(a, 0, sizeof a);
    bool turns = table->beyond == beyond_repeats;
    for (int i = 0; i < n; i++) {
        if (i == last || (i == 0 && !turns)) {
            a[i][i] = 1; /* 0, or that of the first point */
            if (turns) a[i][0] = -1;
            continue;
        }
        int before = i == 0 ? last - 1 : i - 1;
        double h0 = table->x[before + 1] - table->x[before], h1 = table->x[i + 1] - table->x[i];
        a[i][before] += h0;
        a[i][i] += 2 * (h0 + h1);
        a[i][i + 1] += h1;
        a[i][n] = 6 * (chord(table, i) - chord(table, before));
    }
    eliminate(n, a, M);
}

/* ---- slopes at the points */

/* Of the piece i, which may be two beyond the ends. */
static double akima_chord(const struct table *table, int i)
{
    int pieces = table->count - 1;
    if (table->beyond == beyond_repeats) return chord(table, (i + 2 * pieces) % pieces);
    if (i < 0) return 2 * akima_chord(table, i + 1) - akima_chord(table, i + 2);
    if (i >= pieces) return 2 * akima_chord(table, i - 1) - akima_chord(table, i - 2);
    return chord(table, i);
}

static double akima_slope(const struct table *table, int i)
{
    double far = akima_chord(table, i - 2), left = akima_chord(table, i - 1), right = akima_chord(table, i);
    double left_weight = fabs(akima_chord(table, i + 1) - right), right_weight = fabs(left - far);
    if (left_weight + right_weight == 0) return (left + right) / 2;
    return (left_weight * left + right_weight * right) / (left_weight + right_weight);
}

static double sign_of(double u)
{
    return u < 0 ? -1 : 1;
}

/* At the ends that of the piece. */
static double steffen_slope(const struct table *table, int i)
{
    int last = table->count - 1;
    if (i == 0) return chord(table, 0);
    if (i == last) return chord(table, last - 1);
    double h0 = table->x[i] - table->x[i - 1], h1 = table->x[i + 1] - table->x[i];
    double s0 = chord(table, i - 1), s1 = chord(table, i), p = (s0 * h1 + s1 * h0) / (h0 + h1);
    return (sign_of(s0) + sign_of(s1)) * fmin(fmin(fabs(s0), fabs(s1)), fabs(p) / 2);
}

/* The cubic of piece i, at d from where it begins, by its slopes at both ends. */
static void hermite(const struct table *table, int i, double d, double slope, double end, double f[3])
{
    double h = table->x[i + 1] - table->x[i], s = chord(table, i);
    double c2 = (3 * s - 2 * slope - end) / h, c3 = (slope + end - 2 * s) / (h * h);
    f[0] = table->y[i] + d * (slope + d * (c2 + d * c3));
    f[1] = slope + d * (2 * c2 + 3 * d * c3);
    f[2] = 2 * c2 + 6 * d * c3;
}

static void cubic(const struct table *table, int i, double d, double f[3])
{
    double M[most], h = table->x[i + 1] - table->x[i];
    second_derivatives(table, M);
    double third = (M[i + 1] - M[i]) / h, slope = chord(table, i) - h * (2 * M[i] + M[i + 1]) / 6;
    f[0] = table->y[i] + d * (slope + d * (M[i] / 2 + d * third / 6));
    f[1] = slope + d * (M[i] + d * third / 2);
    f[2] = M[i] + d * third;
}

void value_by_table(const struct table *table, double u, double f[3])
{
    int last = table->count - 1, i = 0;
    double from = table->x[0], to = table->x[last];
    f[0] = f[1] = f[2] = 0;
    if (table->beyond == beyond_repeats) u -= (to - from) * floor((u - from) / (to - from));
    if (u < from || u > to) {
        if (table->beyond == beyond_holds) f[0] = u < from ? table->y[0] : table->y[last];
        return;
    }
    while (i < last - 1 && u >= table->x[i + 1]) i++;
    double d = u - table->x[i];
    switch (table->interpolation) {
    case by_lines:
        f[1] = chord(table, i);
        f[0] = table->y[i] + d * f[1];
        break;
    case by_steps: f[0] = u < to ? table->y[i] : table->y[last]; break;
    case by_cubics: cubic(table, i, d, f); break;
    case by_akima: hermite(table, i, d, akima_slope(table, i), akima_slope(table, i + 1), f); break;
    case by_steffen: hermite(table, i, d, steffen_slope(table, i), steffen_slope(table, i + 1), f); break;
    }
}
