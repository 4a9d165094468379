/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Building a program from operands and operations while the text is being read.
 *
 * Temporaries form a stack: before reading a part of the expression note `depth`; the result of the part is
 * stored at that depth. Constants and variables take no temporary and no instruction, and an operation on
 * constants is folded.
 */
#ifndef FBD_EXPR_BUILD_H
#define FBD_EXPR_BUILD_H

#include "expr/program.h"

/* The dimension of a part of an expression. */
struct kind {
    struct dim dim; /* of a free part: its dimension if bare numbers were pure numbers */
    bool free;      /* it has a bare number as a factor and takes any dimension */
    bool truth;     /* a condition */
    bool failed;    /* an error was reported already: no further checks */
};

/* A part of the expression that has been read. */
struct operand {
    struct kind kind;
    enum { place_constant, place_variable, place_temporary } place;
    double value, rest;   /* of a constant, with its low part (base/double_double.h) */
    int index;            /* slot of a variable, number of a temporary */
    bool time, state, pi; /* depends on t, on other variables; contains the constant pi */
    struct pos at;        /* position for messages */
    struct pos broken;    /* position of a constant part that is not finite */
    bool is_broken;
    bool angle; /* a single variable that is an angle */
};

struct builder {
    struct arena scratch; /* memory of all arrays until the program is finished */
    struct instr *code;
    int *slots;
    struct double_double *constants;
    struct expr_switch *switches;
    size_t operations, slot_count, constant_count, switch_count;
    size_t code_room, slot_room, constant_room, switch_room;
    int depth, deepest; /* number of temporaries now, and at most */
    bool full;          /* the limit of operations was exceeded */
};

struct operand build_constant(double value, struct kind kind, struct pos at);
struct operand build_variable(int slot, struct kind kind, struct pos at);

/* Append the operation `op` (with `extra`, for op_whole_power) on `x` and `y` (NULL for one operand); its
 * result, of the given kind, is stored at depth `base`, and temporaries from there on are free again. */
struct operand build_operation(struct builder *builder, int base, enum op op, int extra,
                               const struct operand *x, const struct operand *y, struct kind kind,
                               struct pos at);

/* The value of `table` at `x`. */
/* Add levels to `x`, the argument of a function that varies only within a range of about `unit` (exp, tanh):
 * steps end at the levels. Otherwise a step could pass over the whole transition without a stage in it.
 * exp(-36) is below round-off; over the 8 units from level to level the stages of a step and error control
 * resolve the function. A constant gets no levels. */
struct operand build_levels(struct builder *b, int base, const struct operand *x, double unit);

struct operand build_table(struct builder *builder, int base, const struct table *table,
                           const struct operand *x, struct kind kind, struct pos at);

/* The parts of if(condition, a, b), in this order: start after the condition, first after a, second after b.
 */
struct choice {
    struct operand condition, first;
    size_t start, middle, constants_before;
    int base;
};

void build_choice_start(struct builder *builder, struct choice *choice, int base,
                        const struct operand *condition);
void build_choice_first(struct builder *builder, struct choice *choice, const struct operand *first);
struct operand build_choice_second(struct builder *builder, struct choice *choice,
                                   const struct operand *second, struct kind kind, struct pos at);

/* True when the program exceeds its limits (registers, operations). */
bool build_is_too_long(const struct builder *builder);

/* The finished program in `arena`; NULL when memory is out. */
struct expr *build_finish(struct builder *builder, struct arena *arena, const struct operand *result);

void build_free(struct builder *builder);

#endif
