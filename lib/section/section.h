/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Section forces of a straight body: normal force N, shear force V and bending moment M at the section at the
 * distance x from the start of its axis.
 *
 * e is the unit vector along the axis, n is e turned by 90 degrees to the left. With the loads on the part from 0 to x
 * (forces F, couples C, places p, and per length f, c) its equilibrium, inertia included as loads -m a, gives
 *
 *   N(x) = - sum of F . e,   V(x) = sum of F . n,   M(x) = sum of ((x - p_e) F . n + p_n F . e - C).
 *
 * So N > 0 is tension; V > 0 turns a part between two sections clockwise; M > 0 bends it to be hollow on the side of n
 * (sagging, for an axis to the right). dN/dx = -f_e, dV/dx = f_n, dM/dx = V + p_n f_e - c.
 *
 * A part of mass mu and moment of inertia iota per length has f = mu (g - a), c = -iota alpha, where a is linear in x. So
 * between two places where a load begins, ends or acts, N and M are cubic at most and V quadratic, for loads of constant
 * density per length; every density is a polynomial there, by interpolation where the file gives another function. The
 * places of extremes are roots of the derivatives, which are found exactly (polynomial.h).
 *
 * Beyond the other end N, V and M are zero: the test of each result.
 */
#ifndef FBD_SECTION_SECTION_H
#define FBD_SECTION_SECTION_H

#include "base/arena.h"
#include "base/vec.h"
#include "dynamics/state.h"
#include "fbd_section.h"
#include "section/polynomial.h"

enum section_force { section_N, section_V, section_M, section_forces };

/* A force or couple at one place of the axis; `jump` are the steps of N, V and M there. */
struct section_load {
    const char *name;
    double x;
    double jump[section_forces];
};

/* A stretch of the axis without a load at one place inside. The density of a load is a polynomial of t = -1 ... 1. */
struct section_piece {
    double from, to;
    struct polynomial along, across, couple; /* f_e, f_n, dM/dx - V = p_n f_e - c */
    struct polynomial of[section_forces];    /* N, V, M */
};

struct fbd_section {
    struct arena arena;
    const fbd_model *model; /* its texts */
    const struct model_body *body;
    const char *start, *end; /* the names of its ends, or NULL */
    bool at_rest;
    double t, length;
    struct vec origin, e; /* of the axis, in the frame of the body */
    double near; /* places that differ by less are one [length]: round-off of the length and of the origin */
    size_t load_count, piece_count, piece_room, lump_count;
    struct section_load *loads;
    struct section_piece *pieces;
    double size[section_forces]; /* sums of the magnitudes of all loads, for rounding */
    fbd_section_extreme extremes[section_forces][2];
};

/* The section forces of a body at an evaluated state, in its modes; `at_rest`: without inertia, as of the state of
 * statics. Extremes and the names of the ends are left out (fbd_section_new has them). NULL with a note: `no-section`,
 * `no-balance`, or memory is out. */
fbd_section *section_new(const struct fbd_state *state, bool at_rest, int body, fbd_errors *errors);

/* The end of a piece that is within `near` of x; else x. */
double section_snap(const fbd_section *section, double x);

/* One of them at x, where it jumps before x or `behind` it; at the ends of the body within it. NAN outside, beyond
 * `near`. */
double section_force_at(const fbd_section *section, enum section_force force, double x, bool behind);

/* A value at the round-off level of the reactions is 0. */
double section_rounded(const fbd_section *section, enum section_force force, double value);

#endif
