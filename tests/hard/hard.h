/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the tests of hard cases share: the methods with tolerances they can reach, runs that may fail, and
 * the line that names a case with its error, tolerance and ratio.
 */
#ifndef FBD_TESTS_HARD_H
#define FBD_TESTS_HARD_H

#include "gallery.h"
#include "thorough.h"

/* ---- methods */

struct hard_method {
    const char *name; /* NULL: what the library does by itself */
    double tolerance; /* one that a method of its order reaches in a sensible number of steps */
    int order;
    bool implicit;
    bool no_structure;
};

/* Number 0 is what the library does by itself, number 1 the same without structure, the others are the
 * methods that it has by name; false beyond the last. So a method that is added to the library takes part in
 * every case. Under a sanitizer, number 0 and every third of the others; which third is another from test to test. */
bool hard_method_in_turn(size_t index, size_t turn, struct hard_method *method);

static inline bool hard_method_at(size_t index, struct hard_method *method)
{
    return hard_method_in_turn(index, sizeof __BASE_FILE__, method); /* the name of the test's own file */
}

/* A check of one method at its tolerance, of every method at 1e-4, 1e-6, ... 1e-12; those of order 2 and less
 * only down to 1e-8: beyond, they take some million steps. Under a sanitizer, at 1e-6 alone. */
void hard_each_tolerance(void (*check)(struct checks *checks, const struct hard_method *method));

/* ---- runs */

/* Start with a method (NULL: all as the file and the library say) up to `until` (NAN: the file's). */
void hard_start(struct trial *trial, const struct hard_method *method, double until);

/* Advance to the end of the run, however it ends, and take the last state. */
fbd_outcome hard_finish(struct trial *trial);

/* The same; a run that does not reach its end time is a failure, with its reason printed. */
bool hard_done(struct checks *checks, struct trial *trial);

size_t hard_count(const struct trial *trial, fbd_event_kind kind);

/* What a tolerance promises where errors are not magnified: each step errs by at most the tolerance times
 * the size of the motion, and an estimate is right to a factor of two. */
double hard_promise(const struct trial *trial);

/* ---- cases */

/* Write `# name (method at tolerance): error ..., tolerance ..., ratio ...`, a comment in TAP, on standard
 * output; a ratio above 1 or an error that is not a number fails. */
bool hard_case(struct checks *checks, const struct trial *trial, const char *name, double error,
               double tolerance);

/* ---- references */

/* The zero of a function that changes its sign once in [low, high], to the rounding of its argument. */
double hard_root(double (*function)(double t, const void *context), const void *context, double low,
                 double high);

#endif
