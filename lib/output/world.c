/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/world.h"

#include <string.h>

#include "dynamics/diagram.h"
#include "dynamics/tree.h"

const char *world_part_name(enum world_part part)
{
    static const char *const names[] = {"x", "y", "vx", "vy", "ax", "ay", "proper_ax", "proper_ay"};
    return names[part];
}

const char *world_part_unit(const struct fbd_model *model, enum world_part part)
{
    static const char *const units[][2] = {{"m", "ft"}, {"m/s", "ft/s"}, {"m/s^2", "ft/s^2"}};
    const int order = part < world_proper_ax ? (int)part / 2 : 2;
    return units[order][model->scene->units == unit_us];
}

static bool is_called(const char *name, const char *text, size_t length)
{
    return strlen(name) == length && memcmp(name, text, length) == 0;
}

/* `right`, `G` or `O` of a body. */
static bool find_point(const struct model_body *body, const char *name, size_t length, int *point)
{
    const struct body *source = body->source;
    if (is_called("G", name, length)) {
        *point = world_G;
        return true;
    }
    if (is_called("O", name, length) && body->joint->has_axis) {
        *point = world_O;
        return true;
    }
    for (size_t i = 0; i < source->point_count; i++) {
        if (!is_called(source->points[i].name, name, length)) continue;
        *point = (int)i;
        return true;
    }
    return false;
}

struct vec world_point(const struct fbd_model *model, int b, int point)
{
    const struct model_body *body = &model->bodies[b];
    if (point == world_G) return body->inertia.G;
    return point == world_O ? body->source->motion.point : body->source->points[point].where;
}

bool world_find(const struct fbd_model *model, const char *name, struct world_quantity *quantity)
{
    const char *first = strchr(name, '.'), *last = strrchr(name, '.');
    if (!first || first == last) return false;
    int part = 0;
    while (part < world_parts && strcmp(world_part_name((enum world_part)part), last + 1) != 0) part++;
    if (part == world_parts) return false;
    quantity->part = (enum world_part)part;
    for (size_t b = 0; b < model->body_count; b++) {
        if (!is_called(model->bodies[b].name, name, (size_t)(first - name))) continue;
        quantity->body = (int)b;
        return find_point(&model->bodies[b], first + 1, (size_t)(last - first - 1), &quantity->point);
    }
    return false;
}

/* a_P = a_G + alpha k x r - omega^2 r, r from G to P. */
static struct vec acceleration(const struct model_body *body, const struct instant *at,
                               const struct pose *pose, struct vec point)
{
    struct vec a = mass_center_acceleration(body, at);
    struct vec r = vec_turn(pose->rotation, vec_sub(point, body->inertia.G));
    if (body_never_turns(body)) return a;
    double alpha = body_angular_acceleration(body, at);
    return vec_add(a, vec_sub(vec_scale(alpha, vec_perp(r)), vec_scale(pose->omega * pose->omega, r)));
}

/* The gravity of the scene in its plane; zero if no body has weight, since then there is none. */
static struct vec gravity_of(const struct fbd_model *model)
{
    for (size_t b = 0; b < model->body_count; b++) {
        const struct body *source = model->bodies[b].source;
        for (size_t i = 0; i < source->load_count; i++)
            if (source->loads[i].kind == load_gravity) return model->scene->gravity;
    }
    return (struct vec){0, 0};
}

void world_values(const struct fbd_state *state, int b, struct vec point, double values[world_parts])
{
    const struct model_body *body = &state->model->bodies[b];
    struct instant at = state_instant(state);
    struct pose pose = body_pose(body, &at);
    struct motion_of_point moves = point_motion(body, &pose, point);
    struct vec a = acceleration(body, &at, &pose, point);
    struct vec back = {pose.rotation.x, -pose.rotation.y};
    struct vec proper = vec_turn(back, vec_sub(a, gravity_of(state->model)));
    const double all[world_parts] = {moves.p.x, moves.p.y, moves.v.x, moves.v.y,
                                     a.x,       a.y,       proper.x,  proper.y};
    memcpy(values, all, sizeof all);
}
