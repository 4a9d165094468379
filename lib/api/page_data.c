/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data of the page about a run, as one JSON object:
 *
 * - title, units, angles, reason, stats: as in the JSON of the run; start and end [s] - rows, thinned,
 * bucket, buckets, doubleColumns, floatColumns: of the data - columns: {n: name, u: unit} and one of {c:
 * constant}, {of, a, b: a + b column[of]}, {d | f: number of data} - doubles, floats, envelope: base 64, see
 * pack.h; `doubles` begins with the times - bodies: {name, motion, parent, frame: 3 columns, shapes, G, axis
 * | line, arrows, equations, kinematics} - links: springs and dampers with another end; couplings (both:
 * page_links.c) - energy: 4 columns - states: user states - events: {kinds, labels, times, of: index into
 * labels, details}
 *
 * Names and titles are data, never markup: the script inserts them as text.
 */
#include <string.h>

#include "api/pack.h"
#include "api/page_data.h"
#include "base/json.h"
#include "fbd_view.h"
#include "output/kinematic_lines.h"
#include "output/words.h"

enum { most_bytes = 3600 * 1024, most_listed_events = 60000, bytes_of_event = 26, most_details = 2000 };

/* ---- columns */

static void write_columns(struct text *text, const struct pack *pack)
{
    const struct record *record = pack->record;
    text_add(text, "\"columns\":[");
    for (size_t c = 0; c < record->column_count; c++) {
        const struct packed_column *packed = &pack->columns[c];
        json_comma(text, c);
        text_add(text, "\n{");
        json_text_member(text, "n", record->columns[c].name);
        json_text_member(text, "u", record->columns[c].unit);
        switch (packed->kind) {
        case packed_constant:
            json_key(text, "c");
            json_number(text, packed->offset);
            break;
        case packed_affine:
            json_number_member(text, "a", packed->offset);
            json_number_member(text, "b", packed->factor);
            text_printf(text, "\"of\":%d", packed->of);
            break;
        case packed_double: text_printf(text, "\"d\":%zu", packed->slot); break;
        case packed_float: text_printf(text, "\"f\":%zu", packed->slot); break;
        }
        text_add(text, "}");
    }
    text_add(text, "],\n");
}

static void write_numbers(struct text *text, const struct pack *pack)
{
    const struct record *record = pack->record;
    text_printf(text,
                "\"rows\":%zu,\"thinned\":%s,\"buckets\":%zu,\"doubleColumns\":%zu,\"floatColumns\":%zu,",
                record->count, record_is_thinned(record) ? "true" : "false", record->bucket_count,
                pack->doubles, pack->floats);
    json_number_member(text, "bucket", record->bucket);
    text_add(text, "\n\"doubles\":\"");
    pack_write_doubles(pack, text);
    text_add(text, "\",\n\"floats\":\"");
    pack_write_floats(pack, text);
    text_add(text, "\",\n\"envelope\":\"");
    pack_write_envelope(pack, text);
    text_add(text, "\",\n");
}

/* ---- bodies */

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

/* The equations of the start, for their symbols. */
struct symbolic {
    struct formulas formulas;
    fbd_equations *equations;
    const struct equation *now; /* the equation being written, or NULL */
    size_t written;             /* of the body */
};

/* Works on a copy, since evaluation changes a state. */
static bool symbolic_begin(struct symbolic *symbolic, const fbd_state *start)
{
    if (!equations_cut_free(start->model, true)) return true;
    fbd_state *copy = state_new(start->model);
    if (!copy) return false;
    state_copy(copy, start);
    symbolic->equations = assemble(copy, true);
    bool begun = formulas_begin(&symbolic->formulas, copy);
    symbolic->formulas.slipping = false;
    return begun && symbolic->equations;
}

static void symbolic_end(struct symbolic *symbolic)
{
    fbd_equations_free(symbolic->equations);
    formulas_end(&symbolic->formulas);
    state_free(symbolic->formulas.state);
}

static const struct equation *find_equation(const fbd_equations *all, const char *name)
{
    for (size_t i = 0; i < all->count; i++) {
        const fbd_equation *e = &all->equations[i].public;
        const size_t length = strlen(e->body);
        if (strncmp(name, e->body, length) == 0 && name[length] == '.' &&
            strcmp(name + length + 1, e->coordinate) == 0)
            return &all->equations[i];
    }
    return NULL;
}

/* One equation: inertia * acceleration = sum of terms. */
struct row {
    const char *body, *coordinate, *inertia, *inertia_unit, *acceleration, *acceleration_unit, *unit;
    double value; /* of the inertia, at the start */
    int column;   /* of the acceleration */
    int mass;     /* column of the mass to which the inertia is proportional, or -1; */
    double start; /* and the mass at the start */
};

static void begin_equation(struct text *text, struct symbolic *symbolic, const struct row *row)
{
    struct text name = {0};
    text_printf(&name, row->body ? "%s.%s" : "%s%s", row->body ? row->body : "", row->coordinate);
    json_comma(text, symbolic->written++);
    text_add(text, "\n{");
    json_text_member(text, "name", name.data ? name.data : "");
    symbolic->now = name.data && symbolic->equations ? find_equation(symbolic->equations, name.data) : NULL;
    text->failed |= name.failed;
    text_free(&name);
    const char *left = symbolic->now ? formula_left(&symbolic->formulas, symbolic->now) : NULL;
    json_text_member(text, "inertia", row->inertia);
    json_text_member(text, "left", left ? left : "");
    json_number_member(text, "value", row->value);
    if (row->mass >= 0) {
        text_printf(text, "\"mass\":%d,", row->mass);
        json_number_member(text, "massAtStart", row->start);
    }
    json_text_member(text, "inertiaUnit", row->inertia_unit);
    json_text_member(text, "accelerationName", row->acceleration);
    json_text_member(text, "accelerationUnit", row->acceleration_unit);
    json_text_member(text, "unit", row->unit);
    text_printf(text, "\"acceleration\":%d,\"terms\":[", row->column);
}

static void write_term(struct text *text, struct symbolic *symbolic, const char *name, int column,
                       bool *first)
{
    const char *symbol = symbolic->now ? formula_term(&symbolic->formulas, symbolic->now, name) : "";
    if (!*first) text_add(text, ",");
    *first = false;
    text_add(text, "[");
    text_json_string(text, name);
    text_printf(text, ",%d,", column);
    text_json_string(text, symbol ? symbol : "");
    text_add(text, "]");
    text->failed |= symbolic->formulas.arena.failed;
}

/* The equation of a coordinate. */
static void write_coordinate_equation(struct text *text, struct symbolic *symbolic,
                                      const struct record *record, int b, int k)
{
    const struct fbd_model *model = record->model;
    const struct model_body *body = &model->bodies[b];
    const struct record_of_body *columns = &record->bodies[b];
    const struct label *label = &model->labels[body->first + k];
    struct row row = {.coordinate = label->name,
                      .inertia = body->joint->coordinates[k].inertia,
                      .inertia_unit = label->inertia_unit,
                      .acceleration = equation_acceleration_name(model, body, k),
                      .acceleration_unit = label->acceleration_unit,
                      .unit = label->force_unit,
                      .value = coordinate_inertia(body, k),
                      .column = columns->equation + k,
                      .mass = columns->mass,
                      .start = body->inertia.mass};
    begin_equation(text, symbolic, &row);
    bool first = true;
    for (size_t i = 0; i < columns->arrow_count; i++) {
        const struct record_of_arrow *arrow = &columns->arrows[i];
        if (arrow->term >= 0) write_term(text, symbolic, arrow->name, arrow->term + k, &first);
    }
    if (columns->moving_axis >= 0)
        write_term(text, symbolic, body->joint->has_axis ? "moving axis" : "turning along",
                   columns->moving_axis, &first);
    text_add(text, "]}");
}

/* The Newton-Euler equations of a body cut free, reactions included. */
static void write_newton_equations(struct text *text, struct symbolic *symbolic, const struct record *record,
                                   int b)
{
    const struct fbd_model *model = record->model;
    const struct model_body *body = &model->bodies[b];
    const struct record_of_body *columns = &record->bodies[b];
    static const char *const names[] = {"G.x", "G.y", "G.angle"}, *const accelerations[] = {"a_Gx", "a_Gy",
                                                                                            "alpha"};
    bool si = model->scene->units == unit_si;
    for (int part = 0; part < 3; part++) {
        bool turns = part == 2;
        struct row row = {.body = body->name,
                          .coordinate = names[part],
                          .inertia = turns ? "I_G" : "m",
                          .inertia_unit = turns ? (si ? "kg*m^2" : "slug*ft^2")
                                          : si  ? "kg"
                                                : "slug",
                          .acceleration = accelerations[part],
                          .acceleration_unit = turns ? "rad/s^2"
                                               : si  ? "m/s^2"
                                                     : "ft/s^2",
                          .unit = turns ? moment_unit(model) : force_unit(model),
                          .value = turns ? body->inertia.I_G : body->inertia.mass,
                          .column = columns->newton + part,
                          .mass = columns->mass,
                          .start = body->inertia.mass};
        if (!newton_in_symbols(model, symbolic->equations, b, part, record->components)) continue;
        begin_equation(text, symbolic, &row);
        bool first = true;
        for (size_t i = 0; i < columns->arrow_count; i++)
            write_term(text, symbolic, columns->arrows[i].name, columns->arrows[i].components + part, &first);
        text_add(text, "]}");
    }
}

static void write_equations(struct text *text, struct symbolic *symbolic, const struct record *record, int b)
{
    const struct model_body *body = &record->model->bodies[b];
    text_add(text, "\"equations\":[");
    symbolic->written = 0;
    for (int k = 0; k < body->count; k++)
        if (equation_is_written(record->model, b, false, k, record->components))
            write_coordinate_equation(text, symbolic, record, b, k);
    write_newton_equations(text, symbolic, record, b);
    text_add(text, "],\"kinematics\":[");
    const char *lines[most_kinematic_lines];
    const bool display = symbolic->equations && body_is_cut_free(record->model, b, record->components);
    const int count = display ? kinematic_lines(&symbolic->formulas, b, lines) : 0;
    for (int i = 0; i < count; i++) {
        text->failed |= !lines[i];
        json_comma(text, (size_t)i);
        text_json_string(text, lines[i] ? lines[i] : "");
    }
    text_add(text, "],");
}

/* The curve of a track as points in the frame of the body that carries it. */
static void write_track(struct text *text, const fbd_model *model, size_t b, int carrier)
{
    enum { segments = 400 };
    const fbd_track track = fbd_model_track(model, b);
    struct vec zero = {0, 0}; /* origin of the carrier's frame in the page */
    if (carrier != FBD_GROUND) zero = vec_of(fbd_model_body(model, (size_t)carrier).pin);
    text_printf(text, "\"track\":{\"on\":%d,\"points\":[", carrier);
    for (int i = 0; i <= segments; i++) {
        double s = track.start + track.length * i / segments;
        const fbd_track_place place = fbd_model_track_place(model, b, s);
        json_comma(text, (size_t)i);
        json_vector(text, vec_sub((struct vec){place.x, place.y}, zero));
    }
    text_add(text, "]},");
}

static void write_line(struct text *text, const fbd_model *model, size_t b, const fbd_body *body)
{
    struct vec along = vec_of(body->along), normal = vec_of(body->normal), down = vec_scale(-1, normal);
    struct vec in_body = {vec_dot(down, along), vec_dot(down, vec_perp(along))};
    text_add(text, "\"line\":{\"through\":");
    json_vector(text, vec_of(body->joint));
    text_add(text, ",\"along\":");
    json_vector(text, along);
    text_add(text, ",\"normal\":");
    json_vector(text, normal);
    text_printf(text, ",\"on\":%d", body->carrier);
    text_printf(text, ",\"surface\":%s,\"reach\":", body->surface ? "true" : "false");
    const double in_frame[2] = {in_body.x, in_body.y};
    json_number(text, fmax(0, fbd_model_extent(model, b, fbd_model_inertia(model, b).G, in_frame)));
    text_add(text, "},");
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
}

static void write_body(struct text *text, struct symbolic *symbolic, const struct record *record, size_t b)
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
    write_equations(text, symbolic, record, (int)b);
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

/* ---- events */

/* True for events of the same kind, body and source: their label is written once, for the first of them. */
static bool alike(const struct run_event *a, const struct run_event *b)
{
    return a->kind == b->kind && a->body == b->body && a->load == b->load && a->watch == b->watch;
}

/* The page lists so many events at most, and gives the total number; the JSON of the run has all. */
static size_t listed_events(const struct ensemble *run)
{
    size_t count = run->event_count;
    if (count > most_listed_events) count = most_listed_events;
    return count;
}

static void write_labels(struct text *text, const struct ensemble *run, size_t count)
{
    enum { most_labels = 4096 };
    const struct run_event *labels[most_labels];
    size_t label_count = 0;
    struct text of = {0};
    text_add(text, "\"labels\":[");
    for (size_t i = 0; i < count; i++) {
        const struct run_event *event = &run->events[i];
        size_t k = 0;
        while (k < label_count && !alike(labels[k], event)) k++;
        if (k == label_count && label_count < most_labels) {
            json_comma(text, label_count);
            labels[label_count++] = event;
            text_add(text, "{");
            json_text_member(text, "body", event_body(run->model, event));
            json_text_member(text, "kind", fbd_event_kind_name(event->kind));
            json_key(text, "name");
            text_json_string(text, event_name(run->model, event));
            text_add(text, "}");
        }
        json_comma(&of, i);
        if (k < label_count)
            text_printf(&of, "%zu", k);
        else
            text_add(&of, "null");
    }
    text_add(text, "],\"of\":[");
    if (of.data) text_add(text, of.data);
    text_add(text, "],");
    text->failed |= of.failed;
    text_free(&of);
}

static void write_events(struct text *text, const struct ensemble *run)
{
    size_t count = listed_events(run);
    text_printf(text, "\"events\":{\"count\":%zu,", run->event_count);
    write_labels(text, run, count);
    text_add(text, "\"times\":[");
    for (size_t i = 0; i < count; i++) {
        json_comma(text, i);
        json_number(text, run->events[i].t);
    }
    text_add(text, "],\"details\":[");
    for (size_t i = 0; i < count && i < most_details; i++) {
        char detail[event_detail_size];
        event_detail(run->model, &run->events[i], detail, sizeof detail);
        json_comma(text, i);
        text_json_string(text, detail);
    }
    text_add(text, "]},\n");
}

/* ---- the whole */

static void write_head(struct text *text, fbd_result *result)
{
    const struct ensemble *run = result->simulation->ensemble;
    const struct fbd_model *model = run->model;
    fbd_stats stats = fbd_simulation_stats(result->simulation);
    struct text title = {0};
    text_shown(&title, model->scene->title);
    json_text_member(text, "title", title.data ? title.data : "");
    text->failed |= title.failed;
    text_free(&title);
    json_text_member(text, "reason", run->reason);
    if (result->degrees) json_text_member(text, "angles", "deg");
    json_number_member(text, "start", result->start->t);
    json_number_member(text, "end", run->t);
    text_printf(text, "\"units\":{\"length\":\"%s\",\"force\":\"%s\",\"moment\":\"%s\",\"energy\":\"%s\"},\n",
                length_unit(model), force_unit(model), moment_unit(model), energy_unit(model));
    text_add(text, "\"stats\":{");
    json_text_member(text, "method", stats.method);
    json_number_member(text, "tolerance", stats.tolerance);
    json_number_member(text, "seconds", stats.seconds);
    text_printf(text, "\"steps\":%lu,\"rejected\":%lu,\"rhs\":%lu,\"jacobians\":%lu,\"stiffSteps\":%lu},\n",
                stats.steps, stats.rejected, stats.rhs, stats.jacobians, stats.stiff_steps);
}

bool page_data_write(struct text *text, fbd_result *result, struct record *record, size_t most)
{
    struct pack pack;
    struct symbolic symbolic = {0};
    size_t bytes = most ? most : most_bytes,
           events = bytes_of_event * listed_events(result->simulation->ensemble);
    bytes -= events < bytes / 2 ? events : bytes / 2;
    if (!pack_begin(&pack, record, bytes)) return false;
    text_add(text, "{");
    write_head(text, result);
    write_columns(text, &pack);
    write_numbers(text, &pack);
    text_add(text, "\"bodies\":[");
    if (!symbolic_begin(&symbolic, result->start)) text->failed = true;
    for (size_t b = 0; b < record->model->body_count && !text->failed; b++) {
        json_comma(text, b);
        write_body(text, &symbolic, record, b);
    }
    symbolic_end(&symbolic);
    text_add(text, "],\n");
    page_links_write(text, record);
    page_couplings_write(text, result, record);
    write_events(text, result->simulation->ensemble);
    json_columns_member(text, "energy", record->energy, 4);
    json_columns_member(text, "states", record->energy + 4, record->model->plan.own);
    text_add(text, "\"version\":1}");
    pack_end(&pack);
    return !text->failed;
}
