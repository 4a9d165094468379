/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The loads on a straight body in the axes of its axis: those at one place, and those along stretches of it, its weight
 * and inertia among them.
 */
#ifndef FBD_STUDY_SECTION_LOADS_H
#define FBD_STUDY_SECTION_LOADS_H

#include "base/diag.h"
#include "study/section.h"

/* A part of the body along its axis. */
struct section_bar {
    double from, to;
    double mass, inertia; /* both per length */
};

/* A distributed load; its line from `start` to `end`, in the axes of the axis. */
struct section_spread {
    size_t force; /* in the diagram */
    double length;
    struct vec start, end, resultant;
};

/* The work of fbd_section_new. */
struct section_work {
    fbd_section *section;
    fbd_state *state;
    const fbd_statics *statics;
    fbd_errors *errors;
    size_t body;
    fbd_body seen;
    size_t force_count, bar_count, spread_count, place_count;
    fbd_listed_force *forces;
    struct section_bar *bars;
    struct section_spread *spreads;
    double *places; /* where loads act, begin or end */
    /* in the axes of the axis: weight per mass, acceleration of its start, angular acceleration and velocity */
    struct vec gravity, acceleration;
    double alpha, omega;
};

/* Find the axis of the body and its parts; false with a note. */
bool section_find_axis(struct section_work *work);

/* List the loads; false with a note. */
bool section_list_loads(struct section_work *work);

/* The densities of force and couple at x: f_e, f_n, p_n f_e - c; `piece` is a place in the same stretch. */
void section_density(const struct section_work *work, double x, double piece, double density[3]);

#endif
