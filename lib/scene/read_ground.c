/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The ground: named points and lines that do not move.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

/* The names of the keys of `map`, for a hint. */
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
    const struct ground_line *line = &reader->ground_lines[pair - reader->lines->pairs];
    return line->valid ? line : NULL;
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

bool ground_read(struct reader *reader, const struct node *node, struct pos owner)
{
    struct ground_keys keys = {0};
    bool fine = !node || fields_read(reader, &ground_group, node, owner, &reader->constants, &keys);
    reader->points = keys.points;
    reader->lines = keys.lines;
    bool points = read_points(reader), lines = read_lines(reader);
    return fine && points && lines;
}
