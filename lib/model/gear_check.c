/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Gears whose axes keep their distance: the pitch circles have to touch there.
 *
 *   distance of the axes = r_1 + r_2, and |r_1 - r_2| of a wheel inside a ring
 */
#include "model/builder.h"

/* The distance of two axes that keeps as the bodies move; negative where it does not. Both turn about their
 * centres, and on the same body, or one on the other, or one on an arm about the axis of the other. */
static double axes_apart(const struct tree *tree, const struct tie *tie, double close)
{
    const struct tree_link *link[2];
    for (int k = 0; k < 2; k++) {
        link[k] = &tree->links[tie->end[k].link];
        if (link[k]->kind != motion_pivot || vec_norm(tie->end[k].point) > close) return -1;
    }
    if (link[0]->parent == link[1]->parent) return vec_norm(vec_sub(link[0]->at, link[1]->at));
    for (int k = 0; k < 2; k++) {
        const struct tree_link *other = link[1 - k], *arm = &tree->links[link[k]->parent];
        bool on_the_other = link[k]->parent == tie->end[1 - k].link;
        bool about_it = link[k]->parent > 0 && arm->kind == motion_pivot && arm->parent == other->parent &&
                        vec_norm(vec_sub(arm->at, other->at)) <= close;
        if (on_the_other || about_it) return vec_norm(link[k]->at);
    }
    return -1;
}

static void check_gear(struct builder *builder, const struct tie *tie)
{
    const struct fbd_model *model = builder->model;
    const double digits = 2e-6; /* six digits in a file are meant to fit */
    double r1 = tie->end[0].radius, r2 = tie->end[1].radius, size = r1 + fabs(r2);
    double apart = axes_apart(model->tree, tie, digits * size), needed = fabs(r1 + r2);
    if (apart < 0 || fabs(apart - needed) <= digits * size) return;
    diag_add(builder->errors, FBD_ERROR, "gear-distance", model->scene->constraints[tie->constraint].at,
             r2 < 0 ? "move an axis, or change `radii`"
                    : "move an axis, or change `radii`; of a wheel inside a ring say `inside: true`",
             "the axes of `%s` and `%s` are %.6g apart, where the radii %.6g and %.6g %s %.6g",
             model->bodies[tie->end[0].body].name, model->bodies[tie->end[1].body].name, apart, r1, fabs(r2),
             r2 < 0 ? "differ by" : "add up to", needed);
}

void gears_check(struct builder *builder)
{
    const struct tree *tree = builder->model->tree;
    for (int i = 0; tree && i < tree->tie_count; i++)
        if (tree->ties[i].kind == constraint_gear) check_gear(builder, &tree->ties[i]);
}
