/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Record: a run as a table of numbers for the page and for plots, with bounded memory.
 *
 * Rows are taken at regular times (which include all times of the CSV), at the ends of steps, and twice at
 * each event: before and after. When there are too many, every second one is dropped, except events and ends.
 * The envelope keeps their range: minimum and maximum of each column in each of about a thousand pieces of
 * the run, sampled at the rows and at turning points of coordinates and rates. The motion is smooth between
 * rows, so cubic interpolation is sufficient.
 *
 * A run without a record has no such cost.
 */
#ifndef FBD_OUTPUT_RUN_RECORD_H
#define FBD_OUTPUT_RUN_RECORD_H

#include "record/result.h"

enum record_kind {
    record_coordinate,
    record_rate,
    record_acceleration,
    record_pose,  /* of a body's frame: x, y, angle */
    record_force, /* as in the CSV */
    record_term,  /* of an equation */
    record_arrow, /* fx, fy; point in the body frame; couple */
    record_work,
    record_energy, /* kinetic, potential, work, residual */
    record_own,    /* user states */
};

struct record_column {
    const char *name, *unit;
    enum record_kind kind;
    int body; /* or -1 */
    bool is_constant;
    double least, greatest;
};

/* Indices of the columns of an arrow. */
struct record_of_arrow {
    const char *name;
    int load;               /* -1 for a reaction */
    int arrow;              /* five columns: fx, fy, point in the body frame, couple */
    int force, force_count; /* as in the CSV */
    int components;         /* after or among these: x, y and the moment about G */
    int term;               /* in the equations of the coordinates, or -1 */
    int work;               /* -1: counted with the body that lists it */
};

struct record_of_body {
    int coordinate, rate, acceleration; /* first column of each */
    int pose;                           /* three columns, then two: the velocity of G */
    int equation;                       /* the accelerations in the equations of its coordinates */
    int newton;                         /* three columns: of G, and the angular acceleration */
    int moving_axis;                    /* the inertial terms of tree_has_more; else -1 */
    int mass;                           /* if variable; else -1 */
    size_t arrow_count;
    struct record_of_arrow *arrows;
};

struct record {
    const struct fbd_model *model;
    struct arena arena;
    struct record_column *columns;
    size_t column_count;
    struct record_of_body *bodies;
    int energy; /* first of four columns */

    double *times, *rows; /* row by row, column_count each */
    bool *kept;           /* rows that are never thinned: start, end, events */
    size_t count, room, kept_count;
    unsigned long seen;   /* rows taken so far */
    unsigned long stride; /* of these, each stride-th is stored */

    double bucket; /* width of a piece of the envelope [s] */
    size_t bucket_count;
    float *envelope; /* pieces x columns x (minimum, maximum) */

    bool components; /* show those of forces */
    double every;    /* interval of the regular rows */
    long next;       /* index of the next regular row */
    struct ledger *ledger;
    struct fbd_state *probe;
    struct arrow *arrows;
    double *work;    /* integrals up to the row */
    double *values;  /* of one row */
    double *turning; /* rates and accelerations at the start of the step */
    bool costly;     /* a potential energy is a quadrature: evaluated only for stored rows */
    bool failed;     /* memory ran out */
    const char *odd; /* the first column with a number that is not finite, and its time; or NULL */
    double odd_time;
};

/* Initialize for a run and take the row of its start. Returns false when memory is out. */
bool record_begin(struct record *record, struct ensemble *run, struct ledger *ledger,
                  const fbd_recording *recording);

/* Take the rows of (from, run->t], an interval within the last step of every island: see ensemble_next_end.
 * `event`: an event occurred at run->t. */
bool record_step(struct record *record, struct ensemble *run, double from, bool event);

/* Drop rows and join pieces of the envelope down to these numbers. */
void record_thin(struct record *record, size_t rows, size_t buckets);

/* True if any row was dropped. */
bool record_is_thinned(const struct record *record);

void record_free(struct record *record);

/* For run_record.c: define the columns for a state; and fill `values` from a state, with the work integrals of
 * record->work; without `energies` those columns are NAN. */
bool record_define(struct record *record, struct fbd_state *start);
void record_fill(struct record *record, struct fbd_state *state, bool energies);

#endif
