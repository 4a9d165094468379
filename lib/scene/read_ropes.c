/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ropes: over pulleys, wound on discs, with varying length.
 */
#include "scene/couplings.h"
#include "scene/fields.h"
#include "scene/names.h"
#include "scene/values.h"

#include <math.h>
#include <string.h>

/* ---- pulleys, and ends at the centre of a disc */

static bool names_no_point(const struct node *place)
{
    return strchr(place->text, '.') == NULL;
}

/* Warn of an end at the centre of a turning disc: mostly the rim is meant. */
static void warn_of_centre(struct reader *reader, const struct node *place, const struct body *body)
{
    diag_add(reader->errors, FBD_WARNING, "rope-at-centre", place->at,
             diag_hint(reader->errors,
                       "to wind it on the rim: `wound: {on: %s, side: left}` (or right, top, bottom); if the "
                       "centre is meant: `%s.G`",
                       body->name, body->name),
             "the rope ends at the centre of `%s`, which is round and turns", body->name);
}

/* A turning disc is a pulley without slip; over any other body the rope slides at a point. */
static bool set_pulleys(struct reader *reader, const struct node *through, struct constraint *constraint)
{
    int last = constraint->end_count - 1;
    for (int k = 0; k <= last; k++) {
        if (constraint->body[k] == ground_body || constraint->point[k].kind != point_G) continue;
        const struct body *body = &reader->scene->bodies[constraint->body[k]];
        bool outer = k == 0 || k == last, wound = outer && constraint->wound[k == last] != 0;
        if (wound || !body_turns(body) || !body_round_part(body)) continue;
        if (!outer && !coupling_circle_set(reader, constraint, k, 0)) return false;
        if (outer && names_no_point(through->items[k])) warn_of_centre(reader, through->items[k], body);
    }
    return true;
}

/* ---- discs with wound rope */

/* The end of the rope that an entry refers to: the first of that name without an entry; else -1. */
static int wound_end(const struct node *through, const struct constraint *constraint, const struct node *on)
{
    for (int end = 0; end < 2; end++) {
        const struct node *place = through->items[end == 0 ? 0 : through->count - 1];
        if (strcmp(place->text, on->text) == 0 && constraint->wound[end] == 0) return end;
    }
    return -1;
}

/* Set the disc of an end. A body that does not turn and a point of the ground are allowed, too. */
static bool set_disc(struct reader *reader, const struct wound_keys *keys, struct constraint *constraint,
                     int end)
{
    int k = end == 0 ? 0 : constraint->end_count - 1, b = constraint->body[k];
    const struct part *part = b == ground_body ? NULL : body_round_part(&reader->scene->bodies[b]);
    bool centred = b != ground_body && constraint->point[k].kind == point_G && names_no_point(keys->on);
    constraint->radius[k] = keys->radius > 0 ? keys->radius : part ? part->radius : 0;
    if (part && centred) constraint->point[k] = (struct point){.kind = point_fixed, .where = part->center};
    constraint->wound[end] = keys->side;
    constraint->spare[end] = keys->length > 0 ? keys->length : HUGE_VAL;
    if (constraint->radius[k] > 0) return true;
    diag_add(reader->errors, FBD_ERROR, "missing-key", keys->on->at,
             "give `wound` a `radius`, or the body a round `shape`", "`%s` has no radius", keys->on->text);
    return false;
}

static bool read_wound(struct reader *reader, const struct node *node, const struct node *through,
                       struct constraint *constraint)
{
    struct wound_keys keys = {0};
    if (!fields_read(reader, &wound_group, node, node->at, &reader->constants, &keys)) return false;
    int end = wound_end(through, constraint, keys.on);
    if (end >= 0) return set_disc(reader, &keys, constraint, end);
    diag_add(reader->errors, FBD_ERROR, "not-here", keys.on->at,
             diag_hint(reader->errors, "its ends: `%s`, `%s`", through->items[0]->text,
                       through->items[through->count - 1]->text),
             "`%s` is no end of the rope, or is named twice: a rope is wound on a disc at one of its ends",
             keys.on->text);
    return false;
}

static bool read_all_wound(struct reader *reader, const struct coupling_keys *keys,
                           struct constraint *constraint)
{
    const struct node *wound = keys->wound;
    bool fine = true;
    if (!wound) return true;
    if (wound->kind != node_list) return read_wound(reader, wound, keys->through, constraint);
    for (size_t i = 0; i < wound->count; i++)
        if (!read_wound(reader, wound->items[i], keys->through, constraint)) fine = false;
    return fine;
}

/* ---- length */

static bool set_length(struct reader *reader, const struct value *length, struct constraint *constraint)
{
    const int *slots;
    if (!length->expr) return true;
    if (length->by_input) {
        diag_add(reader->errors, FBD_ERROR, "not-here", length->at,
                 "let a force or a spring follow the input",
                 "the `length` of a rope cannot name an input: its ends would jump with it");
        return false;
    }
    if (expr_is_constant(length->expr)) {
        constraint->length = expr_value(length->expr);
        constraint->length_given = true;
        return true;
    }
    constraint->reel = *length;
    constraint->length_given = true;
    if (expr_variables(length->expr, &slots) == 0) {
        smoothness_note(reader, length->at, "length", length->expr);
        return true;
    }
    diag_add(reader->errors, FBD_ERROR, "not-here", length->at, "write it as an expression of t",
             "the `length` of a rope cannot depend on a motion: a drum that it is wound on turns");
    return false;
}

/* ---- friction on a drum */

static bool refuse_around(struct reader *reader, const struct node *node, const char *hint, const char *what)
{
    diag_add(reader->errors, FBD_ERROR, "not-here", node->at, hint, "%s", what);
    return false;
}

static bool read_around(struct reader *reader, const struct coupling_keys *keys,
                        struct constraint *constraint)
{
    struct around_keys around = {0};
    const struct node *through = keys->through, *node = keys->around;
    if (!fields_read(reader, &around_group, node, node->at, &reader->constants, &around)) return false;
    if (through->count != 3 || strcmp(through->items[1]->text, around.on->text) != 0)
        return refuse_around(reader, around.on, "write `through: [a, drum, b]` and `around: {on: drum, ...}`",
                             "a rope with `around` has three places, and runs round the second");
    if (keys->wound || constraint->reel.expr)
        return refuse_around(reader, node, "let another rope do that",
                             "a rope with `around` is neither wound nor hauled in");
    if (!around.mu_s.expr && !around.mu_k.expr)
        return refuse_around(reader, node, "add for example `kinetic: 0.3`",
                             "`around` needs a coefficient of friction");
    int b = constraint->body[1];
    const struct part *part = b == ground_body ? NULL : body_round_part(&reader->scene->bodies[b]);
    constraint->kind = constraint_capstan;
    constraint->radius[1] = around.radius > 0 ? around.radius : part ? part->radius : 0;
    constraint->turns = around.turns;
    constraint->mu_s = around.mu_s.expr ? around.mu_s : around.mu_k;
    constraint->mu_k = around.mu_k.expr ? around.mu_k : around.mu_s;
    if (part && names_no_point(around.on))
        constraint->point[1] = (struct point){.kind = point_fixed, .where = part->center};
    if (around.turns != floor(around.turns))
        return refuse_around(reader, node, "the rest is where the ends of the rope are",
                             "`turns` is no whole number");
    if (constraint->radius[1] > 0) return true;
    diag_add(reader->errors, FBD_ERROR, "missing-key", around.on->at,
             "give `around` a `radius`, or the body a round `shape`", "`%s` has no radius", around.on->text);
    return false;
}

bool rope_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    if (!coupling_ends_read(reader, keys->through, "through", 2, most_constraint_ends, constraint))
        return false;
    bool length = set_length(reader, &keys->reel, constraint);
    if (keys->around) return read_around(reader, keys, constraint) && length;
    return read_all_wound(reader, keys, constraint) && set_pulleys(reader, keys->through, constraint) &&
           length;
}
