/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scan: the first instant in an interval at which one of several smooth functions becomes negative.
 *
 * Functions with enclosures are searched by root exclusion (interval_roots.h): no zero is missed or invented,
 * however many oscillations an interval has. Most functions are of this kind: see watchers_can_enclose. Those
 * that depend on the motion are first searched with wide bounds, which cost little; groups that remain open
 * are searched with close ones.
 *
 * The others, and those whose enclosures are too wide (a difference of two equal quantities), are sampled,
 * with their rates, and represented by Chebyshev series (series.h) whose zeros are found likewise: three
 * samples suffice for a function far from zero, 17 and more are needed near it. `panel` limits the length
 * over which a series is reliable.
 */
#ifndef FBD_EVENTS_SCAN_H
#define FBD_EVENTS_SCAN_H

#include <stdbool.h>
#include <stddef.h>

#include "events/interval_roots.h"
#include "events/series.h"

/* Fill values[count] and rates[count] at t, those asked for; +HUGE_VAL for a function that is not active.
 * Non-zero stops the scan and is returned. */
typedef series_sampler scan_sampler;

/* Provide enclosures from `from` on; returns the end up to which they are valid, `to` at most, or NAN if
 * there are none. `coarse`: wide ones suffice, over as long a stretch as possible. */
typedef double scan_follower(void *context, double from, double to, bool coarse);

/* The end of the first panel of an interval for series, above `from`. */
typedef double scan_paneller(void *context, double from, double to);

/* The zero of function i within [low, high], at whose end it is negative, without samples; NAN if not
 * available. */
typedef double scan_zero(void *context, size_t i, double low, double high);

/* Cost of all samples so far, in right-hand sides; an interval is also given up at a limit of this cost. */
typedef unsigned long scan_worker(void *context);

struct scan_point {
    double t;
    double *values, *rates; /* of all functions */
};

struct scan {
    size_t count;
    scan_sampler *sample;
    void *context;
    bool *crossed; /* count: result, which functions became negative at `t` */
    double t;      /* result: the first instant at which one is negative, within two roundings of its zero */
    double resolved;           /* result: advisable limit of the next interval; HUGE_VAL if all are smooth */
    double clear;              /* result: no function becomes negative up to here (meant for a return of 2) */
    long samples;              /* counted */
    struct scan_point *points; /* two ends of a bracket and a spare one */

    /* Set by the caller after scan_init, or left NULL for functions without enclosures. */
    struct root_group *groups;
    size_t group_count;
    roots_enclose *enclose;
    scan_zero *zero;       /* or NULL */
    scan_follower *follow; /* NULL: enclosures exist for all times, and searches may run ahead */
    double horizon;        /* limit of searches ahead */
    bool aside;            /* present pass: only groups flagged `aside`, else only the others */
    scan_paneller *panel;  /* NULL: any length is allowed */
    double soon;           /* longest first panel of samples; 0: any length */
    scan_worker *work;     /* NULL: samples cost little */

    struct prover prover;
    struct series series;
    struct root_group *lone; /* count: each function as a group, for its series */
    const struct root_group *found_in;
    bool told;              /* the result is from `zero`, and `crossed` is set */
    bool located;           /* points[1] is the end of the bracket that was located last */
    bool resumed;           /* between scan_pass_over and scan_start */
    bool *sampled, *chosen; /* count: searched by samples; located at present */
    bool *unfinished;       /* count: their series have to be refined */
    bool *dipped;           /* count: see scan_pass_over */
    bool *silent;           /* count: see scan_leave_out */
    bool *waits;            /* count: of the dipped ones, those not yet seen positive in this interval */
};

/* With these enclosures; `groups` are in the order of the functions and cover all of them. */
void scan_use_enclosures(struct scan *scan, struct root_group *groups, size_t count, roots_enclose *enclose,
                         scan_follower *follow);

/* Made of `memory`; false when that is out. */
bool scan_init(struct scan *scan, size_t count, scan_sampler *sample, void *context, struct arena *memory);

/* Search (from, to]. 1: found, see `t` and `crossed`; 0: no zero; 2: given up after too many samples, or too
 * much work for them, see `clear`; negative: return code of the sampler. Functions that start at or below
 * zero are searched after they have been seen positive, except those that are still negative at the end. */
int scan_interval(struct scan *scan, double from, double to);

/* The functions that crossed only dip below zero: until scan_start each must be seen positive in an interval
 * that starts there or later before it counts again. */
void scan_pass_over(struct scan *scan);

/* A function that crosses repeatedly at one place is round-off: exclude it until scan_start. False if it is
 * already excluded. */
bool scan_leave_out(struct scan *scan);
void scan_start(struct scan *scan);

/* The functions have changed: an interval that begins where the last one ended is sampled there again. */
void scan_forget(struct scan *scan);

#endif
