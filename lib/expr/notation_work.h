/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The parts of reading a notation: signs and commands to items (notation_items.c), symbols (notation_run.c), which
 * names they are (notation_names.c), and items to text (notation_write.c).
 */
#ifndef FBD_EXPR_NOTATION_WORK_H
#define FBD_EXPR_NOTATION_WORK_H

#include "base/text.h"
#include "expr/notation.h"

enum item_kind {
    item_end,
    item_number, /* with its unit; or a side that is a quantity */
    item_name,
    item_function, /* its argument may stand without brackets */
    item_call,     /* a function or table whose brackets follow, or what is not known */
    item_sign,     /* + - * / */
    item_power,
    item_break, /* relations, `,`, and, or, not: what stands around is apart */
    item_open,
    item_close,
    item_fraction, /* two groups follow */
    item_bar,      /* of a magnitude */
    item_other,    /* left to the parser of expressions */
};

struct item {
    enum item_kind kind;
    size_t start, length; /* bytes of the source */
    const char *text;     /* NULL: as in the source */
    bool gap;             /* a blank stands before it */
    bool verbatim;        /* that gap is blanks of the source and nothing else */
    bool brace;           /* of item_open and item_close */
    bool magnitude;       /* of item_open: the bar of \left| */
    bool closed;          /* of a number: an exponent that ends by itself, as a superscript */
};

/* One letter, digit or `_` of a symbol, a Greek letter being one. */
struct atom {
    const char *text; /* as the language spells it */
    size_t length;
    size_t start, end; /* bytes of the source */
    int marks;         /* dots or primes */
    bool greek;
};

/* Letters without a blank between them: one name, or several. */
enum { most_atoms = 64 };

struct run {
    struct atom atoms[most_atoms];
    size_t count;
    bool failed; /* longer than that */
};

struct writing {
    struct arena *arena;
    const char *text;
    size_t length, offset;
    size_t start; /* behind a heading */
    struct pos at;
    const struct scope *scope;
    fbd_errors *errors;
    bool equation, latex;
    bool products; /* a side such as `2 m g` is a product, and no quantity */
    bool doubtful; /* there is such a side */
    bool failed;   /* a note was given */
    struct item *items;
    size_t count, room;
    size_t sense_end;  /* the bracket that ends a sense of names (scope.sense); 0: none */
    bool gap, foreign; /* before the next item: a blank; something that is no blank and is left out */
    size_t gap_start;
};

/* Note an error at byte `offset` of the source and give up; false. */
bool writing_refuse(struct writing *w, const char *id, size_t offset, const char *hint, const char *message);

/* Two readings of what stands at `offset`; false. */
bool writing_ambiguous(struct writing *w, size_t offset, const char *first, const char *second);

/* Add an item of the source's bytes from `start` to `end`; `text` as in struct item. NULL when memory is out. */
struct item *writing_add(struct writing *w, enum item_kind kind, size_t start, size_t end, const char *text);

/* ---- notation_items.c */

/* All items, with an item_end behind them; false when one is refused. */
bool writing_read_items(struct writing *w);

/* Can this be the first of an operand? */
bool item_begins_operand(const struct item *item);

/* Is it a bracket with a number or name and nothing else in it? */
bool item_is_single(const struct item *open);

/* Behind the bracket that closes the one at `item`, or the end; behind the exponent of `^`. */
const struct item *item_behind_group(const struct item *item);
const struct item *item_behind_power(const struct item *power);

/* Does `word` stand at `offset`? */
bool writing_has(const struct writing *w, size_t offset, const char *word);

/* Behind blanks at `offset`, and behind spacing of LaTeX. */
size_t writing_skip(const struct writing *w, size_t offset);

/* ---- notation_run.c */

/* The length of the LaTeX command at `offset`, with its backslash; 0 for none. */
size_t command_length(const struct writing *w, size_t offset);

/* Is it one of these: a zero-terminated word without the backslash? */
bool command_is(const struct writing *w, size_t offset, const char *word);

/* Does a symbol begin at `offset`? */
bool run_begins(const struct writing *w, size_t offset);

/* Read one; returns the byte behind it. */
size_t run_read(const struct writing *w, size_t offset, struct run *run);

/* `dv/dt`, `d^2x/dt^2` or the same in a \frac at `offset`: the symbol with its marks, and the byte behind it; 0 when
 * it is something else. */
size_t derivative_read(const struct writing *w, size_t offset, struct run *run);

/* ---- notation_names.c */

/* Is there such a name? *dim is its dimension; none for one that takes any. */
bool name_is_known(const struct writing *w, const char *name, struct dim *dim);

/* Add the names that a symbol is made of. */
bool run_add(struct writing *w, const struct run *run, size_t end);

/* A number and a name behind it: is the name a unit as well, of the same dimension? */
bool name_is_unit(const struct writing *w, const struct item *name);

/* ---- notation_write.c */

/* The text, in the arena of the writing, and where it comes from; NULL when it is refused or memory is out. */
const char *writing_make(struct writing *w, const struct notation_stretch **stretches);

#endif
