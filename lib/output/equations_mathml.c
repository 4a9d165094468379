/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The assembled equations as HTML with MathML: each in symbols, followed by the numbers of the state. Paragraphs of
 * class `equation`, the second line of class `numbers`, under the name of the equation.
 */
#include <math.h>
#include <string.h>

#include "output/equations_write.h"
#include "output/mathml.h"

enum { digits = 6 };

/* N·m, kg·m², rad/s². */
static void write_unit(struct text *text, const char *unit)
{
    text_add(text, "\u00a0");
    for (const char *c = unit; *c; c++) {
        if (*c == '*')
            text_add(text, "·");
        else if (*c == '^' && (c[1] == '2' || c[1] == '3'))
            text_add(text, *++c == '2' ? "²" : "³");
        else
            text_add_bytes(text, c, 1);
    }
}

/* With a minus sign, and powers of ten as such. */
static void write_value(struct text *text, double value)
{
    struct text plain = {0};
    text_number(&plain, fabs(value), digits);
    const char *number = plain.data ? plain.data : "", *power = strchr(number, 'e');
    if (value < 0) text_add(text, "−");
    text_add_bytes(text, number, power ? (size_t)(power - number) : strlen(number));
    if (power) {
        const char *exponent = power[1] == '+' ? power + 2 : power + 1;
        text_printf(text, "·10<sup>%s%s</sup>", *exponent == '-' ? "−" : "", exponent + (*exponent == '-'));
    }
    text->failed |= plain.failed;
    text_free(&plain);
}

/* Numbers at the round-off level of the largest term are zero. */
static double round_off_of(const fbd_equation *e)
{
    const double level = 1e-14;
    double largest = fabs(e->inertia * e->acceleration);
    for (size_t i = 0; i < e->term_count; i++) largest = fmax(largest, fabs(e->terms[i].value));
    return level * largest;
}

static void write_sum(struct text *text, const fbd_equation *e)
{
    const char *before = "";
    for (size_t i = 0; i < e->term_count; i++) {
        const double value = e->terms[i].value;
        if (fabs(value) <= round_off_of(e)) continue;
        if (before[0]) text_add(text, value > 0 ? " + " : " − ");
        write_value(text, before[0] ? fabs(value) : value);
        before = "+";
    }
    if (!before[0]) text_add(text, "0");
    write_unit(text, e->unit);
}

static void write_numbers(struct text *text, const fbd_equation *e)
{
    text_add(text, "<p class=\"equation numbers\">");
    write_value(text, e->inertia);
    write_unit(text, e->inertia_unit);
    text_add(text, " · (");
    write_value(text, fabs(e->inertia * e->acceleration) <= round_off_of(e) ? 0 : e->acceleration);
    write_unit(text, e->acceleration_unit);
    text_add(text, ") = ");
    write_sum(text, e);
    text_add(text, "</p>\n");
}

static bool in_symbols(const struct writer *w, const struct equation *equation)
{
    return equation_in_symbols(w->state->model, equation, w->components);
}

static void write_formula(struct text *text, const char *left, const char *right)
{
    text_add(text, "<p class=\"equation\">");
    mathml_write(text, "", left);
    text_add(text, " ");
    mathml_write(text, "=", right);
    text_add(text, "</p>\n");
}

static void write_equation(struct writer *w, const struct equation *equation)
{
    const fbd_equation *e = &equation->public;
    const char *left = formula_left(&w->formulas, equation), *right = formula_right(&w->formulas, equation);
    if (!left || !right) {
        w->text->failed = true;
        return;
    }
    text_printf(w->text, "<p class=\"equation-name\">%s.%s</p>\n", e->body, e->coordinate);
    write_formula(w->text, left, right);
    write_numbers(w->text, e);
}

static void write_idle(struct writer *w, const struct idle_line *line)
{
    text_add(w->text, "<p class=\"equation\">");
    mathml_write(w->text, "", line->symbols);
    text_printf(w->text, " %s</p>\n", line->when);
}

static void write_kinematics(struct writer *w, int b, const char *const *lines, int count)
{
    text_printf(w->text, "<p class=\"equation-name\">%s: acceleration of G</p>\n",
                w->state->model->bodies[b].name);
    for (int i = 0; i < count; i++) {
        const char *equals = strchr(lines[i], '=');
        const char *left = arena_text(&w->formulas.arena, lines[i], (size_t)(equals - lines[i]) - 1);
        if (left) write_formula(w->text, left, equals + 2);
    }
}

const struct equations_pass mathml_equations = {.symbolic = true,
                                                .includes = in_symbols,
                                                .equation = write_equation,
                                                .idle = write_idle,
                                                .kinematics = write_kinematics};
