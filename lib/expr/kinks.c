/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Switches: where a formula changes, its branch after the change, and the margins to it.
 *
 * Each switch has a smooth switching function u of the state: a for sign, abs, step and the roundings, a - b
 * for min, max and comparisons, a/b for mod and levels, 2a for square. A switch by sign has the branches u <
 * 0, u > 0 and, for sign and ==, u = 0. A rounding has the branches n with n + offset < u < n + offset + 1.
 * For a relay u is the distance to the threshold at which it leaves its branch, a - 1 or a + 1; between the
 * thresholds its branch stays.
 *
 * Late in a run a time has few digits behind the point, and u of a switch by time loses them: t - start,
 * t/period - n, the phase of a sine. So values are double-double numbers: the time has a low part, sums,
 * products and quotients keep their rounding error as low part, and other functions transfer it by their
 * slope,
 *
 *   f(x + rest) = f(x) + f'(x) rest,  which is exact to rest^2 = eps^2 x^2.
 *
 * Whether u is zero cannot be decided from rounded values alone. Each value therefore carries its rate along
 * the motion and a bound of its rounding error, by the first-order propagation
 *
 *   e(f) = |f_a| e(a) + |f_b| e(b) + own |f|,  e(t) = eps^2 t,  e(y) = eps y,  e(c) = eps^2 c
 *
 * (N. Higham, Accuracy and Stability of Numerical Algorithms, ch. 3); own is eps^2 for operations that keep
 * their low part, else eps. Where |u| is within a few such bounds, the rate decides.
 */
#include <float.h>
#include <math.h>

#include "expr/frame.h"

/* High and low part of values, rate, and bound of the rounding error. */
struct motion {
    double value[frame_limit], rest[frame_limit], rate[frame_limit], error[frame_limit];
};

static const double dd_rounding = DBL_EPSILON * DBL_EPSILON;

/* The switching function of a switch at one point of the motion. */
struct crossing {
    struct double_double exact;
    double u, rate, tolerance;
};

/* Called at each active switch in order, before it is evaluated. */
typedef void visit(void *context, const struct instr *i, const struct motion *at, struct crossing crossing);

/* Load the leaves; `rounding` is the relative error of the time and of constants. */
static void load(const struct expr *expr, struct time_dd t, const double *y, double dt, const double *dy,
                 double rounding, struct motion *m)
{
    size_t n = 0;
    frame_values(expr, t.t, y, m->value);
    frame_rates(expr, dt, dy, m->rate);
    if (expr->uses_time) {
        m->rest[n] = t.rest;
        m->error[n++] = rounding * fabs(t.t);
    }
    for (size_t k = 0; k < expr->variables; k++, n++) {
        m->rest[n] = 0;
        m->error[n] = DBL_EPSILON * fabs(m->value[n]);
    }
    for (size_t k = 0; k < expr->constants; k++, n++) {
        m->rest[n] = expr->constant_rest[k];
        m->error[n] = rounding * fabs(m->value[n]);
    }
}

static struct double_double number_of(const struct motion *m, size_t reg)
{
    return (struct double_double){m->value[reg], m->rest[reg]};
}

static struct crossing crossing_at(const struct instr *i, const int *branch, const struct motion *m)
{
    struct double_double a = number_of(m, i->a), b = number_of(m, i->b), u = a;
    double rate = m->rate[i->a], error = m->error[i->a];
    if (op_is_by_difference(i->op)) {
        u = dd_subtract(a, b);
        rate -= m->rate[i->b];
        error += m->error[i->b] + dd_rounding * (fabs(a.x) + fabs(b.x));
    } else if (i->op == op_relay) {
        u = dd_add(a, (struct double_double){branch && branch[i->extra] > 0 ? 1 : -1, 0});
        error += dd_rounding * fabs(a.x);
    } else if (op_is_by_quotient(i->op)) {
        u = dd_divide(a, b);
        rate = (rate - u.x * m->rate[i->b]) / b.x;
        error = (error + fabs(u.x) * m->error[i->b]) / fabs(b.x) + dd_rounding * fabs(u.x);
    } else if (i->op == op_square) {
        u = (struct double_double){2 * a.x, 2 * a.rest};
        rate *= 2;
        error *= 2;
    }
    /* The bounds are of first order, hence the factor; never zero, so that u = 0 lies inside. */
    return (struct crossing){u, dd_value(u), rate, 4 * error + DBL_MIN};
}

/* The double-double result of an instruction with the rounded value f; false for operations without a low
 * part. */
static bool keep_rest(const struct instr *i, const struct motion *m, const int *branch, double f,
                      struct double_double *result)
{
    struct double_double a = number_of(m, i->a), b = number_of(m, i->b);
    double n;
    switch (i->op) {
    case op_add: *result = dd_add(a, b); break;
    case op_subtract: *result = dd_subtract(a, b); break;
    case op_multiply: *result = dd_multiply(a, b); break;
    case op_divide: *result = dd_divide(a, b); break;
    case op_mod:
    case op_sawtooth:
        n = switch_branch(i, a.x, b.x, branch);
        if (n == 0) return false;
        b = i->op == op_sawtooth ? (struct double_double){1, 0} : b;
        *result = dd_subtract(a, dd_multiply((struct double_double){n, 0}, b));
        break;
    default: return false;
    }
    return isfinite(f) && isfinite(result->x + result->rest);
}

/* True for operations whose result is an operand or a whole number, without rounding. */
static bool is_without_rounding(unsigned op)
{
    return op == op_copy || op == op_negate || (op >= op_and && op <= op_not) ||
           (op_is_switch(op) && op != op_table);
}

static void step_motion(const struct instr *i, const int *branch, struct motion *m)
{
    struct slopes s;
    op_slopes(i, m->value[i->a], m->value[i->b], branch, &s);
    double rate = along(s.a, m->rate[i->a]) + along(s.b, m->rate[i->b]);
    double rest = along(s.a, m->rest[i->a]) + along(s.b, m->rest[i->b]);
    double error = along(fabs(s.a), m->error[i->a]) + along(fabs(s.b), m->error[i->b]);
    struct double_double kept;
    bool keeps = keep_rest(i, m, branch, s.f, &kept);
    double own = (keeps || is_without_rounding(i->op) ? dd_rounding : DBL_EPSILON) * fabs(s.f);
    if (i->op == op_table)
        own = table_rounding(i->table, switch_branch(i, m->value[i->a], 0, branch), m->value[i->a]);
    if (keeps && (i->op == op_add || i->op == op_subtract || i->op == op_mod))
        own += dd_rounding * fabs(m->value[i->a]);
    m->value[i->to] = keeps ? kept.x : s.f;
    m->rest[i->to] = keeps ? kept.rest : isfinite(rest) ? rest : 0;
    m->rate[i->to] = rate;
    /* At an infinite slope (sqrt at 0) the first-order bound is infinite, and is dropped. */
    m->error[i->to] = isfinite(error) ? error + own : own;
}

/* Up to the last switch: no later operation is of effect on one. */
static void run(const struct expr *expr, const int *branch, struct motion *m, visit *visit_switch,
                void *context)
{
    const struct instr *last = expr->code + expr->last_switch;
    for (const struct instr *i = expr->code; i <= last; i++) {
        if (i->op == op_jump) {
            i += i->extra;
        } else if (i->op == op_jump_unless) {
            i += m->value[i->a] == 0 ? i->extra : 0;
        } else {
            if (op_is_switch(i->op)) visit_switch(context, i, m, crossing_at(i, branch, m));
            if (i < last) step_motion(i, branch, m);
        }
    }
}

/* ---- margins */

struct margins {
    const int *branch;
    double *margins, *rates, *roundings;
};

static void set_margin(struct margins *m, int index, double margin, struct crossing c, double sign)
{
    m->margins[index] = margin;
    if (m->rates) m->rates[index] = sign * c.rate;
    if (m->roundings) m->roundings[index] = c.tolerance;
}

static void note_margins(void *context, const struct instr *i, const struct motion *at, struct crossing c)
{
    (void)at;
    struct margins *m = context;
    int n = m->branch[i->extra], lower = 2 * i->extra, upper = lower + 1;
    if (i->op == op_table) {
        struct double_double from, to;
        if (n >= branch_limit || n <= -branch_limit) return;
        table_ends(i->table, n, &from, &to);
        if (isfinite(from.x)) set_margin(m, lower, dd_value(dd_subtract(c.exact, from)), c, 1);
        if (isfinite(to.x)) set_margin(m, upper, dd_value(dd_subtract(to, c.exact)), c, -1);
    } else if (!op_is_by_sign(i->op)) {
        if (n >= branch_limit || n <= -branch_limit) return;
        double low = n + switch_offset(i->op);
        if (switch_has_end(i->op, n, 0)) set_margin(m, lower, (c.exact.x - low) + c.exact.rest, c, 1);
        if (switch_has_end(i->op, n, 1)) set_margin(m, upper, (low + 1 - c.exact.x) - c.exact.rest, c, -1);
    } else if (n == 0 && (i->op == op_sign || i->op == op_equal)) {
        set_margin(m, lower, c.tolerance + c.u, c, 1);
        set_margin(m, upper, c.tolerance - c.u, c, -1);
    } else if (n < 0 || (n == 0 && i->op == op_relay)) {
        set_margin(m, upper, -c.u, c, -1);
    } else {
        set_margin(m, lower, c.u, c, 1);
    }
}

void expr_margins(const struct expr *expr, struct time_dd t, const double *y, double dt, const double *dy,
                  const int *branch, double *margins, double *rates, double *roundings)
{
    if (!expr->switches) return;
    struct motion motion;
    struct margins context = {.branch = branch, .margins = margins, .rates = rates, .roundings = roundings};
    for (size_t k = 0; k < 2 * expr->switches; k++) {
        margins[k] = HUGE_VAL;
        if (rates) rates[k] = 0;
        if (roundings) roundings[k] = 0;
    }
    load(expr, t, y, dt, dy, dd_rounding, &motion);
    run(expr, branch, &motion, note_margins, &context);
}

/* ---- switching functions */

struct switchings {
    double *u, *rates, *rounding;
};

static void note_switching(void *context, const struct instr *i, const struct motion *at, struct crossing c)
{
    (void)at;
    struct switchings *s = context;
    s->u[i->extra] = c.u;
    s->rates[i->extra] = c.rate;
    s->rounding[i->extra] = c.tolerance;
}

void expr_switchings(const struct expr *expr, double t, const double *y, double dt, const double *dy,
                     const int *branch, double *u, double *rates, double *rounding)
{
    if (!expr->switches) return;
    struct motion motion;
    struct switchings context = {u, rates, rounding};
    for (size_t k = 0; k < expr->switches; k++) u[k] = rates[k] = rounding[k] = (double)NAN;
    load(expr, time_dd_at(t), y, dt, dy, DBL_EPSILON, &motion);
    run(expr, branch, &motion, note_switching, &context);
}

bool expr_switch_jumps(const struct expr *expr, size_t index)
{
    switch (expr->switch_at[index].op) {
    case op_sign:
    case op_step:
    case op_less:
    case op_less_equal:
    case op_greater:
    case op_greater_equal: return true;
    default: return false;
    }
}

/* ---- branches */

static int counted(double n)
{
    if (isnan(n)) return 0;
    return n >= branch_limit ? branch_limit : n <= -branch_limit ? -branch_limit : (int)n;
}

static int plain_branch(const struct instr *i, const struct motion *at)
{
    return counted(op_plain_branch(i, at->value[i->a], at->value[i->b]));
}

static int branch_by_sign(const struct instr *i, int before, bool stays, const struct motion *at,
                          struct crossing c)
{
    if (!isfinite(c.u)) return plain_branch(i, at);
    if (fabs(c.u) <= c.tolerance) {
        if (c.rate > 0) return 1;
        if (c.rate < 0) return -1;
        if (i->op == op_sign || i->op == op_equal) return 0;
        if (i->op == op_relay) return before > 0 ? 1 : -1;
        if (stays && before != 0) return before;
    }
    if (i->op == op_relay) return c.u > 0 || (c.u == 0 && before > 0) ? 1 : -1;
    return counted(op_plain_branch(i, c.u, 0));
}

static int branch_by_rounding(const struct instr *i, const struct motion *at, struct crossing c)
{
    if (!(isfinite(c.u) && c.tolerance < 0.5)) return plain_branch(i, at);
    double above = c.exact.x - switch_offset(i->op), nearest = round(above);
    double beyond = (above - nearest) + c.exact.rest;
    if (fabs(beyond) <= c.tolerance) {
        if (c.rate > 0) return counted(nearest);
        if (c.rate < 0) return counted(nearest - 1);
        return plain_branch(i, at);
    }
    return counted(beyond < 0 ? nearest - 1 : nearest);
}

static int branch_by_piece(const struct instr *i, const struct motion *at, struct crossing c)
{
    struct double_double from, to;
    double piece = table_piece(i->table, at->value[i->a]);
    if (!isfinite(c.u)) return counted(piece);
    table_ends(i->table, piece, &from, &to);
    double below = dd_value(dd_subtract(c.exact, from)), above = dd_value(dd_subtract(to, c.exact));
    if (fabs(below) <= c.tolerance && c.rate != 0) return counted(c.rate > 0 ? piece : piece - 1);
    if (fabs(above) <= c.tolerance && c.rate != 0) return counted(c.rate > 0 ? piece + 1 : piece);
    return counted(piece);
}

struct resolution {
    const bool *keep;
    bool stays;
    const int *before;
    int *branch;
};

static void choose_branch(void *context, const struct instr *i, const struct motion *at, struct crossing c)
{
    struct resolution *r = context;
    if (r->keep && r->keep[i->extra]) return;
    int *branch = &r->branch[i->extra];
    *branch = i->op == op_table      ? branch_by_piece(i, at, c)
              : op_is_by_sign(i->op) ? branch_by_sign(i, r->before[i->extra], r->stays, at, c)
                                     : branch_by_rounding(i, at, c);
    if (i->op == op_levels) *branch = (int)levels_clamp(*branch);
}

static bool keeps_all(const struct expr *expr, const bool *keep)
{
    for (size_t k = 0; k < expr->switches; k++)
        if (!keep || !keep[k]) return false;
    return true;
}

static void resolve(const struct expr *expr, struct time_dd t, const double *y, double dt, const double *dy,
                    const bool *keep, bool stays, int *branch)
{
    if (keeps_all(expr, keep)) return;
    struct motion motion;
    int before[frame_limit];
    struct resolution context = {keep, stays, before, branch};
    memcpy(before, branch, expr->switches * sizeof *before);
    for (size_t k = 0; k < expr->switches; k++)
        if ((!keep || !keep[k]) && expr->switch_at[k].op != op_relay) branch[k] = 0;
    /* Without an event the time is any double, such as that nearest to 0.7, and 3*t - 2.1 is zero to
     * rounding. */
    load(expr, t, y, dt, dy, keep ? dd_rounding : DBL_EPSILON, &motion);
    run(expr, branch, &motion, choose_branch, &context);
}

void expr_resolve(const struct expr *expr, struct time_dd t, const double *y, double dt, const double *dy,
                  const bool *keep, int *branch)
{
    resolve(expr, t, y, dt, dy, keep, false, branch);
}

void expr_resolve_at_rest(const struct expr *expr, struct time_dd t, const double *y, double dt,
                          const double *dy, const bool *keep, int *branch)
{
    resolve(expr, t, y, dt, dy, keep, true, branch);
}

int expr_branch_beyond(const struct expr *expr, size_t index, int end, int branch)
{
    if (op_is_by_sign(expr->switch_at[index].op)) return end ? 1 : -1;
    return counted((double)branch + (end ? 1 : -1));
}
