/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Record: runs within a simulation, from start to end and once more with another tolerance.
 */
#ifndef FBD_API_RECORD_H
#define FBD_API_RECORD_H

#include "output/csv.h"
#include "record/result.h"

/* Put a run with these options, at its start, into a simulation without a run; with a companion if
 * simulation->bars is set. Returns false when memory is out; simulation_end may be called also then. */
bool simulation_begin(fbd_simulation *simulation, const struct fbd_model *model,
                      const struct run_options *options);

/* Free the run with all its data. */
void simulation_end(fbd_simulation *simulation);

/* Note why an ensemble is refused at its start. */
void simulation_blame(const struct ensemble *ensemble, fbd_errors *errors);

/* Of the parts between changes of inputs the balance with the largest ratio of residual to its bound. */
struct energy_balance simulation_energy_balance(fbd_simulation *simulation);

/* Carry a run from its start to its end; outputs that are NULL in `recording` are not written, and none if it
 * is NULL. NULL when memory is out or the writer returned nonzero. */
fbd_result *record(fbd_simulation *simulation, const fbd_recording *recording);

/* ---- accuracy on request */

/* The initial tolerance. */
double accuracy_first_guess(double accuracy);

/* Repeat runs with decreasing tolerances until the estimate is within simulation->accuracy; keep the best
 * one. NULL as record. */
fbd_result *record_accurately(fbd_simulation *simulation, const fbd_recording *recording);

#endif
