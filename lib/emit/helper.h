/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FBD_EMIT_HELPER_H
#define FBD_EMIT_HELPER_H

#include <stdbool.h>
#include <stddef.h>

/* Features of a program: friction pairs, switches, one-sided surfaces, events, a tree of bodies. A line of a
 * text that begins with `@pairs surfaces|` is written if the program has one of these, with `@!pairs
 * !events|` if it has none. */
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
