/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Are all output numbers of a run finite?
 */
#ifndef FBD_RECORD_FINITE_RESULT_H
#define FBD_RECORD_FINITE_RESULT_H

#include "record/ledger.h"

/* Check the state of the ensemble, and with a ledger its energies and works; a run with a number that is not
 * finite ends with failure, and a reason that names it. False if so, or when memory is out. */
bool result_finite(struct ensemble *ensemble, struct ledger *ledger, const double *work);

#endif
