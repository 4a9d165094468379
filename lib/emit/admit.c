/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The scenes that can be written as C, and messages about unsupported elements of others.
 *
 * Two checks, so that additions to the language are not overlooked: the keys of the file, and the compiled
 * model, each compared with the elements that the other files of this room write.
 */
#include <assert.h>
#include <string.h>

#include "document/node.h"
#include "emit/emit.h"
#include "model/model.h"
#include "scene/language.h"

/* ---- the keys of the file */

struct words {
    const char *const *words;
    size_t count;
};

#define WORDS(...)                                                                                           \
    {                                                                                                        \
        (const char *const[]){__VA_ARGS__}, sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *)      \
    }

static const struct words top_keys =
    WORDS("fbd", "title", "description", "units", "gravity", "plane", "datum", "parameters", "tables",
          "ground", "bodies", "couplings", "contacts", "simulate", "output", "$schema", "grading");
static const struct words body_keys =
    WORDS("mass", "shape", "parts", "inertia", "points", "motion", "initial", "forces", "moments", "hand",
          "exact", "description", "length", "radius", "outer_radius", "inner_radius", "a", "b", "c", "axis",
          "center", "angle", "from", "to", "corners");
static const struct words motions = WORDS("slide", "pivot", "particle", "planar", "weld");
static const struct words motion_keys = WORDS("along", "through", "line", "on", "at", "point", "angle", "x",
                                              "theta", "min", "max", "restitution");
static const struct words initial_keys = WORDS("x", "y", "v", "vx", "vy", "theta", "omega", "assemble");
static const struct words load_keys =
    WORDS("name", "side", "two_sided", "static", "kinetic", "coefficient", "surface_speed", "value", "angle",
          "toward", "fx", "fy", "frame", "at", "stiffness", "free_length", "neutral", "to", "linear",
          "quadratic", "wind", "V");
static const struct words simulate_keys =
    WORDS("until", "tolerance", "accuracy", "method", "step", "every", "impacts", "events");
static const struct words event_keys = WORDS("when", "direction", "then", "stop", "name");

static bool is_known(const struct words *words, const char *word)
{
    for (size_t i = 0; i < words->count; i++)
        if (strcmp(words->words[i], word) == 0) return true;
    return false;
}

static void refuse(fbd_errors *errors, struct pos at, const char *what, const char *name)
{
    diag_add(errors, FBD_ERROR, "cannot-emit", at, "docs/emit-c.md lists the exceptions",
             "`--emit-c` does not know %s `%s`", what, name);
}

static void check_keys(const struct node *map, const struct words *known, const char *what,
                       fbd_errors *errors)
{
    for (size_t i = 0; map && map->kind == node_map && i < map->count; i++)
        if (!is_known(known, map->pairs[i].key)) refuse(errors, map->pairs[i].at, what, map->pairs[i].key);
}

static const struct node *value_of(const struct node *map, const char *key)
{
    const struct pair *pair = node_find(map, key);
    return pair ? pair->value : NULL;
}

/* Check the kind of an entry, with or without keys. */
static void check_kind(const struct node *entry, const struct words *kinds, const struct words *keys,
                       const char *what, fbd_errors *errors)
{
    if (entry->kind == node_scalar && !is_known(kinds, entry->text))
        refuse(errors, entry->at, what, entry->text);
    check_keys(entry, kinds, what, errors);
    for (size_t i = 0; entry->kind == node_map && i < entry->count; i++)
        check_keys(entry->pairs[i].value, keys, "the key", errors);
}

static void check_entries(const struct node *list, const struct words *kinds, const struct words *keys,
                          const char *what, fbd_errors *errors)
{
    if (list && list->kind != node_list) check_kind(list, kinds, keys, what, errors);
    for (size_t i = 0; list && list->kind == node_list && i < list->count; i++)
        check_kind(list->items[i], kinds, keys, what, errors);
}

enum { most_laws = 32 };

/* The names of the laws marked `written_as_c`. */
static struct words laws_written(const struct kinds *kinds, const char *names[static most_laws])
{
    size_t count = 0;
    assert(kinds->count <= most_laws);
    for (size_t i = 0; i < kinds->count; i++)
        if (kinds->kinds[i].law->written_as_c) names[count++] = kinds->kinds[i].name;
    return (struct words){names, count};
}

static void check_body(const struct node *body, fbd_errors *errors)
{
    const char *names[2][most_laws];
    const struct words forces = laws_written(&force_kinds, names[0]),
                       moments = laws_written(&moment_kinds, names[1]);
    check_keys(body, &body_keys, "the key", errors);
    check_entries(value_of(body, "motion"), &motions, &motion_keys, "the motion", errors);
    check_keys(value_of(body, "initial"), &initial_keys, "the key", errors);
    check_entries(value_of(body, "forces"), &forces, &load_keys, "the force", errors);
    check_entries(value_of(body, "moments"), &moments, &load_keys, "the moment", errors);
}

static void check_file(const struct fbd_model *model, fbd_errors *errors)
{
    struct document document;
    if (!document_open(&document, model->source, model->source_length, model->scene->file, errors)) {
        document_close(&document);
        return;
    }
    const struct node *root = document.root, *bodies = value_of(root, "bodies");
    const struct node *simulate = value_of(root, "simulate"), *events = value_of(simulate, "events");
    check_keys(root, &top_keys, "the key", errors);
    for (size_t b = 0; bodies && bodies->kind == node_map && b < bodies->count; b++)
        check_body(bodies->pairs[b].value, errors);
    check_keys(simulate, &simulate_keys, "the key", errors);
    for (size_t i = 0; events && events->kind == node_list && i < events->count; i++)
        check_keys(events->items[i], &event_keys, "the key", errors);
    document_close(&document);
}

/* ---- the compiled model */

static void lacks(fbd_errors *errors, struct pos at, const char *missing, const char *name)
{
    diag_add(errors, FBD_ERROR, "cannot-emit", at, "docs/emit-c.md lists the exceptions",
             "`--emit-c` cannot write `%s`: %s", name, missing);
}

static void check_masses(const struct fbd_model *model, fbd_errors *errors)
{
    for (size_t b = 0; b < model->body_count; b++)
        if (model->bodies[b].varies)
            lacks(errors, model->bodies[b].source->mass.at, "a mass that varies", model->bodies[b].name);
}

static void check_loads(const struct fbd_model *model, fbd_errors *errors)
{
    for (size_t i = 0; i < model->load_count; i++) {
        const struct load *load = model->loads[i].source;
        if (i < model->coupled_count && load_law(load)->of_constraint)
            lacks(errors, load->at, "a load of a kind that is not known here", load->name);
        if (load->guided)
            lacks(errors, load->at, "a force between two bodies in a given direction (`along`)", load->name);
    }
}

static void check_switches(const struct fbd_model *model, fbd_errors *errors)
{
    for (size_t i = 0; i < model->plan.kink_count; i++) {
        const struct kink *kink = &model->plan.kinks[i];
        bool table = false;
        for (size_t k = 0; k < kink->count; k++) table = table || kink->formula.expr->switch_at[k].table;
        const char *name = kink->load < 0 ? "simulate.events" : model->loads[kink->load].source->name;
        struct pos at = kink->load < 0 ? (struct pos){0, 0} : model->loads[kink->load].source->at;
        if (table) lacks(errors, at, "tables of points", name);
        if (kink->slides && !table)
            lacks(errors, at, "motion along a switch, where its branches are mixed", name);
    }
}

static void check_friction(const struct fbd_model *model, fbd_errors *errors)
{
    enum { most_pairs = 6 };
    size_t rubbing = 0;
    for (size_t i = 0; i < model->plan.mode_count; i++) {
        const struct mode *mode = &model->plan.modes[i];
        const struct load *load = model->loads[mode->load].source;
        rubbing += mode_is_friction(mode);
        if (load->journal)
            lacks(errors, load->at, "bearing friction that depends on the reaction", load->name);
        if (mode->kind == mode_joint && mode->two_sided)
            lacks(errors, load->at, "friction in a guide between bodies that move on each other", load->name);
        if (mode_is_friction(mode) && rubbing == most_pairs + 1)
            lacks(errors, load->at, "all modes of more than six dry frictions would be tried in turn",
                  load->name);
    }
}

static void check_events(const struct fbd_model *model, fbd_errors *errors)
{
    for (size_t i = 0; i < model->plan.watch_count; i++) {
        const struct user_event *source = model->plan.watches[i].source;
        if (source->lifetime > 0)
            lacks(errors, source->at, "a force or coupling that begins or ends", source->name);
        else if (model->plan.watches[i].reacts)
            lacks(errors, source->at, "an event that names a reaction", source->name);
    }
}

/* An expression may name the acceleration of a body with a prescribed motion. */
static void check_places(const struct fbd_model *model, fbd_errors *errors)
{
    const struct scene *scene = model->scene;
    for (size_t k = 0; k < scene->absolute_count; k++) {
        const struct absolute *absolute = &scene->absolutes[k];
        const enum absolute_kind kind = absolute->kind;
        if (!absolute->moves ||
            !(kind == absolute_acceleration || kind == absolute_ax || kind == absolute_ay))
            continue;
        lacks(errors, scene->bodies[absolute->body].at, "an expression that names its acceleration",
              scene->bodies[absolute->body].name);
        return;
    }
}

static void check_calls(const struct fbd_model *model, fbd_errors *errors)
{
    for (size_t i = 0; i < model->scene->parameter_count; i++)
        if (input_varies(&model->scene->parameters[i].call))
            lacks(errors, model->scene->parameters[i].at, "an input that is no constant",
                  model->scene->parameters[i].name);
}

bool emit_admits(const struct fbd_model *model, fbd_errors *errors)
{
    const struct scene *scene = model->scene;
    size_t before = fbd_errors_failed_count(errors);
    diag_in_file(errors, scene->file);
    check_file(model, errors);
    for (size_t b = 0; b < scene->body_count; b++)
        if (model->bodies[b].inertia.mass == 0)
            refuse(errors, scene->bodies[b].at, "the body without mass", scene->bodies[b].name);
    for (size_t c = 0; c < scene->constraint_count; c++)
        lacks(errors, scene->constraints[c].at, constraint_laws[scene->constraints[c].kind].not_as_c,
              scene->constraints[c].name);
    for (size_t b = 0; b < scene->body_count; b++)
        if (scene->bodies[b].assemble)
            lacks(errors, scene->bodies[b].at, "a start that is found from couplings", scene->bodies[b].name);
    check_calls(model, errors);
    check_places(model, errors);
    check_events(model, errors);
    check_loads(model, errors);
    check_masses(model, errors);
    check_switches(model, errors);
    check_friction(model, errors);
    return fbd_errors_failed_count(errors) == before;
}
