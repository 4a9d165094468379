/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Motion: the coordinates of a body, where they are counted from, and their values at t = 0.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <math.h>

static bool read_slide(struct reader *reader, const struct chosen *chosen, struct motion *motion)
{
    struct slide_keys keys = {0};
    const char *hint = "a line has its direction and its zero";
    bool fine = fields_read(reader, chosen->kind->group, chosen->node, chosen->at, &reader->constants, &keys);
    if (!fields_exclude(reader, chosen->node, "line", "along", hint)) fine = false;
    if (!fields_exclude(reader, chosen->node, "line", "through", hint)) fine = false;
    motion->along = keys.along;
    if (keys.through && !ground_point_read(reader, keys.through, "through", &motion->through)) fine = false;
    if (!keys.line) return fine;
    const struct ground_line *line = ground_line_find(reader, keys.line);
    if (!line) return false;
    motion->along = line->along;
    motion->through = line->through;
    return fine;
}

/* The centre of mass of the parts: the sum of m r over the sum of m. One part keeps its centre to the last
 * bit. */
static struct vec centre_of_mass(const struct body *body)
{
    double mass = 0;
    struct vec moment = {0, 0};
    for (size_t i = 0; i < body->part_count; i++) {
        mass += body->parts[i].mass;
        moment = vec_add(moment, vec_scale(body->parts[i].mass, body->parts[i].center));
    }
    return body->part_count == 1 ? body->parts[0].center : vec_scale(1 / mass, moment);
}

static bool read_pivot(struct reader *reader, int index, const struct chosen *chosen, struct motion *motion)
{
    struct pivot_keys keys = {0};
    struct point point = {0};
    bool fine = fields_read(reader, chosen->kind->group, chosen->node, chosen->at, &reader->constants, &keys);
    if (keys.at && !ground_point_read(reader, keys.at, "at", &motion->through)) fine = false;
    if (keys.point && !body_point_read(reader, index, keys.point, "point", &point)) return false;
    motion->point = point.kind == point_G ? centre_of_mass(&reader->scene->bodies[index]) : point.where;
    return fine;
}

/* A moment of inertia stated about the pivot needs one. */
static bool check_about_pivot(struct reader *reader, const struct body *body)
{
    bool fine = true;
    for (size_t i = 0; i < body->part_count && body->motion.kind != motion_pivot; i++) {
        if (!body->parts[i].about_pivot) continue;
        diag_add(reader->errors, FBD_ERROR, "not-here", body->parts[i].about.at,
                 "O is the axis of a `pivot`: say G, a point of the body or [x, y]",
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
    bool about = check_about_pivot(reader, body), fine;
    switch (body->motion.kind) {
    case motion_slide: fine = read_slide(reader, &chosen, &body->motion); break;
    case motion_pivot: fine = read_pivot(reader, index, &chosen, &body->motion); break;
    default: {
        char nothing; /* no key of these groups has a value yet */
        fine = fields_read(reader, chosen.kind->group, chosen.node, chosen.at, &reader->constants, &nothing);
    }
    }
    return fine && about;
}

bool body_initial_read(struct reader *reader, int index)
{
    struct scene *scene = reader->scene;
    const struct body *body = &scene->bodies[index];
    const struct draft *draft = &reader->drafts[index];
    const struct pair *pair = node_find(draft->node, "initial");
    struct initial_keys keys = {{0}, {0}};
    if (!draft->keys.initial || !draft->motion_known) return true;
    bool fine = fields_read(reader, &initial_groups[body->motion.kind], draft->keys.initial, pair->at,
                            &reader->constants, &keys);
    for (int i = 0; i < body->count; i++) {
        scene->coordinates[body->first + i].initial = keys.q[i];
        scene->coordinates[body->first + i].initial_rate = keys.v[i];
    }
    return fine;
}
