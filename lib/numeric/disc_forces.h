/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces of dry friction at rest: the minimum of
 *
 *     1/2 f . W f + b . f,   |f_i| <= c_i,
 *
 * with two components f_i at each point, W their accelerations by unit forces, symmetric and positive semidefinite, and b those
 * without the forces. Then a = W f + b is zero at points inside of their disc, and opposite to f_i at the others. The
 * accelerations are unique; the forces are if W is regular.
 */
#ifndef FBD_NUMERIC_DISC_FORCES_H
#define FBD_NUMERIC_DISC_FORCES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/vec.h"

struct disc_problem {
    size_t count;        /* points */
    const double *W, *b; /* 2 count x 2 count, row by row; 2 count */
    const double *c;     /* count: not negative */
    struct vec *f;       /* count: set */
    bool *slips;         /* count: set: |f_i| = c_i, with an acceleration */
    double *room;        /* disc_forces_room(count) */
    size_t *pivot;       /* 2 count: room, too */
};

static inline size_t disc_forces_room(size_t count)
{
    return 4 * count * count + 6 * count;
}

void disc_forces_find(const struct disc_problem *of);

/* The acceleration of point i by all forces but its own. */
struct vec disc_forces_by_others(const struct disc_problem *of, size_t i);

#endif
