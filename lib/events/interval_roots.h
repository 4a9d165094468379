/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Root exclusion: the time at which a function becomes negative, from enclosures and not from samples.
 *
 * A stretch of time has no zero of a function g if g is not negative on all of it, or if g does not decrease
 * anywhere on it; where g only decreases, its sign at the end decides. Any other stretch is halved. So
 * between the beginning and the present end of a search no zero has been missed and none invented, for any g,
 * given that the enclosures are valid, and to the rounding of g itself: two zeros between which g is negative
 * by less than its rounding (`middle` of an enclosure) do not count. There g touches zero and does not cross
 * it.
 *
 * A function far from zero costs one enclosure, which covers a whole step or any number of periods. The idea
 * is that of all branch and bound methods: R. E. Moore, Interval Analysis, 1966; for events: Park, Barton,
 * ACM TOMACS 6 (1996) 137.
 */
#ifndef FBD_EVENTS_INTERVAL_ROOTS_H
#define FBD_EVENTS_INTERVAL_ROOTS_H

#include <stddef.h>

#include "expr/interval.h"

/* Fill `out` with the functions of a group over a stretch; +HUGE_VAL for one that is not active. */
typedef void roots_enclose(void *context, size_t group, const struct stretch *stretch, struct enclosure *out);

/* A group of functions that are enclosed together, and the state of its search. */
struct root_group {
    size_t first, count; /* in the caller's list */
    bool proved;         /* it has enclosures */
    bool aside;          /* searched in a separate pass: see scan.h */
    bool open, again;    /* still to be searched; in the next piece as well */
    bool idle;           /* all functions are HUGE_VAL until the modes change: not searched */
    bool stuck;          /* enclosures are inconclusive: sampled until the functions change */
    double clear;        /* none becomes negative up to here; NAN: not searched */
    double width;        /* length of stretches that were conclusive */
    double low, high;    /* bracket of the zero that was found; high is HUGE_VAL where none was */
};

struct prover {
    roots_enclose *enclose;
    void *context;
    struct enclosure *now, *end; /* for the largest group */
    bool *waiting;               /* negative at the start of the search, and not yet seen positive */
    int blind;                   /* instants at which an enclosure was unbounded */
    bool strict; /* bounds are wider than rounding: a search that depends on them is left unfinished */
};

enum roots_result { roots_clear, roots_found, roots_unfinished };

/* Search a group from `from`, at least to `need` and, where stretches reach further, at most to `far`;
 * continue where the last search ended. A function that is negative at the start and continues to fall
 * becomes negative there; one that is flagged in `waits` must be seen positive first. Unfinished: after many
 * stretches, or where there are no bounds even for instants; clear up to group->clear. */
enum roots_result roots_search(struct prover *prover, struct root_group *groups, size_t index, double from,
                               double need, double far, const bool *waits);

#endif
