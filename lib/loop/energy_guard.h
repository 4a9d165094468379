/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Energy guard: the balance of energy of every run, whatever is shown of it, at the cost of a look at its events and one at
 * its end.
 *
 * Across events energy changes by the work of the impacts that have been logged, and by nothing else: that is looked
 * at in every run. Where all forces of a run have potentials the whole balance follows from its two ends,
 *
 *     (KE + PE) - (KE + PE at the start) - work of impacts = 0.
 *
 * Else what forces do between the events takes integrals along the motion: see record/ledger.h.
 */
#ifndef FBD_LOOP_ENERGY_GUARD_H
#define FBD_LOOP_ENERGY_GUARD_H

#include <stdbool.h>

struct ensemble;
struct run;

struct energy_guard {
    double t, *y;   /* where the run began */
    double jumps;   /* changes of kinetic energy at events beyond the work of impacts */
    double lowered; /* potential energy that has gone into the work of impacts: zeno_rest.c */
};

/* A residual of the energy, and the largest one that tolerance and rounding explain. */
struct energy_balance {
    double residual, explained;
};

/* The run stands at its start. */
void energy_guard_begin(struct run *run);

/* What impacts have added to the kinetic energy so far. */
double energy_of_impacts(const struct run *run);

/* The potential energy where the run stands, of the forces that have a potential. */
double energy_of_place(const struct run *run);

/* Events have been applied; impacts had done `before` until then. */
void energy_guard_events(struct run *run, double before);

/* Of the group with the largest ratio of residual to explained residual. */
struct energy_balance ensemble_energy_balance(struct ensemble *ensemble);

/* The largest residual that so many steps at a tolerance explain: four tolerances of the energy in motion in each, and the
 * rounding of the terms that it is the difference of. */
double energy_explained(double tolerance, double steps, double in_motion, double terms);

#endif
