/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/expr.h"

#include "expr/program.h"

bool expr_is_constant(const struct expr *expr)
{
    return expr->operations == 0 && !expr->uses_time && expr->variables == 0;
}

double expr_value(const struct expr *expr)
{
    return expr->constant[expr->result];
}

bool expr_is_bare(const struct expr *expr)
{
    return expr->bare;
}

struct dim expr_dim(const struct expr *expr)
{
    return expr->dim;
}

bool expr_uses_time(const struct expr *expr)
{
    return expr->uses_time;
}

size_t expr_variables(const struct expr *expr, const int **slots)
{
    *slots = expr->slots;
    return expr->variables;
}

size_t expr_switches(const struct expr *expr)
{
    return expr->switches;
}

bool expr_switch_is_time(const struct expr *expr, size_t index)
{
    return expr->switch_at[index].time;
}

bool expr_switch_remembers(const struct expr *expr, size_t index)
{
    return expr->switch_at[index].op == op_relay;
}

const struct table *expr_switch_table(const struct expr *expr, size_t index)
{
    return expr->switch_at[index].table;
}

bool expr_switch_is_silent(const struct expr *expr, size_t index)
{
    return expr->switch_at[index].op == op_levels;
}

const struct expr *expr_renumbered(struct arena *arena, const struct expr *expr, const int *moved)
{
    if (expr->variables == 0) return expr;
    struct expr *copy = ARENA_NEW(arena, struct expr);
    int *slots = ARENA_ARRAY(arena, expr->variables, int);
    if (!copy || !slots) return NULL;
    *copy = *expr;
    for (size_t i = 0; i < expr->variables; i++) slots[i] = moved[expr->slots[i]];
    copy->slots = slots;
    return copy;
}
