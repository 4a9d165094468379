/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/tables.h"

#include <stdlib.h>
#include <string.h>

struct shared_table *shared_table_new(const char *name)
{
    struct shared_table *shared = calloc(1, sizeof *shared);
    char *copy = malloc(strlen(name) + 1);
    if (!shared || !copy) {
        free(shared);
        free(copy);
        return NULL;
    }
    memcpy(copy, name, strlen(name) + 1);
    shared->table.name = shared->name = copy;
    atomic_init(&shared->holders, 1);
    return shared;
}

struct shared_table *shared_table_hold(struct shared_table *shared)
{
    if (shared) atomic_fetch_add(&shared->holders, 1);
    return shared;
}

void shared_table_release(struct shared_table *shared)
{
    if (!shared || atomic_fetch_sub(&shared->holders, 1) > 1) return;
    table_drop(&shared->table);
    free(shared->name);
    free(shared);
}
