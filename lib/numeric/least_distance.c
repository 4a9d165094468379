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
    double level;
};

static double excess(const void *context, size_t which, const double *x, double *size)
{
    const struct inequalities *all = context;
    const double *row = all->G + which * all->size;
    *size = sqrt(vector_dot(row, row, all->size));
    return vector_dot(row, x, all->size) - (all->h[which] + all->level);
}

static void add_normal(const void *context, size_t which, double *vector)
{
    const struct inequalities *all = context;
    vector_add_multiple(vector, all->G + which * all->size, 1, all->size);
}

enum least_distance least_distance(size_t rows, size_t size, const double *G, const double *h, double *x)
{
    struct inequalities all = {size, G, h, 0};
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

/* ---- the greatest level */

/* The first change of the active limits as the level rises: limit `which` is reached, or its multiplier becomes zero as the k-th active one. */
struct happening {
    double rise;
    size_t which, k;
};

/* Of simultaneous ones the limit with the least index: so it cannot cycle (Murty, Opsearch 11, 1974). */
static void take_first(struct happening *first, double value, double rate, size_t which, size_t k)
{
    if (!(rate < -pivoting_zero)) return;
    double rise = fmax(0, value) / -rate, near = pivoting_zero * (1 + fabs(first->rise));
    if (rise > first->rise + near || (rise >= first->rise - near && which > first->which)) return;
    *first = (struct happening){rise, which, k};
}

static struct happening first_happening(const struct active_set *set, const struct half_spaces *spaces,
                                        double most)
{
    const struct inequalities *all = spaces->context;
    struct happening first = {most - all->level, spaces->count, set->active};
    double size;
    for (size_t which = 0; which < spaces->count; which++) {
        if (set->is_active[which]) continue;
        double rate = vector_dot(all->G + which * all->size, set->step, all->size) - 1;
        take_first(&first, excess(all, which, set->x, &size), rate, which, set->active);
    }
    for (size_t k = 0; k < set->active; k++) take_first(&first, set->u[k], set->r[k], set->limit[k], k);
    return first;
}

/* The multipliers at the greatest level, where limit `last` cannot be satisfied. */
static void set_multipliers(const struct active_set *set, size_t last, double *u)
{
    double sum = 1;
    for (size_t k = 0; k < set->active; k++) sum += fmax(0, -set->r[k]);
    u[last] = 1 / sum;
    for (size_t k = 0; k < set->active; k++) u[set->limit[k]] = fmax(0, -set->r[k]) / sum;
}

static void rise(struct active_set *set, const struct half_spaces *spaces, struct inequalities *all,
                 double most, double *u)
{
    size_t rounds = 50 + 10 * (spaces->count + set->n);
    active_set_begin(set, spaces);
    for (size_t round = 0; round < rounds; round++) {
        active_set_rates(set);
        struct happening first = first_happening(set, spaces, most);
        all->level = first.which < spaces->count ? all->level + first.rise : most;
        vector_add_multiple(set->x, set->step, first.rise, set->n);
        for (size_t k = 0; k < set->active; k++) set->u[k] += first.rise * set->r[k];
        if (first.which == spaces->count) return;
        if (first.k < set->active) {
            active_set_drop(set, first.k);
        } else if (!active_set_add(set, spaces, first.which)) {
            set_multipliers(set, first.which, u);
            return;
        }
    }
}

bool least_distance_rise(size_t rows, size_t size, const double *G, const double *h, double most,
                         double *level, double *u, double *x)
{
    struct inequalities all = {size, G, h, most};
    const struct half_spaces spaces = {rows, &all, excess, add_normal};
    struct active_set set;
    for (size_t i = 0; i < rows; i++) all.level = fmin(all.level, -h[i]);
    memset(u, 0, rows * sizeof *u);
    bool made = active_set_new(&set, size, rows);
    if (made) rise(&set, &spaces, &all, most, u);
    *level = all.level;
    if (made && x) memcpy(x, set.x, size * sizeof *x);
    active_set_free(&set);
    return made;
}
