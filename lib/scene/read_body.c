/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies: the first pass reads inertia and motion of each body, so that the coordinates of all bodies are
 * known when the second pass reads the loads.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <string.h>

bool bodies_start(struct reader *reader)
{
    struct scene *scene = reader->scene;
    size_t count = reader->bodies ? reader->bodies->count : 0;
    scene->body_count = count;
    scene->bodies = ARENA_ARRAY(reader->arena, count, struct body);
    reader->drafts = ARENA_ARRAY(reader->arena, count, struct draft);
    if (!scene->bodies || !reader->drafts) return false;
    for (size_t i = 0; i < count; i++) {
        const struct pair *pair = &reader->bodies->pairs[i];
        scene->bodies[i].name = arena_text(reader->arena, pair->key, strlen(pair->key));
        scene->bodies[i].at = pair->at;
        scene->bodies[i].motion.parent = ground_body;
        reader->drafts[i].node = pair->value->kind == node_map ? pair->value : NULL;
    }
    return !reader->arena->failed;
}

static bool check_body_name(struct reader *reader, const struct body *body)
{
    if (!name_check(reader->errors, body->name, body->at, "a body")) return false;
    static const char *const reserved[][2] = {
        {"t", "`t` cannot be a body: it is the time"},
        {"ground", "`ground` cannot be a body: the ground does not move"},
        {"energy", "`energy` cannot be a body: `energy.kinetic` is that of the scene"},
    };
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++) {
        if (strcmp(body->name, reserved[i][0]) != 0) continue;
        diag_add(reader->errors, FBD_ERROR, "reserved-name", body->at, "choose another name", "%s",
                 reserved[i][1]);
        return false;
    }
    return true;
}

/* True for a key of a body that is among the bodies by wrong indentation: `forces` in the column of `block`. */
static bool is_key_of_body(const struct pair *pair)
{
    const struct node *node = pair->value;
    if (!fields_has(&body_group, pair->key)) return false;
    for (size_t i = 0; node->kind == node_map && i < node->count; i++)
        if (fields_has(&body_group, node->pairs[i].key)) return false;
    return true;
}

static bool note_key_of_body(struct reader *reader, int index)
{
    const struct pair *pairs = reader->bodies->pairs, *owner = NULL;
    for (int i = 0; i < index; i++)
        if (!is_key_of_body(&pairs[i])) owner = &pairs[i];
    const char *hint = owner
                           ? diag_hint(reader->errors, "indent it one level further, below `%s`", owner->key)
                           : "indent it one level further, below the name of a body";
    diag_add(reader->errors, FBD_ERROR, "unknown-key", pairs[index].at, hint,
             "`%s` is a key of a body, but is here in the place of a body", pairs[index].key);
    return false;
}

/* ---- points of the body */

static bool is_special_point(const char *name)
{
    return strcmp(name, "G") == 0 || strcmp(name, "O") == 0;
}

/* Read the points given in the file; those of the shapes follow (read_part.c). */
static bool read_given_points(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    struct draft *draft = &reader->drafts[index];
    const struct node *map = draft->keys.points;
    bool fine = true;
    for (size_t i = 0; map && i < map->count; i++) {
        const struct pair *pair = &map->pairs[i];
        struct vec where;
        bool named = name_check(reader->errors, pair->key, pair->at, "a point");
        if (is_special_point(pair->key)) {
            diag_add(reader->errors, FBD_ERROR, "reserved-name", pair->at, "choose another name",
                     "`%s` cannot be a point of the file: it is %s", pair->key,
                     pair->key[0] == 'G' ? "the centre of mass" : "the pivot");
            named = false;
        }
        if (!value_vector(reader, pair->value, pair->key, a_length, &where) || !named) {
            fine = false;
            continue;
        }
        const char *name = arena_text(reader->arena, pair->key, strlen(pair->key));
        if (!name) return false;
        body->points[body->point_count++] = (struct named_point){name, where};
    }
    return fine;
}

/* ---- first pass */

static size_t most_points(const struct draft *draft)
{
    enum { points_of_a_shape = 3 }; /* left, right, G */
    size_t given = draft->keys.points ? draft->keys.points->count : 0;
    size_t parts = draft->keys.parts ? draft->keys.parts->count : 1;
    return given + points_of_a_shape * parts;
}

bool body_read(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    struct draft *draft = &reader->drafts[index];
    struct body_keys *keys = &draft->keys;
    const struct node *node = reader->bodies->pairs[index].value;
    body_parts_start(keys);
    if (is_key_of_body(&reader->bodies->pairs[index])) {
        draft->node = NULL;
        return note_key_of_body(reader, index);
    }
    bool fine = check_body_name(reader, body);
    if (!draft->node) {
        const char *hint = "write its keys below its name, indented: mass, motion, forces, ...";
        return value_refuse(reader, node, body->name, "a mapping", hint);
    }
    if (!fields_read(reader, &body_group, node, body->at, &reader->constants, keys)) fine = false;
    body->points = ARENA_ARRAY(reader->arena, most_points(draft), struct named_point);
    if (!body->points) return false;
    if (!read_given_points(reader, index)) fine = false;
    /* After the given points, before the motion: the pivot may be a point of a part. */
    draft->faulty_parts = !body_parts_read(reader, index);
    if (draft->faulty_parts) fine = false;
    return fine;
}
