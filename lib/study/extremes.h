/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Extremes: the least and the greatest value of coordinates, rates and points in the world over a run.
 *
 * Each step is looked at on its dense output at equal distances, ends included; where a sample goes beyond
 * what was seen so far and its neighbours do not, the extreme lies between them and is closed in by golden
 * section (Kiefer 1953). Near an extreme q(t) is flat, so a bracket of 1e-6 of the step leaves an error of
 * 1e-12 of the curve's rise in it, which is below that of the motion.
 */
#ifndef FBD_STUDY_EXTREMES_H
#define FBD_STUDY_EXTREMES_H

#include "loop/ensemble.h"
#include "output/world.h"

struct extreme {
    int index; /* in y, or -1: */
    struct world_quantity point;
    int sign; /* +1 greatest, -1 least */
    double value;
};

/* Start at a state. */
void extremes_start(struct extreme *extremes, size_t count, const struct fbd_state *state);

/* Account for the last step of a run. `probe` is a state of the same model, for looking. False when the dense
 * output has no value. */
bool extremes_step(struct extreme *extremes, size_t count, struct ensemble *run, struct fbd_state *probe);

#endif
