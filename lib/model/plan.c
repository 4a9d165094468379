/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From named loads to dense lists: forces in joints and dry friction; all others are added to the tree.
 */
#include <stdlib.h>

#include "model/builder.h"

static void add_potential(struct builder *builder, const struct model_body *body,
                          const struct model_load *load)
{
    struct plan *plan = &builder->model->plan;
    if (formula_is_constant(&load->potential)) return;
    const int *slots;
    size_t count = expr_variables(load->potential.expr, &slots);
    for (size_t k = 0; k < count; k++) {
        int coordinate = slots[k] - 1;
        if (coordinate >= body->first && coordinate < body->first + body->count)
            plan->potentials[plan->potential_count++] =
                (struct potential_term){coordinate, body->place.link, load->source->lifetime.number,
                                        load->potential};
    }
}

/* ---- friction and contact */

static void add_friction(struct builder *builder, struct model_body *body, int index)
{
    struct plan *plan = &builder->model->plan;
    const struct load *source = builder->model->loads[index].source;
    int b = (int)(body - builder->model->bodies);
    bool bearing = source->kind == moment_friction;
    if (body->friction >= 0 || (bearing && !body->joint->has_axis)) {
        bool twice = body->friction >= 0;
        diag_add(builder->errors, FBD_ERROR, twice ? "one-friction" : "not-here", source->at,
                 twice ? "add the coefficients (or the limits) up in one entry"
                       : "a bearing belongs to a `pivot`",
                 twice ? "`%s` has dry friction twice: which of the two sticks first is not determined"
                       : "`%s` moves in the plane and has no bearing",
                 body->name);
        return;
    }
    struct mode mode = {.kind = body->alone ? mode_single : mode_joint,
                        .body = b,
                        .load = index,
                        .coordinate = body->first,
                        .normal_slot = bearing && !source->journal ? -1 : body->normal_slot,
                        .moment = source->kind != load_friction,
                        .mu_s = builder_formula(builder, &source->mu_s, b, index),
                        .mu_k = builder_formula(builder, &source->mu_k, b, index),
                        .surface_speed = builder_formula(builder, &source->surface_speed, b, index),
                        .moving = source->surface_speed.expr != NULL,
                        .inertia = body->alone ? coordinate_inertia(body, 0) : 0,
                        .hold_slot = plan->slots++,
                        .coupling = -1};
    for (int i = 0; i < body->load_count; i++) {
        const struct load *other = builder->model->loads[body->first_load + i].source;
        if (other->kind == load_normal && other->two_sided) mode.two_sided = true;
    }
    body->friction = (int)plan->mode_count;
    plan->modes[plan->mode_count++] = mode;
}

/* Potentials and dry friction of a body, in the order of the file. */
static void add_joint_loads(struct builder *builder, struct model_body *body)
{
    for (int i = body->first_load; i < body->first_load + body->load_count; i++) {
        const struct model_load *load = &builder->model->loads[i];
        switch (load->source->kind) {
        case load_potential:
        case moment_potential: add_potential(builder, body, load); break;
        case load_friction:
        case moment_friction: add_friction(builder, body, i); break;
        default: break; /* add_other_loads */
        }
    }
}

/* All others, of bodies in the order of the tree. */
static void add_other_loads(struct builder *builder, int from, int to)
{
    const struct fbd_model *model = builder->model;
    for (int i = from; i < to; i++) {
        const struct model_body *body = &model->bodies[model->tree->bodies[i]];
        for (int k = 0; k < body->load_count; k++) tree_add_load(builder, body->first_load + k);
    }
}

/* Does an event name the normal force of body b? */
static bool normal_is_named(const struct fbd_model *model, int b)
{
    for (size_t k = 0; k < model->scene->absolute_count; k++) {
        const struct absolute *absolute = &model->scene->absolutes[k];
        if (absolute->kind == absolute_reaction && absolute->body == b && absolute->roll == 0 &&
            absolute->part == reaction_normal)
            return true;
    }
    return false;
}

/* A slide keeps the sum of forces across its line when the normal force is watched, named, or friction needs it,
 * and a pivot its reaction when it has a journal bearing. */
static void plan_normals(struct fbd_model *model)
{
    struct plan *plan = &model->plan;
    for (size_t b = 0; b < model->body_count; b++) {
        struct model_body *body = &model->bodies[b];
        bool rubs = false;
        int normal = -1;
        for (int i = body->first_load; i < body->first_load + body->load_count; i++) {
            if (model->loads[i].source->kind == load_friction) rubs = true;
            if (model->loads[i].source->kind == load_normal) normal = i;
        }
        if (body_has_journal(body->source) && body->joint->has_axis) body->normal_slot = plan->slots++;
        if (normal < 0) continue;
        if (model->loads[normal].source->two_sided && !rubs && !normal_is_named(model, (int)b)) continue;
        body->normal_slot = plan->slots++;
        if (!model->loads[normal].source->two_sided)
            plan->contacts[plan->contact_count++] = (struct contact){(int)b, normal, body->normal_slot, -1};
    }
}

/* ---- packing */

static bool allocate(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    struct plan *plan = &model->plan;
    struct arena *arena = &model->arena;
    size_t loads = model->load_count, most_slots = model->scene->coordinate_count +
                                                   2 * (model->body_count + model->scene->constraint_count);
    size_t couplings = (size_t)model->tree->coupling_count;
    most_slots += 2 * couplings;
    plan->n = (int)model->scene->coordinate_count;
    plan->slots = plan->n;
    plan->own = (int)model->scene->own_count;
    plan->size = scene_size(model->scene);
    plan->inverse_inertia = ARENA_ARRAY(arena, (size_t)plan->n, double);
    plan->affine = ARENA_ARRAY(arena, (size_t)plan->n + loads, struct affine_term);
    builder->affine = ARENA_ARRAY(arena, (size_t)plan->n, struct affine_term);
    plan->potentials = ARENA_ARRAY(arena, most_coordinates_of_a_body * loads, struct potential_term);
    plan->modes = ARENA_ARRAY(arena, loads + 8 * model->scene->constraint_count + 2 * couplings, struct mode);
    plan->contacts = ARENA_ARRAY(arena, model->body_count + model->scene->constraint_count + 2 * couplings,
                                 struct contact);
    plan->slot_constant = ARENA_ARRAY(arena, most_slots, bool);
    struct tree *tree = model->tree;
    tree->following = ARENA_ARRAY(arena, 3 * loads, struct tree_following);
    tree->forces = ARENA_ARRAY(arena, 2 * loads, struct tree_force);
    tree->moments = ARENA_ARRAY(arena, loads, struct tree_moment);
    tree->springs = ARENA_ARRAY(arena, loads, struct tree_spring); /* a belt is a load, too */
    tree->drags = ARENA_ARRAY(arena, loads, struct tree_drag);
    return !arena->failed;
}

static void plan_inertias(struct fbd_model *model)
{
    struct plan *plan = &model->plan;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        for (int k = 0; k < body->count; k++)
            plan->inverse_inertia[body->first + k] = 1 / coordinate_inertia(body, k);
    }
}

static int by_coordinate(const void *a, const void *b)
{
    const struct affine_term *one = a, *other = b;
    const int first = one->coordinate - other->coordinate;
    return first != 0 ? first : one->lifetime - other->lifetime;
}

/* Keep the nonzero terms, in the order of the coordinates. */
static void pack(struct builder *builder)
{
    const struct fbd_model *model = builder->model;
    struct plan *plan = &builder->model->plan;
    for (int i = 0; i < plan->n; i++) {
        struct affine_term affine = builder->affine[i];
        affine.coordinate = i;
        if (affine.c0 != 0 || affine.kq != 0 || affine.kv != 0) plan->affine[plan->affine_count++] = affine;
    }
    qsort(plan->affine, plan->affine_count, sizeof *plan->affine, by_coordinate);
    for (size_t i = 0; i < plan->affine_count; i++)
        plan->affine[i].link =
            model->bodies[model->scene->coordinates[plan->affine[i].coordinate].body].place.link;
}

/* Of bodies that stand alone the equation tells which forces are constant; others, as those of couplings, may
 * vary. */
static void find_constant_slots(struct fbd_model *model)
{
    struct plan *plan = &model->plan;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        const struct scalar_equation *equation = &plan->equations[body->first];
        if (body->count == 0 || !equation->known) continue;
        bool along = scalar_equation_is_constant(equation);
        plan->slot_constant[body->first] = along;
        if (body->friction >= 0) plan->slot_constant[plan->modes[body->friction].hold_slot] = along;
        if (body->normal_slot >= 0)
            plan->slot_constant[body->normal_slot] = equation->across_formulas.count == 0;
    }
}

bool plan_build(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    if (!allocate(builder)) return false;
    plan_normals(model);
    plan_inertias(model);
    for (size_t b = 0; b < model->body_count; b++) add_joint_loads(builder, &model->bodies[b]);
    const int joined = model->tree->joined_count;
    add_other_loads(builder, 0, joined);
    for (size_t i = model->listed_count; i < model->coupled_count; i++) tree_add_load(builder, (int)i);
    plan_couplings(builder);
    couplings_check(builder); /* adds loads on jointed links, which come first */
    add_other_loads(builder, joined, (int)model->body_count);
    pack(builder);
    contacts_check(builder);
    welds_check(builder);
    planes_check(builder);
    if (!ratios_check(builder) || !tree_finish(model) || !scalar_equations_collect(builder)) return false;
    find_constant_slots(model);
    return true;
}
