/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Cost: error against time for every method on one scene.
 *
 * Three stages: a reference (reference.h); the ladders, one run of each method at each of its settings, for
 * the error and the counts, always that run next which will take least; the times, by repeats in turn
 * (timing.h). Each stage has its share of the budget. A run that would not fit is skipped and said to be.
 */
#ifndef FBD_STUDY_COST_H
#define FBD_STUDY_COST_H

#include "base/text.h"
#include "study/reference.h"
#include "study/timing.h"

struct fbd_cost {
    struct arena arena;
    const fbd_model *model;
    fbd_model *stepless; /* the model without a step of its own, where the file gives one; or NULL */
    struct certified_reference reference;
    double until, budget;
    bool *chosen; /* of the quantities; NULL for all */
    fbd_point *points;
    struct setting *settings; /* of the points */
    size_t point_count;
    fbd_series *series;
    size_t series_count;
    const char *says; /* of the reference */
    struct progress progress;
    fbd_errors *errors; /* of the caller, while the study runs */
};

/* Shares of the budget. */
#define REFERENCE_SHARE 0.2
#define LADDER_SHARE    0.35

/* Lay out series and points (ladder.c). */
bool ladder_plan(struct fbd_cost *cost, const fbd_cost_options *options);

/* Make the runs. */
bool ladder_climb(struct fbd_cost *cost);

/* Fronts and orders, when all is measured (analyse.c). */
void cost_analyse(struct fbd_cost *cost);

/* fbd_cost_cheapest; NULL for none. */
const fbd_point *cost_cheapest(const struct fbd_cost *cost, double error);

/* What stands for a point that is not there: fbd_cost_point past the end. */
extern const fbd_point no_point;

/* The model whose runs are measured. */
const fbd_model *cost_model(const struct fbd_cost *cost);

/* What the reference is, in sentences; NULL when memory is out (reference_text.c). */
const char *reference_says(struct arena *arena, const struct certified_reference *reference,
                           const fbd_model *model);

/* The name of a quantity, and its unit. */
const char *quantity_name_of(const fbd_model *model, size_t quantity);
const char *quantity_unit_of(const fbd_model *model, size_t quantity);

/* Marks of the quantities that are named; *chosen is NULL for all. False with a note (`unknown-quantity`). */
bool quantities_choose(const fbd_model *model, const fbd_cost_options *options, struct arena *arena,
                       bool **chosen, fbd_errors *errors);

/* Is there a model, and a name for each method and quantity? *own becomes what is asked for. */
bool study_is_asked(const fbd_model *model, const fbd_cost_options *options, fbd_cost_options *own,
                    fbd_errors *errors);

/* The end of a run: that of the options, else the file's. False with notes when there is none (those of
 * fbd_simulation_new), or when it is the start. */
bool study_until(const fbd_model *model, const fbd_cost_options *options, double *until, fbd_errors *errors);

/* "1.23 ms" (cost_text.c). */
void text_seconds(struct text *text, double seconds);

#endif
