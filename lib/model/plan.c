/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From named loads to dense lists of terms. Constants are folded into an affine or a sine term; a force of
 * fixed direction becomes a scaled formula; only the rest keeps a general term that needs the body's pose.
 */
#include "model/builder.h"

#include <assert.h>

/* The slots of a body are its coordinates and, on some slides, the sum of forces across the line. */
static void add_constant(struct builder *builder, int slot, double value)
{
    builder->affine[slot].c0 += value;
}

static void add_rates(struct builder *builder, int coordinate, double kq, double kv)
{
    builder->affine[coordinate].kq += kq;
    builder->affine[coordinate].kv += kv;
}

static void add_sine(struct builder *builder, int slot, int coordinate, double s, double c)
{
    builder->sine[slot].coordinate = coordinate;
    builder->sine[slot].s += s;
    builder->sine[slot].c += c;
}

static void add_formula(struct builder *builder, int slot, double scale, const struct formula *value)
{
    struct plan *plan = &builder->model->plan;
    if (scale == 0) return;
    if (formula_is_constant(value))
        add_constant(builder, slot, scale * value->constant);
    else
        plan->formulas[plan->formula_count++] = (struct formula_term){slot, scale, *value};
}

/* The moment about the frame's origin (or axis) of a force fixed in the world and acting at `arm` of a body
 * turned by q: M = (R(q) arm) x f = sin(q) (-arm . f) + cos(q) (arm x f). */
static void add_world_moment(struct builder *builder, int coordinate, struct vec arm, struct vec f)
{
    add_sine(builder, coordinate, coordinate, -vec_dot(arm, f), vec_cross(arm, f));
}

/* A moment acts on the body's angle: its only coordinate, or the third of a planar body. */
static int angle_coordinate(const struct model_body *body)
{
    return body->first + body->count - 1;
}

/* ---- constant forces */

static void add_constant_force(struct builder *builder, const struct model_body *body, struct vec point,
                               struct vec f, bool body_frame)
{
    int i = body->first;
    struct vec arm = vec_sub(point, body->pin);
    switch (body->kind) {
    case motion_slide: {
        /* The body frame of a slide lies along the line: e is the image of (1, 0). */
        struct vec world = body_frame ? vec_turn(body->e, f) : f;
        add_constant(builder, i, vec_dot(world, body->e));
        if (body->normal_slot >= 0) add_constant(builder, body->normal_slot, vec_dot(world, body->n));
        break;
    }
    case motion_pivot:
        if (body_frame)
            add_constant(builder, i, vec_cross(arm, f));
        else
            add_world_moment(builder, i, arm, f);
        break;
    case motion_planar:
        if (body_frame) { /* R(q) f = (cos q fx - sin q fy, sin q fx + cos q fy) */
            add_sine(builder, i, i + 2, -f.y, f.x);
            add_sine(builder, i + 1, i + 2, f.x, f.y);
            add_constant(builder, i + 2, vec_cross(arm, f));
            break;
        }
        add_world_moment(builder, i + 2, arm, f);
        add_constant(builder, i, f.x);
        add_constant(builder, i + 1, f.y);
        break;
    case motion_particle:
        add_constant(builder, i, f.x);
        add_constant(builder, i + 1, f.y);
        break;
    case motion_weld:
    case motion_track: break; /* are jointed */
    }
}

static void add_gravity(struct builder *builder, const struct model_body *body)
{
    struct vec weight = vec_scale(body->inertia.mass, builder->model->scene->gravity);
    add_constant_force(builder, body, body->inertia.G, weight, false);
}

/* ---- applied forces */

/* A force of varying size in a constant direction `d`. */
static void add_directed_force(struct builder *builder, const struct model_body *body,
                               const struct model_load *load, const struct formula *value, struct vec d,
                               bool body_frame)
{
    struct plan *plan = &builder->model->plan;
    int i = body->first;
    struct vec arm = vec_sub(load->point, body->pin);
    bool at_origin = arm.x == 0 && arm.y == 0;
    if (formula_is_constant(value)) {
        add_constant_force(builder, body, load->point, vec_scale(value->constant, d), body_frame);
    } else if (body->kind == motion_slide) {
        struct vec world = body_frame ? vec_turn(body->e, d) : d;
        add_formula(builder, i, vec_dot(world, body->e), value);
        if (body->normal_slot >= 0) add_formula(builder, body->normal_slot, vec_dot(world, body->n), value);
    } else if (body->kind == motion_pivot && body_frame) {
        add_formula(builder, i, vec_cross(arm, d), value);
    } else if (body->kind == motion_particle || (body->kind == motion_planar && !body_frame && at_origin)) {
        add_formula(builder, i, d.x, value);
        add_formula(builder, i + 1, d.y, value);
    } else {
        plan->forces[plan->force_count++] =
            (struct force_term){(int)(body - builder->model->bodies), load->point, body_frame, *value,
                                formula_constant(atan2(d.y, d.x))};
    }
}

/* Add the moment of the offset. Where that and the direction are constant, it is added with the formulas of
 * the force itself and shares their switches. */
static void add_couple(struct builder *builder, const struct model_body *body, const struct model_load *load)
{
    const struct load *source = load->source;
    struct vec arm = {load->offset_x.constant, load->offset_y.constant};
    if (body->kind != motion_pivot && body->kind != motion_planar) return;
    bool fixed =
        formula_is_constant(&load->offset_x) && formula_is_constant(&load->offset_y) && !source->body_frame;
    int i = angle_coordinate(body);
    if (fixed && (source->fx.expr || source->fy.expr)) {
        add_formula(builder, i, arm.x, &load->fy);
        add_formula(builder, i, -arm.y, &load->fx);
    } else if (fixed && formula_is_constant(&load->angle)) {
        add_formula(builder, i, vec_cross(arm, vec_unit(load->angle.constant)), &load->value);
    } else {
        add_formula(builder, i, 1, &load->couple);
    }
}

static void add_applied(struct builder *builder, const struct model_body *body, const struct model_load *load)
{
    struct plan *plan = &builder->model->plan;
    bool frame = load->source->body_frame;
    if (load->source->fx.expr || load->source->fy.expr) {
        add_directed_force(builder, body, load, &load->fx, (struct vec){1, 0}, frame);
        add_directed_force(builder, body, load, &load->fy, (struct vec){0, 1}, frame);
    } else if (!load->source->angle.expr) { /* along the slide */
        add_formula(builder, body->first, 1, &load->value);
    } else if (formula_is_constant(&load->angle)) {
        add_directed_force(builder, body, load, &load->value, vec_unit(load->angle.constant), frame);
    } else {
        plan->forces[plan->force_count++] = (struct force_term){(int)(body - builder->model->bodies),
                                                                load->point, frame, load->value, load->angle};
    }
    if (load_is_placed(load->source)) add_couple(builder, body, load);
}

/* ---- springs, dampers, drag */

static void add_link(struct builder *builder, const struct model_body *body, const struct model_load *load)
{
    struct plan *plan = &builder->model->plan;
    const struct load *source = load->source;
    if (load->linked) {
        plan->links[plan->link_count++] = (struct link_term){.body = (int)(body - builder->model->bodies),
                                                             .point = load->point,
                                                             .anchor = load->anchor,
                                                             .stiffness = source->stiffness,
                                                             .free_length = source->free_length,
                                                             .damping = source->coefficient};
    } else {
        add_rates(builder, body->first, source->stiffness, source->coefficient);
        add_constant(builder, body->first, source->stiffness * source->free_length);
    }
}

static void add_square(struct plan *plan, int slot, double k)
{
    assert(plan->square); /* there is room for every load */
    size_t count = plan->square_count;
    if (count > 0 && plan->square[count - 1].slot == slot)
        plan->square[count - 1].k += k;
    else
        plan->square[plan->square_count++] = (struct square_term){slot, slot, k};
}

static void add_drag(struct builder *builder, const struct model_body *body, const struct model_load *load)
{
    struct plan *plan = &builder->model->plan;
    double linear = load->source->linear, quadratic = load->source->quadratic;
    if (load_has_wind(load->source)) {
        add_directed_force(builder, body, load, &load->fx, (struct vec){1, 0}, false);
        add_directed_force(builder, body, load, &load->fy, (struct vec){0, 1}, false);
    }
    if (!load_drags_still_air(load->source)) return;
    struct vec arm = vec_sub(load->point, body->pin);
    double r = vec_norm(arm);
    int i = body->first;
    if (body->kind == motion_slide || body->kind == motion_pivot) {
        /* At distance r from the axis: v = r omega, M = -r (c + k |v|) v. */
        double reach = body->kind == motion_pivot ? r : 1;
        add_rates(builder, i, 0, linear * reach * reach);
        if (quadratic != 0) add_square(plan, i, quadratic * reach * reach * reach);
    } else if (quadratic == 0 && (body->kind == motion_particle || r == 0)) {
        add_rates(builder, i, 0, linear);
        add_rates(builder, i + 1, 0, linear);
    } else {
        plan->drags[plan->drag_count++] =
            (struct drag_term){(int)(body - builder->model->bodies), load->point, linear, quadratic};
    }
}

static void add_moment_spring(struct builder *builder, const struct model_body *body,
                              const struct load *source)
{
    add_rates(builder, angle_coordinate(body), source->stiffness, 0);
    add_constant(builder, angle_coordinate(body), source->stiffness * source->free_length);
}

static void add_moment_damper(struct builder *builder, const struct model_body *body,
                              const struct load *source)
{
    add_rates(builder, angle_coordinate(body), 0, source->coefficient);
}

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
                (struct potential_term){coordinate, coordinate, load->potential};
    }
}

/* ---- friction and contact */

static void add_friction(struct builder *builder, struct model_body *body, int index)
{
    struct plan *plan = &builder->model->plan;
    const struct load *source = builder->model->loads[index].source;
    int b = (int)(body - builder->model->bodies);
    bool bearing = source->kind == moment_friction, jointed = body->place.link > 0;
    if (body->friction >= 0 || body->kind == motion_planar) {
        bool twice = body->friction >= 0;
        diag_add(builder->errors, FBD_ERROR, twice ? "one-friction" : "not-here", source->at,
                 twice ? "add the coefficients (or the limits) up in one entry"
                       : "a bearing belongs to a `pivot`",
                 twice ? "`%s` has dry friction twice: which of the two sticks first is not determined"
                       : "`%s` moves in the plane and has no bearing",
                 body->name);
        return;
    }
    struct mode mode = {.kind = jointed ? mode_joint : mode_single,
                        .body = b,
                        .load = index,
                        .coordinate = body->first,
                        .normal_slot = source->kind == load_friction ? body->normal_slot : -1,
                        .mu_s = builder_formula(builder, &source->mu_s, b, index),
                        .mu_k = builder_formula(builder, &source->mu_k, b, index),
                        .surface_speed = builder_formula(builder, &source->surface_speed, b, index),
                        .moving = source->surface_speed.expr != NULL,
                        .inertia = jointed   ? 0
                                   : bearing ? body->I_O
                                             : body->inertia.mass,
                        .hold_slot = jointed ? plan->slots++ : body->first,
                        .coupling = -1};
    for (int i = 0; i < body->load_count; i++) {
        const struct load *other = builder->model->loads[body->first_load + i].source;
        if (other->kind == load_normal && other->two_sided) mode.two_sided = true;
    }
    body->friction = (int)plan->mode_count;
    plan->modes[plan->mode_count++] = mode;
}

/* Add a load of a body that is not jointed. */
static void add_load(struct builder *builder, struct model_body *body, int index)
{
    const struct model_load *load = &builder->model->loads[index];
    const struct load *source = load->source;
    switch (source->kind) {
    case load_gravity: add_gravity(builder, body); break;
    case load_applied: add_applied(builder, body, load); break;
    case load_spring:
    case load_damper: add_link(builder, body, load); break;
    case load_drag: add_drag(builder, body, load); break;
    case load_potential:
    case moment_potential: add_potential(builder, body, load); break;
    case moment_applied: add_formula(builder, angle_coordinate(body), 1, &load->value); break;
    case moment_spring: add_moment_spring(builder, body, source); break;
    case moment_damper: add_moment_damper(builder, body, source); break;
    case load_drive:
    case load_rope:
    case load_belt:
    case load_contact:
    case load_carried:
    case load_normal: break; /* see the contact below, and its friction */
    case load_friction:
    case moment_friction: add_friction(builder, body, index); break;
    }
}

/* Loads of a jointed body are added to the tree, except those within its joint. */
static void add_jointed_load(struct builder *builder, struct model_body *body, int index)
{
    const struct model_load *load = &builder->model->loads[index];
    switch (load->source->kind) {
    case load_potential:
    case moment_potential: add_potential(builder, body, load); break;
    case load_friction:
    case moment_friction: add_friction(builder, body, index); break;
    default: tree_add_load(builder, index);
    }
}

void plan_load(struct builder *builder, struct model_body *body, int index)
{
    if (body->place.link > 0)
        add_jointed_load(builder, body, index);
    else
        add_load(builder, body, index);
}

/* A slide keeps the sum of forces across its line when the normal force is watched or friction needs it. */
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
        if (normal < 0 || (model->loads[normal].source->two_sided && !rubs)) continue;
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
    size_t couplings = model->tree ? (size_t)model->tree->coupling_count : 0;
    most_slots += 2 * couplings;
    plan->n = (int)model->scene->coordinate_count;
    plan->slots = plan->n;
    plan->own = (int)model->scene->own_count;
    plan->size = scene_size(model->scene);
    plan->inverse_inertia = ARENA_ARRAY(arena, (size_t)plan->n, double);
    plan->affine = builder->affine = ARENA_ARRAY(arena, most_slots, struct affine_term);
    plan->sine = builder->sine = ARENA_ARRAY(arena, most_slots, struct sine_term);
    plan->square = ARENA_ARRAY(arena, loads, struct square_term);
    plan->formulas = ARENA_ARRAY(arena, 4 * loads, struct formula_term); /* two components in two slots */
    plan->potentials = ARENA_ARRAY(arena, most_coordinates_of_a_body * loads, struct potential_term);
    plan->links = ARENA_ARRAY(arena, loads, struct link_term);
    plan->drags = ARENA_ARRAY(arena, loads, struct drag_term);
    plan->forces = ARENA_ARRAY(arena, 2 * loads, struct force_term);
    plan->modes = ARENA_ARRAY(arena, loads + 8 * model->scene->constraint_count + 2 * couplings, struct mode);
    plan->contacts = ARENA_ARRAY(arena, model->body_count + model->scene->constraint_count + 2 * couplings,
                                 struct contact);
    plan->offsets = ARENA_ARRAY(arena, model->body_count, struct offset_body);
    plan->bodies = ARENA_ARRAY(arena, model->body_count, struct body_terms);
    plan->slot_constant = ARENA_ARRAY(arena, most_slots, bool);
    struct tree *tree = model->tree;
    if (tree) {
        tree->following = ARENA_ARRAY(arena, 3 * loads, struct tree_following);
        tree->forces = ARENA_ARRAY(arena, 2 * loads, struct tree_force);
        tree->moments = ARENA_ARRAY(arena, loads, struct tree_moment);
        tree->springs = ARENA_ARRAY(arena, loads, struct tree_spring); /* a belt is a load, too */
        tree->drags = ARENA_ARRAY(arena, loads, struct tree_drag);
    }
    return !arena->failed;
}

static void plan_inertias(struct fbd_model *model)
{
    struct plan *plan = &model->plan;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        const struct inertia *inertia = &body->inertia;
        for (int k = 0; k < body->count; k++) {
            double m = body->kind == motion_pivot ? body->I_O : k == 2 ? inertia->I_G : inertia->mass;
            plan->inverse_inertia[body->first + k] = 1 / m;
        }
        if (body->place.link == 0 && body->kind == motion_planar && (body->arm.x != 0 || body->arm.y != 0))
            plan->offsets[plan->offset_count++] =
                (struct offset_body){(int)b, body->first, inertia->mass, inertia->I_G, body->arm};
    }
}

/* Keep the nonzero terms, in slot order (a fixed order of summation). */
static void pack(struct builder *builder)
{
    struct plan *plan = &builder->model->plan;
    for (int slot = 0; slot < plan->slots; slot++) {
        struct affine_term affine = builder->affine[slot];
        struct sine_term sine = builder->sine[slot];
        affine.slot = sine.slot = slot;
        affine.coordinate = slot < plan->n ? slot : 0; /* normal slots have constants only */
        plan->slot_constant[slot] = affine.kq == 0 && affine.kv == 0 && sine.s == 0 && sine.c == 0;
        if (affine.c0 != 0 || affine.kq != 0 || affine.kv != 0) plan->affine[plan->affine_count++] = affine;
        if (sine.s != 0 || sine.c != 0) plan->sine[plan->sine_count++] = sine;
    }
    for (size_t i = 0; i < plan->square_count; i++) plan->slot_constant[plan->square[i].slot] = false;
    for (size_t i = 0; i < plan->formula_count; i++) plan->slot_constant[plan->formulas[i].slot] = false;
    for (size_t i = 0; i < plan->potential_count; i++) plan->slot_constant[plan->potentials[i].slot] = false;
}

/* General terms reach every slot of their body. */
static void mark_body_slots(struct fbd_model *model, int b)
{
    const struct model_body *body = &model->bodies[b];
    for (int k = 0; k < body->count; k++) model->plan.slot_constant[body->first + k] = false;
    if (body->friction >= 0) model->plan.slot_constant[model->plan.modes[body->friction].hold_slot] = false;
    if (body->normal_slot >= 0) model->plan.slot_constant[body->normal_slot] = false;
}

static void mark_strands(struct fbd_model *model)
{
    for (int i = 0; model->tree && i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        if (coupling_presses(coupling)) model->plan.slot_constant[coupling->normal_slot] = false;
        for (int k = 0; k < coupling->strands; k++)
            model->plan.slot_constant[coupling->slack_slot[k]] = false;
    }
}

bool plan_build(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    struct plan *plan = &model->plan;
    if (!allocate(builder)) return false;
    plan_normals(model);
    plan_inertias(model);
    for (size_t b = 0; b < model->body_count; b++) body_terms_add(builder, (int)b);
    for (size_t i = model->listed_count; i < model->coupled_count; i++) tree_add_load(builder, (int)i);
    plan_couplings(builder);
    pack(builder);
    for (size_t b = 0; b < model->body_count; b++)
        if (model->bodies[b].place.link > 0) mark_body_slots(model, (int)b);
    mark_strands(model);
    couplings_check(builder);
    contacts_check(builder);
    if (model->tree && !tree_finish(model)) return false;
    body_terms_finish(builder);
    for (size_t i = 0; i < plan->link_count; i++) mark_body_slots(model, plan->links[i].body);
    for (size_t i = 0; i < plan->drag_count; i++) mark_body_slots(model, plan->drags[i].body);
    for (size_t i = 0; i < plan->force_count; i++) mark_body_slots(model, plan->forces[i].body);
    return true;
}
