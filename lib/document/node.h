/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Node: a model file as a tree, with the position of every value and every key.
 *
 * The tree is built from libyaml's events, so that depth, size and aliases are bounded while reading. A value
 * that is used by several aliases is one node; `size` counts the nodes of a walk through all uses, and its
 * limit bounds every walk.
 */
#ifndef FBD_DOCUMENT_NODE_H
#define FBD_DOCUMENT_NODE_H

#include "base/arena.h"
#include "base/diag.h"
#include "document/source.h"

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

    /* members of a scalar; zero for a collection */
    const char *text; /* terminated, holds no zero byte */
    size_t length;    /* in bytes */
    bool quoted;      /* in quotes or as a block: always text */
    bool in_braces;   /* without quotes inside braces or brackets: it holds no bracket, brace or comma */
    bool many_lines;  /* `text` was folded from several lines */

    union { /* in a union, to save memory in large files */
        struct {
            struct pos text_at; /* scalar: position of text[0], after the quote or in the block */
            const char *origin; /* many_lines: text[0] in the file, up to ... */
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

/* Read a file. NULL with notes if it is no YAML or exceeds a limit: `yaml-syntax`, `tab-indent`,
 * `empty-file`, `second-document`, `too-deep`, `too-many-nodes`, `alias-budget`, `alias-cycle`,
 * `unknown-anchor`. Errors that allow a tree are noted too, and their nodes left out: `duplicate-key` (the
 * first is kept), `bad-key`, `merge-key`, `tag`. Memory comes from `arena`; the text of the source must live
 * as long as the tree. */
const struct node *node_read(struct arena *arena, const struct source *source, fbd_errors *errors);

/* Check and read a text, as source_open and node_read do. */
const struct node *node_open(struct arena *arena, const char *text, size_t length, fbd_errors *errors);

/* The pair of a mapping with this key, or NULL; takes O(log count). `map` may be NULL or another kind. */
const struct pair *node_find(const struct node *map, const char *key);

/* The position in the file of character `offset` of the text of a scalar, also if the text was folded from
 * several lines. (Escapes in double quotes are not undone: columns behind one are approximate.) */
struct pos node_place(const struct node *scalar, size_t offset);

#endif
