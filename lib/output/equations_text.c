/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The assembled equations as text: in numbers, and in symbols.
 */
#include "dynamics/friction.h"
#include "output/equations_write.h"
#include "output/laws.h"
#include "output/terms.h"

enum { value_column = 22, unit_column = 40, remark_column = 48 };

static const char *side_of_equation(const struct model_body *body, const struct equation *equation)
{
    return (equation->cut_free ? free_coordinates : body->joint->coordinates)[equation->part].sum;
}

static void write_row(struct text *text, const char *name, double value, const char *unit, const char *remark)
{
    text_printf(text, "    %s ", name);
    text_pad(text, value_column);
    if (value >= 0 || value != value) text_add(text, " "); /* room for a sign */
    text_number(text, value, 9);
    text_pad(text, unit_column);
    text_add(text, unit);
    if (remark[0]) {
        text_pad(text, remark_column);
        text_add(text, remark);
    }
    text_add(text, "\n");
}

/* Write the terms of the body's own loads always, those due to other bodies only if they have a value or
 * remark. */
static void write_terms(struct text *text, struct fbd_state *state, const struct equation *equation)
{
    const fbd_equation *e = &equation->public;
    for (size_t i = 0; i < e->term_count; i++) {
        char remark[term_remark_size];
        if (!equation_remark(state, equation, i, remark)) text->failed = true;
        if (e->terms[i].value == 0 && !remark[0] &&
            !body_lists(state->model, equation->body, equation->loads[i]))
            continue;
        write_row(text, e->terms[i].name, e->terms[i].value, e->unit, remark);
    }
}

/* Those of the coordinates; cut free only bodies without coordinates, or with components. */
static bool in_numbers(const struct writer *w, const struct equation *equation)
{
    return !equation->cut_free || w->components || w->state->model->bodies[equation->body].count == 0;
}

static void write_equation(struct writer *w, const struct equation *equation)
{
    struct text *text = w->text;
    const struct model_body *body = &w->state->model->bodies[equation->body];
    const fbd_equation *e = &equation->public;
    const bool turns_too = body->joint->angle > equation->part;
    const char *G = !equation->cut_free && turns_too ? " of G" : "";
    text_printf(text, "  %s.%s: %s %s%s = %s\n", e->body, e->coordinate, e->inertia_name,
                e->acceleration_name, G, side_of_equation(body, equation));
    write_terms(text, w->state, equation);
    write_row(text, "sum", e->sum, e->unit, "");
    write_row(text, e->inertia_name, e->inertia, e->inertia_unit, "");
    char name[64];
    snprintf(name, sizeof name, "%s%s", e->acceleration_name, G);
    write_row(text, name, e->acceleration, e->acceleration_unit,
              equation->cut_free ? "" : term_mode(w->state, equation->body));
    if (equation->cut_free) write_row(text, "residual", e->inertia * e->acceleration - e->sum, e->unit, "");
}

static void write_body(struct writer *w, int b)
{
    struct text *text = w->text;
    const struct fbd_model *model = w->state->model;
    const struct model_body *body = &model->bodies[b];
    if (!body->joint->has_axis) return;
    const struct label *label = &model->labels[body->first];
    text_printf(text, "  %s turns about O: I_O = ", body->name);
    text_number(text, body->I_O, 9);
    text_printf(text, " %s, m = ", label->inertia_unit);
    text_number(text, body->inertia.mass, 9);
    text_printf(text, " %s, L = |OG| = ", model->scene->units == unit_si ? "kg" : "slug");
    text_number(text, body->L, 9);
    text_printf(text, " %s\n", model->scene->units == unit_si ? "m" : "ft");
}

/* Write the rates of the user states. */
static void write_states(struct writer *w)
{
    struct text *text = w->text;
    const struct fbd_state *state = w->state;
    const struct fbd_model *model = state->model;
    const int n = model->plan.n;
    if (model->plan.own > 0) text_add(text, "  states, by equations of their own\n");
    for (int i = 0; i < model->plan.own; i++) {
        const struct own_label *label = &model->own_labels[i];
        text_printf(text, "  %s = ", label->name);
        text_number(text, state->y[2 * n + i], 9);
        text_printf(text, "%s%s\n", unit_word(label->unit)[0] ? " " : "", unit_word(label->unit));
        write_row(text, "rate", state->a[n + i], unit_word(label->rate_unit), "");
    }
}

static void write_time(struct writer *w)
{
    text_add(w->text, "Equations at t = ");
    text_number(w->text, w->state->t, 9);
    text_add(w->text, " s\n");
}

const struct equations_pass text_numbers = {.begin = write_time,
                                            .body = write_body,
                                            .includes = in_numbers,
                                            .equation = write_equation,
                                            .end = write_states};

/* ---- in symbols: Newton's and Euler's equations with all reactions, for joined bodies or for all */

static void write_title(struct writer *w)
{
    text_add(w->text, "Cut free, in symbols at this time\n");
}

static void write_name(struct writer *w, int b)
{
    if (body_is_cut_free(w->state->model, b, w->components))
        text_printf(w->text, "  %s\n", w->state->model->bodies[b].name);
}

static bool in_symbols(const struct writer *w, const struct equation *equation)
{
    return body_is_cut_free(w->state->model, equation->body, w->components) &&
           equation_in_symbols(w->state->model, equation, w->components);
}

static void write_line(struct writer *w, const struct equation *equation)
{
    const char *line = formula_line(&w->formulas, equation);
    w->text->failed |= !line;
    if (line) text_printf(w->text, "    %s\n", line);
}

static void write_idle(struct writer *w, const struct idle_line *line)
{
    text_printf(w->text, "    %s %s\n", line->symbols, line->when);
}

static void write_kinematics(struct writer *w, int b, const char *const *lines, int count)
{
    (void)b;
    for (int i = 0; i < count; i++) text_printf(w->text, "    %s\n", lines[i]);
}

const struct equations_pass text_symbols = {.symbolic = true,
                                            .begin = write_title,
                                            .body = write_name,
                                            .includes = in_symbols,
                                            .equation = write_line,
                                            .idle = write_idle,
                                            .kinematics = write_kinematics};
