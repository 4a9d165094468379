/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: units, bodies and their shapes.
 */
#include <math.h>

#include "dynamics/diagram.h"
#include "expr/curve.h"
#include "fbd_geometry.h"
#include "model/outline.h"
#include "output/words.h"

#define PAIR(v)                                                                                              \
    {                                                                                                        \
        (v).x, (v).y                                                                                         \
    }

fbd_units fbd_model_units(const fbd_model *model)
{
    if (!model) return (fbd_units){.length = NULL};
    const bool si = model->scene->units == unit_si;
    return (fbd_units){.length = length_unit(model),
                       .force = force_unit(model),
                       .moment = moment_unit(model),
                       .energy = energy_unit(model),
                       .mass = si ? "kg" : "slug",
                       .inertia = si ? "kg*m^2" : "slug*ft^2"};
}

/* ---- bodies */

static const struct model_body *body_at(const fbd_model *model, size_t index)
{
    return model && index < model->body_count ? &model->bodies[index] : NULL;
}

/* The limit of the coordinate of a body on one side: +1 its least value, -1 its largest; NAN without a stop. */
static double stop_of(const fbd_model *model, int body, int side)
{
    for (size_t i = 0; i < model->scene->constraint_count; i++) {
        const struct constraint *source = &model->scene->constraints[i];
        if (source->kind == constraint_contact && source->contact.stop == side && source->body[0] == body)
            return source->contact.limit;
    }
    return NAN;
}

_Static_assert((int)FBD_MOTION_TRACK + 1 == motion_kinds_count, "the view has the joints of the language");

fbd_body fbd_model_body(const fbd_model *model, size_t index)
{
    const struct model_body *body = body_at(model, index);
    if (!body)
        return (fbd_body){.carrier = FBD_GROUND,
                          .angle = -1,
                          .inertia = fbd_model_inertia(model, index),
                          .pin = {NAN, NAN},
                          .joint = {NAN, NAN},
                          .along = {NAN, NAN},
                          .normal = {NAN, NAN},
                          .stops = {NAN, NAN}};
    const int angle = body->joint->angle;
    fbd_body seen = {.name = body->name,
                     .motion = (fbd_motion_kind)body->kind,
                     .carrier = body->parent,
                     .coordinate = (size_t)body->first,
                     .coordinate_count = (size_t)body->count,
                     .angle = angle < 0 ? -1 : body->first + angle,
                     .pin = PAIR(body->pin),
                     .joint = PAIR(body->origin),
                     .along = PAIR(body->e),
                     .normal = PAIR(body->n),
                     .friction = body->friction >= 0,
                     .stops = {stop_of(model, (int)index, 1), stop_of(model, (int)index, -1)},
                     .inertia = fbd_model_inertia(model, index),
                     .listed = body->source->load_count,
                     .most_forces = diagram_arrows(model, (int)index),
                     .line = body->source->at.line,
                     .column = body->source->at.column,
                     .motion_line = body->source->motion.at.line,
                     .motion_column = body->source->motion.at.column};
    for (size_t i = 0; body->joint->path == path_line && i < body->source->load_count; i++) {
        if (body->source->loads[i].kind != load_normal) continue;
        seen.surface = true;
        seen.two_sided |= body->source->loads[i].two_sided;
    }
    return seen;
}

size_t fbd_model_shape_count(const fbd_model *model, size_t body)
{
    const struct model_body *b = body_at(model, body);
    return b ? b->source->part_count : 0;
}

fbd_shape fbd_model_shape(const fbd_model *model, size_t body, size_t index)
{
    static const fbd_shape_kind kinds[] = {[outline_dot] = FBD_SHAPE_DOT,
                                           [outline_bar] = FBD_SHAPE_BAR,
                                           [outline_circle] = FBD_SHAPE_CIRCLE,
                                           [outline_polygon] = FBD_SHAPE_POLYGON,
                                           [outline_unknown] = FBD_SHAPE_UNKNOWN};
    if (index >= fbd_model_shape_count(model, body))
        return (fbd_shape){.kind = FBD_SHAPE_UNKNOWN, .center = {NAN, NAN}, .radius = NAN, .inner = NAN};
    const struct outline_part part = outline_of_part(&model->bodies[body].source->parts[index]);
    fbd_shape shape = {.kind = kinds[part.kind],
                       .hole = part.hole,
                       .center = PAIR(part.center),
                       .radius = part.radius,
                       .inner = part.inner,
                       .corner_count = part.count};
    for (size_t i = 0; i < shape.corner_count; i++) {
        shape.corners[i][0] = part.corner[i].x;
        shape.corners[i][1] = part.corner[i].y;
    }
    return shape;
}

fbd_inertia fbd_model_shape_inertia(const fbd_model *model, size_t body, size_t index)
{
    if (index >= fbd_model_shape_count(model, body))
        return (fbd_inertia){.mass = NAN, .I_G = NAN, .I_O = NAN, .L = NAN, .G = {NAN, NAN}};
    const struct model_body *of = &model->bodies[body];
    const struct inertia one = inertia_of_parts(&of->source->parts[index], 1, of->pin);
    return (fbd_inertia){.mass = one.mass, .I_G = one.I_G, .G = PAIR(one.G)};
}

static double extent_of(const fbd_shape *shape, struct vec from, struct vec along)
{
    const double middle = vec_dot(vec_sub(vec_of(shape->center), from), along);
    double most = middle;
    if (shape->kind == FBD_SHAPE_CIRCLE) return middle + shape->radius;
    for (size_t i = 0; i < shape->corner_count; i++)
        most = fmax(most, vec_dot(vec_sub(vec_of(shape->corners[i]), from), along));
    return most;
}

double fbd_model_extent(const fbd_model *model, size_t body, const double from[2], const double along[2])
{
    double most = -HUGE_VAL;
    for (size_t i = 0; from && along && i < fbd_model_shape_count(model, body); i++) {
        const fbd_shape shape = fbd_model_shape(model, body, i);
        if (!shape.hole) most = fmax(most, extent_of(&shape, vec_of(from), vec_of(along)));
    }
    return most;
}

size_t fbd_model_point_count(const fbd_model *model, size_t body)
{
    const struct model_body *b = body_at(model, body);
    return b ? b->source->point_count : 0;
}

fbd_named_point fbd_model_point(const fbd_model *model, size_t body, size_t index)
{
    if (index >= fbd_model_point_count(model, body)) return (fbd_named_point){NULL, NAN, NAN};
    const struct named_point *point = &model->bodies[body].source->points[index];
    return (fbd_named_point){point->name, point->where.x, point->where.y};
}

/* ---- tracks */

static const struct curve *curve_of(const fbd_model *model, size_t body)
{
    const struct model_body *b = body_at(model, body);
    return b ? b->source->motion.curve : NULL;
}

fbd_track fbd_model_track(const fbd_model *model, size_t body)
{
    const struct curve *curve = curve_of(model, body);
    return curve ? (fbd_track){curve->start, curve->length, curve->closed} : (fbd_track){NAN, NAN, false};
}

fbd_track_place fbd_model_track_place(const fbd_model *model, size_t body, double s)
{
    const struct curve *curve = curve_of(model, body);
    if (!curve || !isfinite(s)) return (fbd_track_place){NAN, NAN, {NAN, NAN}, NAN};
    const struct curve_place place = curve_at(curve, NULL, s);
    const struct vec r = vec_add(model->bodies[body].origin, place.r);
    return (fbd_track_place){r.x, r.y, PAIR(place.e), place.bend};
}
