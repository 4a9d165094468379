/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Steps below the level of surfaces.
 */
#include "dynamics/contact.h"

#include "dynamics/constraint.h"

/* Does an impact with this normal push along a side, as a step does that stops a body on it, and not onto it? */
static bool pushes_along(const struct tree_work *work, const struct meeting *meeting, int moving, int side,
                         struct vec normal)
{
    struct touch touch = meeting_touch(meeting, meeting_feature(meeting, moving, 0, side));
    struct vec e = vec_turn(work->links[meeting->shape[1 - moving].link].turn, touch.e);
    return fabs(vec_dot(e, normal)) > fabs(vec_cross(e, normal));
}

/* The depth of a corner of shape `moving` behind a side of the other along which they move; 0 if another
 * corner is deeper than the level. */
static double depth_along(const struct fbd_model *model, const struct tree_work *work, int index, int moving,
                          int side, double speed)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    const double level = contact_level * meeting->reach, near = meeting_near(model, work, index);
    double depth = 0;
    for (int i = 0; i < meeting->shape[moving].count; i++) {
        int feature = meeting_feature(meeting, moving, i, side);
        struct gap gap = feature_gap(model, work, index, feature);
        struct place_on_side at = feature_foot(model, work, index, feature);
        bool over = at.foot >= -level && at.foot <= at.length + level;
        if (gap.x < -level) return 0;
        if (over && gap.x < -near && fabs(gap.rate) <= speed) depth = fmax(depth, -gap.x);
    }
    return depth;
}

double meeting_low_step(const struct fbd_model *model, const struct tree_work *work, int index, double speed,
                        struct vec normal)
{
    const double along = 1e-3; /* of the speed of the impact */
    const struct meeting *meeting = &model->tree->meetings[index];
    bool corners = meeting->shape[0].kind == contact_corners && meeting->shape[1].kind == contact_corners;
    double height = 0;
    if (meeting->thin || meeting->stop != 0 || !corners) return 0;
    for (int moving = 0; moving < 2; moving++)
        for (int side = 0; side < shape_sides(&meeting->shape[1 - moving]); side++)
            if (pushes_along(work, meeting, moving, side, normal))
                height = fmax(height, depth_along(model, work, index, moving, side, along * speed));
    return height;
}

/* Of two polygons `separation` takes a side among those that are equal within a level, and a corner likewise. */
double meeting_jump(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const struct contact_shape *shape = model->tree->meetings[index].shape;
    bool sides = shape[0].kind == contact_corners && shape[1].kind == contact_corners;
    return sides ? meeting_near(model, work, index) : 0;
}

double meeting_speed(const struct tree_work *work, const struct meeting *meeting)
{
    double speed = 0;
    for (int k = 0; k < 2; k++) {
        const struct tree_state *s = &work->links[meeting->shape[k].link];
        speed = fmax(speed, vec_norm(s->v) + fabs(s->omega) * meeting->size);
    }
    return speed;
}
