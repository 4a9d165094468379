/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of drawn reactions in derivations: T for the tension of a rope denotes that reaction at all states,
 * not its value at the start.
 */
#include <stdint.h>
#include <string.h>

#include "base/arena.h"
#include "document/node_edit.h"
#include "document/scalar.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/lines.h"

/* Find a force by its name in derivations. */
static bool find(struct fbd_grade *grade, fbd_state *state, size_t b, const char *name,
                 fbd_named_force *found)
{
    if (!name || !fbd_state_named_force(state, b, name, found)) return false;
    if (found->force == SIZE_MAX) grade->arena.failed = true;
    return found->force != SIZE_MAX;
}

/* A component along an axis; NULL for another direction. */
static const char *component(struct arena *arena, const struct drawn *drawn)
{
    const double little = 1e-9;
    const struct vec u = drawn->along;
    const bool x = fabs(u.y) <= little * fabs(u.x), y = fabs(u.x) <= little * fabs(u.y);
    if (!x && !y) return NULL;
    return arena_printf(arena, "%s%s.%c", (x ? u.x : u.y) < 0 ? "-" : "", drawn->reaction, x ? 'x' : 'y');
}

/* The size of the force, or of the couple, by its name only. */
static const char *size_name(struct fbd_grade *grade, size_t b, fbd_state *state, const struct drawn *drawn)
{
    const size_t room = fbd_model_body(grade->sheet, b).most_forces;
    const bool couple = drawn->along.x == 0 && drawn->along.y == 0;
    const char *name = drawn->reaction;
    fbd_named_force force;
    bool found = find(grade, state, b, name, &force);
    if (!found && couple) {
        name = arena_printf(&grade->arena, "%s.moment", name);
        found = find(grade, state, b, name, &force);
    }
    if (!found || (force.moment && !couple)) return NULL;
    fbd_listed_force *forces = ARENA_ARRAY(&grade->arena, room + 1, fbd_listed_force);
    if (!forces || fbd_state_forces(state, b, forces, room) == SIZE_MAX) {
        grade->arena.failed = true;
        return NULL;
    }
    const fbd_arrow *arrow = &forces[force.force].arrow;
    const double along = arrow->fx * drawn->along.x + arrow->fy * drawn->along.y;
    const double drawn_size = couple ? arrow->couple : along;
    if (!(fabs(force.value) > 0) || !isfinite(force.value)) return NULL;
    return arena_printf(&grade->arena, "%s%s", force.value * drawn_size < 0 ? "-" : "", name);
}

void drawn_find_forces(struct fbd_grade *grade)
{
    fbd_state *state = NULL;
    for (struct drawn *one = grade->drawn; one; one = one->next) {
        if (!one->reaction) continue;
        if (!state) state = grade_start(grade->sheet);
        if (!state) grade->arena.failed = true;
        for (size_t b = 0; state && b < fbd_model_body_count(grade->sheet); b++) {
            fbd_named_force force;
            if (strcmp(fbd_model_body_name(grade->sheet, b), one->body) != 0) continue;
            one->force = size_name(grade, b, state, one);
            const char *part = one->force ? NULL : component(&grade->arena, one);
            if (part && find(grade, state, b, part + (*part == '-'), &force)) one->force = part;
        }
    }
    fbd_state_free(state);
}

/* True if the name is not that of a parameter or another object of the files. */
static bool may_be_symbol(const struct fbd_grade *grade, const struct node *answer, const char *name)
{
    static const char *const maps[] = {"parameters", "inputs", "states", "tables"};
    for (size_t i = 0; name && i < sizeof maps / sizeof *maps; i++)
        if (node_find(lines_value(grade->key->root, maps[i]), name) ||
            node_find(lines_value(answer, maps[i]), name))
            return false;
    return name && fbd_is_name(name) && !name_is_of_equations(name);
}

/* T: cord, of the body itself or of another one. */
static const struct node *with_symbol(struct fbd_grade *grade, const struct node *answer,
                                      const struct node *map, const char *name, const struct drawn *drawn,
                                      const char *body, struct pos at)
{
    struct arena *arena = &grade->arena;
    const bool own = strcmp(drawn->body, body) == 0, minus = *drawn->force == '-';
    if (!may_be_symbol(grade, answer, name) || (node_find(map, name) && !own)) return map;
    const char *text = arena_printf(arena, "%s%s%s%s", minus ? "-" : "", own ? "" : drawn->body,
                                    own ? "" : ".", drawn->force + minus);
    const struct node *value = text ? node_text(arena, text, at) : NULL;
    return value ? node_with(arena, map, name, value) : NULL;
}

const struct node *drawn_symbols(struct fbd_grade *grade, const struct node *answer, const char *body,
                                 struct pos at)
{
    const struct node *map = node_empty_map(&grade->arena);
    for (const struct drawn *one = grade->drawn; map && one; one = one->next) {
        if (!one->force) continue;
        map = with_symbol(grade, answer, map, one->symbol, one, body, at);
        if (map && one->name) map = with_symbol(grade, answer, map, one->name, one, body, at);
    }
    return map && map->count > 0 ? map : NULL;
}
