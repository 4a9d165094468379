/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/transfer.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "numeric/lu.h"
#include "numeric/tolerances.h"
#include "rest/eigenvalues.h"

static const double pi = 3.14159265358979324;

/* ---- states with an effect */

/* Mark the states that the input reaches; with `back` those that act on the output. */
static void mark_reached(const struct siso *system, bool back, bool *marks)
{
    const size_t n = system->size;
    for (size_t i = 0; i < n; i++) marks[i] = (back ? system->c[i] : system->b[i]) != 0;
    for (bool more = true; more;) {
        more = false;
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n && !marks[i]; j++)
                if (marks[j] && (back ? system->A[j * n + i] : system->A[i * n + j]) != 0)
                    marks[i] = more = true;
    }
}

/* Keep the states `kept`. */
static void keep_states(struct siso *system, const size_t *kept, size_t count)
{
    const size_t n = system->size;
    for (size_t i = 0; i < count; i++) {
        system->b[i] = system->b[kept[i]];
        system->c[i] = system->c[kept[i]];
        for (size_t j = 0; j < count; j++) system->A[i * count + j] = system->A[kept[i] * n + kept[j]];
    }
    system->size = count;
}

/* x = D z with powers of two that make rows and columns of A of like size. */
static bool balance(struct siso *system, struct arena *arena)
{
    const size_t n = system->size;
    double *scales = ARENA_ARRAY(arena, n + 1, double);
    if (!scales || n == 0) return scales != NULL;
    gsl_matrix_view A = gsl_matrix_view_array(system->A, n, n);
    gsl_vector_view D = gsl_vector_view_array(scales, n);
    gsl_linalg_balance_matrix(&A.matrix, &D.vector);
    for (size_t i = 0; i < n; i++) {
        system->b[i] /= scales[i];
        system->c[i] *= scales[i];
    }
    return true;
}

bool siso_reduce(struct siso *system, struct arena *arena)
{
    const size_t n = system->size;
    bool *reached = ARENA_ARRAY(arena, n + 1, bool), *acts = ARENA_ARRAY(arena, n + 1, bool);
    size_t *kept = ARENA_ARRAY(arena, n + 1, size_t), count = 0;
    if (!reached || !acts || !kept) return false;
    mark_reached(system, false, reached);
    mark_reached(system, true, acts);
    for (size_t i = 0; i < n; i++)
        if (reached[i] && acts[i]) kept[count++] = i;
    keep_states(system, kept, count);
    return balance(system, arena);
}

/* ---- zeros */

static double norm(const double *x, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum = hypot(sum, x[i]);
    return sum;
}

/* Exchange two states. */
static void exchange(struct siso *system, size_t i, size_t j)
{
    const size_t n = system->size;
    double *A = system->A, kept = system->b[i];
    system->b[i] = system->b[j];
    system->b[j] = kept;
    kept = system->c[i];
    system->c[i] = system->c[j];
    system->c[j] = kept;
    for (size_t k = 0; k < n; k++) {
        kept = A[i * n + k];
        A[i * n + k] = A[j * n + k];
        A[j * n + k] = kept;
    }
    for (size_t k = 0; k < n; k++) {
        kept = A[k * n + i];
        A[k * n + i] = A[k * n + j];
        A[k * n + j] = kept;
    }
}

/* Reflect the states, x -> (1 - 2 w w^T) x with w of length 1. */
static void reflect(struct siso *system, const double *w)
{
    const size_t n = system->size;
    double *A = system->A, sum;
    for (size_t row = 0; row < n; row++) {
        sum = 0;
        for (size_t j = 0; j < n; j++) sum += A[row * n + j] * w[j];
        for (size_t j = 0; j < n; j++) A[row * n + j] -= 2 * sum * w[j];
    }
    for (size_t column = 0; column < n; column++) {
        sum = 0;
        for (size_t i = 0; i < n; i++) sum += A[i * n + column] * w[i];
        for (size_t i = 0; i < n; i++) A[i * n + column] -= 2 * sum * w[i];
    }
    sum = 0;
    for (size_t i = 0; i < n; i++) sum += system->b[i] * w[i];
    for (size_t i = 0; i < n; i++) system->b[i] -= 2 * sum * w[i];
}

/* Turn c into sigma e_n, by an exchange where one entry is not 0: zeros of A and b then stay exact. */
static void turn_output(struct siso *system, double *w)
{
    const size_t n = system->size;
    size_t entries = 0, last = 0;
    for (size_t i = 0; i < n; i++)
        if (system->c[i] != 0) {
            entries++;
            last = i;
        }
    if (entries == 1) {
        if (last != n - 1) exchange(system, last, n - 1);
        return;
    }
    double sigma = -copysign(norm(system->c, n), system->c[n - 1]);
    memcpy(w, system->c, n * sizeof *w);
    w[n - 1] -= sigma;
    double length = norm(w, n);
    for (size_t i = 0; i < n; i++) w[i] /= length;
    reflect(system, w);
    memset(system->c, 0, n * sizeof *w);
    system->c[n - 1] = sigma;
}

/* Remove the last state, which is the output divided by sigma. */
static void remove_output(struct siso *system)
{
    const size_t n = system->size, m = n - 1;
    system->d = system->b[m];
    for (size_t i = 0; i < m; i++) {
        system->c[i] = system->A[m * n + i];
        memmove(system->A + i * m, system->A + i * n, m * sizeof *system->A);
    }
    system->size = m;
}

/* A - b c/d. */
static void close_output(struct siso *system)
{
    const size_t n = system->size;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) system->A[i * n + j] -= system->b[i] * system->c[j] / system->d;
}

/* Reduce the system until d is not 0; returns the gain, 0 where the input has no effect. Round-off of d is relative to b, of
 * which it is an entry, and of a direct effect to that through the states; that of c to the matrix of which it is a row. */
static double reduce_to_zeros(struct siso *system, double *w)
{
    double gain = 1, size_c = norm(system->c, system->size), least = 0;
    double size_A = norm(system->A, system->size * system->size);
    double size = size_A > 0 ? norm(system->b, system->size) * size_c / size_A : 0;
    while (fabs(system->d) <= negligible_part * size) {
        if (system->size == 0 || size_c <= least) return 0;
        turn_output(system, w);
        gain *= system->c[system->size - 1];
        size = norm(system->b, system->size);
        least = negligible_part * norm(system->A, system->size * system->size);
        remove_output(system);
        size_c = norm(system->c, system->size);
    }
    return gain * system->d;
}

/* ---- poles and zeros */

static int take_roots(const struct siso *system, struct arena *arena, fbd_complex **roots)
{
    const size_t n = system->size;
    fbd_mode *modes = ARENA_ARRAY(arena, n + 1, fbd_mode);
    *roots = ARENA_ARRAY(arena, n + 1, fbd_complex);
    if (!modes || !*roots) return -1;
    int found = n > 0 ? eigenvalues_find(n, system->A, modes) : 1;
    for (size_t i = 0; i < n; i++) (*roots)[i] = (fbd_complex){modes[i].re, modes[i].im};
    return found;
}

static bool copy_system(struct siso *copy, const struct siso *system, struct arena *arena)
{
    const size_t n = system->size;
    *copy = (struct siso){.size = n, .d = system->d};
    copy->A = ARENA_ARRAY(arena, n * n + 2 * n + 1, double);
    if (!copy->A) return false;
    copy->b = copy->A + n * n;
    copy->c = copy->b + n;
    memcpy(copy->A, system->A, n * n * sizeof *copy->A);
    memcpy(copy->b, system->b, n * sizeof *copy->b);
    memcpy(copy->c, system->c, n * sizeof *copy->c);
    return true;
}

int transfer_find(const struct siso *system, struct arena *arena, struct transfer *transfer)
{
    struct siso rest;
    double *w = ARENA_ARRAY(arena, system->size + 1, double);
    *transfer = (struct transfer){.pole_count = system->size};
    if (!w || !copy_system(&rest, system, arena)) return -1;
    int found = take_roots(system, arena, &transfer->poles);
    if (found <= 0) return found;
    transfer->gain = reduce_to_zeros(&rest, w);
    if (transfer->gain == 0) {
        transfer->pole_count = 0;
        return 1;
    }
    close_output(&rest);
    transfer->zero_count = rest.size;
    return take_roots(&rest, arena, &transfer->zeros);
}

/* ---- response */

/* (i omega - A)(p + i q) = b in real numbers: [-A, -omega; omega, -A] (p, q) = (b, 0). */
bool siso_response(const struct siso *system, struct arena *arena, double omega, fbd_complex *response)
{
    const size_t n = system->size, m = 2 * n;
    double *M = ARENA_ARRAY(arena, m * m + m + 1, double), *x = M ? M + m * m : NULL;
    size_t *pivot = ARENA_ARRAY(arena, m + 1, size_t);
    if (!M || !pivot) return false;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) M[i * m + j] = M[(n + i) * m + n + j] = -system->A[i * n + j];
        M[i * m + n + i] = -omega;
        M[(n + i) * m + i] = omega;
        x[i] = system->b[i];
    }
    *response = (fbd_complex){INFINITY, INFINITY};
    if (!lu_decompose(m, M, pivot)) return true;
    lu_solve(m, M, pivot, x);
    *response = (fbd_complex){system->d, 0};
    for (size_t i = 0; i < n; i++) {
        response->re += system->c[i] * x[i];
        response->im += system->c[i] * x[n + i];
    }
    return true;
}

/* The phase of s - root; of the right half-plane that of root - s, whose sign is in `negative`. */
static double factor_phase(fbd_complex root, double omega, bool *negative)
{
    bool on_axis = fabs(root.re) <= negligible_sum * fabs(root.im);
    if (on_axis) return omega < root.im ? -pi / 2 : pi / 2;
    if (root.re < 0) return atan2(omega - root.im, -root.re);
    *negative = !*negative;
    return atan2(root.im - omega, root.re);
}

double transfer_phase(const struct transfer *transfer, double omega)
{
    bool negative = transfer->gain < 0;
    double phase = 0;
    for (size_t i = 0; i < transfer->zero_count; i++)
        phase += factor_phase(transfer->zeros[i], omega, &negative);
    for (size_t i = 0; i < transfer->pole_count; i++)
        phase -= factor_phase(transfer->poles[i], omega, &negative);
    return negative ? phase - pi : phase;
}
