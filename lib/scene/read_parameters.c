/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parameters, inputs and gravity: constants that are evaluated at their first use, so that they may stand in
 * any order. Definitions being evaluated are chained on the stack; naming one of them again is a circular
 * definition.
 */
#include "base/number.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Evaluation recurses once for each definition that stands after its use. The limit bounds the stack;
 * definitions in the order of their use do not recurse. */
enum { deepest_chain = 40 };

/* ---- names */

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Notes on a value from outside name the option instead of the file. */
static const char *enter_override(struct reader *reader, const struct override *override)
{
    const char *file = reader->errors->file;
    reader->errors->file = diag_hint(reader->errors, "--set %s", override->name);
    return file;
}

static size_t count_of(const struct node *map)
{
    return map ? map->count : 0;
}

static const struct pair *pair_of(const struct reader *reader, size_t index)
{
    size_t parameters = count_of(reader->parameters);
    return index < parameters ? &reader->parameters->pairs[index]
                              : &reader->inputs->pairs[index - parameters];
}

static void note_unknown_override(struct reader *reader, const struct override *override)
{
    size_t parameters = reader->scene->parameter_count, count = parameters + reader->scene->table_count;
    const char **names = ARENA_ARRAY(reader->arena, count, const char *);
    if (!names) return;
    for (size_t i = 0; i < count; i++)
        names[i] =
            i < parameters ? reader->scene->parameters[i].name : reader->scene->tables[i - parameters].name;
    qsort(names, count, sizeof *names, compare_names);
    const char *file = enter_override(reader, override);
    diag_add(reader->errors, FBD_ERROR, "unknown-parameter", (struct pos){0, 0},
             count ? diag_nearest(reader->errors, override->name, names, count)
                   : "the file has no `parameters` and no `inputs`",
             "the model has no parameter `%.40s` to set", override->name);
    reader->errors->file = file;
}

static struct table_draft *find_table(struct reader *reader, const char *name)
{
    const struct pair *pair = reader->tables ? node_find(reader->tables, name) : NULL;
    return pair ? &reader->table_drafts[pair - reader->tables->pairs] : NULL;
}

static bool apply_overrides(struct reader *reader, const struct override *overrides, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        size_t index;
        struct definition *definition =
            parameters_find(reader, overrides[i].name, &index) ? &reader->definitions[index] : NULL;
        struct table_draft *table = find_table(reader, overrides[i].name);
        if (table) {
            table->override = overrides[i].value ? &overrides[i] : NULL;
            table->varies = !overrides[i].value;
        } else if (definition) {
            definition->override = overrides[i].value ? &overrides[i] : NULL;
            definition->varies = !overrides[i].value || overrides[i].varies;
            reader->scene->parameters[index].call = overrides[i].call;
        } else {
            note_unknown_override(reader, &overrides[i]);
        }
    }
    return !reader->arena->failed;
}

static bool check_parameter_name(struct reader *reader, const struct pair *pair, bool input)
{
    const char *what = input ? "an input" : "a parameter";
    if (!name_check(reader->errors, pair->key, pair->at, what)) return false;
    if (input && reader->parameters && node_find(reader->parameters, pair->key)) {
        diag_add(reader->errors, FBD_ERROR, "duplicate-name", pair->at, "choose another name",
                 "a parameter is called `%s`, too", pair->key);
        return false;
    }
    const bool time = strcmp(pair->key, "t") == 0;
    if (!time && strcmp(pair->key, "pi") != 0) return true;
    diag_add(reader->errors, FBD_ERROR, "reserved-name", pair->at,
             diag_hint(reader->errors, "choose another name, such as `%s0`", pair->key),
             "`%s` cannot be %s: it is %s", pair->key, what, time ? "the time" : "the number 3.14...");
    return false;
}

void parameters_check_coordinates(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    for (size_t i = 0; i < scene->parameter_count; i++) {
        const struct parameter *parameter = &scene->parameters[i];
        const char *name = parameter->name, *noun = parameter->input ? "an input" : "a parameter";
        /* Outside of its block, too, the coordinates of the only body need no prefix. */
        const bool of_only = scene->body_count == 1 && body_has_coordinate(reader, 0, name);
        const bool noted = strcmp(name, "t") == 0 || strcmp(name, "pi") == 0;
        if (noted || (!of_only && !name_is_reserved(name))) continue;
        const char *hint = diag_hint(reader->errors, "choose another name, such as `%s0`", name);
        if (of_only)
            diag_add(reader->errors, FBD_ERROR, "reserved-name", parameter->at, hint,
                     "`%s` cannot be %s: it is a coordinate or rate of `%s`", name, noun,
                     scene->bodies[0].name);
        else
            diag_add(reader->errors, FBD_WARNING, "coordinate-name", parameter->at, hint,
                     "`%s` is %s here, and in other files a coordinate or rate", name, noun);
    }
}

/* Define one entry of `parameters` or `inputs`, without evaluating it. */
static void define(struct reader *reader, size_t index)
{
    const struct pair *pair = pair_of(reader, index);
    struct parameter *parameter = &reader->scene->parameters[index];
    struct definition *definition = &reader->definitions[index];
    parameter->name = arena_text(reader->arena, pair->key, strlen(pair->key));
    parameter->description = "";
    parameter->low = parameter->high = NAN;
    parameter->at = pair->at;
    parameter->input = index >= count_of(reader->parameters);
    definition->node = constant_read(reader, pair, parameter, &definition->range);
    if (!check_parameter_name(reader, pair, parameter->input) || !definition->node)
        definition->progress = failed;
}

bool parameters_start(struct reader *reader, const struct override *overrides, size_t count)
{
    struct scene *scene = reader->scene;
    scene->parameter_count = count_of(reader->parameters) + count_of(reader->inputs);
    scene->parameters = ARENA_ARRAY(reader->arena, scene->parameter_count, struct parameter);
    reader->definitions = ARENA_ARRAY(reader->arena, scene->parameter_count, struct definition);
    if (!scene->parameters || !reader->definitions) return false;
    for (size_t i = 0; i < scene->parameter_count; i++) define(reader, i);
    return apply_overrides(reader, overrides, count);
}

/* ---- evaluation */

void definition_note_circle(struct reader *reader, const char *name, struct pos at)
{
    char path[400] = "";
    size_t used = 0;
    const struct open_definition *names[deepest_chain + 1];
    int count = 0;
    for (const struct open_definition *o = reader->open; o && count <= deepest_chain; o = o->outer) {
        names[count++] = o;
        if (strcmp(o->name, name) == 0) break;
    }
    for (int i = count - 1; i >= 0 && used < sizeof path; i--) {
        int n = snprintf(path + used, sizeof path - used, "%.40s -> ", names[i]->name);
        used += n > 0 ? (size_t)n : 0;
    }
    diag_add(reader->errors, FBD_ERROR, "circular-parameter", at, "give one of them a value of its own",
             "parameters define one another in a circle: %s%.40s", path, name);
}

/* Enter the definition of `name`; false with a note when the chain is too long. */
bool definition_open(struct reader *reader, struct open_definition *open, const char *name, struct pos at)
{
    if (reader->open_depth == deepest_chain) {
        diag_add(reader->errors, FBD_ERROR, "parameter-chain", at, "write definitions before their use",
                 "more than %d definitions wait for `%s`", deepest_chain, name);
        return false;
    }
    *open = (struct open_definition){name, reader->open};
    reader->open = open;
    reader->open_depth++;
    return true;
}

void definition_close(struct reader *reader, const struct open_definition *open)
{
    reader->open = open->outer;
    reader->open_depth--;
}

static const struct expr *compile_parameter(struct reader *reader, const struct node *node, const char *name)
{
    struct value value;
    bool fine = value_formula(reader, node, name, a_parameter, stored, &reader->constants, &value);
    return fine ? value.expr : NULL;
}

/* Compile a value from outside: text without a position in the file. */
const struct expr *override_compile(struct reader *reader, const struct override *override)
{
    const struct node node = {.kind = override->value[0] ? node_scalar : node_null,
                              .size = 1,
                              .height = 1,
                              .text = override->value,
                              .length = strlen(override->value)};
    reader->outside = override;
    const struct expr *expr = compile_parameter(reader, &node, override->name);
    reader->outside = NULL;
    return expr;
}

/* Warn of a large bare number for a parameter that the file probably gives in a unit of angle: a pure number
 * that is not bare. */
static void warn_bare_angle(struct reader *reader, const struct parameter *parameter,
                            const struct override *override)
{
    const double one_turn = 6.283185307179586;
    if (fabs(parameter->value) <= one_turn) return;
    diag_add(reader->errors, FBD_WARNING, "bare-angle", (struct pos){0, 0},
             diag_hint(reader->errors, "write `%s=%.40s deg` if degrees are meant", parameter->name,
                       override->value),
             "`%s` is set to a bare number: %.40s rad if it is an angle", parameter->name, override->value);
}

/* Replace the value of the file by that of `expr`, of the same dimension or a bare number. */
static bool replace_value(struct reader *reader, struct parameter *parameter, const struct expr *expr,
                          const struct override *override)
{
    bool bare = expr_is_bare(expr);
    parameter->value = expr_value(expr);
    if (parameter->bare) {
        parameter->dim = expr_dim(expr);
        parameter->bare = bare;
        return true;
    }
    if (bare && dim_equal(parameter->dim, DIM_NONE)) warn_bare_angle(reader, parameter, override);
    if (bare || dim_equal(parameter->dim, expr_dim(expr))) return true;
    char given[64], wanted[64];
    unit_name(expr_dim(expr), reader->scene->units, given, sizeof given);
    unit_name(parameter->dim, reader->scene->units, wanted, sizeof wanted);
    diag_add(reader->errors, FBD_ERROR, "wrong-dimension", (struct pos){0, 0},
             diag_hint(reader->errors, "the file has it in %s", *wanted ? wanted : "pure numbers"),
             "`%s` cannot be set to `%.40s`: that is %s%s", parameter->name, override->value,
             *given ? "in " : "a pure number", given);
    return false;
}

static bool override_parameter(struct reader *reader, struct parameter *parameter,
                               const struct override *override)
{
    const char *file = enter_override(reader, override);
    const struct expr *expr = override_compile(reader, override);
    bool fine = expr && replace_value(reader, parameter, expr, override);
    reader->errors->file = file;
    return fine;
}

static bool evaluate(struct reader *reader, size_t index)
{
    struct parameter *parameter = &reader->scene->parameters[index];
    const struct definition *definition = &reader->definitions[index];
    bool outer = reader->names_parameters;
    reader->names_parameters = false;
    const struct expr *expr = compile_parameter(reader, definition->node, parameter->name);
    parameter->derived = reader->names_parameters;
    reader->names_parameters = outer;
    if (!expr) return false;
    parameter->value = expr_value(expr);
    parameter->dim = expr_dim(expr);
    parameter->bare = expr_is_bare(expr);
    return !definition->override || override_parameter(reader, parameter, definition->override);
}

static void resolve(struct reader *reader, size_t index, struct pos at)
{
    struct definition *definition = &reader->definitions[index];
    struct open_definition open;
    if (definition->progress != untouched) return;
    definition->progress = failed;
    if (!definition_open(reader, &open, reader->scene->parameters[index].name, at)) return;
    bool outer = reader->varies, outer_names = reader->names_varying;
    reader->varies = false;
    definition->progress = in_progress;
    definition->progress = evaluate(reader, index) ? done : failed;
    definition->varies |= reader->varies;
    reader->varies = outer;
    reader->names_varying = outer_names;
    definition_close(reader, &open);
}

struct symbol parameter_symbol(struct reader *reader, size_t index, struct pos at)
{
    struct parameter *parameter = &reader->scene->parameters[index];
    parameter->used = true;
    reader->names_parameters = true;
    resolve(reader, index, at);
    enum progress progress = reader->definitions[index].progress;
    if (reader->definitions[index].varies) reader->varies = reader->names_varying = true;
    if (progress == in_progress) definition_note_circle(reader, parameter->name, at);
    if (progress != done) return (struct symbol){.kind = symbol_failed};
    return (struct symbol){.kind = symbol_constant,
                           .dim = parameter->dim,
                           .free = parameter->bare,
                           .value = parameter->value};
}

static void read_range(struct reader *reader, size_t index)
{
    const struct definition *definition = &reader->definitions[index];
    if (definition->progress != done || !definition->range) return;
    bool outer = reader->varies;
    constant_range(reader, definition->range, !definition->override && !definition->varies,
                   &reader->scene->parameters[index]);
    reader->varies = outer;
}

/* True if the text is a number with this unit, as `2 kg/s`. */
static bool has_unit(const char *text, const char *unit)
{
    if (!text) return false;
    text += text[0] == '-' || text[0] == '+';
    text += number_length(text, strlen(text));
    text += strspn(text, " ");
    return strcmp(text, unit) == 0;
}

/* A mass flow has the dimension of a damping coefficient: the unit kg/s if the text has it, rather than
 * N*s/m; else NULL. */
static const char *mass_flow(const struct reader *reader, const struct definition *definition)
{
    const char *unit = reader->scene->units == unit_si ? "kg/s" : "slug/s";
    const bool file = definition->node && has_unit(definition->node->text, unit);
    return file || (definition->override && has_unit(definition->override->value, unit)) ? unit : NULL;
}

void parameters_finish(struct reader *reader)
{
    for (size_t i = 0; i < reader->scene->parameter_count; i++) {
        struct parameter *parameter = &reader->scene->parameters[i];
        char unit[64];
        resolve(reader, i, parameter->at);
        read_range(reader, i);
        unit_name(parameter->dim, reader->scene->units, unit, sizeof unit);
        const char *flow = mass_flow(reader, &reader->definitions[i]), *shown = flow ? flow : unit;
        parameter->unit = arena_text(reader->arena, shown, strlen(shown));
    }
}

void parameters_note_unused(struct reader *reader)
{
    for (size_t i = 0; i < reader->scene->parameter_count; i++) {
        const struct parameter *parameter = &reader->scene->parameters[i];
        if (!parameter->used)
            diag_add(reader->errors, FBD_WARNING, "unused-parameter", parameter->at,
                     "delete it, or use it in the model", "nothing uses the %s `%s`",
                     parameter->input ? "input" : "parameter", parameter->name);
    }
}

/* ---- gravity */

bool scene_is_horizontal(const struct node *root)
{
    const struct pair *pair = node_find(root, "plane");
    return pair && pair->value->kind == node_scalar && strcmp(pair->value->text, "horizontal") == 0;
}

/* Warn of the standard value of the other system of units. */
static void warn_foreign_gravity(struct reader *reader, double magnitude)
{
    bool us = reader->scene->units == unit_us;
    double suspect = us ? 9.81 : 32.2;
    if (fabs(magnitude - suspect) > 0.005 * suspect) return;
    diag_add(reader->errors, FBD_WARNING, "suspect-gravity", reader->gravity->at,
             us ? "write `9.81 m/s^2`, or 32.2" : "write `32.2 ft/s^2`, or 9.81",
             "`gravity` is %g %s: that is the number of the other system of units", magnitude,
             us ? "ft/s^2" : "m/s^2");
}

/* True, with a note, where gravity has a direction in a plane that is horizontal. */
static bool is_in_horizontal(struct reader *reader)
{
    if (!scene_is_horizontal(reader->root)) return false;
    diag_add(reader->errors, FBD_ERROR, "conflicting-keys", reader->gravity->at, "write its magnitude",
             "in a horizontal plane `gravity` has no direction");
    return true;
}

/* Turn gravity out of a plane that is horizontal. */
static void turn_gravity(struct reader *reader)
{
    struct scene *scene = reader->scene;
    if (!scene_is_horizontal(reader->root)) return;
    scene->pressing = vec_norm(scene->gravity);
    scene->gravity = (struct vec){0, 0};
}

/* Read a magnitude, downwards, or a vector. */
static bool read_gravity(struct reader *reader)
{
    const struct node *node = reader->gravity;
    struct vec *gravity = &reader->scene->gravity;
    if (node->kind == node_list)
        return value_vector(reader, node, "gravity", an_acceleration, gravity) && !is_in_horizontal(reader);
    double magnitude;
    if (!value_number(reader, node, "gravity", an_acceleration, 0, &magnitude)) return false;
    *gravity = (struct vec){0, -magnitude};
    warn_foreign_gravity(reader, magnitude);
    if (magnitude >= 0) return true;
    diag_add(reader->errors, FBD_ERROR, "out-of-range", node->at,
             "leave out the sign; for another direction write a pair [gx, gy]",
             "`gravity` is a magnitude, straight down: it cannot be below zero");
    return false;
}

struct symbol gravity_symbol(struct reader *reader, struct pos at)
{
    struct open_definition open;
    if (reader->gravity_progress == in_progress) definition_note_circle(reader, "gravity", at);
    if (reader->gravity_progress == untouched) {
        reader->gravity_progress = failed;
        if (definition_open(reader, &open, "gravity", at)) {
            bool outer = reader->varies, outer_names = reader->names_varying;
            reader->varies = false;
            reader->gravity_progress = in_progress;
            reader->gravity_progress = read_gravity(reader) ? done : failed;
            turn_gravity(reader);
            reader->gravity_varies = reader->varies;
            reader->varies = outer;
            reader->names_varying = outer_names;
            definition_close(reader, &open);
        }
    }
    if (reader->gravity_varies) reader->varies = reader->names_varying = true;
    reader->names_parameters = true;
    if (reader->gravity_progress != done) return (struct symbol){.kind = symbol_failed};
    return (struct symbol){.kind = symbol_constant,
                           .dim = DIM_ACCELERATION,
                           .value = vec_norm(reader->scene->gravity) + reader->scene->pressing};
}
