/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "numeric/qr.h"

#include <math.h>
#include <stdlib.h>

#include "numeric/vector.h"

static double *column_of(const struct qr *qr, size_t k)
{
    return qr->R + k * qr->rows;
}

static double square_from(const struct qr *qr, size_t k, size_t row)
{
    const double *a = column_of(qr, k);
    double sum = 0;
    for (size_t i = row; i < qr->rows; i++) sum += a[i] * a[i];
    return sum;
}

static void swap_columns(struct qr *qr, size_t k, size_t l)
{
    double *a = column_of(qr, k), *b = column_of(qr, l);
    size_t kept = qr->column[k];
    qr->column[k] = qr->column[l];
    qr->column[l] = kept;
    for (size_t i = 0; i < qr->rows; i++) {
        double x = a[i];
        a[i] = b[i];
        b[i] = x;
    }
}

static void swap(double *b, size_t i, size_t j)
{
    double kept = b[i];
    b[i] = b[j];
    b[j] = kept;
}

/* Move the largest entry of column k to the diagonal, so that a reflection leaves equations without an entry
 * in its column unchanged. */
static void swap_rows(struct qr *qr, size_t k)
{
    const double *a = column_of(qr, k);
    size_t most = k;
    for (size_t i = k + 1; i < qr->rows; i++)
        if (fabs(a[i]) > fabs(a[most])) most = i;
    qr->row[k] = most;
    for (size_t l = 0; most != k && l < qr->cols; l++) swap(column_of(qr, l), k, most);
}

/* b -= share v (v . b) for the reflection of step k, v = 1 on the diagonal. */
static void reflect(const struct qr *qr, size_t k, double *b)
{
    const double *v = column_of(qr, k);
    double sum = b[k];
    for (size_t i = k + 1; i < qr->rows; i++) sum += v[i] * b[i];
    if (sum == 0) return; /* no common equation */
    sum *= qr->share[k];
    b[k] -= sum;
    for (size_t i = k + 1; i < qr->rows; i++) b[i] -= sum * v[i];
}

/* Make the reflection that eliminates column k below the diagonal; `square` is the squared norm of the column
 * from the diagonal on. */
static void make_reflection(struct qr *qr, size_t k, double square)
{
    double *a = column_of(qr, k), size = a[k] > 0 ? -sqrt(square) : sqrt(square), first = a[k] - size;
    for (size_t i = k + 1; i < qr->rows; i++) a[i] /= first;
    qr->share[k] = -first / size;
    a[k] = size;
}

/* b[0..rank) becomes R^-1 b. */
static void substitute(const struct qr *qr, double *b)
{
    for (size_t k = qr->rank; k-- > 0;) {
        const double *a = column_of(qr, k);
        b[k] /= a[k];
        for (size_t i = 0; b[k] != 0 && i < k; i++) b[i] -= a[i] * b[k];
    }
}

static void set_null_vectors(struct qr *qr)
{
    for (size_t l = qr->rank; l < qr->cols; l++) {
        double *b = column_of(qr, l), *null = qr->null + (l - qr->rank) * qr->cols;
        substitute(qr, b);
        for (size_t i = 0; i < qr->rank; i++) null[qr->column[i]] = -b[i];
        null[qr->column[l]] = 1;
    }
}

bool qr_decompose(struct qr *qr, size_t rows, size_t cols, const double *a, double zero)
{
    *qr = (struct qr){.rows = rows, .cols = cols};
    qr->R = calloc(cols * (rows + cols + 2) + 1, sizeof *qr->R);
    qr->column = calloc(2 * cols + 1, sizeof *qr->column);
    if (!qr->R || !qr->column) return false;
    qr->row = qr->column + cols;
    qr->null = qr->R + cols * rows;
    qr->share = qr->null + cols * cols;
    double *square = qr->share + cols, first = 0;
    for (size_t k = 0; k < cols; k++) {
        qr->column[k] = k;
        for (size_t i = 0; i < rows; i++) column_of(qr, k)[i] = a[i * cols + k];
        square[k] = square_from(qr, k, 0);
    }
    for (size_t k = 0; k < rows && k < cols; k++) {
        size_t most = k;
        for (size_t l = k + 1; l < cols; l++)
            if (square[l] > square[most]) most = l;
        if (k == 0) first = square[most];
        if (!(square[most] > zero * zero * first)) break;
        if (most != k) swap_columns(qr, k, most);
        double own = square[most];
        square[most] = square[k];
        swap_rows(qr, k);
        make_reflection(qr, k, own);
        for (size_t l = k + 1; l < cols; l++) {
            reflect(qr, k, column_of(qr, l));
            square[l] = square_from(qr, l, k + 1);
        }
        qr->rank++;
    }
    set_null_vectors(qr);
    return true;
}

void qr_free(struct qr *qr)
{
    free(qr->R);
    free(qr->column);
    qr->R = NULL;
    qr->column = NULL;
}

void qr_add_solution(const struct qr *qr, double *b, double *x)
{
    for (size_t k = 0; k < qr->rank; k++)
        swap(b, k, qr->row[k]); /* as in all columns, reflections included */
    for (size_t k = 0; k < qr->rank; k++) reflect(qr, k, b);
    substitute(qr, b);
    for (size_t k = 0; k < qr->rank; k++) x[qr->column[k]] += b[k];
}

/* Modified Gram-Schmidt, with reorthogonalisation. */
void qr_set_orthonormal_null(const struct qr *qr, double *rows)
{
    const size_t n = qr->cols, count = n - qr->rank;
    for (size_t k = 0; k < count; k++) {
        double *own = rows + k * n;
        for (size_t j = 0; j < n; j++) own[j] = qr_null(qr, j, k);
        for (size_t l = 0; l < 2 * k; l++) {
            const double *other = rows + l % k * n;
            vector_add_multiple(own, other, -vector_dot(own, other, n), n);
        }
        double size = sqrt(vector_dot(own, own, n));
        for (size_t j = 0; j < n; j++) own[j] /= size;
    }
}

void qr_divide_by_triangle(const struct qr *qr, const double *z, double *w)
{
    size_t first = 0; /* components before it are zero */
    for (size_t k = 0; k < qr->cols; k++) {
        const double *a = column_of(qr, k);
        w[k] = 0;
        if (k >= qr->rank) continue;
        w[k] = (z[qr->column[k]] - vector_dot(w + first, a + first, k - first)) / a[k];
        if (first == k && w[k] == 0) first++;
    }
}
