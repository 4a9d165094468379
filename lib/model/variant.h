/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Variant: the same scene with something changed, compiled anew.
 *
 * The file's text is read again with every parameter as it is in the model, the scene is edited, and the
 * result is compiled: whatever follows from the change (lists of terms, modes, events) follows by itself.
 */
#ifndef FBD_MODEL_VARIANT_H
#define FBD_MODEL_VARIANT_H

#include "model/model.h"

/* Change a scene before it is compiled. `errors` takes a note when that cannot be done. */
typedef void scene_edit(struct scene *scene, void *context, fbd_errors *errors);

/* A variant of `model`, to be freed with model_free; NULL with notes in `errors` when the scene is none any
 * more (ids of model_compile) or memory is out. */
struct fbd_model *model_variant(const struct fbd_model *model, scene_edit *edit, void *context,
                                fbd_errors *errors);

#endif
