/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The bodies in the data of a page: shapes, arrows, the guide on which a body moves, its stops and springs about an axis.
 */
#include <string.h>

#include "api/page_data.h"
#include "api/page_equations.h"
#include "base/json.h"
#include "fbd_view.h"
#include "output/words.h"

static void write_shape(struct text *text, const fbd_shape *part)
{
    static const char *const kinds[] = {"dot", "bar", "circle", "polygon", "unknown"};
    text_add(text, "{");
    json_text_member(text, "kind", kinds[part->kind]);
    if (part->hole) text_add(text, "\"hole\":true,");
    if (part->kind == FBD_SHAPE_CIRCLE) {
        json_number_member(text, "radius", part->radius);
        json_number_member(text, "inner", part->inner);
    }
    if (part->corner_count > 0) {
        text_add(text, "\"corners\":[");
        for (size_t i = 0; i < part->corner_count; i++) {
            json_comma(text, i);
            json_vector(text, vec_of(part->corners[i]));
        }
        text_add(text, "],");
    }
    json_key(text, "center");
    json_vector(text, vec_of(part->center));
    text_add(text, "}");
}

static void write_arrow(struct text *text, const struct fbd_model *model, int b,
                        const struct record_of_arrow *arrow)
{
    text_add(text, "\n{");
    json_text_member(text, "name", arrow->name);
    json_columns_member(text, "arrow", arrow->arrow, 5);
    json_columns_member(text, "force", arrow->force, arrow->force_count);
    const char *drawing = drawing_of_force(model, b, arrow->name, arrow->load);
    const bool coloured =
        strstr("gravity reaction friction", drawing) != NULL; /* of its own, in the style sheet */
    text_printf(text, "\"hue\":\"%s\",\"work\":%d}", coloured ? drawing : "applied", arrow->work);
}

/* The origin of the frame of a carrier in the page, in the frame of the file. */
static struct vec zero_of(const fbd_model *model, int carrier)
{
    return carrier == FBD_GROUND ? (struct vec){0, 0} : vec_of(fbd_model_body(model, (size_t)carrier).pin);
}

/* The place of a joint in the frame of the carrier in the page. */
static struct vec joint_of(const fbd_model *model, const fbd_body *body)
{
    return vec_sub(vec_of(body->joint), zero_of(model, body->carrier));
}

/* The curve of a track as points in the frame of the body that carries it. */
static void write_track(struct text *text, const fbd_model *model, size_t b, int carrier)
{
    enum { segments = 400 };
    const fbd_track track = fbd_model_track(model, b);
    const struct vec zero = zero_of(model, carrier);
    text_printf(text, "\"track\":{\"on\":%d,\"points\":[", carrier);
    for (int i = 0; i <= segments; i++) {
        double s = track.start + track.length * i / segments;
        const fbd_track_place place = fbd_model_track_place(model, b, s);
        json_comma(text, (size_t)i);
        json_vector(text, vec_sub((struct vec){place.x, place.y}, zero));
    }
    text_add(text, "]},");
}

void page_speed_write(struct text *text, const struct value *speed)
{
    const bool constant = speed->expr && expr_is_constant(speed->expr);
    if (!speed->expr || (constant && expr_value(speed->expr) == 0)) return;
    json_key(text, "speed");
    if (constant)
        json_number(text, expr_value(speed->expr));
    else
        text_add(text, "null");
    text_add(text, ",");
}

/* The reach of a body from its centre of mass in a direction of its frame, 0 without a size. */
static double reach_of(const fbd_model *model, size_t b, struct vec way)
{
    const double direction[2] = {way.x, way.y};
    return fmax(0, fbd_model_extent(model, b, fbd_model_inertia(model, b).G, direction));
}

/* The wall of a stop in the frame of the carrier in the page: a point of it, its direction, and that behind it. */
struct wall {
    struct vec at, along, into;
};

/* Before the body at its limit. */
static struct wall wall_of_slide(const fbd_model *model, size_t b, const fbd_body *body, int high)
{
    const struct vec e = vec_of(body->along), out = vec_scale(high ? 1 : -1, e),
                     G = vec_sub(vec_of(fbd_model_inertia(model, b).G), vec_of(body->pin));
    const double reach = reach_of(model, b, (struct vec){high ? 1 : -1, 0});
    const struct vec base = vec_add(joint_of(model, body), vec_turn(e, G)),
                     way = vec_add(vec_scale(body->stops[high], e), vec_scale(reach, out));
    return (struct wall){vec_add(base, way), vec_of(body->normal), out};
}

/* From the axis along the line to the centre of mass, or the x axis of the body, at its limit. */
static struct wall wall_of_pivot(const fbd_model *model, size_t b, const fbd_body *body, int high)
{
    const struct vec arm = vec_sub(vec_of(fbd_model_inertia(model, b).G), vec_of(body->pin));
    const double L = vec_norm(arm);
    const struct vec line = L > 0 ? vec_scale(1 / L, arm) : (struct vec){1, 0},
                     along = vec_turn(vec_unit(body->stops[high]), line);
    return (struct wall){joint_of(model, body), along, vec_scale(high ? 1 : -1, vec_perp(along))};
}

static void write_stops(struct text *text, const fbd_model *model, size_t b, const fbd_body *body)
{
    size_t written = 0;
    text_add(text, "\"stops\":[");
    for (int high = 0; high < 2; high++) {
        if (isnan(body->stops[high])) continue;
        const struct wall wall =
            (body->motion == FBD_MOTION_SLIDE ? wall_of_slide : wall_of_pivot)(model, b, body, high);
        json_comma(text, written++);
        text_printf(text, "{\"high\":\"%s\",", high ? "≤" : "≥");
        json_number_member(text, "value", body->stops[high]);
        json_vector_member(text, "at", wall.at);
        json_vector_member(text, "beside", vec_add(wall.at, wall.along));
        json_key(text, "beyond");
        json_vector(text, vec_add(wall.at, wall.into));
        text_add(text, "}");
    }
    text_add(text, "],");
}

/* The surface speed of the friction of a slide. */
static void write_speed_of_slide(struct text *text, const fbd_model *model, size_t b)
{
    const struct model_body *body = &model->bodies[b];
    for (int i = 0; i < body->load_count; i++) {
        const struct load *load = model->loads[body->first_load + i].source;
        if (load->kind == load_friction) page_speed_write(text, &load->surface_speed);
    }
}

static void write_line(struct text *text, const fbd_model *model, size_t b, const fbd_body *body)
{
    struct vec along = vec_of(body->along), normal = vec_of(body->normal), down = vec_scale(-1, normal);
    struct vec in_body = {vec_dot(down, along), vec_dot(down, vec_perp(along))};
    text_add(text, "\"line\":{\"through\":");
    json_vector(text, joint_of(model, body));
    text_add(text, ",\"along\":");
    json_vector(text, along);
    text_add(text, ",\"normal\":");
    json_vector(text, normal);
    text_printf(text, ",\"on\":%d,", body->carrier);
    write_speed_of_slide(text, model, b);
    text_printf(text, "\"surface\":%s,\"reach\":", body->surface ? "true" : "false");
    json_number(text, reach_of(model, b, in_body));
    text_add(text, "},");
}

/* True for a body that lists a spring about its axis. */
static bool has_coil(const fbd_model *model, size_t b)
{
    const struct model_body *body = &model->bodies[b];
    for (int i = 0; i < body->load_count; i++)
        if (model->loads[body->first_load + i].source->kind == moment_spring) return true;
    return false;
}

static void write_guide(struct text *text, const fbd_model *model, size_t b, const fbd_body *body)
{
    if (body->motion == FBD_MOTION_PIVOT && body->carrier == FBD_GROUND) {
        json_key(text, "axis");
        json_vector(text, vec_of(body->joint));
        text_add(text, ",");
    }
    if (body->motion == FBD_MOTION_PIVOT || body->motion == FBD_MOTION_WELD)
        text_add(text, "\"joint\":true,");
    if (body->motion == FBD_MOTION_TRACK) write_track(text, model, b, body->carrier);
    if (body->motion == FBD_MOTION_SLIDE) write_line(text, model, b, body);
    write_stops(text, model, b, body);
    if (has_coil(model, b)) text_add(text, "\"coil\":true,");
}

void page_body_write(struct text *text, struct symbolic *symbolic, const struct record *record, size_t b)
{
    static const char *const motions[] = {"slide", "pivot", "particle", "planar", "weld", "track"};
    const fbd_model *model = record->model;
    const fbd_body body = fbd_model_body(model, b);
    const struct record_of_body *columns = &record->bodies[b];
    const int count = (int)body.coordinate_count;
    text_add(text, "\n{");
    json_text_member(text, "name", body.name);
    json_text_member(text, "motion", motions[body.motion]);
    text_printf(text, "\"parent\":%d,", body.carrier);
    json_columns_member(text, "frame", columns->pose, 3);
    json_columns_member(text, "velocity", columns->pose + 3, 2);
    json_columns_member(text, "coordinates", columns->coordinate, count);
    json_columns_member(text, "rates", columns->rate, count);
    json_columns_member(text, "accelerations", columns->acceleration, count);
    write_guide(text, model, b, &body);
    page_equations_write(text, symbolic, record, (int)b);
    text_add(text, "\"shapes\":[");
    for (size_t i = 0; i < fbd_model_shape_count(model, b); i++) {
        fbd_shape shape = fbd_model_shape(model, b, i);
        json_comma(text, i);
        write_shape(text, &shape);
    }
    text_add(text, "],\"arrows\":[");
    for (size_t i = 0; i < columns->arrow_count; i++) {
        json_comma(text, i);
        write_arrow(text, model, (int)b, &columns->arrows[i]);
    }
    /* the frame of a pivot is at the axis: its points are relative to that */
    text_add(text, "],\"pin\":");
    json_vector(text, vec_of(body.pin));
    text_add(text, ",\"G\":");
    json_vector(text, vec_sub(vec_of(fbd_model_inertia(model, b).G), vec_of(body.pin)));
    text_add(text, "}");
}
