/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Batch: runs of equal structure that advance together, in the lanes of the processor's vectors (lanes.h).
 *
 * A run is put into a lane between two of its steps, makes ordinary steps there, and is taken out when its
 * next step needs more: the end of the run is reached, stiffness must be checked, rounding is significant, an
 * attempt is not finite or evaluates the sine of a large angle. The run then makes that step from its
 * beginning (run_advance). Results are bitwise those of run_advance: a lane does the same operations in the
 * same order, and the state of run and stepper is restored when the run is taken out.
 *
 * Suitable runs: a simple pendulum, possibly damped, or a double pendulum, under constant forces, with the
 * method that `auto` chooses for it (nystrom.h, rk8pd of pair8.h), without events and therefore without dense
 * output. Other runs are refused; while a batch has runs, so are those of another kind.
 */
#ifndef FBD_BATCH_BATCH_H
#define FBD_BATCH_BATCH_H

#include "loop/run.h"

struct batch;

/* The maximum number of lanes. */
enum { batch_most_lanes = 8 };

/* A batch with empty lanes: as many as the widest vectors of this processor have numbers (8, 4 or 2), but at
 * most `most`, which is 2 or more. NULL when memory is out. */
struct batch *batch_new(unsigned most);
void batch_free(struct batch *batch);

unsigned batch_lanes(const struct batch *batch);

/* True if runs of this model may be suitable for lanes; if false none is. */
bool batch_suits(const struct fbd_model *model);

/* Put a run into an empty lane; returns false if its next step is not suitable. The run must not move in
 * memory, or be used, until it is taken out. */
bool batch_put(struct batch *batch, unsigned lane, struct run *run);

/* Make steps until some of the runs must make the next one themselves. These are taken out; returns the mask
 * of their lanes, which is nonzero unless all lanes are empty. */
unsigned batch_go(struct batch *batch);

/* Take a run out earlier. */
void batch_take(struct batch *batch, unsigned lane);

#endif
