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
#ifndef FBD_EVENTS_COURSE_H
#define FBD_EVENTS_COURSE_H

#include <stddef.h>

#include "base/arena.h"
#include "expr/interval.h"

/* Of a series through samples; of a first look; and of the powers that a method has. */
enum { course_most_degree = 16, course_coarse_degree = 4, course_most_powers = 20 };

/* Fill y at t; non-zero stops. */
typedef int course_sampler(void *context, double t, double *y);

/* The powers of s of a component between two times, at -1 and 1, at most course_most_powers of them. The degree; below zero
 * where the motion is no polynomial. */
typedef int course_powers(void *context, double from, double to, int component, double *c);

/* The samples of one degree d. */
struct course_grid {
    int degree;                    /* 0: not made */
    double *node, *series, *power; /* d + 1 numbers; (d + 1) (d + 1): from samples to c, from c to powers */
};

/* One for each kind of degree that a scene goes to and fro between: it sticks along a line and slips along a wave. */
enum course_grid_kind { course_grid_coarse, course_grid_simple, course_grid_full, course_grids };

struct course {
    size_t size, count; /* of y; components that are followed */
    int *component;     /* count */
    int *place; /* size: of each component among those that are followed, below zero where it is not */
    int *top;   /* count: the highest power of each, below zero where it rests or is not followed */
    int degree; /* of this piece */
    struct course_grid grids[course_grids];
    const struct course_grid *grid;
    double from, to;       /* of the present piece */
    unsigned long piece;   /* its number, from 1 on */
    bool exact;            /* its polynomials are what the method has */
    double length;         /* of the last piece that could be followed; the next may be twice as long */
    double *coefficients;  /* count x (most_powers + 1): powers of s in [-1, 1] over the piece */
    double *doubt;         /* count: what values may be off by */
    double *extent;        /* count: sum of the sizes of the powers that a method has */
    double *noise;         /* count: the least of that, set by the caller: what the motion itself is off by */
    double *scale;         /* count: the largest size of each component since course_start */
    double *floor;         /* count: the share of its size below which the terms of a component are noise */
    double *tail;          /* count: the share of its last terms in the present piece */
    double *samples;       /* (most_degree + 1) x count */
    double *y;             /* size */
    struct enclosure *now; /* size: result of course_enclose, */
    struct stretch enclosed; /* over this stretch; from NAN: none */
    int *fresh;              /* count: which of them are */
};

/* For vectors of `size` components, of which those flagged in `used` are followed. Made of `memory`; false when that is
 * out. */
bool course_init(struct course *course, size_t size, const bool *used, struct arena *memory);

/* Another step: what is small is measured against sizes within one step. */
void course_start(struct course *course);

/* Follow the motion from `from` on: as far as `to`, or to course->to before it. Of the components those that are wanted,
 * a flag for each; all of them for NULL. The motion is a polynomial of this degree if `negligible` is 0, else it is
 * followed by one to about that share of its size. Non-zero is from the sampler. */
int course_set(struct course *course, double from, double to, const bool *wanted, int degree,
               double negligible, course_sampler *sample, void *context);

/* Follow it as far as `to` by what the motion itself has for polynomials. False where it is none. `rough`: they are those of
 * its ends alone, and it may be off by a quarter of their bends. */
bool course_set_powers(struct course *course, double from, double to, const bool *wanted, bool rough,
                       course_powers *powers, void *context);

/* Follow it as far as `to` by a series of degree 4. */
int course_set_coarse(struct course *course, double from, double to, const bool *wanted,
                      course_sampler *sample, void *context);

/* The components over a stretch of the present piece, in course->now: those that are wanted, everything for one that has
 * not been followed there. */
void course_enclose(struct course *course, const struct stretch *stretch, const bool *wanted);

/* The highest power of s of what is in that place, as the present piece has it, and the powers; below zero where it is not
 * followed. */
int course_top(const struct course *course, size_t place);
const double *course_powers_of(const struct course *course, size_t place);

#endif
