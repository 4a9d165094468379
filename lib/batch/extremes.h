/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Extremes: the minimum and maximum of coordinates, rates, points in the world and section forces over a run.
 *
 * The dense output of each step is sampled at equal intervals, ends included; where a sample exceeds the
 * extreme so far and its neighbours do not, the extreme lies between them and is bracketed by golden section
 * (Kiefer 1953). Near an extreme q(t) is flat, so a bracket of 1e-6 of the step leaves an error of 1e-12 of
 * the variation in it, which is below the error of the motion.
 */
#ifndef FBD_BATCH_EXTREMES_H
#define FBD_BATCH_EXTREMES_H

#include "loop/ensemble.h"
#include "output/run_columns.h"

struct extreme {
    struct run_column column;
    int sign; /* +1 greatest, -1 least */
    double value;
};

/* Initialize at a state; `errors` receives why a section force has no value. */
void extremes_start(struct extreme *extremes, size_t count, const struct fbd_state *state,
                    fbd_errors *errors);

/* Update with the last step of a run. `probe` is a scratch state of the same model. Returns false when the
 * dense output is not available, or the quantity has no value. */
bool extremes_step(struct extreme *extremes, size_t count, struct ensemble *run, struct fbd_state *probe,
                   fbd_errors *errors);

#endif
