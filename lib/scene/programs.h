/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Programs: the expressions of a file that have been compiled once, for readings of it under other
 * parameters.
 *
 * A constant is folded into the program that names it, so a program holds for another reading unless it names
 * a parameter that varies, straight or through other definitions (or a place in the world, whose slot each
 * reading numbers for itself): names.c sets `varies` in the reader then. The first reading keeps those that
 * hold (programs_keep); later ones, in any thread, find them (programs_find).
 */
#ifndef FBD_SCENE_PROGRAMS_H
#define FBD_SCENE_PROGRAMS_H

#include "expr/expr.h"
#include "scene/names.h"
#include "scene/node.h"

/* Where an expression stands, and what decides the program that its text becomes. An alias may bring one node
 * to several places. */
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
    struct program *table; /* `room` places, a power of two; free ones have no node */
    size_t room, count;
};

/* The program of a site, or NULL. `programs` may be NULL. */
const struct program *programs_find(const struct programs *programs, const struct program_site *site);

/* Keep one; when memory is out it is not kept. */
void programs_keep(struct programs *programs, const struct program *program);

void programs_free(struct programs *programs);

#endif
