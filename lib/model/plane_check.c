/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The forces of a body on the points that it rests on: in equilibrium with its weight at the centre of mass. Two points are
 * in line with that; three are not in one line. The weight of the body alone is the force on its plane only if no other body
 * rests on it.
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
           (mode_friction_varies(mode) || mode->mu_s.constant > mode->mu_k.constant);
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

/* ---- bodies that carry others */

/* The number of points on which a body lies on planes. */
static int points_under(const struct scene *scene, int body)
{
    int count = 0;
    for (size_t i = 0; i < scene->constraint_count; i++)
        count += scene->constraints[i].kind == constraint_plane && scene->constraints[i].body[0] == body;
    return count;
}

/* A body whose weight is on `carrier`: it lies there on its face, or is fixed to it and lies on no other plane; else -1. */
static int carried_by(const struct fbd_model *model, int carrier)
{
    const struct scene *scene = model->scene;
    for (size_t i = 0; i < scene->constraint_count; i++) {
        const struct constraint *joins = &scene->constraints[i];
        if (joins->kind == constraint_plane && joins->body[1] == carrier) return joins->body[0];
        for (int k = 0; joins->kind == constraint_weld && k < 2; k++)
            if (joins->body[k] == carrier && joins->body[1 - k] != ground_body &&
                points_under(scene, joins->body[1 - k]) == 0)
                return joins->body[1 - k];
    }
    for (int b = 0; b < (int)model->body_count; b++)
        if (model->bodies[b].parent == carrier && model->bodies[b].inertia.mass > 0 &&
            points_under(scene, b) == 0)
            return b;
    return -1;
}

static void check_weight(struct builder *builder, const struct constraint *source)
{
    const struct model_body *bodies = builder->model->bodies;
    if (source->kind != constraint_plane || source->normal.expr || source->place > 0) return;
    const int carried = carried_by(builder->model, source->body[0]);
    if (carried < 0) return;
    diag_add(builder->errors, FBD_ERROR, "missing-key", source->at,
             "add `normal`, with the weight of all that it carries",
             "`%s` carries `%s`: the force on its plane is larger than its own weight",
             bodies[source->body[0]].name, bodies[carried].name);
}

/* ---- static friction */

/* Does a body lie on one that is not driven? The plane of a driven body transmits no forces: its motion is given. */
static bool has_loose_plane(const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    for (size_t i = 0; i < scene->constraint_count; i++) {
        const struct constraint *source = &scene->constraints[i];
        if (source->kind == constraint_plane && source->body[1] != ground_body &&
            model->bodies[source->body[1]].drive < 0)
            return true;
    }
    return false;
}

/* Do joints or other couplings transmit forces between bodies? */
static bool is_joined(const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    bool joined = model->coupled_count > model->listed_count;
    for (size_t i = 0; i < scene->constraint_count; i++)
        joined |= scene->constraints[i].kind != constraint_plane;
    for (size_t b = 0; b < model->body_count; b++) joined |= model->bodies[b].parent >= 0;
    return joined;
}

static void refuse(struct builder *builder, const char *name, struct pos at, bool loose)
{
    diag_add(builder->errors, FBD_ERROR, "not-here", at,
             loose ? "let `static` be `kinetic`, or drive the body that is the plane"
                   : "let `static` be `kinetic`",
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
    for (size_t i = 0; i < scene->constraint_count; i++) {
        check_weight(builder, &scene->constraints[i]);
        planes += scene->constraints[i].kind == constraint_plane;
    }
    for (size_t i = 0; planes > 0 && i < model->plan.mode_count; i++) {
        const struct mode *mode = &model->plan.modes[i];
        const int others = planes - (mode->kind == mode_plane);
        const struct constraint *source =
            mode->coupling >= 0 ? model->tree->couplings[mode->coupling].source : NULL;
        if (others == 0 || !holds_by_more(mode)) continue;
        const bool loose = has_loose_plane(model), joined = is_joined(model),
                   shared = source && mode->kind == mode_plane && points_under(scene, source->body[0]) > 1;
        if (!loose && !joined && !shared) continue;
        const struct load *load = source ? NULL : model->loads[mode->load].source;
        refuse(builder, source ? source->name : load->name, source ? source->at : load->at,
               !joined && !shared);
        return;
    }
}
