/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A block as a linear complementarity problem. With y = w of a row with a lower limit and -w of one with an upper limit only,
 *
 *     lower limit only      x = low + low_share x_k + z      y ⟂ z
 *     upper limit only      x = high + high_share x_k - z    y ⟂ z
 *     both                  x = low + low_share x_k + z      y + z'' ⟂ z,   z'' ⟂ upper limit - x
 *     fixed                 x = low + low_share x_k
 *     load                  as with a limit at zero on the side of its present sign
 *
 * (Glocker, Set-Valued Force Laws, 2001, chapter 8). Rows without limits are eliminated by principal pivots first; those
 * that depend on others keep x = 0.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/pivoting_block.h"
#include "numeric/tolerances.h"

struct path {
    const struct pivoting_block *block;
    size_t n, unknowns;
    double *A;     /* n rows of n + 1: A and b, after elimination of rows without limits */
    bool *is_out;  /* n: eliminated */
    size_t *first; /* n: index of z of each row, that of z'' is the next; `none` */
    double *M, *q; /* of the complementarity problem */
    bool *is_basic;
};

static const size_t none = (size_t)-1;

static bool has_low(const struct pivoting_row *row)
{
    return pivoting_limit(row, false) > -HUGE_VAL;
}

static bool has_high(const struct pivoting_row *row)
{
    return pivoting_limit(row, true) < HUGE_VAL;
}

static bool has_none(const struct pivoting_row *row)
{
    return !has_low(row) && !has_high(row);
}

static void set_unknowns(struct path *path)
{
    for (size_t i = 0; i < path->n; i++) {
        const struct pivoting_row *row = &path->block->rows[i];
        path->first[i] = none;
        if (has_none(row) || pivoting_is_fixed(row)) continue;
        path->first[i] = path->unknowns;
        path->unknowns += 1 + (size_t)(has_low(row) && has_high(row));
    }
}

static bool path_new(struct path *path, const struct pivoting_block *block)
{
    size_t n = block->n;
    *path = (struct path){.block = block, .n = n};
    path->first = calloc(n + 1, sizeof *path->first);
    if (!path->first) return false;
    set_unknowns(path);
    size_t m = path->unknowns;
    path->A = calloc(n * (n + 1) + m * (m + 1) + 1, sizeof *path->A);
    path->is_out = calloc(n + m + 1, sizeof *path->is_out);
    if (!path->A || !path->is_out) return false;
    path->M = path->A + n * (n + 1);
    path->q = path->M + m * m;
    path->is_basic = path->is_out + n;
    for (size_t i = 0; i < n; i++) {
        memcpy(path->A + i * (n + 1), block->A + i * n, n * sizeof *path->A);
        path->A[i * (n + 1) + n] = block->rows[i].b;
    }
    return true;
}

static void path_free(struct path *path)
{
    free(path->first);
    free(path->A);
    free(path->is_out);
}

/* Subtract multiples of row e from all others, so that its w = 0 holds for any other forces. */
static void eliminate(struct path *path, size_t e)
{
    size_t width = path->n + 1;
    const double *by = path->A + e * width;
    path->is_out[e] = true;
    for (size_t i = 0; i < path->n; i++) {
        double *row = path->A + i * width, share = row[e] / by[e];
        if (path->is_out[i] || share == 0) continue;
        for (size_t j = 0; j < width; j++) row[j] -= share * by[j];
        row[e] = 0;
    }
}

/* The largest pivot of the remaining rows without limits, or n. */
static size_t largest_pivot(const struct path *path)
{
    size_t best = path->n;
    double most = pivoting_zero;
    for (size_t i = 0; i < path->n; i++) {
        double own = path->A[i * (path->n + 1) + i];
        if (path->is_out[i] || !has_none(&path->block->rows[i]) || !(own > most)) continue;
        most = own;
        best = i;
    }
    return best;
}

/* Add `factor` x_j, as a function of the unknowns, to a row of M and q. */
static void add_multiplier(const struct path *path, size_t j, double factor, double *row, double *q)
{
    const struct pivoting_row *own = &path->block->rows[j];
    bool high = own->slips != 0 ? own->slips == at_high : !has_low(own);
    double part = factor * pivoting_part(path->block, own);
    if (has_none(own)) return; /* eliminated, or zero */
    *q += part * pivoting_limit(own, high);
    if (path->first[j] != none) row[path->first[j]] += high ? -factor : factor;
    double share = own->of >= 0 ? part * pivoting_share(path->block, own, high) : 0;
    if (share != 0) add_multiplier(path, (size_t)own->of, share, row, q);
}

static void set_row(struct path *path, size_t i)
{
    const struct pivoting_row *own = &path->block->rows[i];
    size_t k = path->first[i], m = path->unknowns, n = path->n;
    double side = has_low(own) ? 1 : -1, *row = path->M + k * m;
    const double *A = path->A + i * (n + 1);
    path->q[k] = side * A[n];
    for (size_t j = 0; j < n; j++)
        if (A[j] != 0) add_multiplier(path, j, side * A[j], row, &path->q[k]);
    if (!has_low(own) || !has_high(own)) return;
    row[k + 1] += 1;
    row += m;
    row[k] = -1;
    path->q[k + 1] = own->high - own->low;
    double share = pivoting_share(path->block, own, true) - pivoting_share(path->block, own, false);
    if (own->of >= 0) add_multiplier(path, (size_t)own->of, share, row, &path->q[k + 1]);
}

static int mode_at_end(const struct path *path, size_t i)
{
    const struct pivoting_row *row = &path->block->rows[i];
    size_t k = path->first[i];
    if (k == none) return row->slips != 0 ? row->slips : has_none(row) ? between : at_low;
    if (row->load != load_is_force) return (path->is_basic[k] ? 1 : -1) * (has_low(row) ? 1 : -1);
    if (!path->is_basic[k]) return has_low(row) ? at_low : at_high;
    return has_low(row) && has_high(row) && path->is_basic[k + 1] ? at_high : between;
}

enum lcp pivoting_lemke(struct pivoting_block *block, int cover)
{
    struct path path;
    enum lcp found = lcp_no_memory;
    if (path_new(&path, block)) {
        for (size_t e = largest_pivot(&path); e < path.n; e = largest_pivot(&path)) eliminate(&path, e);
        for (size_t i = 0; i < path.n; i++)
            if (path.first[i] != none) set_row(&path, i);
        found = lcp_find_basis(path.unknowns, path.M, path.q, cover, path.is_basic);
    }
    for (size_t i = 0; i < path.n && found == lcp_solved; i++) block->rows[i].mode = mode_at_end(&path, i);
    path_free(&path);
    return found;
}
