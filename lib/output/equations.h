/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Assembled equations: inertia * acceleration = sum of named terms, for each coordinate.
 */
#ifndef FBD_OUTPUT_EQUATIONS_H
#define FBD_OUTPUT_EQUATIONS_H

#include "base/text.h"
#include "dynamics/diagram.h"
#include "dynamics/state.h"

struct equation {
    fbd_equation public;
    int body, part;   /* the coordinate is number `part` of the body */
    bool jointed;     /* of a jointed body: see equations_tree.c */
    const char *side; /* then what its right side is, in words */
    const int *loads; /* then the load of each term, -1 for none */
};

struct fbd_equations {
    struct arena arena;
    size_t count;
    struct equation *equations;
};

/* The equations of a jointed body (equations_tree.c): that of its joint, then Newton's and Euler's. */
void equations_of_jointed(struct fbd_equations *all, const struct fbd_state *state, int b,
                          const struct arrow *arrows, size_t arrow_count);

/* Settle the modes if the state was changed, and evaluate. */
void state_ready(struct fbd_state *state);

/* The share of an arrow in equation `part` of a body whose centre of mass is at G. A planar body's moments
 * are taken about its centre of mass, which decouples its equations. */
double equation_term(const struct model_body *body, const struct arrow *arrow, int part, struct vec G);

/* The acceleration on the other side of that equation, at an evaluated state. */
double equation_acceleration(const struct model_body *body, const struct fbd_state *state, int part);

/* An arrow with its moment about a point, for fbd.h. */
fbd_arrow public_arrow(const struct arrow *arrow, struct vec about);

/* Write the equations, and what they belong to, as text. */
void equations_write(struct text *text, struct fbd_state *state);

#endif
