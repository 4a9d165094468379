/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Record: runs within a simulation, from start to end and once more with another tolerance.
 */
#ifndef FBD_API_RECORD_H
#define FBD_API_RECORD_H

#include "output/csv.h"
#include "record/result.h"

/* Put a run of these options, at its start, into a simulation that has none; with a companion where
 * simulation->bars is set. False when memory is out; the simulation can still be ended. */
bool simulation_begin(fbd_simulation *simulation, const struct fbd_model *model,
                      const struct run_options *options);

/* Free the run with all that was made for it. */
void simulation_end(fbd_simulation *simulation);

/* Carry a run that is at its start to its end; what is NULL in `recording`, or itself, is not written. NULL
 * when memory is out or the writer refused. */
fbd_result *record(fbd_simulation *simulation, const fbd_recording *recording);

/* ---- accuracy on request */

/* The tolerance to begin with. */
double accuracy_first_guess(double accuracy);

/* Runs with ever smaller tolerances until the estimate is within simulation->accuracy; the best one stands.
 * NULL as record. */
fbd_result *record_accurately(fbd_simulation *simulation, const fbd_recording *recording);

#endif
