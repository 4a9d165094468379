/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Actuators: a given moment or force between two bodies. It is one load of the first body with a partner, as a
 * spring between two bodies is, so that its opposite on the second body is the same number.
 */
#include "scene/couplings.h"
#include "scene/load_entry.h"
#include "scene/values.h"

/* ---- ends */

/* An end of a moment: a body, the ground, or a point as that of a force, where the moment is drawn. */
static bool read_moment_end(struct reader *reader, const struct node *node, int *body, struct point *point)
{
    if (node->kind != node_scalar || strchr(node->text, '.'))
        return coupling_end_read(reader, node, "between", body, point);
    if (!body_name_read(reader, node, "between", body)) return false;
    *point = (struct point){.kind = *body == ground_body ? point_fixed : point_G, .at = node->at};
    return true;
}

static bool read_end(struct reader *reader, const struct coupling_keys *keys, int end,
                     struct force_coupling *coupling)
{
    const struct node *node = keys->between->items[end];
    int *body = &coupling->body[end];
    struct point *point = &coupling->point[end];
    return coupling->load.kind == moment_applied ? read_moment_end(reader, node, body, point)
                                                 : coupling_end_read(reader, node, "between", body, point);
}

static bool read_ends(struct reader *reader, const struct coupling_keys *keys,
                      struct force_coupling *coupling)
{
    const struct node *list = keys->between;
    if (!list) return false; /* noted before */
    if (list->count != 2) {
        diag_add(reader->errors, FBD_ERROR, "wrong-type", list->at, "write [a, b], or [a.P, b.Q] for a force",
                 "`between` needs two ends, not %zu", list->count);
        return false;
    }
    const bool first = read_end(reader, keys, 0, coupling), second = read_end(reader, keys, 1, coupling);
    if (!first || !second) return false;
    if (coupling->body[0] != coupling->body[1]) return true;
    diag_add(reader->errors, FBD_ERROR, "same-body", list->at, "name two bodies",
             "both ends are on the same body: nothing would act");
    return false;
}

/* A moment, and a force in a given direction, is that on the first body. */
static bool check_first(struct reader *reader, const struct coupling_keys *keys,
                        const struct force_coupling *coupling)
{
    const bool either = coupling->load.kind == load_actuator && !coupling->load.guided;
    if (either || coupling->body[0] != ground_body) return true;
    diag_add(reader->errors, FBD_ERROR, "wrong-type", keys->between->items[0]->at,
             "write [body, ground] and change its sign",
             "the first end of `between` is the body on which the actuator acts, not the ground");
    return false;
}

/* ---- a moment */

/* True if the body turns, or is carried by one that does. */
static bool is_turned(const struct scene *scene, int body)
{
    for (; body != ground_body; body = scene->bodies[body].motion.parent)
        if (motion_joint(&scene->bodies[body].motion)->angle >= 0 || scene->bodies[body].motion.turns)
            return true;
    return false;
}

static bool check_turning(struct reader *reader, const struct coupling_keys *keys,
                          const struct force_coupling *coupling)
{
    const struct scene *scene = reader->scene;
    bool turned = false;
    for (int end = 0; end < 2; end++) {
        const int body = coupling->body[end];
        turned |= is_turned(scene, body);
        if (body == ground_body || scene->bodies[body].motion.kind != motion_particle) continue;
        diag_add(reader->errors, FBD_ERROR, "not-here", keys->between->items[end]->at,
                 "use `planar` for a body that turns",
                 "a moment cannot act on `%s`: a particle does not turn", scene->bodies[body].name);
        return false;
    }
    if (turned) return true;
    diag_add(reader->errors, FBD_ERROR, "not-here", keys->between->at,
             "name a body on a `pivot`, or one that is `planar`; a `force` acts between bodies on slides",
             "neither of the two bodies turns: the moment would do nothing");
    return false;
}

/* ---- a force */

static bool read_force(struct reader *reader, const struct chosen *chosen, struct names *names,
                       const struct coupling_keys *keys, struct force_coupling *coupling)
{
    struct entry entry = {.reader = reader,
                          .body = coupling->body[0],
                          .chosen = *chosen,
                          .keys = {.load = coupling->load, .value = keys->force},
                          .scope = names_scope(names)};
    struct load *load = &entry.keys.load;
    names->distance_known = !load->guided;
    names->distance_named = false;
    const bool read =
        value_formula(reader, keys->force, "force", a_force, stored, &entry.scope, &load->value);
    names->distance_known = false;
    if (!read) return false;
    load->point = coupling->point[0];
    load->target = coupling->body[1];
    load->end = coupling->point[1];
    if (!load->guided && !derive_zero_distance(&entry, names->distance_named)) return false;
    coupling->load = *load;
    return true;
}

/* ---- the whole */

static bool check_keys(struct reader *reader, const struct chosen *chosen, bool moment)
{
    if (!fields_exclude(reader, chosen->node, "moment", "force", "write two actuators where both act") ||
        !fields_exclude(reader, chosen->node, "moment", "along", "a moment in the plane has no direction"))
        return false;
    if (moment || node_find(chosen->node, "force")) return true;
    diag_add(reader->errors, FBD_ERROR, "missing-key", chosen->at,
             "add for example `moment: 5 N*m`, or `force: 20 N`",
             "an actuator needs its `moment` or its `force`");
    return false;
}

bool actuator_read(struct reader *reader, const struct chosen *chosen, struct names *names,
                   const struct coupling_keys *keys, struct force_coupling *coupling)
{
    const bool moment = node_find(chosen->node, "moment") != NULL;
    struct load *load = &coupling->load;
    if (!check_keys(reader, chosen, moment)) return false;
    load->kind = moment ? moment_applied : load_actuator;
    load->guided = node_find(chosen->node, "along") != NULL;
    load->along = keys->along;
    if (!read_ends(reader, keys, coupling) || !check_first(reader, keys, coupling)) return false;
    if (!moment) return keys->force && read_force(reader, chosen, names, keys, coupling);
    load->value = keys->moment;
    return keys->moment.expr && check_turning(reader, keys, coupling);
}
