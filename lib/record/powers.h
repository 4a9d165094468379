/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Integrals of the powers of loads over a part of a step.
 */
#ifndef FBD_RECORD_POWERS_H
#define FBD_RECORD_POWERS_H

#include "record/ledger.h"

/* Powers of a panel are looked at in so many points, the last one only where expressions may vary. */
enum { gauss_points = 5, power_points };

struct sums {
    double *work;    /* per load: the integral of its power is added */
    double lively;   /* the size of a group's energies: what was in motion, */
    double turnover; /* and the integral of the size of all its powers, which is added to */
    double lost;     /* length of all panels in which a power was not resolved */
};

/* Add the integrals over [from, to] of a group's last step, [J] each, to the tolerance of its run or 1e-7, whichever is less, of
 * the size of its energies. NAN where a tenth of that time is not resolved: then ledger->unresolved. False when the state
 * cannot be looked at. */
bool powers_integrate(struct ledger *ledger, struct ensemble *ensemble, size_t group, struct time_dd from,
                      struct time_dd to, struct sums *sums);

#endif
