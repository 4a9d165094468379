/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Course: the state along a step as polynomials, for enclosures over any stretch of it.
 *
 * The dense output of a step is taken for the motion: an event is where the dense output has it, and how far
 * that is from the solution is the business of the error control. For most methods each component is a
 * polynomial, whose powers they know; for some of a known degree d, which d + 1 samples give to rounding. Where it is not (implicit methods
 * that redo a step, places in the world, which are functions of coordinates), the samples
 * give a Chebyshev series, and its last two terms are the bound of what is left out: ASSUMED, not proved; the
 * step is looked at in shorter pieces until they are small. A first look by a series of degree 4 over the
 * whole of a step has wide bounds and costs little: it decides where nothing is near.
 */
#ifndef FBD_EVENTS_TRAJECTORY_POLY_H
#define FBD_EVENTS_TRAJECTORY_POLY_H

#include <stddef.h>

#include "base/arena.h"
#include "expr/interval.h"

/* Of a series through samples; of a first look; and of the powers that a method has. */
enum { trajectory_most_degree = 16, trajectory_coarse_degree = 4, trajectory_most_powers = 20 };

/* Fill y at t; non-zero stops. */
typedef int trajectory_sampler(void *context, double t, double *y);

/* The powers of s of a component between two times, at -1 and 1, at most trajectory_most_powers of them. The degree; below zero
 * where the motion is no polynomial. */
typedef int trajectory_powers(void *context, double from, double to, int component, double *c);

/* The samples of one degree d. */
struct trajectory_grid {
    int degree;                    /* 0: not made */
    double *node, *series, *power; /* d + 1 numbers; (d + 1) (d + 1): from samples to c, from c to powers */
};

/* One for each kind of degree that a scene goes to and fro between: it sticks along a line and slips along a wave. */
enum trajectory_grid_kind {
    trajectory_grid_coarse,
    trajectory_grid_simple,
    trajectory_grid_full,
    trajectory_grids
};

struct trajectory {
    size_t size, count; /* of y; components that are followed */
    int *component;     /* count */
    int *place; /* size: of each component among those that are followed, below zero where it is not */
    int *top;   /* count: the highest power of each, below zero where it rests or is not followed */
    int degree; /* of this piece */
    struct trajectory_grid grids[trajectory_grids];
    const struct trajectory_grid *grid;
    double from, to;       /* of the present piece */
    unsigned long piece;   /* its number, from 1 on */
    bool exact;            /* its polynomials are what the method has */
    double length;         /* of the last piece that could be followed; the next may be twice as long */
    double *coefficients;  /* count x (most_powers + 1): powers of s in [-1, 1] over the piece */
    double *doubt;         /* count: what values may be off by */
    double *extent;        /* count: sum of the sizes of the powers that a method has */
    double *noise;         /* count: the least of that, set by the caller: what the motion itself is off by */
    double *scale;         /* count: the largest size of each component since trajectory_start */
    double *floor;         /* count: the share of its size below which the terms of a component are noise */
    double *tail;          /* count: the share of its last terms in the present piece */
    double *samples;       /* (most_degree + 1) x count */
    double *y;             /* size */
    struct enclosure *now; /* size: result of trajectory_enclose, */
    struct stretch enclosed; /* over this stretch; from NAN: none */
    int *fresh;              /* count: which of them are */
};

/* For vectors of `size` components, of which those flagged in `used` are followed. Made of `memory`; false when that is
 * out. */
bool trajectory_init(struct trajectory *trajectory, size_t size, const bool *used, struct arena *memory);

/* Another step: what is small is measured against sizes within one step. */
void trajectory_start(struct trajectory *trajectory);

/* Follow the motion from `from` on: as far as `to`, or to course->to before it. Of the components those that are wanted,
 * a flag for each; all of them for NULL. The motion is a polynomial of this degree if `negligible` is 0, else it is
 * followed by one to about that share of its size. Non-zero is from the sampler. */
int trajectory_set(struct trajectory *trajectory, double from, double to, const bool *wanted, int degree,
                   double negligible, trajectory_sampler *sample, void *context);

/* Follow it as far as `to` by what the motion itself has for polynomials. False where it is none. `rough`: they are those of
 * its ends alone, and it may be off by a quarter of their bends. */
bool trajectory_set_powers(struct trajectory *trajectory, double from, double to, const bool *wanted,
                           bool rough, trajectory_powers *powers, void *context);

/* Follow it as far as `to` by a series of degree 4. */
int trajectory_set_coarse(struct trajectory *trajectory, double from, double to, const bool *wanted,
                          trajectory_sampler *sample, void *context);

/* The components over a stretch of the present piece, in course->now: those that are wanted, everything for one that has
 * not been followed there. */
void trajectory_enclose(struct trajectory *trajectory, const struct stretch *stretch, const bool *wanted);

/* The highest power of s of what is in that place, as the present piece has it, and the powers; below zero where it is not
 * followed. */
int trajectory_top(const struct trajectory *trajectory, size_t place);
const double *trajectory_powers_of(const struct trajectory *trajectory, size_t place);

#endif
