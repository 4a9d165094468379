/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The parts of reading a notation: signs and commands to items (notation_items.c), symbols (notation_run.c),
 * their names (notation_names.c), and items to text (notation_write.c).
 */
#ifndef FBD_EXPR_NOTATION_WORK_H
#define FBD_EXPR_NOTATION_WORK_H

#include "base/text.h"
#include "expr/notation.h"

enum item_kind {
    item_end,
    item_number, /* with its unit; or a side that is a quantity */
    item_name,
    item_function, /* its argument may be without brackets */
    item_call,     /* a function or table followed by brackets, or an unknown name */
    item_sign,     /* + - * / */
    item_power,
    item_break, /* relations, `,`, and, or, not: they separate products */
    item_open,
    item_close,
    item_fraction, /* two groups follow */
    item_bar,      /* of a magnitude */
    item_other,    /* left to the parser of expressions */
};

struct item {
    enum item_kind kind;
    size_t start, length; /* bytes in the source */
    const char *text;     /* NULL: as in the source */
    bool gap;             /* preceded by a blank */
    bool verbatim;        /* the gap consists of blanks of the source only */
    bool brace;           /* of item_open and item_close: in the source it is a brace */
    bool magnitude;       /* of item_open: the bar of \left| */
    bool closed;          /* of a number: an exponent that needs no end, as a superscript */
};

/* One letter, digit or `_` of a symbol; a Greek letter is one. */
struct atom {
    const char *text; /* spelled as in the language */
    size_t length;
    size_t start, end; /* bytes of the source */
    int marks;         /* dots or primes */
    bool greek;
};

/* Letters without a blank between them: one name or several. */
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
    bool products; /* read a side such as `2 m g` as a product, not as a quantity */
    bool doubtful; /* there is such a side */
    bool failed;   /* a note was given */
    struct item *items;
    size_t count, room;
    size_t sense_end;  /* the bracket that ends a sense of names (scope.sense); 0: none */
    bool gap, foreign; /* before the next item: a blank; removed text other than blanks */
};

/* Note an error at byte `offset` of the source and stop; returns false. */
bool writing_refuse(struct writing *w, const char *id, size_t offset, const char *hint, const char *message);

/* Note two readings of the text at `offset`; returns false. */
bool writing_ambiguous(struct writing *w, size_t offset, const char *first, const char *second);

/* Add an item for the source bytes from `start` to `end`; `text` as in struct item. NULL when memory is out. */
struct item *writing_add(struct writing *w, enum item_kind kind, size_t start, size_t end, const char *text);

/* ---- notation_items.c */

/* Read all items, followed by an item_end; false when one is refused. */
bool writing_read_items(struct writing *w);

/* True if the item can begin an operand. */
bool item_begins_operand(const struct item *item);

/* True for a bracket that contains a single number or name. */
bool item_is_single(const struct item *open);

/* The item behind the exponent of `^`. */
const struct item *item_behind_power(const struct item *power);

/* True if `word` is at `offset`. */
bool writing_has(const struct writing *w, size_t offset, const char *word);

/* Skip blanks and spacing commands of LaTeX at `offset`. */
size_t writing_skip(const struct writing *w, size_t offset);

/* ---- notation_run.c */

/* The length of the LaTeX command at `offset`, with its backslash; 0 for none. */
size_t command_length(const struct writing *w, size_t offset);

/* True if the command at `offset` is `word`, given without the backslash. */
bool command_is(const struct writing *w, size_t offset, const char *word);

/* True if a symbol begins at `offset`. */
bool run_begins(const struct writing *w, size_t offset);

/* Read a symbol; returns the byte behind it. */
size_t run_read(const struct writing *w, size_t offset, struct run *run);

/* Read `dv/dt`, `d^2x/dt^2` or the same in a \frac at `offset` as a symbol with marks; returns the byte
 * behind it, or 0 if it is no derivative. */
size_t derivative_read(const struct writing *w, size_t offset, struct run *run);

/* ---- notation_names.c */

/* True if the name exists; *dim is its dimension, none if it takes any. */
bool name_is_known(const struct writing *w, const char *name, struct dim *dim);

/* Add the names that a symbol consists of. */
bool run_add(struct writing *w, const struct run *run, size_t end);

/* True if the name behind a number is also a unit, of the same dimension. */
bool name_is_unit(const struct writing *w, const struct item *name);

/* ---- notation_write.c */

/* The converted text, in the arena of the writing, and its source; NULL if refused or memory is out. */
const char *writing_make(struct writing *w, const struct notation_stretch **stretches);

#endif
