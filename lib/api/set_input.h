/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Inputs whose values belong to the states: set between steps.
 */
#ifndef FBD_API_SET_INPUT_H
#define FBD_API_SET_INPUT_H

#include "base/diag.h"
#include "scene/scene.h"

/* The index of an input that can be set; SIZE_MAX with a note `unknown-input` or `fixed-input` otherwise. */
size_t settable_input(const struct scene *scene, const char *name, fbd_errors *errors);

#endif
