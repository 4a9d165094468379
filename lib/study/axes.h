/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Axes: the values that a sweep gives to the parameters of a model, and which of them belong to which run.
 *
 *     NAME=VALUES[; NAME=VALUES ...]
 *
 *     0.1:0.6:51            51 values from 0.1 to 0.6, evenly
 *     1:1000:4:log          4 values from 1 to 1000, each the same multiple of the one before
 *     1,2,5 m/s             a list
 *     dry.csv,wet.csv       files of a table
 *     uniform(1,2) kg:100   100 random draws; also normal(mean,deviation) and loguniform(low,high)
 *
 * One text is one axis; its members go side by side, so they have equally many values. The axes are combined:
 * each value with each, the last axis changing fastest. A unit belongs to all values of its member, wherever
 * it is written; without one a value counts as a bare number of the file.
 */
#ifndef FBD_STUDY_AXES_H
#define FBD_STUDY_AXES_H

#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"
#include "study/draws.h"

#include <stdint.h>

struct member {
    const char *name;
    const char *unit; /* as written, or "" */
    uint64_t key;     /* of its draws: made of the name, so that they do not depend on what else varies */
    enum { values_listed, values_words, values_even, values_log, values_drawn } kind;
    enum distribution distribution;
    double a, b; /* ends of a grid, or what the distribution takes */
    const double *list;
    const char *const *words;
    uint64_t count;
    size_t axis;
};

struct axes {
    struct member *members;
    size_t member_count, axis_count;
    uint64_t *counts; /* axis_count: values of each axis */
    uint64_t seed;
    uint64_t runs;
};

enum { most_members = 100 };

/* The most runs of a sweep: their numbers are exact as doubles, for whoever reads the table. */
static const uint64_t most_runs = UINT64_C(1) << 53;

/* Read the texts; `zip` makes one axis of all. False with notes in `errors` (id `bad-vary`). Memory comes
 * from `arena`. */
bool axes_read(struct axes *axes, struct arena *arena, const char *const *texts, size_t count, bool zip,
               uint64_t seed, fbd_errors *errors);

/* Append the value of a member in a run, in its own unit: the shortest decimal that reads back as it. Between
 * the ends of a grid it is rounded to 15 digits: 0.4, not 0.39999999999999997. */
void axes_value(const struct axes *axes, const struct member *member, uint64_t run, struct text *text);

#endif
