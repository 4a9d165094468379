/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reject static friction that the start of a slip on a plane could break. As a body begins to slip, its friction has
 * the direction of a velocity near zero, which is known to rounding only. Where that force reaches dry friction of any
 * kind that holds by more static than kinetic friction, rounding could break it away.
 */
#include "model/builder.h"

static bool holds_by_more(const struct mode *mode)
{
    return mode_is_friction(mode) &&
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

static void refuse(struct builder *builder, const char *name, struct pos at)
{
    diag_add(builder->errors, FBD_ERROR, "not-here", at,
             "let `static` be `kinetic`, or drive the body that is the plane",
             "the static friction of `%s` is larger than its kinetic friction, and a body that begins to "
             "slip on a "
             "plane may break it by forces between them: such a start is not decided to rounding",
             name);
}

void planes_check(struct builder *builder)
{
    const struct fbd_model *model = builder->model;
    const struct scene *scene = model->scene;
    int planes = 0;
    for (size_t i = 0; i < scene->constraint_count; i++)
        planes += scene->constraints[i].kind == constraint_plane;
    for (size_t i = 0; planes > 0 && i < model->plan.mode_count; i++) {
        const struct mode *mode = &model->plan.modes[i];
        const int others = planes - (mode->kind == mode_plane);
        if (others == 0 || !holds_by_more(mode) || !may_be_linked(model)) continue;
        const struct constraint *source =
            mode->coupling >= 0 ? model->tree->couplings[mode->coupling].source : NULL;
        const struct load *load = source ? NULL : model->loads[mode->load].source;
        refuse(builder, source ? source->name : load->name, source ? source->at : load->at);
        return;
    }
}
