/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A primal-dual interior point method (S. J. Wright, Primal-Dual Interior-Point Methods, SIAM 1997): with g_i = f_i/c_i, and
 * W, b and the accelerations relative to the largest b_i, the conditions
 *
 *     W g + b + l_i g_i = 0,    s_i + (|g_i|^2 - 1)/2 = 0,    l_i s_i = mu,    l_i, s_i > 0
 *
 * are solved by Newton's method while mu decreases to zero. Its matrices are positive definite, whatever W. Then relaxation, disc
 * by disc, removes the remainder of mu: each disc is a problem of two unknowns, W_ii + s 1 with s >= 0 such that |f_i| = c_i. Alone
 * it converges slowly where points share forces near the limit that they bear together.
 */
#include "numeric/disc_forces.h"

#include <math.h>

#include "numeric/lu.h"
#include "numeric/tolerances.h"

/* ---- all discs */

struct interior {
    const struct disc_problem *of;
    size_t n;    /* 2 count */
    double size; /* of c_i b_i */
    double mu, least;
    double *g, *step, *l, *s, *J; /* n; n; count; count; n x n */
};

/* Entry p, q of the scaled W. */
static double response(const struct interior *in, size_t p, size_t q)
{
    const double *c = in->of->c;
    return c[p / 2] * c[q / 2] * in->of->W[p * in->n + q] / in->size;
}

/* The excess of point i: s + (|g|^2 - 1)/2. */
static double excess(const struct interior *in, size_t i)
{
    const double x = in->g[2 * i], y = in->g[2 * i + 1];
    return in->s[i] + (x * x + y * y - 1) / 2;
}

/* The change of l_i along g_i: (mu - l s + l excess + l g . dg)/s. */
static double change_of(const struct interior *in, size_t i, double along)
{
    return (in->mu + in->l[i] * (excess(in, i) - in->s[i] + along)) / in->s[i];
}

/* The system for dg: W + l + (l/s) g g, and a little against steps of round-off in directions in which nothing yields. */
static void set_system(const struct interior *in)
{
    for (size_t p = 0; p < in->n; p++) {
        const size_t i = p / 2;
        double sum = in->of->c[i] * in->of->b[p] / in->size + in->l[i] * in->g[p];
        for (size_t q = 0; q < in->n; q++) {
            const double W = response(in, p, q), own = in->l[i] / in->s[i] * in->g[p] * in->g[q];
            sum += W * in->g[q];
            in->J[p * in->n + q] = W + (p == q ? in->l[i] + in->least : 0) + (q / 2 == i ? own : 0);
        }
        in->step[p] = -sum - in->g[p] * change_of(in, i, 0);
    }
}

/* The largest part of a step, at most 1, that keeps a number positive. */
static double part_of(double part, double value, double change)
{
    const double most = 0.99; /* of the distance to zero */
    return value + part * change > (1 - most) * value ? part : most * value / -change;
}

/* A step of Newton's method; false where its system has no solution. */
static bool newton(const struct interior *in)
{
    double part = 1;
    set_system(in);
    if (!lu_decompose(in->n, in->J, in->of->pivot)) return false;
    lu_solve(in->n, in->J, in->of->pivot, in->step);
    double *change = in->J; /* no longer needed */
    for (size_t i = 0; i < in->of->count; i++) {
        const double along = in->g[2 * i] * in->step[2 * i] + in->g[2 * i + 1] * in->step[2 * i + 1];
        change[2 * i] = change_of(in, i, along);
        change[2 * i + 1] = -excess(in, i) - along;
        part = part_of(part, in->l[i], change[2 * i]);
        part = part_of(part, in->s[i], change[2 * i + 1]);
    }
    for (size_t p = 0; p < in->n; p++) in->g[p] += part * in->step[p];
    for (size_t i = 0; i < in->of->count; i++) {
        in->l[i] += part * change[2 * i];
        in->s[i] += part * change[2 * i + 1];
    }
    return true;
}

static double gap_of(const struct interior *in)
{
    double sum = 0;
    for (size_t i = 0; i < in->of->count; i++) sum += in->l[i] * in->s[i];
    return sum / (double)in->of->count;
}

/* Is W round-off in the system? */
static bool is_stiff(const struct interior *in)
{
    double most = 0;
    for (size_t i = 0; i < in->of->count; i++) most = fmax(most, in->l[i] / in->s[i]);
    return round_off(1000, most) > 1;
}

static void approach(const struct disc_problem *of)
{
    enum { most_steps = 100 };
    const double decrease = 0.1, least = solved_rounding * solved_rounding;
    const size_t n = 2 * of->count;
    double *room = of->room;
    struct interior in = {.of = of, .n = n, .g = room, .step = room + n, .l = room + 2 * n};
    in.s = in.l + of->count;
    in.J = in.s + of->count;
    for (size_t p = 0; p < n; p++) {
        in.g[p] = 0;
        in.size = fmax(in.size, of->c[p / 2] * fabs(of->b[p]));
    }
    for (size_t p = 0; in.size > 0 && p < n; p++)
        in.least = fmax(in.least, negligible_sum * response(&in, p, p));
    for (size_t i = 0; i < of->count; i++) {
        in.l[i] = 1;
        in.s[i] = 0.5;
    }
    for (int step = 0; in.size > 0 && step < most_steps && gap_of(&in) > least && !is_stiff(&in); step++) {
        in.mu = decrease * gap_of(&in);
        if (!newton(&in)) break;
    }
    for (size_t i = 0; i < of->count; i++)
        of->f[i] = vec_scale(of->c[i], (struct vec){in.g[2 * i], in.g[2 * i + 1]});
}

/* ---- disc by disc */

/* A disc: A f + b = -s f with s >= 0 and |f| <= c. In the principal axes of A. */
struct disc {
    double a[2]; /* principal values */
    struct vec axis;
    double c;
};

static struct disc disc_of(const struct disc_problem *of, size_t i)
{
    const size_t size = 2 * of->count;
    const double *A = &of->W[2 * i * (size + 1)];
    const double mean = (A[0] + A[size + 1]) / 2, half = (A[0] - A[size + 1]) / 2;
    const double across = (A[1] + A[size]) / 2, spread = hypot(half, across);
    return (struct disc){{mean + spread, mean - spread}, vec_unit(atan2(across, half) / 2), of->c[i]};
}

/* -(A + s 1)^-1 b in the principal axes; a direction in which nothing yields has no force. */
static struct vec force_at(const struct disc *disc, struct vec b, double s)
{
    const double immovable = negligible_sum, least = immovable * disc->a[0];
    return (struct vec){disc->a[0] + s > 0 ? -b.x / (disc->a[0] + s) : 0,
                        disc->a[1] + s > least ? -b.y / (disc->a[1] + s) : 0};
}

/* The force of a disc. 1/|f| grows nearly linearly with s: Newton's method on 1/|f| = 1/c from s = 0 is monotonic (J. J.
 * More and D. C. Sorensen, SIAM J. Sci. Stat. Comput. 4, 1983, 553). `b` is the acceleration without it. */
static struct vec disc_force(const struct disc *disc, struct vec b, bool *slips)
{
    enum { most_steps = 60 };
    const struct vec own = {vec_dot(disc->axis, b), vec_cross(disc->axis, b)};
    struct vec f = force_at(disc, own, 0);
    double s = 0;
    *slips = vec_norm(f) > (1 + negligible_sum) * disc->c || disc->c == 0;
    if (disc->c == 0) return (struct vec){0, 0};
    for (int step = 0; *slips && step < most_steps; step++) {
        const double size = vec_norm(f);
        const double slope = (f.x * f.x / (disc->a[0] + s) + f.y * f.y / (disc->a[1] + s)) / (size * size);
        const double change = (size / disc->c - 1) / slope;
        s += change;
        f = force_at(disc, own, s);
        if (!(change > negligible_sum * s)) break;
    }
    if (*slips) f = vec_scale(disc->c / vec_norm(f), f);
    return vec_turn(disc->axis, f);
}

struct vec disc_forces_by_others(const struct disc_problem *of, size_t i)
{
    const size_t size = 2 * of->count, first = 2 * i;
    double sum[2] = {of->b[first], of->b[first + 1]};
    for (size_t k = 0; k < 2; k++) {
        const double *answers = of->W + (first + k) * size;
        for (size_t j = 0; j < of->count; j++, answers += 2)
            if (j != i) sum[k] += answers[0] * of->f[j].x + answers[1] * of->f[j].y;
    }
    return (struct vec){sum[0], sum[1]};
}

static void relax(const struct disc_problem *of)
{
    enum { most_sweeps = 100 };
    double change = 1;
    for (int sweep = 0; sweep < most_sweeps && change > evaluation_rounding; sweep++) {
        change = 0;
        for (size_t i = 0; i < of->count; i++) {
            const struct disc disc = disc_of(of, i);
            const struct vec f = disc_force(&disc, disc_forces_by_others(of, i), &of->slips[i]);
            if (disc.c > 0) change = fmax(change, vec_norm(vec_sub(f, of->f[i])) / disc.c);
            of->f[i] = f;
        }
    }
}

void disc_forces_find(const struct disc_problem *of)
{
    if (of->count > 1) approach(of);
    relax(of);
}
