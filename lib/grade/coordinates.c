/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivations in the answer's own coordinates, and with names of its drawn forces.
 *
 * An answer may measure x with another sense or origin: x' = s x + c with s = 1 or -1. Its derivations are
 * then valid on the mechanics of the sheet with s x + c written for x', s v for its rate, and s v_dot for its
 * acceleration. The name of a force is replaced by its value; that of a correct unknown by the reaction at
 * the start.
 */
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "document/node_edit.h"
#include "fbd_grade.h"
#include "grade/lines.h"

struct rewriting {
    const struct fbd_grade *grade;
    const struct node *answer;
    const char *body; /* body of the derivation */
    bool varied;      /* reactions are parameters */
};

static bool is_word(const char *word, size_t length, const char *name)
{
    return name && strlen(name) == length && memcmp(word, name, length) == 0;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_part(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
}

/* Write the replacement for a name of this coordinate; false if it is none of its names. */
static bool add_in_its_place(struct text *text, const struct own_coordinate *own, const char *word,
                             size_t length)
{
    static const char *const slide[] = {"v", "x_dot", "v_dot", "a", "x_ddot"};
    static const char *const pivot[] = {"omega", "theta_dot", "omega_dot", "alpha", "theta_ddot"};
    const char *const *rates = own->angle ? pivot : slide;
    bool rate = false, place = own->angle ? is_word(word, length, "theta") || is_word(word, length, "angle")
                                          : is_word(word, length, "x");
    for (size_t i = 0; i < sizeof slide / sizeof *slide; i++) rate = rate || is_word(word, length, rates[i]);
    if (!place && !rate) return false;
    text_add(text, own->sign < 0 ? "(-" : "(");
    if (strcmp(own->body, "") != 0) text_printf(text, "%s.", own->body);
    text_add_bytes(text, word, length);
    if (place) text_printf(text, " + (%.17g[%s])", own->offset, own->unit);
    text_add(text, ")");
    return true;
}

static bool has_normal(const struct fbd_grade *grade, const char *body)
{
    size_t b = 0;
    while (b < fbd_model_body_count(grade->sheet) && strcmp(fbd_model_body_name(grade->sheet, b), body) != 0)
        b++;
    const fbd_body seen = fbd_model_body(grade->sheet, b);
    fbd_state *state = fbd_state_new(grade->sheet);
    fbd_listed_force *forces = calloc(seen.most_forces + 1, sizeof *forces);
    size_t count = state && forces ? fbd_state_forces(state, b, forces, seen.most_forces) : 0;
    bool found = false;
    for (size_t i = 0; i < seen.listed && i < count; i++)
        found = found || strcmp(forces[i].law, "normal") == 0;
    free(forces);
    fbd_state_free(state);
    return found;
}

/* True if the name has another meaning in an equation or in the file. */
static bool is_known(const struct rewriting *rewriting, const char *name)
{
    const struct fbd_grade *grade = rewriting->grade;
    static const char *const maps[] = {"parameters", "inputs", "states", "tables"};
    if (strcmp(name, "N") == 0) return has_normal(grade, rewriting->body);
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        if (node_find(lines_value(grade->key->root, maps[i]), name) ||
            node_find(lines_value(rewriting->answer, maps[i]), name))
            return true;
    return name_is_of_equations(name);
}

/* The drawn entry of this name, on this body or else on another one; NULL for none with a value. */
static const struct drawn *find_drawn(const struct rewriting *rewriting, const char *word, size_t length)
{
    const struct drawn *found = NULL;
    for (const struct drawn *one = rewriting->grade->drawn; one; one = one->next) {
        bool symbol = is_word(word, length, one->symbol);
        if (!one->value || !(symbol || is_word(word, length, one->name))) continue;
        if (is_known(rewriting, symbol ? one->symbol : one->name)) continue;
        if (strcmp(one->body, rewriting->body) == 0) return one;
        found = one;
    }
    return found;
}

/* Rewrite a word with its dots: `x` of the current body, or `body.x`. */
static void add_word(const struct rewriting *rewriting, struct text *text, const char *word, size_t length)
{
    const char *dot = memchr(word, '.', length);
    const struct drawn *drawn = dot ? NULL : find_drawn(rewriting, word, length);
    if (drawn && drawn->force && !rewriting->varied) {
        text_add_bytes(text, word, length); /* one of the symbols */
        return;
    }
    if (drawn) {
        text_add(text, rewriting->varied && drawn->parameter ? drawn->parameter : drawn->value);
        return;
    }
    for (const struct own_coordinate *own = rewriting->grade->own; own; own = own->next) {
        struct own_coordinate named = *own;
        size_t before = dot ? (size_t)(dot - word) + 1 : 0;
        if (dot ? !is_word(word, before - 1, own->body) : strcmp(own->body, rewriting->body) != 0) continue;
        if (!dot) named.body = "";
        if (add_in_its_place(text, &named, word + before, length - before)) return;
    }
    text_add_bytes(text, word, length);
}

/* Rewrite a text; units in brackets and names of functions are unchanged. */
static void rewrite(const struct rewriting *rewriting, const char *from, struct text *text)
{
    while (*from) {
        size_t length = 1;
        if (*from == '[') {
            length = strcspn(from, "]");
            text_add_bytes(text, from, length);
        } else if (is_part(*from)) {
            while (is_part(from[length]) || from[length] == '.') length++;
            bool number = is_digit(*from);
            const bool force = is_word(from, length, "work") || is_word(from, length, "impulse");
            if (force && from[length] == '(')
                length += strcspn(from + length, ")"); /* a name of the diagram */
            if (force || number || from[length + strspn(from + length, " ")] == '(')
                text_add_bytes(text, from, length);
            else
                add_word(rewriting, text, from, length);
        } else {
            text_add_bytes(text, from, 1);
        }
        from += length;
    }
}

static const char *rewritten(struct arena *arena, const struct node *scalar, const void *context)
{
    struct text text = {0};
    rewrite(context, scalar->text, &text);
    const char *made = text.failed ? NULL : arena_text(arena, text.data ? text.data : "", text.length);
    if (!made) arena->failed = true;
    text_free(&text);
    return made;
}

const struct node *coordinates_of_sheet(struct fbd_grade *grade, const struct node *answer,
                                        const struct node *hand, const char *body)
{
    const struct rewriting rewriting = {grade, answer, body, false};
    return (grade->own || grade->drawn) && hand ? node_rewritten(&grade->arena, hand, rewritten, &rewriting)
                                                : hand;
}

const struct node *line_over_parameters(struct fbd_grade *grade, const struct node *answer,
                                        const struct node *line, const char *body)
{
    const struct rewriting rewriting = {grade, answer, body, true};
    return node_rewritten(&grade->arena, line, rewritten, &rewriting);
}

/* ---- reverse direction */

static const char *find_text(const struct node *node, struct pos at)
{
    if (node->kind == node_scalar)
        return node->at.line == at.line && node->at.column == at.column ? node->text : NULL;
    const char *found = NULL;
    for (size_t i = 0; i < node->count && !found; i++)
        found = find_text(node->kind == node_map ? node->pairs[i].value : node->items[i], at);
    return found;
}

static const char *as_written(struct arena *arena, const struct node *scalar, const void *context)
{
    const char *found = context ? find_text(context, scalar->at) : NULL;
    return found ? found : arena_text(arena, scalar->text, scalar->length);
}

static const struct node *hand_of(const struct node *root, const char *body)
{
    return lines_value(lines_value(lines_value(root, "bodies"), body), "hand");
}

static const char *line_of(const struct node *root, const char *body, const fbd_derivation *hand)
{
    const struct node *own = hand_of(root, body);
    return own ? find_text(own, (struct pos){hand->line, hand->column}) : NULL;
}

const char *line_as_written(const struct lines *lines, const char *body, const fbd_derivation *hand)
{
    const char *found = line_of(lines->paper, body, hand);
    return found ? found : hand->written;
}

const char *line_as_read(const struct lines *lines, const char *body, const fbd_derivation *hand)
{
    const char *found = line_of(lines->answer, body, hand);
    return found ? found : hand->text;
}

const struct node *lines_as_written(struct lines *lines)
{
    struct arena *arena = &lines->grade->arena;
    const struct node *bodies = lines_value(lines->root, "bodies"), *made = bodies;
    for (size_t b = 0; made && b < bodies->count; b++) {
        const char *name = bodies->pairs[b].key;
        const struct node *hand = hand_of(lines->root, name);
        if (!hand) continue;
        const struct node *plain = node_rewritten(arena, hand, as_written, hand_of(lines->answer, name));
        const struct node *body = plain ? node_with(arena, bodies->pairs[b].value, "hand", plain) : NULL;
        made = body ? node_with(arena, made, name, body) : NULL;
    }
    return made ? node_with(arena, lines->root, "bodies", made) : NULL;
}
