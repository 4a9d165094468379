/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/program.h"

#include <limits.h>
#include <string.h>

static enum expr_degree larger(enum expr_degree a, enum expr_degree b)
{
    return a > b ? a : b;
}

/* The degree of a nonlinear operation: constant if its operands are constant. */
static enum expr_degree of_any(enum expr_degree a, enum expr_degree b)
{
    return larger(a, b) == expr_constant_between ? expr_constant_between : expr_nonlinear;
}

static enum expr_degree of_table(const struct table *table, enum expr_degree a)
{
    int degree = table_degree(table);
    return degree == 0 ? expr_constant_between : degree == 1 ? a : of_any(a, a);
}

/* The degree of a result from those of the operands; b is a for one operand. */
static enum expr_degree degree_after(const struct instr *instr, enum expr_degree a, enum expr_degree b)
{
    switch (instr->op) {
    case op_copy:
    case op_negate:
    case op_abs:
    case op_sawtooth:
    case op_levels: return a;
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
    case op_table: return of_table(instr->table, a);
    default: return op_is_switch(instr->op) ? expr_constant_between : of_any(a, b);
    }
}

static enum expr_degree degree_of_slot(int slot, int last, const bool *constant)
{
    if (constant && constant[slot]) return expr_constant_between;
    return slot <= last ? expr_affine : expr_nonlinear;
}

/* Set the degrees of time and variables. Returns true if the program has jumps: then a register may be written by either
 * side of an `if`. */
static bool begin(const struct expr *expr, enum expr_degree of_time, int last, const bool *constant,
                  enum expr_degree degree[frame_limit])
{
    size_t first = expr->uses_time;
    bool jumps = false;
    memset(degree, 0, frame_limit * sizeof *degree);
    if (expr->uses_time) degree[0] = of_time;
    for (size_t i = 0; i < expr->variables; i++)
        degree[first + i] = degree_of_slot(expr->slots[i], last, constant);
    for (size_t i = 0; i < expr->operations; i++)
        jumps |= expr->code[i].op == op_jump || expr->code[i].op == op_jump_unless;
    return jumps;
}

/* Set the degree of a result. Both sides of an `if` write the same register: the higher degree counts. */
static void take(const struct instr *instr, bool jumps, enum expr_degree *degree)
{
    enum expr_degree result = degree_after(instr, degree[instr->a], degree[instr->b]);
    degree[instr->to] = jumps ? larger(degree[instr->to], result) : result;
}

enum expr_degree expr_degree(const struct expr *expr, int last, const bool *constant)
{
    enum expr_degree degree[frame_limit];
    if (expr_is_constant(expr)) return expr_constant_between;
    bool jumps = begin(expr, expr_nonlinear, last, constant, degree);
    for (size_t i = 0; i < expr->operations; i++) {
        const struct instr *instr = &expr->code[i];
        if (instr->op != op_jump && instr->op != op_jump_unless) take(instr, jumps, degree);
    }
    return degree[expr->result];
}

bool expr_switch_depends(const struct expr *expr, size_t index, size_t on)
{
    bool follows[frame_limit] = {false};
    for (size_t i = 0; i < expr->operations; i++) {
        const struct instr *instr = &expr->code[i];
        if (instr->op == op_jump || instr->op == op_jump_unless) continue;
        bool does = follows[instr->a] || follows[instr->b], is_switch = op_is_switch(instr->op);
        if (is_switch && (size_t)instr->extra == index) return does;
        follows[instr->to] = does || (is_switch && (size_t)instr->extra == on);
    }
    return false;
}

/* A quotient by a divisor that varies is not affine. */
static enum expr_degree switching_degree(const struct instr *instr, const enum expr_degree *degree)
{
    enum expr_degree a = degree[instr->a], b = degree[instr->b];
    return op_is_by_quotient(instr->op) && b != expr_constant_between ? of_any(a, b) : larger(a, b);
}

static enum expr_degree switch_degree(const struct expr *expr, size_t index, enum expr_degree of_time,
                                      int last, const bool *constant)
{
    enum expr_degree degree[frame_limit], worst = expr_constant_between;
    bool jumps = begin(expr, of_time, last, constant, degree);
    for (size_t i = 0; i < expr->operations; i++) {
        const struct instr *instr = &expr->code[i];
        if (instr->op == op_jump || instr->op == op_jump_unless) continue;
        if (op_is_switch(instr->op) && (size_t)instr->extra == index)
            worst = larger(worst, switching_degree(instr, degree));
        take(instr, jumps, degree);
    }
    return worst;
}

enum expr_degree expr_switch_degree(const struct expr *expr, size_t index, int last, const bool *constant)
{
    return switch_degree(expr, index, expr_nonlinear, last, constant);
}

bool expr_switch_is_affine_in_time(const struct expr *expr, size_t index)
{
    return switch_degree(expr, index, expr_affine, 0, NULL) != expr_nonlinear;
}
