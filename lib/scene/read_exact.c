/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The exact solution of a body, if given; errors are computed from it.
 */
#include "scene/fields.h"
#include "scene/reader.h"

bool body_exact_read(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    const struct draft *draft = &reader->drafts[index];
    const struct pair *pair = node_find(draft->node, "exact");
    if (!draft->keys.exact || !draft->motion_known) return true;
    struct names names = {.reader = reader, .place = place_exact, .body = index};
    struct scope scope = names_scope(&names);
    struct exact_keys keys = {.q = {{0}}, .v = {{0}}};
    bool fine =
        fields_read(reader, &exact_groups[body->motion.kind], draft->keys.exact, pair->at, &scope, &keys);
    for (int k = 0; k < body->count; k++) {
        body->exact[k] = keys.q[k];
        body->exact[body->count + k] = keys.v[k];
    }
    return fine;
}
