/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/laws.h"

/* du = (dp - u dl) / l,  dl = u . dp,  dl' = u . dv + v . du,  df = -(k dl + c dl') u - T du */
struct vec link_variation(const struct link_law *law, struct motion_of_point at, struct motion_of_point d)
{
    struct vec reach = vec_sub(at.p, law->anchor);
    double length = vec_norm(reach);
    if (length == 0) return vec_scale(law->free_length == 0 ? -law->stiffness : 0, d.p);
    struct vec u = vec_scale(1 / length, reach);
    double tension = law->stiffness * (length - law->free_length) + law->damping * vec_dot(u, at.v);
    double d_length = vec_dot(u, d.p);
    struct vec d_u = vec_scale(1 / length, vec_sub(d.p, vec_scale(d_length, u)));
    double d_rate = vec_dot(u, d.v) + vec_dot(at.v, d_u);
    double d_tension = law->stiffness * d_length + law->damping * d_rate;
    return vec_sub(vec_scale(-d_tension, u), vec_scale(tension, d_u));
}

struct vec pull_variation(double F, double dF, struct vec d, struct vec dd)
{
    const double length = vec_norm(d);
    const struct vec u = vec_scale(1 / length, d);
    const struct vec du = vec_scale(1 / length, vec_sub(dd, vec_scale(vec_dot(u, dd), u)));
    return vec_sub(vec_scale(-dF, u), vec_scale(F, du));
}

struct vec drag_variation(const struct drag_law *law, struct vec v, struct vec dv)
{
    double speed = vec_norm(v);
    struct vec d = vec_scale(-(law->linear + law->quadratic * speed), dv);
    if (speed == 0) return d;
    return vec_sub(d, vec_scale(law->quadratic * vec_dot(v, dv) / speed, v));
}
