/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows of numbers under column heads, for programs; the content of the CSV, without text.
 */
#ifndef FBD_RECORD_NUMBERS_H
#define FBD_RECORD_NUMBERS_H

#include "base/text.h"
#include "fbd_export.h"

struct numbers {
    struct text names; /* of the heads, each zero-terminated */
    fbd_column *heads;
    size_t columns, head_room;
    double *values;
    size_t filled, whole, room; /* numbers: all, those of complete rows, capacity */
    bool failed;                /* memory ran out */
};

/* Add a column; `name` is copied, `unit` is not. */
void numbers_head(struct numbers *numbers, const char *name, const char *unit);

/* Call after the last numbers_head. False when memory is out. */
bool numbers_begin(struct numbers *numbers);

/* Add the next number of the row; numbers_end_row keeps the row, false when memory is out; numbers_drop_row
 * discards it. */
void numbers_add(struct numbers *numbers, double value);
bool numbers_end_row(struct numbers *numbers);
void numbers_drop_row(struct numbers *numbers);

void numbers_free(struct numbers *numbers);

#endif
