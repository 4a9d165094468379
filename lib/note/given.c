/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data of forces, moments, couplings and contacts in the letters and units of the file.
 */
#include <string.h>

#include "base/printed.h"
#include "draw/letters.h"
#include "note/given.h"

struct given {
    struct letters letters;
    fbd_entry *entries; /* those of bodies first */
    size_t count;
};

static bool is_named(const char *name, const char *const *names)
{
    for (; *names; names++)
        if (strcmp(name, *names) == 0) return true;
    return false;
}

static void write_scalar(struct text *text, const fbd_model *model, const char *scalar)
{
    bool parameter = false;
    for (size_t i = 0; i < fbd_model_parameter_count(model); i++)
        parameter |= strcmp(fbd_model_parameter(model, i).name, scalar) == 0;
    (parameter ? text_symbol : text_shown)(text, scalar);
}

/* Write a value as the file has it: "0.4", "[0.2 m, 0]", "{x: 1 m}"; a parameter by its symbol. */
static void write_value(struct text *text, const struct fbd_model *model, const struct node *value)
{
    if (value->kind == node_scalar) write_scalar(text, model, value->text);
    if (value->kind != node_list && value->kind != node_map) return;
    text_add(text, value->kind == node_list ? "[" : "{");
    for (size_t i = 0; i < value->count; i++) {
        if (i > 0) text_add(text, ", ");
        if (value->kind == node_map) {
            text_shown(text, value->pairs[i].key);
            text_add(text, ": ");
        }
        write_value(text, model, value->kind == node_list ? value->items[i] : value->pairs[i].value);
    }
    text_add(text, value->kind == node_list ? "]" : "}");
}

/* Write the keys of an entry with their values, but those of `left_out`, with commas behind a text. */
static void write_keys(const struct given *given, struct text *text, const struct node *entry,
                       const char *const *left_out)
{
    for (size_t i = 0; entry && entry->kind == node_map && i < entry->count; i++) {
        if (is_named(entry->pairs[i].key, left_out)) continue;
        if (text->length > 0) text_add(text, ", ");
        text_shown(text, entry->pairs[i].key);
        text_add(text, " ");
        write_value(text, given->letters.model, entry->pairs[i].value);
    }
}

const struct given *given_open(struct making *making)
{
    struct arena *arena = &making->document->arena;
    struct given *given = ARENA_NEW(arena, struct given);
    if (!given || !letters_open(&given->letters, making->model, arena)) return NULL;
    given->count = fbd_model_entries(making->model, NULL, 0);
    given->entries = ARENA_ARRAY(arena, given->count + 1, fbd_entry);
    if (!given->entries) return NULL;
    fbd_model_entries(making->model, given->entries, given->count);
    return given;
}

void given_connection(const struct given *given, const char *name, struct text *text)
{
    static const char *const left_out[] = {"name", "body", "on", NULL};
    write_keys(given, text, letters_entry(&given->letters, "", name), left_out);
}

void given_motion(const struct given *given, const char *body, struct text *text)
{
    static const char *const left_out[] = {"on", NULL};
    write_keys(given, text, letters_motion(&given->letters, body), left_out);
}

void given_forces(struct making *making, const struct given *given)
{
    static const char *const heads[] = {"Body", "Force or moment", "Given"}, *const left_out[] = {"name",
                                                                                                  NULL};
    struct block *table = NULL;
    for (size_t i = 0; i < given->count && given->entries[i].body[0]; i++) {
        const fbd_entry *entry = &given->entries[i];
        struct text *text = making_begin(making);
        write_keys(given, text, letters_entry(&given->letters, entry->body, entry->name), left_out);
        const char *keys = making_take(making);
        if (!keys || !keys[0]) continue;
        if (!table)
            table =
                document_table(making->document, "forces and moments, as the file gives them", "llw", heads);
        document_cell(making->document, table, entry->body);
        document_cell(making->document, table, entry->name);
        document_cell(making->document, table, keys);
    }
}
