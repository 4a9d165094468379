/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Data files: two columns of numbers from a text file as written by instruments, spreadsheets and fbd-run
 * --csv.
 *
 * One row a line; the separator of cells is the first of `;`, tab, `,` and blanks that occurs in the first
 * row. The first row may name the columns, with units in brackets or parentheses: `t [s],force (N)`. Lines
 * that are empty or start with `#` are skipped; if no row names columns, the `#` line just before the numbers
 * may. Cells may stand in double quotes. Numbers have a decimal point; with `;` or tabs as separators a
 * decimal comma is accepted. No row has more cells than the first one.
 */
#ifndef FBD_SCENE_DATA_FILE_H
#define FBD_SCENE_DATA_FILE_H

#include "base/diag.h"
#include "expr/unit.h"

/* A name followed by a unit, as in `force [N]`: a heading of a data file, or a column name in a model file. */
struct heading {
    const char *name, *unit; /* in the text; unit is NULL when there is none */
    size_t name_length, unit_length;
};
struct heading heading_read(const char *text, size_t length);

/* Two columns, in the file's own units. */
struct data_columns {
    double *values[2]; /* count each; to be freed */
    size_t count;
    int *lines;              /* count, to be freed: line number of each row */
    struct heading found[2]; /* in the text of the file */
    struct pos heading_at[2];
};

/* The file read last, for further columns of it; to be freed by data_text_free. */
struct data_text {
    const char *path; /* of the caller, or NULL */
    char *text;
    size_t length;
};
void data_text_free(struct data_text *kept);

/* Positions in the model file of the names of the columns and of the data file; line 0 if not named. */
struct data_places {
    struct pos file, columns[2];
};

/* Read the columns called `wanted[0]` and `wanted[1]`; for NULL the first and the second of the file. A
 * number is the index of a column from 1, unless a column has that name. False with notes in `errors`:
 * `cannot-read`, `unknown-column`, `table-format`; notes about the text of the data file name that file.
 * `kept` holds the text of the last file, which is not read again, and is replaced by that of this one;
 * `path` must live until the next call. */
bool data_file_read(const char *path, const char *const wanted[2], const struct data_places *places,
                    struct data_text *kept, fbd_errors *errors, struct data_columns *columns);
void data_columns_free(struct data_columns *columns);

#endif
