/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of the loads of a body: the given name, or the kind, numbered if that is taken.
 */
#include "scene/reader.h"

#include <stdlib.h>
#include <string.h>

struct given_name {
    const char *name;
    struct pos at;
};

static int compare(const void *a, const void *b)
{
    const struct given_name *p = a, *q = b;
    int order = strcmp(p->name, q->name);
    if (order != 0) return order;
    return p->at.line != q->at.line ? p->at.line - q->at.line : p->at.column - q->at.column;
}

static int compare_key(const void *key, const void *element)
{
    return strcmp(key, ((const struct given_name *)element)->name);
}

/* True for the name of the force of the body's joint, of its prescribed motion, or of the energy of its
 * varying mass. */
static bool is_of_joint(const struct reader *reader, int index, const char *name)
{
    const struct draft *draft = &reader->drafts[index];
    const char *force = motion_joint(&reader->scene->bodies[index].motion)->force;
    if (draft->mass_varies && strcmp(name, "mass") == 0) return true;
    if (!draft->motion_known) return false;
    if (draft->motion_keys.prescribed && strcmp(name, "drive") == 0) return true;
    return force && strcmp(name, force) == 0;
}

/* Check given names: each load is a column of the output beside the coordinates of its body. */
static bool check_given(struct reader *reader, int index, const struct given_name *names, size_t count)
{
    bool fine = true;
    for (size_t i = 0; i < count; i++) {
        if (is_of_joint(reader, index, names[i].name)) {
            diag_add(reader->errors, FBD_ERROR, "duplicate-name", names[i].at, "choose another name",
                     strcmp(names[i].name, "mass") == 0
                         ? "the energy of the mass of this body has the name `%s` already"
                         : "the force of the joint of this body is called `%s` already",
                     names[i].name);
            fine = false;
        }
        if (name_is_reserved(names[i].name)) {
            diag_add(reader->errors, FBD_ERROR, "reserved-name", names[i].at, "choose another name",
                     "`%s` cannot name a load: it is a coordinate or the time", names[i].name);
            fine = false;
        }
        if (i == 0 || strcmp(names[i].name, names[i - 1].name) != 0) continue;
        diag_add(reader->errors, FBD_ERROR, "duplicate-name", names[i].at, "choose another name",
                 "another load of this body is called `%s` already, in line %d", names[i].name,
                 names[i - 1].at.line);
        fine = false;
    }
    return fine;
}

/* The name of its law, and the row of its counter; a force and a moment of one name share the row of the
 * force. */
static const char *law_name(const struct load *load, size_t *row)
{
    const struct kinds *const all[] = {&force_kinds, &moment_kinds};
    const char *name = ""; /* the law is in one of the tables */
    for (int k = 0; k < 2 && !*name; k++)
        for (size_t i = 0; i < all[k]->count && !*name; i++)
            if (all[k]->kinds[i].law == load->law) name = all[k]->kinds[i].name;
    for (*row = 0; *row < force_kinds.count; (*row)++)
        if (strcmp(force_kinds.kinds[*row].name, name) == 0) break;
    return name;
}

/* `applied`, `applied_2`, ...: the first from `*number` on that the file does not use. */
static const char *next_name(struct reader *reader, const char *kind, int *number,
                             const struct given_name *names, size_t count)
{
    for (;;) {
        int n = ++*number;
        const char *name = n == 1 ? kind : arena_printf(reader->arena, "%s_%d", kind, n);
        if (!name || count == 0 || !bsearch(name, names, count, sizeof *names, compare_key)) return name;
    }
}

bool body_loads_name(struct reader *reader, int index, const char *const *given, const struct pos *places)
{
    struct body *body = &reader->scene->bodies[index];
    struct given_name *names = ARENA_ARRAY(reader->arena, body->load_count, struct given_name);
    if (!names) return false;
    size_t count = 0;
    for (size_t i = 0; i < body->load_count; i++)
        if (given[i]) names[count++] = (struct given_name){given[i], places[i]};
    if (count > 0) qsort(names, count, sizeof *names, compare);
    bool fine = check_given(reader, index, names, count);
    int *numbers = ARENA_ARRAY(reader->arena, force_kinds.count + 1, int);
    if (!numbers) return false;
    for (size_t i = 0; i < body->load_count; i++) {
        struct load *load = &body->loads[i];
        size_t row;
        const char *kind = law_name(load, &row);
        load->name = given[i] ? given[i] : next_name(reader, kind, &numbers[row], names, count);
    }
    return fine && !reader->arena->failed;
}
