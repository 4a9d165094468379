/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivatives of the operations: f(x, y), its first partial derivatives a = df/dx and b = df/dy, and the
 * second ones aa, ab, bb.
 */
#include <math.h>

#include "expr/program.h"

/* f = x^n for whole n: no logarithm, no power of a negative base, and the factors n and n (n - 1) remove the
 * poles that x^(n-1) and x^(n-2) have at 0 when the derivative has none. */
static void slopes_of_whole_power(double x, int n, struct slopes *s)
{
    s->f = whole_power(x, n);
    s->a = n == 0 ? 0 : n * whole_power(x, n - 1);
    s->aa = n == 0 || n == 1 ? 0 : (double)n * (n - 1) * whole_power(x, n - 2);
}

/* f = x^y, df/dx = y x^(y-1), df/dy = x^y ln x. At x = 0 and y > 0 the last one has the limit 0. */
static void slopes_of_power(double x, double y, struct slopes *s)
{
    s->f = pow(x, y);
    s->a = y == 0 ? 0 : y * pow(x, y - 1);
    s->aa = y == 0 || y == 1 ? 0 : y * (y - 1) * pow(x, y - 2);
    if (x == 0 && y > 0) {
        s->ab = y > 1 ? 0 : -(double)INFINITY;
        return;
    }
    double l = log(x);
    s->b = s->f * l;
    s->bb = s->b * l;
    s->ab = pow(x, y - 1) * (1 + y * l);
}

/* f = hypot(x, y). At the origin, a cone, the slopes are set to 0. */
static void slopes_of_hypot(double x, double y, struct slopes *s)
{
    double h = hypot(x, y);
    s->f = h;
    if (h == 0) return;
    double c = x / h, n = y / h;
    s->a = c;
    s->b = n;
    s->aa = n * n / h;
    s->ab = -c * n / h;
    s->bb = c * c / h;
}

/* f = atan2(x, y), the angle whose tangent is x/y; h scales so that squares neither overflow nor vanish. */
static void slopes_of_atan2(double x, double y, struct slopes *s)
{
    double h = hypot(x, y), n = x / h, c = y / h;
    s->f = atan2(x, y);
    s->a = c / h;
    s->b = -n / h;
    s->aa = -2 * c * n / h / h;
    s->ab = (n - c) * (n + c) / h / h;
    s->bb = 2 * c * n / h / h;
}

static void slopes_of_quotient(double x, double y, struct slopes *s)
{
    s->f = x / y;
    s->a = 1 / y;
    s->b = -s->f / y;
    s->ab = -s->a / y;
    s->bb = -2 * s->b / y;
}

static void set_slopes(struct slopes *s, double f, double a, double aa)
{
    s->f = f;
    s->a = a;
    s->aa = aa;
}

/* Elementary functions of one variable whose derivatives follow from the value or from one more function. */
static void slopes_of_function(unsigned op, double x, struct slopes *s)
{
    double f, g;
    switch (op) {
    case op_sqrt:
        f = sqrt(x);
        set_slopes(s, f, 0.5 / f, -0.25 / (x * f));
        break;
    case op_cbrt:
        f = cbrt(x);
        set_slopes(s, f, 1 / (3 * f * f), -2 / (9 * x * f * f));
        break;
    case op_exp:
        f = exp(x);
        set_slopes(s, f, f, f);
        break;
    case op_ln: set_slopes(s, log(x), 1 / x, -1 / (x * x)); break;
    case op_log10:
        g = 0.43429448190325182765; /* 1/ln 10 */
        set_slopes(s, log10(x), g / x, -g / (x * x));
        break;
    case op_sinh: set_slopes(s, sinh(x), cosh(x), sinh(x)); break;
    case op_cosh: set_slopes(s, cosh(x), sinh(x), cosh(x)); break;
    default: /* tanh */
        f = tanh(x);
        g = cosh(x);
        set_slopes(s, f, 1 / g / g, -2 * f / g / g);
        break;
    }
}

static void slopes_of_trigonometry(unsigned op, double x, struct slopes *s)
{
    double f, g;
    switch (op) {
    case op_sin:
        f = sin(x);
        set_slopes(s, f, cos(x), -f);
        break;
    case op_cos:
        f = cos(x);
        set_slopes(s, f, -sin(x), -f);
        break;
    case op_tan:
        f = tan(x);
        g = 1 + f * f;
        set_slopes(s, f, g, 2 * f * g);
        break;
    case op_asin:
        g = 1 / sqrt((1 - x) * (1 + x));
        set_slopes(s, asin(x), g, x * g * g * g);
        break;
    case op_acos:
        g = -1 / sqrt((1 - x) * (1 + x));
        set_slopes(s, acos(x), g, x * g * g * g);
        break;
    default: /* atan */
        g = 1 / (1 + x * x);
        set_slopes(s, atan(x), g, -2 * x * g * g);
        break;
    }
}

static void slopes_of_switch(const struct instr *instr, double x, double y, const int *branch,
                             struct slopes *s)
{
    double n = switch_branch(instr, x, y, branch);
    s->f = branch ? switch_value(instr, n, x, y) : op_value(instr, x, y);
    switch (instr->op) {
    case op_abs: s->a = !branch && x == 0 ? 0 : n < 0 ? -1 : 1; break;
    case op_min: s->a = n < 0; break;
    case op_max: s->a = n >= 0; break;
    case op_sawtooth:
    case op_levels: s->a = 1; break;
    case op_mod:
        s->a = 1;
        s->b = -n;
        break;
    case op_table: table_slopes(instr->table, n, x, &s->f, &s->a, &s->aa); break;
    default: break;
    }
    if (instr->op == op_min || instr->op == op_max) s->b = 1 - s->a;
}

void op_slopes(const struct instr *instr, double x, double y, const int *branch, struct slopes *slopes)
{
    struct slopes s = {0};
    switch (instr->op) {
    case op_copy: set_slopes(&s, x, 1, 0); break;
    case op_negate: set_slopes(&s, -x, -1, 0); break;
    case op_add: s = (struct slopes){.f = x + y, .a = 1, .b = 1}; break;
    case op_subtract: s = (struct slopes){.f = x - y, .a = 1, .b = -1}; break;
    case op_multiply: s = (struct slopes){.f = x * y, .a = y, .b = x, .ab = 1}; break;
    case op_divide: slopes_of_quotient(x, y, &s); break;
    case op_whole_power: slopes_of_whole_power(x, instr->extra, &s); break;
    case op_power: slopes_of_power(x, y, &s); break;
    case op_hypot: slopes_of_hypot(x, y, &s); break;
    case op_atan2: slopes_of_atan2(x, y, &s); break;
    case op_and:
    case op_or:
    case op_not: s.f = op_value(instr, x, y); break;
    case op_sin:
    case op_cos:
    case op_tan:
    case op_asin:
    case op_acos:
    case op_atan: slopes_of_trigonometry(instr->op, x, &s); break;
    default:
        if (op_is_switch(instr->op))
            slopes_of_switch(instr, x, y, branch, &s);
        else
            slopes_of_function(instr->op, x, &s);
    }
    *slopes = s;
}
