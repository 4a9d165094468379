/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Node edit: copies of the tree of a file with changes. The tree itself stays unchanged; the copy shares all
 * unchanged nodes. NULL when memory is out.
 */
#ifndef FBD_DOCUMENT_NODE_EDIT_H
#define FBD_DOCUMENT_NODE_EDIT_H

#include "document/node.h"

/* A mapping with `value` under `key`, which replaces the old value or is appended; NULL for `value` removes
 * the key. */
const struct node *node_with(struct arena *arena, const struct node *map, const char *key,
                             const struct node *value);

/* A list without the items for which `leave` returns true. */
const struct node *node_filtered(struct arena *arena, const struct node *list,
                                 bool leave(const struct node *item, const void *context),
                                 const void *context);

/* A list with `item` appended; `list` may be NULL. */
const struct node *node_appended(struct arena *arena, const struct node *list, const struct node *item);

/* The first `most` items of a list. */
const struct node *node_shortened(struct arena *arena, const struct node *list, size_t most);

/* A tree with the texts of its scalars replaced by those that `change` returns. NULL when memory is out. */
const struct node *node_rewritten(struct arena *arena, const struct node *node,
                                  const char *(*change)(struct arena *arena, const struct node *scalar,
                                                        const void *context),
                                  const void *context);

/* A scalar at this position. */
const struct node *node_text(struct arena *arena, const char *text, struct pos at);

/* An empty mapping. */
const struct node *node_empty_map(struct arena *arena);

#endif
