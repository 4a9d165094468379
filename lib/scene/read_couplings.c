/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings: what joins two bodies beside what they move on. Each is declared once and stands in the diagrams
 * of both.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <string.h>

/* ---- ends: body.point, ground.point, or a body for its centre of mass */

static const struct node *part_of(struct reader *reader, const struct node *whole, size_t from, size_t length)
{
    struct node *part = ARENA_ARRAY(reader->arena, 1, struct node);
    char *text = arena_text(reader->arena, whole->text + from, length);
    if (!part || !text) return NULL;
    *part = *whole;
    part->text = text;
    part->length = length;
    part->at.column += (int)from;
    return part;
}

static bool read_end(struct reader *reader, const struct node *node, int *body, struct point *point)
{
    if (node->kind != node_scalar)
        return value_refuse(reader, node, "between", "a point as `body.point` or `ground.point`", NULL);
    const char *dot = strchr(node->text, '.');
    size_t length = dot ? (size_t)(dot - node->text) : node->length;
    const struct node *owner = part_of(reader, node, 0, length);
    if (!owner || !body_name_read(reader, owner, "between", body)) return false;
    if (!dot) {
        *point = (struct point){.kind = point_G, .at = node->at};
        if (*body != ground_body) return true;
        return value_refuse(reader, node, "between", "`ground.point`: the ground has no centre", NULL);
    }
    const struct node *name = part_of(reader, node, length + 1, node->length - length - 1);
    if (!name) return false;
    if (*body != ground_body) return body_point_read(reader, *body, name, "between", point);
    *point = (struct point){.kind = point_fixed, .at = node->at};
    return ground_point_read(reader, name, "between", &point->where);
}

static bool read_between(struct reader *reader, const struct node *list, struct coupling *coupling)
{
    if (!list) return false; /* noted */
    if (list->count != 2) {
        diag_add(reader->errors, FBD_ERROR, "wrong-type", list->at, "write [a.P, b.Q]",
                 "`between` needs two ends, not %zu", list->count);
        return false;
    }
    bool first = read_end(reader, list->items[0], &coupling->body[0], &coupling->point[0]);
    bool second = read_end(reader, list->items[1], &coupling->body[1], &coupling->point[1]);
    if (!first || !second) return false;
    if (coupling->body[0] != coupling->body[1]) return true;
    diag_add(reader->errors, FBD_ERROR, "same-body", list->at, "name points of two bodies",
             "both ends are on the same body: nothing would act");
    return false;
}

/* ---- names */

/* Is one of the first `count` couplings called `name`? */
static bool is_taken(const struct scene *scene, const char *name, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const char *other = scene->couplings[i].load.name;
        if (other && strcmp(other, name) == 0) return true;
    }
    return false;
}

static bool name_coupling(struct reader *reader, size_t index, const char *kind)
{
    struct scene *scene = reader->scene;
    struct coupling *coupling = &scene->couplings[index];
    bool given = coupling->load.name != NULL;
    for (int number = 1; !coupling->load.name; number++) {
        const char *name = number == 1 ? kind : arena_printf(reader->arena, "%s_%d", kind, number);
        if (!name) return false;
        if (!is_taken(scene, name, scene->coupling_count)) coupling->load.name = name;
    }
    if (!given || !is_taken(scene, coupling->load.name, index)) return true;
    diag_add(reader->errors, FBD_ERROR, "duplicate-name", coupling->load.at, "choose another name",
             "two couplings are called `%s`", coupling->load.name);
    return false;
}

/* ---- the list */

static bool read_coupling(struct reader *reader, const struct node *node, struct coupling *coupling,
                          const char **kind)
{
    struct chosen chosen;
    struct coupling_keys keys = {0};
    if (!kind_read(reader, &coupling_kinds, node, "couplings", &chosen)) return false;
    bool fine = fields_read(reader, chosen.kind->group, chosen.node, chosen.at, &reader->constants, &keys);
    *kind = chosen.kind->name;
    coupling->load = (struct load){.kind = (enum load_kind)chosen.kind->value,
                                   .name = keys.name,
                                   .at = chosen.at,
                                   .stiffness = keys.stiffness,
                                   .free_length = keys.free_length,
                                   .coefficient = keys.coefficient};
    return read_between(reader, keys.between, coupling) && fine;
}

bool couplings_read(struct reader *reader, const struct node *list)
{
    struct scene *scene = reader->scene;
    size_t count = list ? list->count : 0;
    scene->couplings = ARENA_ARRAY(reader->arena, count, struct coupling);
    const char **kinds = ARENA_ARRAY(reader->arena, count, const char *);
    if (!scene->couplings || !kinds) return false;
    bool fine = true;
    scene->coupling_count = count;
    for (size_t i = 0; i < count; i++)
        if (!read_coupling(reader, list->items[i], &scene->couplings[i], &kinds[i])) fine = false;
    for (size_t i = 0; fine && i < count; i++)
        if (!name_coupling(reader, i, kinds[i])) fine = false;
    return fine;
}
