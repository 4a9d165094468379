/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/inertia.h"

static double square(double a)
{
    return a * a;
}

/* Shapes with an axis of symmetry x: `along` about x, `across` about y and z. */
static double about_axis(char axis, double along, double across)
{
    return axis == 'x' ? along : across;
}

static double prism_inertia(const struct part *part)
{
    double a = square(part->side[0]), b = square(part->side[1]), c = square(part->side[2]);
    double sum = part->axis == 'x' ? b + c : part->axis == 'y' ? a + c : a + b;
    return part->mass * sum / 12;
}

/* About the centre of mass: the sum over the triangles from there to each side. */
static double polygon_inertia(const struct part *part)
{
    double area = 0, sum = 0;
    for (size_t i = 0; i < part->corner_count; i++) {
        const struct vec a = vec_sub(part->corners[i], part->center),
                         b = vec_sub(part->corners[(i + 1) % part->corner_count], part->center);
        const double twice = vec_cross(a, b);
        area += twice;
        sum += twice * (vec_dot(a, a) + vec_dot(a, b) + vec_dot(b, b));
    }
    return part->mass * sum / (6 * area);
}

static double given_inertia(const struct part *part, struct vec pivot)
{
    const double I = part->gyration > 0 ? part->mass * square(part->gyration) : part->inertia;
    if (part->about.kind != point_fixed && !part->about_pivot) return I;
    struct vec from = vec_sub(part->about_pivot ? pivot : part->about.where, part->center);
    return I - part->mass * vec_dot(from, from);
}

/* The moment of inertia of a homogeneous shape about the axis through its own centre that faces the plane.
 * Sources: the usual table, e.g. Meriam & Kraige, Dynamics, table D/4. For shape_given: the stated value,
 * moved from `about` to the centre; `pivot` is the point of the body that sits on the axis (used when the
 * value is stated about it). */
static double part_inertia(const struct part *part, struct vec pivot)
{
    double m = part->mass, R2 = square(part->radius), L2 = square(part->length);
    double both = R2 + square(part->inner_radius); /* hollow cylinder: R_o^2 + R_i^2 */
    switch (part->shape) {
    case shape_point: return 0;
    case shape_rod: return about_axis(part->axis, 0, m * L2 / 12);
    case shape_sphere: return 2 * m * R2 / 5;
    case shape_cylinder: return about_axis(part->axis, m * R2 / 2, m * (3 * R2 + L2) / 12);
    case shape_hollow_cylinder: return about_axis(part->axis, m * both / 2, m * (3 * both + L2) / 12);
    case shape_prism: return prism_inertia(part);
    case shape_polygon: return polygon_inertia(part);
    case shape_ring: return about_axis(part->axis, m * R2, m * R2 / 2);
    case shape_given: return given_inertia(part, pivot);
    }
    return 0;
}

struct inertia inertia_of_parts(const struct part *parts, size_t count, struct vec pivot)
{
    struct inertia sum = {0};
    struct vec moment = {0, 0};
    for (size_t i = 0; i < count; i++) {
        sum.mass += parts[i].mass;
        moment = vec_add(moment, vec_scale(parts[i].mass, parts[i].center));
    }
    /* A single part keeps its centre without rounding. */
    sum.G = count == 1 || sum.mass == 0 ? parts[0].center : vec_scale(1 / sum.mass, moment);
    for (size_t i = 0; i < count; i++) {
        struct vec d = vec_sub(parts[i].center, sum.G);
        sum.I_G += part_inertia(&parts[i], pivot) + parts[i].mass * vec_dot(d, d);
    }
    return sum;
}

double inertia_about(const struct inertia *inertia, struct vec point)
{
    struct vec d = vec_sub(inertia->G, point);
    return inertia->I_G + inertia->mass * vec_dot(d, d);
}
