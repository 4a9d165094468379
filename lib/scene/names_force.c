/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a derivation by hand may name of the accelerations of a body, and the forces and moments of its diagram. Which there are, only a compiled model has:
 * without their list a derivation with a name that is not known otherwise is left out, and read again (hand_forces.h).
 */
#include <string.h>

#include "scene/names.h"
#include "scene/reader.h"

static const struct symbol unknown = {.kind = symbol_unknown};

/* Is it this name, underscores apart? */
static bool is_letter(const char *letter, const char *name)
{
    for (;; letter++, name++) {
        while (*letter == '_') letter++;
        while (*name == '_') name++;
        if (*letter != *name) return false;
        if (!*letter) return true;
    }
}

static const struct force_name *find(const struct reader *reader, int body, const char *name)
{
    for (size_t i = 0; i < reader->force_name_count; i++) {
        const struct force_name *one = &reader->force_names[i];
        if (one->body == body && strcmp(one->name, name) == 0) return one;
    }
    for (size_t i = 0; i < reader->force_name_count; i++) {
        const struct force_name *one = &reader->force_names[i];
        if (one->body == body && one->letter && is_letter(one->name, name)) return one;
    }
    return NULL;
}

/* `body.name`, of another body. */
static const struct force_name *find_dotted(const struct reader *reader, const char *name)
{
    const char *dot = strchr(name, '.');
    for (size_t b = 0; dot && b < reader->scene->body_count; b++) {
        const char *body = reader->scene->bodies[b].name;
        if (body && strlen(body) == (size_t)(dot - name) && memcmp(body, name, (size_t)(dot - name)) == 0)
            return find(reader, (int)b, dot + 1);
    }
    return NULL;
}

struct symbol hand_place_symbol(const struct names *names, int body, const char *name)
{
    const struct body *owner = &names->reader->scene->bodies[body];
    struct absolute place = {.body = body, .point = {.kind = point_fixed}};
    const char *dot = strrchr(name, '.'), *last = dot ? dot + 1 : name;
    const bool x = strcmp(last, "a_x") == 0, y = strcmp(last, "a_y") == 0;
    if (!dot && strcmp(name, "angle_ddot") == 0) {
        place.kind = absolute_alpha;
    } else if (!dot && strncmp(name, "I_", 2) == 0) {
        place.kind = absolute_inertia;
        if (!names_point(owner, name + 2, strlen(name + 2), &place.point)) return unknown;
    } else if (x || y) {
        place.kind = x ? absolute_ax : absolute_ay;
        if (!names_point(owner, dot ? name : "G", dot ? (size_t)(dot - name) : 1, &place.point))
            return unknown;
    } else {
        return unknown;
    }
    return names_absolute(names->reader, place_hand, &place);
}

struct symbol force_symbol(const struct names *names, const char *name)
{
    struct reader *reader = names->reader;
    if (!reader->force_names) {
        reader->scene->hands_left = true;
        return (struct symbol){.kind = symbol_failed};
    }
    const struct force_name *one = find(reader, names->body, name);
    if (!one) one = find_dotted(reader, name);
    if (!one) return unknown;
    const char *own = arena_text(reader->arena, one->name, strlen(one->name));
    if (!own) return (struct symbol){.kind = symbol_failed};
    const struct absolute force = {.body = one->body,
                                   .point = {.kind = point_fixed},
                                   .kind = absolute_force,
                                   .force = own};
    struct symbol symbol = names_absolute(reader, place_hand, &force);
    symbol.dim = one->dim;
    return symbol;
}
