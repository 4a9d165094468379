/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Proof: where a function becomes negative, from enclosures and not from samples.
 *
 * A stretch of time is clear of a function g when g is not negative on all of it, or when g does not fall on
 * any of it; where g only falls, its sign at the end decides. What is none of these is halved. So between
 * where a search begins and where it has come to, no zero has been missed and none invented, whatever g does
 * in between - given that the enclosures hold, and to the rounding of g itself: two zeros between which g is
 * beyond zero by less than its rounding (`middle` of an enclosure) are none. There g touches zero and does
 * not pass it.
 *
 * A far function costs one enclosure, which covers a whole step or any number of periods. The idea is that of
 * all branch and bound methods: R. E. Moore, Interval Analysis, 1966; for events: Park, Barton, ACM TOMACS 6
 * (1996) 137.
 */
#ifndef FBD_EVENTS_INTERVAL_ROOTS_H
#define FBD_EVENTS_INTERVAL_ROOTS_H

#include <stddef.h>

#include "expr/interval.h"

/* Fill `out` with the functions of a group over a stretch; +HUGE_VAL for one that is not active. */
typedef void roots_enclose(void *context, size_t group, const struct stretch *stretch, struct enclosure *out);

/* A group of functions that are enclosed together, and how far it has been searched. */
struct root_group {
    size_t first, count; /* in the caller's list */
    bool proved;         /* it has enclosures */
    bool aside;          /* searched in a turn of its own: see scan.h */
    bool open, again;    /* still to be searched; in the next piece as well */
    bool idle;           /* HUGE_VAL, all of it, until the functions are others: nothing to search */
    bool stuck;          /* enclosures tell nothing: left to samples until the functions are others */
    double clear;        /* none becomes negative up to here; NAN: not searched */
    double width;        /* of stretches that have told enough */
    double low, high;    /* bracket of the zero that was found; high is HUGE_VAL where none was */
};

struct prover {
    roots_enclose *enclose;
    void *context;
    struct enclosure *now, *end; /* for the largest group */
    bool *waiting;               /* negative where the search began, and not seen otherwise */
    int blind;                   /* instants at which an enclosure was everything */
    bool strict; /* bounds are wider than rounding: what hangs on that, or takes many stretches, is left
                    unfinished */
};

enum roots_result { roots_clear, roots_found, roots_unfinished };

/* Search a group from `from` on, at least to `need` and, where stretches reach further, at most to `far`; go
 * on where the last search ended. A function that is negative at the start and goes on falling becomes
 * negative there; one of those that wait, a flag for each of the group, has to be seen above zero first.
 * Unfinished: after many stretches, or where there are no bounds even for instants; clear up to
 * group->clear. */
enum roots_result roots_search(struct prover *prover, struct root_group *groups, size_t index, double from,
                               double need, double far, const bool *waits);

#endif
