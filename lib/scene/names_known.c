/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The names that an expression may use, for hints.
 */
#include <string.h>

#include "scene/names.h"
#include "scene/reader.h"

enum { most_known = 200 }; /* sufficient for a suggestion, and bounded for scenes of many bodies */

static void know(struct names *names, const char *name)
{
    if (name && names->known_count < most_known) names->known[names->known_count++] = name;
}

static void know_coordinates(struct names *names, int body, bool dotted)
{
    struct reader *reader = names->reader;
    if (!reader->drafts[body].motion_known) return;
    const struct joint_type *joint = motion_joint(&reader->scene->bodies[body].motion);
    const char *prefix = reader->scene->bodies[body].name;
    for (int i = 0; i < joint->count && names->known_count < most_known; i++) {
        const struct joint_coordinate *c = &joint->coordinates[i];
        know(names, dotted ? arena_printf(reader->arena, "%s.%s", prefix, c->name) : c->name);
        know(names, dotted ? arena_printf(reader->arena, "%s.%s", prefix, c->rate) : c->rate);
        if (!dotted && names->place == place_hand) know(names, c->acceleration);
    }
}

/* Forces of the diagram, and letters of their sizes. */
static void know_forces(struct names *names)
{
    const struct reader *reader = names->reader;
    for (size_t i = 0; i < reader->force_name_count; i++) {
        const struct force_name *force = &reader->force_names[i];
        const size_t length = strlen(force->name);
        const bool part = length > 2 && force->letter && force->name[length - 2] == '_' &&
                          (force->name[length - 1] == 'x' || force->name[length - 1] == 'y');
        if (force->body == names->body && !part && !strstr(force->name, ".at.")) know(names, force->name);
    }
}

static void know_all(struct names *names)
{
    static const char *const of_hand[] = {"m", "I_G", "I_O", "L", "N", "mu_s", "mu_k", "mu"};
    struct reader *reader = names->reader;
    bool constant = names->place == place_constant, moves = !constant && names->place != place_exact;
    know(names, names->curve);
    if (moves && names->body != ground_body) know_coordinates(names, names->body, false);
    if (names->place == place_hand) know_forces(names);
    for (size_t i = 0; i < reader->scene->parameter_count; i++)
        if (!constant || !reader->scene->parameters[i].input) know(names, reader->scene->parameters[i].name);
    know(names, "g");
    for (size_t i = 0; moves && i < reader->scene->own_count; i++)
        know(names, arena_printf(reader->arena, "states.%s", reader->scene->own[i].name));
    if (!constant) know(names, "t");
    if (names->place == place_load || names->place == place_exact) know(names, "m");
    if (names->slip != slip_unknown) know(names, "slip");
    if (names->distance_known) know(names, "distance");
    if (names->along) know(names, "s");
    if (names->place == place_contact) know(names, "approach");
    for (size_t i = 0; names->place == place_hand && i < sizeof of_hand / sizeof *of_hand; i++)
        if (hand_symbol(names, of_hand[i]).kind == symbol_variable) know(names, of_hand[i]);
    for (size_t i = 0; moves && i < reader->scene->body_count && names->known_count < most_known; i++)
        if ((int)i != names->body || names->place == place_event || names->place == place_contact)
            know_coordinates(names, (int)i, true);
}

size_t names_list(void *context, const char *const **list)
{
    struct names *names = context;
    if (!names->known) {
        names->known = ARENA_ARRAY(names->reader->arena, most_known, const char *);
        if (names->known) know_all(names);
    }
    *list = names->known;
    return names->known_count;
}

size_t names_list_tables(void *context, const char *const **list)
{
    const struct names *names = context;
    const struct scene *scene = names->reader->scene;
    const char **known = ARENA_ARRAY(names->reader->arena, scene->table_count, const char *);
    if (!known) return 0;
    for (size_t i = 0; i < scene->table_count; i++) known[i] = scene->tables[i].name;
    *list = known;
    return scene->table_count;
}
