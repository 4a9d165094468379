/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The least admissible forces of given modes. With C the rows between their limits, and x_l = base + gain x_k of the others,
 *
 *     K x_C = right,    K_ij = A_ij + sum over l at a limit, of = j: A_il gain_l
 *
 * Rows of K are orthogonalised, the largest remainder first (modified Gram-Schmidt with reorthogonalisation), which gives
 * the rank and, with the same operations on the right-hand side, the components of the least solution. From there limits are
 * satisfied by the dual active-set method (active_set.h).
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/active_set.h"
#include "numeric/pivoting_block.h"
#include "numeric/tolerances.h"
#include "numeric/vector.h"

/* coefficient x_a + other x_k >= least; k = m without another one. */
struct bound {
    size_t a, k;
    double coefficient, other, least;
};

struct fit {
    struct pivoting_block *block;
    struct active_set set;  /* of the rows of C */
    size_t *row;            /* of each row of C: index in the block */
    size_t *place;          /* of each row of the block: index in C, or its number n */
    double *base, *gain;    /* of each row of the block that is at a limit */
    bool *is_loose;         /* of each row of the block: w may have any sign */
    double *right, *square; /* of each row of C: right-hand side, and squared size of the remainder */
    double first;           /* the largest squared size */
};

void pivoting_fit_free(struct fit *fit)
{
    if (!fit) return;
    active_set_free(&fit->set);
    free(fit->row);
    free(fit->base);
    free(fit->is_loose);
    free(fit);
}

struct fit *pivoting_fit_new(size_t most)
{
    size_t n = most + 1;
    struct fit *fit = calloc(1, sizeof *fit);
    if (!fit) return NULL;
    fit->row = calloc(2 * n, sizeof *fit->row);
    fit->base = calloc(4 * n, sizeof *fit->base);
    fit->is_loose = calloc(n, sizeof *fit->is_loose);
    if (active_set_new(&fit->set, n, 2 * n) && fit->row && fit->base && fit->is_loose) {
        fit->place = fit->row + n;
        fit->gain = fit->base + n;
        fit->right = fit->gain + n;
        fit->square = fit->right + n;
        return fit;
    }
    pivoting_fit_free(fit);
    return NULL;
}

/* ---- rows at their limits, and rows between */

/* The side of the limit at which a row is. */
static bool is_high(const struct pivoting_row *row)
{
    return (row->slips != 0 ? row->slips : row->mode) == at_high;
}

/* How far its limits are apart, but for the share of a row that is between its own. */
static bool has_range(const struct fit *fit, const struct pivoting_row *row)
{
    double shares = pivoting_share(fit->block, row, true) - pivoting_share(fit->block, row, false);
    if (row->of >= 0 && fit->place[row->of] < fit->block->n && shares != 0) return true;
    double range = pivoting_limit(row, true) - pivoting_limit(row, false);
    return range + (row->of >= 0 ? shares * fit->base[row->of] : 0) > 0;
}

/* Is the row between its limits? Not where these coincide, as of friction without a normal force. */
static bool is_between(const struct fit *fit, const struct pivoting_row *row)
{
    if (pivoting_is_fixed(row)) return false;
    if (row->mode != between && fabs(pivoting_limit(row, is_high(row))) < HUGE_VAL) return false;
    return has_range(fit, row);
}

static void set_place(struct fit *fit, size_t i)
{
    const struct pivoting_row *row = &fit->block->rows[i];
    size_t n = fit->block->n;
    fit->place[i] = n;
    fit->base[i] = fit->gain[i] = 0;
    if (is_between(fit, row)) {
        fit->place[i] = fit->set.n;
        fit->row[fit->set.n++] = i;
        return;
    }
    double part = pivoting_part(fit->block, row);
    fit->is_loose[i] = pivoting_is_fixed(row) || !has_range(fit, row);
    fit->base[i] = part * pivoting_limit(row, is_high(row));
    fit->gain[i] = part * pivoting_share(fit->block, row, is_high(row));
    if (row->of < 0 || fit->place[row->of] < n) return;
    fit->base[i] += fit->gain[i] * fit->base[row->of];
    fit->gain[i] = 0;
}

/* Rows on which limits of others depend come first. */
static void set_places(struct fit *fit)
{
    size_t n = fit->block->n;
    fit->set.n = 0;
    for (int coupled = 0; coupled < 2; coupled++)
        for (size_t i = 0; i < n; i++)
            if ((fit->block->rows[i].of >= 0) == coupled) set_place(fit, i);
}

static void set_equations(struct fit *fit)
{
    const struct pivoting_block *block = fit->block;
    size_t n = block->n, m = fit->set.n;
    for (size_t a = 0; a < m; a++) {
        const double *A = block->A + fit->row[a] * n;
        double *row = fit->set.rows + a * m;
        fit->set.order[a] = a;
        fit->right[a] = -block->rows[fit->row[a]].b;
        for (size_t c = 0; c < m; c++) row[c] = A[fit->row[c]];
        for (size_t l = 0; l < n; l++) {
            if (fit->place[l] < n) continue;
            fit->right[a] -= A[l] * fit->base[l];
            if (fit->gain[l] != 0) row[fit->place[block->rows[l].of]] += A[l] * fit->gain[l];
        }
    }
}

/* ---- orthonormal rows */

/* Make remainder k orthogonal to the rows before it once more, and of length one. */
static void normalise(struct fit *fit, size_t k)
{
    double *own = active_set_row(&fit->set, k);
    for (size_t j = 0; j < k; j++) {
        double share = vector_dot(own, active_set_row(&fit->set, j), fit->set.n);
        if (share == 0) continue;
        vector_add_multiple(own, active_set_row(&fit->set, j), -share, fit->set.n);
        fit->right[fit->set.order[k]] -= share * fit->right[fit->set.order[j]];
    }
    double size = sqrt(vector_dot(own, own, fit->set.n));
    for (size_t c = 0; c < fit->set.n; c++) own[c] /= size;
    fit->right[fit->set.order[k]] /= size;
}

/* Squares of small remainders are computed anew: their differences would be round-off. */
static void remove_from_others(struct fit *fit, size_t k)
{
    const double *own = active_set_row(&fit->set, k);
    for (size_t l = k + 1; l < fit->set.n; l++) {
        double *other = active_set_row(&fit->set, l), share = vector_dot(own, other, fit->set.n);
        if (share == 0) continue;
        vector_add_multiple(other, own, -share, fit->set.n);
        fit->right[fit->set.order[l]] -= share * fit->right[fit->set.order[k]];
        double *square = &fit->square[fit->set.order[l]];
        *square -= share * share;
        if (*square <= pivoting_zero * fit->first) *square = vector_dot(other, other, fit->set.n);
    }
}

/* Remainders, relative to the largest row, that count as zero. */
static double negligible_remainder(const struct fit *fit)
{
    return fit->block->coarse ? dependent_row : pivoting_zero;
}

/* The rank of K, and x as its least solution. */
static void solve_equations(struct fit *fit)
{
    const double least = negligible_remainder(fit);
    size_t m = fit->set.n;
    for (size_t a = 0; a < m; a++)
        fit->square[a] = vector_dot(fit->set.rows + a * m, fit->set.rows + a * m, m);
    memset(fit->set.x, 0, m * sizeof *fit->set.x);
    for (fit->set.rank = 0; fit->set.rank < m; fit->set.rank++) {
        size_t k = fit->set.rank, most = k;
        for (size_t l = k + 1; l < m; l++)
            if (fit->square[fit->set.order[l]] > fit->square[fit->set.order[most]]) most = l;
        size_t kept = fit->set.order[most];
        fit->set.order[most] = fit->set.order[k];
        fit->set.order[k] = kept;
        if (k == 0) fit->first = fit->square[kept];
        if (!(fit->square[kept] > least * least * fit->first)) break;
        normalise(fit, k);
        remove_from_others(fit, k);
        vector_add_multiple(fit->set.x, active_set_row(&fit->set, k), fit->right[kept], m);
    }
}

/* ---- limits */

/* Bound 2 a + high; false without one. */
static bool bound_at(const struct fit *fit, size_t index, struct bound *bound)
{
    size_t a = index / 2, n = fit->block->n;
    bool high = index % 2 == 1;
    const struct pivoting_row *row = &fit->block->rows[fit->row[a]];
    double side = high ? -1 : 1, limit = pivoting_limit(row, high),
           share = pivoting_share(fit->block, row, high);
    *bound = (struct bound){.a = a, .k = fit->set.n, .coefficient = side, .least = side * limit};
    if (fabs(limit) == HUGE_VAL) return false;
    if (row->of < 0) return true;
    if (fit->place[row->of] == n) {
        bound->least += side * share * fit->base[row->of];
        return true;
    }
    bound->k = fit->place[row->of];
    bound->other = -side * share;
    return true;
}

static double excess_of(const struct fit *fit, const struct bound *bound, const double *x)
{
    double value = bound->coefficient * x[bound->a] - bound->least;
    return bound->k < fit->set.n ? value + bound->other * x[bound->k] : value;
}

static double limit_excess(const void *context, size_t index, const double *x, double *size)
{
    const struct fit *fit = context;
    struct bound bound;
    *size = 1;
    if (!bound_at(fit, index, &bound)) return HUGE_VAL;
    *size = sqrt(1 + bound.other * bound.other);
    return excess_of(fit, &bound, x);
}

static void add_limit_normal(const void *context, size_t index, double *vector)
{
    const struct fit *fit = context;
    struct bound bound;
    if (!bound_at(fit, index, &bound)) return;
    vector[bound.a] += bound.coefficient;
    if (bound.k < fit->set.n) vector[bound.k] += bound.other;
}

/* ---- the results */

/* `limited`: forces beyond a limit by round-off are put to it. */
static void set_forces(struct fit *fit, bool limited)
{
    struct pivoting_block *block = fit->block;
    size_t n = block->n;
    for (int coupled = 0; coupled < 2; coupled++)
        for (size_t i = 0; i < n; i++) {
            struct pivoting_row *row = &block->rows[i];
            if ((row->of >= 0) != coupled) continue;
            double of = coupled ? block->rows[row->of].x : 0;
            row->x = fit->place[i] < n ? fit->set.x[fit->place[i]] : fit->base[i] + fit->gain[i] * of;
            if (fit->place[i] == n || !limited) continue;
            row->x = fmin(row->x, pivoting_limit(row, true) + pivoting_share(block, row, true) * of);
            row->x = fmax(row->x, pivoting_limit(row, false) + pivoting_share(block, row, false) * of);
        }
}

/* Rows that depend on others have the accelerations that the shift of rows leaves. */
static bool has_sign(const struct fit *fit, size_t i)
{
    struct pivoting_row *row = &fit->block->rows[i];
    double level = fit->block->level;
    if (fit->place[i] < fit->block->n)
        return fabs(row->w) <= (fit->block->coarse ? shift_of_rows / solved_rounding : 1) * level;
    if (fit->is_loose[i]) return true;
    return row->mode == at_high ? row->w <= level : row->w >= -level;
}

double pivoting_level(const struct pivoting_block *block, const struct pivoting_row *rows)
{
    double square = 0;
    for (size_t i = 0; i < block->n; i++) square += rows[i].x * rows[i].x;
    return solved_rounding * (block->size + sqrt(square));
}

static bool set_accelerations(struct fit *fit)
{
    struct pivoting_block *block = fit->block;
    size_t n = block->n;
    bool fits = true;
    block->level = pivoting_level(block, block->rows);
    for (size_t i = 0; i < n; i++) {
        struct pivoting_row *row = &block->rows[i];
        row->w = row->b;
        for (size_t j = 0; j < n; j++) row->w += block->A[i * n + j] * block->rows[j].x;
        fits &= has_sign(fit, i);
        if (fit->place[i] < n || fabs(row->w) <= block->level) row->w = 0;
    }
    return fits;
}

static struct fit *fit_equations(struct pivoting_block *block)
{
    struct fit *fit = block->fit;
    fit->block = block;
    set_places(fit);
    set_equations(fit);
    solve_equations(fit);
    return fit;
}

bool pivoting_fit(struct pivoting_block *block)
{
    struct fit *fit = fit_equations(block);
    struct half_spaces limits = {2 * fit->set.n, fit, limit_excess, add_limit_normal};
    size_t index = active_set_satisfy(&fit->set, &limits, block->size);
    block->beyond = index < limits.count ? fit->row[index / 2] : block->n;
    block->at = index % 2 == 0 ? at_low : at_high;
    if (block->beyond < block->n) return false;
    set_forces(fit, true);
    return set_accelerations(fit);
}

void pivoting_guess(struct pivoting_block *block)
{
    struct fit *fit = fit_equations(block);
    set_forces(fit, false);
    (void)set_accelerations(fit);
}
