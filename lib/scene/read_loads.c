/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Loads: the forces and moments that a body lists.
 */
#include "scene/load_entry.h"

static bool check_place(const struct entry *entry, const struct kinds *kinds)
{
    const struct kind *kind = entry->chosen.kind;
    if (!entry->motion || (kind->motions & 1u << entry->motion->kind)) return true;
    diag_add(entry->reader->errors, FBD_ERROR, "not-here", entry->chosen.at, kind->elsewhere,
             "the %s `%s` cannot act on this body: it moves as `%s`", kinds->noun, kind->name,
             motion_joint(entry->motion)->name);
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
    load->lifetime = lifetime_of(reader, entry->keys.since, entry->keys.until);
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
        if (load->kind == load_gravity && reader->scene->pressing > 0) {
            diag_add(reader->errors, FBD_ERROR, "not-here", load->at,
                     "leave it out; `plane_friction` under `couplings` takes the weight by itself",
                     "in a horizontal plane the weight of `%s` has no component", body->name);
            fine = false;
        }
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
