/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "claims.h"

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "fuzz.h"

void claim_in_time(clock_t since, double most)
{
    double took = (double)(clock() - since) / CLOCKS_PER_SEC;
    if (fuzz_hurries && took > most) fuzz_fail("it took %.3g s", took);
}

void claim_finite(const char *what, double value)
{
    if (!isfinite(value)) fuzz_fail("%s is %g", what, value);
}

/* ---- words */

static bool in_word(char c)
{
    return isalnum((unsigned char)c) || c == '_' || (unsigned char)c >= 0x80;
}

/* Where the first word stands that is no number, or NULL. */
static const char *find_nan(const char *text, size_t length)
{
    static const char *const words[] = {"nan", "inf", "infinity"};
    for (size_t i = 0; i < length;) {
        size_t from = i;
        while (i < length && in_word(text[i])) i++;
        for (size_t k = 0; k < sizeof words / sizeof *words; k++)
            if (i - from == strlen(words[k]) && strncasecmp(text + from, words[k], i - from) == 0)
                return text + from;
        if (i == from) i++;
    }
    return NULL;
}

bool names_nan(const char *text, size_t length)
{
    return find_nan(text, length) != NULL;
}

void claim_no_nan(const char *what, const char *text)
{
    const char *found = find_nan(text, strlen(text));
    if (!found) return;
    const char *from = found;
    while (from > text && from[-1] != '\n' && found - from < 100) from--;
    fuzz_fail("%s is not finite: %.200s", what, from);
}

/* ---- characters */

/* The code point at *at, which is moved behind it; UINT32_MAX when there is none. */
static uint32_t next_character(const char **at)
{
    const unsigned char *bytes = (const unsigned char *)*at;
    int more = bytes[0] < 0x80 ? 0 : bytes[0] >= 0xC2 && bytes[0] < 0xE0 ? 1 : bytes[0] < 0xF0 ? 2 : 3;
    if ((bytes[0] >= 0x80 && bytes[0] < 0xC2) || bytes[0] > 0xF4) return UINT32_MAX;
    uint32_t code = more == 0 ? bytes[0] : bytes[0] & (0x3Fu >> more);
    for (int i = 1; i <= more; i++) {
        if ((bytes[i] & 0xC0) != 0x80) return UINT32_MAX;
        code = code << 6 | (bytes[i] & 0x3Fu);
    }
    static const uint32_t least[] = {0, 0x80, 0x800, 0x10000};
    *at += more + 1;
    return code < least[more] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000) ? UINT32_MAX : code;
}

static bool acts_on_a_terminal(uint32_t code)
{
    bool control = (code < 0x20 && code != '\n' && code != '\t') || (code >= 0x7F && code < 0xA0);
    bool direction = code == 0x200E || code == 0x200F || code == 0x061C ||
                     (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
    return control || direction || code == UINT32_MAX;
}

void claim_plain(const char *what, const char *text)
{
    for (const char *at = text, *before = text; *at; before = at) {
        uint32_t code = next_character(&at);
        if (acts_on_a_terminal(code))
            fuzz_fail("%s has the character %#x raw, at byte %td of %.200s", what, (unsigned)code,
                      before - text, text);
    }
}

void claim_notes(fbd_errors *errors)
{
    char *text = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&text, &length);
    if (!stream) return;
    fbd_errors_print(errors, stream);
    fclose(stream);
    claim_plain("the notes", text);
    free(text);
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const fbd_error note = fbd_errors_get(errors, i);
        if (!note.id[0] || !note.message[0] || strchr(note.message, '\n'))
            fuzz_fail("a note `%s` that is not one line: `%s`", note.id, note.message);
    }
}

/* ---- tables */

static bool is_finite_number(const char *cell, size_t length)
{
    char *end;
    return isfinite(strtod(cell, &end)) && end == cell + length;
}

/* The row that is counted and read in one go: tables are most of what is written. `cell` and `name` go on together. */
static void claim_row(const char *what, const char *header, const char *line)
{
    const char *cell = line, *name = header;
    for (size_t i = 0;; i++) {
        size_t length = strcspn(cell, ",\n"), width = strcspn(name, ",\n");
        if (length == 0 ? !memmem(name, width, "±", strlen("±")) : !is_finite_number(cell, length))
            fuzz_fail("%s: column %zu is no finite number: %.300s%.300s", what, i, header, line);
        if (cell[length] != name[width]) fuzz_fail("%s: another number of columns: %.300s", what, line);
        if (cell[length] == '\n') return;
        cell += length + 1;
        name += width + 1;
    }
}

static void claim_names(const char *what, const char *header)
{
    for (const char *a = header; *a != '\n';) {
        size_t length = strcspn(a, ",\n");
        for (const char *b = a + length; *b == ',';) {
            size_t other = strcspn(++b, ",\n");
            if (other == length && memcmp(a, b, length) == 0)
                fuzz_fail("%s has two columns `%.*s`", what, (int)length, a);
            b += other;
        }
        a += length + (a[length] == ',');
    }
}

void claim_table(const char *what, const char *text)
{
    const char *end = strchr(text, '\n');
    if (!end) fuzz_fail("%s has no header: %.200s", what, text);
    claim_names(what, text);
    for (const char *line = end + 1; *line; line = end + 1) {
        end = strchr(line, '\n');
        if (!end) fuzz_fail("%s ends within a row: %.200s", what, line);
        claim_row(what, text, line);
    }
}
