/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The numbers and formulas of a force or moment, and its points of application.
 */
#include "emit/bodies.h"

/* The position is empty for loads with several numbers from one text: these are not expressed by parameters. */
struct emit_origin load_origin(const struct model_load *load, const char *key, struct dim dim)
{
    const struct load *source = load->source;
    bool mixed = load_is_placed(source) || load_has_wind(source) || source->toward || source->reaction ||
                 source->kind == load_actuator;
    return (struct emit_origin){mixed ? (struct pos){0, 0} : source->at, key, dim, load->body};
}

const char *load_number(struct emitter *emitter, const struct model_load *load, const char *key, double value,
                        struct dim dim)
{
    const char *owner = emitter->load[load - emitter->model->loads];
    return emit_parameter(emitter, emit_join(emitter, owner, key), value, load_origin(load, key, dim));
}

const char *load_formula(struct emitter *emitter, const struct model_load *load, const char *key,
                         const struct formula *formula, struct dim dim)
{
    const char *owner = emitter->load[load - emitter->model->loads];
    return emit_formula(emitter, formula, emit_join(emitter, owner, key), load_origin(load, key, dim));
}

/* An end of a coupling, that of `load->body` first; for a load on one body its point, and NULL as second end. */
static const struct point *end_of(const struct fbd_model *model, const struct model_load *load, int end)
{
    size_t i = (size_t)(load - model->loads);
    if (i < model->listed_count) return end == 0 ? &load->source->point : NULL;
    const struct force_coupling *coupling = &model->scene->force_couplings[i - model->listed_count];
    int first = coupling->body[0] == ground_body;
    return &coupling->point[end == 0 ? first : 1 - first];
}

const char *load_anchor(struct emitter *emitter, const struct model_load *load)
{
    const char *owner = emitter->load[load - emitter->model->loads];
    const struct point *end = end_of(emitter->model, load, 1);
    if (load->partner >= 0 && end && end->kind != point_fixed)
        return emit_printf(emitter, "c->%s.G", emitter->body[load->partner]);
    return emit_vector(emitter, emit_join(emitter, owner, "to"), load->anchor,
                       (struct emit_origin){load->source->at, "to", DIM_LENGTH, load->partner});
}

const char *load_point(struct emitter *emitter, const struct model_load *load, const char *body)
{
    const char *owner = emitter->load[load - emitter->model->loads];
    if (end_of(emitter->model, load, 0)->kind != point_fixed) return emit_printf(emitter, "c->%s.G", body);
    return emit_vector(emitter, emit_join(emitter, owner, "at"), load->point,
                       load_origin(load, "at", DIM_LENGTH));
}
