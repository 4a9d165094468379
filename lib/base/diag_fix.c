/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fixes: the places in a text of the words that hints replace.
 */
#include "base/diag.h"
#include "base/utf8.h"

#include <string.h>

struct rest {
    const char *text;
    size_t length;
};

/* The text behind the start of a line (from 1), without a byte order mark. */
static struct rest from_line(const char *text, size_t length, int line)
{
    struct rest rest = {text, length};
    if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) rest = (struct rest){text + 3, length - 3};
    while (line > 1 && rest.length > 0) {
        const bool pair = rest.length > 1 && rest.text[0] == '\r' && rest.text[1] == '\n';
        if (!pair && (*rest.text == '\n' || *rest.text == '\r')) line--;
        rest = (struct rest){rest.text + 1, rest.length - 1};
    }
    return rest;
}

static struct rest from_column(struct rest rest, int column)
{
    unsigned code;
    for (size_t width; column > 1 && rest.length > 0; column--) {
        width = utf8_decode(rest.text, rest.length, &code);
        if (width == 0) return (struct rest){rest.text, 0};
        rest = (struct rest){rest.text + width, rest.length - width};
    }
    return rest;
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           (unsigned char)c >= 0x80;
}

/* True if the text begins with `word`, and no longer word. */
static bool begins(struct rest rest, const char *word)
{
    const size_t length = strlen(word);
    if (length == 0 || rest.length < length || memcmp(rest.text, word, length) != 0) return false;
    return rest.length == length || !is_letter(word[length - 1]) || !is_letter(rest.text[length]);
}

static void place(struct diag_note *note, const char *text, size_t length)
{
    int column = note->error.column;
    struct rest rest = from_column(from_line(text, length, note->error.line), column);
    for (; rest.length > 0 && !begins(rest, note->fix.replace) && strchr("\"'-+ ", *rest.text); column++)
        rest = (struct rest){rest.text + 1, rest.length - 1};
    if (rest.length > 0 && begins(rest, note->fix.replace)) {
        note->fix.line = note->error.line;
        note->fix.column = column;
    }
}

static bool same_file(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

void diag_place_fixes(fbd_errors *errors, const char *file, const char *text, size_t length)
{
    for (struct diag_note *note = errors->first; note; note = note->next) {
        if (!note->fix.replace || note->fix.line > 0) continue;
        if (note->error.line > 0 && same_file(note->error.file, file)) place(note, text, length);
        if (note->fix.line == 0) note->fix = (fbd_fix){0};
    }
}

fbd_fix fbd_errors_fix(fbd_errors *errors, size_t index)
{
    const struct diag_note *note = diag_note_at(errors, index);
    return note && note->fix.line > 0 ? note->fix : (fbd_fix){0};
}
