/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Series: functions along a stretch of time as Chebyshev series, made from samples of value and rate.
 *
 * With s in [-1, 1] over the panel, f = sum c_j T_j(s) + e. Three levels: values and rates at the ends and at
 * one place inside give degree 5; values at 9 and 17 points give degrees 8 and 16, and the rates there must
 * be those of the series. What is left out, e, is taken to be no more than the last terms: ASSUMED, not
 * proved. It holds for functions that are analytic on the panel and change there on no shorter scale than the
 * samples show; so panels are no longer than what is known to vary fast allows (scan.h), and a series whose
 * last terms do not fall, or which misses the rates, is not believed: the panel is halved. Given that, all
 * zeros of the function are those of the series, which interval_roots.h finds without exception.
 *
 * Source: L. N. Trefethen, Approximation Theory and Approximation Practice, SIAM 2013, chapters 3, 4 and 8;
 * for events so F. Biscani, D. Izzo, MNRAS 504 (2021) 2614 (heyoka, with Taylor series).
 */
#ifndef FBD_EVENTS_SERIES_H
#define FBD_EVENTS_SERIES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "expr/interval.h"

enum { series_levels = 3, series_most_degree = 16, series_nodes = series_most_degree + 1 };

struct series {
    size_t count; /* of functions */
    double from, to;
    bool known;             /* the functions at both ends are those of the samples */
    int level, degree;      /* of the present panel, the samples taken last; of the series */
    double *values, *rates; /* count x nodes: at s = cos(pi k / 16); those of a level are a part of them */
    double *c, *doubt;      /* count x nodes; count: the size of e, and rounding */
    double *scale,
        *floor;           /* count: the largest size in a step; the share of it below which terms are noise */
    double *tail;         /* count: the share of what is left out */
    double *value, *rate; /* count: one sample */
    double *rounding;     /* count, set by the caller: what is known of the rounding of each function */
    double *off;          /* count: by how much the rates of the last panel were missed */
    double *matrices;     /* of each level: from values (and rates) at its nodes to c */
    bool prepared;        /* they are made */
};

/* Fill values[count] and rates[count] at t; non-zero stops. */
typedef int series_sampler(void *context, double t, double *values, double *rates);

/* Made of `memory`, which fails when it is out. */
void series_init(struct series *series, size_t count, struct arena *memory);

/* Another step: sizes are those within one step. */
void series_start(struct series *series);

/* Another panel. One that begins where the last one begins or ends has its first sample from there. */
void series_open(struct series *series, double from, double to);

/* The functions are others now. */
void series_forget(struct series *series);

/* Take the samples of the next level. Non-zero is from the sampler. */
int series_refine(struct series *series, series_sampler *sample, void *context);

enum series_state {
    series_inactive,   /* +HUGE_VAL all along */
    series_rough,      /* what is left out matters: only bounds that allow for it can be believed */
    series_followed,   /* what is left out is rounding */
    series_unresolved, /* the samples do not tell the function */
};

/* Fit function i at the present level. `halved`: the panel is half of one that was unresolved. */
enum series_state series_fit(struct series *series, size_t i, bool halved);

/* Is it so far above zero that the sizes of the terms tell? */
bool series_is_positive(const struct series *series, size_t i);

/* Function i over a stretch of the panel. */
struct enclosure series_enclose(const struct series *series, size_t i, const struct stretch *stretch);

#endif
