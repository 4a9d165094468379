/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random states of a scene at which its equations are compared: coordinates and rates of the size of the
 * initial ones, angles in the full circle, couplings closed.
 */
#ifndef FBD_OUTPUT_RANDOM_STATE_H
#define FBD_OUTPUT_RANDOM_STATE_H

#include <gsl/gsl_rng.h>

#include "dynamics/modes.h"

/* The model of a document, each parameter that of `model` times a random factor of 1 +- `spread`: false when
 * memory is out; *drawn is NULL when the file does not allow these values. */
bool random_model(const struct document *document, const fbd_model *model, gsl_rng *rng, double spread,
                  fbd_model **drawn);

/* Consistent positions under prescribed motions: the start, and the coordinates at the nodes of a grid of
 * times that are reached from it; computed on demand. */
struct random_path {
    const struct fbd_state *start; /* as state_new makes it */
    double *y;                     /* random_path_room(model) numbers */
    int known;                     /* number of nodes after the first */
    bool ends;                     /* there: no consistent state beyond */
};

size_t random_path_room(const struct fbd_model *model);

/* Random coordinates and rates of the size of the initial ones, at least one unit; angles in the full circle.
 * With couplings and contacts near the start: loops stay assembled, closed contacts stay closed and open ones
 * open. False if there is no such state. */
bool random_state(gsl_rng *rng, struct fbd_state *state, struct random_path *path);

/* Settle the modes. True if all forces are finite, no normal force is tensile, rolling bodies roll, and
 * closed contacts are closed. */
bool random_admissible(struct fbd_state *state);

#endif
