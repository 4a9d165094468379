/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The least admissible forces of given modes. With C the rows between their limits, and x_l = base + gain x_k of the others,
 *
 *     K x_C = right,    K_ij = A_ij + sum over l at a limit, of = j: A_il gain_l
 *
 * Rows of K are orthogonalised, the largest remainder first (modified Gram-Schmidt with reorthogonalisation), which gives
 * the rank and, with the same operations on the right-hand side, the components of the least solution. That is the start of
 * the dual active-set method of Goldfarb and Idnani (Mathematical Programming 27, 1983, section 4, with the unit matrix as
 * Hessian): limits that are violated become active one after the other, each with the least increase of |x|, and those whose
 * multipliers would become negative are dropped. Normals of active limits extend the same orthonormal rows.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/simd2.h"
#include "numeric/pivoting_block.h"
#include "numeric/tolerances.h"

/* coefficient x_a + other x_k >= least; k = m without another one. */
struct bound {
    size_t a, k;
    double coefficient, other, least;
};

struct fit {
    struct pivoting_block *block;
    size_t m; /* rows of C */
    size_t rank, active;
    size_t *row;         /* m: index in the block */
    size_t *place;       /* of each row of the block: index in C, or its number n */
    double *base, *gain; /* of each row of the block that is at a limit */
    bool *is_loose;      /* of each row of the block: w may have any sign */
    size_t *order; /* m: first `rank` rows of V, orthonormal; then the places of normals of active limits */
    double *V;     /* m rows of m */
    double *right, *square; /* m: right-hand side and squared size of the remainder of each row */
    double first;           /* the largest squared size */
    double *x, *step;       /* m */
    size_t *limit;          /* of each active limit: 2 a, or 2 a + 1 of the upper one */
    bool *is_active;        /* 2 m */
    double *R;              /* column by column, m each: the active normals in the orthonormal rows */
    double *u, *d,
        *r; /* m: multipliers of active limits; components of a normal; change of the multipliers */
};

void *pivoting_fit_memory(size_t most)
{
    size_t n = most + 1;
    struct fit *fit =
        malloc(sizeof *fit + n * ((2 * n + 9) * sizeof(double) + 4 * sizeof(size_t) + 3 * sizeof(bool)));
    if (!fit) return NULL;
    double *next = (double *)(fit + 1);
    double **vectors[] = {&fit->base, &fit->gain, &fit->right, &fit->square, &fit->x,
                          &fit->step, &fit->u,    &fit->d,     &fit->r};
    fit->V = next;
    fit->R = fit->V + n * n;
    next = fit->R + n * n;
    for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++, next += n) *vectors[k] = next;
    size_t *index = (size_t *)next;
    fit->row = index;
    fit->place = index + n;
    fit->order = index + 2 * n;
    fit->limit = index + 3 * n;
    fit->is_loose = (bool *)(index + 4 * n);
    fit->is_active = fit->is_loose + n;
    return fit;
}

/* ---- rows at their limits, and rows between */

static double limit_of(const struct pivoting_row *row, bool high, double *share)
{
    *share = high ? row->high_share : row->low_share;
    return high ? row->high : row->low;
}

/* Is the row between its limits? Not where these coincide, as of friction without a normal force. */
static bool is_between(const struct fit *fit, size_t i)
{
    const struct pivoting_row *row = &fit->block->rows[i];
    double share, limit = limit_of(row, row->mode == at_high, &share);
    if (pivoting_is_fixed(row)) return false;
    if (row->mode != between && fabs(limit) < HUGE_VAL) return false;
    if (row->of < 0 || fit->place[row->of] < fit->block->n) return true;
    return row->high + row->high_share * fit->base[row->of] > row->low + row->low_share * fit->base[row->of];
}

static void set_place(struct fit *fit, size_t i)
{
    const struct pivoting_row *row = &fit->block->rows[i];
    size_t n = fit->block->n;
    fit->place[i] = n;
    fit->base[i] = fit->gain[i] = 0;
    fit->is_loose[i] = pivoting_is_fixed(row);
    if (is_between(fit, i)) {
        fit->place[i] = fit->m;
        fit->row[fit->m++] = i;
        return;
    }
    fit->base[i] = limit_of(row, row->mode == at_high, &fit->gain[i]);
    if (row->of < 0 || fit->place[row->of] < n) return;
    double range = row->high - row->low + (row->high_share - row->low_share) * fit->base[row->of];
    fit->is_loose[i] |= range <= 0;
    fit->base[i] += fit->gain[i] * fit->base[row->of];
    fit->gain[i] = 0;
}

/* Rows on which limits of others depend come first. */
static void set_places(struct fit *fit)
{
    size_t n = fit->block->n;
    fit->m = 0;
    for (int coupled = 0; coupled < 2; coupled++)
        for (size_t i = 0; i < n; i++)
            if ((fit->block->rows[i].of >= 0) == coupled) set_place(fit, i);
}

static void set_equations(struct fit *fit)
{
    const struct pivoting_block *block = fit->block;
    size_t n = block->n, m = fit->m;
    for (size_t a = 0; a < m; a++) {
        const double *A = block->A + fit->row[a] * n;
        double *row = fit->V + a * m;
        fit->order[a] = a;
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

static double *vector_of(const struct fit *fit, size_t k)
{
    return fit->V + fit->order[k] * fit->m;
}

static double dot(const double *a, const double *b, size_t m)
{
    simd2 even = {0, 0}, odd = {0, 0};
    size_t k = 0;
    for (; k + 4 <= m; k += 4) {
        even += simd2_load(a + k) * simd2_load(b + k);
        odd += simd2_load(a + k + 2) * simd2_load(b + k + 2);
    }
    even += odd;
    double sum = even[0] + even[1];
    for (; k < m; k++) sum += a[k] * b[k];
    return sum;
}

static void add_multiple(double *a, const double *b, double share, size_t m)
{
    size_t k = 0;
    for (; k + 4 <= m; k += 4) {
        simd2_store(a + k, simd2_load(a + k) + share * simd2_load(b + k));
        simd2_store(a + k + 2, simd2_load(a + k + 2) + share * simd2_load(b + k + 2));
    }
    for (; k < m; k++) a[k] += share * b[k];
}

/* Make remainder k orthogonal to the rows before it once more, and of length one. */
static void normalise(struct fit *fit, size_t k)
{
    double *own = vector_of(fit, k);
    for (size_t j = 0; j < k; j++) {
        double share = dot(own, vector_of(fit, j), fit->m);
        if (share == 0) continue;
        add_multiple(own, vector_of(fit, j), -share, fit->m);
        fit->right[fit->order[k]] -= share * fit->right[fit->order[j]];
    }
    double size = sqrt(dot(own, own, fit->m));
    for (size_t c = 0; c < fit->m; c++) own[c] /= size;
    fit->right[fit->order[k]] /= size;
}

/* Squares of small remainders are computed anew: their differences would be round-off. */
static void remove_from_others(struct fit *fit, size_t k)
{
    const double *own = vector_of(fit, k);
    for (size_t l = k + 1; l < fit->m; l++) {
        double *other = vector_of(fit, l), share = dot(own, other, fit->m);
        if (share == 0) continue;
        add_multiple(other, own, -share, fit->m);
        fit->right[fit->order[l]] -= share * fit->right[fit->order[k]];
        double *square = &fit->square[fit->order[l]];
        *square -= share * share;
        if (*square <= pivoting_zero * fit->first) *square = dot(other, other, fit->m);
    }
}

/* The rank of K, and x as its least solution. */
static void solve_equations(struct fit *fit)
{
    size_t m = fit->m;
    for (size_t a = 0; a < m; a++) fit->square[a] = dot(fit->V + a * m, fit->V + a * m, m);
    memset(fit->x, 0, m * sizeof *fit->x);
    for (fit->rank = 0; fit->rank < m; fit->rank++) {
        size_t k = fit->rank, most = k;
        for (size_t l = k + 1; l < m; l++)
            if (fit->square[fit->order[l]] > fit->square[fit->order[most]]) most = l;
        size_t kept = fit->order[most];
        fit->order[most] = fit->order[k];
        fit->order[k] = kept;
        if (k == 0) fit->first = fit->square[kept];
        if (!(fit->square[kept] > pivoting_zero * pivoting_zero * fit->first)) break;
        normalise(fit, k);
        remove_from_others(fit, k);
        add_multiple(fit->x, vector_of(fit, k), fit->right[kept], m);
    }
}

/* ---- limits */

/* Bound 2 a + high; false without one. */
static bool bound_at(const struct fit *fit, size_t index, struct bound *bound)
{
    size_t a = index / 2, n = fit->block->n;
    bool high = index % 2 == 1;
    const struct pivoting_row *row = &fit->block->rows[fit->row[a]];
    double side = high ? -1 : 1, share, limit = limit_of(row, high, &share);
    *bound = (struct bound){.a = a, .k = fit->m, .coefficient = side, .least = side * limit};
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

static double excess_of(const struct fit *fit, const struct bound *bound)
{
    double value = bound->coefficient * fit->x[bound->a] - bound->least;
    return bound->k < fit->m ? value + bound->other * fit->x[bound->k] : value;
}

/* The limit that is violated most, or 2 m. */
static size_t most_violated(const struct fit *fit, struct bound *bound)
{
    size_t worst = 2 * fit->m;
    double least = -pivoting_zero * (fit->block->size + sqrt(dot(fit->x, fit->x, fit->m)));
    for (size_t index = 0; index < 2 * fit->m; index++) {
        struct bound own;
        if (fit->is_active[index] || !bound_at(fit, index, &own)) continue;
        double value = excess_of(fit, &own) / sqrt(1 + own.other * own.other);
        if (!(value < least)) continue;
        least = value;
        worst = index;
        *bound = own;
    }
    return worst;
}

/* The step of x, the part of the normal that is orthogonal to all equations and active limits; d, its components along the
 * latter; and r, the decrease of their multipliers. Returns the squared size of the step. */
static double set_directions(struct fit *fit, const struct bound *bound)
{
    size_t m = fit->m, active = fit->active;
    memset(fit->step, 0, m * sizeof *fit->step);
    memset(fit->d, 0, active * sizeof *fit->d);
    fit->step[bound->a] = bound->coefficient;
    if (bound->k < m) fit->step[bound->k] += bound->other;
    for (int round = 0; round < 2; round++)
        for (size_t k = 0; k < fit->rank + active; k++) {
            double share = dot(vector_of(fit, k), fit->step, m);
            if (share == 0) continue;
            add_multiple(fit->step, vector_of(fit, k), -share, m);
            if (k >= fit->rank) fit->d[k - fit->rank] += share;
        }
    for (size_t k = active; k-- > 0;) {
        fit->r[k] = fit->d[k];
        for (size_t j = k + 1; j < active; j++) fit->r[k] -= fit->R[j * m + k] * fit->r[j];
        fit->r[k] /= fit->R[k * m + k];
    }
    return dot(fit->step, fit->step, m);
}

static void activate(struct fit *fit, size_t index, double square, double multiplier)
{
    size_t m = fit->m, k = fit->active++;
    double size = sqrt(square), *own = vector_of(fit, fit->rank + k);
    for (size_t c = 0; c < m; c++) own[c] = fit->step[c] / size;
    memcpy(fit->R + k * m, fit->d, k * sizeof *fit->R);
    fit->R[k * m + k] = size;
    fit->limit[k] = index;
    fit->u[k] = multiplier;
    fit->is_active[index] = true;
}

static void rotate(double *a, double *b, double c, double s)
{
    double first = c * *a + s * *b;
    *b = c * *b - s * *a;
    *a = first;
}

/* Drop active limit l; Givens rotations restore the triangle. */
static void deactivate(struct fit *fit, size_t l)
{
    size_t m = fit->m, last = --fit->active;
    fit->is_active[fit->limit[l]] = false;
    for (size_t k = l; k < last; k++) {
        memcpy(fit->R + k * m, fit->R + (k + 1) * m, (k + 2) * sizeof *fit->R);
        fit->limit[k] = fit->limit[k + 1];
        fit->u[k] = fit->u[k + 1];
    }
    for (size_t k = l; k < last; k++) {
        double *R = fit->R + k * m, size = hypot(R[k], R[k + 1]), c = R[k] / size, s = R[k + 1] / size;
        double *first = vector_of(fit, fit->rank + k), *second = vector_of(fit, fit->rank + k + 1);
        for (size_t j = k; j < last; j++) rotate(&fit->R[j * m + k], &fit->R[j * m + k + 1], c, s);
        for (size_t j = 0; j < m; j++) rotate(&first[j], &second[j], c, s);
    }
}

/* Satisfy a violated limit; false where the others exclude it. */
static bool satisfy(struct fit *fit, size_t index, const struct bound *bound)
{
    double multiplier = 0, normal = 1 + bound->other * bound->other;
    for (;;) {
        double square = set_directions(fit, bound), full = HUGE_VAL, part = HUGE_VAL;
        size_t blocking = fit->active;
        if (fit->rank + fit->active < fit->m && square > pivoting_zero * normal)
            full = -excess_of(fit, bound) / square;
        for (size_t k = 0; k < fit->active; k++) {
            if (!(fit->r[k] > 0) || !(fit->u[k] / fit->r[k] < part)) continue;
            part = fit->u[k] / fit->r[k];
            blocking = k;
        }
        double t = fmin(full, part);
        if (t == HUGE_VAL) return false;
        if (full < HUGE_VAL) add_multiple(fit->x, fit->step, t, fit->m);
        for (size_t k = 0; k < fit->active; k++) fit->u[k] -= t * fit->r[k];
        multiplier += t;
        if (full <= part) {
            activate(fit, index, square, multiplier);
            return true;
        }
        deactivate(fit, blocking);
    }
}

/* Satisfy all limits. Returns one that cannot be satisfied, or 2 m. */
static size_t satisfy_all(struct fit *fit)
{
    struct bound bound = {0};
    size_t most = 20 + 20 * fit->m, index = 2 * fit->m;
    fit->active = 0;
    memset(fit->is_active, 0, 2 * fit->m * sizeof *fit->is_active);
    for (size_t round = 0; round < most; round++) {
        index = most_violated(fit, &bound);
        if (index == 2 * fit->m || !satisfy(fit, index, &bound)) return index;
    }
    return index;
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
            row->x = fit->place[i] < n ? fit->x[fit->place[i]] : fit->base[i] + fit->gain[i] * of;
            if (fit->place[i] == n || !limited) continue;
            row->x = fmin(row->x, row->high + row->high_share * of);
            row->x = fmax(row->x, row->low + row->low_share * of);
        }
}

static bool has_sign(const struct fit *fit, size_t i)
{
    struct pivoting_row *row = &fit->block->rows[i];
    double level = fit->block->level;
    if (fit->place[i] < fit->block->n) return fabs(row->w) <= level;
    if (fit->is_loose[i]) return true;
    return row->mode == at_high ? row->w <= level : row->w >= -level;
}

static bool set_accelerations(struct fit *fit)
{
    struct pivoting_block *block = fit->block;
    size_t n = block->n;
    double square = 0;
    bool fits = true;
    for (size_t i = 0; i < n; i++) square += block->rows[i].x * block->rows[i].x;
    block->level = pivoting_residual * (block->size + sqrt(square));
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
    struct fit *fit = block->memory;
    fit->block = block;
    set_places(fit);
    set_equations(fit);
    solve_equations(fit);
    return fit;
}

bool pivoting_fit(struct pivoting_block *block)
{
    struct fit *fit = fit_equations(block);
    size_t index = satisfy_all(fit);
    block->beyond = index < 2 * fit->m ? fit->row[index / 2] : block->n;
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
