/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Emit: a scene as one readable C program, with the formulas of dynamics/ in their order, so that its
 * accelerations have the digits of the library's.
 *
 * Each file here writes a part of the program into a text of its own; program.c joins them. Scenes that
 * cannot be written are refused first (admit.c), including those with entries of the language that this room
 * does not handle yet.
 */
#ifndef FBD_EMIT_EMIT_H
#define FBD_EMIT_EMIT_H

#include "base/text.h"
#include "expr/program.h"
#include "model/model.h"

struct emit_name;
struct live;

struct emitter {
    const struct fbd_model *model;
    struct arena arena;
    struct emit_name *taken; /* names, the latest first */
    /* the texts of the program, in their order */
    struct text parameters;         /* members of struct parameters */
    struct text defaults;           /* statements that set them */
    struct text constants;          /* members of struct constants */
    struct text derive;             /* statements that compute them */
    struct text formulas;           /* functions of expressions */
    struct text forces;             /* functions of bodies */
    struct text links;              /* passes over the links of a tree */
    struct text start;              /* statements that set the state */
    struct text rest;               /* passes over the links of the tree */
    struct live *live;              /* statements that set the initial state */
    bool *fixed;                    /* those that are part of other numbers, by parameter; the caller's */
    bool *used;                     /* parameters of the file, see live.h */
    const char **rods;              /* by parameter: it is contained in other numbers; array of the caller */
    const char **pose, **forces_on; /* by absolute: named in a formula of the program */
    bool walks;                     /* constants of rods, by part through all bodies; NULL if none */
    /* function names, by body; NULL until written */
    const char **body, **coordinate, **rate, **load, **place, **branch, **pair, **slot;
};

/* the program has a function load_links */
struct emit_origin {
    struct pos at;
    const char *key;
    struct dim dim;
    int body; /* of formulas: body whose coordinates have no prefix; -1 for none */
};

/* The position of a number in the file: the entry of the body, part or load, and the key in it. */

/* A unique C identifier similar to `wanted`. */
const char *emit_name(struct emitter *emitter, const char *wanted);
const char *emit_join(struct emitter *emitter, const char *first, const char *second);

const char *emit_printf(struct emitter *emitter, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* True if the program uses positions in the world. */
bool emit_has_places(const struct emitter *emitter);

/* Choose the names used by several parts. Returns false when memory is out. */
bool emit_names(struct emitter *emitter);

/* ---- write.c */

/* A number as text that C reads back exactly. */
const char *emit_number(struct emitter *emitter, double value);

/* Append text of the file to a comment, changed so that it cannot end the comment. */
void emit_comment(struct text *text, const char *words);

/* Add a member of struct parameters named like `wanted`, with the value of the file and its unit; returns
 * "p->NAME". */
const char *emit_parameter(struct emitter *emitter, const char *wanted, double value,
                           struct emit_origin origin);
/* The same for a point, or the end of a rod; origin.body: the body of its frame, -1 for the ground. */
const char *emit_vector(struct emitter *emitter, const char *wanted, struct vec value,
                        struct emit_origin origin);

/* True if points of a body and the lengths of its rods are parameters. For a free body they are not, since
 * the form of its equations depends on them. */
bool emit_tells_points(const struct emitter *emitter, int b);

/* The end of a rod named by `word`, among the constants; NULL if it is none (inertia.c). */
const char *emit_rod_end(struct emitter *emitter, int b, const char *word, struct vec value);

/* Add a member of struct constants named like `wanted`; returns its name. */
const char *emit_constant(struct emitter *emitter, const char *type, const char *wanted);

/* ---- expression.c */

/* The C expression of a program; its switches are branch `first` of the plan and the following ones. */
const char *emit_expression(struct emitter *emitter, const struct expr *expr, int first);

/* The argument of a switch of the program, and the condition under which it is evaluated: NULL for always. */
struct emit_switch {
    const struct instr *instr;
    const char *a, *b, *condition;
};
bool emit_switches(struct emitter *emitter, const struct expr *expr, int first, struct emit_switch *switches);

/* ---- formula.c */

/* The value of a formula: "p->NAME" of a constant, else the call of a function, which is written too. */
const char *emit_formula(struct emitter *emitter, const struct formula *formula, const char *wanted,
                         struct emit_origin origin);

/* The call of a function that returns a struct dual with the first and second derivative by a slot (0: t). */
const char *emit_slope(struct emitter *emitter, const struct formula *formula, const char *wanted, int slot,
                       struct emit_origin origin);

/* ---- the parts */

void emit_inertias(struct emitter *emitter); /* inertia.c */
void emit_bodies(struct emitter *emitter);   /* bodies.c */
void emit_tree(struct emitter *emitter);     /* tree.c */
void emit_solution(struct emitter *emitter); /* solve.c */
void emit_modes(struct emitter *emitter);    /* modes.c */

/* The number of watched functions. */
int emit_watches(const struct emitter *emitter);

/* Write the functions of the list that `calls` needs, each once (helpers.c). */
struct helper;
void emit_helpers(struct emitter *emitter, const struct helper *list, size_t count, const struct text *calls,
                  struct text *out);

/* The complete program (program.c). NULL when memory is out, or with notes in `errors` (`cannot-emit`) about
 * unsupported elements. */
char *emit_program(const struct fbd_model *model, double until, double tolerance, fbd_errors *errors);

/* ---- admit.c */

/* Check that the scene can be written. Notes in `errors` (`cannot-emit`) list unsupported elements. */
bool emit_admits(const struct fbd_model *model, fbd_errors *errors);

#endif
