/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Numbers: rows of numbers under heads, for programs; what the CSV has, without text.
 */
#ifndef FBD_RECORD_NUMBERS_H
#define FBD_RECORD_NUMBERS_H

#include "base/text.h"
#include "fbd.h"

struct numbers {
    struct text names; /* of the heads, each with its zero */
    fbd_column *heads;
    size_t columns, head_room;
    double *values;
    size_t filled, whole, room; /* numbers: all, those of whole rows, that there is room for */
    bool failed;                /* memory ran out */
};

/* One more column; `name` is copied, `unit` is not. */
void numbers_head(struct numbers *numbers, const char *name, const char *unit);

/* All heads are there. False when memory is out. */
bool numbers_begin(struct numbers *numbers);

/* The next number of the row; numbers_end_row keeps the row, false when memory is out, numbers_drop_row does not.
 */
void numbers_add(struct numbers *numbers, double value);
bool numbers_end_row(struct numbers *numbers);
void numbers_drop_row(struct numbers *numbers);

void numbers_free(struct numbers *numbers);

#endif
