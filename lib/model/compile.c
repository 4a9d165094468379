/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/builder.h"
#include "model/outline.h"

#include <stdlib.h>
#include <string.h>

#include "numeric/tolerances.h"
#include "scene/start_angle.h"

struct formula formula_constant(double value)
{
    return (struct formula){.constant = value};
}

/* The list with room for one more entry, a copy of twice the size where it is full; as it is when memory is out. */
static void *make_room(struct arena *arena, void *list, size_t count, size_t *room, size_t size)
{
    if (count < *room) return list;
    size_t more = *room > 0 ? 2 * *room : 1;
    void *copy = arena_take(arena, more, size, false);
    if (!copy) return list;
    if (count > 0) memcpy(copy, list, count * size);
    *room = more;
    return copy;
}

static void add_kink(struct builder *builder, const struct kink *kink)
{
    struct plan *plan = &builder->model->plan;
    plan->kinks =
        make_room(&builder->model->arena, plan->kinks, plan->kink_count, &builder->kink_room, sizeof *kink);
    if (plan->kink_count < builder->kink_room) plan->kinks[plan->kink_count++] = *kink;
}

static void add_pole(struct builder *builder, const struct pole *pole)
{
    struct plan *plan = &builder->model->plan;
    plan->poles =
        make_room(&builder->model->arena, plan->poles, plan->pole_count, &builder->pole_room, sizeof *pole);
    if (plan->pole_count < builder->pole_room) plan->poles[plan->pole_count++] = *pole;
}

static struct formula make_formula(struct builder *builder, const struct value *value, int body, int load,
                                   int own)
{
    struct formula formula = {.branch = -1};
    if (!value->expr) return formula;
    if (expr_is_constant(value->expr)) return formula_constant(expr_value(value->expr));
    formula.expr = value->expr;
    struct plan *plan = &builder->model->plan;
    size_t switches = expr_switches(value->expr), poles = expr_poles(value->expr);
    if (switches > 0) {
        formula.branch = plan->branches;
        plan->branches += (int)switches;
        add_kink(builder, &(struct kink){
                              .formula = formula, .body = body, .load = load, .own = own, .count = switches});
    }
    if (poles > 0 && (body >= 0 || own >= 0))
        add_pole(builder, &(struct pole){formula, body, load, own, poles});
    return formula;
}

struct formula builder_formula(struct builder *builder, const struct value *value, int body, int load)
{
    return make_formula(builder, value, body, load, -1);
}

static struct formula builder_rate(struct builder *builder, const struct value *value, int own)
{
    return make_formula(builder, value, -1, -1, own);
}

/* ---- bodies */

/* Direct the normal to the side of the surface force: the given one, else up in the world at the start. */
static void set_side(struct model_body *body, const struct scene *scene)
{
    const struct vec turn = vec_unit(start_angle(scene, body->source->motion.parent));
    enum normal_side side = side_up;
    for (size_t i = 0; i < body->source->load_count; i++)
        if (body->source->loads[i].kind == load_normal) side = body->source->loads[i].side;
    double up = vec_turn(turn, body->n).y;
    if (side == side_right || (side == side_up && up < -vertical_line)) body->n = vec_scale(-1, body->n);
}

static void set_line(struct model_body *body)
{
    const struct motion *motion = &body->source->motion;
    body->e = vec_unit(motion->along);
    body->n = vec_perp(body->e);
    body->origin = motion->through;
}

/* Is it stated that the body has no mass, or as a pulley of one piece no moment of inertia? */
static bool is_light(const struct model_body *body)
{
    const struct part *parts = body->source->parts;
    const size_t count = body->source->part_count;
    if (count == 1 && parts[0].shape == shape_given) return body->inertia.I_G == 0;
    for (size_t i = 0; i < count; i++)
        if (parts[i].mass != 0) return false;
    return true;
}

/* Refuse massless bodies where their motion is not covered: on contacts, and free on a moving body. */
static void check_massless(const struct builder *builder)
{
    const struct tree *tree = builder->model->tree;
    for (int k = 0; k < tree->massless_count; k++) {
        const struct tree_link *link = &tree->links[tree->massless[k].link];
        const struct model_body *body = &builder->model->bodies[link->body];
        bool touches = false;
        for (int c = 0; c < tree->coupling_count; c++)
            for (int end = 0; end < tree->couplings[c].end_count; end++)
                touches |= tree->couplings[c].meeting >= 0 &&
                           tree->couplings[c].end[end].link == tree->massless[k].link;
        if (touches)
            diag_add(builder->errors, FBD_ERROR, "no-inertia", body->source->at, "give it a small mass",
                     "`%s` has no mass and can touch other bodies: an impact on it has no result",
                     body->name);
        else if (link->parent > 0 && link_joint(link)->count > 1)
            diag_add(builder->errors, FBD_ERROR, "no-inertia", body->source->at, "give it a small mass",
                     "`%s` has no mass and moves freely on a body that moves", body->name);
        else
            continue;
        return;
    }
}

static void check_holes(const struct body *body, fbd_errors *errors)
{
    const struct part *hole = outline_hole_outside(body);
    if (!hole) return;
    diag_add(errors, FBD_ERROR, "bad-inertia", hole->at, "check its `center`, in the frame of the body",
             "the hole `%s` of `%s` lies outside of the other parts: nothing can be cut out there",
             hole->name, body->name);
}

static void check_inertia(const struct model_body *body, fbd_errors *errors)
{
    const struct inertia *inertia = &body->inertia;
    struct pos at = body->source->at;
    bool turns = body->joint->angle >= 0;
    double least = turns ? coordinate_inertia(body, body->joint->angle) : inertia->mass;
    if (!isfinite(inertia->mass) || !isfinite(inertia->I_G) || (turns && !isfinite(least)))
        diag_add(errors, FBD_ERROR, "bad-inertia", at, "check for quantities near the limits of a double",
                 "the mass or moment of inertia of `%s` is not finite", body->name);
    else if (inertia->mass < 0 || (inertia->mass == 0 && !is_light(body)))
        diag_add(errors, FBD_ERROR, "bad-inertia", at,
                 "holes must have less mass than the parts that they are cut from",
                 "the total mass of `%s` is %g: it must be positive", body->name, inertia->mass);
    else if (inertia->I_G < 0)
        diag_add(errors, FBD_ERROR, "bad-inertia", at,
                 "does each hole lie within the body, and is it smaller?",
                 "the moment of inertia of `%s` about its centre of mass is %g: no body has that", body->name,
                 inertia->I_G);
    else if (turns && (least < 0 || (least == 0 && !is_light(body))))
        diag_add(errors, FBD_ERROR, "bad-inertia", at,
                 "give it a `shape`, `parts` or `inertia`, or let it move as a particle or on a slide",
                 "`%s` turns but has no moment of inertia about %s", body->name,
                 body->joint->has_axis ? "its pivot" : "its centre of mass");
}

static void set_body(struct model_body *body, const struct body *source, const struct scene *scene,
                     fbd_errors *errors)
{
    int n = (int)scene->coordinate_count;
    const struct motion *motion = &source->motion;
    *body = (struct model_body){.source = source,
                                .name = source->name,
                                .kind = motion->kind,
                                .joint = motion_joint(motion),
                                .first = source->first,
                                .count = source->count,
                                .first_rate = n + source->first,
                                .normal_slot = -1,
                                .parent = motion->parent,
                                .child = -1,
                                .sibling = -1,
                                .drive = -1,
                                .drive_pair = -1,
                                .varies = source->mass.expr != NULL,
                                .carried = -1,
                                .arrow_count = (int)source->load_count + 1,
                                .friction = -1};
    body->inertia = inertia_of_parts(source->parts, source->part_count, motion->point);
    if (body->joint->path == path_line) set_line(body);
    if (body->joint->path == path_curve) track_set_body(scene, body);
    if (body->joint->path != path_none) set_side(body, scene);
    if (body->joint->has_axis) {
        body->origin = motion->through;
        body->pin = motion->point;
        body->I_O = inertia_about(&body->inertia, motion->point);
    }
    body->arm = vec_sub(body->inertia.G, body->pin);
    body->L = vec_norm(body->arm);
    check_inertia(body, errors);
    check_holes(source, errors);
}

/* ---- loads */

static struct vec resolve_point(const struct point *point, const struct model_body *body)
{
    return point->kind == point_fixed ? point->where : body->inertia.G;
}

static void set_load(struct builder *builder, struct model_load *load, const struct load *source, int body)
{
    const struct fbd_model *model = builder->model;
    int index = (int)(load - model->loads);
    load->source = source;
    load->body = body;
    load->point = resolve_point(&source->point, &model->bodies[body]);
    load->linked =
        (source->kind == load_spring || source->kind == load_damper) && source->anchor.kind != point_absent;
    load->anchor = source->anchor.where;
    load->partner = -1;
    load->value = builder_formula(builder, &source->value, body, index);
    load->angle = builder_formula(builder, &source->angle, body, index);
    load->fx = builder_formula(builder, &source->fx, body, index);
    load->fy = builder_formula(builder, &source->fy, body, index);
    load->potential = builder_formula(builder, &source->potential, body, index);
    load->offset_x = builder_formula(builder, &source->offset_x, body, index);
    load->offset_y = builder_formula(builder, &source->offset_y, body, index);
    load->couple = builder_formula(builder, &source->couple, body, index);
    builder_formula(builder, &source->zero_distance, body, index); /* for its pole */
}

static void set_loads(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    int next = 0;
    for (size_t b = 0; b < model->body_count; b++) {
        struct model_body *body = &model->bodies[b];
        body->first_load = next;
        body->load_count = (int)body->source->load_count;
        for (int i = 0; i < body->load_count; i++, next++)
            set_load(builder, &model->loads[next], &body->source->loads[i], (int)b);
    }
}

/* A coupling is a load of the body at its first end that is not the ground; the opposite force acts at the
 * other end. */
static void set_couplings(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    for (size_t c = 0; c < model->scene->force_coupling_count; c++) {
        const struct force_coupling *coupling = &model->scene->force_couplings[c];
        struct model_load *load = &model->loads[model->listed_count + c];
        int first = coupling->body[0] == ground_body, other = coupling->body[1 - first];
        set_load(builder, load, &coupling->load, coupling->body[first]);
        load->linked = true;
        load->partner = other;
        load->point = resolve_point(&coupling->point[first], &model->bodies[load->body]);
        load->anchor = other == ground_body
                           ? coupling->point[1 - first].where
                           : resolve_point(&coupling->point[1 - first], &model->bodies[other]);
    }
}

/* Name the friction force of rolling bodies and the force of ropes, for events and their work. */
static bool set_named_couplings(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    size_t next = model->coupled_count;
    for (size_t c = 0; c < model->scene->constraint_count; c++) {
        const struct constraint *constraint = &model->scene->constraints[c];
        if (!constraint_has_load(constraint)) continue;
        struct load *source = ARENA_ARRAY(&model->arena, 1, struct load);
        if (!source) return false;
        const struct constraint_law *law = &constraint_laws[constraint->kind];
        bool rubs =
            law->load_kind == load_normal && (constraint->mu_s.expr || constraint->surface_speed.expr);
        source->kind = rubs ? load_friction : law->load == no_load ? load_rope : law->load_kind;
        source->name = law->load_name ? arena_printf(&model->arena, "%s%s", constraint->name, law->load_name)
                                      : constraint->name;
        source->at = constraint->at;
        source->reels = constraint->reel.expr != NULL;
        set_load(builder, &model->loads[next++], source, constraint_first_body(constraint));
    }
    return true;
}

/* Name the force of each prescribed motion. */
static bool set_drives(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    size_t next = model->load_count;
    for (size_t b = 0; b < model->body_count; b++) next -= model->bodies[b].varies;
    for (size_t b = model->body_count; b-- > 0;) {
        struct model_body *body = &model->bodies[b];
        if (!body->source->motion.prescribed.expr) continue;
        struct load *source = ARENA_ARRAY(&model->arena, 1, struct load);
        if (!source) return false;
        *source = (struct load){.kind = load_drive, .name = "drive", .at = body->source->motion.at};
        body->drive = (int)--next;
        body->arrow_count++;
        body->drive_on_parent = arena_printf(&model->arena, "%s.drive", body->name);
        if (body->parent >= 0) model->bodies[body->parent].arrow_count++;
        set_load(builder, &model->loads[next], source, (int)b);
    }
    return true;
}

/* Name the energy carried by each varying mass. */
static bool set_carried(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    size_t next = model->load_count;
    for (size_t b = model->body_count; b-- > 0;) {
        struct model_body *body = &model->bodies[b];
        if (!body->varies) continue;
        struct load *source = ARENA_ARRAY(&model->arena, 1, struct load);
        if (!source) return false;
        *source = (struct load){.kind = load_carried, .name = "mass", .at = body->source->mass.at};
        body->carried = (int)--next;
        set_load(builder, &model->loads[next], source, (int)b);
        body->mass = builder_formula(builder, &body->source->mass, (int)b, (int)next);
        const struct formula inverse = {.expr = body->source->inverse_mass.expr,
                                        .branch = -1}; /* unchanged */
        add_pole(builder, &(struct pole){inverse, (int)b, (int)next, -1, expr_poles(inverse.expr)});
    }
    return true;
}

static bool set_absolutes(struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    model->absolute_count = scene->absolute_count;
    model->absolutes = ARENA_ARRAY(&model->arena, model->absolute_count, struct model_absolute);
    for (size_t k = 0; model->absolutes && k < model->absolute_count; k++) {
        const struct absolute *absolute = &scene->absolutes[k];
        struct vec point = resolve_point(&absolute->point, &model->bodies[absolute->body]);
        const bool reacts = absolute->kind == absolute_reaction;
        model->absolutes[k] =
            (struct model_absolute){.body = absolute->body,
                                    .point = point,
                                    .kind = absolute->kind,
                                    .coordinate = absolute->kind == absolute_input
                                                      ? absolute->part
                                                      : model->bodies[absolute->body].first + absolute->part,
                                    .pair = -1,
                                    .part = (enum reaction_part)(reacts ? absolute->part : 0),
                                    .load = -1};
        model->names_places |= absolute->moves;
        model->names_poses |=
            absolute->moves && absolute->kind != absolute_slip && absolute->kind != absolute_input && !reacts;
        model->names_reactions |= reacts;
    }
    return model->absolutes != NULL;
}

static bool set_output_points(struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    model->output_points = ARENA_ARRAY(&model->arena, scene->output_point_count, struct vec);
    for (size_t k = 0; model->output_points && k < scene->output_point_count; k++)
        model->output_points[k] =
            resolve_point(&scene->output_points[k].point, &model->bodies[scene->output_points[k].body]);
    return model->output_points != NULL;
}

/* ---- the whole */

static bool allocate(struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    model->body_count = scene->body_count;
    for (size_t b = 0; b < scene->body_count; b++) model->listed_count += scene->bodies[b].load_count;
    model->coupled_count = model->listed_count + scene->force_coupling_count;
    model->load_count = model->coupled_count;
    for (size_t c = 0; c < scene->constraint_count; c++)
        model->load_count += constraint_has_load(&scene->constraints[c]);
    for (size_t b = 0; b < scene->body_count; b++)
        model->load_count += (size_t)(scene->bodies[b].motion.prescribed.expr != NULL) +
                             (size_t)(scene->bodies[b].mass.expr != NULL);
    model->bodies = ARENA_ARRAY(&model->arena, model->body_count, struct model_body);
    model->loads = ARENA_ARRAY(&model->arena, model->load_count, struct model_load);
    model->plan.rates = ARENA_ARRAY(&model->arena, scene->own_count, struct formula);
    model->plan.watches = ARENA_ARRAY(&model->arena, scene->event_count, struct watch);
    return !model->arena.failed;
}

static void set_rates(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    for (int i = 0; i < (int)model->scene->own_count; i++)
        model->plan.rates[i] = builder_rate(builder, &model->scene->own[i].rate, i);
}

/* User events come last, so that loads have the first branches. */
static void set_watches(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    const struct scene *scene = model->scene;
    for (size_t i = 0; i < scene->event_count; i++) {
        const struct user_event *event = &scene->events[i];
        struct value left = {.expr = event->left, .at = event->at},
                     right = {.expr = event->right, .at = event->at};
        struct watch *watch = &model->plan.watches[model->plan.watch_count++];
        watch->source = event;
        watch->left = builder_formula(builder, &left, -1, -1);
        watch->right = builder_formula(builder, &right, -1, -1);
    }
}

static bool set_labels(struct fbd_model *model, bool labels, const struct fbd_model *like)
{
    const struct scene *scene = model->scene;
    model->own_labels = like ? like->own_labels : own_labels_make(&model->arena, scene);
    if (like)
        model->labels = like->labels;
    else if (labels)
        model->labels = labels_make(&model->arena, scene);
    return model->own_labels && (model->labels || !labels);
}

/* With `memory` the arrays of the model are there, and else in an arena of its own. */
static struct fbd_model *compile(struct scene *scene, bool labels, const struct fbd_model *like,
                                 struct arena *memory, fbd_errors *errors)
{
    struct fbd_model *model = calloc(1, sizeof *model);
    if (!model) {
        diag_out_of_memory(errors);
        if (!like) scene_free(scene);
        return NULL;
    }
    model->scene = scene;
    model->scene_lent = model->arena.much_room = like != NULL;
    if (memory) model->arena = *memory;
    struct builder builder = {.model = model, .errors = errors};
    bool done = allocate(model);
    for (size_t b = 0; done && b < scene->body_count; b++)
        if (scene->bodies[b].complete) set_body(&model->bodies[b], &scene->bodies[b], scene, errors);
    if (done && fbd_errors_failed_count(errors) == 0) {
        for (size_t b = 0; b < scene->body_count; b++) model->assembles |= scene->bodies[b].assemble;
        set_loads(&builder);
        set_couplings(&builder);
        done = set_labels(model, labels, like) && set_named_couplings(&builder) && set_drives(&builder) &&
               set_carried(&builder) && set_absolutes(model) && slots_find_constant(model) &&
               set_output_points(model) && tree_number(model) && tracks_set(&builder) &&
               tree_name_reactions(model) && arrows_name(model) && plan_build(&builder) &&
               classify_loads(&builder);
        if (done) check_massless(&builder);
        set_rates(&builder);
        set_watches(&builder);
        if (done) done = slips_find(model);
        if (done) {
            reactions_find(model);
            slides_find(model);
        }
        done = done && !model->arena.failed;
    }
    if (!done) diag_out_of_memory(errors);
    if (memory) {
        *memory = model->arena;
        model->arena = (struct arena){0};
    }
    if (fbd_errors_failed_count(errors) > 0) {
        model_free(model);
        return NULL;
    }
    return model;
}

struct fbd_model *model_compile(struct scene *scene, fbd_errors *errors)
{
    return compile(scene, true, NULL, NULL, errors);
}

struct fbd_model *model_compile_group(struct scene *scene, struct arena *memory, fbd_errors *errors)
{
    return compile(scene, false, NULL, memory, errors);
}

struct fbd_model *model_compile_again(struct scene *scene, const struct fbd_model *like, fbd_errors *errors)
{
    return compile(scene, true, like, NULL, errors);
}

void model_free(struct fbd_model *model)
{
    if (!model) return;
    if (!model->scene_lent) scene_free(model->scene);
    free(model->source);
    arena_free(&model->arena);
    free(model);
}
