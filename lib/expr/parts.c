/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/parts.h"

#include <string.h>

/* ---- recognition: the form of each register, if it is a sum of parts */

struct sum {
    int count; /* 0: not of this form */
    struct expr_part parts[most_parts];
};

static bool is_constant(const struct sum *sum)
{
    return sum->count == 1 && sum->parts[0].kind == part_power && sum->parts[0].power == 0;
}

/* True for u or u^n, without a factor. */
static bool is_power(const struct sum *sum)
{
    return sum->count == 1 && sum->parts[0].kind == part_power && sum->parts[0].power > 0 &&
           sum->parts[0].c == 1;
}

static bool is_bare(const struct sum *sum)
{
    return sum->count == 1 && sum->parts[0].c == 1;
}

static struct sum leaf(const struct expr *expr, size_t reg)
{
    struct sum sum = {.count = 1, .parts = {{.kind = part_power, .power = 1, .c = 1, .variable = -1}}};
    size_t time = expr->uses_time ? 1 : 0;
    if (reg < time) return sum;
    if (reg < time + expr->variables) {
        sum.parts[0].variable = (int)(reg - time);
    } else {
        sum.parts[0].power = 0;
        sum.parts[0].c = expr->constant[reg - time - expr->variables];
    }
    return sum;
}

static const struct sum no_sum = {.count = 0};

/* (a + b + ...) + c. A sum on the right is refused: it would change the order of additions. */
static struct sum add(const struct sum *x, const struct sum *y, double sign)
{
    struct sum sum = *x;
    if (x->count == 0 || y->count != 1 || x->count == most_parts) return no_sum;
    sum.parts[sum.count] = y->parts[0];
    sum.parts[sum.count++].c *= sign;
    return sum;
}

static struct sum negate(const struct sum *x)
{
    struct sum sum = *x;
    for (int i = 0; i < sum.count; i++) sum.parts[i].c = -sum.parts[i].c;
    return sum;
}

static struct sum multiply(const struct sum *x, const struct sum *y)
{
    const struct sum *factor = is_constant(x) ? x : y, *other = factor == x ? y : x;
    struct sum sum = *other;
    if (is_constant(factor) && is_bare(other)) {
        sum.parts[0].c = factor->parts[0].c;
        return sum;
    }
    int power = x->parts[0].power + y->parts[0].power;
    if (!is_power(x) || !is_power(y) || x->parts[0].variable != y->parts[0].variable || power > 3)
        return no_sum;
    sum.parts[0].power = power;
    return sum;
}

/* sin or cos of u, w u, w u + p or p + w u. */
static struct sum harmonic(const struct sum *x, enum part_kind kind)
{
    const struct expr_part *turning = &x->parts[0], *phase = NULL;
    if (x->count == 2) {
        bool first = turning->kind == part_power && turning->power == 0;
        phase = &x->parts[first ? 0 : 1];
        turning = &x->parts[first ? 1 : 0];
        if (phase->kind != part_power || phase->power != 0) return no_sum;
    }
    if (x->count < 1 || x->count > 2 || turning->kind != part_power || turning->power != 1) return no_sum;
    return (struct sum){.count = 1,
                        .parts = {{.kind = kind,
                                   .variable = turning->variable,
                                   .c = 1,
                                   .w = turning->c,
                                   .p = phase ? phase->c : 0}}};
}

static struct sum whole_power_of(const struct sum *x, int n)
{
    struct sum sum = *x;
    if (!is_power(x) || x->parts[0].power != 1 || n < 1 || n > 3) return no_sum;
    sum.parts[0].power = n;
    return sum;
}

static struct sum apply(const struct instr *instr, const struct sum *x, const struct sum *y)
{
    if (x->count == 0 || y->count == 0) return no_sum;
    switch (instr->op) {
    case op_add: return add(x, y, 1);
    case op_subtract: return add(x, y, -1);
    case op_negate: return negate(x);
    case op_multiply: return multiply(x, y);
    case op_whole_power: return whole_power_of(x, instr->extra);
    case op_sin: return harmonic(x, part_sin);
    case op_cos: return harmonic(x, part_cos);
    default: return no_sum;
    }
}

bool parts_make(struct expr *expr, struct arena *scratch, struct arena *arena)
{
    enum { most_operations = 32 }; /* more cannot give so few parts */
    size_t leaves = (expr->uses_time ? 1 : 0) + expr->variables + expr->constants;
    if (leaves == expr->constants || expr->operations > most_operations) return true;
    struct sum *sums = ARENA_ARRAY(scratch, leaves + expr->operations, struct sum);
    if (!sums) return false;
    for (size_t i = 0; i < leaves; i++) sums[i] = leaf(expr, i);
    for (size_t i = 0; i < expr->operations; i++) {
        const struct instr *instr = &expr->code[i];
        if (instr->op == op_jump || instr->op == op_jump_unless) return true;
        sums[instr->to] = apply(instr, &sums[instr->a], &sums[instr->b]);
    }
    const struct sum *whole = &sums[expr->result];
    if (whole->count == 0) return true;
    struct expr_part *parts = ARENA_ARRAY(arena, (size_t)whole->count, struct expr_part);
    if (!parts) return false;
    memcpy(parts, whole->parts, (size_t)whole->count * sizeof *parts);
    expr->parts = parts;
    expr->part_count = whole->count;
    return true;
}
