/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tracks: the starts of their pieces, as switches of an expression of s, and the checks of bodies on them.
 */
#include <string.h>

#include "model/builder.h"

static struct symbol find_s(void *context, const char *name, struct pos at)
{
    const struct model_body *body = context;
    (void)at;
    if (strcmp(name, "s") != 0) return (struct symbol){.kind = symbol_unknown};
    return (struct symbol){.kind = symbol_variable, .dim = DIM_LENGTH, .slot = 1 + body->first};
}

static struct table_symbol find_ends(void *context, const char *name, struct pos at)
{
    const struct model_body *body = context;
    (void)name;
    (void)at;
    return (struct table_symbol){body->source->motion.curve->ends, false};
}

static bool set_piece(struct builder *builder, struct model_body *body, struct tree_link *link)
{
    struct scope scope = {.lookup = find_s, .table = find_ends, .context = body};
    const struct expr_want want = {.dim = DIM_LENGTH, .what = "s"};
    if (!link->track->curve->ends) return true;
    const struct expr *expr =
        expr_compile(&builder->model->arena, "piece(s)", body->source->at, &scope, &want, builder->errors);
    struct value value = {.expr = expr, .at = body->source->at};
    if (expr) link->track->piece = builder_formula(builder, &value, (int)(body - builder->model->bodies), -1);
    return expr != NULL;
}

/* True if the link has rotational inertia or is the base of another link or an end of a coupling. */
static bool resists_turning(const struct fbd_model *model, int index)
{
    const struct tree *tree = model->tree;
    const struct tree_link *link = &tree->links[index];
    bool resists = link->I_O > 0 || vec_norm(link->moment) > 0;
    for (int i = 1; i < tree->count; i++) resists |= tree->links[i].parent == index;
    for (int i = 0; i < tree->coupling_count; i++)
        for (int k = 0; k < tree->couplings[i].end_count; k++)
            resists |= tree->couplings[i].end[k].link == index;
    return resists;
}

/* Reject forces that would turn a body that does not turn with its track. */
static void check_directions(struct builder *builder, const struct model_body *body)
{
    for (size_t i = 0; i < body->source->load_count; i++) {
        const struct load *load = &body->source->loads[i];
        if (load->kind != load_applied) continue;
        bool along = !load->angle.expr && !load->fx.expr && !load->fy.expr;
        if (!along && !load->body_frame) continue;
        diag_add(builder->errors, FBD_ERROR, "not-here", load->at,
                 "give it an angle in the world, or let the body turn",
                 "`%s` refers to the frame of `%s`, which does not turn along its track (`turn: false`)",
                 load->name, body->name);
    }
}

bool tracks_set(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    for (int i = 1; i < model->tree->count; i++) {
        struct tree_link *link = &model->tree->links[i];
        struct model_body *body = &model->bodies[link->body];
        if (link_joint(link)->path != path_curve) continue;
        link->track = ARENA_ARRAY(&model->arena, 1, struct tree_track);
        if (!link->track) return false;
        *link->track =
            (struct tree_track){.curve = body->source->motion.curve, .turns = body->source->motion.turns};
        if (!set_piece(builder, body, link)) return false;
        if (!link->track->turns) check_directions(builder, body);
        if (!link->track->turns || !link->track->curve->kinked || !resists_turning(model, i)) continue;
        diag_add(
            builder->errors, FBD_ERROR, "bad-track", body->source->motion.at,
            "let the curvature grow from one to the other (a table: `interpolation: cubic`), take a point "
            "for the "
            "body, or write `turn: false`",
            "`%s` turns along its track, whose curvature jumps at %.6g: this requires an unbounded moment",
            body->name, link->track->curve->kink);
    }
    return true;
}

/* Set the direction, normal, origin and point of a body on its track at the start. */
void track_set_body(const struct scene *scene, struct model_body *body)
{
    const struct motion *motion = &body->source->motion;
    body->e = curve_at(motion->curve, NULL, scene->coordinates[body->first].initial).e;
    body->n = vec_perp(body->e);
    body->origin = motion->through;
    body->pin = motion->point;
}
