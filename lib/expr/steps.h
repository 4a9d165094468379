/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Steps: the form in which a program without jumps is run for plain values.
 *
 * The frame of program.h supports every kind of number, but for doubles most of its cost is moving them. Here
 * an accumulator contains the latest result, operands are read in place (the constants of the program, the
 * caller's state, t, or a kept result), and common pairs of operations are one step: a product of two leaves,
 * the sine of a product, adding a product. The operations and their order are those of the program, so the
 * results are bitwise the same.
 */
#ifndef FBD_EXPR_STEPS_H
#define FBD_EXPR_STEPS_H

#include "expr/program.h"

enum { most_kept = 16 }; /* results kept at one time; a program with more runs on the frame */

/* In the comments x is the accumulator, a and b are the operands of the step. */
enum step_op {
    step_load, /* a */
    step_keep, /* x stays, and is kept as a */
    step_negate,
    step_add,           /* x + a */
    step_subtract,      /* x - a */
    step_subtract_from, /* a - x */
    step_multiply,      /* x a */
    step_divide,        /* x / a */
    step_divide_into,   /* a / x */
    step_square,        /* x^2 */
    step_cube,          /* x^3 */
    step_sqrt,
    step_sin,
    step_cos,
    step_exp,
    step_sum,              /* a + b */
    step_difference,       /* a - b */
    step_product,          /* a b */
    step_quotient,         /* a / b */
    step_sin_product,      /* sin(a b) */
    step_cos_product,      /* cos(a b) */
    step_add_product,      /* x + a b */
    step_subtract_product, /* x - a b */
    step_any,              /* any operation on x and a */
    step_any_from          /* any operation on a and x */
};

enum step_place { at_constant, at_time, at_state, at_kept };

struct step_operand {
    enum step_place place;
    int index;       /* into the slots of the expression, or the kept results */
    double constant; /* of at_constant */
};

struct step {
    enum step_op op;
    struct step_operand a, b;
    const struct instr *instr; /* of step_any and step_any_from */
};

/* Set the steps of a finished program, in `arena`. A program that is a constant, has jumps or keeps too many
 * results gets none and runs on the frame. False when memory is out. */
bool steps_make(struct expr *expr, struct arena *scratch, struct arena *arena);

double steps_run(const struct expr *expr, double t, const double *y, const int *branch);

#endif
