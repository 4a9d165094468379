/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Translate the derivations of an answer into expressions. They may refer to the drawn forces of the answer.
 */
#include <string.h>

#include "base/text.h"
#include "document/node_edit.h"
#include "fbd_grade.h"
#include "grade/lines.h"

/* The text at a position of the answer, as it was read. */
struct reading {
    struct pos at;
    const char *text;
    struct reading *next;
};

struct readings {
    struct fbd_grade *grade;
    struct reading *first;
};

static void take(void *context, int line, int column, const char *text)
{
    struct readings *readings = context;
    struct arena *arena = &readings->grade->arena;
    struct reading *made = ARENA_NEW(arena, struct reading);
    char *kept = arena_text(arena, text, strlen(text));
    if (!made || !kept) return;
    *made = (struct reading){{line, column}, kept, readings->first};
    readings->first = made;
}

/* The names of drawn forces. NULL when memory is out. */
static const char *const *names_of_drawn(struct fbd_grade *grade, size_t *count)
{
    size_t most = 0;
    for (const struct drawn *one = grade->drawn; one; one = one->next) most += 2;
    const char **names = ARENA_ARRAY(&grade->arena, most + 1, const char *);
    *count = 0;
    for (const struct drawn *one = grade->drawn; names && one; one = one->next) {
        if (one->symbol) names[(*count)++] = one->symbol;
        if (one->name) names[(*count)++] = one->name;
    }
    return names;
}

static const char *as_read(struct arena *arena, const struct node *scalar, const void *context)
{
    for (const struct reading *one = context; one; one = one->next)
        if (one->at.line == scalar->at.line && one->at.column == scalar->at.column) return one->text;
    return arena_text(arena, scalar->text, scalar->length);
}

const struct node *lines_of_notation(struct fbd_grade *grade, const struct node *answer,
                                     const struct node *root)
{
    struct arena *arena = &grade->arena;
    struct readings readings = {grade, NULL};
    const struct node *bodies = lines_value(answer, "bodies"), *made = bodies;
    size_t count;
    const char *const *names = names_of_drawn(grade, &count);
    if (root && names) grade_read_hands(grade, root, names, count, take, &readings);
    if (!root || grade->arena.failed) return NULL;
    if (!readings.first || !bodies || bodies->kind != node_map) return answer;
    for (size_t b = 0; made && b < bodies->count; b++) {
        const struct pair *body = &bodies->pairs[b];
        const struct node *hand = lines_value(body->value, "hand");
        if (!hand) continue;
        const struct node *read = node_rewritten(arena, hand, as_read, readings.first);
        const struct node *other = read ? node_with(arena, body->value, "hand", read) : NULL;
        made = other ? node_with(arena, made, body->key, other) : NULL;
    }
    return made ? node_with(arena, answer, "bodies", made) : NULL;
}

void line_say(struct lines *lines, fbd_finding *finding, const fbd_derivation *hand, const char *message)
{
    struct text text = {0};
    const char *read = line_as_read(lines, finding->body, hand);
    text_add(&text, message);
    if (strcmp(read, finding->name) != 0) text_printf(&text, " (read as `%s`)", read);
    if (text.failed) lines->grade->arena.failed = true;
    finding_say(lines->grade, finding, text.data ? text.data : "");
    text_free(&text);
}
