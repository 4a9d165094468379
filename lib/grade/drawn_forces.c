/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of drawn reactions in derivations: T for the tension of a rope denotes that reaction at all states,
 * not its value at the start.
 */
#include <string.h>

#include "base/arena.h"
#include "document/node_edit.h"
#include "document/scalar.h"
#include "fbd_grade.h"
#include "grade/lines.h"
#include "output/hand_forces.h"

static const struct hand_force *find(const struct hand_forces *forces, int body, const char *name)
{
    for (size_t i = 0; i < forces->count; i++) {
        const struct force_name *one = &forces->list[i].name;
        if (name && one->body == body && !one->letter && strcmp(one->name, name) == 0)
            return &forces->list[i];
    }
    return NULL;
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
static const char *size_name(struct fbd_grade *grade, const struct hand_forces *forces, int b,
                             const fbd_state *state, struct arrow *arrows, const struct drawn *drawn)
{
    const struct fbd_model *model = grade->sheet;
    const struct instant at = state_instant(state);
    const bool couple = drawn->along.x == 0 && drawn->along.y == 0;
    const struct hand_force *force = find(forces, b, drawn->reaction);
    if (!force && couple) force = find(forces, b, arena_printf(&grade->arena, "%s.moment", drawn->reaction));
    if (!force || (force->symbol->moment && !couple)) return NULL;
    diagram_fill(model, b, &at, state->a, state->slots, arrows);
    const double size = hand_force_value(model, force, &at, arrows);
    const struct arrow *arrow = &arrows[force->arrow];
    const double drawn_size = couple ? arrow->couple : vec_dot(arrow->force, drawn->along);
    if (!(fabs(size) > 0) || !isfinite(size)) return NULL;
    return arena_printf(&grade->arena, "%s%s", size * drawn_size < 0 ? "-" : "", force->name.name);
}

void drawn_find_forces(struct fbd_grade *grade)
{
    const struct fbd_model *model = grade->sheet;
    struct hand_forces forces = {0};
    fbd_state *state = NULL;
    struct arrow *arrows = ARENA_ARRAY(&grade->arena, diagram_most_arrows(model), struct arrow);
    for (struct drawn *one = grade->drawn; arrows && one; one = one->next) {
        if (!one->reaction) continue;
        if (!state) state = lines_start_of(model);
        if (!state || (!forces.list && !hand_forces_make(model, &grade->arena, &forces))) break;
        for (int b = 0; b < (int)model->body_count; b++) {
            if (strcmp(model->bodies[b].name, one->body) != 0) continue;
            one->force = size_name(grade, &forces, b, state, arrows, one);
            const char *part = one->force ? NULL : component(&grade->arena, one);
            if (part && find(&forces, b, part + (*part == '-'))) one->force = part;
        }
    }
    state_free(state);
}

/* True if the name is not that of a parameter or another object of the files. */
static bool may_be_symbol(const struct fbd_grade *grade, const struct node *answer, const char *name)
{
    static const char *const maps[] = {"parameters", "inputs", "states", "tables"};
    for (size_t i = 0; name && i < sizeof maps / sizeof *maps; i++)
        if (node_find(lines_value(grade->key->document.root, maps[i]), name) ||
            node_find(lines_value(answer, maps[i]), name))
            return false;
    return name && scalar_is_name(name) && !name_is_reserved(name) && !name_is_of_equations(name);
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
