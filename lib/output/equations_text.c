/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The assembled equations as text.
 */
#include <stdlib.h>

#include "dynamics/friction.h"
#include "fbd_export.h"
#include "output/equations.h"
#include "output/formulas.h"
#include "output/kinematic_lines.h"
#include "output/laws.h"
#include "output/terms.h"

enum { value_column = 22, unit_column = 40, remark_column = 48 };

static const char *side_of_equation(const struct model_body *body, const struct equation *equation)
{
    static const char *const sides[] = {"sum of forces along x", "sum of forces along y",
                                        "sum of moments about G"};
    if (equation->cut_free || body->count > 1) return sides[equation->part];
    return body->kind == motion_pivot   ? "sum of moments about O"
           : body->kind == motion_track ? "sum of forces along the track"
                                        : "sum of forces along x";
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

static void write_equation(struct text *text, struct fbd_state *state, const struct equation *equation)
{
    const struct model_body *body = &state->model->bodies[equation->body];
    const fbd_equation *e = &equation->public;
    const char *G = !equation->cut_free && body->kind == motion_planar && equation->part < 2 ? " of G" : "";
    text_printf(text, "  %s.%s: %s %s%s = %s\n", e->body, e->coordinate, e->inertia_name,
                e->acceleration_name, G, side_of_equation(body, equation));
    write_terms(text, state, equation);
    write_row(text, "sum", e->sum, e->unit, "");
    write_row(text, e->inertia_name, e->inertia, e->inertia_unit, "");
    char name[64];
    snprintf(name, sizeof name, "%s%s", e->acceleration_name, G);
    write_row(text, name, e->acceleration, e->acceleration_unit,
              equation->cut_free ? "" : term_mode(state, equation->body));
    if (equation->cut_free) write_row(text, "residual", e->inertia * e->acceleration - e->sum, e->unit, "");
}

static void write_body(struct text *text, const struct fbd_state *state, int b)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    const struct label *label = &model->labels[body->first + body->count - 1];
    if (body->kind != motion_pivot) return;
    text_printf(text, "  %s turns about O: I_O = ", body->name);
    text_number(text, body->I_O, 9);
    text_printf(text, " %s, m = ", label->inertia_unit);
    text_number(text, body->inertia.mass, 9);
    text_printf(text, " %s, L = |OG| = ", model->scene->units == unit_si ? "kg" : "slug");
    text_number(text, body->L, 9);
    text_printf(text, " %s\n", model->scene->units == unit_si ? "m" : "ft");
}

/* Write the rates of the user states. */
static void write_states(struct text *text, const struct fbd_state *state)
{
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

static void write_line(struct text *text, const char *line)
{
    text->failed |= !line;
    if (line) text_printf(text, "    %s\n", line);
}

/* Write the equations of body b, and the acceleration of its G. */
static void write_lines(struct text *text, struct formulas *formulas, const fbd_equations *all, int b,
                        bool components)
{
    const struct fbd_model *model = formulas->state->model;
    const char *lines[most_kinematic_lines];
    text_printf(text, "  %s\n", model->bodies[b].name);
    for (size_t i = 0; i < all->count; i++)
        if (all->equations[i].body == b && equation_in_symbols(model, &all->equations[i], components))
            write_line(text, formula_line(formulas, &all->equations[i]));
    const int count = kinematic_lines(formulas, b, lines);
    for (int i = 0; i < count; i++) write_line(text, lines[i]);
}

/* Write Newton's and Euler's equations with all reactions, for joined bodies or for all, a line each. */
static void write_cut_free(struct text *text, struct fbd_state *state, bool components)
{
    const struct fbd_model *model = state->model;
    struct formulas formulas;
    fbd_equations *all = assemble(state, true);
    if (!formulas_begin(&formulas, state) || !all) text->failed = true;
    if (!text->failed) text_add(text, "Cut free, in symbols at this time\n");
    for (size_t b = 0; !text->failed && b < model->body_count; b++)
        if (body_is_cut_free(model, (int)b, components))
            write_lines(text, &formulas, all, (int)b, components);
    text->failed |= formulas.arena.failed;
    formulas_end(&formulas);
    fbd_equations_free(all);
}

void equations_write(struct text *text, struct fbd_state *state, bool components)
{
    fbd_equations *all = assemble(state, components);
    if (!all) {
        text->failed = true;
        return;
    }
    text_add(text, "Equations at t = ");
    text_number(text, state->t, 9);
    text_add(text, " s\n");
    int last = -1;
    for (size_t i = 0; i < all->count; i++) {
        if (all->equations[i].body != last) write_body(text, state, all->equations[i].body);
        last = all->equations[i].body;
        write_equation(text, state, &all->equations[i]);
    }
    write_states(text, state);
    fbd_equations_free(all);
    if (equations_cut_free(state->model, components)) write_cut_free(text, state, components);
}

static char *text_of(struct fbd_state *state, bool components)
{
    if (!state) return NULL;
    struct text text = {0};
    equations_write(&text, state, components);
    if (text.failed) text_free(&text);
    return text.data;
}

char *fbd_equations_text(fbd_state *state)
{
    return text_of(state, false);
}

char *fbd_equations_text_components(fbd_state *state)
{
    return text_of(state, true);
}

char *fbd_equations_symbols(fbd_state *state)
{
    if (!state) return NULL;
    struct text text = {0};
    write_cut_free(&text, state, true);
    if (text.failed) text_free(&text);
    return text.data;
}
