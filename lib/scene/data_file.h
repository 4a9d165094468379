/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Data files: two columns of numbers from a text such as instruments, spreadsheets and fbd-run --csv write.
 *
 * One row a line; cells are parted by `;`, tabs, `,` or blanks, whichever of these, in this order, the first row has.
 * The first row may name the columns, with units in brackets or parentheses: `t [s],force (N)`. Lines that are empty
 * or start with `#` are skipped; where no row names columns, the `#` line just before the numbers may. Cells may stand
 * in double quotes. Numbers have a decimal point; in files parted by `;`
 * or tabs a decimal comma will do. No row has more cells than the first one.
 */
#ifndef FBD_SCENE_DATA_FILE_H
#define FBD_SCENE_DATA_FILE_H

#include "base/diag.h"
#include "expr/unit.h"

/* A name with a unit behind it, as in `force [N]`: a heading of a file, or what a model file calls one. */
struct heading {
    const char *name, *unit; /* in the text; unit is NULL when there is none */
    size_t name_length, unit_length;
};
struct heading heading_read(const char *text, size_t length);

/* Two columns, in the file's own units. */
struct data_columns {
    double *values[2]; /* count each; to be freed */
    size_t count;
    int *lines;              /* count, to be freed: where each row stands */
    struct heading found[2]; /* in the text of the file */
    struct pos heading_at[2];
};

/* The file that was read last, for those that want more of its columns; to be freed by data_text_free. */
struct data_text {
    const char *path; /* of the caller, or NULL */
    char *text;
    size_t length;
};
void data_text_free(struct data_text *kept);

/* Where in the model file the columns and the data file itself are named; line 0 where they are not. */
struct data_places {
    struct pos file, columns[2];
};

/* Read the columns called `wanted[0]` and `wanted[1]`; where one is NULL, the first and the second of the file. A
 * number is the place of a column, unless one is called so. False with notes in `errors`, whose file is the data
 * file's for those about its text: `cannot-read`, `unknown-column`, `table-format`. `kept` holds the text of the last
 * file, which is not read again, and then that of this one, until the next call; `path` lives as long. */
bool data_file_read(const char *path, const char *const wanted[2], const struct data_places *places,
                    struct data_text *kept, fbd_errors *errors, struct data_columns *columns);
void data_columns_free(struct data_columns *columns);

#endif
