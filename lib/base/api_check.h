/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Checks of the arguments of public functions: a missing object, or one of another model. The function then
 * returns its error value, and adds a note to the caller's list of errors, if any.
 */
#ifndef FBD_BASE_API_CHECK_H
#define FBD_BASE_API_CHECK_H

#include "base/diag.h"

/* Note a `bad-call`, as "there is no model". Returns NULL, the error value of most functions. */
void *api_refuse(fbd_errors *errors, const char *what);

/* Read the options of a caller, which may be compiled with an earlier or a later version of them: their first
 * member is their size, 0 standing for `room`, that of version 0.1. `whole` holds the defaults, of `room`
 * bytes, and receives the members of both versions; `given` may be NULL. False with a note when the caller
 * sets a member that is unknown here, or the size is invalid. */
bool api_take_options(void *whole, size_t room, const void *given, fbd_errors *errors);

/* Fill the `size` bytes of a caller's options with defaults; members unknown here become zero. */
void api_fill_options(void *options, size_t size, const void *defaults, size_t room);

/* Are all `count` texts, or the name and value of each setting, not NULL? */
bool api_has_texts(const char *const *texts, size_t count);
bool api_has_settings(const fbd_setting *settings, size_t count);

#endif
