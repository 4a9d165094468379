/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The assembled equations as LaTeX (amsmath): each in symbols, followed by the numbers of the state.
 */
#include <math.h>
#include <string.h>

#include "base/api_check.h"
#include "fbd_export.h"
#include "output/kinematic_lines.h"

/* N*m, kg*m^2, m/s^2 upright. */
static void write_unit(struct text *text, const char *unit)
{
    text_add(text, "\\,\\mathrm{");
    for (const char *c = unit; *c; c++) {
        if (*c == '*')
            text_add(text, "\\,");
        else
            text_add_bytes(text, c, 1);
    }
    text_add(text, "}");
}

/* A number with six digits; powers of ten as such. */
static void write_value(struct text *text, double value)
{
    struct text plain = {0};
    text_number(&plain, value, 6);
    const char *digits = plain.data ? plain.data : "", *power = strchr(digits, 'e');
    text_add_bytes(text, digits, power ? (size_t)(power - digits) : strlen(digits));
    if (power) text_printf(text, "\\cdot 10^{%s}", power[1] == '+' ? power + 2 : power + 1);
    text->failed |= plain.failed;
    text_free(&plain);
}

static void write_numbers(struct text *text, const fbd_equation *e)
{
    write_value(text, e->inertia);
    write_unit(text, e->inertia_unit);
    text_add(text, " \\cdot \\left(");
    write_value(text, e->acceleration);
    write_unit(text, e->acceleration_unit);
    text_add(text, "\\right) &= ");
    const char *before = "";
    for (size_t i = 0; i < e->term_count; i++) {
        double value = e->terms[i].value;
        if (value == 0) continue;
        if (before[0]) text_add(text, value > 0 ? " + " : " - ");
        write_value(text, before[0] ? fabs(value) : value);
        before = "+";
    }
    if (!before[0]) text_add(text, "0");
    write_unit(text, e->unit);
}

static void write_equation(struct text *text, struct formulas *formulas, const struct equation *equation)
{
    const fbd_equation *e = &equation->public;
    const char *left = formula_left(formulas, equation), *right = formula_right(formulas, equation);
    if (!left || !right) {
        text->failed = true;
        return;
    }
    text_printf(text, "%% %s.%s\n\\begin{align*}\n", e->body, e->coordinate);
    symbol_write_latex(text, left);
    text_add(text, " &= ");
    symbol_write_latex(text, right);
    text_add(text, " \\\\\n");
    write_numbers(text, e);
    text_add(text, "\n\\end{align*}\n");
}

/* For a body cut free, the acceleration of its G. */
static void write_kinematics(struct text *text, struct formulas *formulas, int b)
{
    const char *lines[most_kinematic_lines];
    const int count = kinematic_lines(formulas, b, lines);
    for (int i = 0; i < count; i++) {
        text->failed |= !lines[i];
        if (!lines[i]) return;
        if (i == 0)
            text_printf(text, "%% %s: acceleration of G\n\\begin{align*}\n",
                        formulas->state->model->bodies[b].name);
        const char *equals = strchr(lines[i], '=');
        char *left = arena_text(&formulas->arena, lines[i], (size_t)(equals - lines[i]) - 1);
        if (left) symbol_write_latex(text, left);
        text_add(text, " &= ");
        symbol_write_latex(text, equals + 2);
        text_add(text, i + 1 < count ? " \\\\\n" : "\n\\end{align*}\n");
    }
}

static char *latex_of(fbd_state *state, bool components)
{
    if (!state) return NULL;
    struct text text = {0};
    struct formulas formulas;
    fbd_equations *all = assemble(state, true);
    bool begun = formulas_begin(&formulas, state);
    if (all && begun) {
        text_add(&text, "% Equations at t = ");
        text_number(&text, state->t, 9);
        text_add(&text, " s; needs amsmath\n");
        for (size_t i = 0; i < all->count; i++) {
            const int b = all->equations[i].body;
            if (equation_in_symbols(state->model, &all->equations[i], components))
                write_equation(&text, &formulas, &all->equations[i]);
            const bool last = i + 1 == all->count || all->equations[i + 1].body != b;
            if (last && body_is_cut_free(state->model, b, components)) write_kinematics(&text, &formulas, b);
        }
    } else {
        text.failed = true;
    }
    text.failed |= formulas.arena.failed;
    formulas_end(&formulas);
    fbd_equations_free(all);
    if (text.failed) text_free(&text);
    return text.data;
}

char *fbd_equations_latex(fbd_state *state)
{
    return latex_of(state, false);
}

char *fbd_equations_latex_components(fbd_state *state)
{
    return latex_of(state, true);
}
