/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Written: a text of the file in the notation of textbooks, as the expression that it means (expr/notation.h).
 */
#ifndef FBD_SCENE_WRITTEN_H
#define FBD_SCENE_WRITTEN_H

#include "expr/notation.h"
#include "scene/reader.h"

/* `node` with an expression for its text: itself when its text is one already. `equation` as for notation_read; `scope`
 * is one of names_scope. What is compiled of it is to be followed by written_places. NULL with a note, or when memory is
 * out. */
const struct node *written_node(struct reader *reader, const struct node *node, const struct scope *scope,
                                bool equation, struct notation *notation);

/* Move notes behind `last`, on what written_node made of `node`, to where that stands in the file. */
void written_places(struct reader *reader, const struct node *node, const struct notation *notation,
                    struct diag_note *last);

#endif
