/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Loads: the forces and moments that a body lists.
 */
#include "scene/load_entry.h"
#include "scene/slip_law.h"
#include "scene/values.h"

/* ---- springs and dampers */

static bool finish_anchored_spring(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    bool fine = true;
    if (entry_has(entry, "neutral")) {
        entry_note(entry, "not-here", node_find(entry->chosen.node, "neutral")->at,
                   "the length without force is `free_length`",
                   "a spring between two points has no `neutral`");
        fine = false;
    }
    if (load->free_length < 0) {
        entry_note(entry, "out-of-range", node_find(entry->chosen.node, "free_length")->value->at, NULL,
                   "`free_length` must be zero or above");
        fine = false;
    }
    return fine;
}

/* True, with a note, if `to` names a body or a point of one: then the spring must be a coupling. */
static bool ends_on_body(struct entry *entry)
{
    const struct node *to = entry->keys.to;
    const struct scene *scene = entry->reader->scene;
    if (to->kind != node_scalar || node_find(entry->reader->points, to->text)) return false;
    size_t length = strcspn(to->text, ".");
    for (size_t b = 0; b < scene->body_count; b++) {
        const char *name = scene->bodies[b].name, *kind = entry->chosen.kind->name;
        if (strlen(name) != length || memcmp(name, to->text, length) != 0) continue;
        diag_add(
            entry->reader->errors, FBD_ERROR, "unknown-point", to->at,
            diag_hint(entry->reader->errors,
                      "write at the top level `couplings: [%s: {between: [%s, %s], %s}]`, and delete it here",
                      kind, scene->bodies[entry->body].name, to->text,
                      strcmp(kind, "spring") == 0 ? "stiffness: ..." : "coefficient: ..."),
            "`%s` is a body: a %s between two bodies is a coupling", name, kind);
        return true;
    }
    return false;
}

bool link_finish(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    if (entry->keys.to) {
        if (ends_on_body(entry)) return false;
        load->anchor = (struct point){.kind = point_fixed, .at = entry->keys.to->at};
        bool anchor = ground_point_read(entry->reader, entry->keys.to, "to", &load->anchor.where);
        return finish_anchored_spring(entry) && anchor;
    }
    if (!entry->motion || entry_has(entry, "to")) return true;
    if (entry_is_slide(entry)) {
        if (entry_has(entry, "neutral")) load->free_length = entry->keys.neutral;
        return entry_exclude(entry, "free_length", "neutral", "on a slide without `to` they mean the same");
    }
    diag_add(entry->reader->errors, FBD_ERROR, "missing-key", entry->chosen.at,
             "add its other end: `to: [x, y]`, or the name of a point of the ground", "%s needs `to`",
             entry->chosen.kind->group->name);
    return false;
}

/* ---- friction, drag */

/* The node of a coefficient; a single value may replace the mapping. */
static const struct node *coefficient_node(const struct entry *entry, const char *key)
{
    const struct pair *pair = node_find(entry->chosen.node, key);
    return pair ? pair->value : entry->chosen.node;
}

/* A coefficient given by one key determines the other one. */
static bool share_coefficient(struct entry *entry, const char *key, const struct value *given,
                              enum slip_name slip, struct value *other)
{
    enum quantity quantity = entry->keys.load.kind == load_friction ? a_number : a_moment;
    return slip_law_share(entry->reader, coefficient_node(entry, key), key, quantity, slip, &entry->scope,
                          given, other);
}

static bool share_friction(struct entry *entry, bool single)
{
    struct load *load = &entry->keys.load;
    if (single) {
        load->mu_k = entry->keys.coefficient;
        return share_coefficient(entry, "coefficient", &load->mu_k, slip_resting, &load->mu_s);
    }
    if (!entry_has(entry, "static"))
        return share_coefficient(entry, "kinetic", &load->mu_k, slip_resting, &load->mu_s);
    if (!entry_has(entry, "kinetic"))
        return share_coefficient(entry, "static", &load->mu_s, slip_moving, &load->mu_k);
    return load->mu_s.expr && load->mu_k.expr;
}

bool friction_finish(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    const char *hint = "`coefficient` means both";
    bool single = entry_has(entry, "coefficient") || entry->keys.coefficient.expr;
    bool fine = entry_exclude(entry, "coefficient", "static", hint) &&
                entry_exclude(entry, "coefficient", "kinetic", hint);
    if (!single && !entry_has(entry, "static") && !entry_has(entry, "kinetic")) {
        entry_note(entry, "missing-key", entry->chosen.at, "add for example `static: 0.5, kinetic: 0.4`",
                   "`friction` needs `static`, `kinetic` or one `coefficient` for both");
        return false;
    }
    if (!share_friction(entry, single)) return false;
    bool constant = expr_is_constant(load->mu_s.expr) && expr_is_constant(load->mu_k.expr);
    if (constant && expr_value(load->mu_k.expr) > expr_value(load->mu_s.expr))
        diag_add(entry->reader->errors, FBD_WARNING, "kinetic-above-static", load->mu_k.at,
                 "are the two exchanged?", "kinetic friction is above static friction");
    return fine;
}

bool normal_finish(struct entry *entry)
{
    entry->keys.load.side = (enum normal_side)entry->keys.side;
    return true;
}

bool moment_spring_finish(struct entry *entry)
{
    entry->keys.load.free_length = entry->keys.neutral;
    return true;
}

/* V is differentiated by coordinates, so it may depend on them alone. */
bool potential_finish(struct entry *entry)
{
    const struct value *V = &entry->keys.load.potential;
    if (!V->expr || expr_is_constant(V->expr)) return true;
    const int *slots;
    size_t count = expr_variables(V->expr, &slots), n = entry->reader->scene->coordinate_count;
    if (count == 0 || (size_t)slots[count - 1] <= 2 * n) return true;
    entry_note(entry, "not-here", V->at, "write V in the coordinates of the body",
               "a potential cannot depend on a place in the world or on a state");
    return false;
}

/* ---- entries */

static bool check_place(const struct entry *entry, const struct kinds *kinds)
{
    const struct kind *kind = entry->chosen.kind;
    if (!entry->motion || (kind->motions & 1u << entry->motion->kind)) return true;
    diag_add(entry->reader->errors, FBD_ERROR, "not-here", entry->chosen.at, kind->elsewhere,
             "the %s `%s` cannot act on this body: it moves as `%s`", kinds->noun, kind->name,
             motion_kinds.kinds[entry->motion->kind].name);
    return false;
}

static bool read_entry(struct entry *entry, const struct kinds *kinds, const struct node *node)
{
    struct reader *reader = entry->reader;
    struct load *load = &entry->keys.load;
    if (!kind_read(reader, kinds, node, kinds == &force_kinds ? "forces" : "moments", &entry->chosen))
        return false;
    load->kind = (enum load_kind)entry->chosen.kind->value;
    load->law = entry->chosen.kind->law;
    load->at = entry->chosen.at;
    ((struct names *)entry->scope.context)->slip_named = false;
    if (!check_place(entry, kinds)) return false;
    bool fine = fields_read(reader, entry->chosen.kind->group, entry->chosen.node, entry->chosen.at,
                            &entry->scope, &entry->keys);
    bool keyed = !entry->chosen.node || entry->chosen.node->kind == node_map;
    if (!fine && !keyed) return false;
    if (entry->keys.at && !entry_place_read(entry)) fine = false;
    return (!load->law->finish || load->law->finish(entry)) && fine;
}

/* Note duplicate weight or normal force, and friction without a normal force. */
static bool check_together(struct reader *reader, int index)
{
    const struct body *body = &reader->scene->bodies[index];
    struct draft *draft = &reader->drafts[index];
    bool seen[load_normal + 1] = {false}, fine = true;
    for (size_t i = 0; i < body->load_count; i++) {
        const struct load *load = &body->loads[i];
        if (load->kind == load_friction || load->kind == moment_friction) draft->has_friction = true;
        if (load->kind != load_gravity && load->kind != load_normal) continue;
        if (seen[load->kind]) {
            diag_add(reader->errors, FBD_ERROR, "duplicate-load", load->at, "delete one of them",
                     "`%s` acts on `%s` twice", load->kind == load_gravity ? "gravity" : "normal",
                     body->name);
            fine = false;
        }
        seen[load->kind] = true;
    }
    draft->has_normal = seen[load_normal];
    for (size_t i = 0; i < body->load_count; i++) {
        if (body->loads[i].kind != load_friction || draft->has_normal) continue;
        diag_add(reader->errors, FBD_ERROR, "needs-normal", body->loads[i].at,
                 "add `normal` to the list: friction is a part of the force of the surface",
                 "`friction` on `%s` needs `normal`", body->name);
        fine = false;
    }
    return fine;
}

static size_t entry_count(const struct node *list)
{
    return !list ? 0 : list->kind == node_list ? list->count : 1;
}

/* An entry of a list, or the single entry that replaces it. */
static const struct node *entry_at(const struct node *list, size_t index)
{
    return list->kind == node_list ? list->items[index] : list;
}

bool body_loads_read(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    const struct draft *draft = &reader->drafts[index];
    const struct node *lists[] = {draft->keys.forces, draft->keys.moments};
    const struct kinds *const kinds[] = {&force_kinds, &moment_kinds};
    struct names names = {.reader = reader, .place = place_load, .body = index};
    size_t most = entry_count(lists[0]) + entry_count(lists[1]);
    const char **given = ARENA_ARRAY(reader->arena, most, const char *);
    struct pos *places = ARENA_ARRAY(reader->arena, most, struct pos);
    body->loads = ARENA_ARRAY(reader->arena, most, struct load);
    if (!given || !places || !body->loads) return false;
    bool fine = true;
    for (int list = 0; list < 2; list++)
        for (size_t i = 0; i < entry_count(lists[list]); i++) {
            struct entry entry = {.reader = reader, .body = index, .scope = names_scope(&names)};
            if (draft->motion_known) entry.motion = &body->motion;
            bool read = read_entry(&entry, kinds[list], entry_at(lists[list], i));
            if (!read) fine = false;
            if (!entry.chosen.kind) continue;
            /* Keep a faulty load for later checks: friction finds its normal, names are checked. */
            const struct pair *name = node_find(entry.chosen.node, "name");
            given[body->load_count] = entry.keys.name;
            places[body->load_count] = name ? name->value->at : entry.chosen.at;
            body->loads[body->load_count++] = entry.keys.load;
        }
    bool named = body_loads_name(reader, index, given, places);
    return check_together(reader, index) && named && fine;
}
