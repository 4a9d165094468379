/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The state along a step as polynomials, for enclosures over any stretch of it.
 *
 * The dense output of a step is taken for the motion: events are those of the dense output; its distance from
 * the solution is controlled by the error control. For most methods each component is a polynomial whose
 * powers the method provides; for some only the degree d is given, and d + 1 samples determine it to
 * rounding. Where the motion is not a polynomial (implicit methods that repeat a step, positions in the
 * world, which are functions of coordinates), the samples give a Chebyshev series, and its last two terms are
 * the bound of the truncation error: ASSUMED, not proved; the step is divided into shorter pieces until they
 * are small. A first series of degree 4 over the whole step has wide bounds and costs little: it excludes
 * functions that are far from zero.
 */
#ifndef FBD_EVENTS_TRAJECTORY_POLY_H
#define FBD_EVENTS_TRAJECTORY_POLY_H

#include <stddef.h>

#include "base/arena.h"
#include "expr/interval.h"

/* Highest degrees: of a series through samples; of the coarse series; of the powers of a method. */
enum { trajectory_most_degree = 16, trajectory_coarse_degree = 4, trajectory_most_powers = 20 };

/* Fill y at t; non-zero stops. */
typedef int trajectory_sampler(void *context, double t, double *y);

/* Set the coefficients of the powers of s of a component between two times, at s = -1 and 1, at most
 * trajectory_most_powers of them. Returns the degree; below zero where the motion is not a polynomial. */
typedef int trajectory_powers(void *context, double from, double to, int component, double *c);

/* The samples of one degree d. */
struct trajectory_grid {
    int degree;                    /* 0: not set */
    double *node, *series, *power; /* d + 1 numbers; (d + 1) (d + 1): from samples to c, from c to powers */
};

/* One for each kind of degree, as a scene may alternate between them: it sticks along a line and slips along
 * a wave. */
enum trajectory_grid_kind {
    trajectory_grid_coarse,
    trajectory_grid_simple,
    trajectory_grid_full,
    trajectory_grids
};

struct trajectory {
    size_t size, count; /* of y; components that are followed */
    int *component;     /* count */
    int *place;         /* size: index of each component among those that are followed, below zero if not */
    int *top;           /* count: highest power of each, below zero if at rest or not followed */
    int degree;         /* of this piece */
    struct trajectory_grid grids[trajectory_grids];
    const struct trajectory_grid *grid;
    double from, to;      /* of the present piece */
    unsigned long piece;  /* its number, from 1 on */
    bool exact;           /* the polynomials are those of the method */
    double length;        /* of the last resolved piece; the next may be twice as long */
    double *coefficients; /* count x (most_powers + 1): powers of s in [-1, 1] over the piece */
    double *doubt;        /* count: error bound of the values */
    double *extent;       /* count: sum of the absolute coefficients of a method's powers */
    double *noise;        /* count: lower limit of doubt, set by the caller: error of the motion itself */
    double *scale;        /* count: the largest size of each component since trajectory_start */
    double *floor;        /* count: the part of its size below which the terms of a component are round-off */
    double *tail;         /* count: last terms in the present piece relative to the size */
    double *samples;      /* (most_degree + 1) x count */
    double *y;            /* size */
    struct enclosure *now;   /* size: result of trajectory_enclose, */
    struct stretch enclosed; /* over this stretch; from NAN: none */
    int *fresh;              /* count: which of them are up to date */
};

/* For vectors of `size` components, of which those flagged in `used` are followed. Allocates in `memory`;
 * false when that is out. */
bool trajectory_init(struct trajectory *trajectory, size_t size, const bool *used, struct arena *memory);

/* Another step: reset the sizes, with which small terms are compared. */
void trajectory_start(struct trajectory *trajectory);

/* Follow the motion from `from` to `to`, or to an earlier end, trajectory->to. `wanted`: a flag for each
 * component; NULL for all. The motion is a polynomial of this degree if `negligible` is 0, else it is
 * approximated by one to about that part of its size. A non-zero result is that of the sampler. */
int trajectory_set(struct trajectory *trajectory, double from, double to, const bool *wanted, int degree,
                   double negligible, trajectory_sampler *sample, void *context);

/* Follow the motion to `to` by the polynomials of the method. False if it has none. `rough`: the polynomials
 * are those of the ends alone, with an error of up to a quarter of the bound of their curvature terms. */
bool trajectory_set_powers(struct trajectory *trajectory, double from, double to, const bool *wanted,
                           bool rough, trajectory_powers *powers, void *context);

/* Follow the motion to `to` by a series of degree 4. */
int trajectory_set_coarse(struct trajectory *trajectory, double from, double to, const bool *wanted,
                          trajectory_sampler *sample, void *context);

/* Enclose the wanted components over a stretch of the present piece, in trajectory->now; a component that is
 * not followed there is unbounded. */
void trajectory_enclose(struct trajectory *trajectory, const struct stretch *stretch, const bool *wanted);

/* The degree of the component with this index in the present piece, and its coefficients of powers of s;
 * below zero if it is not followed. */
int trajectory_top(const struct trajectory *trajectory, size_t place);
const double *trajectory_powers_of(const struct trajectory *trajectory, size_t place);

#endif
