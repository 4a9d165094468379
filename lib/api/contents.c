/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the contents of a model file beside its bodies.
 */
#include "fbd_view.h"
#include "model/model.h"

const char *fbd_model_file(const fbd_model *model)
{
    return model ? model->scene->file : NULL;
}
