/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Samples: a state and some states near it, in its modes and in those in which its friction slips and its ropes are taut. As a force acts at all of
 * them it acts at every time: along one line of the world, at one point of a body, or with one arm.
 */
#ifndef FBD_OUTPUT_SAMPLES_H
#define FBD_OUTPUT_SAMPLES_H

#include "output/hand_forces.h"

enum { most_samples_of_formulas = 7 };

struct samples {
    int count;
    struct fbd_state *states[most_samples_of_formulas]; /* the first is that which was given */
    struct hand_forces forces;
    struct arrow *arrows; /* diagram_most_arrows */
};

/* False when memory is out; to be ended in any case. */
bool samples_begin(struct samples *samples, struct fbd_state *state, struct arena *arena);
void samples_end(struct samples *samples);

/* An arrow at one sample. */
struct act {
    struct vec force, arm; /* from G, or from the axis of a pivot on the ground where `about_axis` */
    struct vec turn;       /* of the body's frame: (cos, sin) of its angle */
    double couple;
    double size; /* of the force, as derivations have it (hand_forces.h); NAN where it has none */
};

/* Those at which it is more than rounding. */
struct acts {
    int count;
    struct act list[most_samples_of_formulas];
};

struct acts acts_of(const struct samples *samples, int body, const char *name, bool about_axis);

/* Is it zero at all of them? In the direction u; about the point. */
bool acts_never_along(const struct acts *acts, struct vec u);
bool acts_never_about(const struct acts *acts);

/* Has it a couple at any? */
bool acts_as_couple(const struct acts *acts);

/* Does it act along one line of the world, *d where its size is above zero? */
bool acts_along_line(const struct acts *acts, struct vec *d);

/* Has it one moment arm, *lever times its size? Of a couple the lever is 1 or -1. */
bool acts_on_lever(const struct acts *acts, double *lever);

/* Is its point at one place of the body's frame, with `turning`, or at one beside the point in the world? *d from there. */
bool acts_at_place(const struct acts *acts, bool turning, struct vec *d);

#endif
