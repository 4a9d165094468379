/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/scene.h"

#include "document/node.h"
#include "scene/fields.h"
#include "scene/programs.h"
#include "scene/reader.h"
#include "scene/record.h"
#include "scene/values.h"

#include <stdlib.h>
#include <string.h>

/* ---- the top level */

static const struct node *mapping(const struct node *root, const char *key)
{
    const struct pair *pair = node_find(root, key);
    return pair && pair->value->kind == node_map ? pair->value : NULL;
}

/* The system of units, which is needed before any number is read; fields_read reports an invalid one. */
static enum unit_system find_units(const struct node *root)
{
    const struct pair *pair = node_find(root, "units");
    bool us = pair && pair->value->kind == node_scalar && strcmp(pair->value->text, "US") == 0;
    return us ? unit_us : unit_si;
}

/* Default gravity; textbooks in US units use 32.2 ft/s^2. */
static void start_gravity(struct reader *reader)
{
    const double si = 9.81, us = 32.2;
    const struct pair *pair = node_find(reader->root, "gravity");
    const double g = reader->scene->units == unit_us ? us : si;
    if (scene_is_horizontal(reader->root))
        reader->scene->pressing = g;
    else
        reader->scene->gravity = (struct vec){0, -g};
    reader->gravity = pair ? pair->value : NULL;
    reader->gravity_progress = !pair ? done : pair->value->kind == node_null ? failed : untouched;
}

static const double language_version = 1;

static void check_version(struct reader *reader, const struct scene_keys *keys)
{
    const struct pair *pair = node_find(reader->root, "fbd");
    if (!pair)
        diag_add(reader->errors, FBD_WARNING, "missing-version", reader->root->at,
                 "start the file with `fbd: 1`", "the file does not give the version of its language");
    else if (keys->version != language_version)
        diag_add(reader->errors, FBD_ERROR, "unsupported-version", pair->value->at, "write `fbd: 1`",
                 "this program reads version 1 of the model language, not %s",
                 value_found(reader, pair->value));
}

static bool read_top(struct reader *reader, struct scene_keys *keys)
{
    struct scene *scene = reader->scene;
    const struct pair *ground = node_find(reader->root, "ground");
    keys->version = language_version; /* stays where the value cannot be read */
    bool fine = fields_read(reader, &scene_group, reader->root, reader->root->at, &reader->constants, keys);
    check_version(reader, keys);
    scene->title = keys->title ? keys->title : "";
    scene->datum = keys->datum;
    if (keys->bodies && keys->bodies->count == 0) {
        diag_add(reader->errors, FBD_ERROR, "missing-value", keys->bodies->at,
                 "write `name: {mass: ..., motion: ...}`", "`bodies` is empty");
        fine = false;
    }
    gravity_symbol(reader, reader->root->at);
    parameters_finish(reader);
    tables_finish(reader);
    bool solid = ground_read(reader, keys->ground, ground ? ground->at : reader->root->at);
    return fine && solid;
}

/* ---- bodies */

/* True beyond the limit of notes: further ones are counted but not kept, so reading on is useless. */
static bool is_hopeless(const struct reader *reader)
{
    return reader->errors->errors > reader->errors->limit || reader->arena->failed;
}

static bool number_coordinates(struct reader *reader)
{
    struct scene *scene = reader->scene;
    scene->coordinates =
        ARENA_ARRAY(reader->arena, most_coordinates_of_a_body * scene->body_count, struct coordinate);
    if (!scene->coordinates) return false;
    for (size_t b = 0; b < scene->body_count; b++) {
        struct body *body = &scene->bodies[b];
        body->first = (int)scene->coordinate_count;
        if (!reader->drafts[b].motion_known) continue;
        body->count = motion_joint(&body->motion)->count;
        for (int i = 0; i < body->count; i++) {
            const struct joint_coordinate *of = &motion_joint(&body->motion)->coordinates[i];
            struct coordinate *coordinate = &scene->coordinates[scene->coordinate_count++];
            *coordinate = (struct coordinate){.body = (int)b,
                                              .name = of->name,
                                              .rate_name = of->rate,
                                              .acceleration_name = of->acceleration,
                                              .angle = of->angle};
            coordinate->dim = of->angle ? DIM_NONE : DIM_LENGTH;
            coordinate->rate_dim = of->angle ? DIM_RATE : DIM_VELOCITY;
        }
    }
    return true;
}

static void read_bodies(struct reader *reader)
{
    struct scene *scene = reader->scene;
    int count = (int)scene->body_count;
    for (int b = 0; b < count && !is_hopeless(reader); b++) {
        reader->inside = b;
        bool body = body_read(reader, b), motion = reader->drafts[b].node && body_motion_read(reader, b);
        scene->bodies[b].complete = body && motion;
    }
    reader->inside = ground_body;
    for (int b = 0; b < count && !is_hopeless(reader); b++)
        if (!body_parent_read(reader, b)) scene->bodies[b].complete = false;
    parents_check(reader);
    if (!number_coordinates(reader)) return;
    for (int b = 0; b < count && !is_hopeless(reader); b++) {
        reader->inside = b;
        bool initial = body_initial_read(reader, b), mass = body_mass_read(reader, b);
        bool loads = body_loads_read(reader, b);
        bool hand = reader->without_hands ||
                    (symbols_check(reader, reader->drafts[b].keys.symbols) && body_hand_read(reader, b));
        bool exact = reader->without_hands || body_exact_read(reader, b);
        bool prescribed = body_prescribed_read(reader, b);
        if (!initial || !mass || !loads || !hand || !exact || !prescribed) scene->bodies[b].complete = false;
    }
    reader->inside = ground_body;
    if (fbd_errors_failed_count(reader->errors) == 0) reactions_add(reader);
}

/* ---- the file */

static void read_scene(struct reader *reader, const struct override *overrides, size_t override_count)
{
    struct scene_keys keys = {0};
    reader->scene->units = find_units(reader->root);
    reader->parameters = mapping(reader->root, "parameters");
    reader->inputs = mapping(reader->root, "inputs");
    reader->tables = mapping(reader->root, "tables");
    reader->own = mapping(reader->root, "states");
    reader->bodies = mapping(reader->root, "bodies");
    reader->symbols = mapping(reader->root, "symbols");
    reader->constant_names = (struct names){.reader = reader, .place = place_constant, .body = ground_body};
    reader->constants = names_scope(&reader->constant_names);
    start_gravity(reader);
    if (!tables_start(reader) || !parameters_start(reader, overrides, override_count) ||
        !own_states_start(reader) || !bodies_start(reader))
        return;
    parameters_check_coordinates(reader);
    read_top(reader, &keys);
    symbols_check(reader, reader->symbols);
    read_bodies(reader);
    if (!is_hopeless(reader) && reader->scene->coordinates) own_states_read(reader);
    if (!is_hopeless(reader) && fbd_errors_failed_count(reader->errors) == 0) masses_start(reader);
    if (!is_hopeless(reader) && reader->bodies) couplings_read(reader, keys.couplings, keys.contacts);
    if (!is_hopeless(reader)) simulate_read(reader, &keys);
    if (!is_hopeless(reader)) grading_read(reader, keys.grading);
    if (fbd_errors_failed_count(reader->errors) > 0) return;
    lint_friction_note(reader);
    lint_effects_note(reader);
    parameters_note_unused(reader);
    tables_note_unused(reader);
}

static bool check_root(struct reader *reader)
{
    const struct node *root = reader->root;
    const char *hint = "a model starts with `fbd: 1` and has `bodies:`";
    if (root->kind == node_map) return true;
    if (root->kind == node_null)
        diag_add(reader->errors, FBD_ERROR, "empty-file", root->at, hint, "the file holds no model");
    else
        diag_add(reader->errors, FBD_ERROR, "wrong-type", root->at, hint,
                 "a model is a mapping of keys, and this file is %s", value_found(reader, root));
    return false;
}

static struct scene *new_scene(const char *file, fbd_errors *errors)
{
    struct scene *scene = calloc(1, sizeof *scene);
    if (!scene) {
        diag_out_of_memory(errors);
        return NULL;
    }
    scene->file = file ? arena_text(&scene->arena, file, strlen(file)) : NULL;
    return scene;
}

bool document_open(struct document *document, const char *text, size_t length, const char *file,
                   fbd_errors *errors)
{
    *document = (struct document){.file = file};
    diag_in_file(errors, file);
    document->root = node_open(&document->arena, text, length, errors);
    return document->root != NULL;
}

void document_close(struct document *document)
{
    if (document->programs) programs_free(document->programs);
    free(document->programs);
    scene_free(document->first);
    arena_free(&document->arena);
}

static const struct definition_readers definition_readers = {
    .parameter = parameter_symbol,
    .gravity = gravity_symbol,
    .state = own_state_symbol,
    .table = table_symbol,
};

static void start(struct reader *reader, const struct document *document, struct scene *scene,
                  struct programs *keep, struct record *record, fbd_errors *errors)
{
    struct arena *arena = &scene->arena;
    *reader = (struct reader){.scene = scene, .arena = arena, .errors = errors, .root = document->root};
    reader->inside = ground_body;
    reader->without_hands = document->without_hands;
    reader->split_hands = document->split_hands;
    reader->hand_reader = document->hand_reader;
    reader->force_names = document->force_names;
    reader->force_name_count = document->force_name_count;
    reader->definition_readers = &definition_readers;
    reader->known = document->programs;
    reader->keep = keep;
    reader->record = record;
    reader->exprs = record ? &record->exprs : arena;
    reader->derived = record ? &record->derived : arena;
    reader->tables_of = document->like ? document->like : document->first;
    reader->same_files = document->like != NULL;
    reader->same_parameters = document->same_parameters;
}

struct scene *scene_read_by(struct reader *reader, const struct document *document,
                            const struct override *overrides, size_t override_count, struct programs *keep,
                            struct record *record, fbd_errors *errors)
{
    const char *file = document->file;
    diag_in_file(errors, file);
    struct scene *scene = new_scene(file, errors);
    if (!scene) return NULL;
    start(reader, document, scene, keep, record, errors);
    if (check_root(reader)) read_scene(reader, overrides, override_count);
    data_text_free(&reader->data);
    if (scene->arena.failed || errors->arena.failed) diag_out_of_memory(errors);
    if (scene->coordinates && !errors->out_of_memory) return scene;
    scene_free(scene);
    return NULL;
}

bool document_prepare(struct document *document, const struct override *overrides, size_t override_count,
                      fbd_errors *errors)
{
    struct programs *programs = calloc(1, sizeof *programs);
    if (!programs) diag_out_of_memory(errors);
    struct reader reader;
    if (programs)
        document->first = scene_read_by(&reader, document, overrides, override_count, programs, NULL, errors);
    document->programs = programs;
    return document->first && fbd_errors_failed_count(errors) == 0;
}

struct scene *scene_make(const struct document *document, const struct override *overrides,
                         size_t override_count, fbd_errors *errors)
{
    struct reader reader;
    return scene_read_by(&reader, document, overrides, override_count, NULL, NULL, errors);
}

struct scene *scene_read(const char *text, size_t length, const char *file, const struct override *overrides,
                         size_t override_count, const struct scene *like, fbd_errors *errors)
{
    struct document document;
    bool open = document_open(&document, text, length, file, errors);
    document.like = like;
    document.same_parameters = like != NULL;
    struct scene *scene = open ? scene_make(&document, overrides, override_count, errors) : NULL;
    document_close(&document);
    return scene;
}

void scene_free(struct scene *scene)
{
    if (!scene) return;
    for (size_t i = 0; scene->tables && i < scene->table_count; i++)
        shared_table_release(scene->tables[i].shared);
    arena_free(&scene->arena);
    free(scene);
}
