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

/* Is each of `count` texts there, and name and value of each setting? */
bool call_has_texts(const char *const *texts, size_t count);
bool call_has_settings(const fbd_setting *settings, size_t count);

#endif
