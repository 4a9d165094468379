/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The names of the forces in joints, and the number of arrows in each diagram.
 */
#include "model/builder.h"

/* True if it acts between the two bodies of its joint. */
static bool is_in_joint(const struct model_load *load)
{
    enum law_place place = load_law(load->source)->place;
    return place == acts_in_joint || (place == acts_in_joint_without_end && !load->linked);
}

static bool has_normal(const struct fbd_model *model, const struct model_body *body)
{
    for (int i = body->first_load; i < body->first_load + body->load_count; i++)
        if (model->loads[i].source->kind == load_normal) return true;
    return false;
}

static bool is_off_center(const struct model_body *body, struct vec at)
{
    return at.x != body->inertia.G.x || at.y != body->inertia.G.y;
}

/* Mark bodies with constraint forces off their centre of mass; on a line for rolling, they act at any point. */
static void find_held(const struct fbd_model *model, bool *twisted)
{
    for (size_t c = 0; c < model->scene->constraint_count; c++) {
        const struct constraint *constraint = &model->scene->constraints[c];
        for (int k = 0; k < constraint->end_count; k++) {
            const struct point *point = &constraint->point[k];
            int b = constraint->body[k];
            if (b == ground_body) continue;
            bool wound = (k == 0 && constraint->wound[0] != 0) ||
                         (k + 1 == constraint->end_count && constraint->wound[1] != 0);
            if ((constraint_laws[constraint->kind].line && k == 1) || wound ||
                (point->kind == point_fixed && is_off_center(&model->bodies[b], point->where)))
                twisted[b] = true;
        }
    }
}

/* Find the bodies with a force that would turn them if they were particles that could turn. Computed for all
 * at once, as a coupling is not in the lists of the bodies that it joins. */
static bool *find_twisted(struct fbd_model *model)
{
    bool *twisted = ARENA_ARRAY(&model->arena, model->body_count, bool);
    for (size_t i = 0; twisted && i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        bool at_origin = load->source->kind == load_potential;
        if (load_is_placed(load->source) ||
            is_off_center(&model->bodies[load->body], at_origin ? (struct vec){0, 0} : load->point))
            twisted[load->body] = true;
        const bool couple = load->source->kind == moment_applied || load->source->guided;
        if (load->partner >= 0 && (couple || is_off_center(&model->bodies[load->partner], load->anchor)))
            twisted[load->partner] = true;
        if (load->linked && load->source->kind == moment_applied) twisted[load->body] = true;
    }
    if (twisted) find_held(model, twisted);
    return twisted;
}

/* The name of the joint force beside the listed loads: a slide with `normal` has it in its list. */
static const char *reaction_of(const struct fbd_model *model, const struct model_body *body, bool twisted)
{
    const bool bears = !body->alone && (twisted || body->parent != ground_body || body->child >= 0);
    if (body->joint->path != path_none && has_normal(model, body)) return NULL;
    return body->joint->prevents_turning && !bears ? NULL : body->joint->force;
}

static void name_reactions(struct fbd_model *model, struct model_body *body, bool twisted)
{
    struct arena *arena = &model->arena;
    body->reaction = reaction_of(model, body, twisted);
    for (int i = body->first_load; i < body->first_load + body->load_count; i++)
        model->loads[i].in_joint = is_in_joint(&model->loads[i]);
    if (body->parent == ground_body) return;
    struct model_body *parent = &model->bodies[body->parent];
    if (body->reaction) {
        body->reaction_on_parent = arena_printf(arena, "%s.%s", body->name, body->reaction);
        parent->arrow_count++;
    }
    for (int i = body->first_load; i < body->first_load + body->load_count; i++) {
        struct model_load *load = &model->loads[i];
        if (!load->in_joint) continue;
        load->name_on_parent = arena_printf(arena, "%s.%s", body->name, load->source->name);
        parent->arrow_count++;
    }
}

bool tree_name_reactions(struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    const int count = (int)model->body_count;
    const bool *twisted = find_twisted(model);
    for (int i = 0; twisted && i < count; i++) {
        int b = tree->bodies[count - 1 - i]; /* lists of children in the order of the tree */
        struct model_body *body = &model->bodies[b];
        name_reactions(model, body, twisted[b]);
        if (body->parent == ground_body) continue;
        body->sibling = model->bodies[body->parent].child;
        model->bodies[body->parent].child = b;
    }
    for (size_t i = model->listed_count; i < model->coupled_count; i++) {
        model->bodies[model->loads[i].body].arrow_count++;
        if (model->loads[i].partner >= 0) model->bodies[model->loads[i].partner].arrow_count++;
    }
    return !model->arena.failed;
}
