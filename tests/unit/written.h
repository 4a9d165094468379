/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The text of a scene that is written piece by piece, for tests that draw their scenes. cmocka.h comes first.
 */
#ifndef FBD_TESTS_WRITTEN_H
#define FBD_TESTS_WRITTEN_H

#include <stdarg.h>
#include <stdio.h>

enum { written_room = 20000 };

struct written {
    int length;
    char all[written_room];
};

/* Write on; the test fails where there is no room. */
__attribute__((format(printf, 2, 3))) static inline void add(struct written *text, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    text->length +=
        vsnprintf(text->all + text->length, (size_t)(written_room - text->length), format, values);
    va_end(values);
    assert_true(text->length < written_room);
}

#endif
