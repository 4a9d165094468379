/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Contacts. A body without a point is in contact with all its shapes; a named point is a corner.
 */
#include "scene/couplings.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <math.h>
#include <string.h>

/* Read a line, polygon or point of the ground as the second end. */
static bool read_surface(struct reader *reader, const struct node *name, struct constraint *constraint)
{
    struct contact_law *contact = &constraint->contact;
    constraint->body[1] = ground_body;
    constraint->point[1] = (struct point){.kind = point_fixed, .at = name->at};
    if (node_find(reader->polygons, name->text)) {
        contact->polygon = ground_polygon_find(reader, name);
        return contact->polygon->count > 0;
    }
    if (node_find(reader->points, name->text))
        return ground_point_read(reader, name, "between", &constraint->point[1].where);
    const struct ground_line *line = ground_line_find(reader, name);
    if (!line) return false;
    contact->line = true;
    constraint->point[1].where = line->through;
    constraint->along = line->along;
    return true;
}

/* Read `body` or `body.point` as end k. */
static bool read_side(struct reader *reader, const struct node *node, int k, struct constraint *constraint)
{
    if (ground_end_refuse(reader, node, "between", true)) return false;
    if (node->kind == node_scalar && strchr(node->text, '.'))
        return coupling_end_read(reader, node, "between", &constraint->body[k], &constraint->point[k]);
    constraint->point[k] = (struct point){.at = node->at};
    return node->kind == node_scalar ? body_name_read(reader, node, "between", &constraint->body[k])
                                     : value_refuse(reader, node, "between", "a body or `body.point`", NULL);
}

static bool is_ground(const struct node *node)
{
    return node->kind == node_scalar &&
           (strncmp(node->text, "ground.", strlen("ground.")) == 0 || strcmp(node->text, "ground") == 0);
}

/* A body without a point needs a shape. */
static bool has_shape(struct reader *reader, const struct constraint *constraint, int k)
{
    if (constraint->body[k] == ground_body || constraint->point[k].kind != point_absent) return true;
    const struct body *body = &reader->scene->bodies[constraint->body[k]];
    if (!body->complete) return false;
    for (size_t i = 0; i < body->part_count; i++)
        if (body->parts[i].shape != shape_given && body->parts[i].mass > 0) return true;
    diag_add(reader->errors, FBD_ERROR, "no-shape", constraint->point[k].at,
             "give it a `shape`, or name the contact point: `body.point`", "`%s` has no shape for a contact",
             body->name);
    return false;
}

static bool read_sides(struct reader *reader, const struct node *list, struct constraint *constraint)
{
    const struct node *first = list->items[0], *second = list->items[1];
    if (is_ground(first) && is_ground(second)) {
        diag_add(reader->errors, FBD_ERROR, "same-body", list->at, "name a body and its partner",
                 "both ends are on the ground: nothing would act");
        return false;
    }
    if (is_ground(first)) {
        first = list->items[1];
        second = list->items[0];
    }
    if (!read_side(reader, first, 0, constraint)) return false;
    if (!is_ground(second)) return read_side(reader, second, 1, constraint);
    if (ground_end_refuse(reader, second, "between", true)) return false;
    size_t skip = strlen("ground.");
    const struct node *name = text_part(reader, second, skip, second->length - skip);
    return name && read_surface(reader, name, constraint);
}

static bool check_restitution(struct reader *reader, const struct value *e)
{
    if (!e->expr || !expr_is_constant(e->expr) || expr_value(e->expr) <= 1) return true;
    diag_add(reader->errors, FBD_ERROR, "out-of-range", e->at, "1 gives all energy back",
             "`restitution` must be at most 1");
    return false;
}

/* Read the side of a line of the ground; a vertical line has no side `up`. */
static bool read_line_side(struct reader *reader, const struct node *list, int side,
                           struct constraint *constraint)
{
    const double upright = 1e-12;
    if (side == contact_side_start) return true;
    double up = cos(constraint->along);
    bool any_up = fabs(up) > upright;
    if (constraint->contact.line && (side != contact_side_up || any_up)) {
        bool left = side == contact_side_up ? up > 0 : side == contact_side_left;
        constraint->contact.side = left ? 1 : -1;
        return true;
    }
    diag_add(reader->errors, FBD_ERROR, "not-here", list->at,
             constraint->contact.line ? "give `left` or `right` of its direction" : "leave `side` out",
             constraint->contact.line ? "no side of a vertical line is up"
                                      : "`side` is that of a line of the ground, and this is none");
    return false;
}

/* True for a coefficient of zero, which is equivalent to no friction. */
static bool is_none(const struct value *mu)
{
    return mu->expr && expr_is_constant(mu->expr) && expr_value(mu->expr) == 0;
}

bool surface_speed_read(struct reader *reader, const struct value *speed, struct constraint *constraint)
{
    const int *slots;
    if (!speed->expr) return true;
    if (speed->by_input) {
        diag_add(reader->errors, FBD_ERROR, "not-here", speed->at, "let a force on a body follow the input",
                 "`surface_speed` cannot name an input here: a body that sticks would jump with it");
        return false;
    }
    if (expr_is_constant(speed->expr) && expr_value(speed->expr) == 0) return true;
    constraint->surface_speed = *speed;
    if (expr_variables(speed->expr, &slots) > 0) {
        diag_add(reader->errors, FBD_ERROR, "not-here", speed->at, "write it as an expression of t",
                 "`surface_speed` cannot depend on a motion here: a belt that a body drives is a body");
        return false;
    }
    for (size_t i = 0; i < expr_switches(speed->expr); i++) {
        if (!expr_switch_jumps(speed->expr, i)) continue;
        diag_add(reader->errors, FBD_ERROR, "not-here", speed->at,
                 "let it grow in a short time, as `v*clamp(t/0.1[s], 0, 1)`",
                 "`surface_speed` jumps: a body that sticks cannot follow");
        return false;
    }
    return true;
}

/* A surface without friction moves nothing along. */
static bool check_surface(struct reader *reader, const struct constraint *constraint)
{
    const struct value *speed = &constraint->surface_speed;
    if (!speed->expr || constraint->mu_s.expr) return true;
    diag_add(reader->errors, FBD_ERROR, "missing-key", speed->at,
             "add for example `static: 0.5, kinetic: 0.4`",
             "`surface_speed` needs friction: without it the surface moves nothing along");
    return false;
}

bool contact_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    const struct node *list = keys->between;
    if (!list) {
        diag_add(reader->errors, FBD_ERROR, "missing-key", constraint->at,
                 "write `between: [ball, ground.floor]`, or `among: all` for all pairs",
                 "a contact needs `between` or `among`");
        return false;
    }
    if (list->count != 2) {
        diag_add(reader->errors, FBD_ERROR, "wrong-type", list->at, "write [body, ground.line]",
                 "`between` needs two ends, not %zu", list->count);
        return false;
    }
    constraint->end_count = 2;
    constraint->contact.law = keys->law;
    constraint->contact.restitution = keys->restitution;
    constraint->mu_s = keys->mu_s.expr ? keys->mu_s : keys->mu_k;
    constraint->mu_k = keys->mu_k.expr ? keys->mu_k : keys->mu_s;
    if (is_none(&constraint->mu_s) && is_none(&constraint->mu_k))
        constraint->mu_s = constraint->mu_k = (struct value){0};
    if (!surface_speed_read(reader, &keys->surface_speed, constraint) || !check_surface(reader, constraint))
        return false;
    if (!check_restitution(reader, &keys->restitution) || !read_sides(reader, list, constraint)) return false;
    if (!read_line_side(reader, list, keys->side, constraint)) return false;
    if (constraint->body[0] == constraint->body[1]) {
        diag_add(reader->errors, FBD_ERROR, "same-body", list->at, "name two bodies",
                 "both ends are on the same body: nothing would act");
        return false;
    }
    return has_shape(reader, constraint, 0) && has_shape(reader, constraint, 1);
}
