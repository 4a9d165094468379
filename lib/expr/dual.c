/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivatives by dual numbers: each value v carries its rate d along a direction, by the chain rule
 *
 *   f' = f_a a' + f_b b',
 *
 * and, for second derivatives, hyper-dual numbers (Fike and Alonso, AIAA 2011-886): v carries d/da, d/db and
 * d2/(da db),
 *
 *   f_pq = f_a a_pq + f_b b_pq + f_aa a_p a_q + f_ab (a_p b_q + a_q b_p) + f_bb b_p b_q.
 *
 * Both are exact to rounding, without a step size.
 */
#include <math.h>

#include "expr/frame.h"

/* Zero factors (see `along`) are treated only if the plain result is NaN. */
static inline double product_rate(double a, double b, double da, double db)
{
    double rate = da * b + a * db;
    return isnan(rate) ? along(b, da) + along(a, db) : rate;
}

/* The same for a quotient. The factor -f/b may vanish where the rate of b overflows: 1/cosh(u)^2 at u = -355. */
static inline double quotient_rate(double b, double f, double da, double db)
{
    double rate = (da - f * db) / b;
    return isfinite(rate) ? rate : along(1 / b, da) + along(-f / b, db);
}

/* Run a program whose frame contains values and rates of variables and constants. */
static double run_dual(const struct expr *expr, double *v, double *d, const int *branch, double *derivative)
{
    struct slopes s;
    const struct instr *end = expr->code + expr->operations;
    for (const struct instr *i = expr->code; i < end; i++) {
        double a = v[i->a], b = v[i->b], da = d[i->a], db = d[i->b];
        switch (i->op) {
        case op_copy:
            v[i->to] = a;
            d[i->to] = da;
            break;
        case op_negate:
            v[i->to] = -a;
            d[i->to] = -da;
            break;
        case op_add:
            v[i->to] = a + b;
            d[i->to] = da + db;
            break;
        case op_subtract:
            v[i->to] = a - b;
            d[i->to] = da - db;
            break;
        case op_multiply:
            v[i->to] = a * b;
            d[i->to] = product_rate(a, b, da, db);
            break;
        case op_divide:
            v[i->to] = a / b;
            d[i->to] = quotient_rate(b, v[i->to], da, db);
            break;
        case op_jump: i += i->extra; break;
        case op_jump_unless: i += a == 0 ? i->extra : 0; break;
        default:
            op_slopes(i, a, b, branch, &s);
            v[i->to] = s.f;
            d[i->to] = along(s.a, da) + along(s.b, db);
        }
    }
    *derivative = d[expr->result];
    return v[expr->result];
}

double expr_eval_along(const struct expr *expr, double t, const double *y, double dt, const double *dy,
                       const int *branch, double *derivative)
{
    double value[frame_limit], rate[frame_limit];
    frame_values(expr, t, y, value);
    frame_rates(expr, dt, dy, rate);
    return run_dual(expr, value, rate, branch, derivative);
}

double expr_eval_slot(const struct expr *expr, double t, const double *y, int slot, const int *branch,
                      double *derivative)
{
    double value[frame_limit], rate[frame_limit];
    frame_values(expr, t, y, value);
    frame_slot(expr, slot, rate);
    return run_dual(expr, value, rate, branch, derivative);
}

/* ---- second order */

struct hyper {
    double v[frame_limit], p[frame_limit], q[frame_limit], pq[frame_limit];
};

static void step_hyper(const struct instr *i, const int *branch, struct hyper *h)
{
    struct slopes s;
    double p[2] = {h->p[i->a], h->p[i->b]}, q[2] = {h->q[i->a], h->q[i->b]},
           pq[2] = {h->pq[i->a], h->pq[i->b]}, divisor = h->v[i->b]; /* `to` may be one of them */
    op_slopes(i, h->v[i->a], h->v[i->b], branch, &s);
    h->v[i->to] = s.f;
    h->p[i->to] = along(s.a, p[0]) + along(s.b, p[1]);
    h->q[i->to] = along(s.a, q[0]) + along(s.b, q[1]);
    h->pq[i->to] = along(s.a, pq[0]) + along(s.b, pq[1]) + along(s.aa, p[0] * q[0]) +
                   along(s.ab, p[0] * q[1] + q[0] * p[1]) + along(s.bb, p[1] * q[1]);
    if (i->op != op_divide) return;
    h->p[i->to] = quotient_rate(divisor, s.f, p[0], p[1]); /* bitwise as in run_dual */
    h->q[i->to] = quotient_rate(divisor, s.f, q[0], q[1]);
}

double expr_eval_second(const struct expr *expr, double t, const double *y, int slot_a, int slot_b,
                        const int *branch, double *d_a, double *d_b, double *d_ab)
{
    struct hyper h;
    size_t leaves = (expr->uses_time ? 1 : 0) + expr->variables + expr->constants;
    frame_values(expr, t, y, h.v);
    frame_slot(expr, slot_a, h.p);
    frame_slot(expr, slot_b, h.q);
    for (size_t i = 0; i < leaves; i++) h.pq[i] = 0;
    const struct instr *end = expr->code + expr->operations;
    for (const struct instr *i = expr->code; i < end; i++) {
        if (i->op == op_jump)
            i += i->extra;
        else if (i->op == op_jump_unless)
            i += h.v[i->a] == 0 ? i->extra : 0;
        else
            step_hyper(i, branch, &h);
    }
    *d_a = h.p[expr->result];
    *d_b = h.q[expr->result];
    *d_ab = h.pq[expr->result];
    return h.v[expr->result];
}
