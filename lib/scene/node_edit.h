/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Node edit: the tree of a file with something left out or put in. The tree itself stays as it is; what is made
 * shares all of it that did not change. NULL when memory is out.
 */
#ifndef FBD_SCENE_NODE_EDIT_H
#define FBD_SCENE_NODE_EDIT_H

#include "scene/node.h"

/* A mapping with `value` under `key`, in the place of what stands there or behind all others; NULL for `value`
 * leaves the key out. */
const struct node *node_with(struct arena *arena, const struct node *map, const char *key,
                             const struct node *value);

/* A list without those items that `leave` says true of. */
const struct node *node_filtered(struct arena *arena, const struct node *list,
                                 bool leave(const struct node *item, const void *context),
                                 const void *context);

/* A list with one item more; `list` may be NULL. */
const struct node *node_appended(struct arena *arena, const struct node *list, const struct node *item);

/* The first `most` items of a list. */
const struct node *node_shortened(struct arena *arena, const struct node *list, size_t most);

/* A tree with other texts in its scalars. NULL when memory is out. */
const struct node *node_rewritten(struct arena *arena, const struct node *node,
                                  const char *(*change)(struct arena *arena, const struct node *scalar,
                                                        const void *context),
                                  const void *context);

/* A scalar that stands at this place. */
const struct node *node_text(struct arena *arena, const char *text, struct pos at);

/* An empty mapping. */
const struct node *node_empty_map(struct arena *arena);

#endif
