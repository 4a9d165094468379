/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdint.h>

#include "expr/program.h"

double whole_power(double x, int n)
{
    unsigned left = n < 0 ? 0u - (unsigned)n : (unsigned)n;
    double product = 1, square = x;
    for (; left; left >>= 1) {
        if (left & 1u) product *= square;
        if (left > 1) square *= square;
    }
    return n < 0 ? 1 / product : product;
}

/* NaN in any operand is propagated; a plain comparison would lose it. */
static double lesser(double x, double y)
{
    return x < y ? x : x >= y ? y : x + y;
}

static double greater(double x, double y)
{
    return x > y ? x : x <= y ? y : x + y;
}

static double sign(double x)
{
    return x > 0 ? 1 : x < 0 ? -1 : x;
}

static double step(double x)
{
    return x >= 0 ? 1 : x < 0 ? 0 : x;
}

/* fmod(x, y), exact. The C library's takes a step for each bit of the quotient, microseconds for mod(x,
 * 1e-300); here a step reduces eleven bits, with integers of 53 bits. */
static double remainder_of(double x, double y)
{
    enum { digits = 53, spare = 11 };
    int of_x, of_y;
    if (!(fabs(x) >= ldexp(fabs(y), spare)) || !isfinite(x) || y == 0) return fmod(x, y);
    uint64_t rest = (uint64_t)ldexp(frexp(fabs(x), &of_x), digits);
    const uint64_t by = (uint64_t)ldexp(frexp(fabs(y), &of_y), digits);
    rest %= by;
    for (int left = of_x - of_y; left > 0 && rest > 0; left -= spare)
        rest = (rest << (left < spare ? left : spare)) % by;
    return copysign(ldexp((double)rest, of_y - digits), x);
}

/* The remainder with the sign of y. It is exact; only the change to the sign of y may round (then up to y
 * itself). */
static double modulo(double x, double y)
{
    double rest = remainder_of(x, y);
    return rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest;
}

static double square_wave(double x)
{
    double half_periods = floor(2 * x);
    return isnan(half_periods) ? half_periods : fmod(half_periods, 2) == 0 ? 1 : -1;
}

static double plain_switch(const struct instr *instr, double x, double y)
{
    switch (instr->op) {
    case op_sign: return sign(x);
    case op_abs: return fabs(x);
    case op_step: return step(x);
    case op_relay: return x >= 1 ? 1 : -1;
    case op_min: return lesser(x, y);
    case op_max: return greater(x, y);
    case op_less: return x < y;
    case op_less_equal: return x <= y;
    case op_greater: return x > y;
    case op_greater_equal: return x >= y;
    case op_equal: return x == y;
    case op_floor: return floor(x);
    case op_ceil: return ceil(x);
    case op_round: return round(x);
    case op_mod: return modulo(x, y);
    case op_sawtooth: return x - floor(x);
    case op_square: return square_wave(x);
    case op_table: return table_value(instr->table, table_piece(instr->table, x), x);
    case op_levels: return x;
    default: return NAN;
    }
}

double op_value(const struct instr *instr, double x, double y)
{
    switch (instr->op) {
    case op_copy: return x;
    case op_negate: return -x;
    case op_add: return x + y;
    case op_subtract: return x - y;
    case op_multiply: return x * y;
    case op_divide: return x / y;
    case op_whole_power: return whole_power(x, instr->extra);
    case op_power: return pow(x, y);
    case op_sqrt: return sqrt(x);
    case op_cbrt: return cbrt(x);
    case op_hypot: return hypot(x, y);
    case op_exp: return exp(x);
    case op_ln: return log(x);
    case op_log10: return log10(x);
    case op_sin: return sin(x);
    case op_cos: return cos(x);
    case op_tan: return tan(x);
    case op_asin: return asin(x);
    case op_acos: return acos(x);
    case op_atan: return atan(x);
    case op_atan2: return atan2(x, y);
    case op_sinh: return sinh(x);
    case op_cosh: return cosh(x);
    case op_tanh: return tanh(x);
    case op_and: return x != 0 && y != 0;
    case op_or: return x != 0 || y != 0;
    case op_not: return x == 0;
    default: return plain_switch(instr, x, y);
    }
}

/* ---- switches */

double op_plain_branch(const struct instr *instr, double x, double y)
{
    switch (instr->op) {
    case op_sign: return sign(x);
    case op_abs:
    case op_step: return x >= 0 ? 1 : -1;
    case op_relay: return x >= 1 ? 1 : -1;
    case op_min:
    case op_less: return x < y ? -1 : 1;
    case op_max:
    case op_less_equal: return x <= y ? -1 : 1;
    case op_greater: return x > y ? 1 : -1;
    case op_greater_equal: return x >= y ? 1 : -1;
    case op_equal: return x < y ? -1 : x > y ? 1 : 0;
    case op_floor:
    case op_sawtooth: return floor(x);
    case op_ceil: return ceil(x);
    case op_round: return round(x);
    case op_mod: return floor(x / y);
    case op_square: return floor(2 * x);
    case op_table: return table_piece(instr->table, x);
    case op_levels: return levels_clamp(round(x / y));
    default: return 0;
    }
}

double switch_branch(const struct instr *instr, double x, double y, const int *branch)
{
    int n = branch ? branch[instr->extra] : branch_limit;
    if (n < branch_limit && n > -branch_limit) return n;
    return op_plain_branch(instr, x, y);
}

double switch_value(const struct instr *instr, double n, double x, double y)
{
    switch (instr->op) {
    case op_abs: return n < 0 ? -x : x;
    case op_step: return n < 0 ? 0 : 1;
    case op_relay: return n > 0 ? 1 : -1;
    case op_min: return n < 0 ? x : y;
    case op_max: return n < 0 ? y : x;
    case op_less:
    case op_less_equal: return n < 0;
    case op_greater:
    case op_greater_equal: return n > 0;
    case op_equal: return n == 0;
    case op_mod: return n == 0 ? x : x - n * y; /* y may be infinite */
    case op_sawtooth: return x - n;
    case op_square: return fmod(n, 2) == 0 ? 1 : -1;
    case op_table: return table_value(instr->table, n, x);
    case op_levels: return x;
    default: return n; /* sign, floor, ceil, round */
    }
}
