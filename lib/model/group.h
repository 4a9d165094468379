/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Group: the model of some of a scene's bodies, as if the file had listed only these.
 *
 * It is compiled from the same scene by the same code, with the coordinates renumbered; its plan, state and
 * right-hand side are those of a smaller scene.
 */
#ifndef FBD_MODEL_GROUP_H
#define FBD_MODEL_GROUP_H

#include "model/model.h"

/* The items of a scene, and of its model, that form a group, as indices in their order; and for the whole scene the numbers
 * in the group: slot s of expressions becomes moved[s], body b becomes local[b]. */
struct selection {
    const int *bodies, *events, *force_couplings, *constraints, *absolutes;
    size_t body_count, event_count, force_coupling_count, constraint_count, absolute_count;
    const int *branches, *modes, *loads; /* of the model, which lists those of a group in the same order */
    size_t branch_count, mode_count, load_count;
    const int *moved, *local;
};

/* The model of a group whose expressions refer to its own bodies only. It refers to `whole`, which must
 * outlive it, has no hand derivations, and is freed with model_free before `memory`, which holds its arrays. NULL when memory
 * is out. */
struct fbd_model *model_group(const struct fbd_model *whole, const struct selection *selection,
                              struct arena *memory);

#endif
