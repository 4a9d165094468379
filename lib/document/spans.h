/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Spans: the extent of the values of a model file in its text, so that a text can be changed in one place and
 * stay unchanged elsewhere. The tree of node.h contains only where values begin; their ends are in libyaml's
 * document, which is made anew for this.
 *
 * Values are numbered; 0 is none, and queries of it return none.
 */
#ifndef FBD_DOCUMENT_SPANS_H
#define FBD_DOCUMENT_SPANS_H

#include <stdbool.h>
#include <stddef.h>

/* Bytes `from` to before `to`. */
struct span {
    size_t from, to;
};

struct spans;

/* Parse a text that is a valid model; it must live as long. NULL if it is no YAML, or memory is out. */
struct spans *spans_open(const char *text, size_t length);
void spans_close(struct spans *spans);

int spans_root(const struct spans *spans);

/* The value under `key` of a mapping, and the span of the key. */
int spans_find(const struct spans *spans, int map, const char *key);
struct span spans_key(const struct spans *spans, int map, const char *key);

/* Entry `index` of a list; the number of entries or pairs. */
int spans_item(const struct spans *spans, int list, size_t index);
size_t spans_count(const struct spans *spans, int collection);

/* The key of pair `index` of a mapping, terminated; NULL past the last. */
const char *spans_key_name(const struct spans *spans, int map, size_t index);

bool spans_is_map(const struct spans *spans, int value);
bool spans_is_list(const struct spans *spans, int value);
bool spans_is_flow(const struct spans *spans, int value); /* written in brackets */

/* The span of a value, without comments behind it; and without its quotes. */
struct span spans_of(const struct spans *spans, int value);
struct span spans_inside(const struct spans *spans, int value);

/* True for a scalar on one line, whose text stands in the file unchanged. */
bool spans_is_plain(const struct spans *spans, int value);

/* Line and column, from 1, as in messages. */
void spans_place(const struct spans *spans, int value, int *line, int *column);

#endif
