/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/build.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "expr/parts.h"
#include "expr/steps.h"

/* While a program is being compiled, its registers are named by kind; their numbers are known at the end. */
enum {
    of_variable = 0,
    of_constant = 0x4000,
    of_temporary = 0x8000,
    of_any = 0xC000,
    register_mask = 0x3FFF
};

struct operand build_constant(double value, struct kind kind, struct pos at)
{
    return (struct operand){.kind = kind, .place = place_constant, .value = value, .at = at};
}

struct operand build_variable(int slot, struct kind kind, struct pos at)
{
    return (struct operand){.kind = kind,
                            .place = place_variable,
                            .index = slot,
                            .time = slot == 0,
                            .state = slot != 0,
                            .at = at};
}

/* Make room for one more element of an array in the scratch arena, which keeps the old copies until the end;
 * growth by half bounds them to a few times the final size. NULL when memory is out. */
static void *grow(struct builder *builder, void *array, size_t count, size_t *room, size_t size)
{
    if (count < *room) return array;
    size_t larger = *room ? *room + *room / 2 : 16;
    void *copy = arena_array(&builder->scratch, larger, size);
    if (!copy) return NULL;
    if (count) memcpy(copy, array, count * size);
    *room = larger;
    return copy;
}

static size_t add_slot(struct builder *b, int slot)
{
    for (size_t i = 0; i < b->slot_count; i++)
        if (b->slots[i] == slot) return i;
    int *slots = grow(b, b->slots, b->slot_count, &b->slot_room, sizeof *slots);
    if (!slots) return 0;
    b->slots = slots;
    slots[b->slot_count] = slot;
    return b->slot_count++;
}

/* Compare bits: == does not distinguish -0 from 0. */
static bool same_bits(double a, double b)
{
    uint64_t x, y;
    memcpy(&x, &a, sizeof x);
    memcpy(&y, &b, sizeof y);
    return x == y;
}

static size_t add_constant(struct builder *b, struct double_double value)
{
    for (size_t i = 0; i < b->constant_count; i++)
        if (same_bits(b->constants[i].x, value.x) && b->constants[i].rest == value.rest) return i;
    struct double_double *constants =
        grow(b, b->constants, b->constant_count, &b->constant_room, sizeof *constants);
    if (!constants) return 0;
    b->constants = constants;
    constants[b->constant_count] = value;
    return b->constant_count++;
}

static int add_switch(struct builder *b, const struct instr *instr, bool time)
{
    struct expr_switch *switches = grow(b, b->switches, b->switch_count, &b->switch_room, sizeof *switches);
    if (!switches) return 0;
    b->switches = switches;
    switches[b->switch_count] =
        (struct expr_switch){.op = (enum op)instr->op, .time = time, .table = instr->table};
    return (int)b->switch_count++;
}

/* True beyond the limits: then the text is read on for further messages only, and the program is discarded. */
bool build_is_too_long(const struct builder *b)
{
    return b->full || b->slot_count + b->constant_count + (size_t)b->deepest > frame_limit;
}

static void add_instr(struct builder *b, struct instr instr)
{
    if (b->operations == operation_limit) b->full = true;
    if (build_is_too_long(b)) return;
    struct instr *code = grow(b, b->code, b->operations, &b->code_room, sizeof *code);
    if (!code) return;
    b->code = code;
    code[b->operations++] = instr;
}

static unsigned short name_register(struct builder *b, const struct operand *operand)
{
    if (build_is_too_long(b)) return 0;
    switch (operand->place) {
    case place_constant:
        return (unsigned short)(of_constant +
                                (int)add_constant(b, (struct double_double){operand->value, operand->rest}));
    case place_variable: return (unsigned short)(of_variable + (int)add_slot(b, operand->index));
    default: return (unsigned short)(of_temporary + operand->index);
    }
}

static unsigned short claim(struct builder *b, int base)
{
    b->depth = base + 1;
    if (b->depth > b->deepest) b->deepest = b->depth;
    return (unsigned short)(of_temporary | (base & register_mask));
}

/* Set the properties that a result inherits from its operands. */
static void inherit(struct operand *whole, const struct operand *part)
{
    whole->time = whole->time || part->time;
    whole->state = whole->state || part->state;
    whole->pi = whole->pi || part->pi;
    if (part->is_broken && !whole->is_broken) {
        whole->is_broken = true;
        whole->broken = part->broken;
    }
}

/* The rounding error of a sum, product or quotient of constants, kept as low part: the end of a pulse is
 * start + width, whose digits beyond those of the start would be lost. */
static double rest_of(enum op op, const struct operand *x, const struct operand *y)
{
    struct double_double a = {x->value, x->rest}, b = {y->value, y->rest}, result = {0, 0};
    switch (op) {
    case op_negate: return -a.rest;
    case op_add: result = dd_add(a, b); break;
    case op_subtract: result = dd_subtract(a, b); break;
    case op_multiply: result = dd_multiply(a, b); break;
    case op_divide: result = dd_divide(a, b); break;
    default: break;
    }
    return isfinite(result.x) ? result.rest : 0;
}

/* Fold an operation on constants. */
static void fold(const struct instr *instr, const struct operand *x, const struct operand *y,
                 struct operand *result)
{
    result->place = place_constant;
    result->value = op_value(instr, x->value, y->value);
    result->rest = rest_of(instr->op, x, y);
    if (isfinite(result->value) || result->is_broken) return;
    result->is_broken = true;
    result->broken = result->at;
}

static struct operand build_instr(struct builder *b, int base, struct instr instr, const struct operand *x,
                                  const struct operand *y, struct kind kind, struct pos at)
{
    struct operand result = {.kind = kind, .at = at};
    const struct operand *second = y ? y : x;
    inherit(&result, x);
    inherit(&result, second);
    if (x->place == place_constant && second->place == place_constant) {
        fold(&instr, x, second, &result);
        b->depth = base;
        return result;
    }
    if (op_is_switch(instr.op)) instr.extra = add_switch(b, &instr, !result.state);
    instr.a = name_register(b, x);
    instr.b = name_register(b, second);
    instr.to = claim(b, base);
    add_instr(b, instr);
    result.place = place_temporary;
    result.index = base;
    return result;
}

struct operand build_operation(struct builder *b, int base, enum op op, int extra, const struct operand *x,
                               const struct operand *y, struct kind kind, struct pos at)
{
    return build_instr(b, base, (struct instr){.op = (unsigned char)op, .extra = extra}, x, y, kind, at);
}

/* Tables with at most this many points get a switch for each jump. */
enum { most_own_jumps = 8 };

/* True for a table of steps in the state with few points. It is built as r_i = r_(i-1) + step(x - x_i) (y_i -
 * r_(i-1)), so that each jump is a switch like sign(x - x_i), at which a sliding mode may occur
 * (dynamics/sliding.h). */
static bool has_own_jumps(const struct table *table, const struct operand *x)
{
    return table->interpolation == table_step && x->state &&
           (table->beyond == table_hold || table->beyond == table_zero) && table->count <= most_own_jumps;
}

static struct operand build_jumps(struct builder *b, int base, const struct table *table,
                                  const struct operand *x, struct kind kind, struct pos at)
{
    struct kind own = x->kind, pure = {.failed = kind.failed};
    struct operand value = build_constant(table->before, kind, at);
    for (size_t i = 0; i < table->count; i++) {
        bool last = i + 1 == table->count;
        double level = last ? table->after : table->c[4 * i];
        if (!last && value.place == place_constant && value.value == level) continue;
        struct operand edge = build_constant(table->x[i], own, at), next = build_constant(level, kind, at);
        int room = base + 1; /* after the register of the argument */
        struct operand far = build_operation(b, room + 1, op_subtract, 0, x, &edge, own, at);
        struct operand on =
            build_instr(b, room + 1, (struct instr){.op = op_step, .table = table}, &far, NULL, pure, at);
        struct operand rise = build_operation(b, room + 2, op_subtract, 0, &next, &value, kind, at);
        rise = build_operation(b, room + 1, op_multiply, 0, &on, &rise, kind, at);
        value = build_operation(b, last ? base : room, op_add, 0, &value, &rise, kind, at);
    }
    return value;
}

struct operand build_table(struct builder *b, int base, const struct table *table, const struct operand *x,
                           struct kind kind, struct pos at)
{
    if (has_own_jumps(table, x)) return build_jumps(b, base, table, x, kind, at);
    return build_instr(b, base, (struct instr){.op = op_table, .table = table}, x, NULL, kind, at);
}

struct operand build_levels(struct builder *b, int base, const struct operand *x, double unit)
{
    const double stretch = 8; /* so the outermost levels are at 36 */
    struct kind pure = {.failed = x->kind.failed};
    struct operand length = build_constant(stretch * unit, pure, x->at);
    if (x->place == place_constant || x->kind.failed) return *x;
    return build_operation(b, base, op_levels, 0, x, &length, x->kind, x->at);
}

/* ---- if: the side that is not chosen is jumped over, so it costs no time and its switches are inactive */

void build_choice_start(struct builder *b, struct choice *choice, int base, const struct operand *condition)
{
    *choice = (struct choice){.condition = *condition,
                              .start = b->operations,
                              .constants_before = b->constant_count,
                              .base = base};
    unsigned short a = name_register(b, condition);
    add_instr(b, (struct instr){.op = op_jump_unless, .a = a, .b = a});
    b->depth = base;
}

/* Copy the result of a side to the register of both, unless it is there already. */
static void settle(struct builder *b, int base, const struct operand *side)
{
    if (side->place != place_temporary) {
        unsigned short a = name_register(b, side);
        add_instr(b, (struct instr){.op = op_copy, .to = claim(b, base), .a = a, .b = a});
    }
    b->depth = base;
}

static void aim(struct builder *b, size_t from)
{
    if (from < b->operations) b->code[from].extra = (int)(b->operations - from - 1);
}

void build_choice_first(struct builder *b, struct choice *choice, const struct operand *first)
{
    choice->first = *first;
    settle(b, choice->base, first);
    choice->middle = b->operations;
    add_instr(b, (struct instr){.op = op_jump});
    aim(b, choice->start);
}

struct operand build_choice_second(struct builder *b, struct choice *choice, const struct operand *second,
                                   struct kind kind, struct pos at)
{
    const struct operand *condition = &choice->condition, *first = &choice->first;
    bool decided = condition->place == place_constant;
    const struct operand *chosen = condition->value != 0 ? first : second;
    struct operand result = {.kind = kind, .at = at};
    inherit(&result, condition);
    /* A constant condition guards the other side: if(n > 0, 1/n, 0) is valid for n = 0. */
    if (!decided || chosen == first) inherit(&result, first);
    if (!decided || chosen == second) inherit(&result, second);
    if (decided && first->place == place_constant && second->place == place_constant) {
        b->operations = choice->start;
        b->constant_count = choice->constants_before;
        b->depth = choice->base;
        result.place = place_constant;
        result.value = chosen->value;
        return result;
    }
    settle(b, choice->base, second);
    aim(b, choice->middle);
    claim(b, choice->base);
    result.place = place_temporary;
    result.index = choice->base;
    return result;
}

/* ---- finishing */

static int by_value(const void *a, const void *b)
{
    int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

static size_t find_slot(const int *slots, size_t count, int slot)
{
    size_t i = 0;
    while (i < count && slots[i] != slot) i++;
    return i;
}

/* The final number of a register: variables in ascending order, then constants, then temporaries. */
static unsigned short locate(const struct builder *b, const int *sorted, unsigned short name)
{
    size_t index = name & register_mask;
    switch (name & of_any) {
    case of_variable: index = find_slot(sorted, b->slot_count, b->slots[index]); break;
    case of_constant: index += b->slot_count; break;
    default: index += b->slot_count + b->constant_count; break;
    }
    return (unsigned short)index;
}

static void locate_all(const struct builder *b, const int *sorted, struct instr *code)
{
    for (size_t i = 0; i < b->operations; i++) {
        code[i] = b->code[i];
        /* Jumps have no result, and unconditional ones no operands; register 0 always exists. */
        bool jump = code[i].op == op_jump, control = jump || code[i].op == op_jump_unless;
        code[i].to = control ? 0 : locate(b, sorted, b->code[i].to);
        code[i].a = jump ? 0 : locate(b, sorted, b->code[i].a);
        code[i].b = jump ? 0 : locate(b, sorted, b->code[i].b);
    }
}

/* Most values of a scene are numbers: programs of one constant, which is stored in the program itself. */
static struct expr *finish_constant(const struct builder *b, struct expr *expr, const struct operand *result)
{
    *expr = (struct expr){.constants = 1,
                          .constant = &expr->single,
                          .single = b->constants[0].x,
                          .dim = result->kind.dim,
                          .bare = result->kind.free};
    return expr;
}

static size_t find_last_switch(const struct instr *code, size_t operations)
{
    while (operations > 0 && !op_is_switch(code[operations - 1].op)) operations--;
    return operations > 0 ? operations - 1 : 0;
}

struct expr *build_finish(struct builder *b, struct arena *arena, const struct operand *result)
{
    unsigned short root = name_register(b, result);
    struct expr *expr = ARENA_NEW(arena, struct expr);
    if (b->scratch.failed || !expr) return NULL;
    if (b->operations == 0 && b->slot_count == 0 && b->constant_count == 1)
        return finish_constant(b, expr, result);
    struct instr *code = ARENA_ARRAY(arena, b->operations, struct instr);
    int *sorted = ARENA_ARRAY(arena, b->slot_count, int);
    double *constants = ARENA_ARRAY(arena, 2 * b->constant_count, double);
    struct expr_switch *switches = ARENA_ARRAY(arena, b->switch_count, struct expr_switch);
    if (!code || !sorted || !constants || !switches) return NULL;
    if (b->slot_count) {
        memcpy(sorted, b->slots, b->slot_count * sizeof *sorted);
        qsort(sorted, b->slot_count, sizeof *sorted, by_value);
    }
    locate_all(b, sorted, code);
    double *rests = constants + b->constant_count;
    for (size_t i = 0; i < b->constant_count; i++) {
        constants[i] = b->constants[i].x;
        rests[i] = b->constants[i].rest;
    }
    if (b->switch_count) memcpy(switches, b->switches, b->switch_count * sizeof *switches);
    bool time = b->slot_count > 0 && sorted[0] == 0;
    *expr = (struct expr){.code = code,
                          .operations = b->operations,
                          .uses_time = time,
                          .variables = b->slot_count - (time ? 1 : 0),
                          .slots = sorted + (time ? 1 : 0),
                          .constants = b->constant_count,
                          .constant = constants,
                          .constant_rest = rests,
                          .result = locate(b, sorted, root),
                          .switches = b->switch_count,
                          .last_switch = find_last_switch(code, b->operations),
                          .switch_at = switches,
                          .dim = result->kind.dim,
                          .bare = result->kind.free};
    bool made = parts_make(expr, &b->scratch, arena) && (expr->parts || steps_make(expr, &b->scratch, arena));
    return made ? expr : NULL;
}

void build_free(struct builder *b)
{
    arena_free(&b->scratch);
}
