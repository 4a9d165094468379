/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scan: the first instant in an interval at which one of several smooth functions becomes negative.
 *
 * Functions that come with enclosures are searched with proof (interval_roots.h): none of their zeros is missed or
 * invented, however many oscillations an interval has. That is the rule: see watchers_can_enclose. Those
 * along a motion are looked at by wide bounds first, which cost little; what these leave open is searched by
 * close ones.
 *
 * The others, and those whose enclosures are too wide to tell anything (a difference of two things that are
 * the same), are sampled, with their rates, and followed by Chebyshev series (series.h) whose zeros are found
 * likewise: three samples tell of a function that is far from zero, 17 and more of one that is near it.
 * `panel` says over how long a stretch a series may be believed.
 */
#ifndef FBD_EVENTS_SCAN_H
#define FBD_EVENTS_SCAN_H

#include <stdbool.h>
#include <stddef.h>

#include "events/interval_roots.h"
#include "events/series.h"

/* Fill values[count] and rates[count] at t; +HUGE_VAL for a function that is not active. Non-zero stops the
 * scan and is returned. */
typedef series_sampler scan_sampler;

/* Enclosures are wanted from `from` on: the end up to which they are there, `to` at most; NAN where there are
 * none. `coarse`: wide ones will do, at once over as much as there are. */
typedef double scan_follower(void *context, double from, double to, bool coarse);

/* The end of the first panel of an interval for series, above `from`. */
typedef double scan_paneller(void *context, double from, double to);

/* Where function i has its zero within [low, high], at whose end it is negative, without samples; NAN where that cannot be
 * told. */
typedef double scan_zero(void *context, size_t i, double low, double high);

/* What samples have cost so far, in right-hand sides: an interval is given up after so much of it, too. */
typedef unsigned long scan_worker(void *context);

struct scan {
    size_t count;
    scan_sampler *sample;
    void *context;
    bool *crossed; /* count: result, which functions became negative at `t` */
    double t;      /* result: the first instant at which one is negative, within two roundings of its zero */
    double resolved; /* result: the next interval should not be longer, or much work is in vain; HUGE_VAL when
                        the functions are smooth over all of this one */
    double clear;    /* result: no function becomes negative up to here (meant for a return of 2) */
    long samples;    /* counted */
    struct scan_point *points; /* two ends of a bracket and a spare one */

    /* Set by the caller after scan_init, or left NULL for functions without enclosures. */
    struct root_group *groups;
    size_t group_count;
    roots_enclose *enclose;
    scan_zero *zero;       /* or NULL */
    scan_follower *follow; /* NULL: enclosures are there for all times, and searches may run ahead */
    double horizon;        /* how far ahead at most */
    bool aside;            /* this turn: only groups that are searched aside, else only the others */
    scan_paneller *panel;  /* NULL: any length will do */
    double soon;           /* how long a first look by samples is to be at most; 0: any length */
    scan_worker *work;     /* NULL: samples cost little */

    struct prover prover;
    struct series series;
    struct root_group *lone; /* count: each function by itself, for its series */
    const struct root_group *found_in;
    bool told;              /* it is what `zero` has found, and `crossed` says which */
    bool located;           /* points[1] is the end of the bracket that was located last */
    bool resumed;           /* between scan_pass_over and scan_start */
    bool *sampled, *chosen; /* count: searched by samples; located at present */
    bool *dipped;           /* count: see scan_pass_over */
    bool *silent;           /* count: see scan_leave_out */
    bool *waits;            /* count: of these, those that have not been seen positive in this interval */
};

/* With these enclosures; `groups` are in the order of the functions and cover all of them. */
void scan_use_enclosures(struct scan *scan, struct root_group *groups, size_t count, roots_enclose *enclose,
                         scan_follower *follow);

/* Made of `memory`; false when that is out. */
bool scan_init(struct scan *scan, size_t count, scan_sampler *sample, void *context, struct arena *memory);

/* Look at (from, to]. 1: found, see `t` and `crossed`; 0: nothing; 2: given up after too many samples, or too
 * much work for them, see `clear`; negative: what the sampler returned.
 * Functions that start at or below zero are looked at once they have been seen positive, except those that
 * are still negative at the end. */
int scan_interval(struct scan *scan, double from, double to);

/* What has crossed dips below zero and does not go on: in intervals from there on it has to be seen positive before it
 * counts again, up to scan_start. */
void scan_pass_over(struct scan *scan);

/* What has crossed again and again at one place is rounding: it is not looked at, up to scan_start, and the others are.
 * False where it has been left out already. */
bool scan_leave_out(struct scan *scan);
void scan_start(struct scan *scan);

/* The functions are others now: an interval that begins where the last one ended is sampled there again. */
void scan_forget(struct scan *scan);

#endif
