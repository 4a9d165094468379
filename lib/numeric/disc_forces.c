/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Newton's method for the accelerations with f_i = -c_i a_i/sqrt(|a_i|^2 + e^2), with e from their size down to round-off; then
 * relaxation, disc by disc, which is exact: each is a problem of two unknowns, W_ii + s 1 with s >= 0 such that |f_i| = c_i.
 * Alone it converges slowly where points share forces near the limit that they bear together.
 */
#include "numeric/disc_forces.h"

#include <math.h>

#include "numeric/lu.h"
#include "numeric/tolerances.h"

/* ---- smooth */

struct smooth {
    const struct disc_problem *of;
    size_t n; /* 2 count */
    double e;
    double *a, *trial, *R, *step, *J;
};

/* Set the forces at accelerations a and R = a - b - W f; returns its square. */
static double set_residual(const struct smooth *smooth, const double *a)
{
    const struct disc_problem *of = smooth->of;
    double square = 0;
    for (size_t i = 0; i < of->count; i++) {
        const struct vec own = {a[2 * i], a[2 * i + 1]};
        of->f[i] = vec_scale(-of->c[i] / hypot(vec_norm(own), smooth->e), own);
    }
    for (size_t p = 0; p < smooth->n; p++) {
        const double *W = of->W + p * smooth->n;
        double sum = a[p] - of->b[p];
        for (size_t j = 0; j < of->count; j++) sum -= W[2 * j] * of->f[j].x + W[2 * j + 1] * of->f[j].y;
        smooth->R[p] = sum;
        square += sum * sum;
    }
    return square;
}

/* J = 1 + W K, K = c/s (1 - a a/s^2), s = sqrt(|a|^2 + e^2). */
static void set_slopes(const struct smooth *smooth)
{
    const struct disc_problem *of = smooth->of;
    for (size_t j = 0; j < of->count; j++) {
        const double x = smooth->a[2 * j], y = smooth->a[2 * j + 1], e = smooth->e;
        const double square = x * x + y * y + e * e, k = of->c[j] / (square * sqrt(square));
        const double xx = k * (y * y + e * e), xy = -k * x * y, yy = k * (x * x + e * e);
        for (size_t p = 0; p < smooth->n; p++) {
            const double *W = of->W + p * smooth->n + 2 * j;
            double *J = smooth->J + p * smooth->n + 2 * j;
            J[0] = (p == 2 * j) + W[0] * xx + W[1] * xy;
            J[1] = (p == 2 * j + 1) + W[0] * xy + W[1] * yy;
        }
    }
}

/* A step of Newton's method, halved until the residual decreases; false if none is found. */
static bool newton(const struct smooth *smooth, double square)
{
    enum { most_halves = 30 };
    const double enough = 0.1; /* of the decrease along the slope */
    for (size_t p = 0; p < smooth->n; p++) smooth->step[p] = -smooth->R[p];
    set_slopes(smooth);
    if (!lu_decompose(smooth->n, smooth->J, smooth->of->pivot)) return false;
    lu_solve(smooth->n, smooth->J, smooth->of->pivot, smooth->step);
    double size = 1;
    for (int half = 0; half < most_halves; half++, size /= 2) {
        for (size_t p = 0; p < smooth->n; p++) smooth->trial[p] = smooth->a[p] + size * smooth->step[p];
        if (!(set_residual(smooth, smooth->trial) <= (1 - enough * size) * square)) continue;
        for (size_t p = 0; p < smooth->n; p++) smooth->a[p] = smooth->trial[p];
        return true;
    }
    return false;
}

/* Newton's method at a given e. */
static void solve(const struct smooth *smooth, double size)
{
    enum { most_steps = 30 };
    const double rounding = evaluation_rounding * size;
    double square = set_residual(smooth, smooth->a);
    for (int step = 0; step < most_steps && square > rounding * rounding; step++) {
        const bool found = newton(smooth, square);
        square = set_residual(smooth, smooth->a);
        if (!found) break;
    }
}

static void approach(const struct disc_problem *of)
{
    const size_t n = 2 * of->count;
    double *room = of->room, size = 0;
    struct smooth smooth = {of, n, 0, room, room + n, room + 2 * n, room + 3 * n, room + 4 * n};
    for (size_t p = 0; p < n; p++) {
        smooth.a[p] = of->b[p];
        size = fmax(size, fabs(of->b[p]));
    }
    for (smooth.e = size; smooth.e > negligible_part * size; smooth.e /= 10) solve(&smooth, size);
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
