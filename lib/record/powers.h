/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Integrals of the powers of loads over a part of a step.
 */
#ifndef FBD_RECORD_POWERS_H
#define FBD_RECORD_POWERS_H

#include "record/ledger.h"

/* Sample points of a panel; the sixth one is used only where expressions may vary. */
enum { gauss_points = 5, power_points };

struct sums {
    double *work;    /* per load: the integral of its power is added here */
    double lively;   /* largest kinetic energy of the group */
    double turnover; /* integral of the absolute powers of its loads; is added to */
    double lost;     /* total length of the panels in which a power was not resolved */
};

/* Add the integrals [J] over [from, to] of a group's last step. Their tolerance is that of the run, between
 * 1e-12 and 1e-7, relative to the size of its energies. Where more than a tenth of the time is not resolved
 * they are NAN and ledger->unresolved is set. Returns false if a state cannot be evaluated. */
bool powers_integrate(struct ledger *ledger, struct ensemble *ensemble, size_t group, struct time_dd from,
                      struct time_dd to, struct sums *sums);

#endif
