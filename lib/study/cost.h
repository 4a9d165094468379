/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Cost: error against time for every method on one scene.
 *
 * Three stages: a reference (reference.h); the ladders, one run of each method at each of its settings, for
 * the error and the counts, always the run with the least expected time first; the times, by interleaved
 * repeats (timing.h). Each stage has its share of the budget. A run that exceeds it is skipped and marked so.
 */
#ifndef FBD_STUDY_COST_H
#define FBD_STUDY_COST_H

#include "base/text.h"
#include "fbd_study.h"
#include "study/reference.h"
#include "study/timing.h"

struct fbd_cost {
    struct arena arena;
    const fbd_model *model;
    struct certified_reference reference;
    double until, budget;
    bool *chosen; /* selected quantities; NULL for all */
    fbd_point *points;
    struct setting *settings; /* of the points */
    size_t point_count;
    fbd_series *series;
    size_t series_count;
    const char *says; /* description of the reference */
    struct progress progress;
    fbd_errors *errors; /* of the caller, during the study */
};

/* Shares of the budget. */
#define REFERENCE_SHARE 0.2
#define LADDER_SHARE    0.35

/* Allocate series and points (ladder.c). */
bool ladder_plan(struct fbd_cost *cost, const fbd_cost_options *options);

/* Make the runs. */
bool ladder_climb(struct fbd_cost *cost);

/* Determine fronts and orders, after all measurements (analyse.c). */
void cost_analyse(struct fbd_cost *cost);

/* fbd_cost_cheapest; NULL for none. */
const fbd_point *cost_cheapest(const struct fbd_cost *cost, double error);

/* The value of fbd_cost_point past the end. */
extern const fbd_point no_point;

/* A description of the reference, in sentences; NULL when memory is out (reference_text.c). */
const char *reference_says(struct arena *arena, const struct certified_reference *reference,
                           const fbd_model *model);

/* The name of a quantity, and its unit. */
const char *quantity_name_of(const fbd_model *model, size_t quantity);
const char *quantity_unit_of(const fbd_model *model, size_t quantity);

/* Mark the named quantities; *chosen is NULL for all. Returns false with a note (`unknown-quantity`). */
bool quantities_choose(const fbd_model *model, const fbd_cost_options *options, struct arena *arena,
                       bool **chosen, fbd_errors *errors);

/* Check the arguments: a model, a name for each method and quantity. *own receives the options. */
bool study_is_asked(const fbd_model *model, const fbd_cost_options *options, fbd_cost_options *own,
                    fbd_errors *errors);

/* The end time of a run: that of the options, else the file's. Returns false with notes when there is none
 * (those of fbd_simulation_new), or when it is the start. */
bool study_until(const fbd_model *model, const fbd_cost_options *options, double *until, fbd_errors *errors);

/* "1.23 ms" (cost_text.c). */
void text_seconds(struct text *text, double seconds);

#endif
