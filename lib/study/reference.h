/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reference: the true motion as accurately as possible, with an estimate of its error.
 *
 * Several methods run at tight tolerances. Of all pairs of runs by different methods the two that agree best
 * are taken: one of them is the reference, and their difference, the largest |difference| / scale over all
 * quantities and times of the grid, is its floor. Errors below the floor are indistinguishable from that of
 * the reference. Parts common to all methods (force laws, the location of events) are not certified by this.
 *
 * Where the file gives the solution of a quantity (`exact:`), that replaces the computed one, and the floor
 * of such a quantity is the rounding of the expression. It is first compared with the computed one: a wrong
 * solution is refused.
 *
 * The scale of a quantity is its largest magnitude on the grid, but at least 1e-6 of the largest scale of all
 * quantities of the same dimension, so that quantities that hardly vary are measured relative to the others.
 * Quantities that are zero throughout have the scale 0 and are left out.
 *
 * A motion that magnifies differences has a high floor at any tolerance. `known` then is the time up to which
 * the floor is below 1e-6, and `tenfold` the time in which the difference of the two runs grows tenfold, by
 * least squares on its logarithm.
 */
#ifndef FBD_STUDY_REFERENCE_H
#define FBD_STUDY_REFERENCE_H

#include "study/track.h"

struct certified_reference {
    struct grid grid; /* ends at the time `known` */
    struct track track;
    struct setting settings[2]; /* of the pair */
    double *scale;              /* of each quantity */
    bool *exact;                /* the quantity comes from the file */
    bool any_exact, all_exact;  /* of the quantities with a scale */
    double floor;
    double floor_end; /* at the end of the grid only */

    double whole_floor; /* over the whole run; above `floor` when the grid was cut */
    double known;       /* time up to which the reference is accurate */
    bool cut;           /* it is not accurate up to the end */
    double tenfold;     /* time in which differences grow tenfold; NAN without such growth */
    double loose_floor; /* the whole floor for looser tolerances */

    bool exact_differs;             /* the file's solution is not that of the scene ... */
    size_t exact_worst;             /* ... in this quantity, ... */
    double exact_error, exact_from; /* ... by this amount (scaled), first at this time */
};

/* Make the reference of a run until `until`. `chosen` marks the selected quantities (NULL: all). It takes at
 * most about `seconds`. Returns false with notes in `errors`: `no-reference` when fewer than two methods
 * reach the end of the run, and those of fbd_simulation_new. */
bool reference_make(struct certified_reference *reference, const fbd_model *model, double until,
                    const bool *chosen, double seconds, struct arena *arena, fbd_errors *errors);

/* The scale of each quantity, as above. */
void reference_scales(double *scale, const struct track *track, const bool *chosen, const fbd_model *model);

/* Errors of a run against the reference; NAN where there is none. */
struct errors_of_a_run {
    double max, end; /* scaled, over the grid and at its last time */
    size_t worst;    /* the quantity of `max` */
    double event;    /* largest error of an event time; NAN when the events differ, or there are none */
    bool same_events;
};

struct errors_of_a_run reference_errors(const struct certified_reference *reference,
                                        const struct track *track);

#endif
