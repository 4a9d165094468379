/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/outline.h"

#include <string.h>

static void set_bar(struct outline_part *outline, struct vec along, double length)
{
    struct vec half = vec_scale(length / 2, along);
    outline->kind = outline_bar;
    outline->count = 2;
    outline->corner[0] = vec_sub(outline->center, half);
    outline->corner[1] = vec_add(outline->center, half);
}

static void set_rectangle(struct outline_part *outline, struct vec along, double length, double width)
{
    struct vec half = vec_scale(length / 2, along), across = vec_scale(width / 2, vec_perp(along));
    if (!(length > 0) || !(width > 0)) {
        if (length > 0 || width > 0)
            set_bar(outline, length > 0 ? along : vec_perp(along), fmax(length, width));
        return;
    }
    outline->kind = outline_polygon;
    outline->count = 4;
    outline->corner[0] = vec_add(outline->center, vec_add(half, across));
    outline->corner[1] = vec_add(outline->center, vec_sub(across, half));
    outline->corner[2] = vec_sub(outline->center, vec_add(half, across));
    outline->corner[3] = vec_add(outline->center, vec_sub(half, across));
}

static void set_circle(struct outline_part *outline, double radius, double inner)
{
    outline->kind = radius > 0 ? outline_circle : outline_dot;
    outline->radius = radius;
    outline->inner = inner;
}

/* Shapes of symmetry about x are circles when x faces the plane; from the side they are rectangles. The
 * sides of a prism are those of the two axes that lie in the plane. */
struct outline_part outline_of_part(const struct part *part)
{
    struct outline_part outline = {.kind = outline_dot, .hole = part->mass < 0, .center = part->center};
    struct vec along = vec_unit(part->angle);
    bool faces = part->axis == 'x';
    switch (part->shape) {
    case shape_point: break;
    case shape_rod:
        if (!faces) set_bar(&outline, along, part->length);
        break;
    case shape_sphere: set_circle(&outline, part->radius, 0); break;
    case shape_cylinder:
    case shape_hollow_cylinder:
        if (faces)
            set_circle(&outline, part->radius, part->inner_radius);
        else
            set_rectangle(&outline, along, part->length, 2 * part->radius);
        break;
    case shape_ring:
        if (faces)
            set_circle(&outline, part->radius, 0.94 * part->radius); /* thin, but visible */
        else
            set_bar(&outline, vec_perp(along), 2 * part->radius);
        break;
    case shape_prism:
        set_rectangle(&outline, along, part->side[faces ? 1 : 0], part->side[part->axis == 'z' ? 1 : 2]);
        break;
    case shape_polygon:
        outline.kind = outline_polygon;
        outline.count = part->corner_count;
        memcpy(outline.corner, part->corners, part->corner_count * sizeof *part->corners);
        break;
    case shape_given:
        outline.kind = outline_unknown;
        if (part->rim > 0) {
            outline.center = part->hub;
            set_circle(&outline, part->rim, 0);
        }
        break;
    }
    return outline;
}

static bool has_area(const struct outline_part *outline)
{
    return outline->kind == outline_circle || outline->kind == outline_polygon;
}

static bool contains(const struct outline_part *outline, struct vec p)
{
    if (outline->kind == outline_circle) {
        double r = vec_norm(vec_sub(p, outline->center));
        return r >= outline->inner && r <= outline->radius;
    }
    size_t left = 0, right = 0;
    for (size_t i = 0; i < outline->count; i++) {
        struct vec from = outline->corner[i], to = outline->corner[(i + 1) % outline->count];
        double side = vec_cross(vec_sub(to, from), vec_sub(p, from));
        left += side >= 0;
        right += side <= 0;
    }
    return left == outline->count || right == outline->count;
}

/* A hole is convex, so its centre belongs to it and must lie in the material. A tube as a hole has no
 * material to remove at its centre. */
const struct part *outline_hole_outside(const struct body *body)
{
    const struct part *outside = NULL;
    for (size_t i = 0; i < body->part_count; i++) {
        const struct outline_part hole = outline_of_part(&body->parts[i]);
        if (!has_area(&hole)) return NULL;
        bool inside = !hole.hole || hole.inner > 0;
        for (size_t k = 0; k < body->part_count && !inside; k++) {
            const struct outline_part other = outline_of_part(&body->parts[k]);
            inside = !other.hole && has_area(&other) && contains(&other, hole.center);
        }
        if (!inside && !outside) outside = &body->parts[i];
    }
    return outside;
}
