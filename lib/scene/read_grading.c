/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How answers are graded with this file as the key (lib/grade).
 */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

enum { most_digits = 8 };

/* Split a text into a number and the unit behind it. */
static bool read_end(const struct node *node, double *number, const char **unit)
{
    char *end = NULL;
    errno = 0;
    if (node->kind != node_scalar || node->length == 0) return false;
    *number = strtod(node->text, &end);
    *unit = end + strspn(end, " ");
    return end != node->text && errno == 0;
}

static bool refuse(struct reader *reader, struct pos at, const char *name, const char *hint)
{
    diag_add(reader->errors, FBD_ERROR, "bad-draw", at, hint, "`%.80s` cannot be drawn", name);
    return false;
}

static const struct parameter *find_parameter(const struct reader *reader, const char *name)
{
    for (size_t i = 0; i < reader->scene->parameter_count; i++)
        if (strcmp(reader->scene->parameters[i].name, name) == 0) return &reader->scene->parameters[i];
    return NULL;
}

/* Check that both ends are valid values of the parameter. */
static bool read_values(struct reader *reader, const struct node *ends, const struct parameter *parameter)
{
    for (size_t i = 0; i < 2; i++) {
        struct value value;
        if (!value_formula(reader, ends->items[i], parameter->name, a_parameter, 0, &reader->constants,
                           &value))
            return false;
        if (parameter->bare || expr_is_bare(value.expr) || dim_equal(expr_dim(value.expr), parameter->dim))
            continue;
        return refuse(reader, ends->items[i]->at, parameter->name, "its unit is not one of this parameter");
    }
    return true;
}

static bool read_draw(struct reader *reader, const struct pair *pair, fbd_drawn_parameter *drawn)
{
    const struct node *ends = pair->value;
    const char *unit;
    const struct parameter *parameter = find_parameter(reader, pair->key);
    if (!parameter) return refuse(reader, pair->at, pair->key, "name one of the parameters of the file");
    *drawn = (fbd_drawn_parameter){.name = pair->key, .line = pair->at.line, .column = pair->at.column};
    if (ends->kind != node_list || ends->count != 2 || !read_end(ends->items[0], &drawn->low, &drawn->unit) ||
        !read_end(ends->items[1], &drawn->high, &unit))
        return refuse(reader, ends->at, pair->key, "write [low, high], as [20 deg, 40 deg]");
    if (strcmp(unit, drawn->unit) != 0)
        return refuse(reader, ends->items[1]->at, pair->key, "write both ends with the same unit");
    if (!(drawn->low < drawn->high))
        return refuse(reader, ends->at, pair->key, "write the lower end first, then a higher one");
    return read_values(reader, ends, parameter);
}

static bool read_draws(struct reader *reader, const struct node *map, fbd_grading *grading)
{
    bool fine = true;
    fbd_drawn_parameter *draws = ARENA_ARRAY(reader->arena, map->count, fbd_drawn_parameter);
    grading->draws = draws;
    if (!draws) return false;
    for (size_t i = 0; i < map->count; i++)
        if (read_draw(reader, &map->pairs[i], &draws[grading->draw_count]))
            grading->draw_count++;
        else
            fine = false;
    return fine;
}

/* `all`, `none`, or names of couplings and of their forces. */
static bool read_reactions(struct reader *reader, const struct node *node, fbd_grading *grading)
{
    bool fine = node->kind == node_list;
    grading->reactions_given = true;
    if (node->kind == node_scalar && strcmp(node->text, "all") == 0) return true;
    if (node->kind == node_scalar && strcmp(node->text, "none") == 0) {
        grading->reactions = FBD_REACTIONS_NONE;
        return true;
    }
    grading->reactions = FBD_REACTIONS_NAMED;
    const char **names = ARENA_ARRAY(reader->arena, node->count + 1, const char *);
    for (size_t i = 0; fine && names && i < node->count; i++) {
        fine = node->items[i]->kind == node_scalar && node->items[i]->length > 0;
        if (fine) names[grading->reaction_count++] = node->items[i]->text;
    }
    grading->reaction_names = names;
    if (!fine)
        diag_add(reader->errors, FBD_ERROR, "wrong-type", node->at,
                 "write `all`, `none`, or the names of couplings, as [A, cord]",
                 "`reactions` must be `all`, `none` or a list of names");
    return fine && names;
}

static bool in_range(struct reader *reader, const struct node *map, const char *key, double value,
                     double most)
{
    const struct pair *pair = node_find(map, key);
    if (!pair || value <= most) return true;
    diag_add(reader->errors, FBD_ERROR, "out-of-range", pair->value->at, "shares are written as 0.8",
             "`%s` must be at most %g", key, most);
    return false;
}

bool grading_read(struct reader *reader, const struct node *node)
{
    const struct pair *pair = node_find(reader->root, "grading");
    struct grading_keys keys;
    fbd_grading *grading = &keys.grading;
    memset(&keys, 0, sizeof keys); /* also padding: scenes are compared word by word (patch.c) */
    keys.digits = 2;
    grading->given = node != NULL;
    grading->tolerance = 0.01;
    grading->partial = 0.5;
    grading->pass = 1;
    grading->points = (fbd_marks){.force = 1, .derivation = 2, .superfluous = 1};
    grading->canvas.angle = 5 * 0.017453292519943295;
    bool fine = !node || fields_read(reader, &grading_group, node, pair->at, &reader->constants, &keys);
    if (fine && keys.points)
        fine = fields_read(reader, grading_points_group, keys.points, keys.points->at, &reader->constants,
                           grading);
    if (keys.canvas && !fields_read(reader, grading_canvas_group, keys.canvas, keys.canvas->at,
                                    &reader->constants, &grading->canvas))
        fine = false;
    if (keys.reactions && !read_reactions(reader, keys.reactions, grading)) fine = false;
    if (keys.draw && !read_draws(reader, keys.draw, grading)) fine = false;
    if (keys.digits > most_digits) fine = in_range(reader, node, "digits", keys.digits, most_digits);
    if (!in_range(reader, node, "tolerance", grading->tolerance, 0.5)) fine = false;
    if (!in_range(reader, node, "partial", grading->partial, 1)) fine = false;
    if (!in_range(reader, node, "pass", grading->pass, 1)) fine = false;
    if (fine) grading->digits = keys.digits < 1 ? 1 : (int)keys.digits;
    reader->scene->grading = *grading;
    return fine;
}
