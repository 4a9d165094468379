/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Slip laws: coefficients of dry friction that may go with `slip`, the speed of the pair on its surface.
 *
 * What holds a pair at rest is asked for at rest only, so `slip` is the number 0 in a static coefficient. One
 * law for both coefficients is read twice: at rest, where it mostly is a number, and in motion.
 */
#ifndef FBD_SCENE_SLIP_LAW_H
#define FBD_SCENE_SLIP_LAW_H

#include "scene/language.h"
#include "scene/names.h"
#include "scene/reader.h"

/* A coefficient, with `slip` as it says; `flags` are those of its field. */
bool slip_law_read(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                   unsigned flags, enum slip_name slip, const struct scope *scope, struct value *value);

/* The static coefficient from the other one, of which `node` is the text, or the reverse. */
bool slip_law_share(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                    enum slip_name slip, const struct scope *scope, const struct value *given,
                    struct value *value);

#endif
