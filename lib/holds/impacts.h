/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Impacts at several points at one instant: points that close, points that touch already and feel the others,
 * and ropes that get taut.
 *
 *   simultaneous  all points are compressed together, up to where none closes any more: the holds of
 *                 holds/holds.h, in impulses (Pfeiffer and Glocker, Multibody Dynamics with Unilateral
 *                 Contacts, chapter 8). Then each gets e times its normal impulse once more, with the
 *                 friction that this brings, and what closes by that is held up again. With `stronge` all of it
 *                 is scaled by one factor, so that the work of the normal impulses is the sum of what the points
 *                 give back, e^2 of theirs; with `poisson` only where energy would be made. With `newton` and
 *                 `moreau` one set of holds has v_n + e v_n (before) in place of v_n (Moreau).
 *
 *   propagate     the point that closes fastest has its impact alone, by holds/impact.h, until none closes.
 *
 * One point alone is an impact by holds/impact.h in both.
 */
#ifndef FBD_HOLDS_IMPACTS_H
#define FBD_HOLDS_IMPACTS_H

#include <stdbool.h>

#include "holds/impact.h"

struct impacts_point {
    double mu, e;
};

/* Unknowns 2 i and 2 i + 1 belong to point i: along its normal and its tangent. */
struct impacts {
    int count;
    bool propagate;
    enum impact_law law;
    const struct impacts_point *points;
    const double *W; /* 2 count x 2 count, symmetric */
    double *v;       /* 2 count: velocities before, then after; v_n of a point that lasts is 0 exactly */
    double *P;       /* 2 count: impulses, set */
    double work;     /* set: the change of kinetic energy */
    bool in_turn;    /* set: some are one after the other, as no impulses of all together were found */
};

enum impacts_end {
    impacts_done,
    impacts_endless,    /* propagation does not come to an end */
    impacts_unsolvable, /* no impulses satisfy the laws */
    impacts_lost,       /* impulses so large that rounding takes what they do */
    impacts_no_memory
};

enum impacts_end impacts_solve(struct impacts *impacts);

#endif
