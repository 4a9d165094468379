/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A document as a list of blocks: headings, paragraphs, lists, tables, pictures, equations, and texts as they are. It is
 * built once; html.c, markdown.c and latex.c write it. Texts are UTF-8 without markup.
 */
#ifndef FBD_NOTE_DOCUMENT_H
#define FBD_NOTE_DOCUMENT_H

#include "base/arena.h"
#include "base/text.h"
#include "fbd_export.h"

enum block_kind {
    block_heading,
    block_paragraph,
    block_list,
    block_table,
    block_picture,
    block_equations, /* differ by format */
    block_verbatim,  /* lines as they are */
};

enum { most_table_columns = 8, note_formats = FBD_NOTE_LATEX + 1 };

/* A cell of a table, or an item of a list. */
struct cell {
    const char *text;
    struct cell *next;
};

struct table {
    const char *columns; /* of each column: l text, r numbers, w text that may take several lines */
    const char *heads[most_table_columns];
    bool marked; /* the last column has verdicts */
};

struct block {
    enum block_kind kind;
    int level;               /* of a heading: 2, 3 */
    const char *text;        /* of a heading, paragraph or verbatim; the caption of a table or picture */
    const char *alternative; /* the text that stands for a picture */
    const char *svg;         /* of a picture */
    size_t number;           /* of a picture or table, from 1 */
    const char *forms[note_formats]; /* of equations */
    struct table table;
    struct cell *first, *last; /* of a list or, row by row, of a table */
    struct block *next;
};

struct document {
    struct arena arena; /* `failed`: memory is out */
    const char *title;
    struct block *first, *last;
    size_t pictures, tables;
    struct block lost; /* takes the place of a block without memory; never written */
};

void document_heading(struct document *document, int level, const char *text);
void document_paragraph(struct document *document, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void document_verbatim(struct document *document, const char *text, size_t length);
void document_picture(struct document *document, char *svg, const char *caption, const char *alternative);

/* The same equations in each format, to be freed by the document. */
void document_equations(struct document *document, char *forms[static note_formats]);

/* Begin a list; items follow. */
struct block *document_list(struct document *document);

/* Begin a table with as many heads as `columns` has letters; cells follow row by row. */
struct block *document_table(struct document *document, const char *caption, const char *columns,
                             const char *const *heads);

/* Append an item or a cell, copied; NULL is an empty one. */
void document_cell(struct document *document, struct block *block, const char *text);
void document_cell_format(struct document *document, struct block *block, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* A copy of a text, which is freed. */
const char *document_take(struct document *document, char *text);

/* The writers. Pictures that stand beside the document are called STEM-1.svg, in LaTeX STEM-1.pdf. */
void write_html(struct text *text, const struct document *document);
void write_markdown(struct text *text, const struct document *document, const char *stem);
void write_latex(struct text *text, const struct document *document, const char *stem);

#endif
