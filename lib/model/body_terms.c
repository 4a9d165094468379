/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The plan body by body: the range of every list that belongs to a body, and the variables of its forces.
 */
#include "model/builder.h"

static unsigned slot_depends(const struct model_body *body, int slot)
{
    int index = slot - 1;
    bool own = index >= body->first && index < body->first + body->count;
    bool own_rate = index >= body->first_rate && index < body->first_rate + body->count;
    return own ? depends_place : own_rate ? depends_rate : depends_other;
}

unsigned formula_depends(const struct model_body *body, const struct formula *formula)
{
    if (formula_is_constant(formula)) return 0;
    const int *slots;
    size_t count = expr_variables(formula->expr, &slots);
    unsigned on = expr_uses_time(formula->expr) ? depends_time : 0;
    for (size_t i = 0; i < count; i++) on |= slot_depends(body, slots[i]);
    return on;
}

/* True if a slot is the slip velocity of the body on its surface. */
static bool is_own_slip(const struct fbd_model *model, const struct model_body *body, int slot)
{
    int first = 1 + (int)plan_size(&model->plan) + hand_slots;
    const struct absolute *absolute = slot < first ? NULL : &model->scene->absolutes[slot - first];
    return absolute && absolute->kind == absolute_slip && absolute->roll == 0 &&
           &model->bodies[absolute->body] == body;
}

/* Variables of kinetic friction; if its law depends on the slip, also those of the surface speed. */
static unsigned friction_depends(const struct fbd_model *model, const struct model_body *body,
                                 const struct mode *mode)
{
    if (formula_is_constant(&mode->mu_k)) return 0;
    const int *slots;
    size_t count = expr_variables(mode->mu_k.expr, &slots);
    unsigned on = expr_uses_time(mode->mu_k.expr) ? depends_time : 0;
    for (size_t i = 0; i < count; i++)
        on |= is_own_slip(model, body, slots[i]) ? depends_rate | formula_depends(body, &mode->surface_speed)
                                                 : slot_depends(body, slots[i]);
    return on;
}

/* ---- lists that are filled body by body */

static void ranges_start(const struct plan *plan, struct body_terms *terms)
{
    terms->square.first = (int)plan->square_count;
    terms->formulas.first = (int)plan->formula_count;
    terms->potentials.first = (int)plan->potential_count;
    terms->links.first = (int)plan->link_count;
    terms->drags.first = (int)plan->drag_count;
    terms->forces.first = (int)plan->force_count;
}

static void ranges_end(const struct plan *plan, struct body_terms *terms)
{
    terms->square.count = (int)plan->square_count - terms->square.first;
    terms->formulas.count = (int)plan->formula_count - terms->formulas.first;
    terms->potentials.count = (int)plan->potential_count - terms->potentials.first;
    terms->links.count = (int)plan->link_count - terms->links.first;
    terms->drags.count = (int)plan->drag_count - terms->drags.first;
    terms->forces.count = (int)plan->force_count - terms->forces.first;
    terms->at_points = terms->links.count + terms->drags.count + terms->forces.count > 0;
}

/* Stable sort by slot, so that the formulas of a coordinate are contiguous. */
static void sort_formulas(struct formula_term *terms, int count)
{
    for (int i = 1; i < count; i++) {
        struct formula_term moved = terms[i];
        int k = i;
        for (; k > 0 && terms[k - 1].slot > moved.slot; k--) terms[k] = terms[k - 1];
        terms[k] = moved;
    }
}

void body_terms_add(struct builder *builder, int b)
{
    struct fbd_model *model = builder->model;
    struct model_body *body = &model->bodies[b];
    struct body_terms *terms = &model->plan.bodies[b];
    ranges_start(&model->plan, terms);
    for (int i = 0; i < body->load_count; i++) plan_load(builder, body, body->first_load + i);
    ranges_end(&model->plan, terms);
    sort_formulas(model->plan.formulas + terms->formulas.first, terms->formulas.count);
}

/* ---- lists in the order of the slots: take the entries below slot `end` from index `*next` on, and advance
 * it */

static struct range take_affine(const struct plan *plan, int *next, int end)
{
    struct range range = {*next, 0};
    while (*next < (int)plan->affine_count && plan->affine[*next].slot < end) (*next)++;
    range.count = *next - range.first;
    return range;
}

static struct range take_sine(const struct plan *plan, int *next, int end)
{
    struct range range = {*next, 0};
    while (*next < (int)plan->sine_count && plan->sine[*next].slot < end) (*next)++;
    range.count = *next - range.first;
    return range;
}

static void take_slots(struct fbd_model *model)
{
    struct plan *plan = &model->plan;
    int affine = 0, sine = 0;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        plan->bodies[b].affine = take_affine(plan, &affine, body->first + body->count);
        plan->bodies[b].sine = take_sine(plan, &sine, body->first + body->count);
    }
    for (size_t b = 0; b < model->body_count; b++) /* normal slots follow the coordinates */
        if (model->bodies[b].normal_slot >= 0)
            plan->bodies[b].across = take_affine(plan, &affine, model->bodies[b].normal_slot + 1);
}

/* ---- variables of a body's forces */

static unsigned simple_depends(const struct plan *plan, const struct body_terms *terms)
{
    unsigned on = terms->square.count > 0 ? depends_rate : 0;
    if (terms->sine.count > 0) on |= depends_place;
    for (int i = terms->affine.first; i < terms->affine.first + terms->affine.count; i++) {
        if (plan->affine[i].kq != 0) on |= depends_place;
        if (plan->affine[i].kv != 0) on |= depends_rate;
    }
    return on;
}

static unsigned formula_terms_depend(const struct fbd_model *model, const struct model_body *body,
                                     const struct body_terms *terms)
{
    const struct plan *plan = &model->plan;
    unsigned on = 0;
    for (int i = terms->formulas.first; i < terms->formulas.first + terms->formulas.count; i++)
        on |= formula_depends(body, &plan->formulas[i].value);
    for (int i = terms->potentials.first; i < terms->potentials.first + terms->potentials.count; i++)
        on |= formula_depends(body, &plan->potentials[i].V);
    if (terms->friction >= 0) on |= friction_depends(model, body, &plan->modes[terms->friction]);
    return on;
}

static unsigned point_terms_depend(const struct plan *plan, const struct model_body *body,
                                   const struct body_terms *terms)
{
    unsigned on = terms->links.count > 0 ? depends_place : 0;
    for (int i = terms->links.first; i < terms->links.first + terms->links.count; i++)
        if (plan->links[i].damping != 0) on |= depends_rate;
    bool turns = body->kind == motion_pivot || body->kind == motion_planar;
    if (terms->drags.count > 0) on |= turns ? depends_place | depends_rate : depends_rate;
    for (int i = terms->forces.first; i < terms->forces.first + terms->forces.count; i++)
        on |= (turns ? depends_place : 0) | formula_depends(body, &plan->forces[i].value) |
              formula_depends(body, &plan->forces[i].angle);
    return on;
}

/* A single sine term may need the sine or the cosine only. */
static bool needs_both(const struct plan *plan, const struct model_body *body, const struct body_terms *terms)
{
    const struct sine_term *sine = &plan->sine[terms->sine.first];
    if (body->place.link > 0) return false; /* its link holds them */
    return terms->sine.count > 1 || (terms->sine.count == 1 && sine->s != 0 && sine->c != 0) ||
           terms->offset >= 0 ||
           (terms->at_points && (body->kind == motion_pivot || body->kind == motion_planar));
}

/* True if the body has a term in the lists of the plan. */
static bool has_terms(const struct body_terms *terms)
{
    return terms->affine.count + terms->sine.count + terms->square.count + terms->formulas.count +
               terms->potentials.count + terms->links.count + terms->drags.count + terms->forces.count +
               terms->across.count >
           0;
}

static void list_acting(struct fbd_model *model)
{
    struct tree *tree = model->tree;
    for (int b = 0; b < (int)model->body_count; b++)
        if (model->bodies[b].place.link == 0 || has_terms(&model->plan.bodies[b]))
            tree->acting[tree->acting_count++] = b;
}

void body_terms_finish(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    struct plan *plan = &model->plan;
    take_slots(model);
    for (size_t b = 0; b < model->body_count; b++) {
        plan->bodies[b].friction = model->bodies[b].friction;
        plan->bodies[b].offset = -1;
    }
    for (size_t i = 0; i < plan->offset_count; i++) plan->bodies[plan->offsets[i].body].offset = (int)i;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct body_terms *terms = &plan->bodies[b];
        terms->depends = simple_depends(plan, terms) | formula_terms_depend(model, body, terms) |
                         point_terms_depend(plan, body, terms);
        terms->turns = needs_both(plan, body, terms);
        if (terms->offset >= 0) terms->depends |= depends_place | depends_rate; /* omega^2 r */
    }
    if (model->tree) list_acting(model);
}
