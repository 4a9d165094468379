/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scan: the first instant in an interval at which one of several smooth functions becomes negative.
 *
 * Functions that come with enclosures are searched with proof (proof.h): none of their zeros is missed or
 * invented, however many oscillations an interval has. That is the rule: see watchers_can_enclose.
 *
 * The others are known at any t with their rates. Between two samples each is compared with its cubic Hermite
 * interpolant: a sign change brackets a zero; an interior minimum of the cubic near zero, or a function that
 * the cubic does not follow, is sampled more finely. So a function that dips below zero and comes back within
 * one step is seen (an even root as well, to the accuracy of the samples), as long as it changes no faster
 * than the samples tell: `panels` says into how many parts an interval has to be divided for that. Functions
 * marked `rough` are checked against one interior sample at least in every part.
 */
#ifndef FBD_SOLVE_SCAN_H
#define FBD_SOLVE_SCAN_H

#include <stdbool.h>
#include <stddef.h>

#include "solve/proof.h"

/* Fill values[count] and rates[count] at t; +HUGE_VAL for a function that is not active. Non-zero stops the
 * scan and is returned. */
typedef int scan_sampler(void *context, double t, double *values, double *rates);

/* Enclosures are wanted from `from` on: the end up to which they are there, `to` at most; NAN where there are
 * none. */
typedef double scan_follower(void *context, double from, double to);

struct scan {
    size_t count;
    scan_sampler *sample;
    void *context;
    bool *rough;   /* count, filled by the caller */
    bool *crossed; /* count: result, which functions became negative at `t` */
    double t;      /* result: the first instant at which one is negative, within two roundings of its zero */
    double
        resolved; /* result: the next interval should not be longer; HUGE_VAL when the functions are smooth
                   * over all of this one, twice its length when they change faster than the samples tell */
    double clear; /* result: no function becomes negative up to here (meant for a return of 2) */
    long samples; /* counted */
    long most;    /* samples that may be counted before the scan gives up */
    double known; /* the end of the last interval, where the functions are known; NAN: they are not */
    struct scan_point *points; /* pool for the recursion */
    double *memory;

    /* Set by the caller after scan_init, or left NULL for functions without enclosures. */
    struct proof_group *groups;
    size_t group_count;
    proof_enclose *enclose;
    scan_follower *follow; /* NULL: enclosures are there for all times, and searches may run ahead */
    double horizon;        /* how far ahead at most */
    bool resumed;          /* see proof_search */
    bool aside;            /* this turn: only groups that are searched aside, else only the others */
    size_t panels;         /* for functions without enclosures; 0 counts as 1 */

    struct prover prover;
    const struct proof_group *found_in;
    bool located;           /* points[1] is the end of the bracket that was located last */
    bool *sampled, *chosen; /* count: searched by samples; located at present */
};

/* With these enclosures; `groups` are in the order of the functions and cover all of them. False when memory
 * is out. */
bool scan_use_enclosures(struct scan *scan, struct proof_group *groups, size_t count, proof_enclose *enclose,
                         scan_follower *follow);

/* False when memory is out. */
bool scan_init(struct scan *scan, size_t count, scan_sampler *sample, void *context);
void scan_free(struct scan *scan);

/* Look at (from, to]. 1: found, see `t` and `crossed`; 0: nothing; 2: given up after too many samples, see
 * `clear`; negative: what the sampler returned.
 * Functions that start at or below zero are looked at once they have been seen positive, except those that
 * are still negative at the end. */
int scan_interval(struct scan *scan, double from, double to);

/* The functions are others now: an interval that begins where the last one ended is sampled there again. */
void scan_forget(struct scan *scan);

#endif
