/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The least |x| that satisfies equations and half-spaces a . x >= least, by the dual active-set method of Goldfarb and Idnani
 * (Mathematical Programming 27, 1983, section 4, with the unit matrix as Hessian).
 *
 * It starts from the least solution of the equations. Limits that are violated become active one after the other, each with
 * the least increase of |x|, and those whose multipliers would become negative are dropped. The equations and the normals of
 * active limits are orthonormal rows, with the triangle of the normals in them, updated by Givens rotations.
 */
#ifndef FBD_NUMERIC_ACTIVE_SET_H
#define FBD_NUMERIC_ACTIVE_SET_H

#include <stdbool.h>
#include <stddef.h>

/* Half-spaces 0 to count - 1. */
struct half_spaces {
    size_t count;
    const void *context;
    /* a . x - least, and |a|; HUGE_VAL where there is no such limit. */
    double (*excess)(const void *context, size_t which, const double *x, double *size);
    /* Add a to a vector of zeros. */
    void (*add_normal)(const void *context, size_t which, double *vector);
};

struct active_set {
    size_t n, rank, active; /* unknowns, equations, active limits */
    double *rows; /* n of n components, in the order `order`: first `rank` equations, then active normals */
    size_t *order;
    double *x; /* n: the least solution of the equations; then the result */
    /* Within: */
    double *step;
    size_t *limit;   /* of each active one */
    bool *is_active; /* of each half-space */
    double *R;       /* column by column, n each: the active normals in the orthonormal rows */
    double *u, *d, *r;
};

/* Memory for n unknowns and `limits` half-spaces. False when there is none; active_set_free in any case. */
bool active_set_new(struct active_set *set, size_t n, size_t limits);
void active_set_free(struct active_set *set);

static inline double *active_set_row(const struct active_set *set, size_t k)
{
    return set->rows + set->order[k] * set->n;
}

/* Move x until all limits are satisfied, to round-off relative to |x| + size. Returns a limit that the others exclude, or
 * spaces->count. n may be less than memory was allocated for. */
size_t active_set_satisfy(struct active_set *set, const struct half_spaces *spaces, double size);

/* One step at a time. Begin without active limits; make a violated one active, false where the others exclude it: then
 * its normal plus those of the active ones times -r is zero, with r <= 0; drop active limit l. */
void active_set_begin(struct active_set *set, const struct half_spaces *spaces);
bool active_set_add(struct active_set *set, const struct half_spaces *spaces, size_t which);
void active_set_drop(struct active_set *set, size_t l);

/* As `least` of all active limits rises by one unit: x changes by `step`, and their multipliers by r. */
void active_set_rates(struct active_set *set);

#endif
