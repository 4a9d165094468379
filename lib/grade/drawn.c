/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The drawn entries of an answer: those with a value, and unknowns.
 *
 * An unknown has no `value`, `value: unknown`, or an otherwise unused name for its value, as `value: N`. A
 * force without a magnitude and without `angle`, on a body that does not slide, has no direction either; the
 * same holds for `angle: unknown`, and for two unknown components.
 */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "document/node_edit.h"
#include "fbd_grade.h"
#include "grade/lines.h"

const char *name_as_drawn(const struct fbd_grade *grade, const fbd_listed_force *force)
{
    const struct drawn *drawn = drawn_at(grade, (struct pos){force->line, force->column});
    return drawn && drawn->name ? drawn->name : force->arrow.name;
}

struct drawn *drawn_at(const struct fbd_grade *grade, struct pos at)
{
    for (struct drawn *one = grade->drawn; one; one = one->next)
        if (one->at.line == at.line && one->at.column == at.column) return one;
    return NULL;
}

/* ---- values */

static bool is_of_word(char c, bool first)
{
    bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    return letter || (!first && c >= '0' && c <= '9');
}

static bool is_word(const char *text)
{
    if (!is_of_word(*text, true)) return false;
    while (is_of_word(*text, false)) text++;
    return *text == '\0';
}

/* True for names that have a value in a file. */
static bool has_value(const struct fbd_grade *grade, const struct node *root, const char *name)
{
    static const char *const known[] = {"t",  "g",  "pi",    "e",     "x",     "y",     "v",
                                        "vx", "vy", "theta", "omega", "angle", "x_dot", "theta_dot"};
    static const char *const maps[] = {"parameters", "inputs", "states", "tables"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(name, known[i]) == 0) return true;
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        if (node_find(lines_value(root, maps[i]), name) ||
            node_find(lines_value(grade->key->root, maps[i]), name))
            return true;
    return false;
}

/* True if the value is unknown. *symbol: its name, or NULL; *minus: its sense is negative. */
static bool is_unknown(const struct fbd_grade *grade, const struct node *root, const struct node *value,
                       const char **symbol, bool *minus)
{
    *symbol = NULL;
    *minus = false;
    if (value->kind == node_null) return true;
    if (value->kind != node_scalar) return false;
    const char *text = value->text;
    *minus = *text == '-';
    text += *minus + strspn(text + *minus, " ");
    if (strcmp(text, "unknown") == 0 || strcmp(text, "?") == 0) return true;
    if (!is_word(text) || has_value(grade, root, text)) return false;
    *symbol = text;
    return true;
}

/* A value as part of an expression: `5 N` is `(5[N])`. */
static const char *as_expression(struct arena *arena, const struct node *value)
{
    if (!value || value->kind != node_scalar) return NULL;
    const char *text = value->text, *behind = text + strspn(text, "+-.0123456789");
    if ((*behind == 'e' || *behind == 'E') && behind > text) {
        const char *power = behind + 1 + strspn(behind + 1, "+-0123456789");
        if (power > behind + 1) behind = power;
    }
    const char *unit = behind + strspn(behind, " ");
    const bool number = strcspn(text, "0123456789") < (size_t)(behind - text);
    if (!number || !is_of_word(*unit, true)) return arena_printf(arena, "(%s)", text);
    return arena_printf(arena, "(%.*s[%s])", (int)(behind - text), text, unit);
}

/* ---- entries */

struct draft_place {
    struct fbd_grade *grade;
    const struct node *root;
    const char *body;
    bool moments, slides;
};

static const struct node *with_text(struct arena *arena, const struct node *map, const char *key,
                                    const char *text)
{
    const struct node *made = map ? node_text(arena, text, map->at) : NULL;
    return made ? node_with(arena, map, key, made) : NULL;
}

/* Components with one or both unknown: 1 N for an unknown one. */
static const struct node *take_components(const struct draft_place *place, const struct node *keys,
                                          struct drawn *drawn)
{
    static const char *const names[] = {"fx", "fy"};
    struct arena *arena = &place->grade->arena;
    size_t unknowns = 0;
    for (size_t i = 0; keys && i < 2; i++) {
        const struct pair *pair = node_find(keys, names[i]);
        const char *symbol;
        bool minus;
        if (!pair || !is_unknown(place->grade, place->root, pair->value, &symbol, &minus)) continue;
        drawn->symbol = symbol;
        unknowns++;
        keys = with_text(arena, keys, names[i], minus ? "-1 N" : "1 N");
    }
    drawn->unknown = unknowns > 0;
    drawn->free = unknowns == 2;
    return keys;
}

static const struct node *take_value(const struct draft_place *place, const struct node *keys,
                                     struct drawn *drawn)
{
    struct arena *arena = &place->grade->arena;
    const struct node *value = lines_value(keys, "value"), *angle = lines_value(keys, "angle");
    bool minus = false, toward = node_find(keys, "toward") != NULL;
    if (value && !is_unknown(place->grade, place->root, value, &drawn->symbol, &minus)) {
        drawn->value = as_expression(arena, value);
        return keys;
    }
    drawn->unknown = true;
    drawn->minus = minus;
    bool wanted = angle && angle->kind == node_scalar &&
                  (strcmp(angle->text, "unknown") == 0 || strcmp(angle->text, "?") == 0);
    drawn->free = !place->moments && !toward && (angle ? wanted : !place->slides);
    if (drawn->free) keys = with_text(arena, keys, "angle", "0 deg");
    const char *one = place->moments ? "1 N*m" : "1 N", *back = place->moments ? "-1 N*m" : "-1 N";
    return with_text(arena, keys, "value", minus ? back : one);
}

/* True if a body moves as prescribed, by a force called `drive`. */
static bool is_driven(const struct draft_place *place)
{
    static const char *const coordinates[] = {"x", "s", "theta"};
    const struct node *body = lines_value(lines_value(place->root, "bodies"), place->body),
                      *motion = lines_value(body, "motion");
    bool driven = false;
    for (size_t i = 0; motion && motion->kind == node_map && i < motion->count; i++)
        for (size_t k = 0; k < 3; k++) driven = driven || lines_value(motion->pairs[i].value, coordinates[k]);
    return driven;
}

/* True for the name of a coupling or contact of the file, or of the force of a joint. */
static bool is_of_model(const struct node *root, const char *name)
{
    static const char *const lists[] = {"couplings", "contacts"}, *joints[] = {"pin", "guide", "weld"};
    for (size_t k = 0; k < sizeof joints / sizeof *joints; k++)
        if (strcmp(name, joints[k]) == 0) return true;
    for (size_t k = 0; k < 2; k++) {
        const struct node *list = lines_value(root, lists[k]);
        for (size_t i = 0; list && list->kind == node_list && i < list->count; i++) {
            const struct node *keys = list->items[i];
            if (k == 0 && keys->kind == node_map && keys->count == 1) {
                if (strcmp(keys->pairs[0].key, name) == 0) return true;
                keys = keys->pairs[0].value;
            }
            const struct node *own = lines_value(keys, "name");
            if (own && own->kind == node_scalar && strcmp(own->text, name) == 0) return true;
        }
    }
    return false;
}

/* The tension of a rope may be called as the rope, and a reaction as the joint: rename them in the model,
 * where these have their own forces. */
static const struct node *with_own_name(const struct draft_place *place, const struct node *keys,
                                        const struct drawn *drawn)
{
    struct arena *arena = &place->grade->arena;
    if (!keys || !drawn->name) return keys;
    const bool drive = strcmp(drawn->name, "drive") == 0 && is_driven(place);
    if (!drive && !is_of_model(place->root, drawn->name)) return keys;
    const char *name = arena_printf(arena, "%s_drawn", drawn->name);
    return name ? with_text(arena, keys, "name", name) : NULL;
}

/* An entry `applied: {...}` as it is compiled. */
static const struct node *take_entry(const struct draft_place *place, const struct node *entry)
{
    struct arena *arena = &place->grade->arena;
    const struct pair *applied = entry->count == 1 ? node_find(entry, "applied") : NULL;
    if (!applied || applied->value->kind != node_map) return entry;
    const struct node *keys = applied->value, *name = lines_value(keys, "name");
    struct drawn *drawn = ARENA_NEW(arena, struct drawn);
    if (!drawn) return NULL;
    *drawn = (struct drawn){.at = applied->at, .body = place->body, .size = NAN, .next = place->grade->drawn};
    drawn->name = name && name->kind == node_scalar ? name->text : NULL;
    place->grade->drawn = drawn;
    bool components = node_find(keys, "fx") || node_find(keys, "fy");
    keys = components ? take_components(place, keys, drawn) : take_value(place, keys, drawn);
    keys = with_own_name(place, keys, drawn);
    return keys ? node_with(arena, entry, "applied", keys) : NULL;
}

static const struct node *take_list(const struct draft_place *place, const struct node *list)
{
    struct arena *arena = &place->grade->arena;
    const struct node *made = node_shortened(arena, list, 0);
    for (size_t i = 0; made && i < list->count; i++) {
        const struct node *entry = list->items[i];
        if (entry->kind == node_map) entry = take_entry(place, entry);
        made = entry ? node_appended(arena, made, entry) : NULL;
    }
    return made;
}

static bool slides(const struct node *body)
{
    const struct node *motion = lines_value(body, "motion");
    if (!motion) return false;
    return motion->kind == node_scalar ? strcmp(motion->text, "slide") == 0
                                       : node_find(motion, "slide") != NULL;
}

const struct node *answer_take_drawn(struct fbd_grade *grade, const struct node *root)
{
    static const char *const keys[] = {"forces", "moments"};
    const struct node *bodies = lines_value(root, "bodies"), *made = bodies;
    if (!bodies || bodies->kind != node_map) return root;
    for (size_t b = 0; made && b < bodies->count; b++)
        for (size_t k = 0; made && k < 2; k++) {
            const char *name = bodies->pairs[b].key;
            const struct node *body = lines_value(made, name), *list = lines_value(body, keys[k]);
            if (!list || list->kind != node_list) continue;
            struct draft_place place = {grade, root, name, k == 1, slides(body)};
            list = take_list(&place, list);
            body = list ? node_with(&grade->arena, body, keys[k], list) : NULL;
            made = body ? node_with(&grade->arena, made, name, body) : NULL;
        }
    return made ? node_with(&grade->arena, root, "bodies", made) : NULL;
}
