/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reject static friction on a plane that the start of another body's slip could break. As a body begins to slip, its
 * friction has the direction of a velocity near zero, which is known to rounding only. Where that force reaches another
 * body, one that is held by more static than kinetic friction could break away by rounding alone.
 */
#include "model/builder.h"

static bool holds_by_more(const struct mode *mode)
{
    return mode->kind == mode_plane &&
           (mode->mu_s.expr || mode->mu_k.expr || mode->mu_s.constant > mode->mu_k.constant);
}

/* Does it transmit forces between bodies? The plane of a driven body does not: its motion is given. */
static bool links(const struct fbd_model *model, const struct constraint *source)
{
    if (source->kind != constraint_plane) return true;
    return source->body[1] != ground_body && model->bodies[source->body[1]].drive < 0;
}

static bool may_be_linked(const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    bool linked = model->coupled_count > model->listed_count;
    for (size_t i = 0; i < scene->constraint_count; i++) linked |= links(model, &scene->constraints[i]);
    for (size_t b = 0; b < model->body_count; b++) linked |= model->bodies[b].parent >= 0;
    return linked;
}

void planes_check(struct builder *builder)
{
    const struct fbd_model *model = builder->model;
    const struct scene *scene = model->scene;
    size_t planes = 0;
    for (size_t i = 0; i < scene->constraint_count; i++)
        planes += scene->constraints[i].kind == constraint_plane;
    for (size_t i = 0; planes > 1 && i < model->plan.mode_count; i++) {
        const struct mode *mode = &model->plan.modes[i];
        if (!holds_by_more(mode) || !may_be_linked(model)) continue;
        const struct constraint *source = model->tree->couplings[mode->coupling].source;
        diag_add(
            builder->errors, FBD_ERROR, "not-here", source->at,
            "let `static` be `kinetic`, or drive the body that they lie on",
            "the static friction of `%s` is larger than its kinetic friction, and other bodies on planes may "
            "break it by forces between them: such a start is not decided to rounding",
            source->name);
        return;
    }
}
