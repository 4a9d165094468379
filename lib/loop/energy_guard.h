/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Energy guard: the energy balance of every run, whatever its output, at the cost of evaluations at its
 * events and its end.
 *
 * At events the energy changes by the logged work of the impacts only: that is checked in every run. Where
 * all forces of a run have potentials the whole balance follows from its two ends,
 *
 *     (KE + PE) - (KE + PE at the start) - work of impacts = 0.
 *
 * Otherwise the work of forces between the events requires integrals along the motion: see record/ledger.h.
 */
#ifndef FBD_LOOP_ENERGY_GUARD_H
#define FBD_LOOP_ENERGY_GUARD_H

#include <stdbool.h>

struct ensemble;
struct fbd_model;
struct run;

struct energy_guard {
    double t, *y;   /* start of the run */
    double jumps;   /* changes of kinetic energy at events beyond the work of impacts */
    double lowered; /* potential energy included in the work of impacts: zeno_rest.c */
};

/* A residual of the energy, and the largest one that tolerance and rounding can cause. */
struct energy_balance {
    double residual, explained;
};

/* Called at the start of the run. */
void energy_guard_begin(struct run *run);

/* The kinetic energy gained in impacts so far. */
double energy_of_impacts(const struct run *run);

/* The potential energy at run->state, of the forces that have a potential. */
double energy_of_place(const struct run *run);

/* Do the works of all loads follow from potentials that are there all the time? */
bool energy_has_potentials(const struct fbd_model *model);

/* Called after events; `before` is the work of impacts before them. */
void energy_guard_events(struct run *run, double before);

/* Of a run; and of the island with the largest ratio of residual to its bound. */
struct energy_balance run_energy_balance(struct run *run);
struct energy_balance ensemble_energy_balance(struct ensemble *ensemble);

/* The largest residual that is consistent with so many steps at a tolerance: four tolerances of the kinetic
 * energy in each, and the rounding of the terms of the difference. */
double energy_explained(double tolerance, double steps, double in_motion, double terms);

#endif
