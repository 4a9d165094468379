/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields: one mapping of the file into one structure, as the tables of language.h say.
 */
#ifndef FBD_SCENE_FIELDS_H
#define FBD_SCENE_FIELDS_H

#include "scene/language.h"
#include "scene/reader.h"

/* Read `node` into `*keys`, the structure of `group`, which holds the defaults before. `node` may be NULL or
 * empty for a mapping without keys, or, when the group has a `brief` key, a single value for that (a list,
 * too, where the key takes any node). `owner` is where missing keys are reported: the key whose value the
 * mapping is. `scope` names what a field_value may use. False when anything was wrong: `unknown-key`,
 * `missing-key`, `not-supported`, and the ids of values.h. */
bool fields_read(struct reader *reader, const struct group *group, const struct node *node, struct pos owner,
                 const struct scope *scope, void *keys);

/* One of several kinds, written as a word or as a mapping with one key. */
struct chosen {
    const struct kind *kind;
    const struct node *node; /* what stands behind the key; NULL when nothing does */
    struct pos at;           /* of the word or key */
};

/* Read which of `kinds` `node` is. Ids: `unknown-kind`, `conflicting-keys`, `unknown-key`. */
bool kind_read(struct reader *reader, const struct kinds *kinds, const struct node *node, const char *what,
               struct chosen *chosen);

/* Has a group, or what it is based on, this key? */
bool fields_has(const struct group *group, const char *key);

/* Note `conflicting-keys` when `map` has both keys; true when it has not. */
bool fields_exclude(struct reader *reader, const struct node *map, const char *key, const char *other,
                    const char *hint);

#endif
