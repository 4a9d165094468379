/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the exact solution of a file.
 */
#include "fbd_study.h"
#include "model/model.h"

bool fbd_model_exact(const fbd_model *model, size_t quantity, double t, double *value, double *derivative)
{
    size_t n = model ? model->scene->coordinate_count : 0;
    if (quantity >= 2 * n || !value || !derivative || scene_has_calls(model->scene)) return false;
    size_t coordinate = quantity % n;
    const struct body *body = &model->scene->bodies[model->scene->coordinates[coordinate].body];
    size_t k = coordinate - (size_t)body->first, count = (size_t)body->count;
    const struct expr *own = body->exact[quantity < n ? k : count + k].expr, *position = body->exact[k].expr;
    if (own) {
        *value = expr_eval_slot(own, t, NULL, 0, NULL, derivative);
    } else if (position && quantity >= n) {
        double again;
        expr_eval_second(position, t, NULL, 0, 0, NULL, value, &again, derivative);
    } else {
        return false;
    }
    return true;
}
