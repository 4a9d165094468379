/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FBD_EMIT_HELPER_H
#define FBD_EMIT_HELPER_H

#include <stdbool.h>
#include <stddef.h>

/* Whether a program has pairs of friction, switches, surfaces that are pressed on, events, a tree of bodies: a line of a text that
 * begins with `@pairs surfaces|` is written where it has one of these, with `@!pairs !events|` where none. */
struct helper_features {
    bool pairs, branches, surfaces, events, tree;
};

/* A function or structure of emitted programs: its name (of a structure "struct NAME") and its text. Made from
 * helpers.in and run.in by `parts`. */
struct helper {
    const char *name, *text;
};

extern const struct helper emit_helper_list[];
extern const size_t emit_helper_count;
extern const struct helper emit_run_list[];
extern const size_t emit_run_count;

#endif
