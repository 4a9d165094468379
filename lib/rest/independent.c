/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/independent.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/project.h"
#include "dynamics/tree.h"
#include "numeric/tolerances.h"

static const double least_pivot = distinct_part; /* of the sizes of coordinates; below is rounding */

bool coordinate_is_driven(const struct fbd_model *model, size_t i)
{
    return model->bodies[model->scene->coordinates[i].body].source->motion.prescribed.expr != NULL;
}

void independent_share(struct fbd_state *state, double *share)
{
    size_t n = (size_t)state->model->plan.n;
    double *v = state->y + n;
    for (size_t j = 0; j < n; j++) {
        memset(v, 0, n * sizeof *v);
        v[j] = coordinate_is_driven(state->model, j) ? 0 : 1;
        state_project_velocity(state, false);
        for (size_t i = 0; i < n; i++) share[i * n + j] = v[i];
    }
    memset(v, 0, n * sizeof *v);
    state_evaluate(state);
}

bool independent_new(struct independent *independent, const struct fbd_state *state)
{
    size_t n = (size_t)state->model->plan.n;
    *independent = (struct independent){.n = n,
                                        .which = calloc(n + 1, sizeof(int)),
                                        .way = calloc(n * n + 1, sizeof(double)),
                                        .share = calloc(n * n + n + 1, sizeof(double))};
    if (!independent->which || !independent->way || !independent->share) return false;
    independent->size = independent->share + n * n;
    return true;
}

void independent_free(struct independent *independent)
{
    free(independent->which);
    free(independent->way);
    free(independent->share);
}

/* The size of an angle is 1, that of a length the size of the mechanism. */
static void set_sizes(struct independent *independent, const struct fbd_state *state)
{
    double reach = 0;
    for (int i = 1; i < state->model->tree->joined; i++)
        reach = fmax(reach, vec_norm(state->tree->links[i].p));
    for (size_t i = 0; i < independent->n; i++)
        independent->size[i] = state->model->scene->coordinates[i].angle || !(reach > 0) ? 1 : reach;
}

/* The largest pivot of row i among the columns from `first` on. */
static double row_pivot(const struct independent *independent, size_t i, size_t first, size_t *column)
{
    size_t n = independent->n;
    double most = 0;
    for (size_t j = first; j < n; j++) {
        double pivot = fabs(independent->share[i * n + j]) * independent->size[j] / independent->size[i];
        if (!(pivot > most)) continue;
        most = pivot;
        *column = j;
    }
    return most;
}

static bool is_taken(const struct independent *independent, size_t count, size_t i)
{
    for (size_t k = 0; k < count; k++)
        if ((size_t)independent->which[k] == i) return true;
    return false;
}

/* The next row: the first in the file whose pivot is at least a tenth of the largest. */
static size_t choose_row(const struct independent *independent, size_t count)
{
    const double much = 0.1;
    size_t n = independent->n, column = 0, row = n;
    double most = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < n; i++) {
            if (is_taken(independent, count, i)) continue;
            double pivot = row_pivot(independent, i, count, &column);
            if (pass == 1 && pivot >= much * most && most > 0) return i;
            most = fmax(most, pivot);
        }
    }
    return row;
}

/* Eliminate: column k gets 1 in row i, all other columns 0. False without a pivot. */
static bool eliminate(struct independent *independent, size_t k, size_t i)
{
    size_t n = independent->n, column = k;
    double *S = independent->share;
    if (!(row_pivot(independent, i, k, &column) > least_pivot)) return false;
    for (size_t r = 0; r < n; r++) {
        double swap = S[r * n + k];
        S[r * n + k] = S[r * n + column];
        S[r * n + column] = swap;
    }
    double pivot = S[i * n + k];
    for (size_t r = 0; r < n; r++) S[r * n + k] /= pivot;
    for (size_t j = 0; j < n; j++) {
        double factor = S[i * n + j];
        if (j == k || factor == 0) continue;
        for (size_t r = 0; r < n; r++) S[r * n + j] -= factor * S[r * n + k];
        S[i * n + j] = 0;
    }
    S[i * n + k] = 1;
    return true;
}

/* Is the remainder at round-off level after all eliminations? */
static bool is_exhausted(const struct independent *independent)
{
    size_t column;
    for (size_t i = 0; i < independent->n; i++)
        if (row_pivot(independent, i, independent->count, &column) > least_pivot) return false;
    return true;
}

static void take_ways(struct independent *independent)
{
    for (size_t i = 0; i < independent->n; i++)
        for (size_t k = 0; k < independent->count; k++)
            independent->way[i * independent->count + k] = independent->share[i * independent->n + k];
}

bool independent_follow(struct independent *independent, struct fbd_state *state)
{
    independent_share(state, independent->share);
    set_sizes(independent, state);
    for (size_t k = 0; k < independent->count; k++)
        if (!eliminate(independent, k, (size_t)independent->which[k])) return false;
    take_ways(independent);
    return is_exhausted(independent);
}

static int ascending(const void *left, const void *right)
{
    return *(const int *)left - *(const int *)right;
}

bool independent_choose(struct independent *independent, struct fbd_state *state)
{
    size_t n = independent->n;
    double trace = 0;
    independent_share(state, independent->share);
    set_sizes(independent, state);
    for (size_t i = 0; i < n; i++) trace += independent->share[i * n + i];
    if (!(fabs(trace - round(trace)) <= distinct_part)) return false;
    independent->count = (size_t)lround(trace);
    for (size_t k = 0; k < independent->count; k++) {
        size_t row = choose_row(independent, k);
        if (row == n || !eliminate(independent, k, row)) return false;
        independent->which[k] = (int)row;
    }
    qsort(independent->which, independent->count, sizeof *independent->which, ascending);
    return independent_follow(independent, state);
}
