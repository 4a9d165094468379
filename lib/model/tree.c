/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/tree.h"

#include <string.h>

#include "model/builder.h"

/* ---- which bodies are jointed, and in which order */

/* Children of each body, as lists threaded through arrays; entry `body_count` is the ground. */
struct family {
    int *first, *next;
    bool *jointed;
};

static void mark(bool *jointed, int body)
{
    if (body != ground_body) jointed[body] = true;
}

/* Has the body no mass, or no moment of inertia though it turns? */
static bool lacks_inertia(const struct model_body *body)
{
    const int angle = body->joint->angle;
    return body->inertia.mass == 0 || (angle >= 0 && coordinate_inertia(body, angle) == 0);
}

static void mark_jointed(const struct fbd_model *model, bool *jointed)
{
    const struct scene *scene = model->scene;
    for (size_t b = 0; b < scene->body_count; b++) {
        const struct motion *motion = &scene->bodies[b].motion;
        const int parent = motion->parent;
        if (motion->prescribed.expr || motion->curve || scene->bodies[b].mass.expr ||
            lacks_inertia(&model->bodies[b]) || body_has_journal(&scene->bodies[b]))
            jointed[b] = true;
        if (parent != ground_body) jointed[b] = jointed[parent] = true;
    }
    for (size_t c = 0; c < scene->force_coupling_count; c++)
        for (int end = 0; end < 2; end++) mark(jointed, scene->force_couplings[c].body[end]);
    for (size_t c = 0; c < scene->constraint_count; c++)
        for (int end = 0; end < scene->constraints[c].end_count; end++)
            mark(jointed, scene->constraints[c].body[end]);
    for (size_t k = 0; k < scene->absolute_count; k++)
        if (absolute_is_of_pin(&scene->absolutes[k])) jointed[scene->absolutes[k].body] = true;
}

static bool find_family(struct fbd_model *model, struct family *family)
{
    struct arena *arena = &model->arena;
    int count = (int)model->body_count;
    family->first = ARENA_ARRAY(arena, (size_t)count + 1, int);
    family->next = ARENA_ARRAY(arena, (size_t)count, int);
    family->jointed = ARENA_ARRAY(arena, (size_t)count, bool);
    if (arena->failed) return false;
    mark_jointed(model, family->jointed);
    for (int b = 0; b <= count; b++) family->first[b] = -1;
    for (int b = count - 1; b >= 0; b--) { /* backwards: the lists keep the order of the file */
        int parent = model->scene->bodies[b].motion.parent;
        int *first = &family->first[parent == ground_body ? count : parent];
        family->next[b] = *first;
        *first = b;
    }
    return true;
}

/* Depth first, each body before those that move on it, so that chains are contiguous in memory. Returns the
 * number of bodies after those that are jointed, or not, have been added to `ordered`. */
static int order_bodies(const struct fbd_model *model, int *ordered, int number, const struct family *family,
                        bool jointed)
{
    int count = (int)model->body_count;
    int b = family->first[count];
    while (b >= 0) {
        if (family->jointed[b] == jointed) ordered[number++] = b;
        int down = family->first[b];
        while (down < 0 && b != ground_body) { /* back up to the next sibling */
            down = family->next[b];
            if (down < 0) b = model->scene->bodies[b].motion.parent;
        }
        b = down;
    }
    return number;
}

/* ---- places and links */

static struct placement place_in_own_link(const struct model_body *body, int link)
{
    return (struct placement){link, vec_scale(-1, body->pin), {1, 0}, 0};
}

static struct placement place_in_parents_link(const struct fbd_model *model, const struct motion *motion)
{
    const struct placement *parent = &model->bodies[motion->parent].place;
    struct vec turn = vec_turn(parent->turn, vec_unit(motion->along));
    struct vec joint = placement_point(parent, motion->through);
    return (struct placement){parent->link, vec_sub(joint, vec_turn(turn, motion->point)), turn,
                              parent->angle + motion->along};
}

static void set_link(const struct fbd_model *model, struct tree_link *link, int b)
{
    const struct model_body *body = &model->bodies[b];
    const struct motion *motion = &body->source->motion;
    *link = (struct tree_link){.body = b,
                               .kind = body->kind,
                               .coordinate = body->first,
                               .at = motion->through,
                               .e = body->joint->path == path_line ? body->e : (struct vec){1, 0},
                               .side = vec_dot(body->n, vec_perp(body->e)) < 0 ? -1 : 1,
                               .along = motion->along,
                               .pair = -1,
                               .normal_slot = -1};
    link->tilt = vec_unit(link->along);
    if (motion->parent == ground_body) return;
    const struct placement *parent = &model->bodies[motion->parent].place;
    link->parent = parent->link;
    link->at = placement_point(parent, motion->through);
    link->e = vec_turn(parent->turn, link->e);
    link->along += parent->angle;
    link->tilt = vec_unit(link->along);
}

static void add_inertia(struct tree_link *link, const struct model_body *body)
{
    const struct inertia *inertia = &body->inertia;
    struct vec G = placement_point(&body->place, inertia->G);
    double mass = link->mass + inertia->mass, both = mass > 0 ? link->mass * inertia->mass / mass : 0;
    struct vec apart =
        link->mass > 0 ? vec_sub(G, vec_scale(1 / link->mass, link->moment)) : (struct vec){0, 0};
    link->I_G += inertia->I_G + both * vec_dot(apart, apart);
    link->mass = mass;
    link->moment = vec_add(link->moment, vec_scale(inertia->mass, G));
    link->I_O += inertia->I_G + inertia->mass * vec_dot(G, G);
    link->inverse_I_O = 1 / link->I_O;
    link->across = link->I_O > 0 ? link->mass * link->I_G / link->I_O : 0;
}

static void add_bulk(struct tree *tree, int b, const struct model_body *body)
{
    for (size_t i = 0; i < tree->bulk_count; i++)
        if (tree->bulks[i].link == body->place.link) tree->bulks[i].last = false;
    struct tree_bulk *bulk = &tree->bulks[tree->bulk_count++];
    *bulk = (struct tree_bulk){.link = body->place.link,
                               .body = b,
                               .mass = body->mass,
                               .start = body->inertia.mass,
                               .G = placement_point(&body->place, body->inertia.G),
                               .square = body->inertia.I_G / body->inertia.mass,
                               .last = true};
}

bool tree_number(struct fbd_model *model)
{
    struct family family;
    if (!find_family(model, &family)) return false;
    size_t count = model->body_count, bulks = 0;
    for (size_t b = 0; b < count; b++) bulks += model->bodies[b].varies;
    struct tree *tree = ARENA_ARRAY(&model->arena, 1, struct tree);
    if (!tree) return false;
    tree->bodies = ARENA_ARRAY(&model->arena, count, int);
    tree->links = ARENA_ARRAY(&model->arena, count + 1, struct tree_link);
    tree->pairs = ARENA_ARRAY(&model->arena, count, int);
    tree->watched = ARENA_ARRAY(&model->arena, count, int);
    tree->bulks = ARENA_ARRAY(&model->arena, bulks, struct tree_bulk);
    if (model->arena.failed) return false;
    tree->joined_count = order_bodies(model, tree->bodies, 0, &family, true);
    order_bodies(model, tree->bodies, tree->joined_count, &family, false);
    tree->count = 1;
    tree->links[0] = (struct tree_link){.body = -1, .pair = -1, .normal_slot = -1};
    for (int i = 0; i < (int)count; i++) {
        struct model_body *body = &model->bodies[tree->bodies[i]];
        body->alone = i >= tree->joined_count;
        if (i == tree->joined_count) tree->joined = tree->count;
        if (body->count == 0) {
            body->place = place_in_parents_link(model, &body->source->motion);
        } else {
            body->place = place_in_own_link(body, tree->count);
            set_link(model, &tree->links[tree->count++], tree->bodies[i]);
        }
        add_inertia(&tree->links[body->place.link], body);
        if (body->varies) add_bulk(tree, tree->bodies[i], body);
    }
    if (tree->joined_count == (int)count) tree->joined = tree->count;
    for (int i = 1; i < tree->count; i++) {
        int parent = tree->links[i].parent;
        tree->links[i].root = parent > 0 ? tree->links[parent].root : i;
    }
    for (int i = tree->count - 1; i > 0; i--) {
        struct tree_link *link = &tree->links[i], *parent = &tree->links[link->parent];
        if (link->end == 0) link->end = i + 1;
        if (parent->end < link->end) parent->end = link->end;
    }
    model->tree = tree;
    return couplings_build(model);
}

/* ---- loads */

static struct tree_link *link_of(struct builder *builder, const struct model_body *body)
{
    return &builder->model->tree->links[body->place.link];
}

static void add_world_force(struct builder *builder, const struct model_body *body, struct vec point,
                            struct vec f)
{
    struct tree_link *link = link_of(builder, body);
    struct vec arm = body->alone && body->kind == motion_planar ? vec_sub(point, body->inertia.G)
                                                                : placement_point(&body->place, point);
    link->force = vec_add(link->force, f);
    link->sine -= vec_dot(arm, f);
    link->cosine += vec_cross(arm, f);
}

static void add_following(struct builder *builder, const struct model_body *body, struct vec point,
                          struct vec f, double couple)
{
    struct tree *tree = builder->model->tree;
    struct vec turned = vec_turn(body->place.turn, f);
    double moment = couple + vec_cross(placement_point(&body->place, point), turned);
    tree->following[tree->following_count++] = (struct tree_following){body->place.link, turned, moment};
}

/* Is it the same at all times? */
static bool is_steady(const struct model_load *load, const struct formula *value)
{
    return formula_is_constant(value) && load->source->lifetime.number == 0;
}

/* The opposite acts on `partner`, NULL for none. */
static void add_moment(struct builder *builder, const struct model_body *body,
                       const struct model_body *partner, const struct model_load *load,
                       const struct formula *value)
{
    struct tree *tree = builder->model->tree;
    const struct vec none = {0, 0};
    if (formula_is_constant(value) && value->constant == 0) return;
    if (!is_steady(load, value)) {
        tree->moments[tree->moment_count++] =
            (struct tree_moment){.link = body->place.link,
                                 .partner = partner ? partner->place.link : 0,
                                 .lifetime = load->source->lifetime.number,
                                 .value = *value};
        return;
    }
    add_following(builder, body, none, none, value->constant);
    if (partner) add_following(builder, partner, none, none, -value->constant);
}

static void add_varying(struct builder *builder, const struct model_body *body, const struct model_load *load,
                        bool body_frame, const struct formula *value, struct formula angle)
{
    struct tree *tree = builder->model->tree;
    const double turn = body_frame ? body->place.angle : 0;
    tree->forces[tree->force_count++] =
        (struct tree_force){.link = body->place.link,
                            .point = placement_point(&body->place, load->point),
                            .turn = turn,
                            .body_frame = body_frame,
                            .lifetime = load->source->lifetime.number,
                            .value = *value,
                            .angle = angle,
                            .direction = vec_unit(angle.constant + turn)};
}

/* A force of given size in a constant direction. */
static void add_directed(struct builder *builder, const struct model_body *body,
                         const struct model_load *load, const struct formula *value, double angle,
                         bool body_frame)
{
    struct vec f = vec_scale(value->constant, vec_unit(angle));
    if (!is_steady(load, value))
        add_varying(builder, body, load, body_frame, value, formula_constant(angle));
    else if (body_frame)
        add_following(builder, body, load->point, f, 0);
    else
        add_world_force(builder, body, load->point, f);
}

static void add_applied(struct builder *builder, const struct model_body *body, const struct model_load *load)
{
    const double up = 1.5707963267948966;
    bool frame = load->source->body_frame;
    if (load->source->fx.expr || load->source->fy.expr) {
        add_directed(builder, body, load, &load->fx, 0, frame);
        add_directed(builder, body, load, &load->fy, up, frame);
    } else if (!load->source->angle.expr) { /* along the slide, which is the x axis of the body's frame */
        add_directed(builder, body, load, &load->value, 0, true);
    } else if (formula_is_constant(&load->angle)) {
        add_directed(builder, body, load, &load->value, load->angle.constant, frame);
    } else {
        add_varying(builder, body, load, frame, &load->value, load->angle);
    }
    if (load_is_placed(load->source)) add_moment(builder, body, NULL, load, &load->couple);
}

/* Add the term of the wind, and the drag as in still air. */
static void add_drag(struct builder *builder, const struct model_body *body, const struct model_load *load)
{
    const double up = 1.5707963267948966;
    struct tree *tree = builder->model->tree;
    const struct load *source = load->source;
    if (load_has_wind(source)) {
        add_directed(builder, body, load, &load->fx, 0, false);
        add_directed(builder, body, load, &load->fy, up, false);
    }
    if (load_drags_still_air(source))
        tree->drags[tree->drag_count++] =
            (struct tree_drag){body->place.link, source->lifetime.number,
                               placement_point(&body->place, load->point), source->linear, source->quadratic};
}

/* Of the term of a coordinate in the equations, those that are always there have one, others one each. */
static void add_affine(struct builder *builder, int coordinate, const struct load *source)
{
    struct plan *plan = &builder->model->plan;
    struct affine_term *term =
        source->lifetime.number > 0 ? &plan->affine[plan->affine_count++] : &builder->affine[coordinate];
    term->coordinate = coordinate;
    term->lifetime = source->lifetime.number;
    term->kq += source->stiffness;
    term->kv += source->coefficient;
    term->c0 += source->stiffness * source->free_length;
}

static void add_spring(struct builder *builder, const struct model_body *body, const struct model_load *load)
{
    struct tree *tree = builder->model->tree;
    const struct load *source = load->source;
    if (!load->linked) {
        add_affine(builder, body->first, source);
        return;
    }
    struct tree_spring *spring = &tree->springs[tree->spring_count++];
    *spring = (struct tree_spring){.link = {body->place.link, 0},
                                   .point = {placement_point(&body->place, load->point), load->anchor},
                                   .lifetime = source->lifetime.number,
                                   .stiffness = source->stiffness,
                                   .free_length = source->free_length,
                                   .damping = source->coefficient};
    spring->actuated = source->kind == load_actuator;
    spring->guided = source->guided;
    spring->pull = load->value;
    spring->along = vec_unit(source->along);
    if (load->partner < 0) return;
    const struct placement *partner = &builder->model->bodies[load->partner].place;
    spring->link[1] = partner->link;
    spring->point[1] = placement_point(partner, load->anchor);
    spring->along = vec_turn(partner->turn, spring->along);
}

static struct tree_bulk *bulk_of(struct builder *builder, int b)
{
    struct tree_bulk *bulk = builder->model->tree->bulks;
    while (bulk->body != b) bulk++;
    return bulk;
}

static void add_gravity(struct builder *builder, int b)
{
    const struct model_body *body = &builder->model->bodies[b];
    const struct vec g = builder->model->scene->gravity;
    if (body->varies)
        bulk_of(builder, b)->g = g;
    else
        add_world_force(builder, body, body->inertia.G, vec_scale(body->inertia.mass, g));
}

void tree_add_load(struct builder *builder, int index)
{
    const struct model_load *load = &builder->model->loads[index];
    const struct model_body *body = &builder->model->bodies[load->body];
    const struct load *source = load->source;
    switch (source->kind) {
    case load_gravity: add_gravity(builder, load->body); break;
    case load_applied: add_applied(builder, body, load); break;
    case load_spring:
    case load_damper:
    case load_actuator: add_spring(builder, body, load); break;
    case load_drag: add_drag(builder, body, load); break;
    case moment_applied:
        add_moment(builder, body, load->partner < 0 ? NULL : &builder->model->bodies[load->partner], load,
                   &load->value);
        break;
    case moment_spring:
    case moment_damper: add_affine(builder, body->first + body->count - 1, source); break;
    case load_drive:
    case load_rope:
    case load_belt:
    case load_contact:
    case load_carried:
    case load_normal:
    case load_friction:
    case moment_friction:
    case load_potential:
    case moment_potential: break; /* plan.c */
    }
}
