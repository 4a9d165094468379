/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/written.h"

#include <string.h>

#include "expr/glyph.h"

/* The number of characters of text[0..length). */
static size_t characters(const char *text, size_t length)
{
    return (size_t)glyph_pos(text, length, (struct pos){1, 0}).column;
}

/* The byte at which character `count` of the text begins. */
static size_t byte_of(const char *text, size_t count)
{
    size_t length = strlen(text), byte = 0;
    for (; count > 0 && byte < length; count--) byte += glyph_size(text + byte, length - byte);
    return byte;
}

void written_places(struct reader *reader, const struct node *node, const struct notation *notation,
                    struct diag_note *last)
{
    for (struct diag_note *note = last ? last->next : reader->errors->first; note; note = note->next) {
        int offset = note->error.column - node->text_at.column;
        if (note->error.line != node->text_at.line || offset < 0) continue;
        size_t source = notation_source(notation, byte_of(notation->text, (size_t)offset));
        struct pos at = node_place(node, characters(node->text, source));
        note->error.line = at.line;
        note->error.column = at.column;
    }
}

/* The names of the scope, and those of the hand_reader. */
struct names_and_more {
    const struct scope *scope;
    const struct hand_reader *reader;
    const char *body;
};

static struct symbol look_up(void *context, const char *name, struct pos at)
{
    const struct names_and_more *more = context;
    const struct symbol symbol = more->scope->lookup(more->scope->context, name, at);
    if (symbol.kind != symbol_unknown || !more->reader->is_known(more->reader->context, more->body, name))
        return symbol;
    return (struct symbol){.kind = symbol_failed, .dim = DIM_INIT(1, 1, -2)};
}

static struct table_symbol look_up_table(void *context, const char *name, struct pos at)
{
    const struct names_and_more *more = context;
    return more->scope->table(more->scope->context, name, at);
}

static bool enter_sense(void *context, const char *word)
{
    const struct names_and_more *more = context;
    return more->scope->sense(more->scope->context, word);
}

static struct symbol look_up_at(void *context, const char *name, double x, struct pos at)
{
    const struct names_and_more *more = context;
    return more->scope->at_length(more->scope->context, name, x, at);
}

static bool read_with_more(struct reader *reader, const struct node *node, const struct scope *scope,
                           bool equation, fbd_errors *errors, struct notation *notation)
{
    const struct names *names = scope->context;
    struct names_and_more more = {scope, reader->hand_reader, reader->scene->bodies[names->body].name};
    const struct scope wider = {.lookup = look_up,
                                .table = look_up_table,
                                .sense = enter_sense,
                                .at_length = look_up_at,
                                .context = &more,
                                .units = scope->units};
    if (!notation_read(reader->exprs, node->text, node->text_at, &wider, equation, errors, notation))
        return false;
    more.reader->take(more.reader->context, node, notation->text);
    return true;
}

/* Read the notation without notes and without side effects on the reader: the lookups only test whether a
 * text is a name. */
static bool read_silently(struct reader *reader, const struct node *node, const struct scope *scope,
                          bool equation, struct notation *notation)
{
    fbd_errors *errors = reader->errors, *silent = fbd_errors_new();
    const size_t absolutes = reader->scene->absolute_count;
    const bool varies = reader->varies, names_varying = reader->names_varying, input = reader->names_input;
    bool fine = false;
    if (silent) {
        reader->errors = silent;
        fine = reader->hand_reader ? read_with_more(reader, node, scope, equation, errors, notation)
                                   : notation_read(reader->exprs, node->text, node->text_at, scope, equation,
                                                   errors, notation);
    }
    if (!silent || silent->out_of_memory || silent->arena.failed) diag_out_of_memory(errors);
    reader->errors = errors;
    reader->scene->absolute_count = absolutes;
    reader->varies = varies;
    reader->names_varying = names_varying;
    reader->names_input = input;
    fbd_errors_free(silent);
    return fine;
}

const struct node *written_node(struct reader *reader, const struct node *node, const struct scope *scope,
                                bool equation, struct notation *notation)
{
    const struct diag_mark mark = diag_mark(reader->errors);
    struct diag_note *last = reader->errors->last;
    if (node->kind != node_scalar) {
        *notation = (struct notation){.text = node->text};
        return node;
    }
    bool fine = read_silently(reader, node, scope, equation, notation);
    if (reader->scene->hands_left &&
        !reader->errors->out_of_memory) { /* read again when all names are known */
        diag_take_back(reader->errors, mark);
        return NULL;
    }
    if (!fine) {
        const struct notation as_it_is = {.text = node->text};
        if (reader->errors->last == last) diag_out_of_memory(reader->errors);
        written_places(reader, node, &as_it_is, last);
        return NULL;
    }
    if (!notation->changed) return node;
    struct node *made = ARENA_NEW(reader->exprs, struct node);
    if (!made) return NULL;
    *made = *node;
    made->at = (struct pos){0}; /* not in the file: programs of earlier readings are not used for it */
    made->text = notation->text;
    made->length = strlen(notation->text);
    made->many_lines = false;
    return made;
}
