/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the schema knows of more than one key at a time: of which keys a mapping needs one, which exclude each other,
 * and which dimensions a shape has.
 */
#ifndef FBD_SCENE_SCHEMA_RULES_H
#define FBD_SCENE_SCHEMA_RULES_H

#include "base/text.h"

/* The keys that a mapping of this name needs one of, or NULL. */
const char *schema_needs(const char *name);

/* `anyOf` of keys; several joined by `+` stand for all of them. */
void schema_add_needs(struct text *text, const char *keys);

/* A member `not`, if keys of the mapping of this name exclude each other, after a comma. */
void schema_add_exclusions(struct text *text, const char *name);

/* Members of `allOf` for the shapes. */
void schema_add_shapes(struct text *text);

#endif
