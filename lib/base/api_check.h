/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Checks of the arguments of public functions: a missing object, or one of another model. The function then returns
 * its error value, and adds a note where the caller passed a list of errors.
 */
#ifndef FBD_BASE_API_CHECK_H
#define FBD_BASE_API_CHECK_H

#include "base/diag.h"

/* Note a `bad-call`: "there is no model". Returns NULL, which is what most functions answer. */
void *api_refuse(fbd_errors *errors, const char *what);

/* Take the options of a caller who may know an earlier or a later form of them: their first member is the size that
 * they have there, 0 standing for `room`, that of version 0.1. `whole` holds the defaults, of `room` bytes, and gets
 * the members that both know; `given` may be NULL. False with a note when the caller sets a member that is not known
 * here, or the size is none. */
bool api_take_options(void *whole, size_t room, const void *given, fbd_errors *errors);

/* Fill the `size` bytes of a caller's options with defaults; what is not known here gets zeros. */
void api_fill_options(void *options, size_t size, const void *defaults, size_t room);

/* Is each of `count` texts there, and name and value of each setting? */
bool api_has_texts(const char *const *texts, size_t count);
bool api_has_settings(const fbd_setting *settings, size_t count);

#endif
