/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Is every number that is shown of a run finite?
 */
#ifndef FBD_RECORD_FINITE_RESULT_H
#define FBD_RECORD_FINITE_RESULT_H

#include "record/ledger.h"

/* Look at the state of the ensemble, and with a ledger at its energies and works; a run where something is
 * not finite ends with failure, and a reason that names it. False when it does, or when memory is out. */
bool result_finite(struct ensemble *ensemble, struct ledger *ledger, const double *work);

#endif
