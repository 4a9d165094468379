/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The assembled equations as LaTeX (amsmath): each in symbols, followed by the numbers of the state.
 */
#include <math.h>
#include <string.h>

#include "output/equations_write.h"

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

static void write_head(struct writer *w)
{
    text_add(w->text, "% Equations at t = ");
    text_number(w->text, w->state->t, 9);
    text_add(w->text, " s; needs amsmath\n");
}

static bool in_symbols(const struct writer *w, const struct equation *equation)
{
    return equation_in_symbols(w->state->model, equation, w->components);
}

static void write_equation(struct writer *w, const struct equation *equation)
{
    struct text *text = w->text;
    const fbd_equation *e = &equation->public;
    const char *left = formula_left(&w->formulas, equation), *right = formula_right(&w->formulas, equation);
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

static void write_idle(struct writer *w, const struct idle_line *line)
{
    text_add(w->text, "\\begin{align*}\n");
    symbol_write_latex(w->text, line->symbols);
    text_printf(w->text, " \\quad \\text{%s}\n\\end{align*}\n", line->when);
}

static void write_kinematics(struct writer *w, int b, const char *const *lines, int count)
{
    struct text *text = w->text;
    text_printf(text, "%% %s: acceleration of G\n\\begin{align*}\n", w->state->model->bodies[b].name);
    for (int i = 0; i < count; i++) {
        const char *equals = strchr(lines[i], '=');
        char *left = arena_text(&w->formulas.arena, lines[i], (size_t)(equals - lines[i]) - 1);
        if (left) symbol_write_latex(text, left);
        text_add(text, " &= ");
        symbol_write_latex(text, equals + 2);
        text_add(text, i + 1 < count ? " \\\\\n" : "\n\\end{align*}\n");
    }
}

const struct equations_pass latex_equations = {.symbolic = true,
                                               .begin = write_head,
                                               .includes = in_symbols,
                                               .equation = write_equation,
                                               .idle = write_idle,
                                               .kinematics = write_kinematics};
