/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of the couplings: the given name; or the kind, if only one of that kind has no name; else the kind
 * with the names of its bodies, `rod_crank_slider`, for all of them, numbered if that is taken, too. Used
 * names are kept sorted: a scene may have a hundred thousand couplings, and as many forces whose names are
 * not available.
 */
#include "scene/coupling_names.h"

#include <stdlib.h>
#include <string.h>

static const char *const reactions[] = {"pin", "guide", "weld"};
enum { reaction_count = sizeof reactions / sizeof *reactions };

/* A used name, with the index of its coupling; -1 for a force of a body, which takes precedence over
 * couplings. */
struct taken {
    const char *name;
    ptrdiff_t index;
};

struct taken_names {
    struct taken *names;
    size_t count;
};

static int compare(const void *a, const void *b)
{
    const struct taken *p = a, *q = b;
    int order = strcmp(p->name, q->name);
    return order != 0 ? order : (p->index > q->index) - (p->index < q->index);
}

static int compare_key(const void *key, const void *element)
{
    return strcmp(key, ((const struct taken *)element)->name);
}

/* Names of joint forces and of loads are not available for couplings. */
static bool collect(struct reader *reader, const struct coupling_name *given, size_t count,
                    struct taken_names *taken)
{
    const struct scene *scene = reader->scene;
    size_t room = reaction_count + count;
    for (size_t b = 0; b < scene->body_count; b++) room += scene->bodies[b].load_count + 1;
    *taken = (struct taken_names){ARENA_ARRAY(reader->arena, room, struct taken), 0};
    if (!taken->names) return false;
    for (size_t i = 0; i < reaction_count; i++)
        taken->names[taken->count++] = (struct taken){reactions[i], -1};
    for (size_t b = 0; b < scene->body_count; b++)
        if (reader->drafts[b].motion_keys.prescribed) /* the force of a prescribed motion */
            taken->names[taken->count++] = (struct taken){"drive", -1};
    for (size_t b = 0; b < scene->body_count; b++)
        for (size_t i = 0; i < scene->bodies[b].load_count; i++)
            taken->names[taken->count++] = (struct taken){scene->bodies[b].loads[i].name, -1};
    for (size_t i = 0; i < count; i++)
        if (given[i].name) taken->names[taken->count++] = (struct taken){given[i].name, (ptrdiff_t)i};
    qsort(taken->names, taken->count, sizeof *taken->names, compare);
    return true;
}

static const struct taken *find(const struct taken_names *taken, const char *name)
{
    return bsearch(name, taken->names, taken->count, sizeof *taken->names, compare_key);
}

/* The first owner of a name: a force, or the first coupling with that name. */
static const struct taken *first_of(const struct taken_names *taken, const char *name)
{
    const struct taken *one = find(taken, name);
    while (one > taken->names && strcmp(one[-1].name, name) == 0) one--;
    return one;
}

static bool has_earlier_coupling(const struct taken_names *taken, const struct taken *first, ptrdiff_t index)
{
    const struct taken *end = taken->names + taken->count;
    const char *name = first->name;
    while (first < end && first->index < 0 && strcmp(first->name, name) == 0) first++;
    return first->index < index;
}

static bool check_given(struct reader *reader, const struct taken_names *taken,
                        const struct coupling_name *names, size_t i)
{
    const struct taken *first = first_of(taken, names[i].name);
    if (first->index == (ptrdiff_t)i) return true;
    bool twice = has_earlier_coupling(taken, first, (ptrdiff_t)i);
    diag_add(reader->errors, FBD_ERROR, "duplicate-name", names[i].at, "choose another name",
             twice ? "two couplings are called `%s`" : "a force of a body is called `%s` already",
             names[i].name);
    return false;
}

/* ---- names for couplings without one */

static const char *body_name(const struct reader *reader, int body)
{
    return body == ground_body ? "ground" : reader->scene->bodies[body].name;
}

/* List `rod_crank_slider` for each coupling without a name, sorted by that base and then by file order. */
static bool list_bases(struct reader *reader, const struct coupling_name *names, size_t count,
                       struct taken_names *bases)
{
    *bases = (struct taken_names){ARENA_ARRAY(reader->arena, count, struct taken), 0};
    for (size_t i = 0; bases->names && i < count; i++) {
        if (names[i].name) continue;
        const char *base =
            arena_printf(reader->arena, "%s_%s_%s", names[i].kind->name, body_name(reader, names[i].body[0]),
                         body_name(reader, names[i].body[1]));
        if (!base) return false;
        bases->names[bases->count++] = (struct taken){base, (ptrdiff_t)i};
    }
    if (bases->count > 0) qsort(bases->names, bases->count, sizeof *bases->names, compare);
    return bases->names != NULL;
}

/* The base, or the base with the first free number. Numbered names of different bases never coincide. */
static const char *numbered(struct reader *reader, const char *base, int *number,
                            const struct taken_names *taken, const struct taken_names *bases)
{
    for (;;) {
        int n = ++*number;
        const char *name = n == 1 ? base : arena_printf(reader->arena, "%s_%d", base, n);
        if (!name || (!find(taken, name) && (n == 1 || !find(bases, name)))) return name;
    }
}

static bool name_by_bodies(struct reader *reader, struct coupling_name *names, size_t count,
                           const struct taken_names *taken)
{
    struct taken_names bases;
    int number = 0;
    if (!list_bases(reader, names, count, &bases)) return false;
    for (size_t k = 0; k < bases.count; k++) {
        const struct taken *base = &bases.names[k];
        if (k == 0 || strcmp(base->name, base[-1].name) != 0) number = 0;
        const char *name = numbered(reader, base->name, &number, taken, &bases);
        if (!name) return false;
        names[base->index].name = name;
    }
    return true;
}

/* True if it is the only one of its kind without a name. `unnamed`: their number by kind. */
static bool is_alone(const size_t *unnamed, const struct coupling_name *name)
{
    return !name->name && unnamed[name->kind - coupling_kinds.kinds] == 1;
}

bool couplings_name(struct reader *reader, struct coupling_name *names, size_t count)
{
    struct taken_names taken;
    size_t *unnamed = ARENA_ARRAY(reader->arena, coupling_kinds.count, size_t);
    if (!unnamed || !collect(reader, names, count, &taken)) return false;
    for (size_t i = 0; i < count; i++)
        if (names[i].name && !check_given(reader, &taken, names, i)) return false;
    for (size_t i = 0; i < count; i++)
        if (!names[i].name) unnamed[names[i].kind - coupling_kinds.kinds]++;
    for (size_t i = 0; i < count; i++)
        if (is_alone(unnamed, &names[i]) && !find(&taken, names[i].kind->name))
            names[i].name = names[i].kind->name;
    return name_by_bodies(reader, names, count, &taken);
}
