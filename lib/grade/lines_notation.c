/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Translate the derivations of an answer into expressions. They may refer to the drawn forces of the answer.
 */
#include <string.h>

#include "base/text.h"
#include "document/node_edit.h"
#include "fbd_grade.h"
#include "grade/lines.h"

/* A text and its translation. */
struct reading {
    const struct node *node;
    const char *text;
    struct reading *next;
};

struct readings {
    struct fbd_grade *grade;
    struct reading *first;
};

static bool is_drawn(void *context, const char *body, const char *name)
{
    const struct readings *readings = context;
    (void)body; /* forces on other bodies may be named as well */
    for (const struct drawn *one = readings->grade->drawn; one; one = one->next)
        if ((one->symbol && strcmp(one->symbol, name) == 0) || (one->name && strcmp(one->name, name) == 0))
            return true;
    return false;
}

static void take(void *context, const struct node *node, const char *text)
{
    struct readings *readings = context;
    struct arena *arena = &readings->grade->arena;
    if (strcmp(node->text, text) == 0) return;
    struct reading *made = ARENA_NEW(arena, struct reading);
    char *kept = arena_text(arena, text, strlen(text));
    if (!made || !kept) return;
    *made = (struct reading){node, kept, readings->first};
    readings->first = made;
}

static const char *as_read(struct arena *arena, const struct node *scalar, const void *context)
{
    for (const struct reading *one = context; one; one = one->next)
        if (one->node == scalar) return one->text;
    return arena_text(arena, scalar->text, scalar->length);
}

const struct node *lines_of_notation(struct fbd_grade *grade, const struct node *answer,
                                     const struct node *root)
{
    struct arena *arena = &grade->arena;
    struct readings readings = {grade, NULL};
    const struct node *bodies = lines_value(answer, "bodies"), *made = bodies;
    const struct hand_reader reader = {&readings, is_drawn, take};
    if (root) grade_read_hands(grade, root, &reader);
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

void line_say(struct lines *lines, fbd_finding *finding, const struct hand *hand, const char *message)
{
    struct text text = {0};
    const char *read = line_as_read(lines, finding->body, hand);
    text_add(&text, message);
    if (strcmp(read, finding->name) != 0) text_printf(&text, " (read as `%s`)", read);
    if (text.failed) lines->grade->arena.failed = true;
    finding_say(lines->grade, finding, text.data ? text.data : "");
    text_free(&text);
}
