/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Translation of programs of expr/ to C expressions, with the minimum of parentheses for the same operations
 * in the same order.
 */
#include "emit/expression.h"
#include "emit/live.h"

static struct arena *arena_of(const struct reading *reading)
{
    return &reading->emitter->arena;
}

static struct piece piece_of(const struct reading *reading, const char *text, enum bond bond)
{
    if (!text) arena_of(reading)->failed = true;
    return (struct piece){text ? text : "", bond};
}

/* The text, in parentheses if its precedence is lower than `least`. */
static const char *within(const struct reading *reading, struct piece piece, enum bond least)
{
    if (piece.bond >= least) return piece.text;
    const char *text = arena_printf(arena_of(reading), "(%s)", piece.text);
    return text ? text : "";
}

/* ---- leaves */

static const char *variable(const struct reading *reading, int slot)
{
    const struct emitter *emitter = reading->emitter;
    int n = emitter->model->plan.n, k = slot - 1;
    if (emit_is_live(emitter, slot)) return emit_live_variable(reading->emitter, slot);
    const char *name = k < n       ? emitter->coordinate[k]
                       : k < 2 * n ? emitter->rate[k - n]
                                   : emitter->place[k - 2 * n - hand_slots];
    return arena_printf(arena_of(reading), "y[%s]", name);
}

/* A slot, or -1 for a number. In duals the derivative of the chosen slot is 1. */
static struct piece leaf(const struct reading *reading, int slot, const char *text, enum bond bond)
{
    if (!reading->dual) return piece_of(reading, text, bond);
    const char *kind = slot == reading->slot ? "dual_along" : "dual_number";
    return piece_of(reading, arena_printf(arena_of(reading), "%s(%s)", kind, text ? text : ""), bond_whole);
}

static void read_leaves(struct reading *reading)
{
    const struct expr *expr = reading->expr;
    size_t n = 0;
    if (expr->uses_time) reading->registers[n++] = leaf(reading, 0, "t", bond_whole);
    for (size_t i = 0; i < expr->variables; i++)
        reading->registers[n++] =
            leaf(reading, expr->slots[i], variable(reading, expr->slots[i]), bond_whole);
    for (size_t i = 0; i < expr->constants; i++)
        reading->registers[n++] = leaf(reading, -1, emit_number(reading->emitter, expr->constant[i]),
                                       expr->constant[i] < 0 ? bond_sign : bond_whole);
}

/* ---- operations */

static struct piece binary(const struct reading *reading, const char *sign, struct piece a, struct piece b,
                           enum bond bond)
{
    const char *left = within(reading, a, bond), *right = within(reading, b, bond + 1);
    return piece_of(reading, arena_printf(arena_of(reading), "%s %s %s", left, sign, right), bond);
}

static struct piece product(const struct reading *reading, const char *sign, struct piece a, struct piece b)
{
    const char *left = within(reading, a, bond_product), *right = within(reading, b, bond_sign + 1);
    return piece_of(reading, arena_printf(arena_of(reading), "%s%s%s", left, sign, right), bond_product);
}

static struct piece call(const struct reading *reading, const char *function, const char *arguments)
{
    return piece_of(reading, arena_printf(arena_of(reading), "%s(%s)", function, arguments), bond_whole);
}

static struct piece call_two(const struct reading *reading, const char *function, struct piece a,
                             struct piece b)
{
    const char *arguments = arena_printf(arena_of(reading), "%s, %s", a.text, b.text);
    return call(reading, function, arguments ? arguments : "");
}

static struct piece whole_power_of(const struct reading *reading, struct piece a, int n)
{
    if (n == 2) return call(reading, "square", a.text);
    if (n == 3) return call(reading, "cube", a.text);
    const char *arguments = arena_printf(arena_of(reading), "%s, %d", a.text, n);
    return call(reading, "whole_power", arguments ? arguments : "");
}

static const char *function_of(unsigned op)
{
    switch (op) {
    case op_sqrt: return "sqrt";
    case op_cbrt: return "cbrt";
    case op_exp: return "exp";
    case op_ln: return "log";
    case op_log10: return "log10";
    case op_sin: return "sin";
    case op_cos: return "cos";
    case op_tan: return "tan";
    case op_asin: return "asin";
    case op_acos: return "acos";
    case op_atan: return "atan";
    case op_sinh: return "sinh";
    case op_cosh: return "cosh";
    case op_tanh: return "tanh";
    default: return NULL;
    }
}

/* ---- switches: the smooth formula of the branch */

static const char *switch_format(unsigned op)
{
    switch (op) {
    case op_abs: return "in_branch_abs(%s, %s)";
    case op_step: return "(%s < 0 ? 0.0 : 1.0)";
    case op_relay: return "(%s > 0 ? 1.0 : -1.0)";
    case op_min: return "in_branch_min(%s, %s, %s)";
    case op_max: return "in_branch_max(%s, %s, %s)";
    case op_less:
    case op_less_equal: return "(%s < 0)";
    case op_greater:
    case op_greater_equal: return "(%s > 0)";
    case op_equal: return "(%s == 0)";
    case op_mod: return "in_branch_mod(%s, %s, %s)";
    case op_sawtooth: return "in_branch_sawtooth(%s, %s)";
    case op_square: return "in_branch_square(%s)";
    default: return "%s"; /* sign, floor, ceil, round */
    }
}

static const char *fill(struct arena *arena, const char *format, const char *n, const char *a, const char *b)
{
    const char *const values[] = {n, a, b};
    struct text text = {0};
    int next = 0;
    for (const char *c = format; *c; c++) {
        if (*c == '%') {
            text_add(&text, values[next++]);
            c++;
        } else {
            text_add_bytes(&text, c, 1);
        }
    }
    const char *copy = text.failed ? NULL : arena_text(arena, text.data, text.length);
    text_free(&text);
    return copy;
}

static struct piece switched(const struct reading *reading, const struct instr *i, const char *condition)
{
    struct arena *arena = arena_of(reading);
    struct piece a = reading->registers[i->a], b = reading->registers[i->b];
    const char *name = reading->emitter->branch[reading->first + i->extra];
    const char *branch = arena_printf(arena, "s->branch[%s]", name);
    if (reading->switches) reading->switches[i->extra] = (struct emit_switch){i, a.text, b.text, condition};
    if (i->op == op_levels) return a;
    return piece_of(reading, fill(arena, switch_format(i->op), branch ? branch : "", a.text, b.text),
                    bond_whole);
}

/* The operation on dual numbers, by a function for each. */
static struct piece operate_dual(const struct reading *reading, const struct instr *i)
{
    struct arena *arena = arena_of(reading);
    const char *a = reading->registers[i->a].text, *b = reading->registers[i->b].text;
    const char *name = emit_dual_name(i->op);
    if (i->op == op_copy || i->op == op_levels) return reading->registers[i->a];
    if (i->op == op_whole_power)
        return piece_of(reading, arena_printf(arena, "dual_whole_power(%s, %d)", a, i->extra), bond_whole);
    if (op_is_switch(i->op)) {
        const char *branch = reading->emitter->branch[reading->first + i->extra];
        branch = arena_printf(arena, "s->branch[%s]", branch);
        if (!branch) branch = "";
        if (name && op_is_by_difference(i->op))
            return piece_of(reading, arena_printf(arena, "%s(%s, %s, %s)", name, branch, a, b), bond_whole);
        if (i->op == op_mod)
            return piece_of(reading, arena_printf(arena, "%s(%s, %s, %s)", name, branch, a, b), bond_whole);
        if (name) return piece_of(reading, arena_printf(arena, "%s(%s, %s)", name, branch, a), bond_whole);
        const char *value = fill(arena, switch_format(i->op), branch, a, b);
        return piece_of(reading, arena_printf(arena, "dual_number(%s)", value ? value : ""), bond_whole);
    }
    if (i->op == op_and || i->op == op_or)
        return piece_of(reading,
                        arena_printf(arena, "dual_number(%s.v != 0 %s %s.v != 0)", a,
                                     i->op == op_and ? "&&" : "||", b),
                        bond_whole);
    if (i->op == op_not)
        return piece_of(reading, arena_printf(arena, "dual_number(%s.v == 0)", a), bond_whole);
    if (emit_dual_takes_two(i->op))
        return piece_of(reading, arena_printf(arena, "%s(%s, %s)", name, a, b), bond_whole);
    return piece_of(reading, arena_printf(arena, "%s(%s)", name, a), bond_whole);
}

static struct piece operate(const struct reading *reading, const struct instr *i, const char *condition)
{
    struct piece a = reading->registers[i->a], b = reading->registers[i->b];
    const char *function = function_of(i->op);
    if (reading->dual) return operate_dual(reading, i);
    if (function) return call(reading, function, a.text);
    switch (i->op) {
    case op_copy: return a;
    case op_negate:
        return piece_of(reading, arena_printf(arena_of(reading), "-%s", within(reading, a, bond_whole)),
                        bond_sign);
    case op_add: return binary(reading, "+", a, b, bond_sum);
    case op_subtract: return binary(reading, "-", a, b, bond_sum);
    case op_multiply: return product(reading, "*", a, b);
    case op_divide: return product(reading, "/", a, b);
    case op_whole_power: return whole_power_of(reading, a, i->extra);
    case op_power: return call_two(reading, "pow", a, b);
    case op_hypot: return call_two(reading, "hypot", a, b);
    case op_atan2: return call_two(reading, "atan2", a, b);
    case op_and:
    case op_or:
        return piece_of(reading,
                        arena_printf(arena_of(reading), "((%s) != 0 %s (%s) != 0)", a.text,
                                     i->op == op_and ? "&&" : "||", b.text),
                        bond_whole);
    case op_not: return piece_of(reading, arena_printf(arena_of(reading), "((%s) == 0)", a.text), bond_whole);
    default: return switched(reading, i, condition);
    }
}

/* ---- choices: two jumps, one over each side */

static const char *both(const struct reading *reading, const char *outer, const char *inner, bool holds)
{
    const char *own = arena_printf(arena_of(reading), holds ? "(%s)" : "!(%s)", inner);
    if (!outer || !own) return own ? own : "";
    const char *all = arena_printf(arena_of(reading), "%s && %s", outer, own);
    return all ? all : "";
}

/* The register with the result of the instructions [from, to). */
static size_t last_register(const struct expr *expr, size_t from, size_t to)
{
    while (to > from && (expr->code[to - 1].op == op_jump || expr->code[to - 1].op == op_jump_unless)) to--;
    return to > from ? expr->code[to - 1].to : expr->result;
}

static void read_range(struct reading *reading, size_t from, size_t to, const char *condition)
{
    const struct instr *code = reading->expr->code;
    for (size_t i = from; i < to; i++) {
        if (code[i].op != op_jump_unless) {
            reading->registers[code[i].to] = operate(reading, &code[i], condition);
            continue;
        }
        size_t middle = i + (size_t)code[i].extra, end = middle + (size_t)code[middle].extra + 1;
        struct piece when = reading->registers[code[i].a];
        read_range(reading, i + 1, middle, both(reading, condition, when.text, true));
        size_t result = last_register(reading->expr, middle + 1, end);
        struct piece first = reading->registers[result];
        read_range(reading, middle + 1, end, both(reading, condition, when.text, false));
        struct piece second = reading->registers[result];
        reading->registers[result] =
            piece_of(reading,
                     arena_printf(arena_of(reading),
                                  reading->dual ? "(%s.v != 0 ? %s : %s)" : "(%s ? %s : %s)", when.text,
                                  first.text, second.text),
                     bond_whole);
        i = end - 1;
    }
}

static const char *read_program(struct reading *reading)
{
    struct emitter *emitter = reading->emitter;
    const struct expr *expr = reading->expr;
    size_t leaves = (expr->uses_time ? 1 : 0) + expr->variables + expr->constants;
    reading->registers = ARENA_ARRAY(&emitter->arena, leaves + expr->operations + 1, struct piece);
    if (!reading->registers) return "";
    for (size_t i = 0; i < leaves + expr->operations + 1; i++) reading->registers[i].text = "";
    read_leaves(reading);
    read_range(reading, 0, expr->operations, NULL);
    return reading->registers[expr->result].text;
}

const char *emit_expression(struct emitter *emitter, const struct expr *expr, int first)
{
    return read_program(&(struct reading){.emitter = emitter, .expr = expr, .first = first});
}

const char *emit_dual(struct emitter *emitter, const struct expr *expr, int first, int slot)
{
    return read_program(
        &(struct reading){.emitter = emitter, .expr = expr, .first = first, .dual = true, .slot = slot});
}

bool emit_switches(struct emitter *emitter, const struct expr *expr, int first, struct emit_switch *switches)
{
    read_program(&(struct reading){.emitter = emitter, .expr = expr, .first = first, .switches = switches});
    return !emitter->arena.failed;
}
