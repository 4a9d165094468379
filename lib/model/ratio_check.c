/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Check that ratios are independent of each other and leave motions. Their rows are constant,
 *
 *     sum c_i v_i = 0,
 *
 * so that elimination (Gauss and Jordan) decides it: a row that becomes zero follows from those before it, and its
 * force would not be determined; a row with one coordinate left forbids the motion of that. Ratios that begin or end
 * are not compared, as they may act at different times; neither are those of very large scenes, whose redundant rows
 * share their forces as those of all couplings.
 */
#include <stdlib.h>

#include "model/builder.h"
#include "numeric/tolerances.h"

struct elimination {
    struct builder *builder;
    int n, count; /* coordinates, and reduced rows */
    double *rows; /* each of n: 1 at its pivot */
    int *pivots;
};

static double *row_at(const struct elimination *all, int i)
{
    return &all->rows[(size_t)i * (size_t)all->n];
}

static bool is_constant(const struct coupling *coupling)
{
    return coupling->kind == constraint_ratio && coupling->source->lifetime.number == 0;
}

static void fill(const struct tree *tree, const struct coupling *coupling, double *row)
{
    for (int k = 0; k < coupling->end_count; k++) {
        const struct ratio_term *term = &coupling->source->terms[k];
        if (!term->opposite)
            row[tree->links[coupling->end[k].link].coordinate + term->coordinate] = term->factor;
    }
}

static int largest(const double *row, int n)
{
    int most = 0;
    for (int i = 1; i < n; i++)
        if (fabs(row[i]) > fabs(row[most])) most = i;
    return most;
}

static void subtract(double *row, double factor, const double *other, int n)
{
    for (int i = 0; factor != 0 && i < n; i++) {
        const double part = factor * other[i];
        row[i] = fabs(row[i] - part) <= negligible_sum * fabs(part) ? 0 : row[i] - part;
    }
}

/* The only coordinate of a row, or -1. */
static int only_one(const double *row, int n)
{
    int found = -1;
    for (int i = 0; i < n; i++) {
        if (row[i] == 0) continue;
        if (found >= 0) return -1;
        found = i;
    }
    return found;
}

static void note_redundant(const struct elimination *all, const struct coupling *coupling)
{
    diag_add(all->builder->errors, FBD_ERROR, "conflicting-keys", coupling->source->at,
             "leave it out: its force would not be determined", "the ratio `%s` follows from those before it",
             coupling->name);
}

static void note_locked(const struct elimination *all, const struct coupling *coupling, int coordinate)
{
    const struct fbd_model *model = all->builder->model;
    const struct coordinate *locked = &model->scene->coordinates[coordinate];
    diag_add(all->builder->errors, FBD_ERROR, "conflicting-keys", coupling->source->at,
             "leave one of them out, or correct a factor",
             "the ratio `%s` and those before it allow no motion of `%s.%s`", coupling->name,
             model->bodies[locked->body].name, locked->name);
}

/* A coordinate without motion, or -1. */
static int locked(const struct elimination *all)
{
    for (int i = 0; i < all->count; i++) {
        const int one = only_one(row_at(all, i), all->n);
        if (one >= 0) return one;
    }
    return -1;
}

/* False after a note. */
static bool add(struct elimination *all, const struct coupling *coupling)
{
    double *row = row_at(all, all->count);
    fill(all->builder->model->tree, coupling, row);
    for (int i = 0; i < all->count; i++) subtract(row, row[all->pivots[i]], row_at(all, i), all->n);
    const int pivot = largest(row, all->n);
    if (row[pivot] == 0) {
        note_redundant(all, coupling);
        return false;
    }
    const double size = row[pivot];
    for (int i = 0; i < all->n; i++) row[i] /= size;
    for (int i = 0; i < all->count; i++) {
        double *other = row_at(all, i);
        subtract(other, other[pivot], row, all->n);
    }
    all->pivots[all->count++] = pivot;
    const int rest = locked(all);
    if (rest >= 0) note_locked(all, coupling, rest);
    return rest < 0;
}

enum { most_entries = 100000 };

bool ratios_check(struct builder *builder)
{
    const struct tree *tree = builder->model->tree;
    struct elimination all = {.builder = builder, .n = builder->model->plan.n};
    size_t count = 0;
    for (int i = 0; i < tree->coupling_count; i++) count += is_constant(&tree->couplings[i]);
    if (count < 2 || count * (size_t)all.n > most_entries) return true;
    all.rows = calloc(count, (size_t)all.n * sizeof *all.rows);
    all.pivots = calloc(count, sizeof *all.pivots);
    bool fine = all.rows && all.pivots;
    for (int i = 0; fine && i < tree->coupling_count; i++)
        if (is_constant(&tree->couplings[i]) && !add(&all, &tree->couplings[i])) break;
    free(all.rows);
    free(all.pivots);
    return fine;
}
