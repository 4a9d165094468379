/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Assembled equations: inertia * acceleration = sum of named terms, for each coordinate.
 */
#ifndef FBD_OUTPUT_EQUATIONS_H
#define FBD_OUTPUT_EQUATIONS_H

#include "base/text.h"
#include "dynamics/state.h"

struct equation {
    fbd_equation public;
    int body, part; /* the coordinate is number `part` of the body */
};

struct fbd_equations {
    struct arena arena;
    size_t count;
    struct equation *equations;
};

/* Settle the modes if the state was changed, and evaluate. */
void state_ready(struct fbd_state *state);

/* Write the equations, and what they belong to, as text. */
void equations_write(struct text *text, struct fbd_state *state);

#endif
