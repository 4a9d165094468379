/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The names of the couplings: as given, or their kind, numbered where that is taken. Names that are taken are
 * kept sorted: a scene may have a hundred thousand couplings, and as many forces whose names they must not
 * bear.
 */
#include "scene/coupling_names.h"

#include <stdlib.h>
#include <string.h>

static const char *const reactions[] = {"pin", "guide", "weld"};
enum { reaction_count = sizeof reactions / sizeof *reactions };

/* A name that is taken, by the coupling `index`; a force that stands in the diagram of a body has it before
 * any coupling has. */
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

/* Forces of joints have their names, and so have the loads of the bodies: a coupling cannot be called so. */
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
        if (reader->drafts[b].motion_keys.prescribed) /* what a prescribed motion takes */
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

/* Who has the name first: a force, or the first of the couplings that give it. */
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

/* `spring`, `spring_2`, ...: the first from `*number` on that is free. */
static const char *next_name(struct reader *reader, const char *kind, int *number,
                             const struct taken_names *taken)
{
    for (;;) {
        int n = ++*number;
        const char *name = n == 1 ? kind : arena_printf(reader->arena, "%s_%d", kind, n);
        if (!name || !find(taken, name)) return name;
    }
}

bool couplings_name(struct reader *reader, struct coupling_name *names, size_t count)
{
    struct taken_names taken;
    int *numbers = ARENA_ARRAY(reader->arena, coupling_kinds.count, int);
    if (!numbers || !collect(reader, names, count, &taken)) return false;
    for (size_t i = 0; i < count; i++)
        if (names[i].name && !check_given(reader, &taken, names, i)) return false;
    for (size_t i = 0; i < count; i++) {
        int *number = &numbers[names[i].kind - coupling_kinds.kinds];
        if (!names[i].name) names[i].name = next_name(reader, names[i].kind->name, number, &taken);
        if (!names[i].name) return false;
    }
    return true;
}
