/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction of a body on a horizontal plane: the point that it rests on, and the force on the plane.
 */
#include "scene/couplings.h"
#include "scene/values.h"

#include <string.h>

static bool refuse(struct reader *reader, struct pos at, const char *id, const char *message,
                   const char *hint)
{
    diag_add(reader->errors, FBD_ERROR, id, at, hint, "%s", message);
    return false;
}

/* The plane: the ground, or a body. */
static bool read_plane(struct reader *reader, const struct node *on, struct constraint *constraint)
{
    constraint->point[1] = (struct point){.kind = point_fixed, .at = on ? on->at : constraint->at};
    if (!on || strcmp(on->text, "ground") == 0) return true;
    if (!body_name_read(reader, on, "on", &constraint->body[1])) return false;
    const struct body *body = &reader->scene->bodies[constraint->body[1]];
    if (body->motion.kind == motion_particle)
        return refuse(reader, on->at, "not-here", "a particle has no face that another body lies on",
                      "let it be `planar`, or on a slide or pivot");
    return constraint->body[1] != constraint->body[0] ||
           refuse(reader, on->at, "same-body", "the body lies on itself: nothing would act",
                  "name another body, or leave `on` out for the ground");
}

/* The weight of the body is on one point, or shared by the points of one entry. Bodies lie on each other in one order. */
static bool fits_others(struct reader *reader, const struct constraint *constraint)
{
    const struct scene *scene = reader->scene;
    for (const struct constraint *other = scene->constraints; other < constraint; other++) {
        if (other->kind != constraint_plane) continue;
        if (other->body[0] == constraint->body[0] && !(other->normal.expr && constraint->normal.expr))
            return refuse(reader, constraint->at, "missing-key",
                          "the body lies on several points, and the part of its weight on each is open",
                          "write `normal` for each of them, or one entry with `points`");
        if (other->body[0] == constraint->body[1] && other->body[1] == constraint->body[0])
            return refuse(reader, constraint->at, "not-here", "the other body lies on this one already",
                          "let the entries of `plane_friction` between two bodies name the same `on`");
    }
    return true;
}

/* Its weight is the default of a mass that does not vary. */
static bool has_normal(struct reader *reader, const struct constraint *constraint)
{
    const struct body *body = &reader->scene->bodies[constraint->body[0]];
    if (constraint->normal.expr) return true;
    if (reader->scene->pressing == 0)
        return refuse(reader, constraint->at, "missing-key", "`plane_friction` needs the force on the plane",
                      "write `normal: 5 N`; or `plane: horizontal` at the top of the file, for its weight");
    return !body->mass.expr ||
           refuse(reader, constraint->at, "missing-key", "the weight of a body of varying mass varies",
                  "add `normal`, an expression of t");
}

/* The points of a body that shares its weight among them. Each is a constraint of its own. */
static bool read_points(struct reader *reader, const struct node *points, struct constraint *constraint)
{
    enum { least = 2, most = 3 };
    struct scene *scene = reader->scene;
    if (scene->bodies[constraint->body[0]].motion.kind == motion_particle)
        return refuse(reader, points->at, "not-here", "a particle has no points",
                      "leave `points` out, or let the body be `planar`");
    if (points->count < least || points->count > most)
        return refuse(reader, points->at, "not-here",
                      "equilibrium shares the weight among two or three points",
                      points->count < least ? "write the only point as `at`"
                                            : "write an entry with `at` and `normal` for each point");
    constraint->points = (int)points->count;
    for (size_t k = 0; k < points->count; k++) {
        struct constraint *own = constraint + k;
        *own = *constraint;
        own->place = (int)k;
        if (!body_point_read(reader, own->body[0], points->items[k], "points", &own->point[0])) return false;
    }
    scene->constraint_count += points->count - 1;
    return true;
}

/* A list of names or lists is no pair of coordinates, but several points. */
static bool is_one_point(struct reader *reader, const struct constraint *constraint, const struct node *at)
{
    const struct body *body = &reader->scene->bodies[constraint->body[0]];
    struct point named;
    for (size_t i = 0; at->kind == node_list && i < at->count; i++) {
        const struct node *item = at->items[i];
        if (item->kind == node_scalar && !names_point(body, item->text, item->length, &named)) continue;
        return refuse(reader, item->at, "not-here", "`at` is one point, the name of one or [x, y]",
                      "write two or three of them under `points`");
    }
    return true;
}

bool plane_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    constraint->end_count = 2;
    constraint->body[1] = ground_body;
    constraint->point[0] = (struct point){.kind = point_G, .at = constraint->at};
    constraint->mu_s = keys->mu_s;
    constraint->mu_k = keys->mu_k;
    constraint->normal = keys->normal;
    constraint->points = 1;
    if (!body_name_read(reader, keys->body, "body", &constraint->body[0])) return false;
    if (constraint->body[0] == ground_body)
        return refuse(reader, constraint->at, "not-here", "the ground cannot lie on the plane",
                      "name a body, and the ground as `on`");
    if (!keys->mu_k.expr)
        return refuse(reader, constraint->at, "missing-key", "`plane_friction` needs a coefficient",
                      "add `kinetic: 0.3`, and `static` if that is another one");
    if (keys->at && keys->points)
        return refuse(reader, keys->points->at, "conflicting-keys", "`at` and `points` exclude each other",
                      "keep one of them");
    if (!read_plane(reader, keys->on, constraint) || !fits_others(reader, constraint) ||
        !has_normal(reader, constraint))
        return false;
    if (keys->points) return read_points(reader, keys->points, constraint);
    if (keys->at && !is_one_point(reader, constraint, keys->at)) return false;
    return !keys->at || body_point_read(reader, constraint->body[0], keys->at, "at", &constraint->point[0]);
}
