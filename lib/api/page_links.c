/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The elements that the page draws between bodies.
 *
 * - links: springs, dampers and actuators, {body, kind, point, partner, anchor} - couplings: {kind, name, ends, length,
 * e, side, force}, a rope cut at its pulleys (coupling.h)
 *
 * An end is {body, point, radius, side, wound}; the body of the ground is -1. Points of a body are relative
 * to the origin of its frame in the page, which is the axis of a pivot.
 */
#include <string.h>

#include "api/page_data.h"
#include "base/json.h"
#include "dynamics/constraint.h"
#include "expr/curve.h"

/* ---- links */

/* As the page draws a load between two points; NULL for others. An actuator in a given direction is an arrow alone. */
static const char *link_kind(const struct load *load)
{
    if (load->kind == load_actuator) return load->guided ? NULL : "actuator";
    return load->kind == load_damper ? "damper" : load->kind == load_spring ? "spring" : NULL;
}

/* The other end: on the ground, on another body, or null for a wall without a position in the file. */
static void write_other_end(struct text *text, const struct fbd_model *model, const struct model_load *load)
{
    text_printf(text, ",\"partner\":%d,\"anchor\":", load->linked ? load->partner : ground_body);
    if (!load->linked)
        text_add(text, "null");
    else if (load->partner >= 0)
        json_vector(text, vec_sub(load->anchor, model->bodies[load->partner].pin));
    else
        json_vector(text, load->anchor);
}

void page_links_write(struct text *text, const struct record *record)
{
    const struct fbd_model *model = record->model;
    size_t written = 0;
    text_add(text, "\"links\":[");
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        const struct model_body *body = &model->bodies[load->body];
        const char *kind = link_kind(load->source);
        if (!kind) continue;
        bool to_a_wall = body->joint->path == path_line && body->parent == ground_body;
        if (!load->linked && !to_a_wall) continue;
        json_comma(text, written++);
        text_printf(text, "{\"body\":%d,\"kind\":\"%s\",\"point\":", load->body, kind);
        json_vector(text, vec_sub(load->point, body->pin));
        write_other_end(text, model, load);
        text_add(text, "}");
    }
    text_add(text, "],\n");
}

/* ---- couplings */

static struct vec end_point(const struct fbd_model *model, const struct constraint *source, int k)
{
    const struct point *point = &source->point[k];
    if (source->body[k] == ground_body) return point->where;
    const struct model_body *body = &model->bodies[source->body[k]];
    return vec_sub(point->kind == point_fixed ? point->where : body->inertia.G, body->pin);
}

static void write_end(struct text *text, const struct fbd_model *model, const struct coupling *coupling,
                      const struct coupling_state *state, int k)
{
    const struct constraint *source = &model->scene->constraints[coupling->constraint];
    bool wound =
        (k == 0 && coupling->wound[0] != 0) || (k + 1 == coupling->end_count && coupling->wound[1] != 0);
    bool round = coupling->law->strands && coupling->end[k].radius > 0; /* a disc that the strands wrap */
    int which = k == 0 ? 0 : round || k + 1 == coupling->end_count ? 1 : -1;
    if (coupling->law->strands && !round) which = -1;
    int side = which < 0 ? 0 : state->side[which];
    json_comma(text, (size_t)k);
    text_printf(text, "{\"body\":%d,", coupling->end[k].body);
    json_vector_member(text, "point", end_point(model, source, coupling->place + k));
    json_number_member(text, "radius", coupling_has_circles(coupling) ? coupling->end[k].radius : 0);
    text_printf(text, "\"side\":%d,\"wound\":%d}", side, wound || round);
}

/* The first of the two columns of its force, by which a rope is drawn taut or slack; -1 when no body has it. */
static int force_column(const struct record *record, const struct coupling *coupling)
{
    for (int k = 0; k < coupling->end_count; k++) {
        if (coupling->end[k].body == ground_body || !coupling->end[k].name[0]) continue;
        const struct record_of_body *body = &record->bodies[coupling->end[k].body];
        for (size_t i = 0; i < body->arrow_count; i++)
            if (strcmp(body->arrows[i].name, coupling->end[k].name[0]) == 0) return body->arrows[i].arrow;
    }
    return -1;
}

/* The curve of a slot in the frame of its body; nothing for an unbounded line. */
static void write_slot(struct text *text, const struct fbd_model *model, const struct coupling *coupling)
{
    enum { segments = 240 };
    const struct constraint *source = &model->scene->constraints[coupling->constraint];
    struct vec from = end_point(model, source, 1), e = vec_unit(source->along);
    if (!source->curve && !(isfinite(source->from) && isfinite(source->to))) return;
    double first = source->curve ? source->curve->start : source->from;
    double length = source->curve ? source->curve->length : source->to - source->from;
    int count = source->curve ? segments : 1;
    text_add(text, "\"points\":[");
    for (int i = 0; i <= count; i++) {
        double s = first + length * i / count;
        struct vec r = source->curve ? curve_at(source->curve, NULL, s).r : vec_scale(s, e);
        json_comma(text, (size_t)i);
        json_vector(text, vec_add(from, r));
    }
    text_add(text, "],");
}

static void write_coupling(struct text *text, const struct record *record, const struct coupling *coupling,
                           const struct coupling_state *state)
{
    const struct fbd_model *model = record->model;
    text_add(text, "\n{");
    json_text_member(text, "kind", coupling->law->drawing);
    json_text_member(text, "name", coupling->name);
    text_add(text, "\"ends\":[");
    for (int k = 0; k < coupling->end_count; k++) write_end(text, model, coupling, state, k);
    text_add(text, "],");
    if (coupling->kind == constraint_slot || coupling->kind == constraint_groove)
        write_slot(text, model, coupling);
    json_number_member(text, "length", coupling->reels ? 0 : state->zero);
    json_vector_member(text, "e", vec_unit(model->scene->constraints[coupling->constraint].along));
    page_speed_write(text, &coupling->source->surface_speed);
    text_printf(text, "\"side\":%d,\"force\":%d}", state->side[0], force_column(record, coupling));
}

/* The surface of a contact: {point, e, n} of a line of the ground, {corners} of a polygon, {body} of a body whose surface
 * runs. */
static void write_surface(struct text *text, const struct constraint *source, int side)
{
    const struct polygon *polygon = source->contact.polygon;
    struct vec e = vec_unit(source->along);
    text_add(text, "{");
    page_speed_write(text, &source->surface_speed);
    if (!source->contact.line && !polygon) {
        text_printf(text, "\"body\":%d", source->body[1]);
    } else if (!polygon) {
        json_vector_member(text, "point", source->point[1].where);
        json_vector_member(text, "e", e);
        text_add(text, "\"n\":");
        json_vector(text, vec_scale(side, vec_perp(e)));
    } else {
        text_add(text, "\"corners\":[");
        for (size_t i = 0; i < polygon->count; i++) {
            json_comma(text, i);
            json_vector(text, polygon->corners[i]);
        }
        text_add(text, "]");
    }
    text_add(text, "}");
}

static void write_surfaces(struct text *text, const fbd_result *result, const struct record *record)
{
    const struct tree *tree = record->model->tree;
    size_t written = 0;
    text_add(text, "\"surfaces\":[");
    for (int i = 0; i < tree->meeting_count; i++) {
        const struct meeting *meeting = &tree->meetings[i];
        const struct constraint *source = &record->model->scene->constraints[meeting->constraint];
        if (!source->contact.line && !source->contact.polygon && !source->surface_speed.expr) continue;
        json_comma(text, written++);
        write_surface(text, source, result->start->tree->couplings[meeting->first_coupling].side[0]);
    }
    text_add(text, "],\n");
}

void page_couplings_write(struct text *text, const fbd_result *result, const struct record *record)
{
    const struct tree *tree = record->model->tree;
    size_t written = 0;
    text_add(text, "\"couplings\":[");
    for (int i = 0; i < tree->coupling_count; i++) {
        if (tree->couplings[i].meeting >= 0) continue; /* its shapes and its forces are drawn */
        if (tree->couplings[i].kind == constraint_resistance) continue; /* its roll is drawn */
        json_comma(text, written++);
        write_coupling(text, record, &tree->couplings[i], &result->start->tree->couplings[i]);
    }
    text_add(text, "],\n");
    write_surfaces(text, result, record);
}
