/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Record: the expressions of one reading of a file, with the data to compile them again under other values of
 * the parameters that they name (patch.h).
 */
#ifndef FBD_SCENE_RECORD_H
#define FBD_SCENE_RECORD_H

#include "scene/reader.h"

/* An expression that was compiled while a scene was read. */
struct site {
    const struct node *node;
    const struct override *outside; /* override whose value is its text; else NULL */
    const struct expr *expr;
    bool varies;    /* depends on a varying name */
    bool patched;   /* may be replaced by another value */
    bool constants; /* its scope has constants only */
    struct expr_want want;
    struct names names;
};

/* The expressions of one reading, in the order in which they were compiled. */
struct record {
    struct arena exprs;   /* memory of expressions */
    struct arena derived; /* memory of expressions derived from them (derived.c), which are not replaced */
    struct site *sites;
    size_t count, room;
};

/* Record a compiled expression; NULL if there is none, as on one side of a comparison. */
void record_compiled(const struct reader *reader, const struct node *node, const struct expr *expr);

/* Mark the expression recorded last as a constant or formula of a `stored` field. */
void record_site(const struct reader *reader, const struct expr *expr, const struct expr_want *want,
                 const struct names *names);

#endif
