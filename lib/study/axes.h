/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Axes: the values that a sweep gives to the parameters of a model, and their assignment to runs.
 *
 *     NAME=VALUES[; NAME=VALUES ...]
 *
 *     0.1:0.6:51            51 values from 0.1 to 0.6, evenly spaced
 *     1:1000:4:log          4 values from 1 to 1000, with a constant ratio
 *     1,2,5 m/s             a list
 *     dry.csv,wet.csv       files of a table
 *     uniform(1,2) kg:100   100 random draws; also normal(mean,deviation) and loguniform(low,high)
 *
 * One text is one axis; its members vary in parallel, so they have equally many values. The axes are
 * combined: each value with each, the last axis varying fastest. A unit belongs to all values of its member,
 * wherever it is written; a value without one is a bare number of the file.
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
    uint64_t key;     /* of its draws: hash of the name, so that draws do not depend on the other members */
    enum { values_listed, values_words, values_even, values_log, values_drawn } kind;
    enum distribution distribution;
    double a, b; /* ends of a grid, or parameters of the distribution */
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

/* The largest number of runs of a sweep: run numbers are exact as doubles in any program that reads the
 * table. */
static const uint64_t most_runs = UINT64_C(1) << 53;

/* Read the texts; `zip` makes one axis of all. Returns false with notes in `errors` (id `bad-vary`). Memory
 * comes from `arena`. */
bool axes_read(struct axes *axes, struct arena *arena, const char *const *texts, size_t count, bool zip,
               uint64_t seed, fbd_errors *errors);

/* Append the value of a member in a run, in its own unit: the shortest decimal that reads back as that value.
 * Inner values of a grid are rounded to 15 digits: 0.4, not 0.39999999999999997. */
void axes_value(const struct axes *axes, const struct member *member, uint64_t run, struct text *text);

#endif
