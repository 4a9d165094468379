/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls of the public interface that cannot be meant: an object that is missing, or of another model. They
 * are answered with the function's error value, and a note where there is a list of errors.
 */
#ifndef FBD_BASE_CALL_H
#define FBD_BASE_CALL_H

#include "base/diag.h"

/* Note a `bad-call`: "there is no model". Returns NULL, which is what most functions answer. */
void *call_refuse(fbd_errors *errors, const char *what);

/* Take the options of a caller who may know an earlier or a later form of them: their first member is the size that
 * they have there, 0 standing for `room`, that of version 0.1. `whole` holds the defaults, of `room` bytes, and gets
 * the members that both know; `given` may be NULL. False with a note when the caller sets a member that is not known
 * here, or the size is none. */
bool call_options(void *whole, size_t room, const void *given, fbd_errors *errors);

/* Fill the `size` bytes of a caller's options with defaults; what is not known here gets zeros. */
void call_fill(void *options, size_t size, const void *defaults, size_t room);

/* Is each of `count` texts there, and name and value of each setting? */
bool call_has_texts(const char *const *texts, size_t count);
bool call_has_settings(const fbd_setting *settings, size_t count);

#endif
