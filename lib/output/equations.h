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
    int body, part;   /* the coordinate is number `part` of the body; for a body cut free the direction */
    bool cut_free;    /* Newton's or Euler's equation, including reactions */
    const int *loads; /* of each term, -1 for none */
};

struct fbd_equations {
    struct arena arena;
    size_t count;
    struct equation *equations;
};

/* `components`: with Newton's and Euler's equations of every body. */
fbd_equations *assemble(fbd_state *state, bool components);

/* Settle the modes if the state was changed, and evaluate. */
void state_ready(struct fbd_state *state);

/* The contribution of an arrow to equation `part` of a body whose centre of mass is at G. A planar body's
 * moments are taken about its centre of mass, which decouples its equations. */
double equation_term(const struct model_body *body, const struct arrow *arrow, int part, struct vec G);

/* The acceleration on the other side of that equation, given those of the coordinates, a[n]; its name; and
 * whether it is that of the coordinate. */
double equation_acceleration(const struct model_body *body, const struct instant *at, const double *a,
                             int part);
const char *equation_acceleration_name(const struct fbd_model *model, const struct model_body *body,
                                       int part);
bool equation_has_coordinate(const struct model_body *body);

/* Reference point of moments in diagrams: the axis of a pivot, else the centre of mass. */
struct vec moment_center(const struct model_body *body, const struct instant *at);

/* An arrow with its moment about a point, for fbd.h. */
fbd_arrow public_arrow(const struct arrow *arrow, struct vec about);

#endif
