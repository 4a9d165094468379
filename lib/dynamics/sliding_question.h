/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Interface between sliding_settle.c, the search for switches with a common surface (sliding_surfaces.c), and
 * switches beside dry friction on the same coordinate (sliding_held.c).
 */
#ifndef FBD_DYNAMICS_SLIDING_QUESTION_H
#define FBD_DYNAMICS_SLIDING_QUESTION_H

#include "dynamics/modes.h"
#include "dynamics/sliding.h"

enum { most_asked = 32, most_units = 5 }; /* the limits of sliding switches (model/slides.c) */

/* A switch for which sliding is to be decided. */
struct asked {
    int kink, part, branch;
    int unit, side; /* the surface, and -1 where its u is opposite to that of the surface's first */
    bool left;      /* its weight has just reached an end */
    bool ended;     /* it is at rest, whatever the remaining speed */
};

struct question {
    struct fbd_state *state;
    bool without_places; /* switches of positions are omitted: there are too many */
    struct asked list[most_asked];
    int count, units;
    int plain[most_asked], plain_count; /* branches resolved by their values: question_leave_repelling */
    bool back[most_units];              /* of a surface: unlimited weight below 1/2, lower branch first */
    bool left[most_asked];              /* of a surface: its weight has just reached an end */
    double most;                        /* of the accelerations tried: the scale of rates */
    double *coupled;                    /* result of state_find_ways, when computed; to be freed */
    double *ways;                       /* the one in use, or NULL */
};

/* The rate of the surface of a switch, along (dt, dy). */
double asked_rate(const struct question *q, const struct asked *asked, double dt, const double *dy);

/* One entry of the gradient of a surface: with time, a coordinate, a rate. */
double asked_slope(const struct question *q, const struct asked *asked, size_t i);

/* The remaining u' of a switch of positions: its value, or zero within rounding. */
double asked_passing_speed(const struct question *q, const struct asked *asked);

/* sliding_parted of a switch. */
int asked_parted(const struct fbd_state *state, const struct asked *asked);

/* Is there friction at rest on all coordinates whose speeds the switch depends on? */
bool asked_is_held(const struct question *q, const struct asked *asked);

/* Set friction on the coordinates of a switch to stick, or to slip where its surface moves off the switch,
 * which then holds them. */
void question_hold_friction(const struct question *q, const struct asked *asked);

/* Set velocities that couplings make proportional to one at rest on friction to zero: they are rounding. */
void question_take_rest(const struct question *q, const struct asked *asked);

/* The decided modes without friction that shares its coordinate with a switch. */
struct decided question_without_shared(const struct question *q, const struct decided *decided);

/* Save the modes and the state, or with `back` restore them. */
void question_keep_modes(const struct fbd_state *state, bool back);

/* A switch whose branches both lead away from it has no sliding mode: where friction holds its coordinates
 * the expression has its value there, as if(v >= 0, ...) with v = 0. Resolve such switches by their values.
 * True when there are any: then the modes are to be settled again. */
bool question_leave_repelling(struct question *q, const struct decided *decided);

/* Collect the switches at zero. False when there are too many. */
bool question_gather(struct question *q, const struct decided *decided);
/* The same without switches of positions. */
bool question_gather_without_places(struct question *q, const struct decided *decided);

/* Find coordinates that couplings make proportional, to sliding->with. False when memory is out. */
bool question_find_coordinates(struct question *q);

/* Add the switches that come to rest with a listed one. False when there are too many. */
bool question_join(struct question *q);

/* Group the switches by surface. `coupled`: switches of speeds that couplings make proportional, as of two
 * bodies on a taut rope, have one surface. */
void question_find_surfaces(struct question *q, bool coupled);
/* Find the smallest number of surfaces. False when memory is out. */
bool question_find_fewest_surfaces(struct question *q);

/* The weight of a surface is that of its first switch. Is a switch that a coupling joined to it still of that
 * surface? No longer if a rope has become slack. */
bool asked_is_joined(struct question *q, const struct asked *asked);

#endif
