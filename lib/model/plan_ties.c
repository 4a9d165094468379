/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The modes of couplings: rolling bodies that stick or slip, ropes that are taut or slack, prescribed joints.
 * They stand with the pairs of dry friction, so that one list of modes serves all.
 */
#include "model/builder.h"

/* A mode of a tie, without a normal force; returns its index among them. */
static int add_mode(struct builder *builder, const struct tie *tie, enum mode_kind kind, int body)
{
    struct plan *plan = &builder->model->plan;
    int tie_index = (int)(tie - builder->model->tree->ties);
    plan->modes[plan->mode_count] =
        (struct mode){.kind = kind, .body = body, .load = tie->load, .normal_slot = -1, .tie = tie_index};
    return (int)plan->mode_count++;
}

/* Dry friction along the surface of a tie. */
static void add_rubbing(struct builder *builder, struct tie *tie)
{
    struct plan *plan = &builder->model->plan;
    int body = constraint_first_body(tie->source);
    tie->pair = add_mode(builder, tie, mode_tangent, body);
    struct mode *mode = &plan->modes[tie->pair];
    mode->normal_slot = tie->normal_slot;
    mode->hold_slot = plan->slots++;
    mode->mu_s = builder_formula(builder, &tie->source->mu_s, body, tie->load);
    mode->mu_k = builder_formula(builder, &tie->source->mu_k, body, tie->load);
}

/* A surface, or what lies on one side of its slot, is pressed on or left, and rubs while it is closed, where it has coefficients. */
static void plan_surface(struct builder *builder, struct tie *tie)
{
    struct plan *plan = &builder->model->plan;
    int body = constraint_first_body(tie->source);
    tie->normal_slot = plan->slots++;
    tie->surface = add_mode(builder, tie, tie->meeting < 0 ? mode_surface : mode_contact, body);
    plan->contacts[plan->contact_count++] = (struct contact){body, tie->load, tie->normal_slot, tie->surface};
    if (tie->source->mu_s.expr) add_rubbing(builder, tie);
}

/* A rope is taut or slack. */
static void plan_rope(struct builder *builder, struct tie *tie)
{
    int first = 0;
    while (tie->end[first].body < 0) first++; /* a piece begins or ends at a body */
    tie->pair = add_mode(builder, tie, mode_rope, tie->end[first].body);
    if (!tie->reels) return;
    tie->reel = builder_formula(builder, &tie->source->reel, tie->end[first].body, tie->load);
    tie->length = expr_eval(tie->reel.expr, 0, NULL, NULL);
}

/* No strand of a belt pushes. What does not move with the axes is a pull between them that is known, of a spring that
 * keeps its length (gear_check.c). */
static void plan_belt(struct builder *builder, struct tie *tie)
{
    struct plan *plan = &builder->model->plan;
    tie->strands = 2;
    for (int k = 0; k < tie->strands; k++) {
        tie->slack_slot[k] = plan->slots++;
        plan->contacts[plan->contact_count++] =
            (struct contact){tie->end[0].body, tie->load, tie->slack_slot[k], -1};
    }
}

/* A slot that holds on both sides rubs on the one that presses, by mu |N|; on one side it is a surface. */
static void plan_groove(struct builder *builder, struct tie *tie)
{
    if (tie->source->presses != 0) {
        plan_surface(builder, tie);
        return;
    }
    tie->normal_slot = builder->model->plan.slots++;
    add_rubbing(builder, tie);
    builder->model->plan.modes[tie->pair].two_sided = true;
}

/* A prescribed motion is a joint that sticks to a surface which moves so. */
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
                      .tie = -1,
                      .position = builder_formula(builder, &body->source->motion.prescribed, b, body->drive)};
}

/* What opens, closes, sticks or must not pull, by kind. */
static void (*const plans[constraint_kinds])(struct builder *builder, struct tie *tie) = {
    [constraint_roll] = plan_surface,    [constraint_slot] = plan_surface,
    [constraint_groove] = plan_groove,   [constraint_belt] = plan_belt,
    [constraint_capstan] = plan_surface, [constraint_rope] = plan_rope,
    [constraint_contact] = plan_surface,
};

void plan_ties(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    int load = (int)model->coupled_count - 1, last = -1;
    for (int i = 0; model->tree && i < model->tree->tie_count; i++) {
        struct tie *tie = &model->tree->ties[i];
        if (!constraint_has_load(tie->source)) continue;
        if (tie->constraint != last)
            load++; /* the pieces of a rope share one, and the features of a contact */
        last = tie->constraint;
        tie->load = load;
        plans[tie->kind](builder, tie);
    }
    for (size_t b = 0; b < model->body_count; b++) plan_drive(builder, &model->bodies[b]);
}
