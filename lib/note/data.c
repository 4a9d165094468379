/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data of a note: parameters, bodies, forces, connections, start values.
 */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "note/given.h"

/* ---- parameters */

static const char *remark_of(struct making *making, const fbd_parameter *parameter)
{
    struct text *text = making_begin(making);
    text_shown(text, parameter->description);
    const char *between = parameter->description[0] ? "; " : "";
    if (parameter->input)
        text_printf(text, "%san input, %s", between,
                    isnan(parameter->value) ? "by a callback of the program, not of the file"
                                            : "constant in this run");
    else if (parameter->derived)
        text_printf(text, "%sfollows from others", between);
    return making_take(making);
}

/* Without remarks their column is left out. */
static void list_parameters(struct making *making)
{
    static const char *const heads[] = {"Letter", "Value", "Remark"};
    const size_t count = fbd_model_parameter_count(making->model);
    bool remarks = false;
    for (size_t i = 0; i < count; i++) {
        const fbd_parameter parameter = fbd_model_parameter(making->model, i);
        remarks = remarks || parameter.description[0] || parameter.input || parameter.derived;
    }
    struct block *table =
        count > 0 ? document_table(making->document, "parameters", remarks ? "lrw" : "lr", heads) : NULL;
    for (size_t i = 0; i < count; i++) {
        const fbd_parameter parameter = fbd_model_parameter(making->model, i);
        document_cell(making->document, table, making_symbol(making, parameter.name));
        document_cell(making->document, table,
                      isnan(parameter.value)
                          ? "u(t, y)"
                          : making_value(making, parameter.value, parameter.unit, note_digits));
        if (remarks) document_cell(making->document, table, remark_of(making, &parameter));
    }
}

/* ---- bodies */

static double distance(const double a[2], const double b[2])
{
    return hypot(b[0] - a[0], b[1] - a[1]);
}

static void write_shape(struct text *text, const fbd_shape *shape, const char *unit)
{
    if (shape->hole) text_add(text, "less ");
    switch (shape->kind) {
    case FBD_SHAPE_DOT: text_add(text, "point mass"); break;
    case FBD_SHAPE_BAR:
        text_add(text, "rod of length ");
        value_write(text, distance(shape->corners[0], shape->corners[1]), unit, note_digits, false);
        break;
    case FBD_SHAPE_CIRCLE:
        text_add(text, shape->inner > 0 ? "ring of radii " : "disc of radius ");
        if (shape->inner > 0) value_write(text, shape->inner, unit, note_digits, false);
        if (shape->inner > 0) text_add(text, " and ");
        value_write(text, shape->radius, unit, note_digits, false);
        break;
    case FBD_SHAPE_POLYGON:
        text_printf(text, "%d corners, sides ", (int)shape->corner_count);
        for (size_t i = 0; i < shape->corner_count; i++) {
            if (i) text_add(text, i + 1 < shape->corner_count ? ", " : " and ");
            value_write(text, distance(shape->corners[i], shape->corners[(i + 1) % shape->corner_count]),
                        unit, note_digits, false);
        }
        break;
    case FBD_SHAPE_UNKNOWN: text_add(text, "not given"); break;
    }
}

static const char *shape_of(struct making *making, size_t body)
{
    const char *unit = fbd_model_units(making->model).length;
    const size_t count = fbd_model_shape_count(making->model, body);
    struct text *text = making_begin(making);
    if (count == 0) text_add(text, "not given");
    for (size_t i = 0; i < count; i++) {
        const fbd_shape shape = fbd_model_shape(making->model, body, i);
        if (i) text_add(text, "; ");
        write_shape(text, &shape, unit);
    }
    return making_take(making);
}

static const char *motion_of(struct making *making, const struct given *given, const fbd_body *body)
{
    static const char *const motions[] = {
        [FBD_MOTION_SLIDE] = "slides on a line",
        [FBD_MOTION_PIVOT] = "turns about an axis",
        [FBD_MOTION_PARTICLE] = "particle",
        [FBD_MOTION_PLANAR] = "free in the plane",
        [FBD_MOTION_WELD] = "fixed",
        [FBD_MOTION_TRACK] = "slides on a curve",
    };
    struct text *text = making_begin(making);
    text_add(text, motions[body->motion]);
    if (body->carrier != FBD_GROUND)
        text_printf(text, " of %s", fbd_model_body_name(making->model, (size_t)body->carrier));
    given_motion(given, body->name, text);
    return making_take(making);
}

static void list_bodies(struct making *making, const struct given *given)
{
    static const char *const heads[] = {"Body", "Motion", "Mass", "Moment of inertia about G", "Shape"};
    struct document *document = making->document;
    const fbd_units units = fbd_model_units(making->model);
    struct block *table = document_table(document, "bodies at the start", "lwrrw", heads);
    for (size_t b = 0; b < fbd_model_body_count(making->model); b++) {
        const fbd_body body = fbd_model_body(making->model, b);
        const fbd_mass mass = fbd_view_mass(making->view, b);
        document_cell(document, table, body.name);
        document_cell(document, table, motion_of(making, given, &body));
        document_cell_format(document, table, "%s = %s", mass.printed,
                             making_value(making, mass.mass, units.mass, note_digits));
        document_cell(document, table,
                      mass.I_G > 0 ? making_value(making, mass.I_G, units.inertia, note_digits) : "–");
        document_cell(document, table, shape_of(making, b));
    }
}

/* ---- couplings and contacts */

static const char *ends_of(struct making *making, const fbd_connection *connection)
{
    struct text *text = making_begin(making);
    for (size_t i = 0; i < connection->end_count && i < FBD_CONNECTION_ENDS; i++) {
        const int body = connection->ends[i].body;
        text_printf(text, "%s%s", i ? ", " : "",
                    body == FBD_GROUND ? "ground" : fbd_model_body_name(making->model, (size_t)body));
    }
    return making_take(making);
}

/* The keys of the file; a length that follows from the start. */
static const char *values_of(struct making *making, const struct given *given,
                             const fbd_connection *connection)
{
    const bool keeps = strcmp(connection->kind, "rope") == 0 || strcmp(connection->kind, "rod") == 0;
    struct text *text = making_begin(making);
    given_connection(given, connection->name, text);
    if (keeps && isnan(connection->length))
        text_add(text, text->length > 0 ? ", length of the start" : "length of the start");
    return making_take(making);
}

static void list_connections(struct making *making, const struct given *given)
{
    enum { most_listed = 60 };
    static const char *const heads[] = {"Connection", "Kind", "Between", "Given"};
    struct document *document = making->document;
    const size_t count = fbd_model_connection_count(making->model);
    struct block *table =
        count > 0 ? document_table(document, "couplings and contacts", "llww", heads) : NULL;
    for (size_t i = 0; i < count && i < most_listed; i++) {
        const fbd_connection connection = fbd_model_connection(making->model, i);
        document_cell(document, table, connection.name);
        document_cell(document, table, connection.kind);
        document_cell(document, table, ends_of(making, &connection));
        document_cell(document, table, values_of(making, given, &connection));
    }
    if (count > most_listed)
        document_paragraph(document, "And %zu more, which the model file lists.", count - most_listed);
}

/* ---- the start */

static void list_starts(struct making *making)
{
    static const char *const heads[] = {"Coordinate", "At the start", "Rate", "At the start"};
    struct document *document = making->document;
    const size_t count = fbd_model_coordinate_count(making->model);
    struct block *table = count > 0 ? document_table(document, "coordinates at t = 0", "lrlr", heads) : NULL;
    for (size_t i = 0; i < count; i++) {
        const fbd_coordinate coordinate = fbd_model_coordinate(making->model, i);
        double q = 0, v = 0;
        fbd_state_get(making->start, coordinate.name, &q);
        fbd_state_get(making->start, coordinate.rate_name, &v);
        document_cell(document, table, making_symbol(making, coordinate.name));
        document_cell(document, table, making_value(making, q, coordinate.unit, note_digits));
        document_cell(document, table, making_symbol(making, coordinate.rate_name));
        document_cell(document, table, making_value(making, v, coordinate.rate_unit, note_digits));
    }
}

void note_data(struct making *making)
{
    const struct given *given = given_open(making);
    document_heading(making->document, 2, "Data");
    list_parameters(making);
    if (!given) {
        making->document->arena.failed = true;
        return;
    }
    list_bodies(making, given);
    given_forces(making, given);
    list_connections(making, given);
    list_starts(making);
    document_paragraph(making->document,
                       "The model file in the appendix contains all data, with the units in which they "
                       "were given.");
}
