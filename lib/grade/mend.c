/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Repair a text that is not valid YAML by removing the entries at which reading fails.
 *
 * A misplaced bracket makes a whole file unreadable, where a human reader would ignore one force. So the
 * entry at which the reader stops is blanked, or the one before it, whichever lets it read further, since an
 * error is often detected only after its cause. An entry is an item, on lines of its own, of a list of
 * forces, moments or derivations; or else all of such a list, if it is on the line of its key.
 */
#include <limits.h>
#include <string.h>

#include "fbd_grade.h"
#include "grade/grade.h"

/* Lines from..to of the text, the last one not included; counted from 1. */
struct entry {
    int from, to;
    int key; /* the line of `forces:` or a similar key */
};

/* A text and the starts of its lines. */
struct page {
    char *text;
    size_t length;
    char **lines;
    int count;
};

/* ---- lines */

/* Limits the time, as the search for an entry may be quadratic in the number of lines. */
enum { most_lines = 2000 };

static bool open_page(struct arena *arena, char *text, size_t length, struct page *page)
{
    *page = (struct page){.text = text, .length = length};
    page->lines = ARENA_ARRAY(arena, most_lines, char *);
    for (char *at = text; page->lines && *at && page->count < most_lines;) {
        page->lines[page->count++] = at;
        at += strcspn(at, "\n");
        at += *at == '\n';
    }
    return page->lines && page->count < most_lines && strlen(text) == length;
}

/* NULL beyond the end. */
static char *line_of(const struct page *page, int line)
{
    return line > 0 && line <= page->count ? page->lines[line - 1] : NULL;
}

static size_t indent_of(const char *line)
{
    return strspn(line, " ");
}

static bool is_blank(const char *line)
{
    line += strspn(line, " \t\r");
    return *line == '\n' || *line == '\0' || *line == '#';
}

/* The text after the key of a graded list, if the line begins with one. */
static const char *behind_key(const char *line)
{
    static const char *const keys[] = {"forces:", "moments:", "hand:"};
    line += indent_of(line);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strncmp(line, keys[i], strlen(keys[i])) == 0) return line + strlen(keys[i]);
    return NULL;
}

static bool is_item(const char *line)
{
    line += indent_of(line);
    return line[0] == '-' && (line[1] == ' ' || line[1] == '\n');
}

/* The enclosing line, which has a smaller indentation; 0 if there is none. Items may have the indentation of
 * their key. */
static int line_around(const struct page *page, int line)
{
    const char *inner = line_of(page, line);
    for (int around = line - 1; around > 0; around--) {
        const char *outer = line_of(page, around);
        bool key = is_item(inner) && !is_item(outer) && indent_of(outer) == indent_of(inner);
        if (!is_blank(outer) && (indent_of(outer) < indent_of(inner) || key)) return around;
    }
    return 0;
}

static int line_after(const struct page *page, int line)
{
    size_t indent = indent_of(line_of(page, line));
    const char *next;
    do next = line_of(page, ++line);
    while (next && (is_blank(next) || indent_of(next) > indent));
    return line;
}

/* ---- entries */

static bool starts_entry(const struct page *page, int line, struct entry *entry)
{
    const char *start = line_of(page, line), *behind = start ? behind_key(start) : NULL;
    if (!start || is_blank(start)) return false;
    *entry = (struct entry){.from = line, .to = line_after(page, line), .key = line};
    if (behind) return !is_blank(behind);
    if (!is_item(start)) return false;
    entry->key = line_around(page, line);
    behind = entry->key ? behind_key(line_of(page, entry->key)) : NULL;
    return behind && is_blank(behind);
}

/* The last entry that starts at this line or above. */
static bool find_entry(const struct page *page, int line, struct entry *entry)
{
    for (; line > 0; line--)
        if (starts_entry(page, line, entry)) return true;
    return false;
}

/* Blank an entry in the text, or in a copy of it. */
static void blank(const struct page *page, const struct entry *entry, char *text)
{
    const char *end = line_of(page, entry->to);
    size_t last = end ? (size_t)(end - page->text) : page->length;
    for (size_t i = (size_t)(line_of(page, entry->from) - page->text); i < last; i++)
        if (text[i] != '\n') text[i] = ' ';
}

/* ---- faults */

/* The position at which reading stops: `line` is INT_MAX if it does not. The errors belong to the caller. */
static struct pos find_fault(struct fbd_grade *grade, const char *text, size_t length, fbd_errors *errors)
{
    struct arena arena = {0};
    diag_in_file(errors, grade->file);
    bool open = node_open(&arena, text, length, errors) != NULL;
    const fbd_error *error = first_error(errors);
    arena_free(&arena);
    if (errors->out_of_memory) grade->arena.failed = true;
    if (open && !error) return (struct pos){INT_MAX, 0};
    return error ? (struct pos){error->line, error->column} : (struct pos){0, 0};
}

static bool is_further(struct pos a, struct pos b)
{
    return a.line > b.line || (a.line == b.line && a.column > b.column);
}

static struct pos fault_without(struct fbd_grade *grade, const struct page *page, const struct entry *entry)
{
    struct pos fault = {0, 0};
    fbd_errors *errors = fbd_errors_new();
    char *copy = arena_text(&grade->arena, page->text, page->length);
    if (copy) blank(page, entry, copy);
    if (copy && errors) fault = find_fault(grade, copy, page->length, errors);
    if (!errors) grade->arena.failed = true;
    fbd_errors_free(errors);
    return fault;
}

/* True if this line may belong to a malformed entry: an item, perhaps indented by a tab, or a line without a
 * key. */
static bool is_stray(const char *line)
{
    line += strspn(line, " \t");
    return *line == '-' || !memchr(line, ':', strcspn(line, "\r\n"));
}

/* Choose the entry to remove: that of the error, the one before, or the line alone; false if none helps. */
static bool choose(struct fbd_grade *grade, const struct page *page, struct pos fault, struct entry *chosen)
{
    struct entry tried[3];
    int count = find_entry(page, fault.line, &tried[0]);
    if (count > 0) count += find_entry(page, tried[0].from - 1, &tried[1]);
    const char *line = line_of(page, fault.line);
    if (count > 0 && line && is_stray(line))
        tried[count++] = (struct entry){fault.line, fault.line + 1, tried[0].key};
    bool found = false;
    for (int k = 0; k < count; k++) {
        struct pos next = fault_without(grade, page, &tried[k]);
        if (!is_further(next, fault)) continue;
        *chosen = tried[k];
        fault = next;
        found = true;
    }
    return found;
}

/* The finding refers to the line where the entry begins. */
static void note(struct fbd_grade *grade, const struct page *page, const struct entry *entry,
                 const fbd_error *error)
{
    int around = line_around(page, entry->key);
    const char *body = around ? line_of(page, around) : "", *line = line_of(page, entry->from);
    body += indent_of(body);
    line += strspn(line, " \t-");
    const char *body_name = arena_text(&grade->arena, body, strcspn(body, ":\r\n"));
    const char *name = arena_text(&grade->arena, line, strcspn(line, "\r\n"));
    fbd_error there = *error;
    there.line = entry->from;
    there.column = (int)(line - line_of(page, entry->from)) + 1;
    if (body_name && name) finding_of_error(grade, FBD_FINDING_UNREADABLE, body_name, name, &there);
}

/* Blank one entry; false if there is no error, or no removal helps. */
static bool mend_one(struct fbd_grade *grade, const struct page *page)
{
    struct entry entry;
    fbd_errors *errors = fbd_errors_new();
    if (!errors) grade->arena.failed = true;
    struct pos fault = {INT_MAX, 0};
    if (errors) fault = find_fault(grade, page->text, page->length, errors);
    bool found = fault.line < INT_MAX && choose(grade, page, fault, &entry);
    if (found) {
        note(grade, page, &entry, first_error(errors));
        blank(page, &entry, page->text);
    }
    fbd_errors_free(errors);
    return found && !grade->arena.failed;
}

void answer_mend(struct fbd_grade *grade, char *text, size_t length)
{
    enum { most = 20 }; /* each reads the text three times */
    struct page page;
    if (!open_page(&grade->arena, text, length, &page)) return;
    int left = most;
    while (left > 0 && mend_one(grade, &page)) left--;
}
