/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/read_among.h"

#include <string.h>

#include "scene/couplings.h"
#include "scene/fields.h"
#include "scene/values.h"

enum { most_pairs = 20000 };

static const char ground_prefix[] = "ground.";
enum { prefix_length = sizeof ground_prefix - 1 };

/* A body, or a line, polygon or point of the ground. */
struct member {
    const struct node *name; /* as in `between` */
    int body;
    const struct ground_line *line; /* of the ground, or NULL */
};

/* The members of one `among`. */
struct membership {
    const struct node *entry;
    struct member *members;
    size_t count;
    bool all;
};

/* ---- entries */

static size_t count_of(const struct node *contacts)
{
    return !contacts ? 0 : contacts->kind == node_list ? contacts->count : 1;
}

/* One entry may stand without a list. */
static const struct node *entry_of(const struct node *contacts, size_t i)
{
    return contacts->kind == node_list ? contacts->items[i] : contacts;
}

/* The value of `among`, which may stand alone; NULL for an entry without it. */
static const struct node *among_of(const struct node *entry)
{
    if (entry->kind != node_map) return entry->kind == node_null ? NULL : entry;
    const struct pair *among = node_find(entry, "among");
    return among ? among->value : NULL;
}

/* ---- members */

static const struct node *name_node(struct reader *reader, struct pos at, const char *prefix,
                                    const char *name)
{
    struct node *node = ARENA_ARRAY(reader->arena, 1, struct node);
    const char *text = arena_printf(reader->arena, "%s%s", prefix, name);
    if (!node || !text) return NULL;
    *node = (struct node){.kind = node_scalar, .height = 1, .at = at, .size = 1};
    node->text = text;
    node->length = strlen(text);
    node->text_at = at;
    return node;
}

static const struct ground_line *line_of(const struct reader *reader, const struct node *name)
{
    const struct pair *pair = node_find(reader->lines, name->text + prefix_length);
    return pair ? &reader->ground_lines[pair - reader->lines->pairs] : NULL;
}

static bool has_outline(const struct body *body)
{
    for (size_t i = 0; i < body->part_count; i++)
        if (body->parts[i].shape != shape_given && body->parts[i].mass > 0) return true;
    return false;
}

static bool add_ground(struct reader *reader, const struct node *map, struct pos at, struct membership *group)
{
    for (size_t i = 0; map && i < map->count; i++) {
        const struct node *name = name_node(reader, at, ground_prefix, map->pairs[i].key);
        if (!name) return false;
        group->members[group->count++] = (struct member){name, ground_body, line_of(reader, name)};
    }
    return true;
}

static bool add_all(struct reader *reader, struct pos at, struct membership *group)
{
    const struct scene *scene = reader->scene;
    for (size_t b = 0; b < scene->body_count; b++) {
        if (!has_outline(&scene->bodies[b])) continue;
        const struct node *name = name_node(reader, at, "", scene->bodies[b].name);
        if (!name) return false;
        group->members[group->count++] = (struct member){name, (int)b, NULL};
    }
    return add_ground(reader, reader->lines, at, group) && add_ground(reader, reader->polygons, at, group);
}

static bool add_listed(struct reader *reader, const struct node *list, struct membership *group)
{
    for (size_t i = 0; i < list->count; i++) {
        struct member *member = &group->members[group->count++];
        const struct node *name = list->items[i];
        *member = (struct member){name, ground_body, NULL};
        if (name->kind == node_scalar && strncmp(name->text, ground_prefix, prefix_length) == 0)
            member->line = line_of(reader, name);
        else if (!body_name_read(reader, name, "among", &member->body))
            return false;
    }
    return true;
}

static size_t count_all(const struct reader *reader)
{
    return reader->scene->body_count + (reader->lines ? reader->lines->count : 0) +
           (reader->polygons ? reader->polygons->count : 0);
}

static bool list_members(struct reader *reader, const struct node *among, struct membership *group)
{
    const bool listed = among->kind == node_list && among->count > 1;
    group->all = among->kind == node_scalar && strcmp(among->text, "all") == 0;
    if (!listed && !group->all) {
        diag_add(reader->errors, FBD_ERROR, "wrong-type", among->at,
                 "write `among: all` or `among: [ball, box, ground.floor]`, or name one pair: `between: "
                 "[ball, ground.floor]`",
                 "`among` must be `all`, or a list of two or more bodies, lines and polygons");
        return false;
    }
    group->members = ARENA_ARRAY(reader->arena, listed ? among->count : count_all(reader), struct member);
    if (!group->members) return false;
    return listed ? add_listed(reader, among, group) : add_all(reader, among->at, group);
}

/* ---- pairs */

/* Couplings by which bodies stay in touch, or in each other. */
static bool joins(enum constraint_kind kind)
{
    switch (kind) {
    case constraint_pin:
    case constraint_weld:
    case constraint_gear:
    case constraint_rack:
    case constraint_roll:
    case constraint_slot:
    case constraint_groove: return true;
    default: return false;
    }
}

static bool are_equal(struct vec a, struct vec b)
{
    return a.x == b.x && a.y == b.y;
}

static bool joins_pair(const struct constraint *constraint, const struct member *a, const struct member *b)
{
    const int *body = constraint->body;
    if (!joins(constraint->kind)) return false;
    if (b->body != ground_body)
        return (body[0] == a->body && body[1] == b->body) || (body[0] == b->body && body[1] == a->body);
    return constraint->kind == constraint_roll && body[0] == a->body && body[1] == ground_body && b->line &&
           constraint->along == b->line->along && are_equal(constraint->point[1].where, b->line->through);
}

/* Does one of the bodies move on the other, or along the line? */
static bool moves_on(const struct reader *reader, const struct member *a, const struct member *b)
{
    const struct body *bodies = reader->scene->bodies;
    if (b->body != ground_body)
        return bodies[a->body].motion.parent == b->body || bodies[b->body].motion.parent == a->body;
    const struct node *line = reader->drafts[a->body].motion_keys.line;
    return line && line->kind == node_scalar && strcmp(line->text, b->name->text + prefix_length) == 0;
}

static bool is_joined(const struct reader *reader, const struct member *a, const struct member *b)
{
    const struct scene *scene = reader->scene;
    bool joined = moves_on(reader, a, b);
    for (size_t i = 0; i < scene->constraint_count && !joined; i++)
        joined = joins_pair(&scene->constraints[i], a, b);
    return joined;
}

static bool is_particle(const struct reader *reader, const struct member *member)
{
    if (member->body == ground_body) return false;
    const struct body *body = &reader->scene->bodies[member->body];
    for (size_t i = 0; i < body->part_count; i++)
        if (body->parts[i].shape != shape_point) return false;
    return true;
}

static bool is_named(const struct node *end, const struct member *member)
{
    return end->kind == node_scalar && strcmp(end->text, member->name->text) == 0;
}

static bool names_pair(const struct node *between, const struct member *a, const struct member *b)
{
    if (!between || between->kind != node_list || between->count != 2) return false;
    const struct node *first = between->items[0], *second = between->items[1];
    return (is_named(first, a) && is_named(second, b)) || (is_named(first, b) && is_named(second, a));
}

/* Does `between` of an entry name this pair, or has one of the `count` pairs of earlier entries it? */
static bool is_taken(const struct node *contacts, const struct contact_pairs *list, size_t count,
                     const struct member *a, const struct member *b)
{
    for (size_t i = 0; i < count_of(contacts); i++) {
        const struct pair *between = node_find(entry_of(contacts, i), "between");
        if (between && names_pair(between->value, a, b)) return true;
    }
    for (size_t i = 0; i < count; i++)
        if (names_pair(list->pairs[i].between, a, b)) return true;
    return false;
}

/* `name_a_b`, with the default name of contacts. */
static const char *name_of(struct reader *reader, const struct node *entry, const struct member *a,
                           const struct member *b)
{
    const struct pair *name = entry->kind == node_map ? node_find(entry, "name") : NULL;
    const char *base = name && name->value->kind == node_scalar ? name->value->text : contact_kind->name;
    const char *other = b->name->text + (b->body == ground_body ? prefix_length : 0);
    return arena_printf(reader->arena, "%s_%s_%s", base, a->name->text, other);
}

static bool add_pair(struct reader *reader, const struct node *entry, const struct member *a,
                     const struct member *b, struct contact_pairs *list)
{
    struct node *between = ARENA_ARRAY(reader->arena, 1, struct node);
    const struct node **ends = ARENA_ARRAY(reader->arena, 2, const struct node *);
    const char *name = name_of(reader, entry, a, b);
    if (!between || !ends || !name) return false;
    ends[0] = a->name;
    ends[1] = b->name;
    *between = (struct node){.kind = node_list, .height = 2, .at = entry->at, .size = 3, .count = 2};
    between->items = ends;
    list->pairs[list->count++] = (struct contact_pair){entry, between, name};
    return true;
}

static bool add_pairs(struct reader *reader, const struct node *contacts, const struct membership *group,
                      struct contact_pairs *list)
{
    const size_t earlier = list->count;
    for (size_t i = 0; i < group->count; i++)
        for (size_t j = i + 1; j < group->count; j++) {
            bool turn = group->members[i].body == ground_body;
            const struct member *a = &group->members[turn ? j : i], *b = &group->members[turn ? i : j];
            bool particles = group->all && is_particle(reader, a) && is_particle(reader, b);
            if (a->body == b->body || particles || is_joined(reader, a, b) ||
                is_taken(contacts, list, earlier, a, b))
                continue;
            if (!add_pair(reader, group->entry, a, b, list)) return false;
        }
    return true;
}

/* ---- the list */

static bool add_entry(struct reader *reader, const struct node *contacts, const struct node *entry,
                      struct contact_pairs *list)
{
    static const char *const excluded[] = {"between", "side", "surface_speed"};
    const struct node *among = among_of(entry);
    struct membership group = {.entry = entry};
    if (!among) {
        list->pairs[list->count++] = (struct contact_pair){entry, NULL, NULL};
        return true;
    }
    for (size_t i = 0; i < sizeof excluded / sizeof *excluded; i++)
        if (!fields_exclude(reader, entry, "among", excluded[i],
                            "give the pair an entry of its own: `between: [a, b]`"))
            return false;
    return list_members(reader, among, &group) && add_pairs(reader, contacts, &group, list);
}

bool contact_pairs_count(struct reader *reader, const struct node *contacts, size_t *most)
{
    *most = 0;
    for (size_t i = 0; i < count_of(contacts); i++) {
        const struct node *entry = entry_of(contacts, i), *among = among_of(entry);
        const size_t members = !among ? 0 : among->kind == node_list ? among->count : count_all(reader);
        const size_t pairs = members > 1 ? members * (members - 1) / 2 : 1;
        *most += pairs;
        if (pairs <= most_pairs) continue;
        diag_add(reader->errors, FBD_ERROR, "out-of-range", entry->at,
                 "list those that may touch each other in several entries with `among`",
                 "`among` has %zu pairs, and may have at most %d", pairs, (int)most_pairs);
        return false;
    }
    return true;
}

bool contact_pairs_list(struct reader *reader, const struct node *contacts, struct contact_pairs *list)
{
    bool fine = true;
    for (size_t i = 0; i < count_of(contacts); i++)
        if (!add_entry(reader, contacts, entry_of(contacts, i), list)) fine = false;
    return fine;
}
