/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The tables of a scene (expr/table.h). A table may be as large as a file of measured data, so scenes of one
 * text, such as those of a sweep, of variants and of the check of derivations, share it by reference
 * counting.
 */
#ifndef FBD_SCENE_TABLES_H
#define FBD_SCENE_TABLES_H

#include <stdatomic.h>

#include "base/diag.h"
#include "base/sha256.h"
#include "expr/table.h"

struct shared_table {
    struct table table;
    char *name;               /* of the table */
    char sha256[sha256_size]; /* of the text of its file; "" for points of the model file */
    atomic_size_t holders;
};

struct scene_table {
    const char *name;
    struct pos at;
    const char *file;            /* file set from outside (`--set name=file`), or NULL */
    const char *path;            /* path of the file that was read for this scene, or NULL */
    struct shared_table *shared; /* NULL after an error */
    bool names_parameters;       /* its points are valid for one reading only */
};

/* A new table without points and with one reference; NULL when memory is out. */
struct shared_table *shared_table_new(const char *name);
struct shared_table *shared_table_hold(struct shared_table *shared);
void shared_table_release(struct shared_table *shared);

#endif
