/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The compiled form of an expression.
 *
 * A program works on one frame of registers:
 *
 *   variables (t first when it is used, then slots ascending) | constants | temporaries
 *
 * Evaluation fills the first two parts and executes the instructions, each of which reads two registers and
 * writes one temporary. Leaves cost no instruction, and the frame may contain any kind of number: doubles,
 * dual numbers, hyper-dual numbers, or values with rates and rounding bounds.
 */
#ifndef FBD_EXPR_PROGRAM_H
#define FBD_EXPR_PROGRAM_H

#include "expr/expr.h"
#include "expr/table.h"

enum {
    frame_limit = 1024,        /* registers: 32 KB of stack for hyper-dual numbers */
    operation_limit = 4096,    /* instructions */
    branch_limit = 2147483647, /* a branch at +-this is not counted: see switch_branch */
    most_levels = 5            /* the branches of op_levels are -5 to 5 */
};

enum op {
    op_copy,
    op_negate,
    op_add,
    op_subtract,
    op_multiply,
    op_divide,
    op_whole_power, /* a^extra */
    op_power,
    op_sqrt,
    op_cbrt,
    op_hypot,
    op_exp,
    op_ln,
    op_log10,
    op_sin,
    op_cos,
    op_tan,
    op_asin,
    op_acos,
    op_atan,
    op_atan2,
    op_sinh,
    op_cosh,
    op_tanh,
    op_and, /* truth values are 0 and 1 */
    op_or,
    op_not,

    /* Switches with the branches -1, 0, 1 by the sign of a, or of a - b; `extra` is the index of the switch.
     */
    op_sign,
    op_abs,
    op_step,
    op_relay, /* 1 from a = 1 upwards until a falls below -1, then -1: its branch is its memory */
    op_min,
    op_max,
    op_less,
    op_less_equal,
    op_greater,
    op_greater_equal,
    op_equal,

    /* Switches with one branch for each unit interval of a, a/b or 2a. */
    op_floor,
    op_ceil,
    op_round,
    op_mod,
    op_sawtooth,
    op_square,

    /* A switch with one branch for each piece of a table (table.h). */
    op_table,

    /* The value a, with one branch for each interval of a of the length b, the middle one around 0, the
     * outermost ones unbounded: argument of a function that varies within a few of them only (build_levels).
     */
    op_levels,

    /* Control: skip `extra` instructions. */
    op_jump,
    op_jump_unless, /* when a is 0 */
};

struct instr {
    unsigned char op;
    unsigned short to, a, b; /* registers; b is a for one operand */
    int extra;
    const struct table *table; /* of op_table */
};

struct expr_switch {
    enum op op;
    bool time;                 /* depends on t alone */
    const struct table *table; /* of op_table */
};

struct step;
struct expr_part;

struct expr {
    const struct instr *code;
    size_t operations;
    const struct expr_part *parts; /* for plain values: a sum of simple parts (parts.h) */
    int part_count;
    const struct step *steps; /* else steps (steps.h); NULL: run on the frame */
    size_t step_count;
    bool uses_time;
    size_t variables; /* without t */
    const int *slots; /* of the variables, ascending */
    size_t constants;
    const double *constant;
    const double *constant_rest; /* their low parts (base/double_double.h); NULL without instructions */
    double single;               /* storage of `constant` when the program is one number */
    size_t result;               /* its register */
    size_t switches;
    size_t last_switch; /* the index of the last instruction that is a switch; 0 without switches */
    const struct expr_switch *switch_at;

    struct dim dim;
    bool bare;
    bool angle, bare_angle; /* a single angle; a bare number beyond one turn (check_is_bare_angle) */
};

/* ---- the formulas of the operations, in ops.c and slopes.c */

static inline bool op_is_switch(unsigned op)
{
    return op >= op_sign && op <= op_levels;
}

/* True if the switching function is a/b. */
static inline bool op_is_by_quotient(unsigned op)
{
    return op == op_mod || op == op_levels;
}

static inline bool op_is_by_sign(unsigned op)
{
    return op >= op_sign && op <= op_equal;
}

/* True if the switching function is a - b. */
static inline bool op_is_by_difference(unsigned op)
{
    return op >= op_min && op <= op_equal;
}

/* x^n by multiplication: exact for small whole numbers, and x^0 is 1 everywhere. */
double whole_power(double x, int n);

/* The lower end of branch 0 of a rounding. */
static inline double switch_offset(unsigned op)
{
    return op == op_ceil ? -1 : op == op_round || op == op_levels ? -0.5 : 0;
}

/* Limit a branch to the outermost levels. */
static inline double levels_clamp(double n)
{
    return n > most_levels ? most_levels : n < -most_levels ? -most_levels : n;
}

/* True if a branch of a rounding has an end below (0) or above (1). */
static inline bool switch_has_end(unsigned op, int n, int end)
{
    return op != op_levels || (end ? n < most_levels : n > -most_levels);
}

/* The value of an operation other than control, at plain values (no branches). */
double op_value(const struct instr *instr, double x, double y);

/* The branch of a switch at plain values, as a double because that of a floor may be beyond the range of an
 * int. */
double op_plain_branch(const struct instr *instr, double x, double y);

/* The branch of a switch: the given one, or the plain one when there is none, or when it is beyond
 * branch_limit (then the steps are below the resolution of the numbers). */
double switch_branch(const struct instr *instr, double x, double y, const int *branch);

/* The smooth formula of branch `n` of a switch. */
double switch_value(const struct instr *instr, double n, double x, double y);

/* Value and partial derivatives with respect to the operands. */
struct slopes {
    double f, a, b, aa, ab, bb;
};

/* Slopes of an operation other than control. Where a derivative does not exist but a finite value is harmless
 * (hypot at the origin), it is 0; infinite ones (sqrt at 0) are infinite. */
void op_slopes(const struct instr *instr, double x, double y, const int *branch, struct slopes *slopes);

/* slope * rate, where an exact zero takes precedence over infinity and NaN: sqrt(x) of a constant x = 0 does
 * not change, and a factor 0 cancels an infinite rate, as in x*sqrt(x) at 0. */
static inline double along(double slope, double rate)
{
    return slope == 0 || rate == 0 ? 0 : slope * rate;
}

#endif
