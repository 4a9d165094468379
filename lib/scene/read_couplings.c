/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings: connections of two bodies beside their joints. Each is declared once and appears in the diagrams
 * of both.
 */
#include "scene/coupling_names.h"
#include "scene/couplings.h"
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/slip_law.h"
#include "scene/values.h"

#include <string.h>

/* ---- ends: body.point, ground.point, or a body for its centre of mass */

const struct node *text_part(struct reader *reader, const struct node *whole, size_t from, size_t length)
{
    struct node *part = ARENA_ARRAY(reader->arena, 1, struct node);
    char *text = arena_text(reader->arena, whole->text + from, length);
    if (!part || !text) return NULL;
    *part = *whole;
    part->text = text;
    part->length = length;
    part->at.column += (int)from;
    return part;
}

bool coupling_end_read(struct reader *reader, const struct node *node, const char *what, int *body,
                       struct point *point)
{
    if (node->kind != node_scalar)
        return value_refuse(reader, node, what, "a point as `body.point` or `ground.point`", NULL);
    const char *dot = strchr(node->text, '.');
    size_t length = dot ? (size_t)(dot - node->text) : node->length;
    const struct node *owner = text_part(reader, node, 0, length);
    if (!dot && ground_end_refuse(reader, node, what, false)) return false;
    if (!owner || !body_name_read(reader, owner, what, body)) return false;
    if (!dot) {
        *point = (struct point){.kind = point_G, .at = node->at};
        return true;
    }
    const struct node *name = text_part(reader, node, length + 1, node->length - length - 1);
    if (!name) return false;
    if (*body != ground_body) return body_point_read(reader, *body, name, what, point);
    *point = (struct point){.kind = point_fixed, .at = node->at};
    return ground_point_read(reader, name, what, &point->where);
}

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

/* ---- constraints */

static bool add_end(struct reader *reader, const struct node *node, struct constraint *constraint)
{
    int k = constraint->end_count++;
    return coupling_end_read(reader, node, "between", &constraint->body[k], &constraint->point[k]);
}

static bool refuse_count(struct reader *reader, const struct node *list, const char *what, const char *hint)
{
    diag_add(reader->errors, FBD_ERROR, "wrong-type", list->at, hint, "`%s` has %zu entries", what,
             list->count);
    return false;
}

bool coupling_ends_read(struct reader *reader, const struct node *list, const char *what, size_t least,
                        size_t most, struct constraint *constraint)
{
    if (!list) return false; /* noted before */
    if (list->count < least || list->count > most)
        return refuse_count(reader, list, what,
                            least == most ? "write [a.P, b.Q]" : "between 2 and 8 places");
    bool fine = true;
    for (size_t i = 0; i < list->count; i++)
        if (!add_end(reader, list->items[i], constraint)) fine = false;
    bool moves = false, same = false;
    for (int k = 0; k < constraint->end_count; k++) {
        if (constraint->body[k] != ground_body) moves = true;
        if (k > 0 && constraint->body[k] != ground_body && constraint->body[k] == constraint->body[k - 1])
            same = true;
    }
    if (!fine || (moves && !same)) return fine;
    diag_add(reader->errors, FBD_ERROR, "same-body", list->at, "name points of two bodies",
             same || constraint->end_count == 2 ? "both ends are on the same body: nothing would act"
                                                : "every place of it is on the ground: nothing would act");
    return false;
}

const struct part *body_round_part(const struct body *body)
{
    for (size_t i = 0; i < body->part_count; i++)
        if (body->parts[i].radius > 0 && body->parts[i].mass > 0) return &body->parts[i];
    return NULL;
}

bool body_turns(const struct body *body)
{
    return body->motion.kind == motion_pivot || body->motion.kind == motion_planar ||
           body->motion.kind == motion_weld;
}

bool coupling_circle_set(struct reader *reader, struct constraint *constraint, int k, double radius)
{
    const struct body *body = &reader->scene->bodies[constraint->body[k]];
    const struct part *part = body_round_part(body);
    constraint->radius[k] = radius > 0 ? radius : part ? part->radius : 0;
    if (part) constraint->point[k] = (struct point){.kind = point_fixed, .where = part->center};
    if (constraint->radius[k] > 0 && body_turns(body)) return true;
    diag_add(reader->errors, FBD_ERROR, body_turns(body) ? "missing-key" : "not-here", constraint->at,
             body_turns(body) ? "give the radius, or the body a round `shape`" : "use `pivot` or `planar`",
             body_turns(body) ? "`%s` has no radius" : "`%s` does not turn", body->name);
    return false;
}

static bool needs_body(struct reader *reader, const struct constraint *constraint, int k)
{
    if (constraint->body[k] != ground_body) return true;
    diag_add(reader->errors, FBD_ERROR, "not-here", constraint->at, NULL,
             "the ground cannot be an end of this coupling");
    return false;
}

bool points_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    return coupling_ends_read(reader, keys->between, "between", 2, 2, constraint);
}

bool wheels_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    double radii[2] = {0, 0};
    if (!coupling_ends_read(reader, keys->between, "between", 2, 2, constraint)) return false;
    if (!needs_body(reader, constraint, 0) || !needs_body(reader, constraint, 1)) return false;
    if (keys->radii && keys->radii->count != 2)
        return refuse_count(reader, keys->radii, "radii", "one for each of the two");
    for (size_t k = 0; keys->radii && k < 2; k++)
        if (!value_number(reader, keys->radii->items[k], "radii", a_length, positive, &radii[k]))
            return false;
    for (int k = 0; k < 2; k++)
        if (!coupling_circle_set(reader, constraint, k, radii[k])) return false;
    if (keys->inside) constraint->radius[1] = -constraint->radius[1];
    constraint->crossed = keys->crossed;
    constraint->tension = keys->tension;
    return true;
}

bool rack_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    if (!coupling_ends_read(reader, keys->between, "between", 2, 2, constraint)) return false;
    if (!strchr(keys->between->items[1]->text, '.')) /* without a point: its x axis, not its centre of mass */
        constraint->point[1] = (struct point){.kind = point_fixed, .at = constraint->at};
    return needs_body(reader, constraint, 0) && needs_body(reader, constraint, 1) &&
           coupling_circle_set(reader, constraint, 0, keys->radius);
}

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

/* A rolling body without shape is drawn by the circle that rolls. */
static void set_rim(struct reader *reader, const struct constraint *constraint)
{
    struct body *body = &reader->scene->bodies[constraint->body[0]];
    struct part *part = &body->parts[0];
    const struct point *center = &constraint->point[0];
    if (body->part_count != 1 || part->shape != shape_given) return;
    part->rim = constraint->radius[0];
    part->hub = center->kind == point_fixed ? center->where : body_centre_of_mass(body);
}

/* `on` is a line of the ground, or a body: then the line is the x axis of its frame. */
bool roll_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    const struct node *on = keys->on;
    if (!body_name_read(reader, keys->body, "body", &constraint->body[0])) return false;
    constraint->end_count = 2;
    constraint->body[1] = ground_body;
    if (!needs_body(reader, constraint, 0) || !coupling_circle_set(reader, constraint, 0, keys->radius))
        return false;
    if (keys->center &&
        !body_point_read(reader, constraint->body[0], keys->center, "center", &constraint->point[0]))
        return false;
    set_rim(reader, constraint);
    constraint->point[1] = (struct point){.kind = point_fixed, .at = on->at};
    constraint->mu_s = keys->mu_s;
    constraint->mu_k = keys->mu_k;
    if (node_find(reader->bodies, on->text)) return body_name_read(reader, on, "on", &constraint->body[1]);
    const struct ground_line *line = ground_line_find(reader, on);
    if (!line) return false;
    constraint->point[1].where = line->through;
    constraint->along = line->along;
    return true;
}

static bool read_constraint(struct reader *reader, const struct chosen *chosen,
                            const struct coupling_keys *keys, struct constraint *constraint)
{
    constraint->kind = (enum constraint_kind)(chosen->kind->value - coupling_constraint);
    constraint->at = chosen->at;
    constraint->length = keys->length;
    constraint->length_given = keys->length > 0;
    const bool fine = constraint_laws[constraint->kind].read(reader, keys, constraint);
    if (fine) place_slips(reader, constraint);
    return fine;
}

/* ---- the list */

/* Read an entry of `couplings`, or of `contacts`. */
static bool read_coupling(struct reader *reader, const struct node *node, bool contact,
                          struct coupling_name *name)
{
    struct scene *scene = reader->scene;
    struct chosen chosen = {contact_kind, node, node->at};
    struct coupling_keys keys = {0};
    if (!contact && !kind_read(reader, &coupling_kinds, node, "couplings", &chosen)) return false;
    struct names names = {.reader = reader,
                          .place = chosen.kind == contact_kind ? place_contact : place_event,
                          .body = ground_body};
    struct scope scope = names_scope(&names);
    bool fine = fields_read(reader, chosen.kind->group, chosen.node, chosen.at, &scope, &keys);
    *name = (struct coupling_name){keys.name, chosen.kind, chosen.at, {ground_body, ground_body}};
    if (chosen.kind->value >= coupling_constraint) {
        /* `slip` refers to the next constraint by its number: count that only after both coefficients are
         * read. */
        if (!fine || !share_friction(reader, chosen.node, &scope, &keys)) return false;
        struct constraint *constraint = &scene->constraints[scene->constraint_count++];
        if (!read_constraint(reader, &chosen, &keys, constraint)) return false;
        name->body[0] = constraint->body[0];
        name->body[1] = constraint->body[constraint->end_count - 1];
        return true;
    }
    struct force_coupling *coupling = &scene->force_couplings[scene->force_coupling_count++];
    coupling->load = (struct load){.kind = (enum load_kind)chosen.kind->value,
                                   .at = chosen.at,
                                   .stiffness = keys.stiffness,
                                   .free_length = keys.free_length,
                                   .coefficient = keys.coefficient};
    if (!read_between(reader, keys.between, coupling)) return false;
    for (int end = 0; end < 2; end++) name->body[end] = coupling->body[end];
    return fine;
}

static bool read_list(struct reader *reader, const struct node *list, bool contact,
                      struct coupling_name *names)
{
    bool fine = true;
    for (size_t i = 0; list && i < list->count; i++)
        if (!read_coupling(reader, list->items[i], contact, &names[i])) fine = false;
    return fine;
}

bool couplings_read(struct reader *reader, const struct node *couplings, const struct node *contacts)
{
    struct scene *scene = reader->scene;
    size_t first = couplings ? couplings->count : 0, count = first + (contacts ? contacts->count : 0);
    size_t stops = stops_count(reader), load = 0, constraint = 0;
    count += stops;
    scene->force_couplings = ARENA_ARRAY(reader->arena, count, struct force_coupling);
    scene->constraints = ARENA_ARRAY(reader->arena, count, struct constraint);
    struct coupling_name *names = ARENA_ARRAY(reader->arena, count, struct coupling_name);
    if (!scene->force_couplings || !scene->constraints || !names) return false;
    bool fine = read_list(reader, couplings, false, names);
    if (!read_list(reader, contacts, true, names + first)) fine = false;
    if (!stops_read(reader, names + count - stops)) fine = false;
    if (!fine || !couplings_name(reader, names, count)) return false;
    for (size_t i = 0; i < count; i++) {
        bool force = names[i].kind->value < coupling_constraint;
        *(force ? &scene->force_couplings[load++].load.name : &scene->constraints[constraint++].name) =
            names[i].name;
    }
    return true;
}
