/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "numeric/lcp.h"

#include <math.h>
#include <stdlib.h>

#include "numeric/tolerances.h"
#include "numeric/vector.h"

/* The rows w - M z - z_0 = q of the basic variables. Variable k < n is w_k, n + k is z_k, 2 n is z_0. The columns of basic
 * variables are unit vectors and not stored. */
struct tableau {
    size_t n, width;
    double *T;              /* n rows of width: the columns of the n + 1 other variables, then q */
    size_t *basic;          /* of each row */
    size_t *other;          /* of each column */
    size_t *place;          /* 2 n + 1: the row of each basic variable, n + the column of each other one */
    double *pivots, *ratio; /* n each: the column of the entering variable; ratios of tied rows */
    size_t *tied;           /* n: rows that are tied */
};

static double *row_of(const struct tableau *tableau, size_t i)
{
    return tableau->T + i * tableau->width;
}

static void tableau_free(struct tableau *tableau)
{
    free(tableau->T);
    free(tableau->basic);
}

/* The entries of the column that makes the start feasible: ones, or others between 1/4 and 7/4. */
static double cover_of(int cover, size_t i)
{
    const double golden = 0.6180339887498949;
    return cover == 0 ? 1 : 0.25 + 1.5 * fmod(golden * cover * (double)(i + 1), 1);
}

static bool tableau_new(struct tableau *tableau, size_t n, const double *M, const double *q, int cover)
{
    *tableau = (struct tableau){.n = n, .width = n + 2};
    tableau->T = calloc(n * tableau->width + 2 * n + 1, sizeof *tableau->T);
    tableau->basic = calloc(5 * n + 2, sizeof *tableau->basic);
    if (!tableau->T || !tableau->basic) return false;
    tableau->other = tableau->basic + n;
    tableau->place = tableau->other + n + 1;
    tableau->tied = tableau->place + 2 * n + 1;
    tableau->pivots = tableau->T + n * tableau->width;
    tableau->ratio = tableau->pivots + n;
    double size = 0;
    for (size_t i = 0; i < n; i++) size = fmax(size, fabs(q[i]));
    for (size_t i = 0; i < n; i++) {
        double *row = row_of(tableau, i);
        for (size_t k = 0; k < n; k++)
            if (M[i * n + k] != 0) row[k] = -M[i * n + k];
        row[n] = -cover_of(cover, i);
        row[n + 1] = q[i] / (size > 0 ? size : 1);
        tableau->basic[i] = tableau->place[i] = i;
    }
    for (size_t k = 0; k <= n; k++) {
        tableau->other[k] = n + k;
        tableau->place[n + k] = n + k;
    }
    return true;
}

/* Exchange the basic variable of row r for that of column e. */
static void pivot(struct tableau *tableau, size_t r, size_t e)
{
    double *by = row_of(tableau, r), inverse = 1 / by[e];
    size_t left = tableau->basic[r], entered = tableau->other[e];
    for (size_t k = 0; k < tableau->width; k++) by[k] *= inverse;
    by[e] = inverse;
    for (size_t i = 0; i < tableau->n; i++) {
        double *row = row_of(tableau, i), share = row[e];
        if (i == r || share == 0) continue;
        row[e] = 0;
        vector_add_multiple(row, by, -share, tableau->width);
    }
    tableau->basic[r] = entered;
    tableau->place[entered] = r;
    tableau->other[e] = left;
    tableau->place[left] = tableau->n + e;
}

/* The entry of row i in the column of w_k. */
static double entry_of_w(const struct tableau *tableau, size_t i, size_t k)
{
    size_t place = tableau->place[k];
    if (place < tableau->n) return place == i;
    return row_of(tableau, i)[place - tableau->n];
}

/* Keep of the tied rows those with the least ratio of their entries in a column, that of w_k or q (k = n), to those in the
 * column of the entering variable. Returns how many. */
static size_t keep_least(const struct tableau *tableau, size_t k, size_t count)
{
    size_t *tied = tableau->tied, kept = 0;
    double *ratio = tableau->ratio, least = HUGE_VAL;
    for (size_t t = 0; t < count; t++) {
        size_t i = tied[t];
        ratio[t] = (k < tableau->n ? entry_of_w(tableau, i, k) : row_of(tableau, i)[tableau->width - 1]) /
                   tableau->pivots[i];
        least = fmin(least, ratio[t]);
    }
    double most = least + undecided_part * (1 + fabs(least));
    for (size_t t = 0; t < count; t++)
        if (ratio[t] <= most) tied[kept++] = tied[t];
    return kept;
}

/* The row whose variable first reaches zero as the one of column `entering` grows; n for none. z_0 has priority, since
 * its leaving ends the method. */
static size_t leaving_row(const struct tableau *tableau, size_t entering)
{
    size_t n = tableau->n, count = 0;
    for (size_t i = 0; i < n; i++) {
        tableau->pivots[i] = row_of(tableau, i)[entering];
        if (tableau->pivots[i] > undecided_part) tableau->tied[count++] = i;
    }
    if (count == 0) return n;
    count = keep_least(tableau, n, count);
    for (size_t t = 0; t < count; t++)
        if (tableau->basic[tableau->tied[t]] == 2 * n) return tableau->tied[t];
    for (size_t k = 0; k < n && count > 1; k++) count = keep_least(tableau, k, count);
    return tableau->tied[0];
}

/* The row that is farthest below zero relative to its cover, or n. */
static size_t lowest_row(const struct tableau *tableau)
{
    size_t best = tableau->n, last = tableau->width - 1;
    double lowest = 0;
    for (size_t i = 0; i < tableau->n; i++) {
        const double *row = row_of(tableau, i);
        double low = row[last] / -row[last - 1];
        if (!(low < lowest)) continue;
        best = i;
        lowest = low;
    }
    return best;
}

static enum lcp run(struct tableau *tableau)
{
    size_t n = tableau->n, most = 100 + 50 * n, r = lowest_row(tableau);
    if (r == n) return lcp_solved;
    size_t entering = n;
    for (size_t count = 0; count < most; count++) {
        size_t left = tableau->basic[r];
        pivot(tableau, r, entering);
        if (left == 2 * n) return lcp_solved;
        entering = tableau->place[left < n ? left + n : left - n] - n;
        r = leaving_row(tableau, entering);
        if (r == n) return lcp_ray;
    }
    return lcp_lost;
}

enum lcp lcp_find_basis(size_t n, const double *M, const double *q, int cover, bool *is_basic)
{
    struct tableau tableau;
    enum lcp found = tableau_new(&tableau, n, M, q, cover) ? run(&tableau) : lcp_no_memory;
    for (size_t k = 0; k < n && found == lcp_solved; k++) is_basic[k] = tableau.place[n + k] < n;
    tableau_free(&tableau);
    return found;
}
