/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parts of a calculation note: each appends its sections to the document. A part that finds memory out sets
 * `document.arena.failed`.
 */
#ifndef FBD_NOTE_NOTE_H
#define FBD_NOTE_NOTE_H

#include "base/engineering.h"
#include "fbd_study.h"
#include "fbd_view.h"
#include "note/document.h"

enum { note_digits = 6, force_digits = 5, error_digits = 2 };

/* A scene of more bodies has its first ones drawn and no list of all equations. */
enum { most_drawn_bodies = 12 };

struct fbd_note {
    struct document document;
    size_t checks, failed_checks;
};

/* The note in the making. */
struct making {
    struct fbd_note *note;
    struct document *document; /* of the note */
    const fbd_note_options *options;
    const fbd_model *model;
    fbd_simulation *simulation;
    fbd_result *result;
    fbd_state *start, *end; /* `end` belongs to the result */
    fbd_view *view;         /* of the start */
    fbd_statics *statics;   /* of the start, if it is in equilibrium; else NULL */
    fbd_stats stats;
    fbd_table table; /* rows of the run */
    double t;        /* of the end */
    double *errors;  /* of the final state, as fbd_simulation_errors; NULL without error bars */
    fbd_errors *list;
    bool refused;     /* there is no note; the list has the reason */
    struct text text; /* scratch of the functions below */
};

/* A text made of pieces, copied into the document: begin, add to making->text, take. */
struct text *making_begin(struct making *making);
const char *making_take(struct making *making);

/* Free a list of errors of a call whose failure is no error of the note, except for lack of memory. */
void making_end_list(struct making *making, fbd_errors *others);

/* The forces on a body at a state: their number, and an array of the arena, NULL for none. */
size_t making_arrows(struct making *making, fbd_state *state, size_t body, fbd_arrow **arrows);

/* A value with its unit, a bare number, and an error, as texts of the document. */
const char *making_value(struct making *making, double value, const char *unit, int digits);
const char *making_number(struct making *making, double value, int digits);
const char *making_symbol(struct making *making, const char *name);

void note_identity(struct making *making);
void note_system(struct making *making);
void note_assumptions(struct making *making);
void note_data(struct making *making);
void note_diagrams(struct making *making);
void note_equations(struct making *making);
void note_statics(struct making *making);
void note_results(struct making *making);
void note_plots(struct making *making);
void note_checks(struct making *making);
void note_limits(struct making *making);
void note_file(struct making *making);

/* A plot of columns of the table over the time, as SVG; NULL when memory is out. `columns`: their indices, at most six. */
char *plot_svg(const struct making *making, const size_t *columns, size_t count, const char *title);

/* The difference of the run from one by another method at a tighter tolerance. */
struct second_run {
    const char *method; /* of the second run */
    double tolerance;
    double
        difference; /* of the final states, divided by the size of the motion; NAN if it has no such state */
    const char *worst;       /* the coordinate or rate of that difference */
    bool same_events;        /* of the same kinds in the same order */
    double event_difference; /* largest one of their times [s]; NAN if the events differ, or there are none */
    const char *reason;      /* why it was not completed; NULL if it was */
};

/* False when memory is out or the caller ended it. */
bool second_run(struct making *making, struct second_run *second);

#endif
