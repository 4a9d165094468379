/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "note/document.h"

#include <stdarg.h>
#include <string.h>

#include "base/format.h"

static struct block *add(struct document *document, enum block_kind kind)
{
    struct block *block = ARENA_NEW(&document->arena, struct block);
    if (!block) return &document->lost;
    block->kind = kind;
    if (document->last)
        document->last->next = block;
    else
        document->first = block;
    document->last = block;
    return block;
}

static const char *copy(struct document *document, const char *text)
{
    return text ? arena_text(&document->arena, text, strlen(text)) : "";
}

const char *document_take(struct document *document, char *text)
{
    const char *kept = text ? copy(document, text) : NULL;
    if (!text) document->arena.failed = true;
    fbd_free(text);
    return kept;
}

/* printf into the arena, of any length. */
static const char *list_printf(struct document *document, const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    const int length = format_list(NULL, 0, format, args);
    char *text = length < 0 ? NULL : ARENA_ARRAY(&document->arena, (size_t)length + 1, char);
    if (text) format_list(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

void document_heading(struct document *document, int level, const char *text)
{
    struct block *block = add(document, block_heading);
    block->level = level;
    block->text = copy(document, text);
}

void document_paragraph(struct document *document, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    add(document, block_paragraph)->text = list_printf(document, format, args);
    va_end(args);
}

void document_verbatim(struct document *document, const char *text, size_t length)
{
    add(document, block_verbatim)->text = arena_text(&document->arena, text, length);
}

void document_picture(struct document *document, char *svg, const char *caption, const char *alternative)
{
    struct block *block = add(document, block_picture);
    block->svg = document_take(document, svg);
    block->text = copy(document, caption);
    block->alternative = copy(document, alternative);
    block->number = ++document->pictures;
}

void document_equations(struct document *document, char *forms[static note_formats])
{
    struct block *block = add(document, block_equations);
    for (int i = 0; i < note_formats; i++) block->forms[i] = document_take(document, forms[i]);
}

struct block *document_list(struct document *document)
{
    return add(document, block_list);
}

struct block *document_table(struct document *document, const char *caption, const char *columns,
                             const char *const *heads)
{
    struct block *block = add(document, block_table);
    block->text = copy(document, caption);
    block->table.columns = copy(document, columns);
    for (size_t i = 0; columns[i]; i++) block->table.heads[i] = copy(document, heads[i]);
    block->number = ++document->tables;
    return block;
}

static void append(struct document *document, struct block *block, const char *text)
{
    struct cell *cell = ARENA_NEW(&document->arena, struct cell);
    if (!cell) return;
    cell->text = text;
    if (block->last)
        block->last->next = cell;
    else
        block->first = cell;
    block->last = cell;
}

void document_cell(struct document *document, struct block *block, const char *text)
{
    append(document, block, copy(document, text));
}

void document_cell_format(struct document *document, struct block *block, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    append(document, block, list_printf(document, format, args));
    va_end(args);
}
