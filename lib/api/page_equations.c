/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The equations of a body in the data of a page: the terms by name, column and symbol.
 */
#include <string.h>

#include "api/page_equations.h"
#include "base/json.h"
#include "output/kinematic_lines.h"
#include "output/words.h"

/* Works on a copy, since evaluation changes a state. */
bool symbolic_begin(struct symbolic *symbolic, const fbd_state *start)
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

void symbolic_end(struct symbolic *symbolic)
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

void page_equations_write(struct text *text, struct symbolic *symbolic, const struct record *record, int b)
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
