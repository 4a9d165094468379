/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document/node.h"

#include <string.h>

#include "base/utf8.h"

const struct pair *node_find(const struct node *map, const char *key)
{
    if (!map || map->kind != node_map) return NULL;
    size_t low = 0, high = map->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        int order = strcmp(key, map->sorted[middle]->key);
        if (order == 0) return map->sorted[middle];
        if (order < 0)
            high = middle;
        else
            low = middle + 1;
    }
    return NULL;
}

struct pos node_place(const struct node *scalar, size_t offset)
{
    struct pos at = scalar->text_at;
    if (!scalar->many_lines) {
        at.column += (int)offset;
        return at;
    }
    /* Advance in text and source together: a run of white space in one corresponds to a run in the other. */
    const char *text = scalar->text, *origin = scalar->origin;
    for (size_t i = 0; i < offset && *text && origin < scalar->end; i++) {
        unsigned code;
        bool blank = *text == ' ' || *text == '\n';
        size_t width = utf8_decode(text, strlen(text), &code);
        text += width;
        if (!blank) {
            origin += width;
            at.column++;
        } else if (*text != ' ' && *text != '\n') {
            for (; origin < scalar->end && strchr(" \t\r\n", *origin); origin++)
                at = source_line_ends(origin, scalar->end) ? (struct pos){at.line + 1, 1}
                                                           : (struct pos){at.line, at.column + 1};
        }
    }
    return at;
}
