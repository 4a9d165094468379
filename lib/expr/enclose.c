/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Enclosures: a program evaluated over intervals of time (interval.h). Each value carries its range, the
 * range of its rate, by the chain rule of dual.c, and its value in the middle of the interval; the mean value
 * theorem then narrows the range at each operation.
 *
 * The result is rigorous for the formula that the branches choose, for all functions of time whose values and
 * rates lie in the enclosures of the variables.
 */
#include <math.h>

#include "expr/frame.h"
#include "expr/interval.h"

/* Derivatives of an operation over the ranges of its operands. */
struct steepness {
    struct interval a, b;
};

static const double half_pi = 1.57079632679489661923;

static const struct interval one = {1, 1}, none = {0, 0}, truth = {0, 1};

/* ---- values */

static struct interval truth_of(const struct instr *i, struct interval a, struct interval b)
{
    bool sure = a.low == a.high && b.low == b.high;
    return sure ? interval_point(op_value(i, a.low, b.low)) : truth;
}

/* The polynomial of a piece, and its slope. */
static struct interval value_of_piece(const struct table *table, double piece, struct interval a)
{
    struct table_polynomial p = table_polynomial(table, piece);
    struct interval u = interval_subtract(a, interval_point(p.from)), f = interval_point(p.c[3]);
    for (int k = 2; k >= 0; k--) f = interval_add(interval_point(p.c[k]), interval_multiply(u, f));
    return f;
}

static struct interval slope_of_piece(const struct table *table, double piece, struct interval a)
{
    struct table_polynomial p = table_polynomial(table, piece);
    struct interval u = interval_subtract(a, interval_point(p.from)), f = interval_point(3 * p.c[3]);
    for (int k = 2; k >= 1; k--) f = interval_add(interval_point(k * p.c[k]), interval_multiply(u, f));
    return f;
}

/* A branch beyond branch_limit uses plain values, which have no smooth formula. */
static struct interval value_of_switch(const struct instr *i, int n, struct interval a, struct interval b)
{
    if (n >= branch_limit || n <= -branch_limit) return interval_everything();
    switch (i->op) {
    case op_abs: return n < 0 ? interval_negate(a) : a;
    case op_min: return n < 0 ? a : b;
    case op_max: return n < 0 ? b : a;
    case op_mod: return n == 0 ? a : interval_subtract(a, interval_scale(n, b));
    case op_sawtooth: return interval_subtract(a, interval_point(n));
    case op_levels: return a;
    case op_table: return value_of_piece(i->table, n, a);
    default: return interval_point(switch_value(i, n, 0, 0));
    }
}

static struct interval value_of_function(const struct instr *i, struct interval a, struct interval b)
{
    const double all = HUGE_VAL;
    switch (i->op) {
    case op_whole_power: return interval_whole_power(a, i->extra);
    case op_power: return interval_power(a, b);
    case op_sqrt: return interval_rising(sqrt, a, 0, all);
    case op_cbrt: return interval_rising(cbrt, a, -all, all);
    case op_hypot: return interval_hypot(a, b);
    case op_exp: return interval_rising(exp, a, -all, all);
    case op_ln: return interval_rising(log, a, 0, all);
    case op_log10: return interval_rising(log10, a, 0, all);
    case op_sin: return interval_sin(a);
    case op_cos: return interval_cos(a);
    case op_tan: return interval_tan(a);
    case op_asin: return interval_rising(asin, a, -1, 1);
    case op_acos: return interval_subtract(interval_point(half_pi), interval_rising(asin, a, -1, 1));
    case op_atan: return interval_rising(atan, a, -all, all);
    case op_atan2: return interval_atan2(a, b);
    case op_sinh: return interval_rising(sinh, a, -all, all);
    case op_cosh: return interval_cosh(a);
    case op_tanh: return interval_rising(tanh, a, -all, all);
    default: return truth_of(i, a, b);
    }
}

static struct interval value_of(const struct instr *i, const int *branch, struct interval a,
                                struct interval b)
{
    switch (i->op) {
    case op_copy: return a;
    case op_negate: return interval_negate(a);
    case op_add: return interval_add(a, b);
    case op_subtract: return interval_subtract(a, b);
    case op_multiply: return interval_multiply(a, b);
    case op_divide: return interval_divide(a, b);
    default: break;
    }
    if (op_is_switch(i->op)) return value_of_switch(i, branch ? branch[i->extra] : branch_limit, a, b);
    return value_of_function(i, a, b);
}

/* ---- derivatives: the formulas of slopes.c */

static struct interval square_of(struct interval a)
{
    return interval_whole_power(a, 2);
}

/* c / r for r >= 0. */
static struct interval over(double c, struct interval r)
{
    if (r.low > 0) return interval_scale(c, interval_divide(one, r));
    struct interval least = interval_divide(one, interval_point(r.high));
    return c < 0 ? (struct interval){-HUGE_VAL, c * least.low} : (struct interval){c * least.low, HUGE_VAL};
}

static struct steepness of_switch(const struct instr *i, int n, struct interval a)
{
    if (n >= branch_limit || n <= -branch_limit)
        return (struct steepness){interval_everything(), interval_everything()};
    switch (i->op) {
    case op_abs: return (struct steepness){interval_point(n < 0 ? -1 : 1), none};
    case op_min: return n < 0 ? (struct steepness){one, none} : (struct steepness){none, one};
    case op_max: return n < 0 ? (struct steepness){none, one} : (struct steepness){one, none};
    case op_sawtooth:
    case op_levels: return (struct steepness){one, none};
    case op_mod: return (struct steepness){one, interval_point(-(double)n)};
    case op_table: return (struct steepness){slope_of_piece(i->table, n, a), none};
    default: return (struct steepness){none, none};
    }
}

/* x/h or y/h, bounded by 1 as cosine and sine of an angle. */
static struct interval share(struct interval part, struct interval h)
{
    const struct interval unit = {-1, 1};
    return h.low > 0 ? interval_meet(unit, interval_divide(part, h)) : unit;
}

static struct steepness of_two(const struct instr *i, struct interval a, struct interval b, struct interval f)
{
    struct interval h;
    switch (i->op) {
    case op_hypot: return (struct steepness){share(a, f), share(b, f)};
    case op_atan2:
        h = interval_hypot(a, b);
        return (struct steepness){interval_multiply(share(b, h), over(1, h)),
                                  interval_multiply(interval_negate(share(a, h)), over(1, h))};
    default: /* power */
        h = interval_power(a, b.low == b.high ? interval_point(b.low - 1) : interval_subtract(b, one));
        return (struct steepness){interval_multiply(b, h),
                                  interval_multiply(f, interval_rising(log, a, 0, HUGE_VAL))};
    }
}

static struct interval of_one(const struct instr *i, struct interval a, struct interval f)
{
    const double lg_e = 0.43429448190325182765; /* 1/ln 10 */
    struct interval rest;
    switch (i->op) {
    case op_whole_power:
        return i->extra == 0 ? none : interval_scale(i->extra, interval_whole_power(a, i->extra - 1));
    case op_sqrt: return over(0.5, f);
    case op_cbrt: return over(1.0 / 3, square_of(f));
    case op_exp: return f;
    case op_ln: return over(1, interval_meet(a, (struct interval){0, HUGE_VAL}));
    case op_log10: return over(lg_e, interval_meet(a, (struct interval){0, HUGE_VAL}));
    case op_sin: return interval_cos(a);
    case op_cos: return interval_negate(interval_sin(a));
    case op_tan: return interval_add(one, square_of(f));
    case op_asin:
    case op_acos:
        rest = interval_meet(interval_subtract(one, square_of(a)), truth);
        rest = interval_rising(sqrt, rest, 0, 1);
        return over(i->op == op_asin ? 1 : -1, rest);
    case op_atan: return over(1, interval_add(one, square_of(a)));
    case op_sinh: return interval_cosh(a);
    case op_cosh: return interval_rising(sinh, a, -HUGE_VAL, HUGE_VAL);
    case op_tanh: return interval_meet(interval_subtract(one, square_of(f)), truth);
    default: return none; /* truth values */
    }
}

static struct interval rate_of(const struct instr *i, const int *branch, const struct enclosure *a,
                               const struct enclosure *b, struct interval f)
{
    struct steepness s = {none, none};
    switch (i->op) {
    case op_copy: return a->rate;
    case op_negate: return interval_negate(a->rate);
    case op_add: return interval_add(a->rate, b->rate);
    case op_subtract: return interval_subtract(a->rate, b->rate);
    case op_multiply:
        return interval_add(interval_multiply(a->rate, b->value), interval_multiply(a->value, b->rate));
    case op_divide:
        return interval_divide(interval_subtract(a->rate, interval_multiply(f, b->rate)), b->value);
    case op_power:
    case op_hypot:
    case op_atan2: s = of_two(i, a->value, b->value, f); break;
    default:
        if (op_is_switch(i->op))
            s = of_switch(i, branch ? branch[i->extra] : branch_limit, a->value);
        else if (a->rate.low == 0 && a->rate.high == 0)
            return none;
        else
            s.a = of_one(i, a->value, f);
    }
    return interval_add(interval_multiply(s.a, a->rate), interval_multiply(s.b, b->rate));
}

/* ---- running */

struct enclosing {
    struct enclosure *frame; /* frame_limit */
    double radius;
    const int *branch;
    struct enclosure *margins; /* or NULL */
};

static void load(const struct expr *expr, const struct stretch *stretch, const struct enclosure *y,
                 struct enclosing *e)
{
    size_t n = 0;
    if (expr->uses_time)
        e->frame[n++] =
            (struct enclosure){{stretch->from, stretch->to}, one, interval_point(stretch->middle)};
    for (size_t i = 0; i < expr->variables; i++)
        e->frame[n++] = y ? y[expr->slots[i] - 1] : enclosure_everything();
    for (size_t i = 0; i < expr->constants; i++) e->frame[n++] = enclosure_point(expr->constant[i]);
    e->radius = stretch_radius(stretch);
}

/* The switching function of a switch: see kinks.c. */
static struct enclosure watched(const struct instr *i, const struct enclosing *e)
{
    const struct enclosure *a = &e->frame[i->a], *b = &e->frame[i->b];
    struct enclosure u = *a;
    if (op_is_by_difference(i->op)) u = enclosure_subtract(*a, *b);
    if (op_is_by_difference(i->op)) enclosure_centre(&u, e->radius);
    if (i->op == op_square) u = enclosure_scale(2, *a);
    if (i->op == op_relay) u = enclosure_add(*a, enclosure_point(e->branch[i->extra] > 0 ? 1 : -1));
    if (!op_is_by_quotient(i->op)) return u;
    u.value = interval_divide(a->value, b->value);
    u.rate = interval_divide(interval_subtract(a->rate, interval_multiply(u.value, b->rate)), b->value);
    u.middle = interval_divide(a->middle, b->middle);
    enclosure_centre(&u, e->radius);
    return u;
}

/* The branch zero of sign and == includes the rounding error of u on both sides. */
static struct enclosure with_tolerance(struct enclosure u)
{
    double tolerance = 16 * interval_width(u.middle) + DBL_MIN;
    u.value.high += tolerance;
    u.middle.high += tolerance;
    return u;
}

static struct enclosure knot_of(struct double_double knot)
{
    struct interval range = interval_widen(knot.x, knot.x, 1);
    return (struct enclosure){range, none, range};
}

/* Enclose the margins of note_margins in kinks.c. */
static void enclose_margins(const struct instr *i, struct enclosing *e)
{
    int n = e->branch[i->extra];
    struct enclosure u = watched(i, e), *lower = &e->margins[(ptrdiff_t)2 * i->extra], *upper = lower + 1;
    if (i->op == op_table) {
        struct double_double from, to;
        if (n >= branch_limit || n <= -branch_limit) return;
        table_ends(i->table, n, &from, &to);
        if (isfinite(from.x)) *lower = enclosure_subtract(u, knot_of(from));
        if (isfinite(to.x)) *upper = enclosure_subtract(knot_of(to), u);
    } else if (!op_is_by_sign(i->op)) {
        if (n >= branch_limit || n <= -branch_limit) return;
        double low = n + switch_offset(i->op);
        if (switch_has_end(i->op, n, 0)) *lower = enclosure_subtract(u, enclosure_point(low));
        if (switch_has_end(i->op, n, 1)) *upper = enclosure_subtract(enclosure_point(low + 1), u);
    } else if (n == 0 && (i->op == op_sign || i->op == op_equal)) {
        *lower = with_tolerance(u);
        *upper = with_tolerance(enclosure_negate(u));
    } else if (n < 0 || (n == 0 && i->op == op_relay)) {
        *upper = enclosure_negate(u);
    } else {
        *lower = u;
    }
}

static void enclose(const struct instr *i, struct enclosing *e)
{
    const struct enclosure *a = &e->frame[i->a], *b = &e->frame[i->b];
    struct enclosure f = {.value = value_of(i, e->branch, a->value, b->value),
                          .middle = value_of(i, e->branch, a->middle, b->middle)};
    f.rate = rate_of(i, e->branch, a, b, f.value);
    enclosure_centre(&f, e->radius);
    e->frame[i->to] = f;
}

/* Run the program. False if the side of an `if` is undecided. */
static bool run(const struct expr *expr, struct enclosing *e)
{
    const struct instr *end = expr->code + expr->operations;
    for (const struct instr *i = expr->code; i < end; i++) {
        if (i->op == op_jump) {
            i += i->extra;
        } else if (i->op == op_jump_unless) {
            struct interval condition = e->frame[i->a].value;
            if (condition.low != condition.high) return false;
            i += condition.low == 0 ? i->extra : 0;
        } else {
            if (e->margins && op_is_switch(i->op)) enclose_margins(i, e);
            enclose(i, e);
        }
    }
    return true;
}

struct enclosure expr_enclose(const struct expr *expr, const struct stretch *stretch,
                              const struct enclosure *y, const int *branch)
{
    struct enclosure frame[frame_limit];
    struct enclosing e = {.frame = frame, .branch = branch};
    load(expr, stretch, y, &e);
    return run(expr, &e) ? e.frame[expr->result] : enclosure_everything();
}

void expr_enclose_margins(const struct expr *expr, const struct stretch *stretch, const struct enclosure *y,
                          const int *branch, struct enclosure *margins)
{
    const struct enclosure absent = {{HUGE_VAL, HUGE_VAL}, {0, 0}, {HUGE_VAL, HUGE_VAL}};
    if (!expr->switches) return;
    struct enclosure frame[frame_limit];
    struct enclosing e = {.frame = frame, .branch = branch, .margins = margins};
    for (size_t k = 0; k < 2 * expr->switches; k++) margins[k] = absent;
    load(expr, stretch, y, &e);
    if (run(expr, &e)) return;
    for (size_t k = 0; k < 2 * expr->switches; k++) margins[k] = enclosure_everything();
}
