/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A document as Markdown (CommonMark, with the tables of GitHub). Drawings are files beside it.
 */
#include <string.h>

#include "base/utf8.h"
#include "note/document.h"

/* A text on one line, with the characters that are marks of Markdown escaped. */
static void write_text(struct text *text, const char *content)
{
    while (*content) {
        struct utf8_shown next = utf8_show(content);
        if (strchr("\\`*_[]<>|#&$~", *content)) text_add(text, "\\");
        text_add_bytes(text, next.text, next.length);
        content += next.taken;
    }
}

/* ---- blocks */

static void write_row(struct text *text, const char *const *cells, size_t count)
{
    text_add(text, "|");
    for (size_t i = 0; i < count; i++) {
        text_add(text, " ");
        write_text(text, cells[i]);
        text_add(text, " |");
    }
    text_add(text, "\n");
}

static void write_table(struct text *text, const struct block *block)
{
    const char *const columns = block->table.columns, *cells[most_table_columns];
    const size_t count = strlen(columns);
    size_t column = 0;
    text_printf(text, "Table %zu: ", block->number);
    write_text(text, block->text);
    text_add(text, "\n\n");
    write_row(text, block->table.heads, count);
    text_add(text, "|");
    for (size_t i = 0; i < count; i++) text_add(text, columns[i] == 'r' ? " ---: |" : " --- |");
    text_add(text, "\n");
    for (const struct cell *cell = block->first; cell; cell = cell->next) {
        cells[column++] = cell->text;
        if (column < count) continue;
        write_row(text, cells, column);
        column = 0;
    }
    text_add(text, "\n");
}

static void write_list(struct text *text, const struct block *block)
{
    for (const struct cell *item = block->first; item; item = item->next) {
        text_add(text, "- ");
        write_text(text, item->text);
        text_add(text, "\n");
    }
    text_add(text, "\n");
}

/* A fence is longer than every run of its character in the text. */
static void write_verbatim(struct text *text, const char *content)
{
    size_t longest = 2;
    for (const char *at = content; (at = strchr(at, '`')) != NULL;) {
        const size_t run = strspn(at, "`");
        if (run > longest) longest = run;
        at += run;
    }
    for (size_t i = 0; i <= longest; i++) text_add(text, "`");
    text_add(text, "text\n");
    text_add(text, content);
    if (content[0] && content[strlen(content) - 1] != '\n') text_add(text, "\n");
    for (size_t i = 0; i <= longest; i++) text_add(text, "`");
    text_add(text, "\n\n");
}

static void write_picture(struct text *text, const struct block *block, const char *stem)
{
    text_add(text, "![");
    write_text(text, block->alternative);
    text_printf(text, "](<%s-%zu.svg>)\n\nFigure %zu: ", stem, block->number, block->number);
    write_text(text, block->text);
    text_add(text, "\n\n");
}

static void write_block(struct text *text, const struct block *block, const char *stem)
{
    switch (block->kind) {
    case block_heading:
        text_add(text, block->level == 2 ? "## " : "### ");
        write_text(text, block->text);
        text_add(text, "\n\n");
        break;
    case block_paragraph:
        write_text(text, block->text);
        text_add(text, "\n\n");
        break;
    case block_list: write_list(text, block); break;
    case block_table: write_table(text, block); break;
    case block_picture: write_picture(text, block, stem); break;
    case block_equations: write_verbatim(text, block->forms[FBD_NOTE_MARKDOWN]); break;
    case block_verbatim: write_verbatim(text, block->text); break;
    }
}

void write_markdown(struct text *text, const struct document *document, const char *stem)
{
    text_add(text, "# ");
    write_text(text, document->title);
    text_add(text, "\n\n");
    for (const struct block *block = document->first; block; block = block->next)
        write_block(text, block, stem);
}
