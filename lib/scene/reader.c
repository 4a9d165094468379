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

/* The joint type that the file names, which may not have been read yet; NULL if there is none of that name. */
static const struct joint_type *joint_in_file(const struct reader *reader, int body)
{
    const struct node *node = reader->drafts[body].node;
    const struct pair *motion = node ? node_find(node, "motion") : NULL;
    const struct node *kind = motion ? motion->value : NULL;
    const char *name = !kind                                       ? NULL
                       : kind->kind == node_scalar                 ? kind->text
                       : kind->kind == node_map && kind->count > 0 ? kind->pairs[0].key
                                                                   : NULL;
    for (int i = 0; name && i < motion_kinds_count; i++)
        if (strcmp(joint_types[i].name, name) == 0) return &joint_types[i];
    return NULL;
}

bool body_has_coordinate(const struct reader *reader, int body, const char *name)
{
    const struct joint_type *joint = joint_in_file(reader, body);
    for (int i = 0; joint && i < joint->count; i++) {
        const struct joint_coordinate *c = &joint->coordinates[i];
        if (strcmp(name, c->name) == 0 || strcmp(name, c->rate) == 0 || strcmp(name, c->rate_alias) == 0)
            return true;
    }
    return false;
}

bool own_states_name(const struct reader *reader, const char *name)
{
    return reader->scene->own_count > 0 && strncmp(name, "states.", strlen("states.")) == 0;
}
