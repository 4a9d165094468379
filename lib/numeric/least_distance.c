/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "numeric/least_distance.h"

#include <math.h>
#include <string.h>

#include "numeric/active_set.h"
#include "numeric/tolerances.h"
#include "numeric/vector.h"

struct inequalities {
    size_t size;
    const double *G, *h;
};

static double excess(const void *context, size_t which, const double *x, double *size)
{
    const struct inequalities *all = context;
    const double *row = all->G + which * all->size;
    *size = sqrt(vector_dot(row, row, all->size));
    return vector_dot(row, x, all->size) - all->h[which];
}

static void add_normal(const void *context, size_t which, double *vector)
{
    const struct inequalities *all = context;
    vector_add_multiple(vector, all->G + which * all->size, 1, all->size);
}

enum least_distance least_distance(size_t rows, size_t size, const double *G, const double *h, double *x)
{
    struct inequalities all = {size, G, h};
    const struct half_spaces spaces = {rows, &all, excess, add_normal};
    struct active_set set;
    enum least_distance found = least_distance_no_memory;
    if (active_set_new(&set, size, rows)) {
        bool satisfied = active_set_satisfy(&set, &spaces, 1) == rows;
        double square = vector_dot(set.x, set.x, size);
        found = satisfied && square < 1 / least_distance_end ? least_distance_found : least_distance_empty;
        if (found == least_distance_found) memcpy(x, set.x, size * sizeof *x);
    }
    active_set_free(&set);
    return found;
}
