/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/linear_system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "numeric/lu.h"
#include "numeric/tolerances.h"

/* ---- one input, one output */

bool linear_system_siso(const struct fbd_linear_system *system, size_t input, size_t output,
                        struct arena *arena, struct siso *siso)
{
    const size_t n = system->linear->size, m = system->input_count;
    *siso = (struct siso){.size = n, .d = system->D[output * m + input]};
    siso->A = ARENA_ARRAY(arena, n * n + 2 * n + 1, double);
    if (!siso->A) return false;
    siso->b = siso->A + n * n;
    siso->c = siso->b + n;
    memcpy(siso->A, system->linear->A, n * n * sizeof *siso->A);
    memcpy(siso->c, system->C + output * n, n * sizeof *siso->c);
    for (size_t i = 0; i < n; i++) siso->b[i] = system->B[i * m + input];
    return siso_reduce(siso, arena);
}

/* Is a square matrix singular to rounding? It is overwritten. */
static bool is_singular(size_t n, double *matrix, size_t *pivot)
{
    double most = 0, least = INFINITY;
    if (!lu_decompose(n, matrix, pivot)) return true;
    for (size_t i = 0; i < n; i++) {
        most = fmax(most, fabs(matrix[i * n + i]));
        least = fmin(least, fabs(matrix[i * n + i]));
    }
    return least <= evaluation_rounding * most;
}

/* H has a pole at 0 where A is singular, and a zero there where [A, b; c, d] is. */
static bool siso_static_gain(const struct siso *siso, struct arena *arena, double *gain)
{
    const size_t n = siso->size, m = n + 1;
    double *M = ARENA_ARRAY(arena, m * m, double);
    size_t *pivot = ARENA_ARRAY(arena, m, size_t);
    fbd_complex response;
    if (!M || !pivot) return false;
    memcpy(M, siso->A, n * n * sizeof *M);
    if (n == 0 || !is_singular(n, M, pivot)) {
        bool fine = siso_response(siso, arena, 0, &response);
        *gain = response.re;
        return fine;
    }
    for (size_t i = 0; i < n; i++) {
        memcpy(M + i * m, siso->A + i * n, n * sizeof *M);
        M[i * m + n] = siso->b[i];
        M[n * m + i] = siso->c[i];
    }
    M[n * m + n] = siso->d;
    *gain = is_singular(m, M, pivot) ? NAN : INFINITY;
    return true;
}

/* ---- public */

struct kept_transfer {
    fbd_transfer public;
    struct arena arena;
};

static int find(struct kept_transfer *kept, const fbd_linear_system *system, size_t input, size_t output)
{
    struct siso siso;
    struct transfer found;
    if (!linear_system_siso(system, input, output, &kept->arena, &siso)) return -1;
    int done = transfer_find(&siso, &kept->arena, &found);
    if (done <= 0) return done;
    kept->public = (fbd_transfer){.pole_count = found.pole_count,
                                  .zero_count = found.zero_count,
                                  .poles = found.poles,
                                  .zeros = found.zeros,
                                  .gain = found.gain};
    bool known = found.gain == 0 || siso_static_gain(&siso, &kept->arena, &kept->public.static_gain);
    return known ? 1 : -1;
}

static fbd_transfer *make(const fbd_linear_system *system, size_t input, size_t output, fbd_errors *errors)
{
    struct kept_transfer *kept = calloc(1, sizeof *kept);
    int done = kept ? find(kept, system, input, output) : -1;
    if (done > 0) return &kept->public;
    if (done < 0)
        diag_out_of_memory(errors);
    else
        diag_add(errors, FBD_ERROR, "not-finite", (struct pos){0, 0}, NULL,
                 "the poles or zeros of `%s` by `%s` are not found, or not finite",
                 system->outputs[output].name, system->inputs[input].name);
    if (kept) arena_free(&kept->arena);
    free(kept);
    return NULL;
}

static bool is_pair(const fbd_linear_system *system, size_t input, size_t output)
{
    return system && input < system->input_count && output < system->output_count;
}

fbd_transfer *fbd_transfer_new(const fbd_linear_system *system, size_t input, size_t output, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_transfer *transfer = is_pair(system, input, output)
                                 ? make(system, input, output, errors)
                                 : api_refuse(errors, "there is no such input or output");
    diag_end(&call);
    return transfer;
}

void fbd_transfer_free(fbd_transfer *transfer)
{
    struct kept_transfer *kept = (struct kept_transfer *)transfer; /* its first member */
    if (!kept) return;
    arena_free(&kept->arena);
    free(kept);
}

bool fbd_linear_system_response(const fbd_linear_system *system, size_t input, size_t output,
                                const double *omega, size_t count, fbd_complex *response)
{
    struct arena arena = {0};
    struct siso siso;
    if (!is_pair(system, input, output) || (count > 0 && (!omega || !response))) return false;
    bool fine = linear_system_siso(system, input, output, &arena, &siso);
    for (size_t i = 0; fine && i < count; i++) {
        struct arena scratch = {0};
        fine = isfinite(omega[i]) && siso_response(&siso, &scratch, omega[i], &response[i]);
        arena_free(&scratch);
    }
    arena_free(&arena);
    return fine;
}

/* ---- frequencies of a plot */

struct band {
    double low, high;
    double *own; /* frequencies of poles and zeros */
    size_t count;
};

static void widen(struct band *range, const fbd_complex *roots, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double frequency = hypot(roots[i].re, roots[i].im);
        if (!(frequency > 0) || roots[i].im < 0) continue;
        range->low = fmin(range->low, frequency);
        range->high = fmax(range->high, frequency);
        range->own[range->count++] = frequency;
    }
}

static bool take_range(const struct fbd_linear_system *system, struct arena *arena, struct band *range)
{
    const size_t pairs = system->input_count * system->output_count;
    *range = (struct band){.low = INFINITY, .high = 0};
    range->own = ARENA_ARRAY(arena, 2 * pairs * system->linear->size + 1, double);
    if (!range->own) return false;
    for (size_t k = 0; k < pairs; k++) {
        struct siso siso;
        struct transfer transfer;
        if (!linear_system_siso(system, k % system->input_count, k / system->input_count, arena, &siso) ||
            transfer_find(&siso, arena, &transfer) < 0)
            return false;
        widen(range, transfer.poles, transfer.pole_count);
        widen(range, transfer.zeros, transfer.zero_count);
    }
    if (range->count == 0) range->low = range->high = 1;
    return true;
}

static int ascending(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

double *linear_system_frequencies(const struct fbd_linear_system *system, struct arena *arena, size_t *count)
{
    const int per_decade = 50, most_decades = 12;
    struct band range;
    if (!take_range(system, arena, &range)) return NULL;
    int last = (int)ceil(log10(range.high)) + 1,
        first = (int)fmax(floor(log10(range.low)) - 1, last - most_decades);
    size_t steps = (size_t)((last - first) * per_decade) + 1;
    double *list = ARENA_ARRAY(arena, steps + range.count, double);
    if (!list) return NULL;
    for (size_t i = 0; i < steps; i++) list[i] = pow(10, first + (double)i / per_decade);
    *count = steps;
    for (size_t i = 0; i < range.count; i++)
        if (range.own[i] > list[0]) list[(*count)++] = range.own[i];
    qsort(list, *count, sizeof *list, ascending);
    size_t kept = 1;
    for (size_t i = 1; i < *count; i++)
        if (list[i] > list[kept - 1] * (1 + undecided_part)) list[kept++] = list[i];
    *count = kept;
    return list;
}
