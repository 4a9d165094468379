/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/force_columns.h"

#include "output/words.h"
#include "record/result.h"

static bool has_part(const struct fbd_model *model, int b, const struct arrow *arrow, enum force_part part)
{
    const struct model_body *body = &model->bodies[b];
    const bool own = arrow->load < 0 && arrow_is_of_joint(model, b, arrow);
    switch (body->kind) {
    case motion_slide:
    case motion_track: return !own && part == force_share;
    case motion_pivot: return own ? part == force_x || part == force_y : part == force_share;
    case motion_particle: return !own && (part == force_x || part == force_y);
    case motion_planar:
    case motion_weld: break;
    }
    return part != force_share;
}

size_t force_columns(const struct fbd_model *model, int b, const struct arrow *arrow, bool components,
                     enum force_part parts[static force_parts])
{
    size_t count = 0;
    for (enum force_part part = force_share; part < force_parts; part++)
        if ((components && part != force_share) || has_part(model, b, arrow, part)) parts[count++] = part;
    return count;
}

const char *force_part_name(enum force_part part)
{
    static const char *const names[] = {"", "x", "y", "moment"};
    return names[part];
}

const char *force_part_unit(const struct fbd_model *model, int b, enum force_part part)
{
    bool about_axis = part == force_share && model->bodies[b].kind == motion_pivot;
    return about_axis || part == force_moment ? moment_unit(model) : force_unit(model);
}

double force_part_value(const struct fbd_model *model, int b, const struct instant *at,
                        const struct arrow *arrow, enum force_part part)
{
    const struct model_body *body = &model->bodies[b];
    if (part == force_x) return arrow->force.x;
    if (part == force_y) return arrow->force.y;
    if (part == force_moment) {
        struct pose pose = body_pose(body, at);
        return arrow_moment(arrow, point_motion(body, &pose, body->inertia.G).p);
    }
    bool normal = arrow->load >= 0 && arrow_is_of_joint(model, b, arrow);
    return normal ? vec_dot(arrow->force, surface_normal(model, body, at)) : arrow->share[0];
}
