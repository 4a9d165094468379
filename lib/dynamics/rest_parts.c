/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The indeterminate reactions, part by part: which null vectors interact, and a basis of least reactions.
 */
#include <math.h>
#include <string.h>

#include "dynamics/rest_memo.h"
#include "dynamics/rest_system.h"
#include "holds/parts.h"
#include "numeric/tolerances.h"

/* The relative size below which the contribution of a null vector to a reaction or a limit is rounding. */
static const double no_share = negligible_sum;

/* The rows by which null vectors interact: all reactions, then all limits. */
struct meeting_rows {
    size_t rows, cols;
    const double *of; /* rows x cols */
    const double *most;
};

static bool meet(const void *context, int i, int j)
{
    const struct meeting_rows *all = context;
    for (size_t k = 0; k < all->rows; k++) {
        const double *row = all->of + k * all->cols;
        if (fabs(row[i]) > no_share * all->most[i] && fabs(row[j]) > no_share * all->most[j]) return true;
    }
    return false;
}

/* Compute R Z, then the slopes of the limits; the basis is Z. */
static double *follow_null_vectors(struct rest_system *system)
{
    size_t m = system->m, d = system->basis_count, count = system->reactions;
    double *rows = ARENA_ARRAY(system->arena, (count + system->bound_count) * d + 1, double);
    for (size_t j = 0; rows && j < m; j++)
        for (size_t i = 0; i < count; i++) {
            double R = system->R[j * count + i];
            for (size_t k = 0; R != 0 && k < d; k++) rows[i * d + k] += R * system->basis[j * d + k];
        }
    return rows && rest_bound_slopes(system, rows + count * d) ? rows : NULL;
}

static bool find_parts(struct rest_system *system, const double *rows)
{
    size_t d = system->basis_count;
    double *most = ARENA_ARRAY(system->arena, d + 1, double);
    system->part = ARENA_ARRAY(system->arena, d + 1, int);
    if (!most || !system->part) return false;
    struct meeting_rows all = {system->reactions + system->bound_count, d, rows, most};
    for (size_t i = 0; i < all.rows; i++)
        for (size_t k = 0; k < d; k++) most[k] = fmax(most[k], fabs(rows[i * d + k]));
    system->parts = parts_find((int)d, meet, &all, system->part);
    return true;
}

/* In one part: the least reactions, and a basis in which the norm of their change by w is |w|: with R Z P = Q U, that of the
 * null vectors Z P U^-1. */
static bool set_part_basis(struct rest_system *system, const double *RZ, int which, double *start)
{
    size_t m = system->m, d = system->basis_count, count = system->reactions, size = 0;
    size_t *column = ARENA_ARRAY(system->arena, d + 1, size_t);
    for (size_t k = 0; column && k < d; k++)
        if (system->part[k] == which) column[size++] = k;
    double *own = ARENA_ARRAY(system->arena, count * size + 1, double);
    double *y = ARENA_ARRAY(system->arena, 3 * size + count + 1, double), *z = y ? y + size : NULL;
    if (!column || !own || !y) return false;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < size; k++) own[i * size + k] = RZ[i * d + column[k]];
    const struct qr *least = rest_memo_qr(&system->state->tree->memo, which, count, size, own);
    if (!least) return false;
    double *w = z + size, *r = w + size;
    memcpy(r, system->r, count * sizeof *r);
    qr_add_solution(least, r, y);
    for (size_t j = 0; j < m; j++) {
        double *row = system->basis + j * d;
        for (size_t k = 0; k < size; k++) z[k] = row[column[k]];
        for (size_t k = 0; k < size; k++) start[j] -= z[k] * y[k];
        qr_divide_by_triangle(least, z, w);
        for (size_t k = 0; k < size; k++) row[column[k]] = w[k];
    }
    return true;
}

bool rest_set_basis(struct rest_system *system, double *start)
{
    size_t m = system->m, d = m - system->qr.rank;
    system->basis = ARENA_ARRAY(system->arena, m * d + 1, double);
    system->basis_count = d;
    system->parts = 0;
    if (!system->basis) return false;
    for (size_t k = 0; k < d; k++)
        for (size_t j = 0; j < m; j++) system->basis[j * d + k] = qr_null(&system->qr, j, k);
    const double *rows = d > 0 ? follow_null_vectors(system) : NULL;
    if (d > 0 && (!rows || !find_parts(system, rows))) return false;
    for (int which = 0; which < system->parts; which++)
        if (!set_part_basis(system, rows, which, start)) return false;
    return true;
}

bool rest_part(const struct rest_system *system, const double *G, int which, struct rest_part *part)
{
    size_t count = system->bound_count, d = system->basis_count;
    *part = (struct rest_part){.column = ARENA_ARRAY(system->arena, d + 1, size_t),
                               .limit = ARENA_ARRAY(system->arena, count + 1, size_t)};
    if (!part->column || !part->limit) return false;
    for (size_t k = 0; k < d; k++)
        if (system->part[k] == which) part->column[part->size++] = k;
    for (size_t i = 0; i < count; i++) {
        double most = 0;
        for (size_t k = 0; k < part->size; k++) most = fmax(most, fabs(G[i * d + part->column[k]]));
        if (most > no_share) part->limit[part->limits++] = i;
    }
    part->G = ARENA_ARRAY(system->arena, part->limits * part->size + 1, double);
    if (!part->G) return false;
    for (size_t i = 0; i < part->limits; i++)
        for (size_t k = 0; k < part->size; k++)
            part->G[i * part->size + k] = G[part->limit[i] * d + part->column[k]];
    return true;
}

bool rest_vary(struct rest_system *system, size_t k, double size)
{
    double *w = ARENA_ARRAY(system->arena, system->basis_count + 1, double);
    if (!w) return false;
    w[k] = 1;
    return rest_move(system, w, size);
}
