/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Detection of numbers of a state that are not finite, with a name for messages: the quantity and its body.
 */
#ifndef FBD_DYNAMICS_NONFINITE_H
#define FBD_DYNAMICS_NONFINITE_H

#include "base/diag.h"
#include "dynamics/state.h"

/* The first number that is not finite. */
struct nonfinite {
    char what[240]; /* "the force `pull` on `block`" */
    double value;
    struct pos at; /* position in the file of its load, body or state */
};

/* Find the first such number of an evaluated state: coordinates and rates, applied loads (before accelerations and reactions, which
 * depend on them), and the energies of the bodies. */
bool nonfinite_find(const struct fbd_state *state, struct nonfinite *found);

/* A motion that no inertia resists (model/tree_massless.c): a sentence but for its time, and its body's place. */
struct unresisted {
    char text[240];
    struct pos at;
};
bool state_is_unresisted(const struct fbd_state *state, struct unresisted *motion);

/* Why a number may not be finite, as the end of a sentence. */
const char *nonfinite_reason(double value);

/* Record a number if it is not finite; returns true in that case. */
bool nonfinite_note(struct nonfinite *found, double value, struct pos at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
