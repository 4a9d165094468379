/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Node: a model file as a tree, with the place of every value and every key.
 *
 * The tree is built from libyaml's events, so that depth, size and aliases are bounded while reading. A value
 * that is used by several aliases is one node; `size` counts what a walk through all of them would meet, and
 * the budget on it makes every walk short.
 */
#ifndef FBD_SCENE_NODE_H
#define FBD_SCENE_NODE_H

#include "base/arena.h"
#include "base/diag.h"
#include "scene/source.h"

enum {
    node_most_depth = 64,
    node_most_nodes = 5000000,  /* written in the file */
    node_most_aliased = 100000, /* added by aliases */
    node_most_anchors = 1000,
    node_longest_key = 128, /* bytes */
};

struct node {
    enum node_kind {
        node_null, /* nothing after the colon, `~` or `null` */
        node_scalar,
        node_list,
        node_map,
    } kind;
    int height; /* levels in it: 1 for a scalar */
    struct pos at;
    size_t size;  /* nodes in it, itself included, aliases expanded */
    size_t count; /* of items or pairs; 0 for a scalar */

    /* scalar; nothing for a collection */
    const char *text; /* terminated, holds no zero byte */
    size_t length;    /* bytes */
    bool quoted;      /* written in quotes or as a block: text, whatever it looks like */
    bool in_braces;   /* without quotes inside braces or brackets: it holds no bracket, brace or comma */
    bool many_lines;  /* `text` was put together from several lines */

    union { /* a large file has many nodes, and none needs both */
        struct {
            struct pos text_at; /* scalar: where text[0] stands: after the quote, or in the block */
            const char *origin; /* many_lines: text[0] in the file, which reaches to ... */
            const char *end;    /* ... here */
        };
        struct {
            const struct node *const *items; /* list */
            struct pair *pairs;              /* mapping: pairs in file order, and ... */
            struct pair **sorted;            /* ... the same sorted by key */
        };
    };
};

struct pair {
    const char *key;
    struct pos at;
    const struct node *value; /* never NULL */
};

/* Read a file. NULL with notes when it is no YAML or goes beyond a limit: `yaml-syntax`, `tab-indent`,
 * `empty-file`, `second-document`, `too-deep`, `too-many-nodes`, `alias-budget`, `alias-cycle`,
 * `unknown-anchor`. Slips that leave a tree are noted too, and the tree goes on without them:
 * `duplicate-key` (the first stays), `bad-key`, `merge-key`, `tag`. Memory comes from `arena`; the text of
 * the source must live as long as the tree. */
const struct node *node_read(struct arena *arena, const struct source *source, fbd_errors *errors);

/* The pair of a mapping with this key, or NULL; takes O(log count). `map` may be NULL or another kind. */
const struct pair *node_find(const struct node *map, const char *key);

/* Where character `offset` of the text of a scalar stands in the file, also when the text was folded from
 * several lines. (Escapes in double quotes are not undone: columns behind one are approximate.) */
struct pos node_place(const struct node *scalar, size_t offset);

#endif
