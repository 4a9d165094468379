/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields: read one mapping of the file into one structure by the tables of language.h.
 */
#ifndef FBD_SCENE_FIELDS_H
#define FBD_SCENE_FIELDS_H

#include "scene/language.h"
#include "scene/reader.h"

/* Read `node` into `*keys`, the structure of `group`, which contains the defaults. `node` may be NULL or
 * empty for a mapping without keys, or, when the group has a `brief` key, a single value of that key (also a
 * list, if the key takes any node). `owner` is where missing keys are reported: the key whose value the
 * mapping is. `scope` holds the names that a field_value may use. False on any error: `unknown-key`,
 * `missing-key`, `not-supported`, and the ids of values.h. */
bool fields_read(struct reader *reader, const struct group *group, const struct node *node, struct pos owner,
                 const struct scope *scope, void *keys);

/* One of several kinds, written as a word or as a mapping with one key. */
struct chosen {
    const struct kind *kind;
    const struct node *node; /* the value behind the key; NULL if empty */
    struct pos at;           /* of the word or key */
};

/* Find the kind of `node` among `kinds`. Ids: `unknown-kind`, `conflicting-keys`, `unknown-key`. */
bool kind_read(struct reader *reader, const struct kinds *kinds, const struct node *node, const char *what,
               struct chosen *chosen);

/* True if a group or its base has this key. */
bool fields_has(const struct group *group, const char *key);

/* Note `conflicting-keys` and return false when `map` has both keys. */
bool fields_exclude(struct reader *reader, const struct node *map, const char *key, const char *other,
                    const char *hint);

#endif
