/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What sliding_settle.c asks, which switches have one surface (sliding_surfaces.c), and switches beside dry friction on the
 * same coordinate (sliding_held.c).
 */
#ifndef FBD_DYNAMICS_SLIDING_QUESTION_H
#define FBD_DYNAMICS_SLIDING_QUESTION_H

#include "dynamics/modes.h"
#include "dynamics/sliding.h"

enum { most_asked = 32, most_units = 5 }; /* as many as are slid on (model/slides.c) */

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
    bool left[most_asked]; /* of a surface: its share has just been used up */
    double most;           /* of the accelerations tried: what rates are measured by */
    double *coupled;       /* of state_find_ways, once they are asked for; to be freed */
    double *ways;          /* those to be heeded now, or NULL */
};

/* The rate of the surface of a switch, along (dt, dy). */
double asked_rate(const struct question *q, const struct asked *asked, double dt, const double *dy);

/* One entry of the gradient of a surface: with time, a coordinate, a rate. */
double asked_slope(const struct question *q, const struct asked *asked, size_t i);

/* What may be left of u' where a switch that watches places is at rest: its value, or zero. */
double asked_passing_speed(const struct question *q, const struct asked *asked);

/* sliding_parted of it. */
int asked_parted(const struct fbd_state *state, const struct asked *asked);

/* Is there friction at rest on all coordinates whose speeds the switch watches? */
bool asked_is_held(const struct question *q, const struct asked *asked);

/* Friction on the coordinates of a switch sticks; it slips where its surface moves off the switch, which holds them. */
void question_hold_friction(const struct question *q, const struct asked *asked);

/* Where friction is at rest, what couplings move as one with it is: what is left of its velocity is rounding. */
void question_take_rest(const struct question *q, const struct asked *asked);

/* What is decided, but for friction that shares its coordinate with a switch. */
struct decided question_without_shared(const struct question *q, const struct decided *decided);

/* Keep the modes and the state, or go `back` to them. */
void question_keep_modes(const struct fbd_state *state, bool back);

/* A switch whose branches both lead away from it is no place to slide on: where friction holds its coordinates what stands
 * there is the value of the expression, if(v >= 0, ...) with v = 0. Those are asked no more, and left to the values. True
 * when there are any: then the modes are to be settled again. */
bool question_leave_repelling(struct question *q, const struct decided *decided);

/* Those that are at zero. False when there are too many. */
bool question_gather(struct question *q, const struct decided *decided);
/* As though what watches places were passed. */
bool question_gather_without_places(struct question *q, const struct decided *decided);

/* Which coordinates couplings move as one, in sliding->with. False when memory is out. */
bool question_find_coordinates(struct question *q);

/* Those that come along with one that is listed. False when there are too many. */
bool question_join(struct question *q);

/* `coupled`: of speeds that couplings make one, as of two bodies on a taut rope, the switches are one surface. */
void question_find_surfaces(struct question *q, bool coupled);
/* The fewest that there are. False when memory is out. */
bool question_find_fewest_surfaces(struct question *q);

/* The share of a surface is that of its first switch. Is one that a coupling joined to it still of that surface? Where a
 * rope has gone slack it is not. */
bool asked_is_joined(struct question *q, const struct asked *asked);

#endif
