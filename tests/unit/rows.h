/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The CSV of a run in a test. Include after <cmocka.h>.
 */
#ifndef FBD_TESTS_ROWS_H
#define FBD_TESTS_ROWS_H

#include <stdlib.h>
#include <string.h>

struct rows {
    char *text;
    size_t length;
};

/* An fbd_write: `context` is a struct rows, whose text is to be freed. */
static inline int append(void *context, const char *text, size_t length)
{
    struct rows *rows = context;
    char *longer = realloc(rows->text, rows->length + length + 1);
    if (!longer) return -1;
    rows->text = longer;
    memcpy(rows->text + rows->length, text, length);
    rows->length += length;
    rows->text[rows->length] = '\0';
    return 0;
}

#endif
