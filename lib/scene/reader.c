/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Searches in the tree of the file that evaluate nothing.
 */
#include "scene/reader.h"

#include <string.h>

/* Index of `name` in a mapping, which may be NULL; false if not found. */
static bool find_in(const struct node *map, const char *name, size_t *index)
{
    const struct pair *pair = map ? node_find(map, name) : NULL;
    if (pair) *index = (size_t)(pair - map->pairs);
    return pair != NULL;
}

bool parameters_find(const struct reader *reader, const char *name, size_t *index)
{
    if (find_in(reader->parameters, name, index)) return true;
    bool found = find_in(reader->inputs, name, index);
    if (found) *index += reader->parameters ? reader->parameters->count : 0;
    return found;
}

bool own_states_name(const struct reader *reader, const char *name)
{
    return reader->scene->own_count > 0 && strncmp(name, "states.", strlen("states.")) == 0;
}
