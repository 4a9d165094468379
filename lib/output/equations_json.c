/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The assembled equations and the free-body diagrams of a state as one JSON object (docs/output.md).
 */
#include <stdlib.h>

#include "dynamics/kinematics.h"
#include "fbd_export.h"
#include "output/display_units.h"
#include "output/kinematic_lines.h"
#include "output/terms.h"

/* A quantity with its name and unit. */
static void quantity(struct text *text, const char *key, const char *name, double value, const char *unit)
{
    text_json_key(text, key);
    text_add(text, "{");
    text_json_words(text, "name", name, ", ");
    text_json_member(text, "value", value, ", ");
    text_json_words(text, "unit", unit, "}");
}

static void write_coordinates(struct text *text, const struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    size_t n = (size_t)model->plan.n;
    text_add(text, "  \"coordinates\": {");
    for (size_t i = 0; i < n; i++) {
        text_add(text, i ? ", " : "");
        const double size = display_of_component(model, i, state->degrees).size;
        text_json_member(text, model->labels[i].name, state->y[i] / size, ", ");
        text_json_member(text, model->labels[i].rate_name, state->y[n + i] / size, "");
    }
    text_add(text, "},\n");
}

/* Write the user states, their values and rates. */
static void write_states(struct text *text, const struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    const int n = model->plan.n, own = model->plan.own;
    if (own == 0) return;
    text_add(text, "  \"states\": {");
    for (int i = 0; i < own; i++) {
        text_add(text, i ? ",\n    " : "\n    ");
        text_json_key(text, model->scene->own[i].name);
        text_add(text, "{");
        text_json_member(text, "value", state->y[2 * n + i], ", ");
        text_json_words(text, "unit", model->own_labels[i].unit, ", ");
        text_json_member(text, "rate", state->a[n + i], ", ");
        text_json_words(text, "rate_unit", model->own_labels[i].rate_unit, "}");
    }
    text_add(text, "\n  },\n");
}

/* The state to be written, and the symbols. */
struct written {
    struct fbd_state *state;
    bool components;
    struct formulas *formulas; /* NULL: without symbols */
};

static bool has_symbols(const struct written *written, const struct equation *equation)
{
    return written->formulas && equation_in_symbols(written->state->model, equation, written->components);
}

/* A text that is NULL when memory is out. */
static void symbols(struct text *text, const char *key, const char *words, const char *after)
{
    text->failed |= !words;
    if (words) text_json_words(text, key, words, after);
}

static void write_term(struct text *text, const struct written *written, const struct equation *equation,
                       size_t i)
{
    struct fbd_state *state = written->state;
    const char *name = equation->public.terms[i].name;
    char remark[term_remark_size];
    if (!equation_remark(state, equation, i, remark)) text->failed = true;
    text_add(text, i ? ",\n       {" : "\n       {");
    text_json_words(text, "name", name, ", ");
    if (has_symbols(written, equation))
        symbols(text, "symbol", formula_term(written->formulas, equation, name), ", ");
    text_json_member(text, "value", equation->public.terms[i].value, remark[0] ? ", " : "}");
    if (remark[0]) text_json_words(text, "remark", remark, "}");
}

static void write_equation(struct text *text, const struct written *written, const struct equation *equation)
{
    const fbd_equation *e = &equation->public;
    const char *mode = equation->cut_free ? "" : term_mode(written->state, equation->body);
    text_add(text, "    {");
    text_json_words(text, "body", e->body, ", ");
    text_json_words(text, "coordinate", e->coordinate, ",\n     ");
    if (has_symbols(written, equation))
        symbols(text, "symbols", formula_line(written->formulas, equation), ",\n     ");
    quantity(text, "inertia", e->inertia_name, e->inertia, e->inertia_unit);
    text_add(text, ",\n     ");
    quantity(text, "acceleration", e->acceleration_name, e->acceleration, e->acceleration_unit);
    text_add(text, ",\n     ");
    quantity(text, "sum", "sum", e->sum, e->unit);
    text_add(text, ",\n     ");
    text_json_member(text, "residual", e->inertia * e->acceleration - e->sum, ", ");
    if (mode[0]) text_json_words(text, "mode", mode, ", ");
    text_add(text, "\"terms\": [");
    for (size_t i = 0; i < e->term_count; i++) write_term(text, written, equation, i);
    text_add(text, "]}");
}

static void write_equations(struct text *text, const struct written *written, const fbd_equations *all)
{
    const struct fbd_model *model = written->state->model;
    bool first = true;
    text_add(text, "  \"equations\": [");
    for (size_t i = 0; i < all->count; i++) {
        const struct equation *equation = &all->equations[i];
        if (equation->cut_free && !written->components && !equation_in_symbols(model, equation, false))
            continue;
        text_add(text, first ? "\n" : ",\n");
        first = false;
        write_equation(text, written, equation);
    }
    text_add(text, "\n  ],\n");
}

/* For the bodies that are cut free. */
static void write_kinematics(struct text *text, const struct written *written)
{
    const struct fbd_model *model = written->state->model;
    const char *lines[most_kinematic_lines], *before = "  \"kinematics\": {\n    ";
    for (size_t b = 0; written->formulas && b < model->body_count; b++) {
        const int count = body_is_cut_free(model, (int)b, written->components)
                              ? kinematic_lines(written->formulas, (int)b, lines)
                              : 0;
        for (int i = 0; i < count; i++) {
            text->failed |= !lines[i];
            if (!lines[i]) return;
            if (i == 0) {
                text_add(text, before);
                text_json_key(text, model->bodies[b].name);
            }
            text_add(text, i == 0 ? "[" : ", ");
            text_json_string(text, lines[i]);
        }
        if (count == 0) continue;
        text_add(text, "]");
        before = ",\n    ";
    }
    if (before[0] == ',') text_add(text, "\n  },\n");
}

static void write_arrow(struct text *text, const fbd_arrow *arrow)
{
    text_json_key(text, arrow->name);
    text_add(text, "{");
    text_json_member(text, "fx", arrow->fx, ", ");
    text_json_member(text, "fy", arrow->fy, ", ");
    text_json_member(text, "x", arrow->x, ", ");
    text_json_member(text, "y", arrow->y, ", ");
    text_json_member(text, "couple", arrow->couple, ", ");
    text_json_member(text, "moment", arrow->moment, ", ");
    text_json_member(text, "power", arrow->power, "}");
}

static void write_body(struct text *text, struct fbd_state *state, int b, struct arrow *arrows)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    struct instant at = state_instant(state);
    struct pose pose = body_pose(body, &at);
    struct vec about =
        body->kind == motion_pivot ? pose.origin : point_motion(body, &pose, body->inertia.G).p;
    size_t count = diagram_fill(model, b, &at, state->a, state->slots, arrows);
    text_json_key(text, body->name);
    text_add(text, "{");
    for (size_t i = 0; i < count; i++) {
        fbd_arrow arrow = public_arrow(&arrows[i], about);
        text_add(text, i ? ",\n      " : "\n      ");
        write_arrow(text, &arrow);
    }
    text_add(text, "}");
}

static void write_forces(struct text *text, struct fbd_state *state, struct arrow *arrows)
{
    text_add(text, "  \"forces\": {");
    state_ready(state);
    for (size_t b = 0; b < state->model->body_count; b++) {
        text_add(text, b ? ",\n    " : "\n    ");
        write_body(text, state, (int)b, arrows);
    }
    text_add(text, "\n  }\n");
}

static char *json_of(fbd_state *state, bool components)
{
    if (!state) return NULL;
    struct text text = {0};
    struct formulas formulas = {0};
    struct written written = {state, components, NULL};
    fbd_equations *all = assemble(state, true);
    struct arrow *arrows = calloc(diagram_most_arrows(state->model), sizeof *arrows);
    bool done = all && arrows;
    if (done && equations_cut_free(state->model, true)) {
        written.formulas = &formulas;
        done = formulas_begin(&formulas, state);
    }
    if (done) {
        text_add(&text, "{\n  ");
        text_json_words(&text, "title", state->model->scene->title, ",\n  ");
        text_json_words(&text, "units", state->model->scene->units == unit_si ? "SI" : "US", ",\n  ");
        if (state->degrees) text_json_words(&text, "angles", "deg", ",\n  ");
        text_json_member(&text, "t", state->t, ",\n");
        write_coordinates(&text, state);
        write_states(&text, state);
        write_equations(&text, &written, all);
        write_kinematics(&text, &written);
        write_forces(&text, state, arrows);
        text_add(&text, "}\n");
    }
    if (!done || text.failed || formulas.arena.failed) text_free(&text);
    formulas_end(&formulas);
    free(arrows);
    fbd_equations_free(all);
    return text.data;
}

char *fbd_equations_json(fbd_state *state)
{
    return json_of(state, false);
}

char *fbd_equations_json_components(fbd_state *state)
{
    return json_of(state, true);
}
