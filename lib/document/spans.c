/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document/spans.h"

#include <stdlib.h>
#include <string.h>
#include <yaml.h>

struct spans {
    yaml_document_t document;
    const char *text;
    size_t length;
};

struct spans *spans_open(const char *text, size_t length)
{
    struct spans *spans = malloc(sizeof *spans);
    yaml_parser_t parser;
    if (!spans || !yaml_parser_initialize(&parser)) {
        free(spans);
        return NULL;
    }
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, length);
    bool done = yaml_parser_load(&parser, &spans->document) != 0;
    yaml_parser_delete(&parser);
    if (!done) {
        free(spans);
        return NULL;
    }
    spans->text = text;
    spans->length = length;
    return spans;
}

void spans_close(struct spans *spans)
{
    if (!spans) return;
    yaml_document_delete(&spans->document);
    free(spans);
}

static const yaml_node_t *node(const struct spans *spans, int value)
{
    const yaml_node_t *start = spans->document.nodes.start, *top = spans->document.nodes.top;
    return value > 0 && value <= top - start ? start + value - 1 : NULL;
}

static const yaml_node_t *node_of(const struct spans *spans, int value, yaml_node_type_t type)
{
    const yaml_node_t *found = node(spans, value);
    return found && found->type == type ? found : NULL;
}

int spans_root(const struct spans *spans)
{
    return node(spans, 1) ? 1 : 0;
}

bool spans_is_map(const struct spans *spans, int value)
{
    return node_of(spans, value, YAML_MAPPING_NODE) != NULL;
}

bool spans_is_list(const struct spans *spans, int value)
{
    return node_of(spans, value, YAML_SEQUENCE_NODE) != NULL;
}

bool spans_is_flow(const struct spans *spans, int value)
{
    const yaml_node_t *map = node_of(spans, value, YAML_MAPPING_NODE),
                      *list = node_of(spans, value, YAML_SEQUENCE_NODE);
    return (map && map->data.mapping.style == YAML_FLOW_MAPPING_STYLE) ||
           (list && list->data.sequence.style == YAML_FLOW_SEQUENCE_STYLE);
}

size_t spans_count(const struct spans *spans, int collection)
{
    const yaml_node_t *map = node_of(spans, collection, YAML_MAPPING_NODE),
                      *list = node_of(spans, collection, YAML_SEQUENCE_NODE);
    if (map) return (size_t)(map->data.mapping.pairs.top - map->data.mapping.pairs.start);
    return list ? (size_t)(list->data.sequence.items.top - list->data.sequence.items.start) : 0;
}

int spans_item(const struct spans *spans, int list, size_t index)
{
    const yaml_node_t *found = node_of(spans, list, YAML_SEQUENCE_NODE);
    return found && index < spans_count(spans, list) ? found->data.sequence.items.start[index] : 0;
}

static const yaml_node_pair_t *pair_at(const struct spans *spans, int map, size_t index)
{
    const yaml_node_t *found = node_of(spans, map, YAML_MAPPING_NODE);
    return found && index < spans_count(spans, map) ? found->data.mapping.pairs.start + index : NULL;
}

const char *spans_key_name(const struct spans *spans, int map, size_t index)
{
    const yaml_node_pair_t *pair = pair_at(spans, map, index);
    const yaml_node_t *key = pair ? node_of(spans, pair->key, YAML_SCALAR_NODE) : NULL;
    return key ? (const char *)key->data.scalar.value : NULL;
}

static const yaml_node_pair_t *pair_of(const struct spans *spans, int map, const char *key)
{
    for (size_t i = 0; i < spans_count(spans, map); i++) {
        const char *name = spans_key_name(spans, map, i);
        if (name && strcmp(name, key) == 0) return pair_at(spans, map, i);
    }
    return NULL;
}

int spans_find(const struct spans *spans, int map, const char *key)
{
    const yaml_node_pair_t *pair = pair_of(spans, map, key);
    return pair ? pair->value : 0;
}

/* The byte of a mark; libyaml counts characters. */
static size_t byte_of(const struct spans *spans, const yaml_mark_t *mark)
{
    size_t at = 0, characters = 0;
    while (at < spans->length && characters < mark->index) {
        at++;
        while (at < spans->length && ((unsigned char)spans->text[at] & 0xC0) == 0x80) at++;
        characters++;
    }
    return at;
}

struct span spans_key(const struct spans *spans, int map, const char *key)
{
    const yaml_node_pair_t *pair = pair_of(spans, map, key);
    const yaml_node_t *found = pair ? node(spans, pair->key) : NULL;
    if (!found) return (struct span){0, 0};
    return (struct span){byte_of(spans, &found->start_mark), byte_of(spans, &found->end_mark)};
}

/* The last node in a collection. A collection without brackets ends, for libyaml, at the next token, behind
 * empty lines and comments: the end of its last node is used instead. */
static const yaml_node_t *last_in(const struct spans *spans, int value)
{
    const yaml_node_t *found = node(spans, value);
    size_t count = spans_count(spans, value);
    while (found && count > 0 && !spans_is_flow(spans, value)) {
        value = spans_is_map(spans, value) ? pair_at(spans, value, count - 1)->value
                                           : spans_item(spans, value, count - 1);
        found = node(spans, value);
        count = spans_count(spans, value);
    }
    return found;
}

struct span spans_of(const struct spans *spans, int value)
{
    const yaml_node_t *found = node(spans, value), *last = last_in(spans, value);
    if (!found || !last) return (struct span){0, 0};
    struct span span = {byte_of(spans, &found->start_mark), byte_of(spans, &last->end_mark)};
    /* a block scalar includes its line break */
    while (span.to > span.from && strchr(" \r\n\t", spans->text[span.to - 1])) span.to--;
    return span;
}

struct span spans_inside(const struct spans *spans, int value)
{
    const yaml_node_t *found = node_of(spans, value, YAML_SCALAR_NODE);
    yaml_scalar_style_t style = found ? found->data.scalar.style : YAML_ANY_SCALAR_STYLE;
    struct span span = spans_of(spans, value);
    bool quoted = style == YAML_SINGLE_QUOTED_SCALAR_STYLE || style == YAML_DOUBLE_QUOTED_SCALAR_STYLE;
    if (quoted && span.to >= span.from + 2) span = (struct span){span.from + 1, span.to - 1};
    return span;
}

bool spans_is_plain(const struct spans *spans, int value)
{
    const yaml_node_t *found = node_of(spans, value, YAML_SCALAR_NODE);
    return found && found->data.scalar.style != YAML_LITERAL_SCALAR_STYLE &&
           found->data.scalar.style != YAML_FOLDED_SCALAR_STYLE &&
           found->start_mark.line == found->end_mark.line;
}

void spans_place(const struct spans *spans, int value, int *line, int *column)
{
    const yaml_node_t *found = node(spans, value);
    *line = found ? (int)found->start_mark.line + 1 : 0;
    *column = found ? (int)found->start_mark.column + 1 : 0;
}
