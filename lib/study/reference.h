/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reference: the true motion as far as it can be known, and how far that is.
 *
 * Several methods run at tight tolerances. Of all pairs of runs by different methods the two that agree best
 * are taken: one of them is the reference, and what they differ by, the largest |difference| / scale over all
 * quantities and times of the grid, is its floor. An error below the floor cannot be told from that of the
 * reference. What all methods share (force laws, the location of events) is not certified by this.
 *
 * Where the file gives the solution of a quantity (`exact:`), that stands in place of the computed one, and
 * the floor of such a quantity is the rounding of the expression. It is first held against the computed one:
 * a solution that is none is refused, not measured against.
 *
 * The scale of a quantity is the largest magnitude that it has on the grid, but at least 1e-6 of the largest
 * scale of all quantities of the same dimension: what hardly moves beside the others is measured against
 * these. Quantities that are zero throughout have the scale 0 and are left out.
 *
 * A motion that magnifies differences has a high floor however tight the tolerance. `known` then is the time
 * up to which the floor is below 1e-6, and `tenfold` the time in which the difference of the two runs grows
 * tenfold, by least squares on its logarithm.
 */
#ifndef FBD_STUDY_REFERENCE_H
#define FBD_STUDY_REFERENCE_H

#include "study/track.h"

struct certified_reference {
    struct grid grid; /* ends where the reference is known */
    struct track track;
    struct setting settings[2]; /* of the pair */
    double *scale;              /* of each quantity */
    bool *exact;                /* the quantity comes from the file */
    bool any_exact, all_exact;  /* of the quantities with a scale */
    double floor;
    double floor_end; /* at the end of the grid alone */

    double whole_floor; /* over the whole run; above `floor` when the grid was cut */
    double known;       /* up to when the whole run is known */
    bool cut;           /* it is not known to its end */
    double tenfold;     /* time in which differences grow tenfold; NAN when they do not grow like that */
    double loose_floor; /* the whole floor that looser tolerances give */

    bool exact_differs;             /* the file's solution is not that of the scene ... */
    size_t exact_worst;             /* ... in this quantity, ... */
    double exact_error, exact_from; /* ... by so much (scaled), first seen at this time */
};

/* Make the reference of a run until `until`. `chosen` marks the quantities that count (NULL: all). It takes
 * at most about `seconds`. False with notes in `errors`: `no-reference` when fewer than two methods get to
 * the end of the run, and those of fbd_simulation_new. */
bool reference_make(struct certified_reference *reference, const fbd_model *model, double until,
                    const bool *chosen, double seconds, struct arena *arena, fbd_errors *errors);

/* The scale of each quantity, as above. */
void reference_scales(double *scale, const struct track *track, const bool *chosen, const fbd_model *model);

/* Errors of a run against the reference; NAN where there is none. */
struct errors_of_a_run {
    double max, end; /* scaled, over the grid and at its last time */
    size_t worst;    /* the quantity of `max` */
    double event;    /* largest error of the time of an event; NAN when the events are others, or none */
    bool same_events;
};

struct errors_of_a_run reference_errors(const struct certified_reference *reference,
                                        const struct track *track);

#endif
