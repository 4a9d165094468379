/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/contact.h"

#include <assert.h>

#include "model/model.h"
#include "model/outline.h"

int shape_sides(const struct contact_shape *shape)
{
    return shape->kind == contact_corners && shape->count > 1 ? shape->count : 0;
}

/* ---- features
 *
 * corners on a line: the corner. A disc at corners: the side; after the sides, the corner. Corners at
 * corners: first those of shape 0 on sides of shape 1, then vice versa. Thin: five sides (enum thin_side) to
 * each of two corners of each shape. */

enum { thin_sides = thin_round + 1 };

struct thin_corner thin_corner_of(const struct meeting *meeting, int probe)
{
    int first = shape_sides(&meeting->shape[1]) > 0 ? meeting->shape[0].count : 0;
    return probe < first ? (struct thin_corner){0, probe} : (struct thin_corner){1, probe - first};
}

int thin_feature(struct thin_corner corner, enum thin_side side)
{
    return thin_sides * (2 * corner.moving + corner.corner) + (int)side;
}

static struct thin_corner thin_corner_at(int feature)
{
    int number = feature / thin_sides;
    return (struct thin_corner){number / 2, number % 2};
}

int meeting_feature(const struct meeting *meeting, int moving, int corner, int side)
{
    const struct contact_shape *a = &meeting->shape[0], *b = &meeting->shape[1];
    if (moving == 0) return corner * shape_sides(b) + side;
    return a->count * shape_sides(b) + corner * shape_sides(a) + side;
}

static void set_side(struct touch *touch, const struct contact_shape *shape, int side)
{
    struct vec from = shape->corners[side], to = shape->corners[(side + 1) % shape->count];
    struct vec along = vec_sub(to, from);
    touch->base = from;
    touch->length = vec_norm(along);
    touch->e = vec_scale(1 / touch->length, along);
    touch->side = -1; /* outwards is to the right of a side that runs counter-clockwise */
}

/* The sides of a bar run round it counter-clockwise; those at its ends have no length. */
static struct touch at_bar(const struct meeting *meeting, int feature)
{
    struct thin_corner corner = thin_corner_at(feature);
    const struct contact_shape *bar = &meeting->shape[1 - corner.moving];
    struct touch touch = {.moving = corner.moving,
                          .point = meeting->shape[corner.moving].corners[corner.corner]};
    enum thin_side side = (enum thin_side)(feature % thin_sides);
    bool ends = side == thin_end || side == thin_begin;
    touch.circles = side == thin_round;
    touch.base_radius = touch.circles ? bar->radius : 0;
    touch.base = bar->center;
    if (touch.circles) return touch;
    set_side(&touch, bar, side == thin_left || side == thin_end ? 1 : 0);
    if (!ends) return touch;
    touch.length = 0;
    touch.e = vec_scale(-1, vec_perp(touch.e));
    return touch;
}

static struct touch at_line(const struct contact_shape *shape, const struct contact_shape *line, int corner)
{
    struct touch touch = {.base = line->center, .e = line->e, .length = HUGE_VAL};
    touch.point = shape->kind == contact_disc ? shape->center : shape->corners[corner];
    touch.radius = shape->kind == contact_disc ? shape->radius : 0;
    return touch;
}

/* The disc is shape `moving`. */
static struct touch at_disc(const struct meeting *meeting, int moving, int feature)
{
    const struct contact_shape *disc = &meeting->shape[moving], *other = &meeting->shape[1 - moving];
    struct touch touch = {.moving = moving, .point = disc->center, .radius = disc->radius};
    int sides = shape_sides(other);
    if (other->kind == contact_corners && feature < sides) {
        set_side(&touch, other, feature);
        return touch;
    }
    touch.circles = true;
    touch.base = other->kind == contact_disc ? other->center : other->corners[feature - sides];
    touch.base_radius = other->kind == contact_disc ? other->radius : 0;
    return touch;
}

struct touch meeting_touch(const struct meeting *meeting, int feature)
{
    const struct contact_shape *a = &meeting->shape[0], *b = &meeting->shape[1];
    if (b->kind == contact_line) return at_line(a, b, feature);
    if (meeting->thin) return at_bar(meeting, feature);
    if (a->kind == contact_disc) return at_disc(meeting, 0, feature);
    if (b->kind == contact_disc) return at_disc(meeting, 1, feature);
    int first = a->count * shape_sides(b), moving = feature < first ? 0 : 1;
    const struct contact_shape *with = &meeting->shape[moving], *on = &meeting->shape[1 - moving];
    int rest = moving == 0 ? feature : feature - first, sides = shape_sides(on);
    assert(sides > 0); /* a feature of corners at corners has a side */
    struct touch touch = {.moving = moving, .point = with->corners[rest / sides]};
    set_side(&touch, on, rest % sides);
    return touch;
}

/* ---- shapes */

static void set_extent(struct contact_shape *shape)
{
    struct vec sum = {0, 0};
    for (int i = 0; i < shape->count; i++) sum = vec_add(sum, shape->corners[i]);
    shape->center = vec_scale(1.0 / shape->count, sum);
    for (int i = 0; i < shape->count; i++)
        shape->radius = fmax(shape->radius, vec_norm(vec_sub(shape->corners[i], shape->center)));
}

/* `points` in the frame of the body (or of the ground, place NULL). */
static bool set_corners(struct fbd_model *model, struct contact_shape *shape, const struct placement *place,
                        const struct vec *points, int count)
{
    shape->kind = contact_corners;
    shape->count = count;
    shape->corners = ARENA_ARRAY(&model->arena, (size_t)count, struct vec);
    if (!shape->corners) return false;
    for (int i = 0; i < count; i++) shape->corners[i] = place ? placement_point(place, points[i]) : points[i];
    set_extent(shape);
    return true;
}

static bool set_part(struct fbd_model *model, struct contact_shape *shape, const struct placement *place,
                     const struct part *part)
{
    struct outline_part outline = outline_of_part(part);
    shape->link = place->link;
    shape->source = part;
    switch (outline.kind) {
    case outline_circle:
        shape->kind = contact_disc;
        shape->center = placement_point(place, outline.center);
        shape->radius = outline.radius;
        return true;
    case outline_polygon:
    case outline_bar: return set_corners(model, shape, place, outline.corner, (int)outline.count);
    case outline_dot:
    case outline_unknown: break;
    }
    return set_corners(model, shape, place, &outline.center, 1);
}

/* True for a part that can have contact. */
static bool is_solid(const struct part *part)
{
    return part->mass > 0 && part->shape != shape_given;
}

static int shapes_of(const struct fbd_model *model, const struct constraint *source, int k)
{
    int b = source->body[k], count = 0;
    if (b == ground_body || source->contact.stop != 0 || source->point[k].kind != point_absent) return 1;
    const struct body *body = model->bodies[b].source;
    for (size_t i = 0; i < body->part_count; i++) count += is_solid(&body->parts[i]);
    return count;
}

static bool set_ground(struct fbd_model *model, struct contact_shape *shape, const struct constraint *source)
{
    const struct polygon *polygon = source->contact.polygon;
    struct vec where = source->point[1].where;
    shape->source = polygon;
    if (polygon) return set_corners(model, shape, NULL, polygon->corners, (int)polygon->count);
    if (!source->contact.line) return set_corners(model, shape, NULL, &where, 1);
    *shape = (struct contact_shape){.kind = contact_line, .center = where, .e = vec_unit(source->along)};
    return true;
}

/* Shape number `index` of side k. */
static bool set_shape(struct fbd_model *model, const struct constraint *source, int k, int index,
                      struct contact_shape *shape)
{
    *shape = (struct contact_shape){.kind = contact_stop};
    if (source->contact.stop != 0) {
        if (source->body[k] != ground_body) shape->link = model->bodies[source->body[k]].place.link;
        return true;
    }
    *shape = (struct contact_shape){0};
    if (source->body[k] == ground_body) return set_ground(model, shape, source);
    const struct model_body *body = &model->bodies[source->body[k]];
    shape->link = body->place.link;
    if (source->point[k].kind != point_absent) {
        struct vec own = source->point[k].kind == point_fixed ? source->point[k].where : body->inertia.G;
        return set_corners(model, shape, &body->place, &own, 1);
    }
    const struct part *part = body->source->parts;
    while (!is_solid(part) || index-- > 0) part++;
    return set_part(model, shape, &body->place, part);
}

/* ---- meetings */

static int couplings_of(const struct meeting *meeting)
{
    const struct contact_shape *a = &meeting->shape[0], *b = &meeting->shape[1];
    if (a->kind != contact_corners || b->kind == contact_disc) return 1;
    return a->count > 1 && (b->kind == contact_line || b->count > 1) ? 2 : 1;
}

static int probes_of(const struct meeting *meeting)
{
    const struct contact_shape *a = &meeting->shape[0], *b = &meeting->shape[1];
    enum { apart_or_one_neighbour_more = 3 };
    if (a->kind != contact_corners || b->kind == contact_disc) return 1;
    if (meeting->thin) return (shape_sides(b) > 0 ? a->count : 0) + (shape_sides(a) > 0 ? b->count : 0);
    return b->kind == contact_line ? a->count : apart_or_one_neighbour_more;
}

int meetings_most(const struct fbd_model *model, int index)
{
    const struct constraint *source = &model->scene->constraints[index];
    return shapes_of(model, source, 0) * shapes_of(model, source, 1);
}

/* The largest initial coordinate of a length, since two points have no size. */
static double farthest_start(const struct scene *scene)
{
    double most = 0;
    for (size_t i = 0; i < scene->coordinate_count; i++)
        if (!scene->coordinates[i].angle) most = fmax(most, fabs(scene->coordinates[i].initial));
    return most;
}

/* The reference length of distances: size of the shapes, limit of a stop and farthest start; 1 for an angle
 * or if it is zero. */
static double reach_of(const struct fbd_model *model, const struct meeting *meeting)
{
    const struct tree_link *link = &model->tree->links[meeting->shape[0].link];
    if (meeting->stop != 0 && link_joint(link)->has_axis) return 1;
    double reach = meeting->size + fabs(meeting->limit) + farthest_start(model->scene);
    return reach > 0 ? reach : 1;
}

static bool is_thin(const struct meeting *meeting)
{
    const struct contact_shape *a = &meeting->shape[0], *b = &meeting->shape[1];
    bool corners = a->kind == contact_corners && b->kind == contact_corners;
    return corners && a->count <= 2 && b->count <= 2 && a->count + b->count > 2;
}

bool meeting_is_of_points(const struct meeting *meeting)
{
    const struct contact_shape *a = &meeting->shape[0], *b = &meeting->shape[1];
    return a->kind == contact_corners && b->kind == contact_corners && a->count + b->count == 2;
}

/* True if the body, or the other one of the pair, has only points. */
static bool is_of_points(const struct fbd_model *model, const struct constraint *source, int k)
{
    if (source->contact.stop != 0) return false;
    if (source->body[k] == ground_body) return !source->contact.polygon && !source->contact.line;
    if (source->point[k].kind != point_absent) return true;
    const struct body *body = model->bodies[source->body[k]].source;
    for (size_t i = 0; i < body->part_count; i++)
        if (is_solid(&body->parts[i]) && outline_of_part(&body->parts[i]).kind != outline_dot) return false;
    return true;
}

/* Contact pair number `i` of the shapes of both sides. */
static bool set_meeting(struct fbd_model *model, int index, int i, struct meeting *meeting)
{
    const struct constraint *source = &model->scene->constraints[index];
    int count = shapes_of(model, source, 1);
    *meeting = (struct meeting){.constraint = index,
                                .first_coupling = model->tree->coupling_count,
                                .lifetime = source->lifetime.number,
                                .stop = source->contact.stop,
                                .limit = source->contact.limit};
    if (!set_shape(model, source, 0, i / count, &meeting->shape[0]) ||
        !set_shape(model, source, 1, i % count, &meeting->shape[1]))
        return false;
    if (meeting_is_of_points(meeting)) points_meet_on_line(model, meeting);
    meeting->thin = is_thin(meeting);
    meeting->size = meeting->shape[0].radius + meeting->shape[1].radius;
    meeting->reach = reach_of(model, meeting);
    meeting->coupling_count = couplings_of(meeting);
    meeting->probes = probes_of(meeting);
    return true;
}

bool meetings_add(struct fbd_model *model, int index)
{
    const struct constraint *source = &model->scene->constraints[index];
    struct tree *tree = model->tree;
    int count = meetings_most(model, index);
    bool points = is_of_points(model, source, 0) && is_of_points(model, source, 1);
    for (int i = 0; i < count; i++) {
        struct meeting *meeting = &tree->meetings[tree->meeting_count];
        if (!set_meeting(model, index, i, meeting)) return false;
        /* Points of bodies that also have shapes have no contact with each other. */
        if (!points && meeting_is_of_points(meeting)) continue;
        tree->meeting_count++;
        for (int k = 0; k < meeting->coupling_count; k++)
            coupling_of_contact(model, index, tree->meeting_count - 1);
    }
    return true;
}
