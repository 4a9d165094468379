/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Moment: a time that keeps its digits, as the sum of two doubles.
 *
 * At t = 1e5 s doubles are 1.5e-11 s apart. An event there is known to the rounding of what happens since the
 * step began, which is shorter by many orders of size, and so is the length of a pulse that is on for a
 * nanosecond. A body that moves at v is off by v 1.5e-11 s after an event that is rounded to a double, after
 * every one anew; after 1e6 of them by a thousand times that, and two runs of different steps agree on it, as
 * they round alike.
 *
 * So where steps begin and end is kept as t + rest; what they are long is a double, the rounded difference.
 * Forces, expressions and output see t, the nearest double. Only events have a rest: steps between them end
 * at doubles.
 */
#ifndef FBD_BASE_MOMENT_H
#define FBD_BASE_MOMENT_H

#include <stdbool.h>

#include "base/twofold.h"

struct moment {
    double t, rest;
};

static inline struct moment moment_at(double t)
{
    return (struct moment){t, 0};
}

/* a - b, rounded once or twice. */
static inline double moment_since(struct moment a, struct moment b)
{
    struct twofold d = twofold_sum(a.t, -b.t);
    return d.x + (d.rest + (a.rest - b.rest));
}

/* a + s. */
static inline struct moment moment_after(struct moment a, double s)
{
    struct twofold sum = twofold_add((struct twofold){a.t, a.rest}, (struct twofold){s, 0});
    return (struct moment){sum.x, sum.rest};
}

static inline bool moment_equal(struct moment a, struct moment b)
{
    return a.t == b.t && a.rest == b.rest;
}

static inline struct moment moment_earlier(struct moment a, struct moment b)
{
    return moment_since(a, b) <= 0 ? a : b;
}

#endif
