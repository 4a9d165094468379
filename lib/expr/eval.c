/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "expr/frame.h"
#include "expr/parts.h"
#include "expr/steps.h"

/* Run a program with jumps. The operations of most force laws are inlined; the others go through op_value,
 * whose call is cheap compared with the library function in it. */
static double run_on_frame(const struct expr *expr, double t, const double *y, const int *branch)
{
    double value[frame_limit];
    frame_values(expr, t, y, value);
    const struct instr *end = expr->code + expr->operations;
    for (const struct instr *i = expr->code; i < end; i++) {
        double a = value[i->a], b = value[i->b];
        switch (i->op) {
        case op_copy: value[i->to] = a; break;
        case op_negate: value[i->to] = -a; break;
        case op_add: value[i->to] = a + b; break;
        case op_subtract: value[i->to] = a - b; break;
        case op_multiply: value[i->to] = a * b; break;
        case op_divide: value[i->to] = a / b; break;
        case op_sqrt: value[i->to] = sqrt(a); break;
        case op_sin: value[i->to] = sin(a); break;
        case op_cos: value[i->to] = cos(a); break;
        case op_whole_power: value[i->to] = whole_power(a, i->extra); break;
        case op_jump: i += i->extra; break;
        case op_jump_unless: i += a == 0 ? i->extra : 0; break;
        default:
            if (branch && op_is_switch(i->op))
                value[i->to] = switch_value(i, switch_branch(i, a, b, branch), a, b);
            else
                value[i->to] = op_value(i, a, b);
        }
    }
    return value[expr->result];
}

double expr_eval(const struct expr *expr, double t, const double *y, const int *branch)
{
    if (expr->parts) return parts_run(expr, t, y);
    return expr->steps ? steps_run(expr, t, y, branch) : run_on_frame(expr, t, y, branch);
}
