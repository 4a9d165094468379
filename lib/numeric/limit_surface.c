/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The least Phi(v) of all twists with w . v = 1. At a twist about point p, where Phi has a kink, it is least if the force
 * that p needs is within its limit. Elsewhere Phi is smooth, and Newton's method on sqrt(|u_i|^2 + e^2) for |u_i|, with e
 * from the size of the twists down to round-off, passes the kinks.
 */
#include "numeric/limit_surface.h"

#include <stdbool.h>

#include "numeric/tolerances.h"

struct twist {
    struct vec V;
    double omega; /* times `length` */
};

struct surface {
    struct limit_point *points;
    size_t count;
    double length;     /* the largest arm */
    struct twist w;    /* of magnitude 1 */
    struct twist b[2]; /* the directions normal to w */
    double smooth;     /* e */
};

static double dot(struct twist a, struct twist b)
{
    return vec_dot(a.V, b.V) + a.omega * b.omega;
}

static struct twist sum(struct twist a, double s, struct twist b)
{
    return (struct twist){vec_add(a.V, vec_scale(s, b.V)), a.omega + s * b.omega};
}

static struct twist cross(struct twist a, struct twist b)
{
    return (struct twist){{a.V.y * b.omega - a.omega * b.V.y, a.omega * b.V.x - a.V.x * b.omega},
                          a.V.x * b.V.y - a.V.y * b.V.x};
}

static struct vec arm_of(const struct surface *of, size_t i)
{
    return vec_scale(1 / of->length, of->points[i].r);
}

static struct vec velocity(const struct surface *of, size_t i, struct twist v)
{
    return vec_add(v.V, vec_scale(v.omega, vec_perp(arm_of(of, i))));
}

/* ---- twists about a point */

/* The twist about point p with w . v = 1; false if w has no moment about it. */
static bool pivot_of(const struct surface *of, size_t p, struct twist *v)
{
    const struct vec r = arm_of(of, p);
    const double moment = of->w.omega - vec_cross(r, of->w.V);
    if (fabs(moment) <= negligible_sum) return false;
    *v = (struct twist){vec_scale(-1 / moment, vec_perp(r)), 1 / moment};
    return true;
}

/* Does point p remain at rest while the others slip about it? At its limit it does not. */
static bool rests(const struct surface *of, size_t p, struct twist v)
{
    double phi = 0;
    struct vec f = {0, 0};
    for (size_t i = 0; i < of->count; i++) {
        const struct vec u = velocity(of, i, v);
        const double speed = i == p ? 0 : vec_norm(u);
        if (speed == 0) continue;
        phi += of->points[i].c * speed;
        f = vec_add(f, vec_scale(of->points[i].c / speed, u));
    }
    return vec_norm(vec_sub(vec_scale(phi, of->w.V), f)) < (1 - nine_digits) * of->points[p].c;
}

/* ---- smooth */

static double phi_of(const struct surface *of, struct twist v)
{
    double phi = 0;
    for (size_t i = 0; i < of->count; i++) {
        const struct vec u = velocity(of, i, v);
        phi += of->points[i].c * sqrt(vec_dot(u, u) + of->smooth * of->smooth);
    }
    return phi;
}

/* Newton's step in the plane of b, with the second derivatives H + little. */
static struct twist newton_step(const struct surface *of, struct twist v, double *slope)
{
    double g[2] = {0, 0}, H[3] = {0, 0, 0};
    for (size_t i = 0; i < of->count; i++) {
        const struct vec u = velocity(of, i, v);
        const double c = of->points[i].c, speed = sqrt(vec_dot(u, u) + of->smooth * of->smooth);
        const struct vec d[2] = {velocity(of, i, of->b[0]), velocity(of, i, of->b[1])};
        const double along[2] = {vec_dot(u, d[0]) / speed, vec_dot(u, d[1]) / speed};
        for (int k = 0; k < 2; k++) g[k] += c * along[k];
        H[0] += c / speed * (vec_dot(d[0], d[0]) - along[0] * along[0]);
        H[1] += c / speed * (vec_dot(d[0], d[1]) - along[0] * along[1]);
        H[2] += c / speed * (vec_dot(d[1], d[1]) - along[1] * along[1]);
    }
    const double little = negligible_sum * (H[0] + H[2]);
    H[0] += little;
    H[2] += little;
    const double det = H[0] * H[2] - H[1] * H[1];
    const double z[2] = {-(H[2] * g[0] - H[1] * g[1]) / det, -(H[0] * g[1] - H[1] * g[0]) / det};
    *slope = g[0] * z[0] + g[1] * z[1];
    return sum((struct twist){vec_scale(z[0], of->b[0].V), z[0] * of->b[0].omega}, z[1], of->b[1]);
}

/* A descent by Newton's method with halved steps. */
static struct twist descend(const struct surface *of, struct twist v)
{
    enum { most_steps = 30, most_halves = 30 };
    const double enough = 0.1; /* of the decrease along the slope (Armijo) */
    for (int step = 0; step < most_steps; step++) {
        double slope, size = 1;
        const struct twist way = newton_step(of, v, &slope);
        const double phi = phi_of(of, v);
        if (!(slope < -negligible_part * negligible_part * phi)) return v;
        int half = 0;
        while (half++ < most_halves && !(phi_of(of, sum(v, size, way)) <= phi + enough * size * slope))
            size /= 2;
        if (half > most_halves) return v;
        v = sum(v, size, way);
    }
    return v;
}

static struct twist smooth_least(struct surface *of)
{
    struct twist v = of->w;
    of->smooth = 1;
    while (of->smooth > negligible_sum) {
        v = descend(of, v);
        of->smooth /= 10;
    }
    return v;
}

/* ---- all */

static void set_surface(struct surface *of, struct vec F, double M)
{
    for (size_t i = 0; i < of->count; i++) of->length = fmax(of->length, vec_norm(of->points[i].r));
    if (of->length == 0) of->length = 1;
    const double size = hypot(vec_norm(F), M / of->length);
    of->w = (struct twist){vec_scale(1 / size, F), M / of->length / size};
    const struct twist axis = fabs(of->w.omega) < 0.5 ? (struct twist){{0, 0}, 1} : (struct twist){{1, 0}, 0};
    const struct twist b = cross(of->w, axis);
    const double length = sqrt(dot(b, b));
    of->b[0] = (struct twist){vec_scale(1 / length, b.V), b.omega / length};
    of->b[1] = cross(of->w, of->b[0]);
}

static void set_velocities(const struct surface *of, struct twist v, size_t at_rest)
{
    double phi = 0, all = 0;
    for (size_t i = 0; i < of->count; i++) {
        of->points[i].u = i == at_rest ? (struct vec){0, 0} : velocity(of, i, v);
        phi += of->points[i].c * vec_norm(of->points[i].u);
        all += of->points[i].c;
    }
    for (size_t i = 0; i < of->count && phi > 0; i++) of->points[i].u = vec_scale(all / phi, of->points[i].u);
}

void limit_surface_normal(struct limit_point *points, size_t count, struct vec F, double M)
{
    struct surface of = {.points = points, .count = count};
    struct twist v;
    if (!(hypot(vec_norm(F), M) > 0)) F = (struct vec){1, 0};
    set_surface(&of, F, M);
    for (size_t p = 0; p < count; p++)
        if (pivot_of(&of, p, &v) && rests(&of, p, v)) {
            set_velocities(&of, v, p);
            return;
        }
    set_velocities(&of, smooth_least(&of), count);
}
