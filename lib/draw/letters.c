/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/letters.h"

#include <math.h>
#include <string.h>

#include "draw/panel.h"

bool letters_open(struct letters *letters, const fbd_model *model, struct arena *arena)
{
    size_t length = 0;
    const char *source = fbd_model_source(model, &length);
    fbd_errors *errors = fbd_errors_new();
    *letters = (struct letters){.arena = arena, .model = model};
    letters->units = ARENA_ARRAY(arena, fbd_model_parameter_count(model) + 1, const char *);
    if (errors && source) letters->root = node_open(arena, source, length, errors);
    const bool done = errors && letters->units;
    fbd_errors_free(errors);
    return done;
}

static const struct node *value_of(const struct node *map, const char *key)
{
    const struct pair *pair = node_find(map, key);
    return pair ? pair->value : NULL;
}

const struct node *letters_part(const struct letters *letters, const char *body, size_t part)
{
    const struct node *map = value_of(value_of(letters->root, "bodies"), body),
                      *parts = value_of(map, "parts");
    if (!parts) return map;
    return parts->kind == node_map && part < parts->count ? parts->pairs[part].value : NULL;
}

/* The value behind the key at a position of the file, or the item of a list there. */
static const struct node *node_at(const struct node *node, int line, int column)
{
    for (size_t i = 0; i < node->count; i++) {
        const struct pair *pair = node->kind == node_map ? &node->pairs[i] : NULL;
        if (pair && pair->at.line == line && pair->at.column == column) return pair->value;
        const struct node *inside = pair ? pair->value : node->items[i];
        const struct node *found = node_at(inside, line, column);
        if (found) return found;
        if (!pair && inside->at.line == line && inside->at.column == column) return inside;
    }
    return NULL;
}

const struct node *letters_entry(const struct letters *letters, const char *body, const char *name)
{
    const size_t count = fbd_model_entries(letters->model, NULL, 0);
    fbd_entry *entries = ARENA_ARRAY(letters->arena, count + 1, fbd_entry);
    if (!entries || !letters->root) return NULL;
    fbd_model_entries(letters->model, entries, count);
    for (size_t i = 0; i < count; i++) {
        const bool owned = strcmp(entries[i].body, body) == 0 || entries[i].body[0] == '\0';
        if (owned && strcmp(entries[i].name, name) == 0)
            return node_at(letters->root, entries[i].line, entries[i].column);
    }
    return NULL;
}

/* The index of the parameter that is given by this name; the number of parameters for none. */
static size_t parameter_of(const struct letters *letters, const struct node *given)
{
    const size_t count = fbd_model_parameter_count(letters->model);
    if (!given || given->kind != node_scalar || given->quoted) return count;
    for (size_t i = 0; i < count; i++)
        if (strcmp(fbd_model_parameter(letters->model, i).name, given->text) == 0) return i;
    return count;
}

static const char *letter_of(const struct letters *letters, size_t parameter)
{
    return panel_indexed(letters->arena, fbd_model_parameter(letters->model, parameter).name);
}

const struct node *letters_motion(const struct letters *letters, const char *body)
{
    const struct node *motion = value_of(value_of(value_of(letters->root, "bodies"), body), "motion");
    return motion && motion->kind == node_map && motion->count > 0 ? motion->pairs[0].value : NULL;
}

const char *letters_slope(const struct letters *letters, const char *body)
{
    const size_t index = parameter_of(letters, value_of(letters_motion(letters, body), "along"));
    return index < fbd_model_parameter_count(letters->model) ? letter_of(letters, index) : NULL;
}

const char *letters_text(struct letters *letters, const struct node *map, const char *key, double value,
                         const char *unit)
{
    const struct node *given = value_of(map, key);
    const size_t index = parameter_of(letters, given);
    if (!given || given->kind != node_scalar || given->quoted) return NULL;
    if (index < fbd_model_parameter_count(letters->model)) {
        const fbd_parameter parameter = fbd_model_parameter(letters->model, index);
        letters->units[index] = unit[0] ? unit : parameter.unit;
        return letter_of(letters, index);
    }
    const bool known =
        !isnan(value) || fbd_model_quantity(letters->model, key, given->text, unit, &value, NULL);
    return known ? panel_text(letters->arena, value, unit) : NULL;
}

/* True if the text of a list or scalar has the name as a word. */
static bool names(const struct node *given, const char *name)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.";
    if (given->kind == node_list)
        for (size_t i = 0; i < given->count; i++)
            if (names(given->items[i], name)) return true;
    if (given->kind != node_scalar) return false;
    const size_t length = strlen(name);
    for (const char *at = strstr(given->text, name); at; at = strstr(at + 1, name)) {
        const bool begins = at == given->text || !strchr(letters, at[-1]),
                   ends = at[length] == '\0' || !strchr(letters, at[length]);
        if (begins && ends) return true;
    }
    return false;
}

const char *letters_same(struct letters *letters, const struct node *map, const char *const keys[2],
                         double value, const char *unit)
{
    const double rounding = 1e-12; /* of a few operations between the parameter and the value */
    for (size_t i = 0; i < fbd_model_parameter_count(letters->model); i++) {
        const fbd_parameter parameter = fbd_model_parameter(letters->model, i);
        const bool same =
            strcmp(parameter.unit, unit) == 0 && fabs(parameter.value - value) <= rounding * value;
        if (!same || (!names(value_of(map, keys[0]), parameter.name) &&
                      !names(value_of(map, keys[1]), parameter.name)))
            continue;
        letters->units[i] = unit;
        return letter_of(letters, i);
    }
    return panel_text(letters->arena, value, unit);
}

const char *letters_listed(struct letters *letters, size_t index)
{
    for (size_t i = 0; i < fbd_model_parameter_count(letters->model); i++) {
        if (!letters->units[i] || index-- > 0) continue;
        const fbd_parameter parameter = fbd_model_parameter(letters->model, i);
        return arena_printf(letters->arena, "%s = %s", letter_of(letters, i),
                            panel_text(letters->arena, parameter.value, letters->units[i]));
    }
    return NULL;
}
