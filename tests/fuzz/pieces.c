/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pieces.h"

#include <ctype.h>
#include <string.h>

size_t random_below(struct random_numbers *random, size_t count)
{
    return count ? (size_t)(random_bits(random) % count) : 0;
}

bool draft_replace(struct draft *draft, struct piece piece, const char *bytes, size_t length)
{
    if (draft->length - piece.length + length > draft->room) return false;
    char *at = draft->data + piece.start;
    memmove(at + length, at + piece.length, draft->length - piece.start - piece.length);
    memcpy(at, bytes, length);
    draft->length = draft->length - piece.length + length;
    return true;
}

/* ---- where pieces end; each returns the length of the piece that starts at `at`, 0 when none does */

static bool is_name(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

static size_t line_at(const struct draft *text, size_t at)
{
    if (at > 0 && text->data[at - 1] != '\n') return 0;
    const char *end = memchr(text->data + at, '\n', text->length - at);
    return end ? (size_t)(end + 1 - (text->data + at)) : text->length - at;
}

size_t indentation(const struct draft *text, size_t at, bool dashes)
{
    size_t end = at;
    while (end < text->length && (text->data[end] == ' ' || (dashes && text->data[end] == '-'))) end++;
    return end - at;
}

static size_t block_at(const struct draft *text, size_t at)
{
    size_t length = line_at(text, at);
    if (length == 0) return 0;
    size_t own = indentation(text, at, false);
    while (at + length < text->length && text->data[at + length] != '\n' &&
           indentation(text, at + length, false) > own)
        length += line_at(text, at + length);
    return length;
}

/* Up to one of `ends` outside of brackets, of a text that begins behind an opening one. */
static size_t up_to(const struct draft *text, size_t at, const char *ends)
{
    int depth = 0;
    size_t end = at;
    for (; end < text->length; end++) {
        char c = text->data[end];
        if (depth == 0 && c && strchr(ends, c)) break;
        if (c == '{' || c == '[') depth++;
        if (c == '}' || c == ']') depth--;
    }
    return end - at;
}

static size_t flow_at(const struct draft *text, size_t at)
{
    if (text->data[at] != '{' && text->data[at] != '[') return 0;
    size_t inner = up_to(text, at + 1, "}]");
    return at + 1 + inner < text->length ? inner + 2 : 0;
}

static size_t entry_at(const struct draft *text, size_t at)
{
    return at > 0 && strchr("{[,", text->data[at - 1]) && text->data[at - 1] ? up_to(text, at, ",}]\n") : 0;
}

static size_t value_at(const struct draft *text, size_t at)
{
    return at > 1 && text->data[at - 1] == ' ' && text->data[at - 2] == ':' ? up_to(text, at, ",}]\n") : 0;
}

static size_t word_at(const struct draft *text, size_t at)
{
    size_t end = at;
    if ((at > 0 && is_name(text->data[at - 1])) || isdigit((unsigned char)text->data[at])) return 0;
    while (end < text->length && is_name(text->data[end])) end++;
    return end - at;
}

static size_t number_at(const struct draft *text, size_t at)
{
    size_t end = at;
    if (at > 0 && (is_name(text->data[at - 1]) || text->data[at - 1] == '.')) return 0;
    while (end < text->length && (isdigit((unsigned char)text->data[end]) || text->data[end] == '.')) end++;
    if (end == at) return 0;
    size_t power = end;
    if (power < text->length && text->data[power] == 'e') power++;
    if (power > end && power < text->length && strchr("+-", text->data[power])) power++;
    size_t digits = power;
    while (digits < text->length && isdigit((unsigned char)text->data[digits])) digits++;
    return (power > end && digits > power ? digits : end) - at;
}

struct piece piece_next(const struct draft *text, enum piece_kind kind, size_t from)
{
    static size_t (*const at[piece_kinds])(const struct draft *text, size_t at) = {
        [piece_line] = line_at,     [piece_block] = block_at, [piece_flow] = flow_at,
        [piece_entry] = entry_at,   [piece_value] = value_at, [piece_word] = word_at,
        [piece_number] = number_at,
    };
    for (; from < text->length; from++) {
        size_t length = at[kind](text, from);
        if (length > 0) return (struct piece){from, length};
    }
    return (struct piece){text->length, 0};
}

/* To list all pieces for every change would take as long as to try the input. */
struct piece piece_any(const struct draft *text, enum piece_kind kind, struct random_numbers *random)
{
    struct piece next = piece_next(text, kind, random_below(random, text->length));
    return next.length > 0 ? next : piece_next(text, kind, 0);
}

/* ---- names and sections */

struct piece find_section(const struct draft *text, const char *key)
{
    size_t length = strlen(key);
    struct piece block = piece_next(text, piece_block, 0);
    while (block.length > 0) {
        const char *line = text->data + block.start;
        if (block.length > length && memcmp(line, key, length) == 0 && line[length] == ':') return block;
        block = piece_next(text, piece_block, block.start + 1);
    }
    return block;
}

static bool is_word(const struct draft *text, struct piece piece, const char *word, size_t length)
{
    return piece.length == length && memcmp(text->data + piece.start, word, length) == 0;
}

bool has_word(const struct draft *text, const char *word, size_t length)
{
    struct piece next = piece_next(text, piece_word, 0);
    while (next.length > 0 && !is_word(text, next, word, length))
        next = piece_next(text, piece_word, next.start + next.length);
    return next.length > 0;
}

void rename_word(struct draft *draft, const char *word, size_t length, const char *suffix)
{
    struct piece next = piece_next(draft, piece_word, 0);
    while (next.length > 0) {
        size_t end = next.start + next.length;
        if (is_word(draft, next, word, length) &&
            draft_replace(draft, (struct piece){end, 0}, suffix, strlen(suffix)))
            end += strlen(suffix);
        next = piece_next(draft, piece_word, end);
    }
}
