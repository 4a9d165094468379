/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How libFuzzer changes and crosses models: by pieces that belong together, so that what comes out is often a
 * model again. A quarter of all changes are libFuzzer's own, of bytes.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "pieces.h"
#include "words.h"

enum { most_changes = 4, longest_piece = fuzz_longest };

/* ---- pieces in each other's place */

/* Piece `p` of the draft becomes a copy of piece `q` of another text; a block is indented as the one that it
 * replaces. */
static void put_piece(struct draft *draft, struct piece p, const struct draft *from, struct piece q,
                      enum piece_kind kind)
{
    char copy[longest_piece];
    struct draft made = {copy, 0, sizeof copy};
    if (kind != piece_block) {
        if (q.length <= sizeof copy) {
            memcpy(copy, from->data + q.start, q.length);
            draft_replace(draft, p, copy, q.length);
        }
        return;
    }
    size_t wanted = indentation(draft, p.start, false), own = indentation(from, q.start, false);
    for (size_t at = q.start; at < q.start + q.length;) {
        struct piece line = piece_next(from, piece_line, at);
        size_t blanks = indentation(from, at, false), more = blanks > own ? blanks - own : 0;
        size_t rest = line.length - blanks;
        if (made.length + wanted + more + rest > made.room) return;
        memset(copy + made.length, ' ', wanted + more);
        memcpy(copy + made.length + wanted + more, from->data + at + blanks, rest);
        made.length += wanted + more + rest;
        at += line.length;
    }
    draft_replace(draft, p, copy, made.length);
}

static void substitute(struct draft *draft, const struct draft *from, struct random_numbers *random)
{
    enum piece_kind kind = (enum piece_kind)random_below(random, piece_kinds);
    struct piece p = piece_any(draft, kind, random), q = piece_any(from, kind, random);
    if (q.length > 0) put_piece(draft, p, from, q, kind);
}

static void exchange(struct draft *draft, struct random_numbers *random)
{
    enum piece_kind kind = (enum piece_kind)random_below(random, piece_kinds);
    struct piece p = piece_any(draft, kind, random), q = piece_any(draft, kind, random);
    if (p.start + p.length > q.start || q.length == 0) return; /* p has to stand before q */
    char bytes[longest_piece];
    struct draft copy = {bytes, draft->length, sizeof bytes};
    if (draft->length > copy.room) return;
    memcpy(bytes, draft->data, draft->length);
    put_piece(draft, q, &copy, p, kind);
    put_piece(draft, p, &copy, q, kind);
}

/* A copy of a line, a block or an entry behind itself, under a name of its own. */
static void repeat(struct draft *draft, struct random_numbers *random)
{
    static const enum piece_kind kinds[] = {piece_line, piece_block, piece_entry};
    enum piece_kind kind = kinds[random_below(random, 3)];
    struct piece p = piece_any(draft, kind, random);
    char bytes[longest_piece];
    struct draft copy = {bytes, p.length + (kind == piece_entry), sizeof bytes - 16};
    if (p.length == 0 || copy.length > copy.room) return;
    bytes[0] = ',';
    memcpy(bytes + (kind == piece_entry), draft->data + p.start, p.length);
    struct piece word =
        random_below(random, 2) ? piece_next(&copy, piece_word, 0) : piece_any(&copy, piece_word, random);
    char name[64];
    if (word.length > 0 && word.length < sizeof name) {
        memcpy(name, bytes + word.start, word.length);
        rename_word(&copy, name, word.length, "2");
    }
    draft_replace(draft, (struct piece){p.start + p.length, 0}, bytes, copy.length);
}

static void take_out(struct draft *draft, struct random_numbers *random)
{
    draft_replace(draft, piece_any(draft, (enum piece_kind)random_below(random, piece_kinds), random), "", 0);
}

/* ---- words and numbers */

static void change_number(struct draft *draft, struct random_numbers *random)
{
    static const char *const numbers[] = {
        "0",      "1",        "-1",      "2",       "0.5",     "1e-3",   "1e3",
        "1e-9",   "1e9",      "1e15",    "1e-15",   "1e100",   "1e-100", "1e300",
        "1e-300", "4.9e-324", "1.7e308", "90 deg",  "180 deg", "0.1",    "3.14159265358979",
        "10",     "45 deg",   "-90 deg", "360 deg", "1e-6",    "1e6",    "0.3",
        "-0"};
    struct piece p = piece_any(draft, piece_number, random);
    if (p.length == 0) return;
    const char *number = numbers[random_below(random, sizeof numbers / sizeof *numbers)];
    char made[40];
    if (random_below(random, 3) == 0) {
        snprintf(made, sizeof made, "%.*g", 1 + (int)random_below(random, 17), random_between(random, -5, 5));
        number = made;
    }
    draft_replace(draft, p, number, strlen(number));
}

/* Of all sets that a word is in, one; of its words, one. */
struct choice {
    const char *word;
    size_t length, sets;
    const char *other;
    struct random_numbers *random;
};

static void choose_other(void *context, const struct word_set *set)
{
    struct choice *choice = context;
    for (size_t i = 0; i < set->count; i++)
        if (strlen(set->words[i]) == choice->length &&
            memcmp(set->words[i], choice->word, choice->length) == 0) {
            if (random_below(choice->random, ++choice->sets) == 0)
                choice->other = set->words[random_below(choice->random, set->count)];
            return;
        }
}

static void change_word(struct draft *draft, struct random_numbers *random)
{
    struct piece p = piece_any(draft, piece_word, random);
    struct choice choice = {draft->data + p.start, p.length, 0, NULL, random};
    if (p.length == 0) return;
    each_word_set(choose_other, &choice);
    if (choice.other) draft_replace(draft, p, choice.other, strlen(choice.other));
}

/* A name in the place of another name of the same text that is no word of the language: another body. */
static void change_name(struct draft *draft, struct random_numbers *random)
{
    for (int tries = 0; tries < 8; tries++) {
        struct piece p = piece_any(draft, piece_word, random), q = piece_any(draft, piece_word, random);
        struct choice first = {draft->data + p.start, p.length, 0, NULL, random}, second = first;
        second.word = draft->data + q.start;
        second.length = q.length;
        each_word_set(choose_other, &first);
        each_word_set(choose_other, &second);
        if (first.sets > 0 || second.sets > 0 || q.length > 200) continue;
        put_piece(draft, p, draft, q, piece_word);
        return;
    }
}

/* Keep the line of choices at the start, with other bits. */
static void change_choices(struct draft *draft, struct random_numbers *random)
{
    char line[24];
    int length = snprintf(line, sizeof line, "#?%016" PRIx64 "\n", random_bits(random));
    bool there = draft->length > 2 && draft->data[0] == '#' && draft->data[1] == '?';
    draft_replace(draft, there ? piece_next(draft, piece_line, 0) : (struct piece){0, 0}, line,
                  (size_t)length);
}

static void change(struct draft *draft, struct random_numbers *random)
{
    switch (random_below(random, 12)) {
    case 0:
    case 1: substitute(draft, draft, random); break;
    case 2: exchange(draft, random); break;
    case 3: repeat(draft, random); break;
    case 4: take_out(draft, random); break;
    case 5:
    case 6:
    case 7: change_number(draft, random); break;
    case 8:
    case 9: change_word(draft, random); break;
    case 10: change_name(draft, random); break;
    default: change_choices(draft, random); break;
    }
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
    struct random_numbers random = {seed};
    struct draft draft = {(char *)data, size, max_size};
    if (random_below(&random, 4) == 0) return LLVMFuzzerMutate(data, size, max_size);
    for (size_t i = 1 + random_below(&random, random_below(&random, most_changes) + 1); i > 0; i--)
        change(&draft, &random); /* mostly one: each makes it less likely that it still is a model */
    return draft.length;
}

/* ---- two models */

/* The names that a section gives: `name:` at its first level. Of `b`, those that `a` has too get a suffix. */
static void rename_clashes(struct draft *b, const char *key, const struct draft *a)
{
    struct piece section = find_section(b, key);
    size_t level = SIZE_MAX;
    for (struct piece word = piece_next(b, piece_word, section.start + strlen(key));
         word.length > 0 && word.start < section.start + section.length;
         word = piece_next(b, piece_word, word.start + word.length)) {
        size_t line = word.start, end = word.start + word.length;
        while (line > 0 && b->data[line - 1] != '\n') line--;
        bool flow = line <= section.start + 1, first = line + indentation(b, line, true) == word.start;
        if (end >= b->length || b->data[end] != ':' || !(flow || first)) continue;
        if (!flow && level == SIZE_MAX) level = word.start - line;
        if (!flow && word.start - line > level) continue;
        char name[64];
        if (word.length >= sizeof name || !has_word(a, b->data + word.start, word.length)) continue;
        memcpy(name, b->data + word.start, word.length);
        rename_word(b, name, word.length, "_2");
        section = find_section(b, key);
    }
}

/* What section `key` of `b` has goes to that of `a`, or is appended with its key. */
static void merge_section(struct draft *a, const struct draft *b, const char *key)
{
    struct piece to = find_section(a, key), from = find_section(b, key);
    size_t brace = strlen(key) + 2; /* `key: {` */
    if (from.length == 0) return;
    if (to.length == 0) {
        draft_replace(a, (struct piece){a->length, 0}, b->data + from.start, from.length);
        return;
    }
    bool flows = to.length > brace && from.length > brace && a->data[to.start + brace] == '{' &&
                 b->data[from.start + brace] == '{';
    struct piece line = piece_next(b, piece_line, from.start);
    if (flows) {
        struct piece flow = piece_next(b, piece_flow, from.start + brace);
        if (flow.length < 2) return;
        draft_replace(a, (struct piece){to.start + brace + 1, 0}, ", ", 2);
        draft_replace(a, (struct piece){to.start + brace + 1, 0}, b->data + flow.start + 1, flow.length - 2);
    } else {
        draft_replace(a, (struct piece){to.start + to.length, 0}, b->data + from.start + line.length,
                      from.length - line.length);
    }
}

static const char *const sections[] = {"parameters", "ground", "bodies", "couplings"};

/* Both models in one file, side by side. */
static void merge(struct draft *a, const struct draft *b)
{
    char bytes[2 * fuzz_longest];
    struct draft renamed = {bytes, b->length, sizeof bytes};
    if (b->length > renamed.room) return;
    memcpy(bytes, b->data, b->length);
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) rename_clashes(&renamed, sections[i], a);
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) merge_section(a, &renamed, sections[i]);
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t max_size, unsigned seed)
{
    struct random_numbers random = {seed};
    struct draft draft = {(char *)out, a_size < max_size ? a_size : max_size, max_size};
    const struct draft other = {(char *)(uintptr_t)b, b_size, b_size};
    memcpy(out, a, draft.length);
    if (random_below(&random, 3) == 0) {
        merge(&draft, &other);
        for (size_t i = random_below(&random, 3); i > 0; i--) change_name(&draft, &random);
    } else {
        for (size_t i = 1 + random_below(&random, most_changes); i > 0; i--)
            substitute(&draft, &other, &random);
    }
    return draft.length;
}
