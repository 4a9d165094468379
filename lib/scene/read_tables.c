/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tables: functions given by points in the file or by a data file. Like parameters they are read at their
 * first use, so that they may stand in any order, and points may name parameters.
 */
#include <math.h>
#include <string.h>

#include "base/file.h"
#include "base/number.h"
#include "scene/data_file.h"
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

/* ---- names */

static bool check_table_name(struct reader *reader, const struct pair *pair)
{
    if (!name_check(reader->errors, pair->key, pair->at, "a table")) return false;
    const char *function;
    for (size_t i = 0; (function = expr_function(i)) != NULL; i++) {
        if (strcmp(function, pair->key) != 0) continue;
        diag_add(reader->errors, FBD_ERROR, "reserved-name", pair->at, "choose another name",
                 "`%s` cannot be a table: it is a function", pair->key);
        return false;
    }
    if (name_is_reserved(pair->key)) {
        diag_add(reader->errors, FBD_ERROR, "reserved-name", pair->at, "choose another name",
                 "`%s` cannot be a table: it is the time, a number or a coordinate", pair->key);
        return false;
    }
    const struct node *inputs = reader->inputs, *parameters = reader->parameters;
    bool input = inputs && node_find(inputs, pair->key);
    if (!input && (!parameters || !node_find(parameters, pair->key))) return true;
    diag_add(reader->errors, FBD_ERROR, "duplicate-name", pair->at, "choose another name",
             "%s is called `%s`, too", input ? "an input" : "a parameter", pair->key);
    return false;
}

bool tables_start(struct reader *reader)
{
    struct scene *scene = reader->scene;
    const struct node *map = reader->tables;
    scene->table_count = map ? map->count : 0;
    scene->tables = ARENA_ARRAY(reader->arena, scene->table_count, struct scene_table);
    reader->table_drafts = ARENA_ARRAY(reader->arena, scene->table_count, struct table_draft);
    if (!scene->tables || !reader->table_drafts) return false;
    for (size_t i = 0; i < scene->table_count; i++) {
        const struct pair *pair = &map->pairs[i];
        scene->tables[i].name = arena_text(reader->arena, pair->key, strlen(pair->key));
        scene->tables[i].at = pair->at;
        if (!check_table_name(reader, pair)) reader->table_drafts[i].progress = failed;
    }
    return !reader->arena->failed;
}

/* ---- points */

/* The points that were read, and their units. */
struct points {
    size_t count;
    double *values[2];
    struct unit unit[2];
    bool has_unit[2];
    const int *lines; /* of a data file; else NULL, and positions are those of `nodes` */
    const struct node *nodes;
};

static const char *const axis_names[] = {"x", "y"};

/* Read the unit in the brackets of a heading, if any. */
static bool read_label_unit(struct reader *reader, const struct heading *heading, struct pos at,
                            struct points *points, int axis)
{
    if (!heading->unit) return true;
    struct unit unit;
    if (heading->unit_length == 0) { /* `ratio []` */
        unit = (struct unit){.factor = 1};
    } else if (!unit_parse(heading->unit, heading->unit_length, reader->scene->units, reader->errors, at,
                           &unit)) {
        return false;
    }
    if (points->has_unit[axis] && (!dim_equal(points->unit[axis].dim, unit.dim) ||
                                   fabs(points->unit[axis].factor - unit.factor) > 1e-14 * unit.factor)) {
        diag_add(reader->errors, FBD_ERROR, "wrong-dimension", at, "leave it out: the file gives it",
                 "`%s` has the unit `%.*s` here, and another one in its file", axis_names[axis],
                 (int)heading->unit_length, heading->unit);
        return false;
    }
    points->unit[axis] = unit;
    points->has_unit[axis] = true;
    return true;
}

static struct pos key_place(const struct node *map, const char *key)
{
    const struct pair *pair = node_find(map, key);
    return pair ? pair->value->at : (struct pos){0, 0};
}

/* Position of the file name: `f: a.csv` or `f: {file: a.csv}`. */
static struct pos file_place(const struct node *map)
{
    return map->kind == node_scalar ? map->at : key_place(map, "file");
}

/* A relative path in the file is relative to the folder of the model file. */
static const char *resolve_path(struct reader *reader, const char *path, bool from_outside)
{
    const char *model = reader->scene->file, *slash = model ? strrchr(model, '/') : NULL;
    if (PATH_IS_ABSOLUTE(path)) return path;
    if (from_outside || !slash) return arena_printf(reader->arena, "./%s", path);
    return arena_printf(reader->arena, "%.*s/%s", (int)(slash - model), model, path);
}

static bool read_file(struct reader *reader, size_t index, const struct node *map,
                      const struct table_keys *keys, const char *path, struct data_columns *columns,
                      struct points *points)
{
    const char *const wanted[2] = {keys->x, keys->y};
    bool given = path && reader->table_drafts[index].override;
    const struct data_places places = {given ? (struct pos){0, 0} : file_place(map),
                                       {key_place(map, "x"), key_place(map, "y")}};
    if (!path || !data_file_read(path, wanted, &places, &reader->data, reader->errors, columns)) return false;
    points->count = columns->count;
    points->lines = columns->lines;
    const char *model_file = reader->errors->file;
    bool fine = true;
    for (int k = 0; k < 2; k++) {
        points->values[k] = columns->values[k];
        diag_in_file(reader->errors, path);
        if (!read_label_unit(reader, &columns->found[k], columns->heading_at[k], points, k)) fine = false;
        reader->errors->file = model_file;
        if (!wanted[k]) continue;
        struct heading heading = heading_read(wanted[k], strlen(wanted[k]));
        if (!read_label_unit(reader, &heading, places.columns[k], points, k)) fine = false;
    }
    for (int k = 0; fine && k < 2; k++)
        for (size_t i = 0; points->has_unit[k] && i < points->count; i++)
            points->values[k][i] *= points->unit[k].factor;
    return fine;
}

/* Read one number of a point. A bare number has the unit of `x: "t [s]"`. */
static bool read_coordinate(struct reader *reader, const struct node *node, int axis, bool labelled,
                            struct points *points, double *number)
{
    struct value value;
    if (!value_formula(reader, node, axis_names[axis], a_parameter, 0, &reader->constants, &value))
        return false;
    *number = expr_value(value.expr);
    if (expr_is_bare(value.expr)) {
        double plain, factor = labelled ? points->unit[axis].factor : 1;
        *number *= factor;
        if (factor == 1 || number_read(node->text, node->length, &plain)) return true;
        diag_add(reader->errors, FBD_ERROR, "wrong-dimension", node->at, "give it a unit where it is defined",
                 "`%.40s` has no unit, and `%s` has one here that is not the model's", node->text,
                 axis_names[axis]);
        return false;
    }
    struct dim dim = expr_dim(value.expr);
    if (!points->has_unit[axis]) points->unit[axis] = (struct unit){.dim = dim, .factor = 1};
    points->has_unit[axis] = true;
    if (dim_equal(points->unit[axis].dim, dim)) return true;
    char given[64], wanted[64];
    unit_name(dim, reader->scene->units, given, sizeof given);
    unit_name(points->unit[axis].dim, reader->scene->units, wanted, sizeof wanted);
    diag_add(reader->errors, FBD_ERROR, "wrong-dimension", node->at, NULL,
             "this `%s` is in %s, and those before are in %s", axis_names[axis],
             *given ? given : "pure numbers", *wanted ? wanted : "pure numbers");
    return false;
}

static bool read_points(struct reader *reader, const struct node *map, const struct table_keys *keys,
                        struct points *points)
{
    const char *const labels[2] = {keys->x, keys->y};
    bool fine = true, labelled[2];
    for (int k = 0; k < 2; k++) {
        struct heading heading = {0};
        if (labels[k]) heading = heading_read(labels[k], strlen(labels[k]));
        if (!read_label_unit(reader, &heading, key_place(map, axis_names[k]), points, k)) fine = false;
        labelled[k] = points->has_unit[k];
        points->values[k] = ARENA_ARRAY(reader->arena, keys->points->count, double);
        if (!points->values[k]) return false;
    }
    points->nodes = keys->points;
    points->count = keys->points->count;
    for (size_t i = 0; i < points->count; i++) {
        const struct node *pair = keys->points->items[i];
        if (pair->kind != node_list || pair->count != 2) {
            fine = value_refuse(reader, pair, "points", "a list of pairs [x, y]",
                                "write `points: [[0, 0], [1, 5]]`");
            continue;
        }
        for (int k = 0; k < 2; k++)
            if (!read_coordinate(reader, pair->items[k], k, labelled[k], points, &points->values[k][i]))
                fine = false;
    }
    return fine;
}

/* ---- the table */

static struct pos row_place(const struct points *points, size_t i)
{
    return points->lines ? (struct pos){points->lines[i], 1} : points->nodes->items[i]->at;
}

/* Check that x increases from row to row; repeated rows are removed. */
static bool check_order(struct reader *reader, const char *file, struct points *points)
{
    size_t kept = 0;
    const char *model_file = reader->errors->file;
    double *x = points->values[0], *y = points->values[1];
    for (size_t i = 0; i < points->count; i++) {
        if (kept && x[i] == x[kept - 1] && y[i] == y[kept - 1]) continue;
        if (kept && !(x[i] > x[kept - 1])) {
            bool same = x[i] == x[kept - 1];
            if (file) diag_in_file(reader->errors, file);
            diag_add(reader->errors, FBD_ERROR, "table-order", row_place(points, i),
                     same ? "a jump needs `interpolation: step`" : "sort the rows by x",
                     same ? "`x` is %.9g here and in the row before, with another `y`"
                          : "`x` must grow from row to row: %.9g is less than before",
                     x[i] / (points->has_unit[0] ? points->unit[0].factor : 1));
            reader->errors->file = model_file;
            return false;
        }
        x[kept] = x[i];
        y[kept++] = y[i];
    }
    points->count = kept;
    return true;
}

static bool make_table(struct reader *reader, const struct pair *pair, const struct table_keys *keys,
                       const struct points *points, struct table *table)
{
    table->interpolation = (enum table_interpolation)keys->interpolation;
    table->beyond = (enum table_beyond)keys->beyond;
    table->x_free = !points->has_unit[0];
    table->y_free = !points->has_unit[1];
    table->x_dim = table->x_free ? DIM_NONE : points->unit[0].dim;
    table->y_dim = table->y_free ? DIM_NONE : points->unit[1].dim;
    switch (table_make(table, points->count, points->values[0], points->values[1])) {
    case table_made: return true;
    case table_no_memory: diag_out_of_memory(reader->errors); break;
    case table_too_few:
        diag_add(reader->errors, FBD_ERROR, "table-points", pair->at, NULL,
                 "the table `%s` has %zu point%s; its interpolation needs at least %zu", pair->key,
                 points->count, points->count == 1 ? "" : "s",
                 table_least(table->interpolation, table->beyond));
        break;
    case table_open:
        diag_add(reader->errors, FBD_ERROR, "table-points", pair->at,
                 "let the last point, which is the first of the next period, have the value of the first",
                 "the table `%s` repeats a spline, but ends at %.9g and begins at %.9g", pair->key,
                 points->values[1][points->count - 1], points->values[1][0]);
        break;
    case table_too_steep:
        diag_add(reader->errors, FBD_ERROR, "table-points", pair->at, NULL,
                 "the table `%s` has points so far apart that its slope is not finite", pair->key);
        break;
    }
    return false;
}

static bool read_table(struct reader *reader, size_t index, struct shared_table *shared)
{
    const struct pair *pair = &reader->tables->pairs[index];
    struct table_draft *draft = &reader->table_drafts[index];
    struct table_keys keys = {0};
    struct points points = {0};
    struct data_columns columns = {0};
    if (pair->value->kind == node_list)
        keys.points = pair->value;
    else if (!fields_read(reader, &table_group, pair->value, pair->at, &reader->constants, &keys))
        return false;
    if (!fields_exclude(reader, pair->value, "file", "points", "give the points, or the file that has them"))
        return false;
    if (!keys.file && !keys.points && !draft->override) {
        diag_add(reader->errors, FBD_ERROR, "missing-key", pair->at,
                 "add `file: data.csv` or `points: [[0, 0], [1, 5]]`",
                 "the table `%s` has neither a file nor points", pair->key);
        return false;
    }
    const char *path = draft->override ? resolve_path(reader, draft->override->value, true)
                       : keys.file     ? resolve_path(reader, keys.file, false)
                                       : NULL;
    reader->scene->tables[index].path = path;
    bool fine = path ? read_file(reader, index, pair->value, &keys, path, &columns, &points)
                     : read_points(reader, pair->value, &keys, &points);
    if (fine && path) sha256_text(reader->data.text, reader->data.length, shared->sha256);
    fine = fine && check_order(reader, path, &points) &&
           make_table(reader, pair, &keys, &points, &shared->table);
    data_columns_free(&columns);
    return fine;
}

/* The table of an earlier reading of the same text, if it is valid for this one; else NULL. */
static struct shared_table *find_known(const struct reader *reader, size_t index)
{
    const struct scene *known = reader->tables_of;
    const struct table_draft *draft = &reader->table_drafts[index];
    if (!known || index >= known->table_count) return NULL;
    const struct scene_table *table = &known->tables[index];
    if (reader->same_parameters) return table->shared;
    if (table->names_parameters || draft->varies) return NULL;
    if (draft->override)
        return table->file && strcmp(table->file, draft->override->value) == 0 ? table->shared : NULL;
    return table->file && !reader->same_files ? NULL : table->shared;
}

static void resolve(struct reader *reader, size_t index, struct pos at)
{
    struct table_draft *draft = &reader->table_drafts[index];
    struct scene_table *entry = &reader->scene->tables[index];
    struct open_definition open;
    if (draft->progress != untouched) return;
    draft->progress = failed;
    entry->file = draft->override ? draft->override->value : NULL;
    struct shared_table *known = find_known(reader, index);
    if (known) {
        entry->shared = shared_table_hold(known);
        draft->progress = done;
        return;
    }
    if (!definition_open(reader, &open, entry->name, at)) return;
    bool outer = reader->varies, outer_names = reader->names_parameters;
    reader->varies = reader->names_parameters = false;
    draft->progress = in_progress;
    struct shared_table *shared = shared_table_new(entry->name);
    if (!shared) diag_out_of_memory(reader->errors);
    bool fine = shared && read_table(reader, index, shared);
    draft->progress = fine ? done : failed;
    entry->names_parameters = reader->names_parameters;
    draft->varies = draft->varies || reader->names_parameters;
    entry->shared = fine ? shared : NULL;
    if (!fine) shared_table_release(shared);
    reader->varies = outer;
    reader->names_parameters = outer_names || entry->names_parameters;
    definition_close(reader, &open);
}

struct table_symbol table_symbol(struct reader *reader, const char *name, struct pos at)
{
    const struct pair *pair = reader->tables ? node_find(reader->tables, name) : NULL;
    if (!pair) return (struct table_symbol){NULL, false};
    size_t index = (size_t)(pair - reader->tables->pairs);
    struct table_draft *draft = &reader->table_drafts[index];
    draft->used = true;
    resolve(reader, index, at);
    if (draft->varies) reader->varies = reader->names_varying = true;
    if (draft->progress == in_progress) definition_note_circle(reader, name, at);
    if (draft->progress != done) return (struct table_symbol){NULL, true};
    return (struct table_symbol){&reader->scene->tables[index].shared->table, false};
}

void tables_finish(struct reader *reader)
{
    for (size_t i = 0; i < reader->scene->table_count; i++) resolve(reader, i, reader->scene->tables[i].at);
}

void tables_note_unused(struct reader *reader)
{
    for (size_t i = 0; i < reader->scene->table_count; i++)
        if (!reader->table_drafts[i].used)
            diag_add(reader->errors, FBD_WARNING, "unused-table", reader->scene->tables[i].at,
                     diag_hint(reader->errors, "use it in an expression, as `%s(t)`, or delete it",
                               reader->scene->tables[i].name),
                     "nothing uses the table `%s`", reader->scene->tables[i].name);
}
