/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The assembled equations and the free-body diagrams of a state as one JSON object (docs/output.md).
 */
#include "dynamics/kinematics.h"
#include "output/display_units.h"
#include "output/equations_write.h"
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

static void write_head(struct writer *w)
{
    struct text *text = w->text;
    const struct fbd_state *state = w->state;
    text_add(text, "{\n  ");
    text_json_words(text, "title", state->model->scene->title, ",\n  ");
    text_json_words(text, "units", state->model->scene->units == unit_si ? "SI" : "US", ",\n  ");
    if (state->degrees) text_json_words(text, "angles", "deg", ",\n  ");
    text_json_member(text, "t", state->t, ",\n");
    write_coordinates(text, state);
    write_states(text, state);
    text_add(text, "  \"equations\": [");
}

/* ---- equations */

static bool is_included(const struct writer *w, const struct equation *equation)
{
    return !equation->cut_free || w->components || equation_in_symbols(w->state->model, equation, false);
}

static bool has_symbols(const struct writer *w, const struct equation *equation)
{
    return w->symbolic && equation_in_symbols(w->state->model, equation, w->components);
}

/* A text that is NULL when memory is out. */
static void symbols(struct text *text, const char *key, const char *words, const char *after)
{
    text->failed |= !words;
    if (words) text_json_words(text, key, words, after);
}

static void write_term(struct writer *w, const struct equation *equation, size_t i)
{
    struct text *text = w->text;
    const char *name = equation->public.terms[i].name;
    char remark[term_remark_size];
    if (!equation_remark(w->state, equation, i, remark)) text->failed = true;
    text_add(text, i ? ",\n       {" : "\n       {");
    text_json_words(text, "name", name, ", ");
    if (has_symbols(w, equation)) symbols(text, "symbol", formula_term(&w->formulas, equation, name), ", ");
    text_json_member(text, "value", equation->public.terms[i].value, remark[0] ? ", " : "}");
    if (remark[0]) text_json_words(text, "remark", remark, "}");
}

static void write_equation(struct writer *w, const struct equation *equation)
{
    struct text *text = w->text;
    const fbd_equation *e = &equation->public;
    const char *mode = equation->cut_free ? "" : term_mode(w->state, equation->body);
    text_add(text, w->written ? ",\n    {" : "\n    {");
    text_json_words(text, "body", e->body, ", ");
    text_json_words(text, "coordinate", e->coordinate, ",\n     ");
    if (has_symbols(w, equation)) symbols(text, "symbols", formula_line(&w->formulas, equation), ",\n     ");
    quantity(text, "inertia", e->inertia_name, e->inertia, e->inertia_unit);
    text_add(text, ",\n     ");
    quantity(text, "acceleration", e->acceleration_name, e->acceleration, e->acceleration_unit);
    text_add(text, ",\n     ");
    quantity(text, "sum", "sum", e->sum, e->unit);
    text_add(text, ",\n     ");
    text_json_member(text, "residual", e->inertia * e->acceleration - e->sum, ", ");
    if (mode[0]) text_json_words(text, "mode", mode, ", ");
    text_add(text, "\"terms\": [");
    for (size_t i = 0; i < e->term_count; i++) write_term(w, equation, i);
    text_add(text, "]}");
}

static void end_equations(struct writer *w)
{
    text_add(w->text, "\n  ],\n");
}

const struct equations_pass json_equations = {.begin = write_head,
                                              .includes = is_included,
                                              .equation = write_equation,
                                              .end = end_equations};

/* ---- kinematics: absent where no body has such lines */

static void write_kinematics(struct writer *w, int b, const char *const *lines, int count)
{
    text_add(w->text, w->written ? ",\n    " : "  \"kinematics\": {\n    ");
    text_json_key(w->text, w->state->model->bodies[b].name);
    for (int i = 0; i < count; i++) {
        text_add(w->text, i == 0 ? "[" : ", ");
        text_json_string(w->text, lines[i]);
    }
    text_add(w->text, "]");
}

static void end_kinematics(struct writer *w)
{
    if (w->written) text_add(w->text, "\n  },\n");
}

const struct equations_pass json_kinematics = {.symbolic = true,
                                               .kinematics = write_kinematics,
                                               .end = end_kinematics};

/* ---- free-body diagrams */

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

static void begin_forces(struct writer *w)
{
    text_add(w->text, "  \"forces\": {");
    state_ready(w->state);
}

static void write_forces(struct writer *w, int b)
{
    struct text *text = w->text;
    const struct fbd_model *model = w->state->model;
    const struct model_body *body = &model->bodies[b];
    const struct instant at = state_instant(w->state);
    const struct vec about = moment_center(body, &at);
    struct arrow *arrows = ARENA_ARRAY(&w->all->arena, diagram_arrows(model, b), struct arrow);
    text->failed |= !arrows;
    const size_t count = arrows ? diagram_fill(model, b, &at, w->state->slots, arrows) : 0;
    text_add(text, b ? ",\n    " : "\n    ");
    text_json_key(text, body->name);
    text_add(text, "{");
    for (size_t i = 0; i < count; i++) {
        const fbd_arrow arrow = public_arrow(&arrows[i], about);
        text_add(text, i ? ",\n      " : "\n      ");
        write_arrow(text, &arrow);
    }
    text_add(text, "}");
}

static void end_forces(struct writer *w)
{
    text_add(w->text, "\n  }\n}\n");
}

const struct equations_pass json_forces = {.begin = begin_forces, .body = write_forces, .end = end_forces};
