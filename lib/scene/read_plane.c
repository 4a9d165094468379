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

/* Several points on one plane would share the friction of a body that sticks in an indeterminate way. */
__attribute__((unused)) static bool is_only(struct reader *reader, const struct constraint *constraint)
{
    const struct scene *scene = reader->scene;
    for (const struct constraint *other = scene->constraints; other < constraint; other++)
        if (other->kind == constraint_plane && other->body[0] == constraint->body[0] &&
            other->body[1] == constraint->body[1])
            return refuse(reader, constraint->at, "not-here",
                          "the body lies on this plane with another point already",
                          "one point, with the whole normal force");
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
                  "write `normal`, an expression of t");
}

bool plane_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    constraint->end_count = 2;
    constraint->body[1] = ground_body;
    constraint->point[0] = (struct point){.kind = point_G, .at = constraint->at};
    constraint->mu_s = keys->mu_s;
    constraint->mu_k = keys->mu_k;
    constraint->normal = keys->normal;
    constraint->share = 1;
    if (!body_name_read(reader, keys->body, "body", &constraint->body[0])) return false;
    if (constraint->body[0] == ground_body)
        return refuse(reader, constraint->at, "not-here", "the ground cannot lie on the plane",
                      "name a body, and the ground as `on`");
    if (keys->at && !body_point_read(reader, constraint->body[0], keys->at, "at", &constraint->point[0]))
        return false;
    if (!keys->mu_k.expr)
        return refuse(reader, constraint->at, "missing-key", "`plane_friction` needs a coefficient",
                      "add `kinetic: 0.3`, and `static` if that is another one");
    return read_plane(reader, keys->on, constraint) &&
           has_normal(reader, constraint);
}
