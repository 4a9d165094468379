/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rules of the schema that involve several keys: alternatives of which a mapping needs one, exclusions, and
 * the dimensions of shapes.
 */
#ifndef FBD_SCENE_SCHEMA_RULES_H
#define FBD_SCENE_SCHEMA_RULES_H

#include "base/text.h"

/* The alternatives of which the mapping of this name needs one, or NULL. */
const char *schema_needs(const char *name);

/* Add `anyOf` of the alternatives; keys joined by `+` are required together. */
void schema_add_needs(struct text *text, const char *keys);

/* Add a comma and a member `not`, if keys of the mapping of this name exclude each other. */
void schema_add_exclusions(struct text *text, const char *name);

/* Add members of `allOf` for the shapes. */
void schema_add_shapes(struct text *text);

#endif
