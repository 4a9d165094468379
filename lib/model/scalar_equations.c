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

/* Of the first coordinate of a link. */
static struct scalar_equation *equation_of(const struct fbd_model *model, int link)
{
    return &model->plan.equations[model->tree->links[link].coordinate];
}

static void forget(const struct fbd_model *model, int link)
{
    const struct model_body *body = &model->bodies[model->tree->links[link].body];
    for (int k = 0; k < body->count; k++) model->plan.equations[body->first + k].known = false;
}

static const struct model_body *body_of(const struct fbd_model *model, int link)
{
    return &model->bodies[model->tree->links[link].body];
}

/* Components of a force on a slide, along it and to the side of its surface, and on a particle, along x and y. The
 * frame of the body on a slide lies along the line; that of a particle does not turn. */
static struct vec along_and_across(const struct fbd_model *model, int link, struct vec f, bool body_frame)
{
    const struct model_body *body = body_of(model, link);
    if (body->joint->path == path_none) return f;
    if (!body_frame) return (struct vec){vec_dot(f, body->e), vec_dot(f, body->n)};
    return (struct vec){f.x, f.y * model->tree->links[link].side};
}

static void take_formula(const struct pass *pass, struct range *list, double scale,
                         const struct formula *value)
{
    if (scale == 0) return;
    int place = list->first + list->count++;
    if (pass->adds) pass->model->plan.formulas[place] = (struct formula_term){scale, *value};
}

static void take_force(const struct pass *pass, const struct tree_force *force)
{
    const struct model_body *body = body_of(pass->model, force->link);
    struct scalar_equation *equation = equation_of(pass->model, force->link);
    if (!equation->known) return;
    bool turns = body->joint->has_axis;
    if (!formula_is_constant(&force->angle) || (turns && !force->body_frame)) {
        forget(pass->model, force->link);
        return;
    }
    const struct vec d = force->direction;
    if (turns) {
        take_formula(pass, &equation->formulas, vec_cross(force->point, d), &force->value);
        return;
    }
    struct vec share = along_and_across(pass->model, force->link, d, force->body_frame);
    take_formula(pass, &equation->formulas, share.x, &force->value);
    take_formula(pass, body->count == 2 ? &equation[1].formulas : &equation->across_formulas, share.y,
                 &force->value);
}

static void take_moment(const struct pass *pass, const struct tree_moment *moment)
{
    const struct model_body *body = body_of(pass->model, moment->link);
    struct scalar_equation *equation = equation_of(pass->model, moment->link);
    if (equation->known && body->joint->has_axis) take_formula(pass, &equation->formulas, 1, &moment->value);
}

static void take_formulas(const struct pass *pass)
{
    const struct tree *tree = pass->model->tree;
    for (size_t i = 0; i < tree->force_count; i++) take_force(pass, &tree->forces[i]);
    for (size_t i = 0; i < tree->moment_count; i++) take_moment(pass, &tree->moments[i]);
}

/* ---- constants */

static void take_constant(const struct model_body *body, struct scalar_equation *equation, struct vec share)
{
    equation->c0 += share.x;
    if (body->count == 2)
        equation[1].c0 += share.y;
    else
        equation->across += share.y;
}

static void take_following(const struct fbd_model *model, const struct tree_following *following)
{
    const struct model_body *body = body_of(model, following->link);
    struct scalar_equation *equation = equation_of(model, following->link);
    if (body->joint->has_axis)
        equation->c0 += following->moment;
    else
        take_constant(body, equation, along_and_across(model, following->link, following->force, true));
}

/* At distance r from an axis: v = r omega, M = -r (c + k |v|) v. The speed of a particle has both components. */
static void take_drag(const struct fbd_model *model, const struct tree_drag *drag)
{
    struct scalar_equation *equation = equation_of(model, drag->link);
    const struct model_body *body = body_of(model, drag->link);
    double r = body->joint->has_axis ? vec_norm(drag->point) : 1;
    if (body->count == 2) equation[1].kv += drag->linear;
    if (body->count == 2 && drag->quadratic != 0) forget(model, drag->link);
    equation->kv += drag->linear * r * r;
    equation->square += drag->quadratic * r * r * r;
}

static void take_weights(const struct fbd_model *model, const struct tree_link *link)
{
    const struct model_body *body = &model->bodies[link->body];
    struct scalar_equation *equation = &model->plan.equations[link->coordinate];
    if (body->joint->has_axis) {
        equation->s += link->sine;
        equation->c += link->cosine;
    } else {
        take_constant(body, equation, along_and_across(model, body->place.link, link->force, false));
    }
}

static void take_constants(struct builder *builder)
{
    const struct fbd_model *model = builder->model;
    const struct tree *tree = model->tree;
    for (int i = tree->joined; i < tree->count; i++)
        if (equation_of(model, i)->known) take_weights(model, &tree->links[i]);
    for (size_t i = 0; i < tree->following_count; i++)
        if (equation_of(model, tree->following[i].link)->known) take_following(model, &tree->following[i]);
    for (size_t i = 0; i < tree->drag_count; i++)
        if (equation_of(model, tree->drags[i].link)->known) take_drag(model, &tree->drags[i]);
    for (int i = 0; i < model->plan.n; i++) {
        const struct affine_term *joint = &builder->affine[i];
        struct scalar_equation *equation = &model->plan.equations[i];
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
        for (int k = 0; k < body->count; k++)
            plan->equations[body->first + k].known = body->alone && body->count < 3;
    }
    for (size_t i = 0; i < tree->spring_count; i++)
        for (int end = 0; end < 2; end++)
            if (tree->springs[i].link[end] > 0) forget(model, tree->springs[i].link[end]);
    for (size_t i = 0; i < plan->potential_count; i++) forget(model, plan->potentials[i].link);
    for (size_t i = 0; i < model->load_count; i++) {
        const int link = model->bodies[model->loads[i].body].place.link;
        if (model->loads[i].source->lifetime.number > 0 && link > 0) forget(model, link);
    }
}

/* Set the place of a list behind `first` others, to be filled anew; returns the number with it. */
static int number(struct range *list, int first)
{
    const int count = list->count;
    *list = (struct range){first, 0};
    return first + count;
}

static bool number_formulas(struct fbd_model *model)
{
    struct plan *plan = &model->plan;
    int total = 0;
    take_formulas(&(struct pass){model, false});
    for (int i = 0; i < plan->n; i++) {
        total = number(&plan->equations[i].formulas, total);
        total = number(&plan->equations[i].across_formulas, total);
    }
    plan->formulas = ARENA_ARRAY(&model->arena, (size_t)total, struct formula_term);
    if (plan->formulas) take_formulas(&(struct pass){model, true});
    return plan->formulas != NULL;
}

bool scalar_equations_collect(struct builder *builder)
{
    struct fbd_model *model = builder->model;
    model->plan.equations = ARENA_ARRAY(&model->arena, (size_t)model->plan.n, struct scalar_equation);
    if (!model->plan.equations) return false;
    find_known(model);
    take_constants(builder);
    return number_formulas(model);
}

bool scalar_equation_is_constant(const struct scalar_equation *equation)
{
    return equation->known && equation->kq == 0 && equation->kv == 0 && equation->square == 0 &&
           equation->s == 0 && equation->c == 0 && equation->formulas.count == 0;
}
