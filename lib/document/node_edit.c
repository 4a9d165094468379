/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document/node_edit.h"

#include <stdlib.h>
#include <string.h>

static int compare_pairs(const void *a, const void *b)
{
    return strcmp((*(struct pair *const *)a)->key, (*(struct pair *const *)b)->key);
}

static struct node *copy_of(struct arena *arena, const struct node *node)
{
    struct node *copy = ARENA_NEW(arena, struct node);
    if (copy) *copy = *node;
    return copy;
}

/* Sizes and heights bound walks. Inserted nodes come from bounded trees. */
static void measure(struct node *node)
{
    node->size = 1;
    node->height = 1;
    for (size_t i = 0; i < node->count; i++) {
        const struct node *child = node->kind == node_map ? node->pairs[i].value : node->items[i];
        node->size += child->size;
        if (child->height >= node->height) node->height = child->height + 1;
    }
}

const struct node *node_with(struct arena *arena, const struct node *map, const char *key,
                             const struct node *value)
{
    struct node *made = copy_of(arena, map);
    struct pair *pairs = ARENA_ARRAY(arena, map->count + 1, struct pair);
    struct pair **sorted = ARENA_ARRAY(arena, map->count + 1, struct pair *);
    bool put = value == NULL;
    if (!made || !pairs || !sorted) return NULL;
    made->count = 0;
    for (size_t i = 0; i < map->count; i++) {
        bool here = strcmp(map->pairs[i].key, key) == 0;
        if (here && !value) continue;
        pairs[made->count] = map->pairs[i];
        if (here) pairs[made->count].value = value;
        put = put || here;
        made->count++;
    }
    if (!put) pairs[made->count++] = (struct pair){.key = key, .at = value->at, .value = value};
    for (size_t i = 0; i < made->count; i++) sorted[i] = &pairs[i];
    if (made->count > 1) qsort(sorted, made->count, sizeof *sorted, compare_pairs);
    made->pairs = pairs;
    made->sorted = sorted;
    measure(made);
    return made;
}

const struct node *node_filtered(struct arena *arena, const struct node *list,
                                 bool leave(const struct node *item, const void *context),
                                 const void *context)
{
    struct node *made = copy_of(arena, list);
    const struct node **items = ARENA_ARRAY(arena, list->count + 1, const struct node *);
    if (!made || !items) return NULL;
    made->count = 0;
    for (size_t i = 0; i < list->count; i++)
        if (!leave(list->items[i], context)) items[made->count++] = list->items[i];
    made->items = items;
    measure(made);
    return made;
}

const struct node *node_appended(struct arena *arena, const struct node *list, const struct node *item)
{
    size_t count = list ? list->count : 0;
    struct node *made = copy_of(arena, list ? list : item);
    const struct node **items = ARENA_ARRAY(arena, count + 1, const struct node *);
    if (!made || !items) return NULL;
    made->kind = node_list;
    made->count = count + 1;
    for (size_t i = 0; i < count; i++) items[i] = list->items[i];
    items[count] = item;
    made->items = items;
    measure(made);
    return made;
}

const struct node *node_shortened(struct arena *arena, const struct node *list, size_t most)
{
    struct node *made = copy_of(arena, list);
    if (!made) return NULL;
    if (made->count > most) made->count = most;
    measure(made);
    return made;
}

const struct node *node_text(struct arena *arena, const char *text, struct pos at)
{
    struct node *made = ARENA_NEW(arena, struct node);
    if (!made) return NULL;
    *made = (struct node){.kind = node_scalar, .height = 1, .at = at, .size = 1, .text = text};
    made->length = strlen(text);
    made->text_at = at;
    return made;
}

const struct node *node_empty_map(struct arena *arena)
{
    struct node *made = ARENA_NEW(arena, struct node);
    if (made) *made = (struct node){.kind = node_map, .height = 1, .size = 1};
    return made;
}

static const struct node *rewritten_scalar(struct arena *arena, const struct node *node, const char *text)
{
    struct node *made = text ? copy_of(arena, node) : NULL;
    if (!made) return NULL;
    made->text = text;
    made->length = strlen(text);
    made->many_lines = false;
    return made;
}

static bool rewrite_pairs(struct arena *arena, struct node *made, const struct node *node,
                          const char *(*change)(struct arena *arena, const struct node *scalar,
                                                const void *context),
                          const void *context)
{
    struct pair *pairs = ARENA_ARRAY(arena, node->count + 1, struct pair);
    struct pair **sorted = ARENA_ARRAY(arena, node->count + 1, struct pair *);
    if (!pairs || !sorted) return false;
    for (size_t i = 0; i < node->count; i++) {
        pairs[i] = node->pairs[i];
        pairs[i].value = node_rewritten(arena, node->pairs[i].value, change, context);
        if (!pairs[i].value) return false;
        sorted[i] = &pairs[i];
    }
    if (node->count > 1) qsort(sorted, node->count, sizeof *sorted, compare_pairs);
    made->pairs = pairs;
    made->sorted = sorted;
    return true;
}

static bool rewrite_items(struct arena *arena, struct node *made, const struct node *node,
                          const char *(*change)(struct arena *arena, const struct node *scalar,
                                                const void *context),
                          const void *context)
{
    const struct node **items = ARENA_ARRAY(arena, node->count + 1, const struct node *);
    if (!items) return false;
    for (size_t i = 0; i < node->count; i++) {
        items[i] = node_rewritten(arena, node->items[i], change, context);
        if (!items[i]) return false;
    }
    made->items = items;
    return true;
}

const struct node *node_rewritten(struct arena *arena, const struct node *node,
                                  const char *(*change)(struct arena *arena, const struct node *scalar,
                                                        const void *context),
                                  const void *context)
{
    if (node->kind == node_null) return node;
    if (node->kind == node_scalar) return rewritten_scalar(arena, node, change(arena, node, context));
    struct node *made = copy_of(arena, node);
    bool done = made && (node->kind == node_map ? rewrite_pairs(arena, made, node, change, context)
                                                : rewrite_items(arena, made, node, change, context));
    return done ? made : NULL;
}
