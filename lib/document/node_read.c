/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document/node.h"

#include "base/utf8.h"
#include "document/scalar.h"
#include "document/syntax.h"

#include <stdlib.h>
#include <string.h>

struct anchor {
    const char *name;
    const struct node *node; /* NULL while the node is being read: an alias to it is circular */
};

struct builder {
    yaml_parser_t parser;
    const struct source *source;
    struct arena *arena;
    fbd_errors *errors;
    size_t nodes, aliased;
    int braces;         /* number of open braces and brackets */
    struct node *spare; /* node of the last key, whose memory is reused by the next node */

    /* Children of all open collections; each takes its own from the end when it closes. */
    struct pair *pending;
    size_t pending_count, pending_capacity;

    struct anchor *anchors;
    size_t anchor_count;

    /* The start of the current line of the source; line numbers are requested in ascending order. */
    const char *line_start;
    int line;
};

static bool next_event(struct builder *builder, yaml_event_t *event)
{
    if (yaml_parser_parse(&builder->parser, event)) return true;
    syntax_explain(&builder->parser, builder->source, builder->errors);
    return false;
}

static bool out_of_memory(struct builder *builder)
{
    diag_out_of_memory(builder->errors);
    return false;
}

static bool push(struct builder *builder, struct pair pair)
{
    if (builder->pending_count == builder->pending_capacity) {
        size_t capacity = builder->pending_capacity ? 2 * builder->pending_capacity : 256;
        struct pair *pending = realloc(builder->pending, capacity * sizeof *pending);
        if (!pending) return out_of_memory(builder);
        builder->pending = pending;
        builder->pending_capacity = capacity;
    }
    builder->pending[builder->pending_count++] = pair;
    return true;
}

static struct node *new_node(struct builder *builder, enum node_kind kind, struct pos at)
{
    if (++builder->nodes > node_most_nodes) {
        diag_add(builder->errors, FBD_ERROR, "too-many-nodes", at, NULL,
                 "the file has more than %d values: this is no model", node_most_nodes);
        return NULL;
    }
    struct node *node = builder->spare ? builder->spare : ARENA_NEW(builder->arena, struct node);
    builder->spare = NULL;
    if (!node) {
        out_of_memory(builder);
        return NULL;
    }
    *node = (struct node){.kind = kind, .at = at, .size = 1, .height = 1};
    return node;
}

/* ---- scalars */

/* The first byte of line `line`; lines must be requested in ascending order. */
static const char *line_at(struct builder *builder, int line)
{
    const char *end = builder->source->text + builder->source->length;
    while (builder->line < line && builder->line_start < end)
        if (source_line_ends(builder->line_start++, end)) builder->line++;
    return builder->line_start;
}

/* The content of a block scalar starts at the first character that is not blank below its `|` or `>`. */
static void find_block_text(struct builder *builder, struct node *node)
{
    const char *end = builder->source->text + builder->source->length;
    const char *start = line_at(builder, node->at.line + 1), *text = start;
    struct pos at = {node->at.line + 1, 1};
    while (text < end && strchr(" \r\n", *text)) {
        bool ends = source_line_ends(text++, end);
        at = ends ? (struct pos){at.line + 1, 1} : (struct pos){at.line, at.column + 1};
    }
    node->text_at = at;
    node->origin = text;
    node->end = end;
}

static void find_folded_text(struct builder *builder, struct node *node)
{
    const char *text = line_at(builder, node->text_at.line);
    const char *end = builder->source->text + builder->source->length;
    unsigned code;
    for (int column = 1; column < node->text_at.column && text < end; column++)
        text += utf8_decode(text, (size_t)(end - text), &code);
    node->origin = text;
    node->end = end;
}

static int characters(const char *text, size_t length)
{
    int count = 0;
    for (size_t i = 0; i < length; i++) count += ((unsigned char)text[i] & 0xC0) != 0x80;
    return count;
}

/* The position of a value behind an anchor: the event starts at the anchor, so count back from its end. */
static struct pos behind_anchor(const yaml_event_t *event, int length, bool quoted)
{
    struct pos end = syntax_place(event->end_mark);
    int start = end.column - length - (quoted ? 2 : 0);
    return (struct pos){end.line, start > 0 ? start : 1};
}

static struct node *read_scalar(struct builder *builder, const yaml_event_t *event)
{
    const char *value = (const char *)event->data.scalar.value;
    size_t length = event->data.scalar.length;
    yaml_scalar_style_t style = event->data.scalar.style;
    struct node *node = new_node(builder, node_scalar, syntax_place(event->start_mark));
    if (!node) return NULL;
    bool block = style == YAML_LITERAL_SCALAR_STYLE || style == YAML_FOLDED_SCALAR_STYLE;
    node->quoted = style != YAML_PLAIN_SCALAR_STYLE;
    node->in_braces = !node->quoted && builder->braces > 0;
    node->many_lines = block || event->end_mark.line != event->start_mark.line;
    if (event->data.scalar.anchor && !node->many_lines)
        node->at = behind_anchor(event, characters(value, length), node->quoted);
    node->text_at = node->at;
    if (node->quoted) node->text_at.column++;
    if (block)
        find_block_text(builder, node);
    else if (node->many_lines)
        find_folded_text(builder, node);
    if (memchr(value, '\0', length)) {
        diag_add(builder->errors, FBD_ERROR, "control-character", node->at, "delete the escape `\\0`",
                 "a zero byte in the text");
        length = strlen(value);
    }
    if (!node->quoted && scalar_is_null(value)) node->kind = node_null;
    node->text = arena_text(builder->arena, value, length);
    node->length = length;
    if (!node->text) out_of_memory(builder);
    return node->text ? node : NULL;
}

/* ---- anchors and aliases */

static struct anchor *find_anchor(struct builder *builder, const char *name)
{
    for (size_t i = builder->anchor_count; i > 0; i--)
        if (strcmp(builder->anchors[i - 1].name, name) == 0) return &builder->anchors[i - 1];
    return NULL;
}

/* Open an anchor; `*index` is its number, for closing it. A later anchor of the same name hides this one. */
static bool open_anchor(struct builder *builder, const char *name, struct pos at, size_t *index)
{
    if (builder->anchor_count == node_most_anchors) {
        diag_add(builder->errors, FBD_ERROR, "alias-budget", at, NULL, "more than %d anchors",
                 node_most_anchors);
        return false;
    }
    if (!builder->anchors) builder->anchors = ARENA_ARRAY(builder->arena, node_most_anchors, struct anchor);
    const char *copy = arena_text(builder->arena, name, strlen(name));
    if (!builder->anchors || !copy) return out_of_memory(builder);
    *index = builder->anchor_count++;
    builder->anchors[*index] = (struct anchor){copy, NULL};
    return true;
}

static const struct node *read_alias(struct builder *builder, const yaml_event_t *event, int depth)
{
    const char *name = (const char *)event->data.alias.anchor;
    struct pos at = syntax_place(event->start_mark);
    const struct anchor *anchor = find_anchor(builder, name);
    if (!anchor) {
        const char *hint =
            diag_hint(builder->errors, "define it before: `&%.40s value`; a product needs a left side", name);
        diag_add(builder->errors, FBD_ERROR, "unknown-anchor", at, hint, "there is no anchor `&%.40s` above",
                 name);
        return NULL;
    }
    if (!anchor->node) {
        diag_add(builder->errors, FBD_ERROR, "alias-cycle", at, "write the value out",
                 "`*%.40s` is inside the value to which it refers", name);
        return NULL;
    }
    builder->aliased += anchor->node->size;
    if (builder->aliased > node_most_aliased) {
        diag_add(builder->errors, FBD_ERROR, "alias-budget", at, "write the values out",
                 "aliases multiply the file to more than %d values", node_most_aliased);
        return NULL;
    }
    const int scalar_depth = node_most_depth + 1; /* depth of the entries of the innermost collection */
    if (depth + anchor->node->height - 1 > scalar_depth) {
        diag_add(builder->errors, FBD_ERROR, "too-deep", at, NULL,
                 "with this alias the file is nested more than %d deep", node_most_depth);
        return NULL;
    }
    return anchor->node;
}

/* ---- collections */

static const struct node *read_node(struct builder *builder, const yaml_event_t *event, int depth);

static void count_child(struct node *node, const struct node *child)
{
    node->size += child->size;
    if (child->height >= node->height) node->height = child->height + 1;
}

static bool read_items(struct builder *builder, struct node *list, int depth)
{
    size_t first = builder->pending_count;
    for (;;) {
        yaml_event_t event;
        if (!next_event(builder, &event)) return false;
        bool end = event.type == YAML_SEQUENCE_END_EVENT;
        const struct node *item = end ? NULL : read_node(builder, &event, depth + 1);
        yaml_event_delete(&event);
        if (end) break;
        if (!item || !push(builder, (struct pair){NULL, item->at, item})) return false;
        count_child(list, item);
    }
    list->count = builder->pending_count - first;
    const struct node **items = ARENA_ARRAY(builder->arena, list->count, const struct node *);
    if (!items) return out_of_memory(builder);
    for (size_t i = 0; i < list->count; i++) items[i] = builder->pending[first + i].value;
    list->items = items;
    builder->pending_count = first;
    return true;
}

static int compare_pairs(const void *a, const void *b)
{
    const struct pair *p = *(struct pair *const *)a, *q = *(struct pair *const *)b;
    int order = strcmp(p->key, q->key);
    return order != 0 ? order : (p > q) - (p < q);
}

/* Sort by key and remove pairs that repeat an earlier key. */
static bool sort_pairs(struct builder *builder, struct node *map)
{
    map->sorted = ARENA_ARRAY(builder->arena, map->count, struct pair *);
    if (!map->sorted) return out_of_memory(builder);
    for (size_t i = 0; i < map->count; i++) map->sorted[i] = &map->pairs[i];
    if (map->count > 1) qsort(map->sorted, map->count, sizeof *map->sorted, compare_pairs);
    const struct pair *first = NULL;
    size_t repeated = 0;
    for (size_t i = 0; i < map->count; i++) {
        struct pair *pair = map->sorted[i];
        if (!first || strcmp(first->key, pair->key) != 0) {
            first = pair;
            continue;
        }
        diag_add(builder->errors, FBD_ERROR, "duplicate-key", pair->at,
                 "delete one of them, or give it another name", "`%s` is here already, in line %d", pair->key,
                 first->at.line);
        pair->value = NULL;
        repeated++;
    }
    if (repeated == 0) return true;
    size_t kept = 0;
    for (size_t i = 0; i < map->count; i++)
        if (map->pairs[i].value) map->pairs[kept++] = map->pairs[i];
    map->count = kept;
    for (size_t i = 0; i < kept; i++) map->sorted[i] = &map->pairs[i];
    qsort(map->sorted, kept, sizeof *map->sorted, compare_pairs);
    return true;
}

/* True if `key` is a valid key; else a note is added. */
static bool check_key(struct builder *builder, const struct node *key)
{
    if (key->kind != node_scalar) {
        diag_add(builder->errors, FBD_ERROR, "bad-key", key->at, "quote an expression with brackets",
                 "a key must be a word, not %s",
                 key->kind == node_null   ? "nothing"
                 : key->kind == node_list ? "a list"
                                          : "a mapping");
        return false;
    }
    if (key->length > node_longest_key) {
        diag_add(builder->errors, FBD_ERROR, "bad-key", key->at, "is a quote or a line end missing?",
                 "a key of %zu bytes: the limit is %d", key->length, node_longest_key);
        return false;
    }
    if (!key->quoted && strcmp(key->text, "<<") == 0) {
        diag_add(builder->errors, FBD_ERROR, "merge-key", key->at,
                 "write the keys out, or share a whole value: `gravity: *alias`",
                 "`<<` does not merge mappings: YAML 1.2 has no merge key");
        return false;
    }
    return true;
}

/* Read a key. Only its text and position are kept. */
static bool read_key(struct builder *builder, const yaml_event_t *event, int depth, struct node *key)
{
    if (event->type != YAML_SCALAR_EVENT || event->data.scalar.anchor || event->data.scalar.tag) {
        const struct node *node = read_node(builder, event, depth + 1);
        if (node) *key = *node;
        return node != NULL;
    }
    struct node *node = read_scalar(builder, event);
    if (!node) return false;
    *key = *node;
    builder->spare = node;
    return true;
}

static bool read_pair(struct builder *builder, struct node *map, const yaml_event_t *event, int depth)
{
    struct node key;
    yaml_event_t next;
    if (!read_key(builder, event, depth, &key) || !next_event(builder, &next)) return false;
    const struct node *value = read_node(builder, &next, depth + 1);
    yaml_event_delete(&next);
    if (!value) return false;
    count_child(map, value);
    return !check_key(builder, &key) || push(builder, (struct pair){key.text, key.at, value});
}

static bool read_pairs(struct builder *builder, struct node *map, int depth)
{
    size_t first = builder->pending_count;
    for (;;) {
        yaml_event_t event;
        if (!next_event(builder, &event)) return false;
        bool end = event.type == YAML_MAPPING_END_EVENT;
        bool fine = end || read_pair(builder, map, &event, depth);
        yaml_event_delete(&event);
        if (!fine) return false;
        if (end) break;
    }
    map->count = builder->pending_count - first;
    map->pairs = ARENA_ARRAY(builder->arena, map->count, struct pair);
    if (!map->pairs) return out_of_memory(builder);
    if (map->count) memcpy(map->pairs, builder->pending + first, map->count * sizeof *map->pairs);
    builder->pending_count = first;
    return sort_pairs(builder, map);
}

static const struct node *read_collection(struct builder *builder, const yaml_event_t *event, int depth)
{
    struct pos at = syntax_place(event->start_mark);
    bool map = event->type == YAML_MAPPING_START_EVENT;
    if (depth > node_most_depth) {
        diag_add(builder->errors, FBD_ERROR, "too-deep", at, "is a bracket left open somewhere above?",
                 "the file is nested more than %d deep", node_most_depth);
        return NULL;
    }
    struct node *node = new_node(builder, map ? node_map : node_list, at);
    if (!node) return NULL;
    bool braces = map ? event->data.mapping_start.style == YAML_FLOW_MAPPING_STYLE
                      : event->data.sequence_start.style == YAML_FLOW_SEQUENCE_STYLE;
    builder->braces += braces;
    bool fine = (map ? read_pairs : read_items)(builder, node, depth);
    builder->braces -= braces;
    return fine ? node : NULL;
}

/* ---- nodes */

static const char *tag_of(const yaml_event_t *event)
{
    const yaml_char_t *tag = NULL;
    if (event->type == YAML_SCALAR_EVENT) tag = event->data.scalar.tag;
    if (event->type == YAML_SEQUENCE_START_EVENT) tag = event->data.sequence_start.tag;
    if (event->type == YAML_MAPPING_START_EVENT) tag = event->data.mapping_start.tag;
    return (const char *)tag;
}

static const char *anchor_of(const yaml_event_t *event)
{
    const yaml_char_t *anchor = NULL;
    if (event->type == YAML_SCALAR_EVENT) anchor = event->data.scalar.anchor;
    if (event->type == YAML_SEQUENCE_START_EVENT) anchor = event->data.sequence_start.anchor;
    if (event->type == YAML_MAPPING_START_EVENT) anchor = event->data.mapping_start.anchor;
    return (const char *)anchor;
}

/* The node that starts with `event`, which the caller deletes. NULL when reading cannot continue. */
static const struct node *read_node(struct builder *builder, const yaml_event_t *event, int depth)
{
    struct pos at = syntax_place(event->start_mark);
    if (event->type == YAML_ALIAS_EVENT) return read_alias(builder, event, depth);
    if (tag_of(event))
        diag_add(builder->errors, FBD_ERROR, "tag", at,
                 "delete it; text that looks like a number goes into quotes",
                 "a tag (`!...`) has no meaning in a model file");
    const char *anchor = anchor_of(event);
    size_t index = 0;
    if (anchor && !open_anchor(builder, anchor, at, &index)) return NULL;
    const struct node *node = event->type == YAML_SCALAR_EVENT ? read_scalar(builder, event)
                                                               : read_collection(builder, event, depth);
    if (anchor) builder->anchors[index].node = node;
    return node;
}

/* ---- the file */

/* Skip the events before the root; false when there is none. */
static bool read_start(struct builder *builder, yaml_event_t *event)
{
    for (;;) {
        if (!next_event(builder, event)) return false;
        bool empty = event->type == YAML_STREAM_END_EVENT;
        bool before = event->type == YAML_STREAM_START_EVENT || event->type == YAML_DOCUMENT_START_EVENT;
        if (!before && !empty) return true;
        yaml_event_delete(event);
        if (!empty) continue;
        diag_add(builder->errors, FBD_ERROR, "empty-file", (struct pos){1, 1},
                 "a model starts with `fbd: 1` and has `bodies:`", "the file holds no model");
        return false;
    }
}

/* Skip the events after the root, which must end the file. */
static bool read_end(struct builder *builder)
{
    for (;;) {
        yaml_event_t event;
        if (!next_event(builder, &event)) return false;
        yaml_event_type_t type = event.type;
        struct pos at = syntax_place(event.start_mark);
        yaml_event_delete(&event);
        if (type == YAML_STREAM_END_EVENT) return true;
        if (type != YAML_DOCUMENT_START_EVENT) continue;
        diag_add(builder->errors, FBD_ERROR, "second-document", at, "delete `---`, or split the file",
                 "a second model starts here: a file has one");
        return false;
    }
}

static const struct node *read_file(struct builder *builder)
{
    yaml_event_t event;
    if (!read_start(builder, &event)) return NULL;
    const struct node *root = read_node(builder, &event, 1);
    yaml_event_delete(&event);
    return root && read_end(builder) ? root : NULL;
}

const struct node *node_read(struct arena *arena, const struct source *source, fbd_errors *errors)
{
    struct builder builder = {
        .source = source, .arena = arena, .errors = errors, .line_start = source->text, .line = 1};
    if (!yaml_parser_initialize(&builder.parser)) {
        diag_out_of_memory(errors);
        return NULL;
    }
    yaml_parser_set_encoding(&builder.parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&builder.parser, (const unsigned char *)source->text, source->length);
    const struct node *root = read_file(&builder);
    yaml_parser_delete(&builder.parser);
    free(builder.pending);
    return root;
}

const struct node *node_open(struct arena *arena, const char *text, size_t length, fbd_errors *errors)
{
    struct source source;
    if (!source_open(text, length, errors, &source)) return NULL;
    const struct node *root = node_read(arena, &source, errors);
    if (arena->failed || errors->arena.failed) diag_out_of_memory(errors);
    return root;
}
