/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Series: functions along a stretch of time as Chebyshev series, made from samples of value and rate.
 *
 * With s in [-1, 1] over the panel, f = sum c_j T_j(s) + e. Three levels: values and rates at the ends and at
 * one point inside give degree 5; values at 9 and 17 points give degrees 8 and 16, and the rates there must
 * be those of the series. The truncation error e is taken to be no more than the last terms: ASSUMED, not
 * proved. It holds for functions that are analytic on the panel and vary there on no shorter scale than the
 * spacing of samples; so panels are limited by the known fast variations (scan.h), and a panel with a series
 * whose last terms do not fall, or whose rates are wrong, is halved. Under this assumption all zeros of the
 * function are those of the series, which interval_roots.h finds without exception.
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
    bool known;             /* the samples at both ends are valid */
    int level, degree;      /* of the present panel, the latest samples; of the series */
    double *values, *rates; /* count x nodes: at s = cos(pi k / 16); those of a level are a part of them */
    double *c, *doubt;      /* count x nodes; count: bound of e and rounding */
    double *scale,
        *floor;   /* count: the largest size in a step; the part of it below which terms are round-off */
    double *tail; /* count: the truncation error relative to the size */
    double *value, *rate; /* count: one sample */
    double *rounding;     /* count, set by the caller: round-off level of each function */
    double *jump;         /* the same: it may jump by so much, twice this level */
    double *off;          /* count: error of the rates of the last panel */
    double *matrices;     /* of each level: from values (and rates) at its nodes to c */
    bool prepared;        /* the matrices are set */
};

/* Fill values[count] and rates[count] at t; non-zero stops. Functions that are not asked for may be left out, as
 * +HUGE_VAL; `asked` is NULL for all. */
typedef int series_sampler(void *context, double t, const bool *asked, double *values, double *rates);

/* Allocate in `memory`; memory->failed if that is out. */
void series_init(struct series *series, size_t count, struct arena *memory);

/* Another step: reset the sizes. */
void series_start(struct series *series);

/* Another panel. If it begins where the last one begins or ends, the first sample is reused. */
void series_open(struct series *series, double from, double to);

/* The functions have changed: discard all samples. */
void series_forget(struct series *series);

/* Take the samples of the next level: of the first one for all functions, since the next panel may use them
 * for others, then for those asked for. Non-zero is from the sampler. */
int series_refine(struct series *series, series_sampler *sample, void *context, const bool *asked);

enum series_state {
    series_inactive,   /* +HUGE_VAL all along */
    series_rough,      /* the truncation error matters: only bounds that include it are valid */
    series_followed,   /* the truncation error is round-off */
    series_unresolved, /* the samples do not resolve the function */
};

/* Fit function i at the present level. `halved`: the panel is half of one that was unresolved. */
enum series_state series_fit(struct series *series, size_t i, bool halved);

/* Is it so far above zero that the sizes of the terms prove it positive? */
bool series_is_positive(const struct series *series, size_t i);

/* Function i over a stretch of the panel. */
struct enclosure series_enclose(const struct series *series, size_t i, const struct stretch *stretch);

#endif
