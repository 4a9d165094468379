/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random states of a scene, where its equations are compared: coordinates and rates of the size of the initial ones,
 * angles all around, couplings closed.
 */
#ifndef FBD_OUTPUT_RANDOM_STATE_H
#define FBD_OUTPUT_RANDOM_STATE_H

#include <gsl/gsl_rng.h>

#include "dynamics/modes.h"

/* The model of a document, each parameter that of `model` times a random factor, `spread` more or less than
 * 1: false when memory is out; *drawn is NULL when the file does not allow these. */
bool random_model(const struct document *document, const fbd_model *model, gsl_rng *rng, double spread,
                  fbd_model **drawn);

/* Where couplings fit: from the start, where motions are prescribed, the coordinates to which it leads by the nodes of a
 * grid of times; as far as they were asked for. */
struct random_path {
    const struct fbd_state *start; /* as state_new makes it */
    double *y;                     /* random_path_room(model) numbers */
    int known;                     /* nodes behind the first */
    bool ends;                     /* there: no state fits further on */
};

size_t random_path_room(const struct fbd_model *model);

/* Random coordinates and rates of the size of the initial ones, at least one unit; angles all around. With couplings and
 * contacts near the start: loops stay assembled as they are there, what touches stays closed, and what is apart is open.
 * False where there is no such state. */
bool random_state(gsl_rng *rng, struct fbd_state *state, struct random_path *path);

/* Settle the modes: are all forces finite, does no surface have to pull, does what rolls roll, and is what was closed? */
bool random_admissible(struct fbd_state *state);

#endif
