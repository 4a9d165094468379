/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ledger: what every force has done.
 *
 * The work of a conservative force is what its potential energy has lost, exactly. The work of any other is
 * the integral of its power over the motion, by Gauss's rule with five points in each step, on the step's
 * dense output: its error is below that of the motion itself. The residual
 *
 *     (KE + PE) - (KE + PE at the start) - work of the forces without a potential
 *
 * is zero for the true motion. The ledger looks at the steps and acts on nothing.
 */
#ifndef FBD_OUTPUT_LEDGER_H
#define FBD_OUTPUT_LEDGER_H

#include "dynamics/diagram.h"
#include "solve/run.h"

struct ledger {
    const struct fbd_model *model;
    bool *integrated;          /* per load: its work is integrated */
    bool any;                  /* one of them is, and it was asked for */
    double *work;              /* per load, integrated, up to the end of the last step */
    double *initial_potential; /* per load */
    double initial_kinetic, initial_sum;
    struct fbd_state *probe; /* for looking into a step */
    struct arrow *arrows;
    double *scratch; /* 2 n */
};

/* Start at a state. Without `works` nothing is integrated, and what would need it is NAN. False when memory
 * is out. */
bool ledger_init(struct ledger *ledger, const struct fbd_model *model, struct fbd_state *start, bool works);
void ledger_free(struct ledger *ledger);

/* Add the integral of power over [from, to] of the run's last step to work[load_count]. */
bool ledger_integrate(struct ledger *ledger, struct run *run, double from, double to, double *work);

/* Account for the whole of the last step. */
bool ledger_step(struct ledger *ledger, struct run *run);

/* Work of load `index` at a state, given the integrals up to there. */
double ledger_work(struct ledger *ledger, const struct fbd_state *state, size_t index, const double *work);

/* Energies at a state, given the integrals up to there. */
fbd_energy ledger_energy(struct ledger *ledger, const struct fbd_state *state, const double *work);

#endif
