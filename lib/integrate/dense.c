/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivation. Let theta = (t - t0) / h, s = theta - 1/2, w = theta (1 - theta) = 1/4 - s^2, a dot d/dtheta.
 *
 * Level 0. q is the quintic Q of the end values, in the basis theta, theta (1-theta), theta^2 (1-theta), ...,
 * which gives both ends without cancellation. v = q. / h is written as the cubic Hermite polynomial V of (v,
 * a) plus a multiple of w^2, whose integral is 1/30:
 *     v = V + w^2 P_0,   P_0 = 30 (dq / h - (v0 + v1)/2 - h (a0 - a1)/12).
 * The error is proportional to w^3 in q, so to (w^3). = -6 s w^2 in v: zero at s = 0. The state in the middle
 * is better by one order in v than elsewhere: q, v and so a are good to h^6 there.
 *
 * Adding accelerations. The corrections that leave all end values unchanged are q = Q + h w^3 (C0 + C1 s + C2
 * s^2), thus
 *     v = V + w^2 (P_0 + M),   M = C1/4 + (C2/2 - 6 C0) s - 7 C1 s^2 - 8 C2 s^3.
 * An acceleration a at s requires v. = h a there, that is
 *     g(s) := h a - V.(s) + 4 s w P_0 = -4 s w M + w^2 M..
 * Only P_0 contains the difference of the q, whose rounding error is magnified by 1/h; the C do not.
 *
 * Level 1: a(0) with an error of h^6 gives g(0) = -(6/16) C0, C1 = C2 = 0; q errs by h^7 w^3 s, hence v by
 * h^6 (w^3 s). = h^6 w^2 (w - 6 s^2), which is zero for s = +-sigma, sigma^2 = 1/28, w = 3/14. There v is
 * good to h^7.
 *
 * Level 2: a(+-sigma) with errors of h^7. With m = C2/2 - 6 C0 and even and odd parts of g,
 *     g_odd = -14 sigma w^2 C1,   g_even = (3/196) m - (3/98) C2.
 * First C2 = 0: the polynomial of degree 7 errs by h^8, and in v by an odd function of s, thus by h^8 in the
 * middle. So a(0) is evaluated again, and now 16 g(0) = m and g_even give C0 and C2: degree 8, q errs by h^9.
 *
 * Other components: x = X + w^2 (B0 + B1 s) with X the cubic of the end values. The middle is of no use here
 * (w^2 has no slope there); slopes at +-sigma give h x. - X. =: g, g_odd = -4 sigma w B0, g_even = (3/196)
 * B1.
 */
#include "integrate/dense.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "integrate/linear.h"
#include "integrate/nystrom.h"
#include "integrate/pair8.h"
#include "integrate/parabola.h"
#include "numeric/tolerances.h"

/* Coefficients of a pair, in the order of the derivation, and of another component. */
struct pair {
    double q, dq, r1, r2, r3, r4; /* Q, nested: see pair_eval */
    double v, dv, s1, s2;         /* V */
    double p0, c0, c1, c2;
    double even; /* even part of g at +-sigma */
};

struct single {
    double x, dx, s1, s2, b0, b1;
};

/* Steppers with a dense output of their own. */
struct own {
    const gsl_odeiv2_step_type *const *type;
    int (*prepare)(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys);
    void (*eval)(const gsl_odeiv2_step *step, double at, double *y); /* at theta; an exact one at t - t0 */
    int (*powers)(const gsl_odeiv2_step *step, size_t i, const struct powers_piece *piece,
                  double *c); /* or NULL */
    bool exact;               /* without evaluations */
};

static const struct own owns[] = {
    {&step_dop853, dop853_dense_prepare, dop853_dense_eval, dop853_dense_powers, false},
    {&step_nystrom, nystrom_dense_prepare, nystrom_dense_eval, NULL, false},
    {&step_linear, linear_dense_prepare, linear_dense_eval, linear_dense_powers, true},
    {&step_parabola, parabola_dense_prepare, parabola_dense_eval, parabola_dense_powers, true},
};

struct dense {
    size_t pairs, extra;
    int level;
    bool prepared;
    struct time_dd t0, t1;
    double h;
    const double *y0, *f0, *y1, *f1;
    const double *error; /* see dense_set_errors; or NULL */
    const gsl_odeiv2_system *sys;
    const struct own *own; /* the stepper's own dense output, or NULL */
    gsl_odeiv2_step *step;
    struct pair *pair;
    struct single *single;
    double *y, *minus, *plus; /* an inner state; slopes at -sigma, and at sigma or in the middle */
};

static const double sigma = 0.18898223650461362; /* 1 / sqrt(28) */
static const double w_sigma = 3.0 / 14;          /* w at sigma */

struct dense *dense_alloc(const struct layout *layout)
{
    size_t n = layout->pairs, m = layout->extra, size = layout_size(layout);
    if (size > SIZE_MAX / 16 / sizeof(struct pair)) return NULL;
    size_t bytes = n * sizeof(struct pair) + m * sizeof(struct single) + 3 * size * sizeof(double);
    struct dense *d = block_alloc(sizeof *d + bytes);
    if (!d) return NULL;
    d->pairs = n;
    d->extra = m;
    d->pair = (struct pair *)(d + 1);
    d->single = (struct single *)(d->pair + n);
    d->y = (double *)(d->single + m);
    d->minus = d->y + size;
    d->plus = d->minus + size;
    return d;
}

void dense_free(struct dense *dense)
{
    free(dense);
}

void dense_set_errors(struct dense *dense, const double *errors)
{
    dense->error = errors;
}

static int level_for(int order, size_t pairs, size_t extra)
{
    if (order <= 4) return 0;
    return order == 5 && (pairs == 0 || extra == 0) ? 1 : 2;
}

void dense_set(struct dense *d, int order, struct time_dd t0, const double *y0, const double *f0,
               struct time_dd t1, const double *y1, const double *f1, const gsl_odeiv2_system *sys,
               gsl_odeiv2_step *step)
{
    d->level = level_for(order, d->pairs, d->extra);
    d->prepared = false;
    d->t0 = t0;
    d->t1 = t1;
    d->h = time_dd_since(t1, t0);
    d->y0 = y0;
    d->f0 = f0;
    d->y1 = y1;
    d->f1 = f1;
    d->sys = sys;
    if (step == d->step) return;
    d->step = step;
    d->own = NULL;
    for (size_t i = 0; step && i < sizeof owns / sizeof *owns; i++)
        if (*owns[i].type == step->type) d->own = &owns[i];
}

/* Level 0 of a pair. P_0 is dropped where it is within the errors of q: in a very short step the cubic is
 * accurate enough, and events on v must not contain the round-off of q divided by h. */
static void pair_from_ends(struct pair *p, double h, double q0, double v0, double a0, double q1, double v1,
                           double a1, double error)
{
    *p = (struct pair){.q = q0, .dq = q1 - q0, .v = v0, .dv = v1 - v0};
    p->r1 = h * v0 - p->dq;
    p->r2 = p->dq - h * v1 - p->r1;
    p->r3 = h * h * a0 / 2 + p->r1 - p->r2;
    p->r4 = h * h * a1 / 2 + p->r1 + 2 * p->r2 - p->r3;
    p->s1 = h * a0 - p->dv;
    p->s2 = p->dv - h * a1 - p->s1;
    double excess = p->dq / h - (v0 + v1) / 2 - h * (a0 - a1) / 12;
    double noise = (round_off(1, fabs(q0) + fabs(q1)) + 10 * fabs(error)) / fabs(h);
    p->p0 = fabs(excess) > noise ? 30 * excess : 0;
}

static void single_from_ends(struct single *x, double h, double x0, double f0, double x1, double f1)
{
    *x = (struct single){.x = x0, .dx = x1 - x0};
    x->s1 = h * f0 - x->dx;
    x->s2 = x->dx - h * f1 - x->s1;
}

static void pair_eval(const struct pair *p, double h, double theta, double *q, double *v)
{
    double rest = 1 - theta, s = theta - 0.5, w = theta * rest;
    double quintic = p->r1 + theta * (p->r2 + rest * (p->r3 + theta * p->r4));
    double m = p->c1 / 4 + s * ((p->c2 / 2 - 6 * p->c0) - s * (7 * p->c1 + s * 8 * p->c2));
    *q = p->q + theta * (p->dq + rest * quintic) + h * w * w * w * (p->c0 + s * (p->c1 + s * p->c2));
    *v = p->v + theta * (p->dv + rest * (p->s1 + theta * p->s2)) + w * w * (p->p0 + m);
}

static double single_eval(const struct single *x, double theta)
{
    double rest = 1 - theta, s = theta - 0.5, w = theta * rest;
    return x->x + theta * (x->dx + rest * (x->s1 + theta * x->s2)) + w * w * (x->b0 + s * x->b1);
}

static void eval_all(const struct dense *d, double theta, double *y)
{
    size_t n = d->pairs;
    for (size_t i = 0; i < n; i++) pair_eval(&d->pair[i], d->h, theta, &y[i], &y[n + i]);
    for (size_t i = 0; i < d->extra; i++) y[2 * n + i] = single_eval(&d->single[i], theta);
}

/* y_i + theta (slope + (1 - theta) (s1 + theta s2)), the cubic of all of them. */
static int cubic_powers(double y, double slope, double s1, double s2, const struct powers_piece *piece,
                        double *c)
{
    c[0] = s2;
    int degree = powers_times_theta(0, c, piece);
    c[0] += s1;
    degree = powers_times_rest(degree, c, piece);
    c[0] += slope;
    degree = powers_times_theta(degree, c, piece);
    c[0] += y;
    return degree;
}

/* c times (theta (1 - theta))^count */
static int times_w(int degree, double *c, int count, const struct powers_piece *piece)
{
    for (int k = 0; k < count; k++) {
        degree = powers_times_theta(degree, c, piece);
        degree = powers_times_rest(degree, c, piece);
    }
    return degree;
}

static int add_powers(int degree, double *c, int other_degree, const double *other)
{
    for (int k = degree + 1; k <= other_degree; k++) c[k] = 0;
    for (int k = 0; k <= other_degree; k++) c[k] += other[k];
    return degree > other_degree ? degree : other_degree;
}

static int q_powers(const struct pair *p, double h, const struct powers_piece *piece, double *c)
{
    c[0] = p->r4;
    int degree = powers_times_theta(0, c, piece);
    c[0] += p->r3;
    degree = powers_times_rest(degree, c, piece);
    c[0] += p->r2;
    degree = powers_times_theta(degree, c, piece);
    c[0] += p->r1;
    degree = powers_times_rest(degree, c, piece);
    c[0] += p->dq;
    degree = powers_times_theta(degree, c, piece);
    c[0] += p->q;
    if (p->c0 == 0 && p->c1 == 0 && p->c2 == 0) return degree;
    double high[dense_most_degree + 1] = {h * p->c2};
    int of_high = powers_times_centred(0, high, piece);
    high[0] += h * p->c1;
    of_high = powers_times_centred(of_high, high, piece);
    high[0] += h * p->c0;
    return add_powers(degree, c, times_w(of_high, high, 3, piece), high);
}

static int v_powers(const struct pair *p, const struct powers_piece *piece, double *c)
{
    int degree = cubic_powers(p->v, p->dv, p->s1, p->s2, piece, c), of_high = 0;
    double high[dense_most_degree + 1] = {-8 * p->c2};
    if (p->c0 != 0 || p->c1 != 0 || p->c2 != 0) {
        of_high = powers_times_centred(of_high, high, piece);
        high[0] -= 7 * p->c1;
        of_high = powers_times_centred(of_high, high, piece);
        high[0] += p->c2 / 2 - 6 * p->c0;
        of_high = powers_times_centred(of_high, high, piece);
        high[0] += p->c1 / 4;
    }
    high[0] += p->p0;
    return add_powers(degree, c, times_w(of_high, high, 2, piece), high);
}

static int single_powers(const struct single *x, const struct powers_piece *piece, double *c)
{
    int degree = cubic_powers(x->x, x->dx, x->s1, x->s2, piece, c);
    if (x->b0 == 0 && x->b1 == 0) return degree;
    double high[dense_most_degree + 1] = {x->b1};
    int of_high = powers_times_centred(0, high, piece);
    high[0] += x->b0;
    return add_powers(degree, c, times_w(of_high, high, 2, piece), high);
}

/* f = slopes on the present polynomial at s. */
static int inner_slopes(struct dense *d, double s, double *f)
{
    eval_all(d, s + 0.5, d->y);
    return GSL_ODEIV_FN_EVAL(d->sys, d->t0.t + (s + 0.5) * d->h, d->y, f);
}

/* The slope at s, d/dtheta, of a cubic with this difference of its ends and the coefficients s1, s2. */
static double cubic_slope(double difference, double s1, double s2, double s)
{
    double theta = s + 0.5, rest = 1 - theta, inner = s1 + theta * s2;
    return difference + rest * inner + theta * (rest * s2 - inner);
}

/* g(s) of the derivation for an acceleration a at s. */
static double pair_defect(const struct pair *p, double h, double a, double s)
{
    return h * a - cubic_slope(p->dv, p->s1, p->s2, s) + 4 * s * (0.25 - s * s) * p->p0;
}

static double single_defect(const struct single *x, double h, double slope, double s)
{
    return h * slope - cubic_slope(x->dx, x->s1, x->s2, s);
}

/* Use the acceleration in the middle. Before the even parts at +-sigma are set (level 1), C2 = 0. */
static int use_middle(struct dense *d, bool even_known)
{
    int code = inner_slopes(d, 0, d->plus);
    if (code != GSL_SUCCESS) return code;
    for (size_t i = 0; i < d->pairs; i++) {
        struct pair *p = &d->pair[i];
        double m = 16 * pair_defect(p, d->h, d->plus[d->pairs + i], 0);
        p->c2 = even_known ? m / 2 - 98.0 / 3 * p->even : 0;
        p->c0 = (p->c2 / 2 - m) / 6;
    }
    return GSL_SUCCESS;
}

/* Use the slopes at +-sigma in place of the earlier ones. */
static int use_sigma(struct dense *d)
{
    int code = inner_slopes(d, -sigma, d->minus);
    if (code == GSL_SUCCESS) code = inner_slopes(d, sigma, d->plus);
    if (code != GSL_SUCCESS) return code;
    size_t n = d->pairs;
    for (size_t i = 0; i < n; i++) {
        struct pair *p = &d->pair[i];
        double below = pair_defect(p, d->h, d->minus[n + i], -sigma);
        double above = pair_defect(p, d->h, d->plus[n + i], sigma);
        p->even = (above + below) / 2;
        p->c1 = (below - above) / 2 / (14 * sigma * w_sigma * w_sigma);
        p->c2 = 0;
        p->c0 = -196.0 / 3 * p->even / 6;
    }
    for (size_t i = 0; i < d->extra; i++) {
        struct single *x = &d->single[i];
        double below = single_defect(x, d->h, d->minus[2 * n + i], -sigma);
        double above = single_defect(x, d->h, d->plus[2 * n + i], sigma);
        x->b0 = (below - above) / 2 / (4 * sigma * w_sigma);
        x->b1 = (above + below) / 2 * 196 / 3;
    }
    return GSL_SUCCESS;
}

/* Set pair i from its ends. */
static void set_pair(struct dense *d, size_t i)
{
    size_t n = d->pairs;
    const double *y0 = d->y0, *y1 = d->y1, *f0 = d->f0, *f1 = d->f1;
    pair_from_ends(&d->pair[i], d->h, y0[i], y0[n + i], f0[n + i], y1[i], y1[n + i], f1[n + i],
                   d->error ? d->error[i] : 0);
}

static void from_ends(struct dense *d)
{
    size_t n = d->pairs;
    const double *y0 = d->y0, *y1 = d->y1, *f0 = d->f0, *f1 = d->f1;
    for (size_t i = 0; i < n; i++) set_pair(d, i);
    for (size_t i = 0, j = 2 * n; i < d->extra; i++, j++)
        single_from_ends(&d->single[i], d->h, y0[j], f0[j], y1[j], f1[j]);
}

static int refine(struct dense *d)
{
    if (d->pairs == 0) {
        int code = d->level >= 1 ? use_sigma(d) : GSL_SUCCESS;
        return code == GSL_SUCCESS && d->level >= 2 ? use_sigma(d) : code;
    }
    int code = d->level >= 1 ? use_middle(d, false) : GSL_SUCCESS;
    if (code == GSL_SUCCESS && d->level >= 2) code = use_sigma(d);
    if (code == GSL_SUCCESS && d->level >= 2) code = use_middle(d, true);
    return code;
}

static int prepare(struct dense *d)
{
    int code;
    if (d->own) {
        code = d->own->prepare(d->step, d->sys);
    } else {
        from_ends(d);
        code = refine(d);
    }
    d->prepared = code == GSL_SUCCESS;
    return code;
}

int dense_eval(struct dense *d, struct time_dd t, double *y)
{
    size_t size = 2 * d->pairs + d->extra;
    bool start = time_dd_equal(t, d->t0);
    if (start || time_dd_equal(t, d->t1)) {
        memcpy(y, start ? d->y0 : d->y1, size * sizeof *y);
        return GSL_SUCCESS;
    }
    if (!d->prepared) {
        int code = prepare(d);
        if (code != GSL_SUCCESS) return code;
    }
    double since = time_dd_since(t, d->t0), theta = since / d->h;
    if (d->own)
        d->own->eval(d->step, d->own->exact ? since : theta, y);
    else
        eval_all(d, theta, y);
    return GSL_SUCCESS;
}

static struct powers_piece piece_between(const struct dense *d, struct time_dd from, struct time_dd to)
{
    double begin = time_dd_since(from, d->t0) / d->h, end = time_dd_since(to, d->t0) / d->h;
    return (struct powers_piece){begin + (end - begin) / 2, (end - begin) / 2};
}

int dense_powers_of_ends(struct dense *d, struct time_dd from, struct time_dd to, size_t i, double *c)
{
    size_t n = d->pairs;
    if (i >= 2 * n || d->prepared || (d->own && d->own->exact)) return -1;
    const struct powers_piece piece = piece_between(d, from, to);
    set_pair(d, i % n);
    return i < n ? q_powers(&d->pair[i], d->h, &piece, c) : v_powers(&d->pair[i - n], &piece, c);
}

int dense_powers(struct dense *d, struct time_dd from, struct time_dd to, size_t i, double *c)
{
    size_t n = d->pairs;
    if ((d->own && !d->own->powers) || (!d->prepared && prepare(d) != GSL_SUCCESS)) return -1;
    const struct powers_piece piece = piece_between(d, from, to);
    if (d->own) return d->own->powers(d->step, i, &piece, c);
    if (i < n) return q_powers(&d->pair[i], d->h, &piece, c);
    if (i < 2 * n) return v_powers(&d->pair[i - n], &piece, c);
    return single_powers(&d->single[i - 2 * n], &piece, c);
}

void dense_eval_plain(struct dense *d, struct time_dd t, double *y)
{
    d->prepared = false;
    from_ends(d);
    eval_all(d, time_dd_since(t, d->t0) / d->h, y);
}
