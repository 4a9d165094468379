/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/diag.h"

#include "base/block_alloc.h"
#include "base/format.h"
#include "base/utf8.h"
#include "fbd_export.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { most_notes = 200 }; /* limit for files that are no model files */

fbd_errors *fbd_errors_new(void)
{
    fbd_errors *errors = block_alloc(sizeof *errors);
    if (errors) errors->limit = most_notes;
    return errors;
}

void fbd_errors_free(fbd_errors *errors)
{
    if (!errors) return;
    arena_free(&errors->arena);
    free(errors->sorted);
    free(errors);
}

size_t fbd_errors_count(const fbd_errors *errors)
{
    return errors ? errors->count + (errors->out_of_memory ? 1 : 0)
                  : 0; /* when memory is out a separate note is made */
}

size_t fbd_errors_failed_count(const fbd_errors *errors)
{
    return errors ? errors->errors + (errors->out_of_memory ? 1 : 0) : 0;
}

static char *format_text(struct arena *arena, const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    int length = format_list(NULL, 0, format, again);
    va_end(again);
    char *text = length < 0 ? NULL : arena_array(arena, (size_t)length + 1, 1);
    if (text) format_list(text, (size_t)length + 1, format, args);
    return text;
}

/* A message on one line, with control characters of quoted text escaped. */
static const char *shown_text(struct arena *arena, const char *text)
{
    bool plain = true;
    size_t length = 0;
    for (const char *c = text; *c;) {
        struct utf8_shown shown = utf8_show(c);
        plain = plain && shown.plain;
        length += shown.length;
        c += shown.taken;
    }
    if (plain) return text;
    char *made = arena_array(arena, length + 1, 1);
    if (made) fbd_escape(text, made, length + 1);
    return made;
}

/* The fix of a note with this hint, without its place. */
static fbd_fix fix_of(const fbd_errors *errors, const char *hint)
{
    const struct diag_replacement *last = &errors->replacement;
    return hint && hint == last->hint ? (fbd_fix){.replace = last->replace, .with = last->with}
                                      : (fbd_fix){0};
}

static void add_note(fbd_errors *errors, fbd_error note, const char *format, va_list args)
{
    if (!errors) return;
    if (note.severity == FBD_ERROR) errors->errors++;
    if (errors->count >= errors->limit) return;
    struct diag_note *entry = ARENA_NEW(&errors->arena, struct diag_note);
    const char *message = entry ? format_text(&errors->arena, format, args) : NULL;
    if (message) message = shown_text(&errors->arena, message);
    const fbd_fix fix = fix_of(errors, note.hint);
    if (message && note.hint) note.hint = shown_text(&errors->arena, note.hint);
    if (!message) {
        errors->out_of_memory = true;
        return;
    }
    entry->error = note;
    entry->fix = fix;
    entry->error.message = message;
    entry->error.file = errors->file;
    if (errors->last)
        errors->last->next = entry;
    else
        errors->first = entry;
    errors->last = entry;
    errors->count++;
    free(errors->sorted);
    errors->sorted = NULL;
}

void diag_add(fbd_errors *errors, fbd_severity severity, const char *id, struct pos at, const char *hint,
              const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fbd_error note = {.severity = severity, .id = id, .hint = hint, .line = at.line, .column = at.column};
    add_note(errors, note, format, args);
    va_end(args);
}

void diag_add_within(fbd_errors *errors, const char *id, struct pos at, struct pos context, const char *hint,
                     const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fbd_error note = {.severity = FBD_ERROR,
                      .id = id,
                      .hint = hint,
                      .line = at.line,
                      .column = at.column,
                      .context_line = context.line,
                      .context_column = context.column};
    add_note(errors, note, format, args);
    va_end(args);
}

void diag_out_of_memory(fbd_errors *errors)
{
    if (errors) errors->out_of_memory = true;
}

const char *diag_hint(fbd_errors *errors, const char *format, ...)
{
    if (!errors) return NULL;
    va_list args;
    va_start(args, format);
    char *text = format_text(&errors->arena, format, args);
    va_end(args);
    return text;
}

const char *diag_replace(fbd_errors *errors, const char *wrong, const char *with, const char *format, ...)
{
    if (!errors) return NULL;
    va_list args;
    va_start(args, format);
    const char *hint = format_text(&errors->arena, format, args);
    va_end(args);
    const char *replace = arena_text(&errors->arena, wrong, strlen(wrong));
    const char *word = arena_text(&errors->arena, with, strlen(with));
    if (hint && replace && word) errors->replacement = (struct diag_replacement){hint, replace, word};
    return hint;
}

void diag_in_file(fbd_errors *errors, const char *file)
{
    if (errors->file && file && strcmp(errors->file, file) == 0) return;
    errors->file = file ? arena_text(&errors->arena, file, strlen(file)) : NULL;
    if (file && !errors->file) diag_out_of_memory(errors);
}

void diag_reads(fbd_errors *errors, const char *path)
{
    struct diag_file **end = &errors->files;
    for (; *end; end = &(*end)->next)
        if (strcmp((*end)->path, path) == 0) return;
    struct diag_file *file = ARENA_NEW(&errors->arena, struct diag_file);
    const char *copy = file ? diag_hint(errors, "%s", path) : NULL;
    if (!copy) {
        diag_out_of_memory(errors);
        return;
    }
    *file = (struct diag_file){.path = copy};
    *end = file;
}

size_t fbd_errors_file_count(const fbd_errors *errors)
{
    size_t count = 0;
    for (const struct diag_file *file = errors ? errors->files : NULL; file; file = file->next) count++;
    return count;
}

const char *fbd_errors_file(const fbd_errors *errors, size_t index)
{
    const struct diag_file *file = errors ? errors->files : NULL;
    while (file && index-- > 0) file = file->next;
    return file ? file->path : NULL;
}

fbd_errors *diag_begin(struct diag_call *call, fbd_errors *errors)
{
    *call = (struct diag_call){.own.limit = most_notes, .errors = errors};
    if (!errors) return &call->own;
    call->earlier = errors->errors;
    call->earlier_out_of_memory = errors->out_of_memory;
    call->file = errors->file;
    errors->errors = 0;
    errors->out_of_memory = false;
    errors->file = NULL;
    return errors;
}

void diag_end(struct diag_call *call)
{
    fbd_errors *errors = call->errors;
    arena_free(&call->own.arena);
    free(call->own.sorted);
    if (!errors) return;
    errors->errors += call->earlier;
    errors->out_of_memory |= call->earlier_out_of_memory;
    errors->file = call->file;
}

/* ---- the nearest name */

enum { longest_name = 48 };

static size_t smallest(size_t a, size_t b, size_t c)
{
    size_t least = a < b ? a : b;
    return least < c ? least : c;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Optimal string alignment distance without regard to case: insertions, deletions, replacements and swaps of
 * neighbours (Damerau 1964). Names longer than `longest_name` count as far away. */
static size_t distance(const char *a, const char *b)
{
    size_t n = strlen(a), m = strlen(b);
    if (n > longest_name || m > longest_name) return longest_name;
    size_t rows[3][longest_name + 1];
    size_t *before = rows[0], *last = rows[1], *now = rows[2];
    for (size_t j = 0; j <= m; j++) last[j] = before[j] = j;
    for (size_t i = 1; i <= n; i++) {
        now[0] = i;
        for (size_t j = 1; j <= m; j++) {
            bool same = lower(a[i - 1]) == lower(b[j - 1]);
            now[j] = smallest(last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1));
            bool swapped =
                i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped && before[j - 2] + 1 < now[j]) now[j] = before[j - 2] + 1;
        }
        size_t *spare = before;
        before = last;
        last = now;
        now = spare;
    }
    return last[m];
}

static bool starts_with(const char *name, const char *start)
{
    size_t length = strlen(start);
    return length >= 3 && strncmp(name, start, length) == 0;
}

const char *diag_nearest(fbd_errors *errors, const char *wrong, const char *const *names, size_t count)
{
    /* Any two single letters are at distance 1: for these only the case may differ. */
    size_t best = count, length = strlen(wrong), least = length > 1 ? 1 + length / 3 : 0;
    for (size_t i = 0; i < count; i++) {
        size_t d =
            starts_with(names[i], wrong) || starts_with(wrong, names[i]) ? 1 : distance(wrong, names[i]);
        if (d < least || (d == least && best == count)) {
            least = d;
            best = i;
        }
    }
    if (best < count) return diag_replace(errors, wrong, names[best], "did you mean `%s`?", names[best]);
    enum { most_listed = 24 };
    char list[512] = "";
    size_t used = 0;
    for (size_t i = 0; i < count && i < most_listed; i++) {
        int n = snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", names[i]);
        if (n < 0 || (size_t)n >= sizeof list - used) break;
        used += (size_t)n;
    }
    return count ? diag_hint(errors, "one of: %s%s", list, count > most_listed ? ", ..." : "") : NULL;
}

/* ---- removal of notes */

struct diag_mark diag_mark(const fbd_errors *errors)
{
    return (struct diag_mark){errors->last, errors->count, errors->errors};
}

void diag_take_back(fbd_errors *errors, struct diag_mark mark)
{
    errors->last = mark.last;
    if (mark.last)
        mark.last->next = NULL;
    else
        errors->first = NULL;
    errors->count = mark.count;
    errors->errors = mark.errors;
    free(errors->sorted);
    errors->sorted = NULL;
}

/* ---- output */

static bool stands_after(const fbd_error *a, const fbd_error *b)
{
    return a->line != b->line ? a->line > b->line : a->column > b->column;
}

static bool sort_notes(fbd_errors *errors)
{
    errors->sorted = calloc(errors->count ? errors->count : 1, sizeof *errors->sorted);
    if (!errors->sorted) return false;
    /* By insertion, which is stable (qsort is not) and fast enough for `most_notes`. */
    size_t done = 0;
    for (struct diag_note *note = errors->first; note; note = note->next) {
        size_t place = done++;
        for (; place > 0 && stands_after(&errors->sorted[place - 1]->error, &note->error); place--)
            errors->sorted[place] = errors->sorted[place - 1];
        errors->sorted[place] = note;
    }
    return true;
}

/* If memory for sorting is out, the notes are returned in the order of discovery. */
static const struct diag_note *unsorted(const fbd_errors *errors, size_t index)
{
    const struct diag_note *note = errors->first;
    while (index-- > 0) note = note->next;
    return note;
}

const struct diag_note *diag_note_at(fbd_errors *errors, size_t index)
{
    static const struct diag_note no_memory = {
        .error = {.severity = FBD_ERROR, .id = "out-of-memory", .message = "out of memory"}};
    if (!errors) return NULL;
    if (index < errors->count)
        return errors->sorted || sort_notes(errors) ? errors->sorted[index] : unsorted(errors, index);
    return errors->out_of_memory && index == errors->count ? &no_memory : NULL;
}

const fbd_error *diag_get(fbd_errors *errors, size_t index)
{
    const struct diag_note *note = diag_note_at(errors, index);
    return note ? &note->error : NULL;
}

const fbd_error *diag_first_error(fbd_errors *errors)
{
    const fbd_error *first = NULL;
    for (const struct diag_note *note = errors ? errors->first : NULL; note; note = note->next)
        if (note->error.severity == FBD_ERROR && (!first || stands_after(first, &note->error)))
            first = &note->error;
    return first || !errors ? first : diag_get(errors, errors->count);
}

fbd_error fbd_errors_get(fbd_errors *errors, size_t index)
{
    const fbd_error *error = diag_get(errors, index);
    return error ? *error : (fbd_error){0};
}

size_t fbd_escape(const char *text, char *shown, size_t room)
{
    size_t length = 0, put = 0;
    bool fits = true;
    if (!shown) room = 0;
    while (text && *text) {
        struct utf8_shown next = utf8_show(text);
        fits = fits && put + next.length < room;
        if (fits) {
            memcpy(shown + put, next.text, next.length);
            put += next.length;
        }
        length += next.length;
        text += next.taken;
    }
    if (room > 0) shown[put] = '\0';
    return length;
}

/* The stored name of a file is unchanged, so that a program can open it; for output it is escaped. */
static void print_shown(FILE *stream, const char *text)
{
    while (*text) {
        struct utf8_shown next = utf8_show(text);
        fwrite(next.text, 1, next.length, stream);
        text += next.taken;
    }
}

/* True if the guide has a section about note `index`, and about no note before it. */
static bool is_first_of_section(fbd_errors *errors, size_t index)
{
    const char *section = fbd_errors_guide(diag_get(errors, index)->id);
    for (size_t i = 0; section && i < index; i++)
        if (fbd_errors_guide(diag_get(errors, i)->id) == section) return false;
    return section != NULL;
}

void fbd_errors_print(fbd_errors *errors, FILE *stream)
{
    if (!stream) return;
    const fbd_error *e;
    if (errors && errors->out_of_memory) { /* other notes may be a consequence */
        fputs("error: out of memory [out-of-memory]\n", stream);
        return;
    }
    for (size_t i = 0; (e = diag_get(errors, i)) != NULL; i++) {
        if (e->file) print_shown(stream, e->file);
        if (e->file) fputs(":", stream);
        if (e->line) fprintf(stream, "%d:%d:", e->line, e->column);
        fprintf(stream, "%s%s: %s [%s]\n", e->file || e->line ? " " : "",
                e->severity == FBD_ERROR ? "error" : "warning", e->message, e->id);
        if (e->context_line)
            fprintf(stream, "    in the block that starts at line %d, column %d\n", e->context_line,
                    e->context_column);
        if (e->hint) fprintf(stream, "    hint: %s\n", e->hint);
        if (is_first_of_section(errors, i)) fprintf(stream, "    see: %s\n", fbd_errors_guide(e->id));
    }
    if (errors && errors->errors > errors->limit)
        fprintf(stream, "... and %zu more errors\n", errors->errors - errors->limit);
}
