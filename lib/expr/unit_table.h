/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The table of unit.h: the units, and hints for other words.
 */
#ifndef FBD_EXPR_UNIT_TABLE_H
#define FBD_EXPR_UNIT_TABLE_H

#include "expr/unit.h"

/* A factor as a quotient of two doubles that are exact where the definition allows it: then lbf/in is 12
 * lbf/ft and N/mm is 1000 N/m without rounding. */
struct unit_ratio {
    double over, under;
};

struct unit_row {
    const char *name;
    struct dim dim;
    struct unit_ratio factor[2]; /* indexed by enum unit_system */
    bool angle;
};

/* The row of the unit called `name[0..length)`, or NULL. */
const struct unit_row *unit_find(const char *name, size_t length);

/* Row `index`, or NULL past the end. */
const struct unit_row *unit_row(size_t index);

/* A hint for the unknown unit `name[0..length)`. */
const char *unit_suggest(fbd_errors *errors, const char *name, size_t length);

#endif
