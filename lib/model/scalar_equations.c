/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scalar equations, collected from the loads of the tree. A direction that does not turn makes a formula a
 * scaled term; a spring between points, a force fixed in the world on a turning body, and a potential do not
 * fit.
 */
#include "model/builder.h"

/* Both passes go through the same loads: the first counts the formulas of each body, the second adds them. */
struct pass {
    struct fbd_model *model;
    bool adds;
};

static struct scalar_equation *equation_of(const struct fbd_model *model, int link)
{
    return link > 0 ? &model->plan.equations[model->tree->links[link].body] : NULL;
}

static const struct model_body *body_of(const struct fbd_model *model, int link)
{
    return &model->bodies[model->tree->links[link].body];
}

/* Components of a force on a slide: along it, and to the side of its surface. The frame of the body lies along the
 * line. */
static struct vec along_and_across(const struct fbd_model *model, int link, struct vec f, bool body_frame)
{
    const struct model_body *body = body_of(model, link);
    if (!body_frame) return (struct vec){vec_dot(f, body->e), vec_dot(f, body->n)};
    return (struct vec){f.x, f.y * model->tree->links[link].side};
}

static void take_formula(const struct pass *pass, struct scalar_equation *equation, int slot, double scale,
                         const struct formula *value)
{
    if (scale == 0) return;
    int place = equation->formulas.first + equation->formulas.count++;
    if (pass->adds) pass->model->plan.formulas[place] = (struct formula_term){slot, scale, *value};
}

static void take_force(const struct pass *pass, const struct tree_force *force)
{
    const struct model_body *body = body_of(pass->model, force->link);
    struct scalar_equation *equation = equation_of(pass->model, force->link);
    if (!equation->known) return;
    bool turns = body->kind == motion_pivot;
    if (!formula_is_constant(&force->angle) || (turns && !force->body_frame)) {
        equation->known = false;
        return;
    }
    struct vec d = vec_unit(force->angle.constant + (force->body_frame ? force->turn : 0));
    if (turns) {
        take_formula(pass, equation, body->first, vec_cross(force->point, d), &force->value);
        return;
    }
    struct vec share = along_and_across(pass->model, force->link, d, force->body_frame);
    take_formula(pass, equation, body->first, share.x, &force->value);
    if (body->normal_slot >= 0) take_formula(pass, equation, body->normal_slot, share.y, &force->value);
}

static void take_moment(const struct pass *pass, const struct tree_moment *moment)
{
    const struct model_body *body = body_of(pass->model, moment->link);
    struct scalar_equation *equation = equation_of(pass->model, moment->link);
    if (equation->known && body->kind == motion_pivot)
        take_formula(pass, equation, body->first, 1, &moment->value);
}

static void take_formulas(const struct pass *pass)
{
    const struct tree *tree = pass->model->tree;
    for (size_t i = 0; i < tree->force_count; i++) take_force(pass, &tree->forces[i]);
    for (size_t i = 0; i < tree->moment_count; i++) take_moment(pass, &tree->moments[i]);
}

/* ---- constants */

static void take_following(const struct fbd_model *model, const struct tree_following *following)
{
    const struct model_body *body = body_of(model, following->link);
    struct scalar_equation *equation = equation_of(model, following->link);
    if (body->kind == motion_pivot) {
        equation->c0 += following->moment;
    } else {
        struct vec f = along_and_across(model, following->link, following->force, true);
        equation->c0 += f.x;
        equation->across += f.y;
    }
}

/* At distance r from an axis: v = r omega, M = -r (c + k |v|) v. */
static void take_drag(const struct fbd_model *model, const struct tree_drag *drag)
{
    struct scalar_equation *equation = equation_of(model, drag->link);
    double r = body_of(model, drag->link)->kind == motion_pivot ? vec_norm(drag->point) : 1;
    equation->kv += drag->linear * r * r;
    equation->square += drag->quadratic * r * r * r;
}

static void take_weights(const struct fbd_model *model, const struct tree_link *link)
{
    const struct model_body *body = &model->bodies[link->body];
    struct scalar_equation *equation = &model->plan.equations[link->body];
    if (body->kind == motion_pivot) {
        equation->s += link->sine;
        equation->c += link->cosine;
    } else {
        equation->c0 += vec_dot(link->force, body->e);
        equation->across += vec_dot(link->force, body->n);
    }
}

static void take_constants(struct builder *builder)
{
    const struct fbd_model *model = builder->model;
    const struct tree *tree = model->tree;
    for (int i = tree->joined; i < tree->count; i++) take_weights(model, &tree->links[i]);
    for (size_t i = 0; i < tree->following_count; i++) take_following(model, &tree->following[i]);
    for (size_t i = 0; i < tree->drag_count; i++) take_drag(model, &tree->drags[i]);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct affine_term *joint = &builder->affine[model->bodies[b].first];
        struct scalar_equation *equation = &model->plan.equations[b];
        if (!equation->known) continue;
        equation->c0 += joint->c0;
        equation->kq += joint->kq;
        equation->kv += joint->kv;
    }
}

/* ---- the whole */

static void find_known(struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    const struct plan *plan = &model->plan;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        plan->equations[b].known =
            body->alone && (body->kind == motion_slide || body->kind == motion_pivot);
    }
    for (size_t i = 0; i < tree->spring_count; i++)
        for (int end = 0; end < 2; end++)
            if (tree->springs[i].link[end] > 0) equation_of(model, tree->springs[i].link[end])->known = false;
    for (size_t i = 0; i < plan->potential_count; i++)
        plan->equations[model->scene->coordinates[plan->potentials[i].coordinate].body].known = false;
}

static bool number_formulas(struct fbd_model *model)
{
    struct plan *plan = &model->plan;
    int total = 0;
    take_formulas(&(struct pass){model, false});
    for (size_t b = 0; b < model->body_count; b++) {
        plan->equations[b].formulas.first = total;
        total += plan->equations[b].formulas.count;
        plan->equations[b].formulas.count = 0;
    }
    plan->formulas = ARENA_ARRAY(&model->arena, (size_t)total, struct formula_term);
    if (plan->formulas) take_formulas(&(struct pass){model, true});
    return plan->formulas != NULL;
}

bool scalar_equations_collect(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    model->plan.equations = ARENA_ARRAY(&model->arena, model->body_count, struct scalar_equation);
    if (!model->plan.equations) return false;
    find_known(model);
    take_constants(builder);
    return number_formulas(model);
}

static bool varies_in(const struct plan *plan, const struct scalar_equation *equation, int slot)
{
    for (int i = equation->formulas.first; i < equation->formulas.first + equation->formulas.count; i++)
        if (plan->formulas[i].slot == slot) return true;
    return false;
}

bool scalar_equation_is_constant(const struct plan *plan, const struct scalar_equation *equation, int slot)
{
    return equation->known && equation->kq == 0 && equation->kv == 0 && equation->square == 0 &&
           equation->s == 0 && equation->c == 0 && !varies_in(plan, equation, slot);
}

bool scalar_equation_presses_constantly(const struct plan *plan, const struct scalar_equation *equation,
                                        int slot)
{
    return equation->known && !varies_in(plan, equation, slot);
}
