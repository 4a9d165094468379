/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The forces of a body on the points that it rests on: in equilibrium with its weight at the centre of mass. Two points are
 * in line with that; three are not in one line.
 *
 * Reject static friction that the start of a slip on a plane could break. As a body begins to slip, its friction has
 * the direction of a velocity near zero, which is known to rounding only. Where that force reaches dry friction of any
 * kind that holds by more static than kinetic friction, rounding could break it away.
 */
#include "model/builder.h"
#include "numeric/tolerances.h"

static bool holds_by_more(const struct mode *mode)
{
    return mode_is_friction(mode) &&
           (mode->mu_s.expr || mode->mu_k.expr || mode->mu_s.constant > mode->mu_k.constant);
}

/* ---- points that share the weight */

/* From the centre of mass. */
static struct vec arm_of(const struct model_body *body, const struct point *point)
{
    return point->kind == point_fixed ? vec_sub(point->where, body->inertia.G) : (struct vec){0, 0};
}

static double tips(struct builder *builder, const struct constraint *source, const char *message,
                   const char *hint)
{
    if (source->place == 0)
        diag_add(builder->errors, FBD_ERROR, "not-here", source->point[0].at, hint, "%s", message);
    return 0;
}

/* N_k = (r_i x r_j)/sum of these, with i and j the points behind k. */
static double share_of_three(struct builder *builder, const struct constraint *source, const struct vec *r)
{
    const double area = vec_cross(vec_sub(r[1], r[0]), vec_sub(r[2], r[0]));
    const double side = fmax(vec_norm(vec_sub(r[1], r[0])), vec_norm(vec_sub(r[2], r[0])));
    if (fabs(area) <= six_digits * side * side)
        return tips(builder, source,
                    "the points are in one line: equilibrium does not determine their parts of the weight",
                    "write two points, or an entry with `at` and `normal` for each");
    double shares[3], least = 1;
    for (int k = 0; k < 3; k++)
        least = fmin(least, shares[k] = vec_cross(r[(k + 1) % 3], r[(k + 2) % 3]) / area);
    if (least < -six_digits)
        return tips(builder, source,
                    "the centre of mass is outside of the triangle of the points: the body tips",
                    "let the points surround the centre of mass");
    return fmax(0, shares[source->place]);
}

static double share_of_two(struct builder *builder, const struct constraint *source, const struct vec *r)
{
    const struct vec line = vec_sub(r[1], r[0]);
    const double length = vec_norm(line);
    if (!(length > 0) || fabs(vec_cross(line, r[0])) > six_digits * length * length)
        return tips(builder, source, "the centre of mass is not in line with the two points: the body tips",
                    "add a third point, or an entry with `at` and `normal` for each");
    const double second = -vec_dot(line, r[0]) / (length * length);
    if (second < -six_digits || second > 1 + six_digits)
        return tips(builder, source, "the centre of mass is not between the two points: the body tips",
                    "let it be between them");
    return fmin(1, fmax(0, source->place == 0 ? 1 - second : second));
}

double plane_share(struct builder *builder, const struct constraint *source)
{
    const struct model_body *body = &builder->model->bodies[source->body[0]];
    struct vec r[3] = {{0, 0}};
    if (source->points == 1) return 1;
    for (int k = 0; k < source->points; k++) r[k] = arm_of(body, &(source - source->place + k)->point[0]);
    return source->points == 2 ? share_of_two(builder, source, r) : share_of_three(builder, source, r);
}

/* ---- static friction */

/* Does it transmit forces between bodies? The plane of a driven body does not: its motion is given. */
static bool links(const struct fbd_model *model, const struct constraint *source)
{
    if (source->kind != constraint_plane) return true;
    return source->body[1] != ground_body && model->bodies[source->body[1]].drive < 0;
}

/* Does its body lie on another point, too? */
static bool has_others(const struct scene *scene, const struct constraint *source)
{
    bool any = false;
    for (const struct constraint *other = scene->constraints;
         other < scene->constraints + scene->constraint_count; other++)
        any |= other != source && other->kind == constraint_plane && other->body[0] == source->body[0];
    return any;
}

static bool may_be_linked(const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    bool linked = model->coupled_count > model->listed_count;
    for (size_t i = 0; i < scene->constraint_count; i++) linked |= links(model, &scene->constraints[i]);
    for (size_t b = 0; b < model->body_count; b++) linked |= model->bodies[b].parent >= 0;
    return linked;
}

static void refuse(struct builder *builder, const char *name, struct pos at)
{
    diag_add(builder->errors, FBD_ERROR, "not-here", at,
             "let `static` be `kinetic`, or drive the body that is the plane",
             "the static friction of `%s` is larger than its kinetic friction, and a body that begins to "
             "slip on a "
             "plane may break it by forces between them: such a start is not decided to rounding",
             name);
}

void planes_check(struct builder *builder)
{
    const struct fbd_model *model = builder->model;
    const struct scene *scene = model->scene;
    int planes = 0;
    for (size_t i = 0; i < scene->constraint_count; i++)
        planes += scene->constraints[i].kind == constraint_plane;
    for (size_t i = 0; planes > 0 && i < model->plan.mode_count; i++) {
        const struct mode *mode = &model->plan.modes[i];
        const int others = planes - (mode->kind == mode_plane);
        const struct constraint *source =
            mode->coupling >= 0 ? model->tree->couplings[mode->coupling].source : NULL;
        if (others == 0 || !holds_by_more(mode)) continue;
        if (!may_be_linked(model) && !(source && mode->kind == mode_plane && has_others(scene, source)))
            continue;
        const struct load *load = source ? NULL : model->loads[mode->load].source;
        refuse(builder, source ? source->name : load->name, source ? source->at : load->at);
        return;
    }
}
