/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The parent of a body: the ground, or another body. Read when all motions are known, so that a body may
 * stand before its parent.
 */
#include "scene/reader.h"
#include "scene/values.h"

#include <string.h>

/* Note a position of an axis in the world that names a point of the body itself. */
static bool is_own_point(struct reader *reader, int index, const struct node *node)
{
    const struct body *body = &reader->scene->bodies[index];
    if (node->kind != node_scalar || node_find(reader->points, node->text)) return false;
    for (size_t i = 0; i < body->point_count; i++) {
        if (strcmp(body->points[i].name, node->text) != 0) continue;
        diag_add(reader->errors, FBD_ERROR, "unknown-point", node->at,
                 diag_hint(reader->errors,
                           "which point of it sits on the axis is `point: %s`; `at` is where in the world",
                           node->text),
                 "`%s` is a point of `%s`, not of the ground", node->text, body->name);
        return true;
    }
    return false;
}

/* Read a point of the parent in its frame. */
static bool read_place(struct reader *reader, int parent, const struct node *node, const char *what,
                       struct vec *where)
{
    struct point point;
    if (!node) return true;
    if (parent == ground_body) return ground_point_read(reader, node, what, where);
    if (!body_point_read(reader, parent, node, what, &point)) return false;
    *where = point.kind == point_G ? body_centre_of_mass(&reader->scene->bodies[parent]) : point.where;
    return true;
}

static bool read_line(struct reader *reader, const struct node *name, struct motion *motion)
{
    const struct ground_line *line = ground_line_find(reader, name);
    if (!line) return false;
    motion->along = line->along;
    motion->through = line->through;
    return true;
}

bool body_parent_read(struct reader *reader, int index)
{
    struct motion *motion = &reader->scene->bodies[index].motion;
    const struct motion_keys *keys = &reader->drafts[index].motion_keys;
    if (!reader->drafts[index].motion_known) return true; /* noted before */
    if (keys->on && !body_name_read(reader, keys->on, "on", &motion->parent)) return false;
    const struct joint_type *joint = motion_joint(motion);
    if (joint->count == 0 && keys->on && motion->parent == ground_body) {
        diag_add(reader->errors, FBD_ERROR, "not-here", motion->at, "leave the body out: it does not move",
                 "a body that is welded to the ground has no motion");
        return false;
    }
    if (motion->parent == index) return true; /* noted by parents_check */
    const bool line = joint->path == path_line;
    const struct node *place = line ? keys->through : keys->at;
    if (place && motion->parent == ground_body && is_own_point(reader, index, place)) return false;
    bool fine = read_place(reader, motion->parent, place, line ? "through" : "at", &motion->through);
    if (keys->line && !read_line(reader, keys->line, motion)) fine = false;
    return fine;
}

/* Find circles: each body has one parent. From every body walk to the ground or to a body of an earlier walk;
 * reaching a body of the same walk closes a circle. */
bool parents_check(struct reader *reader)
{
    struct scene *scene = reader->scene;
    int count = (int)scene->body_count;
    int *walk = ARENA_ARRAY(reader->arena, (size_t)count,
                            int); /* 0, or the number of the walk that visited the body */
    if (!walk) return false;
    bool fine = true;
    for (int start = 0; start < count; start++) {
        int b = start;
        while (b != ground_body && walk[b] == 0) {
            walk[b] = start + 1;
            b = scene->bodies[b].motion.parent;
        }
        if (b == ground_body || walk[b] != start + 1) continue;
        fine = false;
        diag_add(reader->errors, FBD_ERROR, "motion-in-a-circle", scene->bodies[b].motion.at,
                 "let one of them move on the ground; a closed loop is a tree and a `pin` under `couplings`",
                 "`%s` moves on `%s`, and that in the end on `%s`", scene->bodies[b].name,
                 scene->bodies[scene->bodies[b].motion.parent].name, scene->bodies[b].name);
        scene->bodies[b].motion.parent = ground_body; /* one note for each circle */
        scene->bodies[b].complete = false;
    }
    return fine;
}
