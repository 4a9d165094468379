/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What sliding_settle.c asks, and switches beside dry friction on the same coordinate (sliding_held.c).
 */
#ifndef FBD_DYNAMICS_SLIDING_QUESTION_H
#define FBD_DYNAMICS_SLIDING_QUESTION_H

#include "dynamics/modes.h"
#include "dynamics/sliding.h"

enum { most_asked = 16, most_units = 5 };

/* A switch that is asked. */
struct asked {
    int kink, part, branch;
    int unit, side; /* the surface, and -1 where its u goes against that of the surface's first */
    bool left;      /* its share has just been used up */
    bool ended;     /* it is at rest, whatever speed there still is */
};

struct question {
    struct fbd_state *state;
    bool without_places; /* there are too many */
    struct asked list[most_asked];
    int count, units;
    int plain[most_asked], plain_count; /* branches that are left to the values: sliding_leave_repelling */
    bool back
        [most_units]; /* of a surface that slides by more than there is the lower side helps, and comes first */
    double most;      /* of the accelerations tried: what rates are measured by */
};

/* The rate of the surface of a switch, along (dt, dy). */
double asked_rate(const struct question *q, const struct asked *asked, double dt, const double *dy);

/* One entry of the gradient of a surface: with time, a coordinate, a rate. */
double asked_slope(const struct question *q, const struct asked *asked, size_t i);

/* sliding_parted of it. */
int asked_parted(const struct fbd_state *state, const struct asked *asked);

/* Is there friction at rest on all coordinates whose speeds the switch watches? */
bool asked_is_held(const struct question *q, const struct asked *asked);

/* Friction on the coordinates of a switch sticks; it slips where its surface moves off the switch, which holds them. */
void question_hold_friction(const struct question *q, const struct asked *asked);

/* What is decided, but for friction that shares its coordinate with a switch. */
struct decided question_without_shared(const struct question *q, const struct decided *decided);

/* Keep the modes and the state, or go `back` to them. */
void question_keep_modes(const struct fbd_state *state, bool back);

/* A switch whose branches both lead away from it is no place to slide on: where friction holds its coordinates what stands
 * there is the value of the expression, if(v >= 0, ...) with v = 0. Those are asked no more, and left to the values. True
 * when there are any: then the modes are to be settled again. */
bool question_leave_repelling(struct question *q, const struct decided *decided);

#endif
