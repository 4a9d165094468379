/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Switches: where a formula changes, on which side a motion goes on, and how far the change is.
 *
 * Each switch watches a smooth function u of the state: a for sign, abs, step and the roundings, a - b for
 * min, max and comparisons, a/b for mod, 2a for square. A switch by sign has the branches u < 0, u > 0 and,
 * for sign and ==, u = 0. A rounding has the branches n with n + offset < u < n + offset + 1.
 *
 * Whether u is zero cannot be asked of rounded numbers. With each value therefore run its rate along the
 * motion and a bound of its rounding error, by the first-order propagation
 *
 *     e(f) = |f_a| e(a) + |f_b| e(b) + eps |f|,    e(leaf) = eps |leaf|
 *
 * (N. Higham, Accuracy and Stability of Numerical Algorithms, ch. 3). Leaves count as rounded, because an
 * instant is located to the last bit at best, and 0.7 is not exact. Where |u| is within a few such bounds,
 * the rate decides.
 */
#include <float.h>
#include <math.h>

#include "expr/frame.h"

struct motion {
    double value[frame_limit], rate[frame_limit], error[frame_limit];
};

/* The function that a switch watches, at one point of the motion. */
struct crossing {
    double u, rate, tolerance;
};

/* Called at each active switch in order, before it is evaluated. */
typedef void visit(void *context, const struct instr *i, const struct motion *at, struct crossing crossing);

static void load(const struct expr *expr, double t, const double *y, double dt, const double *dy,
                 struct motion *m)
{
    size_t leaves = (expr->uses_time ? 1 : 0) + expr->variables + expr->constants;
    frame_values(expr, t, y, m->value);
    frame_rates(expr, dt, dy, m->rate);
    for (size_t k = 0; k < leaves; k++) m->error[k] = DBL_EPSILON * fabs(m->value[k]);
}

static struct crossing crossing_at(const struct instr *i, const struct motion *m)
{
    double a = m->value[i->a], b = m->value[i->b];
    double u = a, rate = m->rate[i->a], error = m->error[i->a];
    if (op_is_by_difference(i->op)) {
        u = a - b;
        rate -= m->rate[i->b];
        error += m->error[i->b];
    } else if (i->op == op_mod) {
        u = a / b;
        rate = (rate - u * m->rate[i->b]) / b;
        error = (error + fabs(u) * m->error[i->b]) / fabs(b) + DBL_EPSILON * fabs(u);
    } else if (i->op == op_square) {
        u = 2 * a;
        rate *= 2;
        error *= 2;
    }
    /* The bounds are of first order, so a few of them; never zero, so that u = 0 lies inside. */
    return (struct crossing){u, rate, 4 * error + DBL_MIN};
}

static void step_motion(const struct instr *i, const int *branch, struct motion *m)
{
    struct slopes s;
    op_slopes(i, m->value[i->a], m->value[i->b], branch, &s);
    double rate = along(s.a, m->rate[i->a]) + along(s.b, m->rate[i->b]);
    double own = DBL_EPSILON * fabs(s.f);
    double error = along(fabs(s.a), m->error[i->a]) + along(fabs(s.b), m->error[i->b]) + own;
    m->value[i->to] = s.f;
    m->rate[i->to] = rate;
    /* At an infinite slope (sqrt at 0) the first order says nothing. */
    m->error[i->to] = isfinite(error) ? error : own;
}

static void run(const struct expr *expr, const int *branch, struct motion *m, visit *visit_switch,
                void *context)
{
    const struct instr *end = expr->code + expr->operations;
    for (const struct instr *i = expr->code; i < end; i++) {
        if (i->op == op_jump) {
            i += i->extra;
        } else if (i->op == op_jump_unless) {
            i += m->value[i->a] == 0 ? i->extra : 0;
        } else {
            if (op_is_switch(i->op)) visit_switch(context, i, m, crossing_at(i, m));
            step_motion(i, branch, m);
        }
    }
}

/* The lower end of branch 0 of a rounding. */
static double offset_of(unsigned op)
{
    return op == op_ceil ? -1 : op == op_round ? -0.5 : 0;
}

/* ---- margins */

struct margins {
    const int *branch;
    double *margins, *rates;
};

static void set_margin(struct margins *m, int index, double margin, double rate)
{
    m->margins[index] = margin;
    if (m->rates) m->rates[index] = rate;
}

static void note_margins(void *context, const struct instr *i, const struct motion *at, struct crossing c)
{
    (void)at;
    struct margins *m = context;
    int n = m->branch[i->extra], lower = 2 * i->extra, upper = lower + 1;
    if (!op_is_by_sign(i->op)) {
        if (n >= branch_limit || n <= -branch_limit) return;
        double low = n + offset_of(i->op);
        set_margin(m, lower, c.u - low, c.rate);
        set_margin(m, upper, low + 1 - c.u, -c.rate);
    } else if (n == 0 && (i->op == op_sign || i->op == op_equal)) {
        set_margin(m, lower, c.tolerance + c.u, c.rate);
        set_margin(m, upper, c.tolerance - c.u, -c.rate);
    } else if (n < 0) {
        set_margin(m, upper, -c.u, -c.rate);
    } else {
        set_margin(m, lower, c.u, c.rate);
    }
}

void expr_margins(const struct expr *expr, double t, const double *y, double dt, const double *dy,
                  const int *branch, double *margins, double *rates)
{
    if (!expr->switches) return;
    struct motion motion;
    struct margins context = {.branch = branch, .margins = margins, .rates = rates};
    for (size_t k = 0; k < 2 * expr->switches; k++) {
        margins[k] = HUGE_VAL;
        if (rates) rates[k] = 0;
    }
    load(expr, t, y, dt, dy, &motion);
    run(expr, branch, &motion, note_margins, &context);
}

/* ---- what they watch */

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
    struct motion motion;
    struct switchings context = {u, rates, rounding};
    for (size_t k = 0; k < expr->switches; k++) u[k] = rates[k] = rounding[k] = (double)NAN;
    load(expr, t, y, dt, dy, &motion);
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

static int branch_by_sign(const struct instr *i, const struct motion *at, struct crossing c)
{
    if (isfinite(c.u) && fabs(c.u) <= c.tolerance) {
        if (c.rate > 0) return 1;
        if (c.rate < 0) return -1;
        if (i->op == op_sign || i->op == op_equal) return 0;
    }
    return counted(op_plain_branch(i->op, at->value[i->a], at->value[i->b]));
}

static int branch_by_rounding(const struct instr *i, const struct motion *at, struct crossing c)
{
    double above = c.u - offset_of(i->op), nearest = round(above);
    if (c.tolerance < 0.5 && fabs(above - nearest) <= c.tolerance) {
        if (c.rate > 0) return counted(nearest);
        if (c.rate < 0) return counted(nearest - 1);
    }
    return counted(op_plain_branch(i->op, at->value[i->a], at->value[i->b]));
}

struct resolution {
    const bool *keep;
    int *branch;
};

static void choose_branch(void *context, const struct instr *i, const struct motion *at, struct crossing c)
{
    struct resolution *r = context;
    if (r->keep && r->keep[i->extra]) return;
    r->branch[i->extra] = op_is_by_sign(i->op) ? branch_by_sign(i, at, c) : branch_by_rounding(i, at, c);
}

void expr_resolve(const struct expr *expr, double t, const double *y, double dt, const double *dy,
                  const bool *keep, int *branch)
{
    if (!expr->switches) return;
    struct motion motion;
    struct resolution context = {keep, branch};
    for (size_t k = 0; k < expr->switches; k++)
        if (!keep || !keep[k]) branch[k] = 0;
    load(expr, t, y, dt, dy, &motion);
    run(expr, branch, &motion, choose_branch, &context);
}

int expr_branch_beyond(const struct expr *expr, size_t index, int end, int branch)
{
    if (op_is_by_sign(expr->switch_at[index].op)) return end ? 1 : -1;
    return counted((double)branch + (end ? 1 : -1));
}
