/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a plain scalar means: the core schema of YAML 1.2, and the traps that other readers set.
 *
 * `no`, `on`, `y` are words, not booleans; `010`, `0x10`, `1:30`, `1_000` are no numbers of ours, although
 * YAML 1.1 reads each of them as one (and not always as the one that was meant).
 */
#ifndef FBD_SCENE_SCALAR_H
#define FBD_SCENE_SCALAR_H

#include "base/diag.h"

/* Nothing, `~`, `null`, `Null`, `NULL`. */
bool scalar_is_null(const char *text);

/* `true`, `True`, `TRUE` and the same for false. */
bool scalar_boolean(const char *text, bool *value);

/* The truth value that YAML 1.1 gives to `yes`, `no`, `on`, `off`, `y`, `n`: "true" or "false"; else NULL. */
const char *scalar_boolean_word(const char *text);

/* False with a note when `text`, which should be a number, a quantity or an expression, starts as a number of
 * YAML 1.1 or of another language (`number-format`) or is no finite number (`not-finite`). `what` names the
 * value in the message. */
bool scalar_check_number(const char *text, struct pos at, const char *what, fbd_errors *errors);

/* [A-Za-z0-9_], whatever the locale takes for a letter. */
bool scalar_is_word(char c);

/* [A-Za-z_][A-Za-z0-9_]* */
bool scalar_is_name(const char *text);

#endif
