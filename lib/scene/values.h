/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Values: one scalar or pair of the tree as a number, a formula, text, a choice.
 *
 * `what` names the value in messages. All return false after noting what is wrong: `missing-value`,
 * `wrong-type`, `out-of-range`, `unknown-choice`, `bad-name`, the ids of scalar.h and those of expr.h.
 */
#ifndef FBD_SCENE_VALUES_H
#define FBD_SCENE_VALUES_H

#include "scene/language.h"
#include "scene/reader.h"

/* A constant; infinite for one that varies, where `flags`, of field_flag_bits, allow it. */
bool value_number(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                  unsigned flags, double *number);

/* What may vary with the names of `scope`; a constant when that is `reader->constants`. */
bool value_formula(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                   unsigned flags, const struct scope *scope, struct value *value);

/* Any expression, as it is; NULL after noting what is wrong. */
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

/* What `node` is, for messages: "a list", "`text`". */
const char *value_found(struct reader *reader, const struct node *node);

/* Note `missing-value` when `node` is empty and `wrong-type` otherwise: `what` must be `wanted`. Returns
 * false. */
bool value_refuse(struct reader *reader, const struct node *node, const char *what, const char *wanted,
                  const char *hint);

#endif
