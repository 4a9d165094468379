/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings: connections of two bodies beside their joints. Each is declared once and appears in the diagrams
 * of both.
 */
#include "scene/coupling_names.h"
#include "scene/couplings.h"
#include "scene/fields.h"
#include "scene/read_among.h"
#include "scene/reader.h"
#include "scene/slip_law.h"
#include "scene/values.h"

#include <string.h>

/* ---- constraints */

/* Set the body of slip speeds: the coefficients were read before the body was known. */
static void place_slips(struct reader *reader, const struct constraint *constraint)
{
    struct scene *scene = reader->scene;
    int roll = 1 + (int)(constraint - scene->constraints);
    for (size_t i = 0; i < scene->absolute_count; i++)
        if (scene->absolutes[i].roll == roll) scene->absolutes[i].body = constraint_first_body(constraint);
}

/* A coefficient given by one key determines the other one. */
static bool share_friction(struct reader *reader, const struct node *node, const struct scope *scope,
                           struct coupling_keys *keys)
{
    const struct pair *rest = node_find(node, "static"), *moving = node_find(node, "kinetic");
    if (moving && !rest)
        return slip_law_share(reader, moving->value, "kinetic", a_number, slip_resting, scope, &keys->mu_k,
                              &keys->mu_s);
    if (rest && !moving)
        return slip_law_share(reader, rest->value, "static", a_number, slip_moving, scope, &keys->mu_s,
                              &keys->mu_k);
    return true;
}

/* The rolling resistance of a roll is a constraint of its own behind it, with its arm as the coefficient. */
static void add_resistance(struct scene *scene, const struct coupling_keys *keys)
{
    if (!keys->resistance.expr) return;
    const struct constraint *roll = &scene->constraints[scene->constraint_count - 1];
    struct constraint *own = &scene->constraints[scene->constraint_count++];
    *own = *roll;
    own->kind = constraint_resistance;
    own->mu_s = own->mu_k = keys->resistance;
    own->surface_speed = (struct value){0};
}

/* The friction of a gear of efficiency eta is a moment on its first wheel of at most (1/eta - 1) r |F|, with the force F
 * of the teeth: while that wheel drives, its moment is F r/eta, of which F r passes; while the second one drives,
 * (2 - 1/eta) F r remains, and nothing where eta is below 1/2, as in a worm gear. */
static bool add_gear_friction(struct reader *reader, const struct chosen *chosen,
                              const struct coupling_keys *keys)
{
    struct scene *scene = reader->scene;
    const struct pair *given = node_find(chosen->node, "efficiency");
    if (chosen->kind->value != coupling_constraint + constraint_gear || !given || keys->efficiency == 1)
        return true;
    if (!fields_exclude(reader, chosen->node, "efficiency", "from",
                        "its friction would take its share of the impact at the begin"))
        return false;
    const struct constraint *gear = &scene->constraints[scene->constraint_count - 1];
    const struct motion *motion = &scene->bodies[gear->body[0]].motion;
    if (keys->efficiency > 1) {
        diag_add(reader->errors, FBD_ERROR, "out-of-range", given->value->at, "0.95 loses 5 % of the power",
                 "`efficiency` must be at most 1");
        return false;
    }
    if (!motion_joint(motion)->has_axis) {
        diag_add(reader->errors, FBD_ERROR, "not-here", given->at,
                 "let the first of `between` be a body on a pivot, in whose bearing the moment of the "
                 "friction acts",
                 "the first wheel of a gear with `efficiency` turns on a `pivot`");
        return false;
    }
    struct constraint *own = &scene->constraints[scene->constraint_count++];
    *own = *gear;
    own->kind = constraint_resistance;
    own->body[1] = motion->parent;
    own->point[1] = (struct point){.kind = point_fixed, .at = own->at};
    own->radius[0] = fabs(gear->radius[0]);
    own->radius[1] = 0;
    own->mu_s.expr = own->mu_k.expr =
        expr_constant(reader->arena, (1 / keys->efficiency - 1) * own->radius[0], DIM_LENGTH);
    return own->mu_s.expr != NULL;
}

static bool read_constraint(struct reader *reader, const struct chosen *chosen,
                            const struct coupling_keys *keys, struct constraint *constraint)
{
    constraint->kind = (enum constraint_kind)(chosen->kind->value - coupling_constraint);
    constraint->at = chosen->at;
    constraint->length = keys->length;
    constraint->length_given = keys->length > 0;
    constraint->lifetime = lifetime_of(reader, keys->since, keys->until);
    if (!constraint_laws[constraint->kind].read(reader, keys, constraint)) return false;
    place_slips(reader, constraint);
    const struct node *when = keys->until ? keys->until : keys->since;
    if (!when || !constraint_laws[constraint->kind].strands) return true;
    diag_add(reader->errors, FBD_ERROR, "not-here", when->at,
             "let a `rod` or a `rope` without `around` begin or end, which carries the same load",
             "a belt, and a rope with friction on a drum, cannot begin or end during a run");
    return false;
}

/* ---- forces */

static bool read_between(struct reader *reader, const struct node *list, struct force_coupling *coupling)
{
    if (!list) return false; /* noted before */
    if (list->count != 2) {
        diag_add(reader->errors, FBD_ERROR, "wrong-type", list->at, "write [a.P, b.Q]",
                 "`between` needs two ends, not %zu", list->count);
        return false;
    }
    bool first =
        coupling_end_read(reader, list->items[0], "between", &coupling->body[0], &coupling->point[0]);
    bool second =
        coupling_end_read(reader, list->items[1], "between", &coupling->body[1], &coupling->point[1]);
    if (!first || !second) return false;
    if (coupling->body[0] != coupling->body[1]) return true;
    diag_add(reader->errors, FBD_ERROR, "same-body", list->at, "name points of two bodies",
             "both ends are on the same body: nothing would act");
    return false;
}

/* ---- the list */

/* Read an entry of `couplings`; or of `contacts`, with its `pair`. */
static bool read_coupling(struct reader *reader, const struct node *node, const struct contact_pair *pair,
                          struct coupling_name *name)
{
    struct scene *scene = reader->scene;
    struct chosen chosen = {contact_kind, node, node->at};
    struct coupling_keys keys = {0};
    if (!pair && !kind_read(reader, &coupling_kinds, node, "couplings", &chosen)) return false;
    struct names names = {.reader = reader,
                          .place = chosen.kind == contact_kind ? place_contact : place_event,
                          .body = ground_body};
    struct scope scope = names_scope(&names);
    bool fine = fields_read(reader, chosen.kind->group, chosen.node, chosen.at, &scope, &keys);
    keys.terms = chosen.node;
    if (pair && pair->between) keys.between = pair->between;
    if (pair && pair->name) keys.name = pair->name;
    *name = (struct coupling_name){keys.name, chosen.kind, chosen.at, {ground_body, ground_body}};
    if (chosen.kind->value >= coupling_constraint) {
        /* `slip` refers to the next constraint by its number: count that only after both coefficients are
         * read. */
        if (!fine || !share_friction(reader, chosen.node, &scope, &keys)) return false;
        struct constraint *constraint = &scene->constraints[scene->constraint_count++];
        if (!read_constraint(reader, &chosen, &keys, constraint)) return false;
        name->body[0] = constraint->body[0];
        name->body[1] = constraint->body[constraint->end_count - 1];
        add_resistance(scene, &keys);
        return add_gear_friction(reader, &chosen, &keys);
    }
    struct force_coupling *coupling = &scene->force_couplings[scene->force_coupling_count++];
    coupling->load = (struct load){.kind = (enum load_kind)chosen.kind->value,
                                   .at = chosen.at,
                                   .stiffness = keys.stiffness,
                                   .free_length = keys.free_length,
                                   .coefficient = keys.coefficient};
    coupling->load.law = chosen.kind->law;
    coupling->load.lifetime = lifetime_of(reader, keys.since, keys.until);
    fine = (chosen.kind->law ? actuator_read(reader, &chosen, &names, &keys, coupling)
                             : read_between(reader, keys.between, coupling)) &&
           fine;
    for (int end = 0; end < 2; end++) name->body[end] = coupling->body[end];
    return fine;
}

static bool read_list(struct reader *reader, const struct node *list, struct coupling_name *names)
{
    bool fine = true;
    for (size_t i = 0; list && i < list->count; i++)
        if (!read_coupling(reader, list->items[i], NULL, &names[i])) fine = false;
    return fine;
}

/* An error in an entry with `among` is one of all of its pairs: the first one notes it. */
static bool read_pairs(struct reader *reader, const struct contact_pairs *list, struct coupling_name *names)
{
    const struct node *wrong = NULL;
    for (size_t i = 0; i < list->count; i++) {
        const struct contact_pair *pair = &list->pairs[i];
        if (pair->entry != wrong && !read_coupling(reader, pair->entry, pair, &names[i])) wrong = pair->entry;
    }
    return !wrong;
}

/* The points of a body on a plane have its name with their numbers. Returns the next constraint. */
static size_t name_points(struct reader *reader, size_t index, const char *name)
{
    struct constraint *first = &reader->scene->constraints[index];
    for (int k = 0; k < first->points; k++) first[k].name = arena_printf(reader->arena, "%s_%d", name, k + 1);
    return index + (size_t)first->points;
}

/* The name of a constraint; that of its rolling resistance, or friction, follows from it. Returns the next constraint. */
static size_t name_constraint(struct reader *reader, size_t index, const char *name)
{
    struct scene *scene = reader->scene;
    if (scene->constraints[index].points > 1) return name_points(reader, index, name);
    scene->constraints[index++].name = name;
    if (index == scene->constraint_count || scene->constraints[index].kind != constraint_resistance)
        return index;
    const bool gear = scene->constraints[index - 1].kind == constraint_gear;
    scene->constraints[index].name =
        arena_printf(reader->arena, "%s.%s", name, gear ? "friction" : "resistance");
    return index + 1;
}

/* The names of points are made: is none of them that of another coupling? */
static bool points_have_own_names(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    for (size_t i = 0; i < scene->constraint_count; i++) {
        const struct constraint *point = &scene->constraints[i];
        for (size_t j = 0; point->points > 1 && j < scene->constraint_count; j++) {
            const char *other = scene->constraints[j].name;
            if (j == i || !point->name || !other || strcmp(point->name, other) != 0) continue;
            diag_add(reader->errors, FBD_ERROR, "duplicate-name", scene->constraints[j].at,
                     "choose another name", "a point of `plane_friction` is called `%s` already",
                     point->name);
            return false;
        }
    }
    return true;
}

/* The number of points in a list, beyond the first of each entry. */
static size_t count_points(const struct node *couplings)
{
    size_t count = 0;
    for (size_t i = 0; couplings && i < couplings->count; i++) {
        const struct node *entry = couplings->items[i];
        const struct node *keys = entry->kind == node_map && entry->count == 1 ? entry->pairs[0].value : NULL;
        const struct pair *points = keys && keys->kind == node_map ? node_find(keys, "points") : NULL;
        if (points && points->value->kind == node_list) count += points->value->count;
    }
    return count;
}

/* Name all constraints and forces, in the order of the names. */
static bool name_all(struct reader *reader, struct coupling_name *names, size_t count)
{
    size_t load = 0, constraint = 0;
    if (!couplings_name(reader, names, count)) return false;
    for (size_t i = 0; i < count; i++) {
        bool force = names[i].kind->value < coupling_constraint;
        if (force)
            reader->scene->force_couplings[load++].load.name = names[i].name;
        else
            constraint = name_constraint(reader, constraint, names[i].name);
    }
    return points_have_own_names(reader);
}

bool couplings_read(struct reader *reader, const struct node *couplings, const struct node *contacts)
{
    struct scene *scene = reader->scene;
    struct contact_pairs pairs = {0};
    size_t first = couplings ? couplings->count : 0, stops = stops_count(reader), most;
    if (!contact_pairs_count(reader, contacts, &most)) return false;
    const size_t room = first + most + stops;
    scene->force_couplings = ARENA_ARRAY(reader->arena, room, struct force_coupling);
    scene->constraints = ARENA_ARRAY(reader->arena, 2 * room + count_points(couplings), struct constraint);
    pairs.pairs = ARENA_ARRAY(reader->arena, most, struct contact_pair);
    struct coupling_name *names = ARENA_ARRAY(reader->arena, room, struct coupling_name);
    if (!scene->force_couplings || !scene->constraints || !pairs.pairs || !names) return false;
    bool fine = read_list(reader, couplings, names);
    if (!contact_pairs_list(reader, contacts, &pairs)) fine = false;
    if (!read_pairs(reader, &pairs, names + first)) fine = false;
    if (!stops_read(reader, names + first + pairs.count)) fine = false;
    return fine && name_all(reader, names, first + pairs.count + stops);
}
