/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/linear_doublings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/double_double.h"
#include "numeric/tolerances.h"

static const double lowest = 0.125; /* h rho of the first length */

void doublings_restart(struct doublings *d, size_t dim, double rho)
{
    d->dim = dim;
    d->rho = rho;
    d->made = 0;
}

void doublings_free(struct doublings *d)
{
    free(d->matrices);
    free(d->last);
    *d = (struct doublings){0};
}

double doublings_length(const struct doublings *d, int index)
{
    return ldexp(lowest / d->rho, index);
}

int doublings_within(const struct doublings *d, double h)
{
    int index;
    frexp(h * d->rho / lowest, &index);
    return index > most_doublings ? most_doublings - 1 : index > 1 ? index - 1 : 0;
}

static double *matrix_at(const struct doublings *d, int index)
{
    return d->matrices + (size_t)index * d->dim * d->dim;
}

const double *doublings_phi(const struct doublings *d, int index)
{
    return matrix_at(d, 2 * index);
}

const double *doublings_exponential(const struct doublings *d, int index)
{
    return matrix_at(d, 2 * index + 1);
}

/* ---- matrices in double-double arithmetic */

static void multiply(size_t dim, const struct double_double *a, const struct double_double *b,
                     struct double_double *result)
{
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = 0; j < dim; j++) {
            struct double_double sum = {0, 0};
            for (size_t k = 0; k < dim; k++) sum = dd_add(sum, dd_multiply(a[i * dim + k], b[k * dim + j]));
            result[i * dim + j] = sum;
        }
    }
}

static void add_one(size_t dim, struct double_double *matrix)
{
    const struct double_double one = {1, 0};
    for (size_t i = 0; i < dim; i++) matrix[i * dim + i] = dd_add(matrix[i * dim + i], one);
}

/* sum += term, element by element; is every term negligible compared with its sum? */
static bool add_small(size_t size, const struct double_double *term, struct double_double *sum)
{
    bool small = true;
    for (size_t i = 0; i < size; i++) {
        small &= fabs(term[i].x) <= negligible_dd * fabs(sum[i].x);
        sum[i] = dd_add(sum[i], term[i]);
    }
    return small;
}

/* next = h A term / k */
static void next_term(const struct doublings *d, const struct double_double *A, double k,
                      const struct double_double *term, struct double_double *next)
{
    const struct double_double factor =
        dd_divide((struct double_double){doublings_length(d, 0), 0}, (struct double_double){k, 0});
    multiply(d->dim, A, term, next);
    for (size_t i = 0; i < d->dim * d->dim; i++) next[i] = dd_multiply(next[i], factor);
}

/* Phi by its series h (1 + hA/2! + ...), and e^(hA) = 1 + A Phi. */
static void set_first(struct doublings *d, const double *A)
{
    const size_t dim = d->dim, size = dim * dim;
    struct double_double *phi = d->last, *exponential = phi + size, *term = exponential + size,
                         *next = term + size, *matrix = next + size;
    for (size_t i = 0; i < size; i++) {
        matrix[i] = (struct double_double){A[i], 0};
        phi[i] = term[i] = (struct double_double){i % (dim + 1) == 0 ? doublings_length(d, 0) : 0, 0};
    }
    for (size_t k = 1; k <= linear_terms; k++) {
        next_term(d, matrix, (double)(k + 1), term, next);
        memcpy(term, next, size * sizeof *term);
        if (add_small(size, term, phi) && k >= dim) break;
    }
    multiply(dim, matrix, phi, exponential);
    add_one(dim, exponential);
}

/* Phi(2h) = Phi(h) + e^(hA) Phi(h),  e^(2hA) = e^(hA)^2 */
static void set_twice(struct doublings *d)
{
    const size_t size = d->dim * d->dim;
    struct double_double *phi = d->last, *exponential = phi + size, *work = exponential + size;
    multiply(d->dim, exponential, phi, work);
    for (size_t i = 0; i < size; i++) phi[i] = dd_add(phi[i], work[i]);
    multiply(d->dim, exponential, exponential, work);
    memcpy(exponential, work, size * sizeof *work);
}

/* ---- lengths */

static bool make_room(struct doublings *d, int count)
{
    enum { at_once = 16, of_last = 5 };
    const size_t size = d->dim * d->dim;
    if (!d->last) d->last = calloc(of_last * size, sizeof *d->last);
    if (!d->last) return false;
    if (count <= d->room) return true;
    const int room = (count / at_once + 1) * at_once;
    double *matrices = realloc(d->matrices, 2 * (size_t)room * size * sizeof *matrices);
    if (!matrices) return false;
    d->matrices = matrices;
    d->room = room;
    return true;
}

static void round_last(struct doublings *d)
{
    double *rounded = matrix_at(d, 2 * d->made);
    for (size_t i = 0; i < 2 * d->dim * d->dim; i++) rounded[i] = dd_value(d->last[i]);
}

bool doublings_reach(struct doublings *d, const double *A, double h)
{
    const int count = doublings_within(d, h) + 1;
    if (!make_room(d, count)) return false;
    for (; d->made < count; d->made++) {
        if (d->made == 0)
            set_first(d, A);
        else
            set_twice(d);
        round_last(d);
    }
    return true;
}
