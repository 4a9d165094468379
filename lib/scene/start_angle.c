/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/start_angle.h"

#include "expr/curve.h"
#include "expr/expr.h"

static double start_of(const struct scene *scene, const struct body *body, int part)
{
    const struct expr *prescribed = body->motion.prescribed.expr;
    const int *slots;
    if (prescribed && expr_variables(prescribed, &slots) == 0) return expr_eval(prescribed, 0, NULL, NULL);
    return scene->coordinates[body->first + part].initial;
}

static double own_angle(const struct scene *scene, const struct body *body)
{
    const struct motion *motion = &body->motion;
    switch (motion->kind) {
    case motion_slide:
    case motion_weld: return motion->along;
    case motion_pivot: return start_of(scene, body, 0);
    case motion_planar: return start_of(scene, body, 2);
    case motion_track: break;
    case motion_particle: return 0;
    }
    if (!motion->turns) return 0;
    struct vec e = curve_at(motion->curve, NULL, start_of(scene, body, 0)).e;
    return atan2(e.y, e.x);
}

double start_angle(const struct scene *scene, int body)
{
    double angle = 0;
    for (; body != ground_body; body = scene->bodies[body].motion.parent)
        angle += own_angle(scene, &scene->bodies[body]);
    return angle;
}
