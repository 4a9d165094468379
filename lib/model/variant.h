/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Variant: the same scene with a change, compiled anew.
 *
 * The file's text is read again with the parameter values of the model, the scene is edited, and the result
 * is compiled; lists of terms, modes and events are rebuilt accordingly.
 */
#ifndef FBD_MODEL_VARIANT_H
#define FBD_MODEL_VARIANT_H

#include "model/model.h"

/* Change a scene before it is compiled. `errors` receives a note when that is impossible. */
typedef void scene_edit(struct scene *scene, void *context, fbd_errors *errors);

/* A variant of `model`, to be freed with model_free; NULL with notes in `errors` when the edited scene is
 * invalid (ids of model_compile) or memory is out. */
struct fbd_model *model_variant(const struct fbd_model *model, scene_edit *edit, void *context,
                                fbd_errors *errors);

#endif
