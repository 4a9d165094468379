/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Record: the expressions of one reading of a file, with what it takes to compile them again under other values of
 * the parameters that they name (patch.h).
 */
#ifndef FBD_SCENE_RECORD_H
#define FBD_SCENE_RECORD_H

#include "scene/reader.h"

/* An expression that was compiled while a scene was read. */
struct site {
    const struct node *node;
    const struct override *outside; /* its text is the value of this one; else NULL */
    const struct expr *expr;
    bool varies;    /* names what varies, */
    bool patched;   /* and stands where something else may be put */
    bool constants; /* knows constants alone */
    unsigned flags;
    struct expr_want want;
    struct names names;
};

/* The expressions of one reading, in the order in which they were compiled. */
struct record {
    struct arena exprs;   /* their memory, */
    struct arena derived; /* and that of those which follow from them (derived.h), where nothing is put */
    struct site *sites;
    size_t count, room;
};

/* Note an expression; NULL where there is none, as on one side of a comparison. */
void record_compiled(const struct reader *reader, const struct node *node, const struct expr *expr);

/* The one that was noted last is a constant or formula with a field that is `stored`. */
void record_site(const struct reader *reader, const struct expr *expr, unsigned flags,
                 const struct expr_want *want, const struct names *names);

#endif
