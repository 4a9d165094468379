/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Motion: the coordinates of a body, their reference, and their values at t = 0.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

static bool read_slide(struct reader *reader, const struct chosen *chosen, const struct motion_keys *keys)
{
    const char *hint = "a line has its direction and its zero";
    bool fine = fields_exclude(reader, chosen->node, "line", "along", hint);
    if (!fields_exclude(reader, chosen->node, "line", "through", hint)) fine = false;
    if (keys->line && !fields_exclude(reader, chosen->node, "line", "on", "lines are those of the ground"))
        fine = false;
    return fine;
}

static bool read_own_point(struct reader *reader, int index, const struct motion_keys *keys)
{
    struct body *body = &reader->scene->bodies[index];
    struct point point = {0};
    if (keys->point && !body_point_read(reader, index, keys->point, "point", &point)) return false;
    body->motion.point = point.kind == point_G ? body_centre_of_mass(body) : point.where;
    return true;
}

/* Note `about: O` on a body without a pivot. */
static bool check_about_pivot(struct reader *reader, const struct body *body)
{
    bool fine = true;
    for (size_t i = 0; i < body->part_count && !motion_joint(&body->motion)->has_axis; i++) {
        if (!body->parts[i].about_pivot) continue;
        diag_add(reader->errors, FBD_ERROR, "not-here", body->parts[i].about.at,
                 "O is the axis of a `pivot`: give G, a point of the body or [x, y]",
                 "`%s` has no pivot that `about: O` could mean", body->name);
        fine = false;
    }
    return fine;
}

bool body_motion_read(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    struct draft *draft = &reader->drafts[index];
    struct chosen chosen;
    if (!draft->keys.motion || !kind_read(reader, &motion_kinds, draft->keys.motion, "motion", &chosen))
        return false;
    body->motion.kind = (enum motion_kind)chosen.kind->value;
    body->motion.at = chosen.at;
    draft->motion_known = true;
    struct motion_keys *keys = &draft->motion_keys;
    keys->turn = true;
    bool about = check_about_pivot(reader, body);
    bool fine = fields_read(reader, chosen.kind->group, chosen.node, chosen.at, &reader->constants, keys);
    const struct joint_type *joint = motion_joint(&body->motion);
    body->motion.along = joint->path == path_line ? keys->along : keys->angle;
    if (joint->path == path_line && !read_slide(reader, &chosen, keys)) fine = false;
    if (joint->path == path_curve && fine) fine = track_read(reader, index);
    draft->motion_read = fine && read_own_point(reader, index, keys);
    return draft->motion_read && about;
}

bool body_initial_read(struct reader *reader, int index)
{
    struct scene *scene = reader->scene;
    struct body *body = &scene->bodies[index];
    const struct draft *draft = &reader->drafts[index];
    const struct pair *pair = node_find(draft->node, "initial");
    struct initial_keys keys = {.assemble = false};
    if (!draft->keys.initial || !draft->motion_known) return true;
    bool fine = fields_read(reader, &initial_groups[body->motion.kind], draft->keys.initial, pair->at,
                            &reader->constants, &keys);
    body->assemble = keys.assemble;
    bool on_curve = motion_joint(&body->motion)->path == path_curve;
    if (on_curve && !track_initial_read(reader, index, &keys)) fine = false;
    for (int i = 0; i < body->count; i++) {
        scene->coordinates[body->first + i].initial = keys.q[i];
        scene->coordinates[body->first + i].initial_rate = keys.v[i];
    }
    return fine;
}

/* Read a prescribed coordinate, a function of time alone. It excludes `initial` and dry friction in the
 * joint. */
bool body_prescribed_read(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    const struct draft *draft = &reader->drafts[index];
    const struct node *node = draft->motion_keys.prescribed;
    if (!node || !draft->motion_known) return true;
    const struct joint_coordinate *coordinate = motion_joint(&body->motion)->coordinates;
    const char *name = coordinate->name;
    struct names names = {.reader = reader, .place = place_load, .body = index};
    struct scope scope = names_scope(&names);
    const int *slots;
    if (!value_formula(reader, node, name, coordinate->angle ? an_angle : a_length, 0, &scope,
                       &body->motion.prescribed))
        return false;
    const struct expr *expr = body->motion.prescribed.expr;
    bool fine = true;
    if (!expr_is_constant(expr) && expr_variables(expr, &slots) > 0) {
        diag_add(reader->errors, FBD_ERROR, "not-here", node->at, "write it as an expression of t",
                 "a prescribed `%s` cannot depend on a motion", name);
        fine = false;
    }
    if (body->motion.prescribed.by_input) {
        diag_add(reader->errors, FBD_ERROR, "not-here", node->at, "let a force or a spring follow the input",
                 "a prescribed `%s` cannot name an input: the place would jump with it", name);
        fine = false;
    }
    if (fine) smoothness_note(reader, node->at, name, expr);
    const struct pair *initial = node_find(draft->node, "initial");
    if (initial) {
        diag_add(reader->errors, FBD_ERROR, "conflicting-keys", initial->at, "delete it",
                 "the motion of `%s` is prescribed: it has no initial state", body->name);
        fine = false;
    }
    for (size_t i = 0; i < body->load_count; i++) {
        if (body->loads[i].kind != load_friction && body->loads[i].kind != moment_friction) continue;
        diag_add(reader->errors, FBD_ERROR, "not-here", body->loads[i].at,
                 "leave it out: the drive would only take that much more",
                 "the motion of `%s` is prescribed: friction in its joint has no effect on it", body->name);
        fine = false;
    }
    return fine;
}
