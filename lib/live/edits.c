/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Changes of a text: see edits.h.
 */
#include "live/edits.h"

#include <stdlib.h>
#include <string.h>

struct edit {
    size_t from, to, order;
    char *with;
};

void edits_replace(struct edits *edits, size_t from, size_t to, const char *with)
{
    if (edits->count == edits->room) {
        size_t room = edits->room ? 2 * edits->room : 64;
        struct edit *list = realloc(edits->list, room * sizeof *list);
        if (!list) {
            edits->failed = true;
            return;
        }
        edits->list = list;
        edits->room = room;
    }
    struct edit *edit = &edits->list[edits->count];
    *edit = (struct edit){.from = from, .to = to, .order = edits->count};
    edit->with = strdup(with);
    if (edit->with)
        edits->count++;
    else
        edits->failed = true;
}

/* ---- lines */

static size_t line_start(const struct edits *edits, size_t at)
{
    while (at > 0 && edits->text[at - 1] != '\n') at--;
    return at;
}

void edits_comment_out(struct edits *edits, size_t from, size_t to)
{
    size_t column = from - line_start(edits, from);
    for (size_t at = from; at < to;) {
        edits_replace(edits, at, at, "# ");
        const char *end = memchr(edits->text + at, '\n', to - at);
        if (!end) return;
        at = (size_t)(end - edits->text) + 1;
        while (at < to && strchr("\r\n", edits->text[at])) at++; /* empty lines stay */
        size_t indent = 0;
        while (indent < column && at + indent < to && edits->text[at + indent] == ' ') indent++;
        at += indent;
    }
}

size_t edits_dash(const struct edits *edits, size_t from)
{
    size_t at = from;
    while (at > 0 && edits->text[at - 1] == ' ') at--;
    return at > 0 && edits->text[at - 1] == '-' ? at - 1 : from;
}

/* ---- pairs */

void edits_remove_pair(struct edits *edits, const struct spans *spans, int map, const char *key)
{
    struct span name = spans_key(spans, map, key), value = spans_of(spans, spans_find(spans, map, key));
    size_t next = 0, before = 0;
    if (name.to == 0) return;
    if (!spans_is_flow(spans, map)) {
        edits_comment_out(edits, name.from, value.to);
        return;
    }
    for (size_t i = 0; i < spans_count(spans, map); i++) {
        const char *other_name = spans_key_name(spans, map, i);
        struct span other = other_name ? spans_key(spans, map, other_name) : name;
        if (other.from > name.from && (next == 0 || other.from < next)) next = other.from;
        if (other.from < name.from) {
            struct span of = spans_of(spans, spans_find(spans, map, other_name));
            if (of.to > before) before = of.to;
        }
    }
    edits_replace(edits, next || before == 0 ? name.from : before, next ? next : value.to, "");
}

/* True if only blanks stand before `at` on its line. */
static bool begins_line(const struct edits *edits, size_t at)
{
    size_t start = at;
    while (start > 0 && edits->text[start - 1] == ' ') start--;
    return start == 0 || edits->text[start - 1] == '\n';
}

bool edits_new_pair(const struct edits *edits, const struct spans *spans, int map, const char *key,
                    struct text *before, size_t *at)
{
    size_t count = spans_count(spans, map);
    const char *last = count > 0 ? spans_key_name(spans, map, count - 1) : NULL;
    if (!last) return false;
    const struct span name = spans_key(spans, map, last),
                      value = spans_of(spans, spans_find(spans, map, last));
    if (value.to <= name.to) return false; /* an alias */
    *at = value.to;
    if (spans_is_flow(spans, map)) {
        text_printf(before, ", %s: ", key);
        return true;
    }
    if (!begins_line(edits, name.from)) return false;
    const char *end = memchr(edits->text + *at, '\n', edits->length - *at);
    *at = end ? (size_t)(end - edits->text) : edits->length; /* after a comment on that line */
    text_printf(before, "\n%*s%s: ", (int)(name.from - line_start(edits, name.from)), "", key);
    return true;
}

/* ---- the changed text */

static int by_place(const void *a, const void *b)
{
    const struct edit *first = a, *second = b;
    if (first->from != second->from) return (first->from > second->from) - (first->from < second->from);
    return (first->order > second->order) - (first->order < second->order);
}

void edits_apply(struct text *text, struct edits *edits)
{
    size_t at = 0;
    if (edits->count > 0) qsort(edits->list, edits->count, sizeof *edits->list, by_place);
    for (size_t i = 0; i < edits->count; i++) {
        const struct edit *now = &edits->list[i];
        if (now->from < at) continue; /* inside a removed part */
        text_add_bytes(text, edits->text + at, now->from - at);
        text_add(text, now->with);
        at = now->to;
    }
    text_add_bytes(text, edits->text + at, edits->length - at);
    text->failed |= edits->failed;
}

void edits_free(struct edits *edits)
{
    for (size_t i = 0; i < edits->count; i++) free(edits->list[i].with);
    free(edits->list);
    edits->list = NULL;
    edits->count = edits->room = 0;
}
