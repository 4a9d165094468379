/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ledger: what every force has done.
 *
 * The work of a conservative force is what its potential energy has lost, exactly. The work of any other is
 * the integral of its power over the motion, by Gauss's rule with five points in each step, on the step's
 * dense output, and in parts of a step where a power has more in it than the motion: so its error is below that of
 * the motion itself. The residual
 *
 *     (KE + PE) - (KE + PE at the start) - work of the forces without a potential
 *
 * is zero for the true motion. The ledger looks at the steps and acts on nothing.
 */
#ifndef FBD_RECORD_LEDGER_H
#define FBD_RECORD_LEDGER_H

#include "dynamics/diagram.h"
#include "loop/ensemble.h"

struct ledger {
    const struct fbd_model *model;
    bool *integrated;    /* per load: its work is integrated */
    bool *counted;       /* per load: ... or it is that of impacts alone, of a force across the motion */
    bool any;            /* a work is counted, of powers or of impacts, and it was asked for */
    bool works;          /* it was asked for */
    double *begin, *end; /* per load, integrated, up to the begin and end of its group's last step */
    double *work;        /* per load, integrated, up to the end of the run */
    double *struck;      /* per load: what impacts have taken by then */
    /* Per load, of the first one of a group: its most kinetic energy at the end of a step, and the integral of the size of
     * all its powers. */
    double *lively, *through;
    double *initial_potential; /* per load */
    double initial_kinetic, initial_sum;
    double liveliest; /* the most kinetic energy of a group at the end of a step */
    double turnover;  /* integral of the size of all powers that are integrated */
    bool
        unresolved; /* works are NAN: a force swings thousands of times within a step that knows nothing of it */
    double *powers; /* points of a panel times loads */
    struct arrow *arrows;
    double *scratch; /* 2 n */
};

/* Start at a state. Without `works` nothing is integrated, and what would need it is NAN. False when memory
 * is out. */
bool ledger_init(struct ledger *ledger, const struct fbd_model *model, struct fbd_state *start, bool works);
void ledger_free(struct ledger *ledger);

/* Is any work in this group integrated? A look into a step costs what dense output costs. */
bool ledger_integrates(const struct ledger *ledger, const struct group *group);

/* Is any work in this group counted: of powers, or of impacts alone (a normal force of a wheel that lands)? */
bool ledger_counts(const struct ledger *ledger, const struct group *group);

/* Account for the last step of group `index`; begin with it again. Of use if `any` only. */
bool ledger_step(struct ledger *ledger, struct ensemble *ensemble, size_t index);
void ledger_restart(struct ledger *ledger, struct ensemble *ensemble, size_t index);

/* Note how lively a group is at the end of its last step, before ledger_step. */
void ledger_note(struct ledger *ledger, const struct group *group);

/* work[load_count]: the integrals up to a time in the last step of every group; up to the ensemble's time. */
bool ledger_within(struct ledger *ledger, struct ensemble *ensemble, double t, double *work);
bool ledger_at(struct ledger *ledger, struct ensemble *ensemble, double *work);

/* Work of load `index` at a state, given the integrals up to there. */
double ledger_work(struct ledger *ledger, const struct fbd_state *state, size_t index, const double *work);

/* The largest residual at a state that `steps` steps at a tolerance explain: four tolerances of the size of the energy
 * in each - the most that was in motion and what went through by forces without a potential - and the rounding of what
 * it is the difference of. A motion whose steps have gone over a short pulse is far beyond it: its work is looked at in
 * other places than the steps are. NAN where no works are integrated. */
double ledger_explained(struct ledger *ledger, struct fbd_state *state, double tolerance, double steps);

/* Energies at a state, given the integrals up to there. */
fbd_energy ledger_energy(struct ledger *ledger, const struct fbd_state *state, const double *work);

#endif
