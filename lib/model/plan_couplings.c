/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The modes of couplings: rolling bodies that stick or slip, ropes that are taut or slack, prescribed joints.
 * They are in one list with the modes of dry friction.
 */
#include "model/builder.h"
#include "numeric/tolerances.h"

/* Add a mode of a coupling, without a normal force; returns its index. */
static int add_mode(struct builder *builder, const struct coupling *coupling, enum mode_kind kind, int body)
{
    struct plan *plan = &builder->model->plan;
    int coupling_index = (int)(coupling - builder->model->tree->couplings);
    plan->modes[plan->mode_count] = (struct mode){
        .kind = kind, .body = body, .load = coupling->load, .normal_slot = -1, .coupling = coupling_index};
    return (int)plan->mode_count++;
}

/* Dry friction along the surface of a coupling. */
static void add_rubbing(struct builder *builder, struct coupling *coupling)
{
    struct plan *plan = &builder->model->plan;
    int body = constraint_first_body(coupling->source);
    coupling->pair = add_mode(builder, coupling, mode_tangent, body);
    struct mode *mode = &plan->modes[coupling->pair];
    mode->normal_slot = coupling->normal_slot;
    mode->hold_slot = plan->slots++;
    mode->mu_s = builder_formula(builder, &coupling->source->mu_s, body, coupling->load);
    mode->mu_k = builder_formula(builder, &coupling->source->mu_k, body, coupling->load);
}

/* Add the modes of a surface or one-sided slot: closed or open, and friction while it is closed, where it has
 * coefficients. */
static void plan_surface(struct builder *builder, struct coupling *coupling)
{
    struct plan *plan = &builder->model->plan;
    int body = constraint_first_body(coupling->source);
    coupling->normal_slot = plan->slots++;
    coupling->surface =
        add_mode(builder, coupling, coupling->meeting < 0 ? mode_surface : mode_contact, body);
    plan->contacts[plan->contact_count++] =
        (struct contact){body, coupling->load, coupling->normal_slot, coupling->surface};
    if (coupling->source->mu_s.expr) add_rubbing(builder, coupling);
    coupling->moves = coupling->source->surface_speed.expr != NULL;
    coupling->surface_speed =
        builder_formula(builder, &coupling->source->surface_speed, body, coupling->load);
}

/* Rolling resistance is friction with the normal force of its roll, that of a gear with the force of its teeth, which has
 * either sign. */
static void plan_resistance(struct builder *builder, struct coupling *coupling)
{
    struct coupling *of = coupling - 1;
    const bool gear = of->kind == constraint_gear;
    if (gear) of->normal_slot = builder->model->plan.slots++;
    coupling->normal_slot = of->normal_slot;
    coupling->surface = of->surface;
    add_rubbing(builder, coupling);
    builder->model->plan.modes[coupling->pair].moment = true;
    builder->model->plan.modes[coupling->pair].two_sided = gear;
}

/* A rope is taut or slack. */
static void plan_rope(struct builder *builder, struct coupling *coupling)
{
    int first = 0;
    while (coupling->end[first].body < 0) first++; /* a piece begins or ends at a body */
    coupling->pair = add_mode(builder, coupling, mode_rope, coupling->end[first].body);
    if (!coupling->reels) return;
    coupling->reel =
        builder_formula(builder, &coupling->source->reel, coupling->end[first].body, coupling->load);
    coupling->length = expr_eval(coupling->reel.expr, 0, NULL, NULL);
}

/* The strand tensions of a belt must not become negative. Their mean between fixed axes is a known force,
 * that of a spring of constant length (gear_check.c). */
static void plan_belt(struct builder *builder, struct coupling *coupling)
{
    struct plan *plan = &builder->model->plan;
    coupling->strands = 2;
    for (int k = 0; k < coupling->strands; k++) {
        coupling->slack_slot[k] = plan->slots++;
        plan->contacts[plan->contact_count++] =
            (struct contact){coupling->end[0].body, coupling->load, coupling->slack_slot[k], -1};
    }
}

/* A two-sided slot has friction mu |N|; a one-sided slot is a surface. */
static void plan_groove(struct builder *builder, struct coupling *coupling)
{
    if (coupling->source->presses != 0) {
        plan_surface(builder, coupling);
        return;
    }
    coupling->normal_slot = builder->model->plan.slots++;
    add_rubbing(builder, coupling);
    builder->model->plan.modes[coupling->pair].two_sided = true;
}

/* A negligible speed, per force: that of the body after 1e-10 of the run. */
static double soft_of(const struct fbd_model *model, int body)
{
    const struct value *until = &model->scene->simulate.until;
    const double time = until->expr ? expr_value(until->expr) : 1, mass = model->bodies[body].inertia.mass;
    return mass > 0 ? soft_part * time / mass : 0;
}

/* Friction on a plane: its normal force is known. */
static void plan_plane(struct builder *builder, struct coupling *coupling)
{
    const struct fbd_model *model = builder->model;
    const struct constraint *source = coupling->source;
    const int body = source->body[0];
    coupling->normal_slot = -1;
    add_rubbing(builder, coupling);
    builder->model->plan.modes[coupling->pair].kind = mode_plane;
    coupling->normal = source->normal.expr
                           ? builder_formula(builder, &source->normal, body, coupling->load)
                           : formula_constant(model->bodies[body].inertia.mass * model->scene->pressing);
    coupling->share = plane_share(builder, source);
    coupling->soft = soft_of(model, body);
}

/* A prescribed motion is a joint that sticks to a surface with that motion. */
static void plan_drive(struct builder *builder, struct model_body *body)
{
    struct plan *plan = &builder->model->plan;
    int b = (int)(body - builder->model->bodies);
    if (body->drive < 0) return;
    body->drive_pair = (int)plan->mode_count;
    plan->modes[plan->mode_count++] =
        (struct mode){.kind = mode_drive,
                      .body = b,
                      .load = body->drive,
                      .coordinate = body->first,
                      .normal_slot = -1,
                      .hold_slot = plan->slots++,
                      .coupling = -1,
                      .position = builder_formula(builder, &body->source->motion.prescribed, b, body->drive)};
}

/* Add the modes of a coupling, by kind. */
static void (*const plans[constraint_kinds])(struct builder *builder, struct coupling *coupling) = {
    [constraint_roll] = plan_surface,    [constraint_slot] = plan_surface,
    [constraint_groove] = plan_groove,   [constraint_belt] = plan_belt,
    [constraint_capstan] = plan_surface, [constraint_rope] = plan_rope,
    [constraint_contact] = plan_surface, [constraint_resistance] = plan_resistance,
    [constraint_plane] = plan_plane,
};

void plan_couplings(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    int load = (int)model->coupled_count - 1, last = -1;
    for (int i = 0; i < model->tree->coupling_count; i++) {
        struct coupling *coupling = &model->tree->couplings[i];
        if (!constraint_has_load(coupling->source)) continue;
        if (coupling->constraint != last)
            load++; /* the pieces of a rope share one, as do the features of a contact */
        last = coupling->constraint;
        coupling->load = load;
        if (plans[coupling->kind]) plans[coupling->kind](builder, coupling);
    }
    for (size_t b = 0; b < model->body_count; b++) plan_drive(builder, &model->bodies[b]);
}
