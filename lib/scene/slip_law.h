/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Slip laws: coefficients of dry friction that may depend on `slip`, the slip speed.
 *
 * A static coefficient is evaluated at rest only, so there `slip` is the number 0. One law for both
 * coefficients is read twice: at rest, where it is mostly a number, and in motion.
 */
#ifndef FBD_SCENE_SLIP_LAW_H
#define FBD_SCENE_SLIP_LAW_H

#include "scene/language.h"
#include "scene/names.h"
#include "scene/reader.h"

/* Read a coefficient with `slip` in the given meaning; `flags` are those of its field. */
bool slip_law_read(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                   unsigned flags, enum slip_name slip, const struct scope *scope, struct value *value);

/* Derive the static coefficient from the kinetic one, whose text is `node`, or the reverse. */
bool slip_law_share(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                    enum slip_name slip, const struct scope *scope, const struct value *given,
                    struct value *value);

#endif
