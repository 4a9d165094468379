/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ledger: the work of every force.
 *
 * The work of a conservative force is exactly the decrease of its potential energy. The work of any other
 * force is the integral of its power over the motion, by Gauss's rule with five points in each step, on the
 * step's dense output, and in parts of a step where the power varies faster than the motion; so its error is
 * below that of the motion itself. The residual
 *
 *     (KE + PE) - (KE + PE at the start) - work of the forces without a potential
 *
 * is zero for the true motion. The ledger reads the steps and does not influence the run.
 */
#ifndef FBD_RECORD_LEDGER_H
#define FBD_RECORD_LEDGER_H

#include "dynamics/diagram.h"
#include "loop/ensemble.h"

struct ledger {
    const struct fbd_model *model;
    bool *integrated; /* per load: its work is integrated */
    bool *counted;    /* per load: ... or its work in impacts alone (a force perpendicular to the motion) */
    bool any;         /* works were requested, and a load has some (ledger_has_works) */
    bool works;       /* works were requested */
    double *begin, *end; /* per load, integrated, up to the begin and end of its group's last step */
    double *work;        /* per load, integrated, up to the end of the run */
    double *struck;      /* per load: work of impacts up to then */
    /* At the first load of each group: its largest kinetic energy at the end of a step, and the integral of
     * the absolute powers of its loads. */
    double *lively, *through;
    double *initial_potential; /* per load */
    double initial_kinetic, initial_sum;
    double liveliest;     /* largest kinetic energy of a group at the end of a step */
    double turnover;      /* integral of the absolute powers of all integrated loads */
    bool unresolved;      /* works are NAN: a force oscillates thousands of times within a step */
    double *powers;       /* points of a panel times loads */
    struct arrow *arrows; /* the block of all arrays */
    double *scratch;      /* plan_size */
};

/* Start at a state. Without `works` nothing is integrated, and results that need integrals are NAN. False
 * when memory is out. */
bool ledger_init(struct ledger *ledger, const struct fbd_model *model, struct fbd_state *start, bool works);
void ledger_free(struct ledger *ledger);

/* Does a load have works that do not follow from its potential? As a spring breaks, its energy is lost. */
bool ledger_has_works(const struct ledger *ledger, size_t load);

/* Is any work in this group counted: of powers, or of impacts alone (a normal force of a wheel that lands)? */
bool ledger_counts(const struct ledger *ledger, const struct group *group);

/* Account for the last step of group `index`; restart its account. Required only if `any`. */
bool ledger_step(struct ledger *ledger, struct ensemble *ensemble, size_t index);
void ledger_restart(struct ledger *ledger, struct ensemble *ensemble, size_t index);

/* Update the largest kinetic energy of a group at the end of its last step, before ledger_step. */
void ledger_note(struct ledger *ledger, const struct group *group);

/* work[load_count]: the integrals up to a time in the last step of every group; up to the ensemble's time. */
bool ledger_within(struct ledger *ledger, struct ensemble *ensemble, double t, double *work);
bool ledger_at(struct ledger *ledger, struct ensemble *ensemble, double *work);

/* Work of load `index` at a state, given the integrals up to there. */
double ledger_work(struct ledger *ledger, const struct fbd_state *state, size_t index, const double *work);

/* The largest residual at a state that errors of `steps` steps at a tolerance explain: in each step four
 * tolerances of the size of the energy (largest kinetic energy plus the integral of the absolute powers of
 * forces without a potential), and the rounding of the terms of the residual. A motion whose steps have
 * skipped a short pulse has a far larger residual, because the power is sampled at other times than the
 * right-hand side. NAN where no works are integrated. */
double ledger_explained(struct ledger *ledger, struct fbd_state *state, double tolerance, double steps);

/* Energies at a state, given the integrals up to there. */
fbd_energy ledger_energy(struct ledger *ledger, const struct fbd_state *state, const double *work);

#endif
