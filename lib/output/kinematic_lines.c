/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/kinematic_lines.h"

#include <math.h>
#include <string.h>

#include "dynamics/kinematics.h"
#include "output/moments.h"

/* A name of body b as written in the lines of body `of`. */
static const char *name_of(struct formulas *formulas, int b, int of, const char *name)
{
    return b == of ? name
                   : arena_printf(&formulas->arena, "%s.%s", formulas->state->model->bodies[b].name, name);
}

static const char *acceleration_of(struct formulas *formulas, int b, int of, int part)
{
    const struct fbd_model *model = formulas->state->model;
    return name_of(formulas, b, of, model->labels[model->bodies[b].first + part].acceleration_name);
}

/* ---- a point of a body that turns */

/* The angle of a body in the world, and its rates. */
struct turning {
    const char *angle, *rate, *acceleration;
};

static struct turning turning_of(struct formulas *formulas, int b, int of)
{
    const struct fbd_model *model = formulas->state->model;
    const struct model_body *body = &model->bodies[b];
    const char *angle = angle_name(formulas, b);
    if (strcmp(angle, "angle") == 0)
        return (struct turning){name_of(formulas, b, of, angle), name_of(formulas, b, of, "angle_dot"),
                                name_of(formulas, b, of, "angle_ddot")};
    const struct coordinate *q = &model->scene->coordinates[body->first + body->count - 1];
    return (struct turning){name_of(formulas, b, of, angle), name_of(formulas, b, of, q->rate_name),
                            acceleration_of(formulas, b, of, body->count - 1)};
}

/* Vector from one point of a body to another, in its frame. */
static struct vec arm_in_frame(const struct formulas *formulas, int b, struct vec from, struct vec to)
{
    const struct instant at = state_instant(formulas->state);
    const struct vec turn = body_pose(&formulas->state->model->bodies[b], &at).rotation,
                     d = vec_sub(to, from);
    struct vec arm = {vec_dot(turn, d), vec_cross(turn, d)};
    const double zero = 1e-9 * (vec_norm(d) + 1e-3 * vec_norm(to));
    if (fabs(arm.x) <= zero) arm.x = 0;
    if (fabs(arm.y) <= zero) arm.y = 0;
    return arm;
}

/* One of two terms of alpha k x d - omega^2 d: `arm` times a bracket. */
static const char *turned_part(struct formulas *formulas, int b, const struct turning *turning, double arm,
                               bool sine)
{
    if (arm == 0) return "";
    const char *length = arm_name(formulas, b, arm);
    if (!length || !turning->angle || !turning->rate || !turning->acceleration) return NULL;
    return arena_printf(&formulas->arena, "%s%s (%s %s(%s) %c %s^2 %s(%s))", arm < 0 ? "-" : "", length,
                        turning->acceleration, sine ? "sin" : "cos", turning->angle, sine ? '+' : '-',
                        turning->rate, sine ? "cos" : "sin", turning->angle);
}

static const char *add_turned(struct formulas *formulas, const char *sum, int b, int of, struct vec d,
                              int part)
{
    const struct turning turning = turning_of(formulas, b, of);
    const char *along = turned_part(formulas, b, &turning, part == 0 ? -d.x : d.x, part == 0);
    const char *across = turned_part(formulas, b, &turning, -d.y, part == 1);
    return formula_add(formulas, formula_add(formulas, sum, along), across);
}

/* ---- a body that does not turn */

static bool is_straight(const struct fbd_model *model, int b)
{
    const struct model_body *body = &model->bodies[b];
    return body->parent == ground_body && body->joint->angle < 0 && body->joint->path != path_curve;
}

/* v_dot cos(phi); of a particle vx_dot. */
static const char *add_straight(struct formulas *formulas, const char *sum, int b, int of, int part)
{
    const struct model_body *body = &formulas->state->model->bodies[b];
    const char *name = acceleration_of(formulas, b, of, body->count == 2 ? part : 0);
    if (body->count == 2) return formula_add(formulas, sum, name);
    const double share = part == 0 ? body->e.x : body->e.y;
    if (!name || share == 0) return name ? sum : NULL;
    if (fabs(share) == 1) {
        const char *term = arena_printf(&formulas->arena, "%s%s", share < 0 ? "-" : "", name);
        return formula_add(formulas, sum, term);
    }
    const char *angle = slope_of(formulas, body->e);
    return formula_add(formulas, sum,
                       angle ? arena_printf(&formulas->arena, "%s %s(%s)", name, part == 0 ? "cos" : "sin",
                                            angle)
                             : NULL);
}

/* ---- the lines */

static struct vec origin_of(const struct formulas *formulas, int b)
{
    const struct instant at = state_instant(formulas->state);
    return body_pose(&formulas->state->model->bodies[b], &at).origin;
}

static struct vec center_of(const struct formulas *formulas, int b)
{
    const struct instant at = state_instant(formulas->state);
    const struct model_body *body = &formulas->state->model->bodies[b];
    const struct pose pose = body_pose(body, &at);
    return point_motion(body, &pose, body->inertia.G).p;
}

/* The acceleration of a point of body p, in the lines of body `of`. */
static const char *of_point(struct formulas *formulas, int p, int of, struct vec point, int part)
{
    const struct model_body *body = &formulas->state->model->bodies[p];
    if (is_straight(formulas->state->model, p)) return add_straight(formulas, "", p, of, part);
    if (body->parent == ground_body && body->joint->has_axis)
        return add_turned(formulas, "", p, of, arm_in_frame(formulas, p, origin_of(formulas, p), point),
                          part);
    const char *G = name_of(formulas, p, of, part == 0 ? "a_Gx" : "a_Gy");
    return add_turned(formulas, G, p, of, arm_in_frame(formulas, p, center_of(formulas, p), point), part);
}

static const char *line(struct formulas *formulas, char point, int part, const char *right)
{
    return right ? arena_printf(&formulas->arena, "a_%c%c = %s", point, "xy"[part], right[0] ? right : "0")
                 : NULL;
}

/* For a pivot: by the axis O, whose acceleration has its own line if it moves on a curve. */
static int lines_of_pivot(struct formulas *formulas, int b, const char **lines)
{
    const struct fbd_model *model = formulas->state->model;
    const int p = model->bodies[b].parent;
    const struct vec O = origin_of(formulas, b), arm = arm_in_frame(formulas, b, O, center_of(formulas, b));
    int count = 0;
    for (int part = 0; part < 2; part++) {
        const char *axis = p == ground_body        ? ""
                           : is_straight(model, p) ? add_straight(formulas, "", p, b, part)
                           : part == 0             ? "a_Ox"
                                                   : "a_Oy";
        lines[count++] = line(formulas, 'G', part, add_turned(formulas, axis, b, b, arm, part));
    }
    if (p == ground_body || is_straight(model, p)) return count;
    for (int part = 0; part < 2; part++)
        lines[count++] = line(formulas, 'O', part, of_point(formulas, p, b, O, part));
    return count;
}

/* For a slide on the ground; along x or y it is the acceleration in its equation. */
static int lines_of_slide(struct formulas *formulas, int b, const char **lines)
{
    const struct vec e = formulas->state->model->bodies[b].e;
    int count = 0;
    for (int part = 0; part < 2; part++)
        if ((part == 0 ? e.y : e.x) != 0)
            lines[count++] = line(formulas, 'G', part, add_straight(formulas, "", b, b, part));
    return count;
}

int kinematic_lines(struct formulas *formulas, int b, const char *lines[static most_kinematic_lines])
{
    const struct fbd_model *model = formulas->state->model;
    const struct model_body *body = &model->bodies[b];
    const bool ground = body->parent == ground_body, off_center = body_is_off_center(body);
    if (body->joint->has_axis) return lines_of_pivot(formulas, b, lines);
    if (body->joint->path == path_line && ground) return lines_of_slide(formulas, b, lines);
    if (body->count > 0 && !(ground && off_center)) return 0;
    const struct vec origin = origin_of(formulas, b), G = center_of(formulas, b);
    for (int part = 0; part < 2; part++) {
        const char *right = off_center ? add_turned(formulas, acceleration_of(formulas, b, b, part), b, b,
                                                    arm_in_frame(formulas, b, origin, G), part)
                            : ground   ? ""
                                       : of_point(formulas, body->parent, b, G, part);
        lines[part] = line(formulas, 'G', part, right);
    }
    return 2;
}
