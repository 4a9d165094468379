/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/program.h"

static enum expr_degree larger(enum expr_degree a, enum expr_degree b)
{
    return a > b ? a : b;
}

/* A function of constants is constant, whatever the function. */
static enum expr_degree of_any(enum expr_degree a, enum expr_degree b)
{
    return larger(a, b) == expr_constant_between ? expr_constant_between : expr_nonlinear;
}

/* The degree of a result from those of the operands; b is a where there is one operand. */
static enum expr_degree degree_after(const struct instr *instr, enum expr_degree a, enum expr_degree b)
{
    switch (instr->op) {
    case op_copy:
    case op_negate:
    case op_abs:
    case op_sawtooth: return a;
    case op_add:
    case op_subtract:
    case op_min:
    case op_max: return larger(a, b);
    case op_mod: return b == expr_constant_between ? a : of_any(a, b);
    case op_multiply:
        if (a == expr_constant_between) return b;
        return b == expr_constant_between ? a : expr_nonlinear;
    case op_divide: return b == expr_constant_between ? a : expr_nonlinear;
    case op_whole_power:
        return instr->extra == 0 ? expr_constant_between : instr->extra == 1 ? a : of_any(a, a);
    default: return op_is_switch(instr->op) ? expr_constant_between : of_any(a, b);
    }
}

enum expr_degree expr_degree(const struct expr *expr)
{
    enum expr_degree degree[frame_limit] = {expr_constant_between};
    size_t first = expr->uses_time;
    if (expr->uses_time) degree[0] = expr_nonlinear;
    for (size_t i = 0; i < expr->variables; i++) degree[first + i] = expr_affine;
    bool jumps = false;
    for (size_t i = 0; i < expr->operations; i++)
        jumps |= expr->code[i].op == op_jump || expr->code[i].op == op_jump_unless;
    for (size_t i = 0; i < expr->operations; i++) {
        const struct instr *instr = &expr->code[i];
        if (instr->op == op_jump || instr->op == op_jump_unless) continue;
        enum expr_degree result = degree_after(instr, degree[instr->a], degree[instr->b]);
        /* Both sides of an `if` write the same register: the worse one counts. */
        degree[instr->to] = jumps ? larger(degree[instr->to], result) : result;
    }
    return degree[expr->result];
}

/* Registers are used again: one that has been worse before counts as that. */
enum expr_degree expr_jumps_degree(const struct expr *expr)
{
    enum expr_degree degree[frame_limit] = {expr_constant_between}, worst = expr_constant_between;
    size_t first = expr->uses_time;
    if (expr->uses_time) degree[0] = expr_nonlinear;
    for (size_t i = 0; i < expr->variables; i++) degree[first + i] = expr_affine;
    for (size_t i = 0; i < expr->operations; i++) {
        const struct instr *instr = &expr->code[i];
        if (instr->op == op_jump || instr->op == op_jump_unless) continue;
        if (op_is_switch(instr->op) && expr_switch_jumps(expr, (size_t)instr->extra))
            worst = larger(worst, larger(degree[instr->a], degree[instr->b]));
        degree[instr->to] =
            larger(degree[instr->to], degree_after(instr, degree[instr->a], degree[instr->b]));
    }
    return worst;
}
