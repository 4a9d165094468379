/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivations by hand: equations over the coordinates and the names of enum hand_slot.
 */
#include <string.h>

#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"
#include "scene/written.h"

/* Read the two sides. */
static bool read_sides(struct reader *reader, const struct node *node, const struct scope *scope,
                       struct hand *hand, char *relation)
{
    const struct expr_want want = {.any_dim = true, .what = "equation"};
    struct notation notation;
    const struct node *read = written_node(reader, node, scope, true, &notation);
    if (!read) return false;
    hand->text = arena_text(reader->arena, read->text, read->length);
    struct diag_note *last = reader->errors->last;
    bool fine = value_relation(reader, read, &want, scope, &hand->left, relation, &hand->right);
    if (notation.changed) written_places(reader, node, &notation, last);
    return fine && hand->text;
}

/* `M(a)` is a product where `M` has another meaning, as the letter of a moment, else a section force. Where the dimensions
 * of the line do not permit the product, a section force is meant; where they permit both, as in `M(a) = 0`, the line is
 * refused. A bare number is no length beside another meaning: `N(1 - mu)` is a product. */
static bool read_meaning(struct reader *reader, const struct node *node, const struct scope *scope,
                         struct hand *hand, char *relation)
{
    struct names *names = scope->context;
    const struct diag_mark mark = diag_mark(reader->errors);
    names->sections = names->section_hidden = false;
    const bool fine = read_sides(reader, node, scope, hand, relation);
    if (!names->section_hidden || reader->scene->hands_left) return fine;
    const struct diag_mark own = diag_mark(reader->errors);
    const size_t absolutes = reader->scene->absolute_count;
    struct hand other = *hand;
    names->sections = true;
    const bool section = read_sides(reader, node, scope, &other, relation);
    if (section && fine) {
        diag_add(reader->errors, FBD_ERROR, "ambiguous-notation", node->at,
                 "write the product with `*`; of a section force give the zero its unit, as `M(a) = 0[N*m]`",
                 "`%s` can be read in two ways: a name with parentheses is a product or a section force",
                 hand->text);
        return false;
    }
    diag_take_back(reader->errors, section ? mark : own);
    if (section)
        *hand = other;
    else
        reader->scene->absolute_count = absolutes;
    names->sections = section;
    return section || fine;
}

static bool read_equation(struct reader *reader, const struct node *node, const struct scope *scope,
                          struct hand *hand)
{
    char relation = 0;
    if (node->length == 0) return value_refuse(reader, node, "hand", "an equation", "write left = right");
    if (!read_meaning(reader, node, scope, hand, &relation)) return false;
    const bool conserved = hand->kind == hand_conserved;
    if (relation == (conserved ? 0 : '=')) return true;
    diag_add(reader->errors, FBD_ERROR, "no-equation", node->at,
             conserved ? "write `equation: left = right` for an equation"
                       : "write both sides, as `m*v_dot = f1 - m*g*sin(phi)`",
             conserved ? "`conserved` is one expression, without a relation"
                       : "a derivation by hand must be an equation");
    return false;
}

/* ---- validity of an equation */

/* True if a slot without `before` or `after` has one value at an impact. Velocities have two, forces none. */
static bool stands_at_impacts(const struct scene *scene, size_t slot)
{
    const size_t n = scene->coordinate_count, size = scene_size(scene);
    if (slot <= n || (slot > 2 * n && slot <= size)) return true;
    if (slot <= 2 * n) return false;
    const size_t k = slot - 1 - size;
    if (k < hand_slots) return k >= hand_mass && k != hand_N;
    const enum absolute_kind kind = scene->absolutes[k - hand_slots].kind;
    return kind == absolute_x || kind == absolute_y || kind == absolute_angle || kind == absolute_mass ||
           kind == absolute_inertia || kind == absolute_work || kind == absolute_impulse;
}

/* Kinds of names in an equation. */
struct senses {
    bool of[hand_senses];
    bool work;  /* or an impulse */
    bool jumps; /* a name without a unique value at an impact */
};

static void note_senses(const struct scene *scene, const struct expr *expr, struct senses *senses)
{
    const int *slots;
    const size_t size = hand_sense_size(scene), first = scene_size(scene) + hand_slots,
                 count = expr ? expr_variables(expr, &slots) : 0;
    for (size_t i = 0; i < count; i++) {
        const size_t slot = (size_t)slots[i], sense = (slot - 1) / size, k = (slot - 1) % size;
        senses->of[sense] = true;
        if (sense == sense_now && !stands_at_impacts(scene, slot)) senses->jumps = true;
        if (k >= first && scene->absolutes[k - first].kind >= absolute_work) senses->work = true;
    }
}

/* Set the kind of an equation, which follows from its names. */
static bool set_kind(struct reader *reader, const struct node *impact, struct hand *hand)
{
    struct senses senses = {{false}, false, false};
    note_senses(reader->scene, hand->left, &senses);
    note_senses(reader->scene, hand->right, &senses);
    const bool impacts = senses.of[sense_before] || senses.of[sense_after];
    const char *message = NULL, *hint = NULL;
    if (impacts && hand->kind != hand_conserved)
        hand->kind = hand_of_impacts;
    else if (hand->kind == hand_of_states && (senses.of[sense_initial] || senses.work))
        hand->kind = hand_of_run;
    if (impacts && (hand->kind == hand_conserved || senses.of[sense_initial])) {
        message = "`before` and `after` are of an impact, and stand in an equation of that alone";
        hint = "as `m*after(v) = -e*m*before(v)`";
    } else if (impacts && senses.jumps) {
        message = "a velocity without `before` or `after`, or a force, has no value at an impact";
        hint = "write `before(v)` or `after(v)`; `work(...)` and `impulse(...)` are those of the impact";
    } else if (impact && !impacts) {
        message = "`impact` goes with an equation that has `before` and `after`";
    }
    if (message)
        diag_add(reader->errors, FBD_ERROR, "not-here", impact ? impact->at : hand->at, hint, "%s", message);
    return !message;
}

/* Position of the equals sign outside of all brackets. */
static size_t equals_sign(const char *text)
{
    int depth = 0;
    for (size_t i = 0; text[i]; i++) {
        if (text[i] == '(' || text[i] == '[') depth++;
        if (text[i] == ')' || text[i] == ']') depth--;
        if (depth == 0 && text[i] == '=') return i;
    }
    return strlen(text);
}

/* Compile the summands of one side, which was compiled as a whole before: only memory can fail. `sign` is
 * that of the side after moving all summands to the right. */
static bool add_summands(struct reader *reader, const char *text, size_t length, double sign,
                         const struct scope *scope, struct hand *hand)
{
    const struct expr_want want = {.any_dim = true, .what = "summand"};
    struct summand summands[most_summands];
    size_t count = expr_summands(text, length, summands, most_summands);
    fbd_errors *silent = fbd_errors_new();
    bool fine = silent != NULL;
    for (size_t i = 0; fine && i < count; i++) {
        char *one = arena_text(reader->arena, text + summands[i].start, summands[i].length);
        const struct expr *expr =
            one ? expr_compile(reader->arena, one, hand->at, scope, &want, silent) : NULL;
        fine = expr != NULL;
        if (!fine) continue;
        double own = summands[i].negative ? -sign : sign;
        hand->summands[hand->summand_count++] = (struct hand_summand){one, own, expr};
    }
    fbd_errors_free(silent);
    if (!fine) diag_out_of_memory(reader->errors);
    return fine;
}

/* Split an equation into its summands; one with more than most_summands stays whole. */
static bool split_equation(struct reader *reader, const struct scope *scope, struct hand *hand)
{
    size_t left = equals_sign(hand->text), length = strlen(hand->text);
    if (hand->kind == hand_conserved) {
        hand->summands = ARENA_ARRAY(reader->arena, most_summands, struct hand_summand);
        bool whole = expr_summands(hand->text, length, NULL, 0) > most_summands;
        return hand->summands && (whole || add_summands(reader, hand->text, length, 1, scope, hand));
    }
    const char *right = hand->text + left + 1;
    size_t right_length = length - left - 1;
    size_t count = expr_summands(hand->text, left, NULL, 0) + expr_summands(right, right_length, NULL, 0);
    if (count > most_summands) return true;
    hand->summands = ARENA_ARRAY(reader->arena, count, struct hand_summand);
    return hand->summands && add_summands(reader, hand->text, left, -1, scope, hand) &&
           add_summands(reader, right, right_length, 1, scope, hand);
}

static const struct expr *read_condition(struct reader *reader, const struct node *node,
                                         const struct scope *scope)
{
    const struct expr_want want = {.condition = true, .what = "when"};
    struct notation notation;
    const struct node *read = written_node(reader, node, scope, false, &notation);
    struct diag_note *last = reader->errors->last;
    const struct expr *when = read ? value_compile(reader, read, &want, scope) : NULL;
    if (read && notation.changed) written_places(reader, node, &notation, last);
    return when;
}

/* ---- point of reference of moments */

/* Set the reference point by the expressions `name.x`, `name.y`. */
static bool name_place(struct reader *reader, const char *name, const struct scope *scope, struct hand *hand)
{
    const struct expr_want want = {.dim = DIM_LENGTH, .what = "about"};
    for (int k = 0; name && k < 2; k++) {
        const char *text = arena_printf(reader->arena, "%s.%c", name, k == 0 ? 'x' : 'y');
        hand->about[k] =
            text ? expr_compile(reader->arena, text, hand->at, scope, &want, reader->errors) : NULL;
    }
    return hand->about[0] && hand->about[1];
}

static bool ground_place(struct reader *reader, const struct pair *pair, struct hand *hand)
{
    const struct ground_point *point = &reader->ground_points[pair - reader->points->pairs];
    hand->about[0] = expr_constant(reader->arena, point->where.x, DIM_LENGTH);
    hand->about[1] = expr_constant(reader->arena, point->where.y, DIM_LENGTH);
    return point->valid && hand->about[0] && hand->about[1];
}

/* Read a point of the body, of the ground, of another body, or the point of application of a force of the
 * diagram. */
static bool read_about(struct reader *reader, int index, const struct node *node, const struct scope *scope,
                       struct hand *hand)
{
    const struct names *names = scope->context;
    const char *name = node->text, *dot = strchr(name, '.');
    const size_t before = dot ? (size_t)(dot - name) : 0;
    struct point point = {.kind = point_absent};
    hand->about_name = arena_text(reader->arena, name, node->length);
    if (!hand->about_name) return false;
    const struct body *body = &reader->scene->bodies[index];
    if (names_point(body, name, node->length, &point))
        return name_place(reader, arena_printf(reader->arena, "%s.%s", body->name, name), scope, hand);
    const bool ground = before == strlen("ground") && strncmp(name, "ground", before) == 0;
    const struct pair *pair = reader->points ? node_find(reader->points, ground ? dot + 1 : name) : NULL;
    if (pair) return ground_place(reader, pair, hand);
    for (size_t b = 0; dot && b < reader->scene->body_count; b++) {
        const struct body *other = &reader->scene->bodies[b];
        if (strncmp(other->name, name, before) != 0 || other->name[before]) continue;
        if (names_point(other, dot + 1, strlen(dot + 1), &point))
            return name_place(reader, name, scope, hand);
    }
    const char *at = arena_printf(reader->arena, "%s.at", name);
    const char *x = arena_printf(reader->arena, "%s.at.x", name);
    const int kind = at && x ? (int)force_symbol(names, x).kind : (int)symbol_failed;
    if (kind == symbol_variable) return name_place(reader, at, scope, hand);
    if (kind == symbol_unknown)
        diag_add(reader->errors, FBD_ERROR, "unknown-point", node->at,
                 "write `G`, a point of the body, `ground.NAME`, or a joint or force of its diagram",
                 "there is no point `%s` to take moments about", name);
    return false;
}

static bool read_hand(struct reader *reader, int index, const struct node *node, struct hand *hand)
{
    struct names names = {.reader = reader, .place = place_hand, .body = index};
    names.slip = reader->drafts[index].has_friction ? slip_moving : slip_unknown;
    names.slip_angular = motion_joint(&reader->scene->bodies[index].motion)->has_axis;
    struct scope scope = names_scope(&names);
    struct hand_keys keys = {0};
    bool fine = fields_read(reader, &hand_group, node, node->at, &scope, &keys);
    hand->at = node->at;
    const struct node *line = keys.conserved ? keys.conserved : keys.equation;
    if (keys.conserved) hand->kind = hand_conserved;
    if (keys.impact) hand->impact = arena_text(reader->arena, keys.impact->text, keys.impact->length);
    if (fine && (keys.conserved != NULL) == (keys.equation != NULL)) {
        diag_add(reader->errors, FBD_ERROR, line ? "conflicting-keys" : "missing-key", node->at,
                 "a derivation is an `equation` or a `conserved` expression", "%s",
                 line ? "`equation` and `conserved` exclude each other" : "`equation` is missing");
        return false;
    }
    if (line) {
        hand->at = line->at;
        hand->written = arena_text(reader->arena, line->text, line->length);
        if (!hand->written || !read_equation(reader, line, &scope, hand) ||
            !set_kind(reader, keys.impact, hand) ||
            (reader->split_hands && !split_equation(reader, &scope, hand)))
            fine = false;
    }
    if (keys.when) hand->when = read_condition(reader, keys.when, &scope);
    if (keys.about && !read_about(reader, index, keys.about, &scope, hand)) fine = false;
    return fine && (!keys.when || hand->when);
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
    for (size_t i = 0; i < count; i++) {
        bool left_before = reader->scene->hands_left;
        struct hand *hand = &body->hands[body->hand_count];
        reader->scene->hands_left = false;
        bool read = read_hand(reader, index, list ? node->items[i] : node, hand);
        bool left = reader->scene->hands_left;
        reader->scene->hands_left = left || left_before;
        if (left)
            *hand = (struct hand){.text = NULL}; /* read again when the names of forces are known */
        else if (read)
            body->hand_count++;
        else
            fine = false;
    }
    return fine;
}
