/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Edits: changes of the text of a model in several places at once. The rest of the text, its comments and its
 * layout stay.
 */
#ifndef FBD_LIVE_EDITS_H
#define FBD_LIVE_EDITS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/text.h"
#include "document/spans.h"

struct edit;

struct edits {
    const char *text;
    size_t length;
    struct edit *list;
    size_t count, room;
    bool failed; /* memory ran out */
};

/* Replace the bytes `from` to before `to` by a copy of `with`; of several insertions at one place the first one
 * stands first. */
void edits_replace(struct edits *edits, size_t from, size_t to, const char *with);

/* Comment out the lines from `from`, the start of the entry, to that of `to`, each from the same column on. */
void edits_comment_out(struct edits *edits, size_t from, size_t to);

/* The position of the dash before an entry of a list on lines of its own; `from` without one. */
size_t edits_dash(const struct edits *edits, size_t from);

/* Comment out a pair on lines of its own, or cut it out of brackets; nothing where the mapping has no such key. */
void edits_remove_pair(struct edits *edits, const struct spans *spans, int map, const char *key);

/* The place `*at` and the text `before` the value of a new pair, behind the last one of a nonempty mapping; false
 * where the layout of the mapping has no such place. */
bool edits_new_pair(const struct edits *edits, const struct spans *spans, int map, const char *key,
                    struct text *before, size_t *at);

/* Append the changed text. */
void edits_apply(struct text *text, struct edits *edits);
void edits_free(struct edits *edits);

#endif
