/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From operands and operations to a program, while the text is being read.
 *
 * Temporaries follow the discipline of a stack: whoever reads a part of the expression notes `depth` before,
 * and the result of the part takes the place of that depth. Constants and variables take no place, so no
 * instruction is made for them, and an operation on constants is done at once.
 */
#ifndef FBD_EXPR_BUILD_H
#define FBD_EXPR_BUILD_H

#include "expr/program.h"

/* What is known of the dimension of a part. */
struct kind {
    struct dim dim; /* of a free part: what it would be if bare numbers were pure numbers */
    bool free;      /* a bare number decides: any dimension will do */
    bool truth;     /* a condition */
    bool failed;    /* an error was reported already: any kind will do */
};

/* A part of the expression that has been read. */
struct operand {
    struct kind kind;
    enum { place_constant, place_variable, place_temporary } place;
    double value, rest;   /* of a constant, with what its rounding has left (base/double_double.h) */
    int index;            /* slot of a variable, number of a temporary */
    bool time, state, pi; /* depends on t, on other variables; contains the constant pi */
    struct pos at;        /* where to point when it does not fit */
    struct pos broken;    /* a constant part of it that is not finite; line and column 0 when all is well */
    bool is_broken;
    bool angle; /* a variable alone that is an angle */
};

struct builder {
    struct arena scratch; /* everything below, until the program is finished */
    struct instr *code;
    int *slots;
    struct double_double *constants;
    struct expr_switch *switches;
    size_t operations, slot_count, constant_count, switch_count;
    size_t code_room, slot_room, constant_room, switch_room;
    int depth, deepest; /* temporaries in use now, and at most */
    bool full;          /* there were more operations than are allowed */
};

struct operand build_constant(double value, struct kind kind, struct pos at);
struct operand build_variable(int slot, struct kind kind, struct pos at);

/* Append the operation `op` (with `extra`, for op_whole_power) on `x` and `y` (NULL for one operand); its
 * result, of the given kind, takes the place `base`, and temporaries from there on are free again. */
struct operand build_operation(struct builder *builder, int base, enum op op, int extra,
                               const struct operand *x, const struct operand *y, struct kind kind,
                               struct pos at);

/* The value of `table` at `x`. */
/* `x` itself, the argument of a function that changes within a range of about `unit`: with levels, at which steps end.
 * A step that goes from where the function is asleep to where it is asleep again would see nothing of what is between.
 * exp(-36) is less than a rounding; from level to level, 8 units, a bell is seen by the stages of a step and the error
 * control sees to the rest. A constant has none. */
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

/* True when the program outgrew its limits (registers, operations). */
bool build_is_too_long(const struct builder *builder);

/* The finished program in `arena`; NULL when memory is out. */
struct expr *build_finish(struct builder *builder, struct arena *arena, const struct operand *result);

void build_free(struct builder *builder);

#endif
