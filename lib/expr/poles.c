/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Poles: where a formula may become infinite, and the distance to that. Each division, and each power with a
 * negative exponent, has a divisor that must not be zero.
 */
#include <math.h>

#include "expr/frame.h"

static bool is_constant(const struct expr *expr, size_t reg)
{
    size_t first = (expr->uses_time ? 1 : 0) + expr->variables;
    return reg >= first && reg < first + expr->constants;
}

/* The register of the divisor of this instruction; false if it has no varying one. */
static bool divides_by(const struct expr *expr, const struct instr *i, size_t *divisor)
{
    bool pole = i->op == op_divide || (i->op == op_whole_power && i->extra < 0);
    if (i->op == op_power && is_constant(expr, i->b)) {
        size_t first = (expr->uses_time ? 1 : 0) + expr->variables;
        pole = expr->constant[i->b - first] < 0;
    }
    *divisor = i->op == op_divide ? i->b : i->a;
    return pole && !is_constant(expr, *divisor);
}

size_t expr_poles(const struct expr *expr)
{
    size_t count = 0, divisor;
    for (size_t k = 0; k < expr->operations; k++) count += divides_by(expr, &expr->code[k], &divisor);
    return count;
}

void expr_divisors(const struct expr *expr, double t, const double *y, double dt, const double *dy,
                   const int *branch, double *divisors, double *rates)
{
    double value[frame_limit], rate[frame_limit];
    const struct instr *end = expr->code + expr->operations;
    size_t pole = 0, divisor;
    frame_values(expr, t, y, value);
    frame_rates(expr, dt, dy, rate);
    /* The side of an `if` that is not chosen is skipped, with its poles. */
    const struct instr *next = expr->code;
    for (const struct instr *i = expr->code; i < end; i++) {
        bool active = i >= next, has_pole = divides_by(expr, i, &divisor);
        if (has_pole) {
            divisors[pole] = active ? value[divisor] : HUGE_VAL;
            rates[pole++] = active ? rate[divisor] : 0;
        }
        if (!active) continue;
        if (i->op == op_jump || (i->op == op_jump_unless && value[i->a] == 0)) next = i + 1 + i->extra;
        if (i->op == op_jump || i->op == op_jump_unless) continue;
        struct slopes s;
        op_slopes(i, value[i->a], value[i->b], branch, &s);
        double by_a = along(s.a, rate[i->a]), by_b = along(s.b, rate[i->b]);
        value[i->to] = s.f;
        rate[i->to] = by_a + by_b;
    }
}
