/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Values: read one scalar or pair of the tree as a number, formula, text or choice.
 *
 * All return false after noting an error: `missing-value`, `wrong-type`, `out-of-range`, `unknown-choice`,
 * `bad-name`, the ids of scalar.h and those of expr.h; `what` names the value in messages.
 */
#ifndef FBD_SCENE_VALUES_H
#define FBD_SCENE_VALUES_H

#include "scene/language.h"
#include "scene/reader.h"

/* A constant. If `flags` (field_flag_bits) contain may_vary, a varying value is read as infinity. */
bool value_number(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                  unsigned flags, double *number);

/* An expression of the names of `scope`; a constant if that is `reader->constants`. */
bool value_formula(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                   unsigned flags, const struct scope *scope, struct value *value);

/* Any expression; NULL after noting an error. */
const struct expr *value_compile(struct reader *reader, const struct node *node, const struct expr_want *want,
                                 const struct scope *scope);

/* An equation or comparison; see expr_compile_relation. */
bool value_relation(struct reader *reader, const struct node *node, const struct expr_want *want,
                    const struct scope *scope, const struct expr **left, char *relation,
                    const struct expr **right);

/* A pair [x, y] of constants. */
bool value_vector(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                  struct vec *vector);

bool value_text(struct reader *reader, const struct node *node, const char *what, const char **text);
bool value_name(struct reader *reader, const struct node *node, const char *what, const char **name);
bool value_flag(struct reader *reader, const struct node *node, const char *what, bool *flag);
bool value_choice(struct reader *reader, const struct node *node, const char *what,
                  const struct choice *choices, size_t count, int *choice);

/* The kind or text of `node`, for messages: "a list", "`text`". */
const char *value_found(struct reader *reader, const struct node *node);

/* Note `missing-value` when `node` is empty and `wrong-type` otherwise: the value must be `wanted`. Returns
 * false. */
bool value_refuse(struct reader *reader, const struct node *node, const char *what, const char *wanted,
                  const char *hint);

/* The same, where a list may be right but for the number of its entries. */
bool value_refuse_list(struct reader *reader, const struct node *node, const char *key, const char *wanted,
                       const char *hint);

#endif
