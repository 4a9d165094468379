/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The loads on a straight body in the axes of its axis: those at one place, and those along stretches of it, its weight
 * and inertia among them.
 */
#ifndef FBD_SECTION_LOADS_H
#define FBD_SECTION_LOADS_H

#include "base/diag.h"
#include "dynamics/diagram.h"
#include "section/section.h"

/* A part of the body along its axis. */
struct section_bar {
    double from, to;
    double mass, inertia; /* both per length */
};

/* A distributed load; its line from `start` to `end`, in the axes of the axis. */
struct section_spread {
    const struct spread *line;
    struct vec start, end, resultant;
};

/* The work of section_new. */
struct section_work {
    fbd_section *section;
    const struct fbd_state *state; /* evaluated */
    fbd_errors *errors;
    const struct model_body *body;
    struct instant at;
    struct pose pose;
    size_t arrow_count, bar_count, spread_count, place_count;
    struct arrow *arrows; /* the diagram of the body */
    struct section_bar *bars;
    struct section_spread *spreads;
    double *places; /* where loads act, begin or end */
    /* in the axes of the axis: weight per mass, acceleration of its start, angular acceleration and velocity */
    struct vec gravity, acceleration;
    double alpha, omega;
};

struct outline_part;

/* Is the shape a rod, or a rectangle, whose mass is uniform along its middle line? The diagonals of a rectangle are equal
 * and bisect each other. */
bool section_is_straight(const struct outline_part *shape);

/* Find the axis of the body and its parts; false with a note. */
bool section_find_axis(struct section_work *work);

/* List the loads; false with a note. */
bool section_list_loads(struct section_work *work);

/* The densities of force and couple at x: f_e, f_n, p_n f_e - c; `piece` is a place in the same stretch. */
void section_density(const struct section_work *work, double x, double piece, double density[3]);

#endif
