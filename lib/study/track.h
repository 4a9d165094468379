/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Track: one run sampled at the times of a grid, with its events and its counts.
 *
 * A quantity is a coordinate, a rate or a user state: quantity i < n is coordinate i, quantity n + i its
 * rate, quantity 2 n + i state i.
 */
#ifndef FBD_STUDY_TRACK_H
#define FBD_STUDY_TRACK_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "fbd.h"

/* Settings of a run: a tolerance, or steps of fixed size. */
struct setting {
    const char *method;
    double tolerance; /* 0 with a fixed step */
    double step;      /* 0 without */
    bool automatic;   /* automatic steps even where the file gives a size */
};

/* The options of a run with this setting. */
fbd_options setting_options(const struct setting *setting, double until);

/* The number of quantities of a model. */
size_t quantity_count(const fbd_model *model);

struct grid {
    double until;
    size_t count; /* times: k until / (count - 1) */
};

double grid_time(const struct grid *grid, size_t index);

struct track_event {
    double t;
    fbd_event_kind kind;
    const char *body, *name; /* of the model */
};

struct track {
    size_t size;    /* quantities */
    size_t reached; /* times of the grid that the run has reached */
    double *y;      /* grid.count x size: the quantities at each time */
    double *end;    /* size: at the end of the run */
    double t_end;
    struct track_event *events;
    size_t event_count;
    fbd_outcome outcome; /* FBD_GOING: abandoned for its time */
    const char *reason;  /* "" without an error */
    fbd_stats stats;
    double seconds; /* sampling included */
};

/* Make and sample a run; it is abandoned after `most_seconds`. Memory is taken from `arena`. Returns false
 * with a note in `errors` when the run cannot start, or memory is out. */
bool track_make(struct track *track, const fbd_model *model, const struct setting *setting,
                const struct grid *grid, double most_seconds, struct arena *arena, fbd_errors *errors);

/* True when the run reached its end time or was stopped by an event. */
bool track_ended(const struct track *track);

/* The largest |a - b| / scale over all quantities with a scale above 0, at times first <= k < count of the
 * grid. *worst (may be NULL) is the quantity. NAN when that is not a number. */
double tracks_differ(const struct track *a, const struct track *b, const double *scale, size_t first,
                     size_t count, size_t *worst);

#endif
