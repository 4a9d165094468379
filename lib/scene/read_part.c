/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parts: shapes with their dimensions and positions, as a whole body or as a part of one.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <math.h>
#include <string.h>

/* The keys that describe a shape; which of them each shape takes and needs is below. */
enum dimension {
    use_length = 1,
    use_radius = 2,
    use_outer_radius = 4,
    use_inner_radius = 8,
    use_a = 16,
    use_b = 32,
    use_c = 64,
    use_from = 128,
    use_to = 256,
    use_angle = 512,
    use_axis = 1024,
    use_center = 2048,
    use_corners = 4096,
};

static const struct {
    const char *key;
    unsigned bit;
} dimensions[] = {
    {"length", use_length},
    {"radius", use_radius},
    {"outer_radius", use_outer_radius},
    {"inner_radius", use_inner_radius},
    {"a", use_a},
    {"b", use_b},
    {"c", use_c},
    {"from", use_from},
    {"to", use_to},
    {"angle", use_angle},
    {"axis", use_axis},
    {"center", use_center},
    {"corners", use_corners},
};

enum { dimension_count = sizeof dimensions / sizeof *dimensions };

static unsigned taken_by(enum shape_kind shape)
{
    const unsigned placed = use_center | use_angle | use_axis;
    switch (shape) {
    case shape_rod: return placed | use_length | use_from | use_to;
    case shape_sphere: return use_center | use_radius;
    case shape_cylinder: return placed | use_radius | use_length;
    case shape_hollow_cylinder: return placed | use_outer_radius | use_inner_radius | use_length;
    case shape_prism: return placed | use_a | use_b | use_c;
    case shape_ring: return placed | use_radius;
    case shape_polygon: return use_corners;
    case shape_point:
    case shape_given: break;
    }
    return use_center;
}

const char *shape_dimension(size_t index, int shape, bool *taken)
{
    if (index >= dimension_count) return NULL;
    *taken = (taken_by((enum shape_kind)shape) & dimensions[index].bit) != 0;
    return dimensions[index].key;
}

/* The dimensions that determine the moment of inertia about the axis perpendicular to the plane. */
static unsigned needed_by(enum shape_kind shape, char axis)
{
    unsigned across = axis == 'x' ? 0 : use_length;
    switch (shape) {
    case shape_rod: return use_length;
    case shape_sphere:
    case shape_ring: return use_radius;
    case shape_cylinder: return use_radius | across;
    case shape_hollow_cylinder: return use_outer_radius | use_inner_radius | across;
    case shape_polygon: return use_corners;
    case shape_prism: return axis == 'x' ? use_b | use_c : axis == 'y' ? use_a | use_c : use_a | use_b;
    case shape_point:
    case shape_given: break;
    }
    return 0;
}

static char default_axis(enum shape_kind shape)
{
    return shape == shape_cylinder || shape == shape_hollow_cylinder || shape == shape_ring ? 'x' : 'z';
}

/* ---- checks */

/* The word of the file for the shape. */
static const char *shape_word(const struct node *map, enum shape_kind shape)
{
    const struct pair *pair = node_find(map, "shape");
    if (shape == shape_given) return "body of given inertia";
    return pair && pair->value->kind == node_scalar ? pair->value->text : "point";
}

static const char *list_taken(struct reader *reader, unsigned taken)
{
    char list[160] = "";
    size_t used = 0;
    for (size_t i = 0; i < dimension_count; i++) {
        if (!(taken & dimensions[i].bit)) continue;
        int n = snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", dimensions[i].key);
        used += n > 0 ? (size_t)n : 0;
    }
    return diag_hint(reader->errors, "it takes: %s", list);
}

static bool check_taken(struct reader *reader, const struct node *map, enum shape_kind shape)
{
    unsigned taken = taken_by(shape);
    bool fine = true;
    bool shapeless = shape == shape_point && !node_find(map, "shape");
    for (size_t i = 0; i < dimension_count; i++) {
        const struct pair *pair = node_find(map, dimensions[i].key);
        if (!pair || (taken & dimensions[i].bit)) continue;
        const char *hint =
            shapeless ? "give the shape: `shape: rod`, `shape: sphere`, ..." : list_taken(reader, taken);
        if (shapeless)
            diag_add(reader->errors, FBD_ERROR, "not-here", pair->at, hint, "`%s` needs a `shape`",
                     pair->key);
        else
            diag_add(reader->errors, FBD_ERROR, "not-here", pair->at, hint, "a %s has no `%s`",
                     shape_word(map, shape), pair->key);
        fine = false;
    }
    return fine;
}

static bool check_needed(struct reader *reader, const struct node *map, struct pos at, enum shape_kind shape,
                         char axis)
{
    unsigned needed = needed_by(shape, axis);
    bool ends = node_find(map, "from") || node_find(map, "to");
    if (ends) needed = use_from | use_to;
    bool fine = true;
    for (size_t i = 0; i < dimension_count; i++) {
        if (!(needed & dimensions[i].bit) || node_find(map, dimensions[i].key)) continue;
        const char *hint = shape == shape_rod ? "give `length`, or both ends: `from` and `to`"
                           : dimensions[i].bit == use_length
                               ? "its axis of symmetry lies in the plane: with `axis: x` it faces the plane"
                               : NULL;
        diag_add(reader->errors, FBD_ERROR, "missing-key", at, hint, "a %s needs `%s`",
                 shape_word(map, shape), dimensions[i].key);
        fine = false;
    }
    return fine;
}

static bool check_rod(struct reader *reader, const struct node *map)
{
    static const char *const excluded[] = {"length", "center", "angle"};
    const char *hint = "the ends determine it: leave the other out";
    bool fine = true;
    for (size_t i = 0; i < 3; i++) {
        const char *end = node_find(map, "from") ? "from" : "to";
        if (!fields_exclude(reader, map, end, excluded[i], hint)) fine = false;
    }
    return fine;
}

static bool check_tube(struct reader *reader, const struct node *map, const struct part_keys *keys)
{
    if (!(keys->inner_radius >= keys->outer_radius)) return true;
    const struct pair *pair = node_find(map, "inner_radius");
    diag_add(reader->errors, FBD_ERROR, "out-of-range", pair->value->at, NULL,
             "`inner_radius` must be less than `outer_radius`");
    return false;
}

/* ---- given inertia */

static bool read_inertia(struct reader *reader, int body, const struct node *map,
                         const struct part_keys *keys, struct part *part)
{
    struct inertia_keys given = {0};
    const struct pair *pair = node_find(map, "inertia");
    bool fine = fields_exclude(reader, map, "shape", "inertia", "a shape has its moment of inertia: choose");
    if (!fields_read(reader, &inertia_group, keys->inertia, pair->at, &reader->constants, &given))
        return false;
    const struct node *inertia = keys->inertia;
    const bool k = node_find(inertia, "radius_of_gyration") != NULL;
    if (inertia->kind == node_map && !k && !node_find(inertia, "value")) {
        diag_add(reader->errors, FBD_ERROR, "missing-key", pair->at,
                 "add `value: 0.2 kg*m^2`, or `radius_of_gyration: 12 cm`", "`inertia` needs `value`");
        fine = false;
    }
    if (!fields_exclude(reader, inertia, "value", "radius_of_gyration", "each gives the other: I = m k^2"))
        fine = false;
    part->inertia = given.value;
    part->gyration = given.gyration;
    part->about = (struct point){.kind = point_G, .at = pair->at};
    /* A hole has negative mass and moment of inertia. */
    if (given.value * keys->mass < 0) {
        diag_add(reader->errors, FBD_ERROR, "out-of-range", keys->inertia->at, NULL,
                 "`inertia` must have the sign of `mass`");
        fine = false;
    }
    const struct node *about = given.about;
    if (!about) return fine;
    if (about->kind == node_scalar && strcmp(about->text, "O") == 0) {
        part->about = (struct point){.kind = point_absent, .at = about->at};
        part->about_pivot = true;
        return fine;
    }
    return body_point_read(reader, body, about, "about", &part->about) && fine;
}

/* ---- one part */

static bool place_rod(struct reader *reader, const struct node *map, const struct part_keys *keys,
                      struct part *part)
{
    if (!node_find(map, "from")) return true;
    struct vec along = vec_sub(keys->to, keys->from);
    part->length = vec_norm(along);
    part->angle = atan2(along.y, along.x);
    part->center = vec_scale(0.5, vec_add(keys->from, keys->to));
    if (part->length != 0) return true;
    diag_add(reader->errors, FBD_ERROR, "out-of-range", node_find(map, "to")->value->at, NULL,
             "the two ends of a rod cannot be one point");
    return false;
}

/* The centre of mass of a plate: that of the triangles from its first corner. */
static struct vec center_of(const struct polygon *polygon)
{
    struct vec sum = {0, 0}, base = polygon->corners[0];
    double area = 0;
    for (size_t i = 1; i + 1 < polygon->count; i++) {
        const struct vec a = vec_sub(polygon->corners[i], base), b = vec_sub(polygon->corners[i + 1], base);
        const double twice = vec_cross(a, b);
        sum = vec_add(sum, vec_scale(twice / 3, vec_add(a, b)));
        area += twice;
    }
    return vec_add(base, vec_scale(1 / area, sum));
}

static bool place_polygon(struct reader *reader, const struct part_keys *keys, struct part *part)
{
    struct polygon polygon;
    if (!keys->corners) return false; /* noted: it is no list */
    if (keys->corners->count > FBD_MOST_CORNERS) {
        diag_add(reader->errors, FBD_ERROR, "out-of-range", keys->corners->at, "divide it into `parts`",
                 "a polygon of a body has at most %d corners", (int)FBD_MOST_CORNERS);
        return false;
    }
    if (!polygon_read(reader, keys->corners, "corners", &polygon)) return false;
    part->corner_count = polygon.count;
    part->corners = polygon.corners;
    part->center = center_of(&polygon);
    return true;
}

/* Numbers that could not be read stay NaN, which passes all checks below, so that no second note is given. */
static struct part_keys no_keys(void)
{
    return (struct part_keys){.mass = NAN,
                              .shape = -1,
                              .outer_radius = NAN,
                              .inner_radius = NAN,
                              .from = {NAN, NAN},
                              .to = {NAN, NAN}};
}

static bool read_part(struct reader *reader, int body, const struct node *map, struct pos at,
                      const struct part_keys *keys, struct part *part)
{
    bool given = keys->inertia != NULL;
    bool unclear = (node_find(map, "shape") && keys->shape < 0) || (node_find(map, "axis") && !keys->axis);
    enum shape_kind shape = given             ? shape_given
                            : keys->shape < 0 ? shape_point
                                              : (enum shape_kind)keys->shape;
    char axis = keys->axis ? (char)keys->axis : default_axis(shape);
    *part = (struct part){.at = at,
                          .shape = shape,
                          .axis = axis,
                          .mass = keys->mass,
                          .length = keys->length,
                          .radius = shape == shape_hollow_cylinder ? keys->outer_radius : keys->radius,
                          .inner_radius = shape == shape_hollow_cylinder ? keys->inner_radius : 0,
                          .side = {keys->a, keys->b, keys->c},
                          .center = keys->center,
                          .angle = keys->angle};
    bool fine = !given || read_inertia(reader, body, map, keys, part);
    if (unclear) return false;
    if (!check_taken(reader, map, shape)) fine = false;
    if (!check_needed(reader, map, at, shape, axis)) fine = false;
    if (shape == shape_rod && fine) return check_rod(reader, map) && place_rod(reader, map, keys, part);
    if (shape == shape_polygon && fine) return place_polygon(reader, keys, part);
    if (shape == shape_hollow_cylinder && fine) return check_tube(reader, map, keys);
    return fine;
}

/* Add a named point; without memory for the name it is skipped. */
static void name_point(struct body *body, const char *name, struct vec where)
{
    if (name) body->points[body->point_count++] = (struct named_point){name, where};
}

/* Name the ends of a rod and the centre: `left`, or `rod.left` for a part called rod. */
static void name_points(struct reader *reader, struct body *body, const struct part *part)
{
    const char *prefix = part->name ? part->name : "", *dot = part->name ? "." : "";
    struct vec half = vec_scale(part->length / 2, vec_unit(part->angle));
    if (part->shape == shape_rod) {
        name_point(body, arena_printf(reader->arena, "%s%sleft", prefix, dot), vec_sub(part->center, half));
        name_point(body, arena_printf(reader->arena, "%s%sright", prefix, dot), vec_add(part->center, half));
    }
    if (part->name) name_point(body, arena_printf(reader->arena, "%s.G", prefix), part->center);
}

/* ---- the parts of a body */

static bool check_mass(struct reader *reader, const struct node *map, struct pos at, const char *name,
                       double mass)
{
    if (node_find(map, "mass")) return !isnan(mass);
    diag_add(reader->errors, FBD_ERROR, "missing-key", at, "add for example `mass: 2 kg`",
             "`%s` needs `mass`", name);
    return false;
}

/* True for a varying mass, which is read later (read_mass.c); until then that of the part is 1. */
static bool varies(double mass)
{
    return isinf(mass);
}

/* Without mass the body must be joined to others that have some: found when all is known. */
static bool check_mass_of_body(struct reader *reader, const struct node *map, double mass)
{
    if (!(mass < 0)) return true;
    diag_add(reader->errors, FBD_ERROR, "out-of-range", node_find(map, "mass")->value->at,
             "a hole is a part of negative mass, among others under `parts`",
             "the `mass` of a body cannot be below zero");
    return false;
}

/* The parameter that a body has as its mass (`mass: m_1`), if its name is a symbol as a textbook writes it: M, m2, m_cart. */
static const char *name_of_mass(const struct reader *reader, const struct node *body)
{
    const struct pair *mass = node_find(body, "mass");
    size_t index;
    if (!mass || mass->value->kind != node_scalar || mass->value->quoted) return NULL;
    const char *name = mass->value->text;
    const bool is_symbol = (*name == 'm' || *name == 'M') &&
                           (!name[1] || name[1] == '_' || strspn(name + 1, "0123456789") == strlen(name + 1));
    return is_symbol && parameters_find(reader, name, &index) ? reader->scene->parameters[index].name : NULL;
}

static bool read_single(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    struct draft *draft = &reader->drafts[index];
    struct part_keys *keys = &draft->keys.part;
    draft->mass_varies = varies(keys->mass);
    if (draft->mass_varies) keys->mass = 1;
    body->parts = ARENA_NEW(reader->arena, struct part);
    if (!body->parts) return false;
    body->part_count = 1;
    draft->mass = keys->mass;
    draft->mass_known = check_mass(reader, draft->node, body->at, body->name, keys->mass) &&
                        check_mass_of_body(reader, draft->node, keys->mass);
    if (!read_part(reader, index, draft->node, body->at, keys, body->parts)) return false;
    name_points(reader, body, body->parts);
    if (!draft->mass_varies) body->mass_name = name_of_mass(reader, draft->node);
    return draft->mass_known;
}

static bool check_no_single(struct reader *reader, const struct node *map)
{
    static const char *const keys[] = {"mass", "shape", "inertia"};
    const char *hint = "the parts of a body have these keys: give it to one of them";
    bool fine = true;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (!fields_exclude(reader, map, "parts", keys[i], hint)) fine = false;
    for (size_t i = 0; i < dimension_count; i++)
        if (!fields_exclude(reader, map, "parts", dimensions[i].key, hint)) fine = false;
    return fine;
}

static bool read_named_part(struct reader *reader, int index, const struct pair *pair, struct part *part)
{
    struct body *body = &reader->scene->bodies[index];
    struct draft *draft = &reader->drafts[index];
    struct part_keys keys = no_keys();
    bool named = name_check(reader->errors, pair->key, pair->at, "a part");
    bool fine = fields_read(reader, &part_group, pair->value, pair->at, &reader->constants, &keys) && named;
    if (pair->value->kind != node_map && pair->value->kind != node_null) return false;
    if (varies(keys.mass)) {
        const char *hint = diag_hint(reader->errors,
                                     "make it a body of its own: `%s: {mass: ..., motion: {weld: {on: %s}}}`",
                                     pair->key, body->name);
        diag_add(reader->errors, FBD_ERROR, "not-constant", node_find(pair->value, "mass")->value->at, hint,
                 "the mass of a part cannot vary, since the centre of mass would move in the body");
        return false;
    }
    bool mass = check_mass(reader, pair->value, pair->at, pair->key, keys.mass);
    if (!read_part(reader, index, pair->value, pair->at, &keys, part)) fine = false;
    draft->mass += keys.mass;
    draft->mass_known = draft->mass_known && mass;
    part->name = arena_text(reader->arena, pair->key, strlen(pair->key));
    if (fine) name_points(reader, body, part);
    return fine && mass;
}

static bool read_composite(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    struct draft *draft = &reader->drafts[index];
    const struct node *map = draft->keys.parts;
    bool fine = check_no_single(reader, draft->node);
    if (map->count == 0) {
        diag_add(reader->errors, FBD_ERROR, "missing-value", map->at, "write `name: {shape: ..., mass: ...}`",
                 "`parts` is empty");
        return false;
    }
    body->parts = ARENA_ARRAY(reader->arena, map->count, struct part);
    if (!body->parts) return false;
    body->part_count = map->count;
    draft->mass_known = true;
    for (size_t i = 0; i < map->count; i++)
        if (!read_named_part(reader, index, &map->pairs[i], &body->parts[i])) fine = false;
    return fine;
}

void body_parts_start(struct body_keys *keys)
{
    keys->part = no_keys();
}

bool body_parts_read(struct reader *reader, int index)
{
    const struct draft *draft = &reader->drafts[index];
    if (draft->keys.parts) return read_composite(reader, index);
    bool faulty = node_find(draft->node, "parts") != NULL;
    return !faulty && read_single(reader, index);
}
