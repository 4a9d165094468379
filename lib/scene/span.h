/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A part of a text, without a terminating zero.
 */
#ifndef FBD_SCENE_SPAN_H
#define FBD_SCENE_SPAN_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

struct span {
    const char *text;
    size_t length;
};

static inline bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static inline struct span trim(struct span s)
{
    while (s.length && is_blank(s.text[0])) s.text++, s.length--;
    while (s.length && is_blank(s.text[s.length - 1])) s.length--;
    return s;
}

static inline bool is_same(struct span a, struct span b)
{
    return a.length == b.length && memcmp(a.text, b.text, a.length) == 0;
}

#endif
