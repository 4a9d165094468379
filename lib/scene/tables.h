/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The tables of a scene (expr/table.h). A table may be as large as a file of measured data, so scenes of one text, as
 * those of a sweep, of variants and of the check of derivations, share it: it is read once, and goes with the last
 * scene that holds it.
 */
#ifndef FBD_SCENE_TABLES_H
#define FBD_SCENE_TABLES_H

#include <stdatomic.h>

#include "base/diag.h"
#include "expr/table.h"

struct shared_table {
    struct table table;
    char *name; /* of the table */
    atomic_size_t holders;
};

struct scene_table {
    const char *name;
    struct pos at;
    const char *file;            /* the file that was set from outside (`--set name=file`), or NULL */
    const char *path;            /* of the file that was read for this scene, or NULL */
    struct shared_table *shared; /* NULL where it is wrong */
    bool names_parameters;       /* its points are those of one reading */
};

/* A new one without points, held once; NULL when memory is out. */
struct shared_table *shared_table_new(const char *name);
struct shared_table *shared_table_hold(struct shared_table *shared);
void shared_table_release(struct shared_table *shared);

#endif
