/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the contents of a file.
 */
#include "base/api_check.h"
#include "fbd_view.h"
#include "model/model.h"

const char *fbd_model_file(const fbd_model *model)
{
    return model ? model->scene->file : NULL;
}

void fbd_model_options(const fbd_model *model, fbd_options *options, size_t size)
{
    fbd_options file = FBD_OPTIONS_DEFAULT;
    if (!options) return;
    if (model) {
        const struct simulate *simulate = &model->scene->simulate;
        if (simulate->until.expr) file.until = expr_value(simulate->until.expr);
        file.tolerance = simulate->tolerance;
        file.step = simulate->step;
        file.method = simulate->method;
        file.accuracy = simulate->accuracy;
    }
    api_fill_options(options, size, &file, sizeof file);
}
