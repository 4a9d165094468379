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
 * Points that do not feel each other have impacts of their own. Each has its law; together it is the law of the one with
 * restitution that closes fastest.
 *
 * One point alone is an impact by holds/impact.h in both. Where impulses press slides on their guides, the friction of
 * these is decided with all points, together.
 */
#ifndef FBD_HOLDS_IMPACTS_H
#define FBD_HOLDS_IMPACTS_H

#include <stdbool.h>

#include "holds/impact.h"

struct impacts_point {
    double mu, e;
    enum impact_law law;
    int slips; /* 1 or -1: no impulse moves it along its surface, on which it slips this way; W has zeros there */
};

/* Friction of a slide that the impulses press on its guide. */
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
    const double *W;     /* size x size, symmetric */
    const double *B;     /* slides x size: the normal impulse of a guide by each */
    double *v;           /* size: velocities before, then after; v_n of a point that lasts is 0 exactly */
    double *P;           /* size: impulses, set */
    double work;         /* set: the change of kinetic energy */
    enum impact_law law; /* set: of points that are solved together */
    bool several;        /* set: other impulses agree with the laws, too, and give other velocities */
    bool in_turn;        /* set: some are one after the other, as no impulses of all together were found */
};

static inline int impacts_size(const struct impacts *impacts)
{
    return 2 * impacts->count + impacts->slides;
}

enum impacts_end {
    impacts_done,
    impacts_endless,    /* propagation does not come to an end */
    impacts_unsolvable, /* no impulses satisfy the laws */
    impacts_jammed,     /* friction locks a point that closes, and what it strikes gives no way */
    impacts_lost,       /* impulses so large that rounding takes what they do */
    impacts_no_memory
};

enum impacts_end impacts_solve(struct impacts *impacts);

#endif
