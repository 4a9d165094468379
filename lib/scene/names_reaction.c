/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of reactions in events: of couplings and contacts, springs and dampers, and joints.
 */
#include "scene/names.h"

#include "scene/reader.h"

#include <string.h>

static const struct symbol unknown = {.kind = symbol_unknown};
static const struct symbol failed_before = {.kind = symbol_failed};

static const char *const part_names[] = {"x", "y", "force", "tension", "normal", "friction", "moment"};
enum { part_count = sizeof part_names / sizeof *part_names };

/* -1 if there is none of that name. */
static int part_called(const char *name)
{
    for (int part = 0; part < part_count; part++)
        if (strcmp(name, part_names[part]) == 0) return part;
    return -1;
}

/* ---- couplings */

/* The reactions of each kind; a belt, and a rope on a rough drum, have a tension in each strand. */
static bool has_part(const struct constraint *constraint, enum reaction_part part)
{
    switch (constraint->kind) {
    case constraint_resistance:
    case constraint_belt:
    case constraint_capstan: return false;
    case constraint_rod:
    case constraint_rope: return part <= reaction_tension;
    case constraint_slot: return part <= reaction_force || part == reaction_normal;
    case constraint_roll:
    case constraint_groove:
    case constraint_contact: return part != reaction_tension && part != reaction_moment;
    case constraint_ratio: return part == (constraint->radius[0] > 0 ? reaction_moment : reaction_force);
    case constraint_weld: return part <= reaction_force || part == reaction_moment;
    default: return part <= reaction_force;
    }
}

static const char *list_parts(const struct names *names, const char *name,
                              const struct constraint *constraint)
{
    struct reader *reader = names->reader;
    const char *list = NULL;
    for (int part = 0; part < part_count; part++) {
        if (constraint ? !has_part(constraint, (enum reaction_part)part) : part > reaction_tension) continue;
        list = list ? arena_printf(reader->arena, "%s, `%s.%s`", list, name, part_names[part])
                    : arena_printf(reader->arena, "it has `%s.%s`", name, part_names[part]);
    }
    return list ? list : "name a coordinate or the time instead";
}

static struct symbol refuse(const struct names *names, const char *name, const char *part, struct pos at,
                            const struct constraint *constraint)
{
    const char *hint = list_parts(names, name, constraint);
    diag_add(names->reader->errors, FBD_ERROR, "unknown-name", at,
             diag_hint(names->reader->errors, "%s", hint), "the coupling `%s` has no reaction called `%s`",
             name, part);
    return failed_before;
}

/* A moment, or a force in a given direction. */
static struct symbol refuse_given(const struct names *names, const char *name, struct pos at)
{
    diag_add(names->reader->errors, FBD_ERROR, "unknown-name", at,
             "write its expression here; `force` on the line of its points has a `tension`",
             "the actuator `%s` has no reaction: its size is given", name);
    return failed_before;
}

static struct symbol of_constraint(const struct names *names, const struct constraint *constraint, int part)
{
    const struct scene *scene = names->reader->scene;
    const struct absolute reaction = {.body = constraint_first_body(constraint),
                                      .point = {.kind = point_fixed},
                                      .kind = absolute_reaction,
                                      .part = part,
                                      .roll = 1 + (int)(constraint - scene->constraints)};
    return names_absolute(names->reader, names->place, &reaction);
}

static struct symbol of_spring(const struct names *names, const struct force_coupling *coupling, int part)
{
    const struct absolute reaction = {.body = coupling->body[coupling->body[0] == ground_body],
                                      .point = {.kind = point_fixed},
                                      .kind = absolute_reaction,
                                      .part = part,
                                      .force = coupling->load.name};
    return names_absolute(names->reader, names->place, &reaction);
}

static bool is_called(const char *name, const char *text, size_t length)
{
    return name && strncmp(name, text, length) == 0 && name[length] == '\0';
}

/* A reaction elsewhere than in events. */
static struct symbol misplaced(const struct names *names, const char *name, struct pos at)
{
    diag_add(names->reader->errors, FBD_ERROR, "not-here", at,
             "write the law that causes it, as k*x of a spring; events (`when`, `until`, `from`) may name "
             "reactions",
             "`%s` is a reaction, which follows from the forces: no force may depend on it", name);
    return failed_before;
}

/* Has a list of the file an entry with this name? In `couplings` it stands behind its kind. */
static bool lists(const struct node *list, const char *name, size_t length)
{
    for (size_t i = 0; list && list->kind == node_list && i < list->count; i++) {
        const struct node *entry = list->items[i];
        const struct pair *own = entry->kind == node_map ? node_find(entry, "name") : NULL;
        if (entry->kind == node_map && !own && entry->count == 1 && entry->pairs[0].value->kind == node_map)
            own = node_find(entry->pairs[0].value, "name");
        if (own && own->value->kind == node_scalar && is_called(own->value->text, name, length)) return true;
    }
    return false;
}

static bool is_listed(const struct reader *reader, const char *name, size_t length)
{
    const struct pair *couplings = node_find(reader->root, "couplings"),
                      *contacts = node_find(reader->root, "contacts");
    return lists(couplings ? couplings->value : NULL, name, length) ||
           lists(contacts ? contacts->value : NULL, name, length);
}

struct symbol reaction_symbol(const struct names *names, const char *name, struct pos at)
{
    const struct scene *scene = names->reader->scene;
    const char *dot = strrchr(name, '.');
    const size_t length = (size_t)(dot - name);
    const int part = part_called(dot + 1);
    if (names->place == place_load && part >= 0 && is_listed(names->reader, name, length))
        return misplaced(names, name, at);
    if (names->place != place_event) return unknown;
    for (size_t i = 0; i < scene->constraint_count; i++) {
        const struct constraint *constraint = &scene->constraints[i];
        if (!is_called(constraint->name, name, length)) continue;
        if (part >= 0 && has_part(constraint, (enum reaction_part)part))
            return of_constraint(names, constraint, part);
        return refuse(names, constraint->name, dot + 1, at, constraint);
    }
    for (size_t i = 0; i < scene->force_coupling_count; i++) {
        const struct force_coupling *coupling = &scene->force_couplings[i];
        if (!is_called(coupling->load.name, name, length)) continue;
        if (coupling->load.kind == moment_applied || coupling->load.guided)
            return refuse_given(names, coupling->load.name, at);
        if (part >= 0 && part <= reaction_tension) return of_spring(names, coupling, part);
        return refuse(names, coupling->load.name, dot + 1, at, NULL);
    }
    return unknown;
}

/* The reactions of a spring or damper in the list of a body: with another end its force and tension (x and y are those of
 * the body); along or about the coordinate of the body the size of its force or moment. */
static bool load_has_part(const struct load *load, enum reaction_part part)
{
    switch (load->kind) {
    case load_spring:
    case load_damper:
        return part == reaction_force || (part == reaction_tension && load->anchor.kind != point_absent);
    case moment_spring:
    case moment_damper: return part == reaction_moment;
    default: return false; /* their size is given */
    }
}

struct symbol own_reaction_symbol(const struct names *names, const char *name)
{
    const int part = part_called(name);
    if (part < 0) return unknown;
    if (names->of) {
        if (!has_part(names->of, (enum reaction_part)part)) return unknown;
        return of_constraint(names, names->of, part);
    }
    if (names->of_coupling) {
        const struct load *load = &names->of_coupling->load;
        if (load->kind == moment_applied || load->guided || part > reaction_tension) return unknown;
        return of_spring(names, names->of_coupling, part);
    }
    if (!load_has_part(names->of_load, (enum reaction_part)part)) return unknown;
    const struct absolute reaction = {.body = names->body,
                                      .point = {.kind = point_fixed},
                                      .kind = absolute_reaction,
                                      .part = part,
                                      .force = names->of_load->name};
    return names_absolute(names->reader, names->place, &reaction);
}

/* ---- joints */

/* `pin.x` of a body on a pivot, unless it is a point of the body. */
static int part_of_pin(const struct body *body, const char *name)
{
    static const char pin[] = "pin.";
    struct point point;
    if (names_point(body, pin, strlen(pin) - 1, &point)) return -1;
    if (!motion_joint(&body->motion)->has_axis || strncmp(name, pin, strlen(pin)) != 0) return -1;
    const int part = part_called(name + strlen(pin));
    return part <= reaction_force ? part : -1;
}

/* A listed `normal` or `friction` of a body on a line or curve. */
static int part_of_guide(const struct body *body, const char *name)
{
    for (size_t i = 0; i < body->load_count; i++) {
        const struct load *load = &body->loads[i];
        if (!load->name || strcmp(load->name, name) != 0) continue;
        if (load->kind == load_normal) return reaction_normal;
        if (load->kind == load_friction) return reaction_friction;
    }
    return -1;
}

/* The name of an entry `normal` or `friction`; else NULL. */
static const char *name_of_guide(const struct node *entry)
{
    const struct pair *pair = entry->kind == node_map && entry->count == 1 ? &entry->pairs[0] : NULL;
    const char *kind = pair ? pair->key : entry->kind == node_scalar ? entry->text : "";
    if (strcmp(kind, "normal") != 0 && strcmp(kind, "friction") != 0) return NULL;
    const struct pair *own = pair && pair->value->kind == node_map ? node_find(pair->value, "name") : NULL;
    return own && own->value->kind == node_scalar ? own->value->text : kind;
}

/* Does the file list a normal force or friction of this name for the body, which may not be read yet? */
static bool lists_guide(const struct reader *reader, int body, const char *name)
{
    const struct node *keys = reader->bodies->pairs[body].value;
    const struct pair *forces = keys->kind == node_map ? node_find(keys, "forces") : NULL;
    const bool list = forces && forces->value->kind == node_list;
    const size_t count = list ? forces->value->count : forces != NULL;
    for (size_t i = 0; i < count; i++) {
        const char *own = name_of_guide(list ? forces->value->items[i] : forces->value);
        if (own && strcmp(own, name) == 0) return true;
    }
    return false;
}

struct symbol joint_reaction_symbol(const struct names *names, int body, const char *name, struct pos at)
{
    const struct body *owner = &names->reader->scene->bodies[body];
    if (names->place == place_load &&
        (lists_guide(names->reader, body, name) || part_of_pin(owner, name) >= 0))
        return misplaced(names, name, at);
    if (names->place != place_event) return unknown;
    int part = part_of_pin(owner, name);
    if (part < 0) part = part_of_guide(owner, name);
    if (part < 0) return unknown;
    const struct absolute reaction = {.body = body,
                                      .point = {.kind = point_fixed},
                                      .kind = absolute_reaction,
                                      .part = part};
    return names_absolute(names->reader, names->place, &reaction);
}
