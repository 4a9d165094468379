/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "numeric/least_distance.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/svd.h"
#include "numeric/tolerances.h"

/* Non-negative least squares (Lawson and Hanson, chapter 23, algorithm NNLS): m equations, n unknowns. */
struct nnls {
    size_t m, n;
    const double *E; /* n columns of m */
    double *u, *z;   /* n */
    double *rest;    /* m: f - E u */
    double *f, *A;   /* m; m rows of the free columns */
    bool *positive;  /* n: u may be positive */
    bool no_memory;
};

static void nnls_free(struct nnls *problem)
{
    free(problem->u);
    free(problem->positive);
}

static bool nnls_new(struct nnls *problem, size_t m, size_t n, const double *E)
{
    *problem = (struct nnls){.m = m, .n = n, .E = E};
    problem->u = calloc(2 * n + 2 * m + m * n, sizeof *problem->u);
    problem->positive = calloc(n + 1, sizeof *problem->positive);
    if (!problem->u || !problem->positive) return false;
    problem->z = problem->u + n;
    problem->rest = problem->z + n;
    problem->f = problem->rest + m;
    problem->A = problem->f + m;
    problem->f[m - 1] = 1;
    return true;
}

/* Solve for z: least squares over the unknowns that may be positive, the others zero. */
static bool nnls_solve_free(struct nnls *problem)
{
    struct svd svd;
    size_t free = 0;
    for (size_t j = 0; j < problem->n; j++) free += problem->positive[j];
    for (size_t j = 0, k = 0; j < problem->n; j++) {
        if (!problem->positive[j]) continue;
        for (size_t i = 0; i < problem->m; i++) problem->A[i * free + k] = problem->E[j * problem->m + i];
        k++;
    }
    memset(problem->z, 0, problem->n * sizeof *problem->z);
    bool made = svd_decompose(&svd, problem->m, free, problem->A);
    if (made) svd_add_solution(&svd, problem->f, problem->z);
    svd_free(&svd);
    problem->no_memory = !made;
    for (size_t j = problem->n, k = free; made && j-- > 0;) { /* to their original indices, the last first */
        double own = problem->positive[j] ? problem->z[--k] : 0;
        problem->z[j] = own;
    }
    return made;
}

static void nnls_set_rest(struct nnls *problem)
{
    for (size_t i = 0; i < problem->m; i++) {
        problem->rest[i] = i + 1 == problem->m;
        for (size_t j = 0; j < problem->n; j++)
            problem->rest[i] -= problem->E[j * problem->m + i] * problem->u[j];
    }
}

/* The unknown at zero whose increase reduces the residual most, or n. The residual has rounding errors in
 * proportion to u. */
static size_t nnls_enter(const struct nnls *problem)
{
    size_t best = problem->n;
    double most = negligible_part;
    for (size_t j = 0; j < problem->n; j++) most += slope_rounding * problem->u[j];
    for (size_t j = 0; j < problem->n; j++) {
        double slope = 0;
        for (size_t i = 0; i < problem->m; i++) slope += problem->E[j * problem->m + i] * problem->rest[i];
        if (problem->positive[j] || !(slope > most)) continue;
        most = slope;
        best = j;
    }
    return best;
}

/* Move from u towards z until an unknown becomes zero, and fix it there; true when z was reached. */
static bool nnls_move(struct nnls *problem)
{
    double share = 1;
    size_t blocking = problem->n;
    for (size_t j = 0; j < problem->n; j++) {
        if (!problem->positive[j] || problem->z[j] > 0) continue;
        double own = problem->u[j] / (problem->u[j] - problem->z[j]);
        if (blocking < problem->n && own >= share) continue;
        share = own;
        blocking = j;
    }
    for (size_t j = 0; j < problem->n; j++) problem->u[j] += share * (problem->z[j] - problem->u[j]);
    if (blocking == problem->n) return true;
    problem->u[blocking] = 0;
    problem->positive[blocking] = false;
    return false;
}

static bool nnls_run(struct nnls *problem)
{
    size_t most = 10 * (problem->n + 10);
    nnls_set_rest(problem);
    for (size_t round = 0; round < most; round++) {
        size_t entering = nnls_enter(problem);
        if (entering == problem->n) return true;
        problem->positive[entering] = true;
        do {
            if (!nnls_solve_free(problem)) return false;
        } while (!nnls_move(problem));
        nnls_set_rest(problem);
    }
    return false;
}

enum least_distance least_distance(size_t rows, size_t size, const double *G, const double *h, double *x)
{
    size_t m = size + 1;
    struct nnls problem = {0};
    double *E = calloc(m * rows, sizeof *E);
    enum least_distance found = least_distance_no_memory;
    for (size_t i = 0; E && i < rows; i++) {
        memcpy(&E[i * m], &G[i * size], size * sizeof *E);
        E[i * m + size] = h[i];
    }
    if (E && nnls_new(&problem, m, rows, E)) {
        bool ended = nnls_run(&problem);
        /* r = -rest; r_last = -rest_last, and rest_last = |rest|^2 = 1 / (1 + |x|^2) at the minimum. */
        double last = problem.rest[size];
        found = ended && last > least_distance_end ? least_distance_found : least_distance_empty;
        if (problem.no_memory) found = least_distance_no_memory;
        for (size_t k = 0; k < size && found == least_distance_found; k++) x[k] = -problem.rest[k] / last;
    }
    nnls_free(&problem);
    free(E);
    return found;
}
