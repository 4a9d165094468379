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
    const int angle = motion_joint(motion)->angle;
    if (angle >= 0) return start_of(scene, body, angle);
    if (!motion->turns) return motion->along;
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
