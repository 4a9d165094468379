/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The ground: named points and lines that do not move.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <string.h>

/* A hint with the nearest key of `map`; `none` if it is empty. */
static const char *hint_names(struct reader *reader, const struct node *map, const char *wrong,
                              const char *none)
{
    enum { most_listed = 100 };
    const char *names[most_listed];
    size_t count = 0;
    for (; map && count < map->count && count < most_listed; count++) names[count] = map->pairs[count].key;
    return count ? diag_nearest(reader->errors, wrong, names, count) : none;
}

bool ground_point_read(struct reader *reader, const struct node *node, const char *what, struct vec *where)
{
    if (node->kind == node_list) return value_vector(reader, node, what, a_length, where);
    if (node->kind != node_scalar)
        return value_refuse(reader, node, what, "a pair [x, y] or the name of a point of the ground", NULL);
    const struct pair *pair = node_find(reader->points, node->text);
    if (!pair) {
        diag_add(reader->errors, FBD_ERROR, "unknown-point", node->at,
                 hint_names(reader, reader->points, node->text,
                            "write [x, y], or name points under `ground: {points: ...}`"),
                 "the ground has no point %s", value_found(reader, node));
        return false;
    }
    const struct ground_point *point = &reader->ground_points[pair - reader->points->pairs];
    *where = point->where;
    return point->valid;
}

const struct ground_line *ground_line_find(struct reader *reader, const struct node *name)
{
    const struct pair *pair = node_find(reader->lines, name->text);
    if (!pair) {
        diag_add(reader->errors, FBD_ERROR, "unknown-line", name->at,
                 hint_names(reader, reader->lines, name->text,
                            "write `along` and `through`, or name lines under `ground: {lines: ...}`"),
                 "the ground has no line %s", value_found(reader, name));
        return NULL;
    }
    struct ground_line *line = &reader->ground_lines[pair - reader->lines->pairs];
    line->used = true;
    return line->valid ? line : NULL;
}

/* The first key of a map of the ground, or NULL. */
static const char *first_of(const struct node *map)
{
    return map && map->count > 0 ? map->pairs[0].key : NULL;
}

static const char *hint_end(struct reader *reader, bool surfaces)
{
    const char *name = surfaces ? first_of(reader->lines) : NULL;
    if (!name && surfaces) name = first_of(reader->polygons);
    if (!name) name = first_of(reader->points);
    if (name) return diag_hint(reader->errors, "write `ground.%s`", name);
    return surfaces ? "name a line under `ground: {lines: {floor: {through: [0, 0], along: 0}}}`, and here "
                      "`ground.floor`"
                    : "name a point under `ground: {points: {A: [0, 0]}}`, and here `ground.A`";
}

bool ground_end_refuse(struct reader *reader, const struct node *node, const char *what, bool surfaces)
{
    if (node->kind != node_scalar || node_find(reader->bodies, node->text)) return false;
    if (strcmp(node->text, "ground") == 0) {
        const char *wanted =
            surfaces ? "`ground.line`, `ground.polygon` or `ground.point`" : "`ground.point`";
        value_refuse(reader, node, what, wanted, hint_end(reader, surfaces));
        return true;
    }
    bool surface = node_find(reader->lines, node->text) || node_find(reader->polygons, node->text);
    if (!(surface && surfaces) && !node_find(reader->points, node->text)) return false;
    diag_add(reader->errors, FBD_ERROR, "unknown-body", node->at,
             diag_hint(reader->errors, "write `ground.%s`", node->text),
             "`%s`: `%s` is no body, but part of the ground", what, node->text);
    return true;
}

static bool read_points(struct reader *reader)
{
    size_t count = reader->points ? reader->points->count : 0;
    reader->ground_points = ARENA_ARRAY(reader->arena, count, struct ground_point);
    if (!reader->ground_points) return false;
    bool fine = true;
    for (size_t i = 0; i < count; i++) {
        const struct pair *pair = &reader->points->pairs[i];
        struct ground_point *point = &reader->ground_points[i];
        bool named = name_check(reader->errors, pair->key, pair->at, "a point");
        point->valid = value_vector(reader, pair->value, pair->key, a_length, &point->where);
        fine = fine && named && point->valid;
    }
    return fine;
}

static bool read_line(struct reader *reader, const struct pair *pair, struct ground_line *line)
{
    struct line_keys keys = {0};
    bool named = name_check(reader->errors, pair->key, pair->at, "a line");
    line->valid = fields_read(reader, &line_group, pair->value, pair->at, &reader->constants, &keys);
    line->along = keys.along;
    line->at = pair->at;
    if (keys.through && !ground_point_read(reader, keys.through, "through", &line->through))
        line->valid = false;
    return named && line->valid;
}

static bool read_lines(struct reader *reader)
{
    size_t count = reader->lines ? reader->lines->count : 0;
    reader->ground_lines = ARENA_ARRAY(reader->arena, count, struct ground_line);
    if (!reader->ground_lines) return false;
    bool fine = true;
    for (size_t i = 0; i < count; i++)
        if (!read_line(reader, &reader->lines->pairs[i], &reader->ground_lines[i])) fine = false;
    return fine;
}

/* Twice the area, counter-clockwise. */
static double area_of(const struct polygon *polygon)
{
    double area = 0;
    for (size_t i = 0; i < polygon->count; i++)
        area += vec_cross(polygon->corners[i], polygon->corners[(i + 1) % polygon->count]);
    return area;
}

static void reverse(struct polygon *polygon)
{
    for (size_t i = 0, k = polygon->count - 1; i < k; i++, k--) {
        struct vec kept = polygon->corners[i];
        polygon->corners[i] = polygon->corners[k];
        polygon->corners[k] = kept;
    }
}

/* True if every corner turns left and the total angle is one turn. */
static bool is_convex(const struct polygon *polygon)
{
    const double round = 6.283185307179586;
    double turned = 0;
    for (size_t i = 0; i < polygon->count; i++) {
        struct vec a = polygon->corners[i], b = polygon->corners[(i + 1) % polygon->count],
                   c = polygon->corners[(i + 2) % polygon->count];
        struct vec in = vec_sub(b, a), out = vec_sub(c, b);
        double turn = atan2(vec_cross(in, out), vec_dot(in, out));
        if (!(turn > 0)) return false;
        turned += turn;
    }
    return turned < 1.5 * round;
}

bool polygon_read(struct reader *reader, const struct node *list, const char *key, struct polygon *polygon)
{
    if (list->kind != node_list || list->count < 3)
        return value_refuse_list(reader, list, key, "three corners or more, [[x, y], ...]", NULL);
    struct polygon read = {list->count, ARENA_ARRAY(reader->arena, list->count, struct vec)};
    if (!read.corners) return false;
    for (size_t i = 0; i < list->count; i++)
        if (!value_vector(reader, list->items[i], key, a_length, &read.corners[i])) return false;
    if (area_of(&read) < 0) reverse(&read);
    if (!is_convex(&read)) {
        diag_add(
            reader->errors, FBD_ERROR, "not-convex", list->at,
            "cut it into convex ones: of the ground each with a contact of its own, of a body as `parts`",
            "the polygon `%s` has a corner that points inwards, or corners in one line", key);
        return false;
    }
    *polygon = read;
    return true;
}

static bool read_polygon(struct reader *reader, const struct pair *pair, struct polygon *polygon)
{
    return name_check(reader->errors, pair->key, pair->at, "a polygon") &&
           polygon_read(reader, pair->value, pair->key, polygon);
}

static bool read_polygons(struct reader *reader)
{
    size_t count = reader->polygons ? reader->polygons->count : 0;
    reader->ground_polygons = ARENA_ARRAY(reader->arena, count, struct polygon);
    if (!reader->ground_polygons) return false;
    bool fine = true;
    for (size_t i = 0; i < count; i++)
        if (!read_polygon(reader, &reader->polygons->pairs[i], &reader->ground_polygons[i])) fine = false;
    return fine;
}

const struct polygon *ground_polygon_find(struct reader *reader, const struct node *name)
{
    const struct pair *pair = node_find(reader->polygons, name->text);
    return pair ? &reader->ground_polygons[pair - reader->polygons->pairs] : NULL;
}

bool ground_read(struct reader *reader, const struct node *node, struct pos owner)
{
    struct ground_keys keys = {0};
    bool fine = !node || fields_read(reader, &ground_group, node, owner, &reader->constants, &keys);
    reader->points = keys.points;
    reader->lines = keys.lines;
    reader->polygons = keys.polygons;
    bool points = read_points(reader), lines = read_lines(reader), polygons = read_polygons(reader);
    return fine && points && lines && polygons;
}
