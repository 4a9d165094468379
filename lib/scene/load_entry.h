/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One entry of `forces` or `moments` while it is read, shared by the files that read it.
 */
#ifndef FBD_SCENE_LOAD_ENTRY_H
#define FBD_SCENE_LOAD_ENTRY_H

#include "scene/fields.h"
#include "scene/reader.h"

#include <string.h>

struct entry {
    struct reader *reader;
    int body;
    const struct motion *motion; /* NULL when it is not known */
    struct chosen chosen;
    struct load_keys keys;
    const struct node *offset; /* of its point of application, along the axes of the world, or NULL */
    struct scope scope;
};

static inline void entry_note(const struct entry *entry, const char *id, struct pos at, const char *hint,
                              const char *message)
{
    diag_add(entry->reader->errors, FBD_ERROR, id, at, hint, "%s", message);
}

static inline bool entry_has(const struct entry *entry, const char *key)
{
    return node_find(entry->chosen.node, key) != NULL;
}

static inline bool entry_exclude(struct entry *entry, const char *key, const char *other, const char *hint)
{
    return fields_exclude(entry->reader, entry->chosen.node, key, other, hint);
}

/* True if the body moves along a line or curve, which gives forces their direction. */
static inline bool entry_is_slide(const struct entry *entry)
{
    return entry->motion && motion_joint(entry->motion)->path != path_none;
}

/* The point of application: `at`. */
bool entry_place_read(struct entry *entry);

/* Checks of laws beyond their keys: the column `finish` of their table (read_laws.c). */
bool link_finish(struct entry *entry);
bool normal_finish(struct entry *entry);
bool friction_finish(struct entry *entry);
bool potential_finish(struct entry *entry);
bool moment_spring_finish(struct entry *entry);

/* In read_applied.c. */
bool applied_finish(struct entry *entry);
bool drag_finish(struct entry *entry);

/* A distributed load as its resultant (read_distributed.c). */
bool distributed_finish(struct entry *entry);

/* The force of a mass flow (read_thrust.c). */
bool thrust_finish(struct entry *entry);

/* A pair of values, as [2 m/s, "sin(t)"]; `hint` shows the notation. */
bool entry_pair_read(struct entry *entry, const struct node *node, const char *what, enum quantity quantity,
                     const char *hint, struct value *x, struct value *y);

/* ---- expressions derived from the entry (derived.c), compiled from text over the names of the file
 *
 * False when memory is out or, with a note, when the expressions are too long together. */

/* The direction to `load.target` and `load.end`, and that of the reaction; also `value` if it names the
 * distance. */
bool derive_toward(struct entry *entry, bool distance_named);

/* The moment of a force with an offset about its point of the body. */
bool derive_couple(struct entry *entry, bool distance_named);

/* The size of a force, `size` times its factor. */
bool derive_scaled(struct entry *entry, double size);

/* The value of `key` followed by the text `behind`, such as "/v": a formula of the quantity `wanted`. */
bool derive_value(struct entry *entry, const char *key, const struct value *value, enum quantity quantity,
                  const char *behind, enum quantity wanted, struct value *result);

/* A length over the distance of the two points of an actuator, whose pole is where it has no direction; also `value` if
 * it names the distance. */
bool derive_zero_distance(struct entry *entry, bool distance_named);

/* Of a thrust: its size from the exhaust speed, or its force from the velocity of the mass in the world,
 * along the line of a slide or, where `velocity` is a pair, as components. */
bool derive_exhaust(struct entry *entry);
bool derive_entering(struct entry *entry, const struct value *along, const struct value *x,
                     const struct value *y);

/* The forces of drag in a wind. */
bool derive_wind(struct entry *entry);

#endif
