/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pieces of JSON: each member is followed by a comma.
 */
#ifndef FBD_BASE_JSON_H
#define FBD_BASE_JSON_H

#include "base/text.h"
#include "base/vec.h"

void json_key(struct text *text, const char *name);
void json_number(struct text *text, double value); /* null when it is not finite */
void json_vector(struct text *text, struct vec v);
void json_text_member(struct text *text, const char *name, const char *value);
void json_number_member(struct text *text, const char *name, double value);
void json_vector_member(struct text *text, const char *name, struct vec v);

/* "name":[first, first + 1, ...], */
void json_columns_member(struct text *text, const char *name, int first, int count);

/* A comma before every entry of a list except the first. */
void json_comma(struct text *text, size_t index);

#endif
