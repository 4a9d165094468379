/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/programs.h"

#include <stdint.h>

static bool same_site(const struct program_site *a, const struct program_site *b)
{
    return a->node == b->node && a->place == b->place && a->body == b->body &&
           dim_equal(a->want.dim, b->want.dim) && a->want.any_dim == b->want.any_dim &&
           a->want.constant == b->want.constant && a->want.condition == b->want.condition;
}

/* The entry of a site, or the free entry for it: open addressing with Fibonacci hashing of the node's address
 * (Knuth, The Art of Computer Programming 3, 6.4). */
static struct program *locate(const struct programs *programs, const struct program_site *site)
{
    uint64_t hash = (uint64_t)(uintptr_t)site->node * UINT64_C(0x9E3779B97F4A7C15) >> 32;
    for (size_t i = (size_t)hash & (programs->room - 1);; i = (i + 1) & (programs->room - 1)) {
        struct program *program = &programs->table[i];
        if (!program->site.node || same_site(&program->site, site)) return program;
    }
}

const struct program *programs_find(const struct programs *programs, const struct program_site *site)
{
    if (!programs || programs->room == 0) return NULL;
    const struct program *program = locate(programs, site);
    return program->site.node ? program : NULL;
}

/* Double the table. Old tables stay in the arena: together they are no larger than the last. */
static bool grow(struct programs *programs)
{
    const struct programs old = *programs;
    size_t room = old.room ? 2 * old.room : 64;
    struct program *table = ARENA_ARRAY(&programs->arena, room, struct program);
    if (!table) return false;
    programs->table = table;
    programs->room = room;
    for (size_t i = 0; i < old.room; i++)
        if (old.table[i].site.node) *locate(programs, &old.table[i].site) = old.table[i];
    return true;
}

void programs_keep(struct programs *programs, const struct program *program)
{
    if (2 * (programs->count + 1) > programs->room && !grow(programs)) return;
    *locate(programs, &program->site) = *program;
    programs->count++;
}

void programs_free(struct programs *programs)
{
    arena_free(&programs->arena);
}
