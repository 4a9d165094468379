/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Written: a text of the file in textbook notation, converted to an expression (expr/notation.h).
 */
#ifndef FBD_SCENE_WRITTEN_H
#define FBD_SCENE_WRITTEN_H

#include "expr/notation.h"
#include "scene/reader.h"

/* `node` with its text converted to an expression, or `node` itself if its text is one already. `equation` as
 * for notation_read; `scope` is one of names_scope. Call written_places after compiling the result. NULL with
 * a note, or when memory is out. */
const struct node *written_node(struct reader *reader, const struct node *node, const struct scope *scope,
                                bool equation, struct notation *notation);

/* Move notes behind `last`, on the result of written_node for `node`, to their positions in the file. */
void written_places(struct reader *reader, const struct node *node, const struct notation *notation,
                    struct diag_note *last);

#endif
