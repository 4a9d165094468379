/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Error ratios: estimated errors of a run over its true errors, for the validation of error bars.
 *
 * What is true is a certified reference: two runs at a tolerance of 1e-14 by two methods (dop853 and rk8pd)
 * with other formulas, other steps and so other roundings; how far they are apart is how well the truth is
 * known. A true error below four times that is not determined: then the estimate counts as right when it says
 * no more than ten times what the truth can be. The same below some roundings of the size of the quantity.
 */
#ifndef FBD_TESTS_ERROR_RATIO_H
#define FBD_TESTS_ERROR_RATIO_H

#include "exact_motions.h"
#include "fbd.h"

enum ratio_kind {
    ratio_global,  /* fbd_stats.error_estimate */
    ratio_largest, /* a coordinate, rate or state: largest error over the run */
    ratio_end,     /* a coordinate, rate or state at one time late in the run */
    ratio_event,   /* the event whose time is worst */
    ratio_force,   /* a component of a force at the end, a moment */
    ratio_energy,  /* energies and works at the end */
    ratio_kinds
};

extern const char *const ratio_names[ratio_kinds];

struct ratio_counts {
    unsigned long low, good, high; /* determined: ratio below 0.3, in [0.3, 10], above 10 */
    unsigned long floor, over;     /* not determined: right, and too large */
};

struct ratio_table {
    struct ratio_counts counts[ratio_kinds];
    bool verbose; /* print what is not good */
};

/* Share of the estimates that are good, of all and of those that are determined; NAN for none. */
double ratio_share(const struct ratio_counts *counts);
unsigned long ratio_determined(const struct ratio_counts *counts);
double ratio_determined_share(const struct ratio_counts *counts);

struct truth;

/* The reference for a model; NULL when the scene does not come to an end or takes too many evaluations.
 * `exact`, if any, gives the coordinates and rates at t in closed form and is used instead of the mean of the
 * two runs. */
struct truth *truth_new(const fbd_model *model, exact_motion *exact);
void truth_free(struct truth *truth);

/* How far the two runs are apart, in units of the global error. */
double truth_floor(const struct truth *truth);

/* Run with a method and a tolerance (or a fixed step, `tolerance` 0) and count its ratios. False when the
 * method does not come to the end, or takes too many evaluations. */
bool ratio_add(struct ratio_table *table, const struct truth *truth, const char *method, double tolerance,
               double step);

#endif
