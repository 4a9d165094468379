/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Applied forces and drag: point of application, direction, wind.
 */
#include "scene/load_entry.h"
#include "scene/values.h"

bool entry_pair_read(struct entry *entry, const struct node *node, const char *what, enum quantity quantity,
                     const char *hint, struct value *x, struct value *y)
{
    if (node->kind != node_list || node->count != 2)
        return value_refuse_list(entry->reader, node, what, "a pair [x, y]", hint);
    bool first = value_formula(entry->reader, node->items[0], what, quantity, 0, &entry->scope, x);
    return value_formula(entry->reader, node->items[1], what, quantity, 0, &entry->scope, y) && first;
}

/* ---- point of application */

static const char offset_hint[] = "write for example `offset: [0.1 m, 0]`, along the axes of the world";

bool entry_place_read(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    const struct node *at = entry->keys.at;
    struct place_keys place = {.point = at};
    if (at->kind == node_map && load->kind != load_applied) {
        entry_note(entry, "not-here", at->at, "write the name of a point of the body, or [x, y] in its frame",
                   "only an applied force takes an `offset`");
        return false;
    }
    if (at->kind == node_map) {
        place.point = NULL;
        if (!fields_read(entry->reader, &place_group, at, at->at, &entry->scope, &place)) return false;
    }
    if (place.point && !body_point_read(entry->reader, entry->body, place.point, "at", &load->point))
        return false;
    entry->offset = place.offset;
    return !place.offset || entry_pair_read(entry, place.offset, "offset", a_length, offset_hint,
                                            &load->offset_x, &load->offset_y);
}

/* ---- applied forces */

static bool read_component(struct entry *entry, const struct node *node, struct value *value)
{
    return value_formula(entry->reader, node, "value", a_force, stored, &entry->scope, value);
}

static bool read_applied_value(struct entry *entry)
{
    const struct node *value = entry->keys.value;
    struct load *load = &entry->keys.load;
    if (value->kind != node_list) return read_component(entry, value, &load->value);
    if (value->count != 2) {
        entry_note(entry, "wrong-type", value->at, "write [fx, fy]", "`value` must be one force or a pair");
        return false;
    }
    bool x = read_component(entry, value->items[0], &load->fx);
    return read_component(entry, value->items[1], &load->fy) && x;
}

static bool fill_component(struct entry *entry, const char *key, struct value *value)
{
    if (value->expr || entry_has(entry, key)) return value->expr != NULL;
    *value =
        (struct value){.expr = expr_constant(entry->reader->arena, 0, DIM_FORCE), .at = entry->chosen.at};
    return value->expr != NULL;
}

/* A force given by its size needs a direction; a slide has one. */
static bool check_direction(struct entry *entry)
{
    if (entry_has(entry, "angle") || entry_has(entry, "toward") || !entry->motion || entry_is_slide(entry))
        return true;
    entry_note(entry, "missing-key", entry->chosen.at,
               "add its direction, `angle: 0 deg` for one along x or `toward: [1 m, 0]` to a point, or write "
               "`value: [fx, fy]`",
               "an applied force needs `angle`, unless it acts on a slide");
    return false;
}

/* Read `toward`: [x, y] on the ground, or the end of a coupling. */
static bool read_toward(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    const struct node *node = entry->keys.toward;
    load->target = ground_body;
    load->toward = "a point of the ground";
    load->end = (struct point){.kind = point_fixed, .at = node->at};
    if (node->kind == node_list) return ground_point_read(entry->reader, node, "toward", &load->end.where);
    if (node->kind == node_scalar && strcmp(node->text, "ground") == 0) {
        entry_note(entry, "unknown-point", node->at, "name a point of it, `ground.P`, or write [x, y]",
                   "`toward` needs a point: the ground has no centre");
        return false;
    }
    if (!coupling_end_read(entry->reader, node, "toward", &load->target, &load->end)) return false;
    load->toward = arena_text(entry->reader->arena, node->text, node->length);
    if (!load->toward) return false;
    if (load->target != entry->body) return true;
    entry_note(entry, "same-body", node->at,
               "for a direction that turns with the body write `angle` and `frame: body`",
               "`toward` names a point of the body that the force acts on");
    return false;
}

/* Components exclude the keys of a size with direction. */
static bool check_form(struct entry *entry, bool components, bool pair)
{
    const char *hint = "give its size (and angle) or its components";
    bool fine = entry_exclude(entry, "value", "fx", hint) && entry_exclude(entry, "value", "fy", hint);
    const char *const directions[] = {"angle", "toward"};
    for (int i = 0; i < 2; i++) {
        const char *key = directions[i];
        if (components && !entry_exclude(entry, key, entry_has(entry, "fx") ? "fx" : "fy", hint))
            fine = false;
        if (pair && !entry_exclude(entry, key, "value", hint)) fine = false;
    }
    if (!entry_exclude(entry, "toward", "angle", "they both say its direction")) fine = false;
    return fine &&
           entry_exclude(entry, "toward", "frame", "the direction to a point is the same in any frame");
}

/* Derive direction and moment from the entry. */
static bool derive(struct entry *entry, const struct names *names)
{
    struct load *load = &entry->keys.load;
    if (load->toward && !derive_toward(entry, names->distance_named)) return false;
    return !load_is_placed(load) || derive_couple(entry, names->distance_named);
}

/* True if an unknown key was refused: the missing key may have been meant by it, so no second note is given. */
static bool has_unknown_key(const struct entry *entry)
{
    const struct node *node = entry->chosen.node;
    for (size_t i = 0; node && node->kind == node_map && i < node->count; i++)
        if (!fields_has(entry->chosen.kind->group, node->pairs[i].key)) return true;
    return false;
}

bool applied_finish(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    struct names *names = entry->scope.context;
    bool components = entry_has(entry, "fx") || entry_has(entry, "fy");
    bool pair = entry->keys.value && entry->keys.value->kind == node_list;
    bool fine = check_form(entry, components, pair);
    load->body_frame = entry->keys.frame == frame_body;
    if (entry->keys.toward && !read_toward(entry)) fine = false;
    names->distance_known = entry->keys.toward != NULL;
    names->distance_named = false;
    bool value = !entry->keys.value || read_applied_value(entry);
    names->distance_known = false;
    if (!value) return false;
    if (components && !entry->keys.value)
        return fill_component(entry, "fx", &load->fx) && fill_component(entry, "fy", &load->fy) && fine &&
               derive(entry, names);
    if (!entry->keys.value && !entry_has(entry, "value")) {
        if (!has_unknown_key(entry))
            entry_note(entry, "missing-key", entry->chosen.at, "add for example `value: 5 N`",
                       "an applied force needs `value`");
        return false;
    }
    return (pair || components || check_direction(entry)) && fine && derive(entry, names);
}

/* ---- drag */

bool drag_finish(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    if (!entry_has(entry, "linear") && !entry_has(entry, "quadratic")) {
        entry_note(entry, "missing-key", entry->chosen.at, "add for example `linear: 0.5 N*s/m`",
                   "`drag` needs `linear` or `quadratic`");
        return false;
    }
    if (!entry->keys.wind) return true;
    return entry_pair_read(entry, entry->keys.wind, "wind", a_velocity,
                           "write for example `wind: [2 m/s, 0]`", &load->wind_x, &load->wind_y) &&
           derive_wind(entry);
}
