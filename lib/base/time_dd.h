/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Time in double-double arithmetic: t + rest, the unevaluated sum of two doubles.
 *
 * At t = 1e5 s adjacent doubles are 1.5e-11 s apart. The root of an event function is found relative to the
 * start of the step, and so is the length of a pulse of a nanosecond: both are much more accurate than that.
 * If the time of an event were rounded to a double, a body of velocity v would be off by v 1.5e-11 s after
 * each event, and by a thousand times that after 1e6 events. Two runs with different steps would not show it,
 * since they round alike.
 *
 * The start and the end of a step are therefore kept as t + rest. The step size is a double, the rounded
 * difference of the two. Forces, expressions and output use t, the nearest double. Only events have a rest:
 * all other steps end at doubles.
 */
#ifndef FBD_BASE_TIME_DD_H
#define FBD_BASE_TIME_DD_H

#include <stdbool.h>

#include "base/double_double.h"

struct time_dd {
    double t, rest;
};

static inline struct time_dd time_dd_at(double t)
{
    return (struct time_dd){t, 0};
}

/* a - b, rounded once or twice. Most times are doubles: with equal rests the rounded difference is exact to
 * half a unit of its last place, and adding its error would not change it. */
static inline double time_dd_since(struct time_dd a, struct time_dd b)
{
    if (a.rest == b.rest) return a.t - b.t;
    struct double_double d = dd_sum(a.t, -b.t);
    return d.x + (d.rest + (a.rest - b.rest));
}

/* a + s. */
static inline struct time_dd time_dd_after(struct time_dd a, double s)
{
    struct double_double sum = dd_add((struct double_double){a.t, a.rest}, (struct double_double){s, 0});
    return (struct time_dd){sum.x, sum.rest};
}

static inline bool time_dd_equal(struct time_dd a, struct time_dd b)
{
    return a.t == b.t && a.rest == b.rest;
}

static inline struct time_dd time_dd_earlier(struct time_dd a, struct time_dd b)
{
    return time_dd_since(a, b) <= 0 ? a : b;
}

#endif
