/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Samples: a state and some states near it, in its modes and in those with slipping friction and taut ropes.
 * Properties of a force at all of them are taken as valid at every time: along one line of the world, at one
 * point of a body, or with one arm.
 *
 * A force that acts in none of them may act later: in a contact that is open, from a condition on, or at another
 * place. Its own states are drawn where it acts (samples_apart.c).
 */
#ifndef FBD_OUTPUT_SAMPLES_H
#define FBD_OUTPUT_SAMPLES_H

#include <gsl/gsl_rng.h>

#include "output/hand_forces.h"

enum { most_samples_of_formulas = 7 };

struct samples {
    int count;
    struct fbd_state *states[most_samples_of_formulas]; /* the first is the given state */
    struct hand_forces forces;
    struct arrow *arrows;    /* diagram_most_arrows */
    struct fbd_state *apart; /* scratch: one in which a force acts that acts in none of these */
    gsl_rng *rng;
    struct arena *arena;
    struct acts_kept *
        *kept; /* of each body and arrow, where it acts in none of these; NULL before the first */
};

/* False when memory is out; call samples_end in any case. */
bool samples_begin(struct samples *samples, struct fbd_state *state, struct arena *arena);
void samples_end(struct samples *samples);

/* An arrow at one sample. */
struct act {
    struct vec force, arm; /* from G, or from the axis of a pivot on the ground where `about_axis` */
    struct vec turn;       /* of the body's frame: (cos, sin) of its angle */
    double couple;
    double size; /* of the force, with the sign of derivations (hand_forces.h); NAN if it has none */
};

/* The samples at which the arrow is above round-off level. */
struct acts {
    int count;
    struct act list[most_samples_of_formulas];
};

struct acts_kept {
    bool known, about_axis;
    struct acts acts;
};

/* None of a force that is zero in all modes. */
struct acts acts_of(const struct samples *samples, int body, const char *name, bool about_axis);

/* True if it is zero at all samples: in the direction u; about the point. */
bool acts_never_along(const struct acts *acts, struct vec u);
bool acts_never_about(const struct acts *acts);

/* True if it has a couple at any sample. */
bool acts_as_couple(const struct acts *acts);

/* True if it acts along one line of the world; *d is its direction for positive size. */
bool acts_along_line(const struct acts *acts, struct vec *d);

/* True if the moment is *lever times its size at all samples. For a couple the lever is 1 or -1. */
bool acts_on_lever(const struct acts *acts, double *lever);

/* True if its point is fixed in the body's frame (`turning`), or has a constant offset in the world; *d is
 * that offset. */
bool acts_at_place(const struct acts *acts, bool turning, struct vec *d);

/* ---- parts */

/* The arrow of this name of a body. */
struct acting {
    int body;
    const char *name;
    bool about_axis;
};

/* Its index; `count` without one. */
size_t acting_arrow(const struct acting *acting, const struct arrow *arrows, size_t count);

/* Append arrow i of samples->arrows, which are those of the instant. */
void acts_add(struct acts *acts, const struct samples *samples, const struct instant *at,
              const struct acting *acting, size_t i);

/* Append those of a force that acts in no sample. */
void acts_apart(struct acts *acts, const struct samples *samples, const struct acting *acting);

double sample_between(gsl_rng *rng, double low, double high);

/* Move a state at random, by about `reach` times the reach of samples. */
void sample_move(struct fbd_state *state, gsl_rng *rng, double reach);

/* Project it onto its couplings and evaluate it; false where that is not possible. */
bool sample_evaluate(struct fbd_state *state);

#endif
