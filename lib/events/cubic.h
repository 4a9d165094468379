/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The cubic through values and rates at both ends of a stretch, on s in [0, 1]: c0 + c1 s + c2 s^2 + c3 s^3.
 */
#ifndef FBD_EVENTS_CUBIC_H
#define FBD_EVENTS_CUBIC_H

#include <math.h>

#include "numeric/tolerances.h"

struct cubic {
    double c0, c1, c2, c3;
};

/* Over a stretch of the length h; from the value a at the rate da to b at the rate db. */
static inline struct cubic cubic_between(double h, double a, double da, double b, double db)
{
    double d = b - a, ra = h * da, rb = h * db;
    return (struct cubic){a, ra, 3 * d - 2 * ra - rb, ra + rb - 2 * d};
}

static inline double cubic_at(const struct cubic *c, double s)
{
    return c->c0 + s * (c->c1 + s * (c->c2 + s * c->c3));
}

/* A zero of a cubic that changes sign from + to - over [0, 1]: Newton kept inside a shrinking bracket. */
static inline double cubic_zero(const struct cubic *c)
{
    enum { most_steps = 8 }; /* if more are needed the cubic is round-off */
    double low = 0, high = 1, s = c->c0 / (c->c0 - cubic_at(c, 1));
    for (int i = 0; i < most_steps && high - low > round_off(1, 1); i++) {
        if (!(s > low && s < high)) s = (low + high) / 2;
        double value = cubic_at(c, s), slope = c->c1 + s * (2 * c->c2 + s * 3 * c->c3);
        if (value >= 0)
            low = s;
        else
            high = s;
        double next = slope != 0 ? s - value / slope : -1;
        if (fabs(next - s) <= round_off(1, 1)) return s;
        s = next;
    }
    return s;
}

#endif
