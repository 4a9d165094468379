/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivations by hand: equations over the coordinates and what the assembly knows.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

static bool read_equation(struct reader *reader, const struct node *node, const struct scope *scope,
                          struct hand *hand)
{
    const struct expr_want want = {.any_dim = true, .what = "equation"};
    char relation = 0;
    if (node->length == 0) return value_refuse(reader, node, "hand", "an equation", "write left = right");
    if (!value_relation(reader, node, &want, scope, &hand->left, &relation, &hand->right)) return false;
    if (relation == '=') return true;
    diag_add(reader->errors, FBD_ERROR, "no-equation", node->at,
             "write both sides, as `m*v_dot = f1 - m*g*sin(phi)`",
             "a derivation by hand must be an equation");
    return false;
}

static bool read_hand(struct reader *reader, int index, const struct node *node, struct hand *hand)
{
    struct names names = {.reader = reader, .place = place_hand, .body = index};
    struct scope scope = names_scope(&names);
    struct hand_keys keys = {0};
    bool fine = fields_read(reader, &hand_group, node, node->at, &scope, &keys);
    hand->at = node->at;
    if (keys.equation) {
        hand->at = keys.equation->at;
        hand->text = arena_text(reader->arena, keys.equation->text, keys.equation->length);
        if (!read_equation(reader, keys.equation, &scope, hand)) fine = false;
    }
    if (keys.when) {
        const struct expr_want want = {.condition = true, .what = "when"};
        hand->when = value_compile(reader, keys.when, &want, &scope);
        if (!hand->when) fine = false;
    }
    return fine;
}

bool body_hand_read(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    const struct node *node = reader->drafts[index].keys.hand;
    if (!node) return true;
    bool list = node->kind == node_list, fine = true;
    size_t count = list ? node->count : 1;
    body->hands = ARENA_ARRAY(reader->arena, count, struct hand);
    if (!body->hands) return false;
    body->hand_count = count;
    for (size_t i = 0; i < count; i++)
        if (!read_hand(reader, index, list ? node->items[i] : node, &body->hands[i])) fine = false;
    return fine;
}
