/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "numeric/active_set.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/tolerances.h"
#include "numeric/vector.h"

bool active_set_new(struct active_set *set, size_t n, size_t limits)
{
    *set = (struct active_set){.n = n};
    set->rows = calloc(2 * n * n + 5 * n + 1, sizeof *set->rows);
    set->order = calloc(2 * n + 1, sizeof *set->order);
    set->is_active = calloc(limits + 1, sizeof *set->is_active);
    if (!set->rows || !set->order || !set->is_active) return false;
    set->R = set->rows + n * n;
    set->x = set->R + n * n;
    set->step = set->x + n;
    set->u = set->step + n;
    set->d = set->u + n;
    set->r = set->d + n;
    set->limit = set->order + n;
    for (size_t k = 0; k < n; k++) set->order[k] = k;
    return true;
}

void active_set_free(struct active_set *set)
{
    free(set->rows);
    free(set->order);
    free(set->is_active);
}

/* The limit that is violated most, or spaces->count. */
static size_t most_violated(const struct active_set *set, const struct half_spaces *spaces, double size)
{
    size_t worst = spaces->count;
    double least = -pivoting_zero * (size + sqrt(vector_dot(set->x, set->x, set->n)));
    for (size_t which = 0; which < spaces->count; which++) {
        double normal;
        if (set->is_active[which]) continue;
        double excess = spaces->excess(spaces->context, which, set->x, &normal);
        if (!(excess < least * normal)) continue;
        least = excess / normal;
        worst = which;
    }
    return worst;
}

/* r = R^-1 d. */
static void substitute(struct active_set *set)
{
    for (size_t k = set->active; k-- > 0;) {
        set->r[k] = set->d[k];
        for (size_t j = k + 1; j < set->active; j++) set->r[k] -= set->R[j * set->n + k] * set->r[j];
        set->r[k] /= set->R[k * set->n + k];
    }
}

/* The step of x, the part of the normal that is orthogonal to all equations and active limits; d, its components along the
 * latter; and r, the decrease of their multipliers. Returns the squared size of the step. */
static double set_directions(struct active_set *set, const struct half_spaces *spaces, size_t which)
{
    size_t n = set->n, active = set->active;
    memset(set->step, 0, n * sizeof *set->step);
    memset(set->d, 0, active * sizeof *set->d);
    spaces->add_normal(spaces->context, which, set->step);
    for (int round = 0; round < 2; round++)
        for (size_t k = 0; k < set->rank + active; k++) {
            double share = vector_dot(active_set_row(set, k), set->step, n);
            if (share == 0) continue;
            vector_add_multiple(set->step, active_set_row(set, k), -share, n);
            if (k >= set->rank) set->d[k - set->rank] += share;
        }
    substitute(set);
    return vector_dot(set->step, set->step, n);
}

static void activate(struct active_set *set, size_t index, double square, double multiplier)
{
    size_t n = set->n, k = set->active++;
    double size = sqrt(square), *own = active_set_row(set, set->rank + k);
    for (size_t c = 0; c < n; c++) own[c] = set->step[c] / size;
    memcpy(set->R + k * n, set->d, k * sizeof *set->R);
    set->R[k * n + k] = size;
    set->limit[k] = index;
    set->u[k] = multiplier;
    set->is_active[index] = true;
}

static void rotate(double *a, double *b, double c, double s)
{
    double first = c * *a + s * *b;
    *b = c * *b - s * *a;
    *a = first;
}

/* Givens rotations restore the triangle. */
void active_set_drop(struct active_set *set, size_t l)
{
    size_t n = set->n, last = --set->active;
    set->is_active[set->limit[l]] = false;
    for (size_t k = l; k < last; k++) {
        memcpy(set->R + k * n, set->R + (k + 1) * n, (k + 2) * sizeof *set->R);
        set->limit[k] = set->limit[k + 1];
        set->u[k] = set->u[k + 1];
    }
    for (size_t k = l; k < last; k++) {
        double *R = set->R + k * n, size = hypot(R[k], R[k + 1]), c = R[k] / size, s = R[k + 1] / size;
        double *first = active_set_row(set, set->rank + k), *second = active_set_row(set, set->rank + k + 1);
        for (size_t j = k; j < last; j++) rotate(&set->R[j * n + k], &set->R[j * n + k + 1], c, s);
        for (size_t j = 0; j < n; j++) rotate(&first[j], &second[j], c, s);
    }
}

/* The active limit whose multiplier vanishes first, and the change of the new one until then. */
static size_t first_to_drop(const struct active_set *set, double *part)
{
    size_t first = set->active;
    double most = 0;
    *part = HUGE_VAL;
    for (size_t k = 0; k < set->active; k++) most = fmax(most, fabs(set->r[k]));
    for (size_t k = 0; k < set->active; k++) {
        if (!(set->r[k] > pivoting_zero * most) || !(set->u[k] / set->r[k] < *part)) continue;
        *part = set->u[k] / set->r[k];
        first = k;
    }
    return first;
}

bool active_set_add(struct active_set *set, const struct half_spaces *spaces, size_t which)
{
    double multiplier = 0, normal;
    for (;;) {
        double square = set_directions(set, spaces, which), full = HUGE_VAL, part;
        double excess = spaces->excess(spaces->context, which, set->x, &normal);
        size_t first = first_to_drop(set, &part);
        if (set->rank + set->active < set->n && square > pivoting_zero * normal * normal)
            full = -excess / square;
        double t = fmin(full, part);
        if (t == HUGE_VAL) return false;
        if (full < HUGE_VAL) vector_add_multiple(set->x, set->step, t, set->n);
        for (size_t k = 0; k < set->active; k++) set->u[k] -= t * set->r[k];
        multiplier += t;
        if (full <= part) {
            activate(set, which, square, multiplier);
            return true;
        }
        active_set_drop(set, first);
    }
}

void active_set_begin(struct active_set *set, const struct half_spaces *spaces)
{
    set->active = 0;
    memset(set->is_active, 0, spaces->count * sizeof *set->is_active);
}

void active_set_rates(struct active_set *set)
{
    size_t n = set->n;
    memset(set->step, 0, n * sizeof *set->step);
    for (size_t k = 0; k < set->active; k++) {
        const double *R = set->R + k * n;
        set->d[k] = (1 - vector_dot(R, set->d, k)) / R[k];
        vector_add_multiple(set->step, active_set_row(set, set->rank + k), set->d[k], n);
    }
    substitute(set);
}

size_t active_set_satisfy(struct active_set *set, const struct half_spaces *spaces, double size)
{
    size_t most = 20 + 20 * set->n, which = spaces->count;
    active_set_begin(set, spaces);
    for (size_t round = 0; round < most; round++) {
        which = most_violated(set, spaces, size);
        if (which == spaces->count || !active_set_add(set, spaces, which)) return which;
    }
    return which;
}
