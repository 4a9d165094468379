/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_section: distributed loads, and the forces inside a straight body. The rules of fbd.h apply.
 */
#ifndef FBD_SECTION_H
#define FBD_SECTION_H

#include "fbd_study.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- distributed loads */

/* The line of a distributed load, whose resultant is a force of the diagram. */
typedef struct fbd_spread {
    double from[2], to[2]; /* points of the body, in its frame; NAN for a force that is not distributed */
    double length;         /* 0 for such a force */
} fbd_spread;

FBD_API fbd_spread fbd_model_spread(const fbd_model *model, size_t body, size_t force);

/* The part of the resultant per length at the distance s from the start of the line: its integral is 1, and 0 for
 * a load of nothing; NAN for a force that is not distributed. */
FBD_API double fbd_model_spread_density(const fbd_model *model, size_t body, size_t force, double s);

/* The ends of the intervals of s on which that is smooth, 0 and the length included. Fills at most `room` of them;
 * returns their number, 0 for a force that is not distributed or when memory is out. */
FBD_API size_t fbd_model_spread_ends(const fbd_model *model, size_t body, size_t force, double *ends,
                                     size_t room);

/* ---------------------------------------------------------------- section forces */

/* Normal force N, shear force V and bending moment M along a straight body, a rod or a long plate: of the section at
 * the distance x from the start of its axis (the end `from`, or `left`). N > 0 is tension, V > 0 turns a part
 * clockwise, M > 0 bends the body hollow on the left side of the axis (for an axis to the right: sagging). */
typedef struct fbd_section fbd_section;

/* Find them from the free-body diagram of the body and the inertia of its mass (d'Alembert's forces -m a) at the
 * state, in its modes; with `statics`, of that state at rest, from the reactions there. The section does not need the
 * state and the statics from then on, but the model. NULL with a note in `errors`: `unknown-body`, `no-section` (the
 * body is not straight, or the distribution of its mass is not known), `no-balance` (N, V and M do not vanish beyond
 * the other end, or the scene is not in equilibrium), or memory is out. */
FBD_API fbd_section *fbd_section_new(fbd_state *state, const fbd_statics *statics, const char *body,
                                     fbd_errors *errors);
FBD_API void fbd_section_free(fbd_section *section);

FBD_API double fbd_section_length(const fbd_section *section);

/* The body and the state of a section. */
typedef struct fbd_section_source {
    const fbd_model *model;
    const char *body;
    double t;
    bool at_rest;
} fbd_section_source;

FBD_API fbd_section_source fbd_section_source_of(const fbd_section *section);

/* The ends of the intervals of x on which N, V and M are smooth, 0 and the length included, in ascending order. Fills at
 * most `room` of them; returns their number. */
FBD_API size_t fbd_section_ends(const fbd_section *section, double *ends, size_t room);

/* Read a place: a named point of the body, or a length of numbers and parameters ("1.2 m", "L/2"). Returns false with a
 * note in `errors`: `bad-place`, or those of an expression. */
FBD_API bool fbd_section_place(const fbd_section *section, const char *text, double *x, fbd_errors *errors);

typedef struct fbd_cut {
    double x, N, V, M;
} fbd_cut;

/* N, V and M at x; where they jump, before x or `behind` it. A place that differs from an end by round-off is that end; NAN
 * outside of the body. */
FBD_API fbd_cut fbd_section_at(const fbd_section *section, double x, bool behind);

/* A load at one place of the axis, with the jumps of N, V and M, in ascending order of x; name NULL past the last. */
typedef struct fbd_section_load {
    const char *name;
    double x, N, V, M;
} fbd_section_load;

FBD_API size_t fbd_section_load_count(const fbd_section *section);
FBD_API fbd_section_load fbd_section_load_get(const fbd_section *section, size_t index);

/* The least or the greatest value of N (0), V (1) or M (2), and its place. */
typedef struct fbd_section_extreme {
    double x, value;
} fbd_section_extreme;

FBD_API fbd_section_extreme fbd_section_extreme_of(const fbd_section *section, int force, bool greatest);

/* A table along the body, or of the section at `x` alone (NULL: the table); the same as one JSON object; the three
 * diagrams as an SVG document. NULL when memory is out. */
FBD_API char *fbd_section_text(const fbd_section *section, const double *x);
FBD_API char *fbd_section_json(const fbd_section *section, const double *x);
FBD_API char *fbd_section_svg(const fbd_section *section);

#ifdef __cplusplus
}
#endif

#endif
