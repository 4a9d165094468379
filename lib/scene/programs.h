/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Programs: the expressions of a file that have been compiled once, for readings of it under other
 * parameters.
 *
 * Constants are folded into the program that names them, so a program is valid for another reading unless it
 * names a varying parameter, directly or through other definitions (or a position in the world, whose slot
 * each reading numbers anew): then names.c sets `varies` in the reader. The first reading keeps the valid
 * ones (programs_keep); later ones, in any thread, find them (programs_find).
 */
#ifndef FBD_SCENE_PROGRAMS_H
#define FBD_SCENE_PROGRAMS_H

#include "document/node.h"
#include "expr/expr.h"
#include "scene/names.h"

/* Position of an expression and all that determines its program beside the text. By an alias one node may be
 * in several places. */
struct program_site {
    const struct node *node;
    enum place place;
    int body;
    struct expr_want want;
};

struct program {
    struct program_site site;
    const struct expr *left, *right; /* right: of a relation that has one */
    char relation;
};

struct programs {
    struct arena arena;
    struct program *table; /* `room` entries, a power of two; free ones have no node */
    size_t room, count;
};

/* The program of a site, or NULL. `programs` may be NULL. */
const struct program *programs_find(const struct programs *programs, const struct program_site *site);

/* Keep one; without memory it is dropped. */
void programs_keep(struct programs *programs, const struct program *program);

void programs_free(struct programs *programs);

#endif
