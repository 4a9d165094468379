/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Emit: a scene as one C program that a student could have written, with the formulas of dynamics/ in their
 * order, so that its accelerations have the digits of the library's.
 *
 * Each file here writes a part of the program into a text of its own; program.c puts them together. What is
 * not taken is refused before anything is written (admit.c): an entry of the language that this room does not
 * know is refused like one that it knows it cannot write.
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
    struct text rest;               /* modes, events, main */
    struct live *live;              /* parameters, see live.h */
    bool *fixed;                    /* those that are part of other numbers, by parameter; the caller's */
    bool *used;                     /* absolutes that a formula of the program names */
    const char **rods;              /* their constants, by part through all bodies; NULL without one */
    const char **pose, **forces_on; /* functions, by body; NULL until they are written */
    bool walks;                     /* the tree has functions of its own */
    /* C names: by body, coordinate, load, absolute, branch, friction, slot of forces */
    const char **body, **coordinate, **rate, **load, **place, **branch, **pair, **slot;
};

/* Where the file says a number: the entry of the body, part or load, and the key in it. */
struct emit_origin {
    struct pos at;
    const char *key;
    struct dim dim;
    int body; /* of formulas: whose coordinates have no dot; -1 for none */
};

/* ---- names.c */

/* A C identifier like `wanted` that nothing else in the program has. */
const char *emit_name(struct emitter *emitter, const char *wanted);
const char *emit_join(struct emitter *emitter, const char *first, const char *second);

const char *emit_printf(struct emitter *emitter, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Does the program name places in the world? */
bool emit_has_places(const struct emitter *emitter);

/* The names that many parts use. False when memory is out. */
bool emit_names(struct emitter *emitter);

/* ---- write.c */

/* A number as C reads it back to the bit. */
const char *emit_number(struct emitter *emitter, double value);

/* Words of the file within a comment, which they cannot end. */
void emit_comment(struct text *text, const char *words);

/* A member of struct parameters like `wanted`, with the value of the file and its unit; returns "p->NAME". */
const char *emit_parameter(struct emitter *emitter, const char *wanted, double value,
                           struct emit_origin origin);
/* A point likewise, or the end of a rod; origin.body: in whose frame, -1 for the ground. */
const char *emit_vector(struct emitter *emitter, const char *wanted, struct vec value,
                        struct emit_origin origin);

/* Are points of a body and the lengths of its rods written as the file says them? Where a body moves freely by
 * itself they decide what its equations look like. */
bool emit_tells_points(const struct emitter *emitter, int b);

/* The end of a rod that a word of the file names, among the constants; NULL where it is none (inertia.c). */
const char *emit_rod_end(struct emitter *emitter, int b, const char *word, struct vec value);

/* A member of struct constants like `wanted`; returns its name. */
const char *emit_constant(struct emitter *emitter, const char *type, const char *wanted);

/* ---- expression.c */

/* The C expression of a program in the branches that begin with branch `first` of the plan. */
const char *emit_expression(struct emitter *emitter, const struct expr *expr, int first);

/* What each switch of the program watches, and when: NULL for always. */
struct emit_switch {
    const struct instr *instr;
    const char *a, *b, *condition;
};
bool emit_switches(struct emitter *emitter, const struct expr *expr, int first, struct emit_switch *switches);

/* ---- formula.c */

/* The value of a formula: "p->NAME" of a constant, else the call of a function, which is written. */
const char *emit_formula(struct emitter *emitter, const struct formula *formula, const char *wanted,
                         struct emit_origin origin);

/* The call of a function whose result, a struct dual, has the first and second derivative by a slot (0: t). */
const char *emit_slope(struct emitter *emitter, const struct formula *formula, const char *wanted, int slot,
                       struct emit_origin origin);

/* ---- the parts */

void emit_inertias(struct emitter *emitter); /* inertia.c */
void emit_bodies(struct emitter *emitter);   /* bodies.c */
void emit_tree(struct emitter *emitter);     /* tree.c */
void emit_solution(struct emitter *emitter); /* solve.c */
void emit_modes(struct emitter *emitter);    /* modes.c */

/* How many things can happen on the way. */
int emit_watches(const struct emitter *emitter);

/* The functions of the lists that `calls` has need of, each once (helpers.c). */
struct helper;
void emit_helpers(struct emitter *emitter, const struct helper *list, size_t count, const struct text *calls,
                  struct text *out);

/* All of it (program.c). NULL when memory is out, or with notes in `errors` (`cannot-emit`): what is missing. */
char *emit_program(const struct fbd_model *model, double until, double tolerance, fbd_errors *errors);

/* ---- admit.c */

/* Can all of it be written? Notes in `errors` (`cannot-emit`) say what cannot. */
bool emit_admits(const struct fbd_model *model, fbd_errors *errors);

#endif
