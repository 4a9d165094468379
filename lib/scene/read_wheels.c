/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ends of constraints, and the constraints of points and of circles: pins, rods, gears, belts, racks, rolls.
 */
#include "scene/couplings.h"
#include "scene/values.h"

#include <string.h>

/* ---- ends */

static bool add_end(struct reader *reader, const struct node *node, const char *key,
                    struct constraint *constraint)
{
    int k = constraint->end_count++;
    return coupling_end_read(reader, node, key, &constraint->body[k], &constraint->point[k]);
}

static bool refuse_count(struct reader *reader, const struct node *list, const char *key, const char *hint)
{
    diag_add(reader->errors, FBD_ERROR, "wrong-type", list->at, hint, "`%s` has %zu entries", key,
             list->count);
    return false;
}

bool coupling_ends_read(struct reader *reader, const struct node *list, const char *key, size_t least,
                        size_t most, struct constraint *constraint)
{
    if (!list) return false; /* noted before */
    if (list->count < least || list->count > most)
        return refuse_count(reader, list, key, least == most ? "write [a.P, b.Q]" : "between 2 and 8 places");
    bool fine = true;
    for (size_t i = 0; i < list->count; i++)
        if (!add_end(reader, list->items[i], key, constraint)) fine = false;
    bool moves = false, same = false;
    for (int k = 0; k < constraint->end_count; k++) {
        if (constraint->body[k] != ground_body) moves = true;
        if (k > 0 && constraint->body[k] != ground_body && constraint->body[k] == constraint->body[k - 1])
            same = true;
    }
    if (!fine || (moves && !same)) return fine;
    diag_add(reader->errors, FBD_ERROR, "same-body", list->at, "name points of two bodies",
             same || constraint->end_count == 2 ? "both ends are on the same body: nothing would act"
                                                : "every place of it is on the ground: nothing would act");
    return false;
}

const struct part *body_round_part(const struct body *body)
{
    for (size_t i = 0; i < body->part_count; i++)
        if (body->parts[i].radius > 0 && body->parts[i].mass >= 0) return &body->parts[i];
    return NULL;
}

bool body_turns(const struct body *body)
{
    const struct joint_type *joint = motion_joint(&body->motion);
    return joint->angle >= 0 || joint->count == 0; /* a welded body turns with the one that it is fixed on */
}

bool coupling_circle_set(struct reader *reader, struct constraint *constraint, int k, double radius)
{
    const struct body *body = &reader->scene->bodies[constraint->body[k]];
    const struct part *part = body_round_part(body);
    constraint->radius[k] = radius > 0 ? radius : part ? part->radius : 0;
    if (part) constraint->point[k] = (struct point){.kind = point_fixed, .where = part->center};
    if (constraint->radius[k] > 0 && body_turns(body)) return true;
    diag_add(reader->errors, FBD_ERROR, body_turns(body) ? "missing-key" : "not-here", constraint->at,
             body_turns(body) ? "give the radius, or the body a round `shape`" : "use `pivot` or `planar`",
             body_turns(body) ? "`%s` has no radius" : "`%s` does not turn", body->name);
    return false;
}

/* ---- points and circles */

static bool needs_body(struct reader *reader, const struct constraint *constraint, int k)
{
    if (constraint->body[k] != ground_body) return true;
    diag_add(reader->errors, FBD_ERROR, "not-here", constraint->at, NULL,
             "the ground cannot be an end of this coupling");
    return false;
}

bool points_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    return coupling_ends_read(reader, keys->between, "between", 2, 2, constraint);
}

bool wheels_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    double radii[2] = {0, 0};
    if (!coupling_ends_read(reader, keys->between, "between", 2, 2, constraint)) return false;
    if (!needs_body(reader, constraint, 0) || !needs_body(reader, constraint, 1)) return false;
    if (keys->radii && keys->radii->count != 2)
        return refuse_count(reader, keys->radii, "radii", "one for each of the two");
    for (size_t k = 0; keys->radii && k < 2; k++)
        if (!value_number(reader, keys->radii->items[k], "radii", a_length, positive, &radii[k]))
            return false;
    for (int k = 0; k < 2; k++)
        if (!coupling_circle_set(reader, constraint, k, radii[k])) return false;
    if (keys->inside) constraint->radius[1] = -constraint->radius[1];
    constraint->crossed = keys->crossed;
    constraint->tension = keys->tension;
    return true;
}

bool rack_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    if (!coupling_ends_read(reader, keys->between, "between", 2, 2, constraint)) return false;
    if (!strchr(keys->between->items[1]->text, '.')) /* without a point: its x axis, not its centre of mass */
        constraint->point[1] = (struct point){.kind = point_fixed, .at = constraint->at};
    return needs_body(reader, constraint, 0) && needs_body(reader, constraint, 1) &&
           coupling_circle_set(reader, constraint, 0, keys->radius);
}

/* A rolling body without shape is drawn by the circle that rolls. */
static void set_rim(struct reader *reader, const struct constraint *constraint)
{
    struct body *body = &reader->scene->bodies[constraint->body[0]];
    struct part *part = &body->parts[0];
    const struct point *center = &constraint->point[0];
    if (body->part_count != 1 || part->shape != shape_given) return;
    part->rim = constraint->radius[0];
    part->hub = center->kind == point_fixed ? center->where : body_centre_of_mass(body);
}

/* `on` is a line of the ground, or a body: then the line is the x axis of its frame. */
bool roll_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    const struct node *on = keys->on;
    if (!body_name_read(reader, keys->body, "body", &constraint->body[0])) return false;
    constraint->end_count = 2;
    constraint->body[1] = ground_body;
    if (!needs_body(reader, constraint, 0) || !coupling_circle_set(reader, constraint, 0, keys->radius))
        return false;
    if (keys->center &&
        !body_point_read(reader, constraint->body[0], keys->center, "center", &constraint->point[0]))
        return false;
    set_rim(reader, constraint);
    constraint->point[1] = (struct point){.kind = point_fixed, .at = on->at};
    constraint->mu_s = keys->mu_s;
    constraint->mu_k = keys->mu_k;
    if (!surface_speed_read(reader, &keys->surface_speed, constraint)) return false;
    if (node_find(reader->bodies, on->text)) return body_name_read(reader, on, "on", &constraint->body[1]);
    const struct ground_line *line = ground_line_find(reader, on);
    if (!line) return false;
    constraint->point[1].where = line->through;
    constraint->along = line->along;
    return true;
}
