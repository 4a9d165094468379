/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The modes of couplings: rolling bodies that stick or slip, ropes that are taut or slack, prescribed joints.
 * They stand with the pairs of dry friction, so that one list of modes serves all.
 */
#include "model/builder.h"

/* Dry friction along the surface of a tie. */
static void add_rubbing(struct builder *builder, struct tie *tie)
{
    struct plan *plan = &builder->model->plan;
    const struct constraint *source = &builder->model->scene->constraints[tie->constraint];
    int body = constraint_first_body(&builder->model->scene->constraints[tie->constraint]);
    tie->pair = (int)plan->friction_count;
    plan->frictions[plan->friction_count++] =
        (struct friction){.body = body,
                          .load = tie->load,
                          .normal_slot = tie->normal_slot,
                          .mu_s = builder_formula(builder, &source->mu_s, body, tie->load),
                          .mu_k = builder_formula(builder, &source->mu_k, body, tie->load),
                          .surface_speed = formula_constant(0),
                          .hold_slot = plan->slots++,
                          .tie = (int)(tie - builder->model->tree->ties),
                          .jointed = true};
}

/* A surface that presses or is left. */
static void add_surface(struct builder *builder, struct tie *tie, enum mode_kind kind)
{
    struct plan *plan = &builder->model->plan;
    int body = constraint_first_body(&builder->model->scene->constraints[tie->constraint]);
    tie->normal_slot = plan->slots++;
    tie->surface = (int)plan->friction_count;
    plan->contacts[plan->contact_count++] = (struct contact){body, tie->load, tie->normal_slot, tie->surface};
    plan->frictions[plan->friction_count++] =
        (struct friction){.kind = kind,
                          .body = body,
                          .load = tie->load,
                          .normal_slot = -1,
                          .hold_slot = 0,
                          .tie = (int)(tie - builder->model->tree->ties),
                          .jointed = true};
}

/* A rolling body presses on its line, and its friction, when it has coefficients, sticks or slips. */
static void plan_roll(struct builder *builder, struct tie *tie)
{
    add_surface(builder, tie, mode_surface);
    if (builder->model->scene->constraints[tie->constraint].mu_s.expr) add_rubbing(builder, tie);
}

/* A contact is closed or open, and rubs while it is closed. */
static void plan_contact(struct builder *builder, struct tie *tie)
{
    add_surface(builder, tie, mode_contact);
    if (builder->model->scene->constraints[tie->constraint].mu_s.expr) add_rubbing(builder, tie);
}

/* A rope is taut or slack. */
static void plan_rope(struct builder *builder, struct tie *tie)
{
    struct fbd_model *model = builder->model;
    struct plan *plan = &model->plan;
    int first = 0;
    while (tie->end[first].body < 0) first++; /* a piece begins or ends at a body */
    tie->pair = (int)plan->friction_count;
    plan->frictions[plan->friction_count++] = (struct friction){.kind = mode_rope,
                                                                .body = tie->end[first].body,
                                                                .load = tie->load,
                                                                .normal_slot = -1,
                                                                .hold_slot = 0,
                                                                .tie = (int)(tie - model->tree->ties),
                                                                .jointed = true};
    if (!tie->reels) return;
    tie->reel = builder_formula(builder, &model->scene->constraints[tie->constraint].reel,
                                tie->end[first].body, tie->load);
    tie->length = expr_eval(tie->reel.expr, 0, NULL, NULL);
}

/* No strand of a belt pushes. What does not move with the axes is a pull between them that is known, of a spring that
 * keeps its length (gear_check.c). */
static void plan_belt(struct fbd_model *model, struct tie *tie)
{
    struct plan *plan = &model->plan;
    for (int k = 0; k < 2; k++) {
        tie->slack_slot[k] = plan->slots++;
        plan->contacts[plan->contact_count++] =
            (struct contact){tie->end[0].body, tie->load, tie->slack_slot[k], -1};
    }
}

/* What lies on one side of its slot comes off where that would have to pull. */
static void plan_slot(struct fbd_model *model, struct tie *tie)
{
    struct plan *plan = &model->plan;
    tie->normal_slot = plan->slots++;
    plan->contacts[plan->contact_count++] =
        (struct contact){constraint_first_body(&model->scene->constraints[tie->constraint]), tie->load,
                         tie->normal_slot, -1};
}

/* A prescribed motion is a joint that sticks to a surface which moves so. */
static void plan_drive(struct builder *builder, struct model_body *body)
{
    struct plan *plan = &builder->model->plan;
    int b = (int)(body - builder->model->bodies);
    if (body->drive < 0) return;
    body->drive_pair = (int)plan->friction_count;
    plan->frictions[plan->friction_count++] =
        (struct friction){.kind = mode_drive,
                          .body = b,
                          .load = body->drive,
                          .coordinate = body->first,
                          .normal_slot = -1,
                          .hold_slot = plan->slots++,
                          .tie = -1,
                          .position =
                              builder_formula(builder, &body->source->motion.prescribed, b, body->drive),
                          .jointed = true};
}

void plan_ties(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    int load = (int)model->coupled_count - 1, last = -1;
    for (int i = 0; model->tree && i < model->tree->tie_count; i++) {
        struct tie *tie = &model->tree->ties[i];
        bool named = constraint_has_load(&model->scene->constraints[tie->constraint]);
        if (!named) continue;
        if (tie->constraint != last)
            load++; /* the pieces of a rope share one, and the features of a contact */
        last = tie->constraint;
        tie->load = load;
        if (tie->kind == constraint_roll || tie->kind == constraint_capstan)
            plan_roll(builder, tie);
        else if (tie->kind == constraint_contact)
            plan_contact(builder, tie);
        else if (tie->kind == constraint_belt)
            plan_belt(model, tie);
        else if (tie->kind == constraint_slot)
            plan_slot(model, tie);
        else
            plan_rope(builder, tie);
    }
    for (size_t b = 0; b < model->body_count; b++) plan_drive(builder, &model->bodies[b]);
}
