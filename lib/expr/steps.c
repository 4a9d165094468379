/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/steps.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* ---- running */

static double any(const struct instr *instr, double x, double y, const int *branch)
{
    if (branch && op_is_switch(instr->op))
        return switch_value(instr, switch_branch(instr, x, y, branch), x, y);
    return op_value(instr, x, y);
}

/* The place of an operand never changes, so the branch is predicted, and the value costs one load. */
static inline double fetch(const struct step_operand *operand, const struct expr *expr, double t,
                           const double *y, const double *kept)
{
    if (operand->place == at_constant) return operand->constant;
    if (operand->place == at_time) return t;
    return operand->place == at_state ? y[expr->slots[operand->index] - 1] : kept[operand->index];
}

#define A fetch(&step->a, expr, t, y, kept)
#define B fetch(&step->b, expr, t, y, kept)

double steps_run(const struct expr *expr, double t, const double *y, const int *branch)
{
    double kept[most_kept];
    const struct step *end = expr->steps + expr->step_count;
    double x = 0;
    for (const struct step *step = expr->steps; step < end; step++) {
        switch (step->op) {
        case step_load: x = A; break;
        case step_keep: kept[step->a.index] = x; break;
        case step_negate: x = -x; break;
        case step_add: x = x + A; break;
        case step_subtract: x = x - A; break;
        case step_subtract_from: x = A - x; break;
        case step_multiply: x = x * A; break;
        case step_divide: x = x / A; break;
        case step_divide_into: x = A / x; break;
        case step_square: x = x * x; break;
        case step_cube: x = x * (x * x); break;
        case step_sqrt: x = sqrt(x); break;
        case step_sin: x = sin(x); break;
        case step_cos: x = cos(x); break;
        case step_exp: x = exp(x); break;
        case step_sum: x = A + B; break;
        case step_difference: x = A - B; break;
        case step_product: x = A * B; break;
        case step_quotient: x = A / B; break;
        case step_sin_product: x = sin(A * B); break;
        case step_cos_product: x = cos(A * B); break;
        case step_add_product: x = x + A * B; break;
        case step_subtract_product: x = x - A * B; break;
        case step_any: x = any(step->instr, x, A, branch); break;
        case step_any_from: x = any(step->instr, A, x, branch); break;
        }
    }
    return x;
}

#undef A
#undef B

/* ---- construction */

struct maker {
    const struct expr *expr;
    struct step *steps;
    size_t count;
    int latest;   /* the register in the accumulator, or -1 */
    bool refused; /* the program does not fit */
};

static size_t leaves_of(const struct expr *expr)
{
    return (expr->uses_time ? 1 : 0) + expr->variables + expr->constants;
}

static struct step_operand operand(struct maker *maker, size_t reg)
{
    const struct expr *expr = maker->expr;
    size_t time = expr->uses_time ? 1 : 0;
    if (reg < time) return (struct step_operand){.place = at_time};
    reg -= time;
    if (reg < expr->variables) return (struct step_operand){.place = at_state, .index = (int)reg};
    reg -= expr->variables;
    if (reg < expr->constants)
        return (struct step_operand){.place = at_constant, .constant = expr->constant[reg]};
    reg -= expr->constants;
    if (reg >= most_kept) maker->refused = true;
    return (struct step_operand){.place = at_kept, .index = (int)reg};
}

static void emit(struct maker *maker, struct step step)
{
    assert(maker->steps); /* checked by steps_make */
    maker->steps[maker->count++] = step;
}

/* Number of reads of a register behind instruction `at`, before it is overwritten. */
static int reads_behind(const struct expr *expr, const struct instr *at, size_t reg)
{
    int reads = 0;
    const struct instr *end = expr->code + expr->operations;
    for (const struct instr *i = at + 1; i < end; i++) {
        reads += i->a == reg || i->b == reg;
        if (i->to == reg) break;
    }
    return reads;
}

static void keep(struct maker *maker)
{
    if (maker->latest < 0) return;
    emit(maker, (struct step){.op = step_keep, .a = operand(maker, (size_t)maker->latest)});
    maker->latest = -1;
}

static bool is_binary(unsigned op)
{
    switch (op) {
    case op_add:
    case op_subtract:
    case op_multiply:
    case op_divide:
    case op_power:
    case op_hypot:
    case op_atan2:
    case op_and:
    case op_or:
    case op_mod: return true;
    default: return op_is_by_difference(op);
    }
}

/* The steps for x op a, a op x and a op b; step_any if there is none. */
struct forms {
    enum step_op on, from, pair;
};

static struct forms forms_of(unsigned op)
{
    switch (op) {
    case op_add: return (struct forms){step_add, step_add, step_sum};
    case op_subtract: return (struct forms){step_subtract, step_subtract_from, step_difference};
    case op_multiply: return (struct forms){step_multiply, step_multiply, step_product};
    case op_divide: return (struct forms){step_divide, step_divide_into, step_quotient};
    default: return (struct forms){step_any, step_any_from, step_any};
    }
}

static enum step_op unary_form(const struct instr *instr)
{
    switch (instr->op) {
    case op_negate: return step_negate;
    case op_sqrt: return step_sqrt;
    case op_sin: return step_sin;
    case op_cos: return step_cos;
    case op_exp: return step_exp;
    case op_whole_power: return instr->extra == 2 ? step_square : instr->extra == 3 ? step_cube : step_any;
    default: return step_any;
    }
}

/* Load the operand into the accumulator. */
static void add_same(struct maker *maker, const struct instr *instr)
{
    struct step_operand a = operand(maker, instr->a);
    if (maker->latest == instr->a) return;
    keep(maker);
    emit(maker, (struct step){.op = step_load, .a = a});
}

static void add_unary(struct maker *maker, const struct instr *instr)
{
    add_same(maker, instr);
    /* `any` reads a second operand even if the operation has none. */
    struct step step = {.op = unary_form(instr), .a = {.place = at_time}, .instr = instr};
    struct step *before = &maker->steps[maker->count - 1];
    if (before->op == step_product && (step.op == step_sin || step.op == step_cos))
        before->op = step.op == step_sin ? step_sin_product : step_cos_product;
    else
        emit(maker, step);
}

static void add_binary(struct maker *maker, const struct instr *instr)
{
    struct forms forms = forms_of(instr->op);
    struct step_operand a = operand(maker, instr->a), b = operand(maker, instr->b);
    bool held = maker->latest >= 0, is_a = held && maker->latest == instr->a,
         is_b = held && maker->latest == instr->b;
    if (is_a && is_b) { /* x op x */
        int latest = maker->latest;
        keep(maker);
        maker->latest = latest;
    } else if (!is_a && !is_b) {
        keep(maker);
        if (forms.pair != step_any) {
            emit(maker, (struct step){.op = forms.pair, .a = a, .b = b});
            return;
        }
        emit(maker, (struct step){.op = step_load, .a = a});
        is_a = true;
    }
    struct step step = {.op = is_a ? forms.on : forms.from, .a = is_a ? b : a, .instr = instr};
    struct step *last = maker->count >= 2 ? &maker->steps[maker->count - 2] : NULL;
    bool kept = last && last[0].op == step_keep && last[1].op == step_product && step.a.place == at_kept &&
                step.a.index == last[0].a.index &&
                reads_behind(maker->expr, instr, is_a ? instr->b : instr->a) == 0;
    if (kept && (step.op == step_add || step.op == step_subtract_from)) {
        /* keep x, a b, then x + (a b) or x - (a b) */
        last[0] = last[1];
        last[0].op = step.op == step_add ? step_add_product : step_subtract_product;
        maker->count--;
    } else {
        emit(maker, step);
    }
}

bool steps_make(struct expr *expr, struct arena *scratch, struct arena *arena)
{
    struct maker maker = {.expr = expr, .latest = -1};
    if (leaves_of(expr) == expr->constants && expr->operations == 0) return true;
    maker.steps =
        ARENA_ARRAY(scratch, 4 * expr->operations + 1, struct step); /* keep, load, operation, keep */
    if (!maker.steps) return false;
    for (size_t i = 0; i < expr->operations && !maker.refused; i++) {
        const struct instr *instr = &expr->code[i];
        if (instr->op == op_jump || instr->op == op_jump_unless || instr->op == op_copy) return true;
        if (instr->op == op_levels)
            add_same(&maker, instr);
        else if (is_binary(instr->op))
            add_binary(&maker, instr);
        else
            add_unary(&maker, instr);
        maker.latest = instr->to;
        if (reads_behind(expr, instr, instr->to) > 1) /* read again later, as in pulse and clamp */
            emit(&maker, (struct step){.op = step_keep, .a = operand(&maker, instr->to)});
    }
    if (maker.latest < 0) /* a single leaf */
        emit(&maker, (struct step){.op = step_load, .a = operand(&maker, expr->result)});
    else if ((size_t)maker.latest != expr->result)
        maker.refused = true;
    if (maker.refused) return true;
    struct step *steps = ARENA_ARRAY(arena, maker.count, struct step);
    if (!steps) return false;
    memcpy(steps, maker.steps, maker.count * sizeof *steps);
    expr->steps = steps;
    expr->step_count = maker.count;
    return true;
}
