/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plain scalars by the core schema of YAML 1.2, and numbers of YAML 1.1 that are refused.
 *
 * `no`, `on`, `y` are words, not booleans; `010`, `0x10`, `1:30`, `1_000` are refused as numbers, although
 * YAML 1.1 accepts each of them (and not always with the intended value).
 */
#ifndef FBD_DOCUMENT_SCALAR_H
#define FBD_DOCUMENT_SCALAR_H

#include "base/diag.h"

/* True for an empty text, `~`, `null`, `Null`, `NULL`. */
bool scalar_is_null(const char *text);

/* `true`, `True`, `TRUE` and the same for false. */
bool scalar_boolean(const char *text, bool *value);

/* The truth value that YAML 1.1 gives to `yes`, `no`, `on`, `off`, `y`, `n`: "true" or "false"; else NULL. */
const char *scalar_boolean_word(const char *text);

/* False with a note when `text`, a number, quantity or expression, starts with a number of YAML 1.1 or of
 * another language (`number-format`) or is not finite (`not-finite`). `what` names the value in the message.
 */
bool scalar_check_number(const char *text, struct pos at, const char *what, fbd_errors *errors);

/* [A-Za-z0-9_], independently of the locale. */
bool scalar_is_word(char c);

/* [A-Za-z_][A-Za-z0-9_]* */
bool scalar_is_name(const char *text);

#endif
