/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Impacts at several points at one instant: closing points, touching points, and ropes that become taut.
 *
 *     simultaneous  all points are compressed together until none closes any more: the complementarity
 *                   problem of holds/holds.h, in impulses (Pfeiffer and Glocker, Multibody Dynamics with
 *                   Unilateral Contacts, chapter 8). Then each gets e times its normal impulse once more,
 *                   with the resulting friction, and constraints that would close by it get an impulse. With
 *                   `stronge` all of it is scaled by one factor, so that the work of the normal impulses is the
 *                   sum of e^2 times the work of compression at the points; with `poisson` only where energy
 *                   would be gained. With `newton` and `moreau` one problem has v_n + e v_n (before) in place
 *                   of v_n (Moreau).
 *
 *     propagate     the point that closes fastest has its impact alone, by holds/impact.h, until none closes.
 *
 * Points without dynamic coupling have independent impacts. Of coupled points, the law is that of the one
 * with restitution that closes fastest.
 *
 * A single point is an impact by holds/impact.h in both. Friction of slides whose guides the impulses load is
 * decided together with all points.
 */
#ifndef FBD_HOLDS_IMPACTS_H
#define FBD_HOLDS_IMPACTS_H

#include <stdbool.h>

#include "holds/impact.h"

struct impacts_point {
    double mu, e;
    enum impact_law law;
    int slips; /* 1 or -1: slips in this direction, unchanged by any impulse; W has zeros there */
};

/* Friction of a slide whose guide the impulses load. */
struct impacts_slide {
    double mu;
    bool two_sided;
};

/* Unknowns 2 i and 2 i + 1 belong to point i: along its normal and its tangent; those of slides follow. */
struct impacts {
    int count, slides;
    bool propagate;
    const struct impacts_point *points;
    const struct impacts_slide *slide;
    const double *W; /* size x size, symmetric */
    const double *B; /* slides x size: response of the normal impulse of a guide */
    double *v;       /* size: velocities before, then after; v_n of a point that stays closed is exactly 0 */
    double *P;       /* size: impulses, set */
    double work;     /* set: the change of kinetic energy */
    enum impact_law law; /* set: of points that are solved together */
    bool several;        /* set: other impulses satisfy the laws, too, with other velocities */
    bool in_turn;        /* set: some were solved sequentially; no simultaneous solution was found */
};

static inline int impacts_size(const struct impacts *impacts)
{
    return 2 * impacts->count + impacts->slides;
}

enum impacts_end {
    impacts_done,
    impacts_endless,    /* propagation does not end */
    impacts_unsolvable, /* no impulses satisfy the laws */
    impacts_jammed,     /* friction locks a closing point against an immovable body */
    impacts_lost,       /* impulses so large that rounding hides their effect */
    impacts_no_memory
};

enum impacts_end impacts_solve(struct impacts *impacts);

#endif
