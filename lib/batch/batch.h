/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Batch: runs of equal structure that advance together, in the lanes of the processor's vectors (lanes.h).
 *
 * A run is put into a lane between two of its steps, makes quiet ones there, and is taken out where its next one is not
 * quiet: it has to end at the end of the run, the stiff method is to be asked, rounding counts, an attempt is not finite or
 * asks for the sine of a large angle. Of that step the run knows nothing yet, and makes it itself (run_advance). So it has
 * the bits that it has alone: a lane does what the run does in a quiet step, by the same operations in the same order, and
 * what the run goes by is in its place before and after.
 *
 * What a lane takes: a single pendulum, perhaps with a damper, or a double one, under constant forces, by the method that
 * `auto` has for that (nystrom.h, rk8pd of pair8.h), of which nobody asks what there is inside of its steps: without events.
 * Others are refused, and while there are runs in the batch those that are of another kind.
 */
#ifndef FBD_BATCH_BATCH_H
#define FBD_BATCH_BATCH_H

#include "loop/run.h"

struct batch;

/* The most lanes that there are. */
enum { batch_most_lanes = 8 };

/* All lanes empty: as many as the widest vectors of this processor have numbers (8, 4 or 2), but at most `most`, which is 2 or
 * more. NULL when memory is out. */
struct batch *batch_new(unsigned most);
void batch_free(struct batch *batch);

unsigned batch_lanes(const struct batch *batch);

/* May runs of this model be put into lanes? If not none of them may. */
bool batch_suits(const struct fbd_model *model);

/* Put a run into an empty lane; false where its next step is not a quiet one. The run must stay where it is until it
 * is taken out, and nobody may use it. */
bool batch_put(struct batch *batch, unsigned lane, struct run *run);

/* Make steps until some of the runs have to make the next one themselves. These are taken out, and their lanes empty: the
 * mask of these lanes. Not 0 unless all are empty. */
unsigned batch_go(struct batch *batch);

/* Take a run out before that. */
void batch_take(struct batch *batch, unsigned lane);

#endif
