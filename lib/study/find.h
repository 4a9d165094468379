/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Find: the values of a parameter at which an outcome changes or an equation holds.
 *
 *     question     PARAMETER [= FROM..TO [UNIT]] [: CONDITION]             (find_question.c)
 *     trial        the model with one value of the parameter: a row of a sweep (batch/rows.h), or its
 *                  statics                                                (find_trial.c)
 *     scan         trials at equal distances; between two neighbours that differ there is a solution
 *     solution     bisection for outcomes, Brent's method (GSL) for equations; its error from trials with a
 *                  smaller tolerance                                      (find_solve.c)
 *     pair         two roots between neighbours, from a minimum of |f|    (find_pair.c)
 */
#ifndef FBD_STUDY_FIND_H
#define FBD_STUDY_FIND_H

#include "batch/row_formula.h"
#include "batch/rows.h"
#include "fbd_find.h"
#include "fbd_study.h"

enum find_kind {
    find_happenings, /* the list of happenings changes */
    find_event,      /* one outcome happens, or not */
    find_equation,
    find_equilibrium,
    find_limit, /* of statics */
};

/* The model with one value of the parameter. */
struct trial {
    double p;
    bool known, failed;  /* it has a result; it has none because the run failed */
    const char *outcome; /* outcomes: equal texts are equal outcomes */
    double f;            /* equations: left side minus right side; limits: the margin */
    const char *story;   /* the happenings, for the reader */
    const char *broken;  /* statics: the first limit that is exceeded, or NULL */
    bool determinate;    /* statics: equilibrium determines all reactions */
    const char *status, *reason;
};

/* Rows of the question at one tolerance; value `i` of the parameter is that of run i. */
struct find_rows {
    struct rows *rows;
    struct row_maker *maker;
    fbd_options options;
};

struct fbd_find {
    struct arena arena;
    const char *source, *name; /* of the model file */
    size_t source_length;
    const fbd_find_plan *plan; /* of the caller, during the search */
    fbd_errors *errors;

    const char *parameter, *unit, *condition; /* unit: as given, or ""; condition: "" for none */
    const char *shown_unit;                   /* as given, or that of the parameter */
    double from, to;                          /* NAN: the range of the file */
    enum find_kind kind;
    const char *event; /* of find_event: as `block.slips` */
    const char *limit; /* of the margin of a trial */
    bool limit_seen;   /* some trial has it */
    struct row_formula *formula;

    struct find_rows normal, tight;
    struct row_look look;
    double value; /* of the parameter, of the run that is made */

    fbd_solution *solutions;
    size_t solution_count, solution_room;
    fbd_find_gap *gaps;
    size_t gap_count, gap_room;
    const char *throughout; /* the story of the first trial, "" without one */
    const char *
        alone[2]; /* the story at an end of the range, where all other values have another outcome; or NULL */
    double least, most; /* of the trials of the scan: left side minus right side, or the margin */
    double slope;       /* of the first two */
    bool linear;        /* those of all of them are linear in the parameter */
    size_t scan, runs, failed;
    bool stopped;
};

/* Read the question, and complete it from the file. Return false with notes in find->errors. */
bool find_read_question(struct fbd_find *find, const char *question);
bool find_complete_question(struct fbd_find *find);

/* Prepare the trials, try the ends of the range. Returns false with notes. */
bool find_prepare_trials(struct fbd_find *find);
void find_free_trials(struct fbd_find *find);

/* Make a trial; `tight` with a hundredth of the tolerance. Returns false when memory is out or the search is
 * stopped. */
bool find_try(struct fbd_find *find, double p, bool tight, struct trial *trial);

/* True if there is a solution between two known trials. */
bool find_differs(const struct fbd_find *find, const struct trial *a, const struct trial *b);

/* Has a trial a difference or margin f? */
static inline bool find_is_equation(const struct fbd_find *find)
{
    return find->kind == find_equation || find->kind == find_limit;
}

/* Are its trials rows of a sweep? */
static inline bool find_runs(const struct fbd_find *find)
{
    return !find->plan->statics || find->kind == find_equation;
}

/* Find the solutions between two trials of the scan. Returns false as find_try. */
bool find_solve(struct fbd_find *find, const struct trial *a, const struct trial *b);

/* Find two roots of an equation between a trial b and its neighbours a < b < c, if |f| is least at b; and between an
 * end of the range and its neighbour. Returns false as find_try (find_pair.c). */
bool find_solve_pair(struct fbd_find *find, const struct trial *a, const struct trial *b,
                     const struct trial *c);
bool find_solve_end(struct fbd_find *find, const struct trial *end, const struct trial *inner);

/* Add a trial as a solution of an equation; false when memory is out. */
bool find_add_root(struct fbd_find *find, const struct trial *trial, double error);

/* Add a trial of the scan at which an equation holds exactly; of several neighbours the ends of their interval. A
 * neighbour is NULL at the end of the range. Returns false as find_try (find_pair.c). */
bool find_take_zero(struct fbd_find *find, const struct trial *before, const struct trial *trial,
                    const struct trial *after);

/* The width of the last bracket, and the error of a root at p between a and b, which is at least that. */
double find_finest(const struct fbd_find *find);
bool find_root_error(struct fbd_find *find, double p, double width, const struct trial *a,
                     const struct trial *b, double *error);

/* Add a trial without a value to the list; false when memory is out. */
bool find_add_gap(struct fbd_find *find, const struct trial *trial);

#endif
