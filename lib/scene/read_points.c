/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies and their points, where other entries of the file name them.
 */
#include "scene/reader.h"
#include "scene/values.h"

#include <string.h>

/* ---- points of a body */

struct vec body_centre_of_mass(const struct body *body)
{
    double mass = 0;
    struct vec moment = {0, 0};
    for (size_t i = 0; i < body->part_count; i++) {
        mass += body->parts[i].mass;
        moment = vec_add(moment, vec_scale(body->parts[i].mass, body->parts[i].center));
    }
    /* the exact centre of a single part, without rounding */
    return body->part_count == 1 || mass == 0 ? body->parts[0].center : vec_scale(1 / mass, moment);
}

static void note_unknown_point(struct reader *reader, int index, const struct node *node, const char *what)
{
    enum { most_listed = 60 };
    const struct body *body = &reader->scene->bodies[index];
    const char *names[most_listed] = {"G"};
    size_t count = 1;
    if (reader->drafts[index].motion_known && motion_joint(&body->motion)->has_axis) names[count++] = "O";
    for (size_t i = 0; i < body->point_count && count < most_listed; i++)
        names[count++] = body->points[i].name;
    diag_add(reader->errors, FBD_ERROR, "unknown-point", node->at,
             diag_nearest(reader->errors, node->text, names, count), "`%s`: `%s` has no point %s", what,
             body->name, value_found(reader, node));
}

/* True if a point may be missing because of an error noted before. */
static bool is_excused(const struct draft *draft, const char *name)
{
    bool pivot = strcmp(name, "O") == 0 && !draft->motion_known;
    return pivot || draft->faulty_parts || node_find(draft->keys.points, name);
}

bool body_point_read(struct reader *reader, int index, const struct node *node, const char *what,
                     struct point *point)
{
    const struct body *body = &reader->scene->bodies[index];
    const struct draft *draft = &reader->drafts[index];
    *point = (struct point){.kind = point_fixed, .at = node->at};
    if (node->kind == node_list) return value_vector(reader, node, what, a_length, &point->where);
    if (node->kind != node_scalar)
        return value_refuse(reader, node, what, "a pair [x, y] or the name of a point of the body", NULL);
    if (strcmp(node->text, "G") == 0) {
        point->kind = point_G;
        return true;
    }
    if (strcmp(node->text, "O") == 0 && draft->motion_known && motion_joint(&body->motion)->has_axis) {
        point->where = body->motion.point;
        return true;
    }
    for (size_t i = 0; i < body->point_count; i++) {
        if (strcmp(node->text, body->points[i].name) != 0) continue;
        point->where = body->points[i].where;
        return true;
    }
    if (!is_excused(draft, node->text)) note_unknown_point(reader, index, node, what);
    return false;
}

bool body_name_read(struct reader *reader, const struct node *node, const char *what, int *body)
{
    enum { most_listed = 100 };
    const char *names[most_listed];
    *body = ground_body;
    if (node->kind != node_scalar) return value_refuse(reader, node, what, "the name of a body", NULL);
    if (strcmp(node->text, "ground") == 0) return true;
    const struct pair *pair = node_find(reader->bodies, node->text);
    if (pair) {
        *body = (int)(pair - reader->bodies->pairs);
        return true;
    }
    size_t count = 0, there = reader->bodies ? reader->bodies->count : 0; /* the file may have none */
    for (; count < there && count < most_listed; count++) names[count] = reader->bodies->pairs[count].key;
    diag_add(reader->errors, FBD_ERROR, "unknown-body", node->at,
             diag_nearest(reader->errors, node->text, names, count), "`%s`: there is no body %s", what,
             value_found(reader, node));
    return false;
}

/* ---- ends: body.point, ground.point, or a body for its centre of mass */

const struct node *text_part(struct reader *reader, const struct node *whole, size_t from, size_t length)
{
    struct node *part = ARENA_ARRAY(reader->arena, 1, struct node);
    char *text = arena_text(reader->arena, whole->text + from, length);
    if (!part || !text) return NULL;
    *part = *whole;
    part->text = text;
    part->length = length;
    part->at.column += (int)from;
    return part;
}

bool coupling_end_read(struct reader *reader, const struct node *node, const char *what, int *body,
                       struct point *point)
{
    if (node->kind != node_scalar)
        return value_refuse(reader, node, what, "a point as `body.point` or `ground.point`", NULL);
    const char *dot = strchr(node->text, '.');
    size_t length = dot ? (size_t)(dot - node->text) : node->length;
    const struct node *owner = text_part(reader, node, 0, length);
    if (!dot && ground_end_refuse(reader, node, what, false)) return false;
    if (!owner || !body_name_read(reader, owner, what, body)) return false;
    if (!dot) {
        *point = (struct point){.kind = point_G, .at = node->at};
        return true;
    }
    const struct node *name = text_part(reader, node, length + 1, node->length - length - 1);
    if (!name) return false;
    if (*body != ground_body) return body_point_read(reader, *body, name, what, point);
    *point = (struct point){.kind = point_fixed, .at = node->at};
    return ground_point_read(reader, name, what, &point->where);
}
