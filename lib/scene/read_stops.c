/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Stops: `min` and `max` of a slide or pivot.
 */
#include "scene/coupling_names.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <assert.h>

static const struct node *stop_of(const struct reader *reader, size_t body, int end)
{
    const struct motion_keys *keys = &reader->drafts[body].motion_keys;
    return end == 0 ? keys->low : keys->high;
}

size_t stops_count(const struct reader *reader)
{
    size_t count = 0;
    for (size_t b = 0; b < reader->scene->body_count; b++)
        for (int end = 0; end < 2; end++) count += stop_of(reader, b, end) != NULL;
    return count;
}

/* Check that `max` is above `min`, e at most 1, and the coordinate not prescribed. */
static bool check_stops(struct reader *reader, size_t b, const double limit[2])
{
    const struct body *body = &reader->scene->bodies[b];
    const struct draft *draft = &reader->drafts[b];
    const struct node *high = stop_of(reader, b, 1), *low = stop_of(reader, b, 0);
    const struct node *told = high ? high : low;
    assert(told); /* the body has a stop */
    struct pos at = told->at;
    if (body->motion.prescribed.expr) {
        diag_add(reader->errors, FBD_ERROR, "not-here", at, "leave it out",
                 "the motion of `%s` is prescribed: no stop could hold it", body->name);
        return false;
    }
    if (draft->motion_keys.restitution > 1) {
        diag_add(reader->errors, FBD_ERROR, "out-of-range", at, "1 gives all energy back",
                 "`restitution` must be at most 1");
        return false;
    }
    if (!low || !high || limit[1] > limit[0]) return true;
    diag_add(reader->errors, FBD_ERROR, "out-of-range", at, NULL, "`max` must be above `min`");
    return false;
}

static void add_stop(struct reader *reader, size_t b, int end, double limit, struct coupling_name *name)
{
    struct scene *scene = reader->scene;
    const struct body *body = &scene->bodies[b];
    struct pos at = stop_of(reader, b, end)->at;
    struct constraint *stop = &scene->constraints[scene->constraint_count++];
    *stop = (struct constraint){.kind = constraint_contact,
                                .at = at,
                                .end_count = 2,
                                .body = {(int)b, body->motion.parent},
                                .contact = {.stop = end == 0 ? 1 : -1, .limit = limit}};
    stop->contact.e = reader->drafts[b].motion_keys.restitution;
    *name = (struct coupling_name){arena_printf(reader->arena, end == 0 ? "%s_min" : "%s_max", body->name),
                                   contact_kind,
                                   at,
                                   {ground_body, ground_body}};
}

bool stops_read(struct reader *reader, struct coupling_name *names)
{
    bool fine = true;
    for (size_t b = 0; b < reader->scene->body_count; b++) {
        double limit[2] = {0, 0};
        const bool angle = motion_joint(&reader->scene->bodies[b].motion)->angle == 0;
        const enum quantity quantity = angle ? an_angle : a_length;
        bool any = false, read = true;
        for (int end = 0; end < 2; end++) {
            const struct node *node = stop_of(reader, b, end);
            if (!node) continue;
            any = true;
            read &= value_number(reader, node, end == 0 ? "min" : "max", quantity, 0, &limit[end]);
        }
        if (!any) continue;
        if (!read || !check_stops(reader, b, limit)) fine = false;
        for (int end = 0; end < 2; end++)
            if (stop_of(reader, b, end)) add_stop(reader, b, end, limit[end], names++);
    }
    return fine;
}
