/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bound of the rounding error of a formula with exact variables, by the first-order propagation of kinks.c,
 *
 *   e(f) = |f_a| e(a) + |f_b| e(b) + own |f|,
 *
 * with half a unit in the last place for each operation that is rounded correctly, and one unit for functions
 * of the mathematical library.
 */
#include <float.h>
#include <math.h>

#include "expr/frame.h"

static double own_rounding(const struct instr *i, const int *branch, double a, double f)
{
    const double unit = DBL_EPSILON / 2;
    if (i->op == op_table) return table_rounding(i->table, switch_branch(i, a, 0, branch), a);
    if (i->op == op_copy || i->op == op_negate || (i->op >= op_and && i->op <= op_not) || op_is_switch(i->op))
        return 0;
    bool correct = (i->op >= op_add && i->op <= op_divide) || i->op == op_sqrt;
    return (correct ? 1 : 2) * unit * fabs(f);
}

double expr_rounding(const struct expr *expr, double t, const double *y, const int *branch)
{
    double value[frame_limit], error[frame_limit];
    size_t leaves = (expr->uses_time ? 1 : 0) + expr->variables + expr->constants;
    frame_values(expr, t, y, value);
    memset(error, 0, leaves * sizeof *error);
    const struct instr *end = expr->code + expr->operations;
    for (const struct instr *i = expr->code; i < end; i++) {
        if (i->op == op_jump || i->op == op_jump_unless) {
            i += i->op == op_jump || value[i->a] == 0 ? i->extra : 0;
            continue;
        }
        struct slopes s;
        op_slopes(i, value[i->a], value[i->b], branch, &s);
        double passed = along(fabs(s.a), error[i->a]) + along(fabs(s.b), error[i->b]),
               own = own_rounding(i, branch, value[i->a], s.f);
        value[i->to] = s.f;
        error[i->to] = (isfinite(passed) ? passed : 0) + (isfinite(own) ? own : 0);
    }
    return error[expr->result];
}
