/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The table of the columns: a row for each kind, in the order in which an output lists those of one scope.
 */
#ifndef FBD_OUTPUT_COLUMN_TABLE_H
#define FBD_OUTPUT_COLUMN_TABLE_H

#include "output/run_columns.h"

/* A column belongs to the run, a body, a user state, an output point, an arrow, or the works of a body. */
enum column_scope { of_run, of_body, of_state, of_point, of_arrow, of_works, of_energy };

struct column_row {
    enum column_scope scope;
    unsigned uses; /* enum column_use */
    enum column_quantity quantity;
    int parts; /* at most */
    bool (*define)(struct run_columns *columns, struct run_column *c);
    void (*values)(const struct run_column *c, int count, struct column_view *view, double *values);
    double (*error)(const struct run_column *c, const struct column_view *view, const struct bars *bars,
                    double value, double other); /* NULL for an exact value */
};

extern const struct column_row column_rows[column_kinds];

#endif
