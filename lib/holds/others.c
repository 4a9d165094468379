/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Other forces of the same modes. Where the forces are indeterminate, M f = right has null vectors z, and f +
 * t z are forces of the same modes within the limits: f >= 0 of a surface, |f| <= mu P of sticking friction,
 * and the directions of motion of open and slipping constraints. All of these have the form a + t b >= 0.
 */
#include "holds/others.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "numeric/qr.h"
#include "numeric/tolerances.h"

/* Limit of t by a + t b >= 0, where a counts as zero up to `zero`. */
static double within(double limit, double a, double b, double zero, double least)
{
    if (!(b < -least)) return limit;
    return fmin(limit, a <= zero ? 0 : a / -b);
}

static double answer_to(const struct hold_problem *problem, size_t i, const double *z)
{
    double c = 0;
    for (size_t j = 0; j < problem->count; j++) c += problem->A[i * problem->count + j] * z[j];
    return c;
}

/* The largest t with which constraint i is consistent with its mode. */
static double furthest_of(const struct hold_problem *problem, size_t i, const double *z, double size)
{
    const struct hold *hold = &problem->holds[i];
    double t = HUGE_VAL, most = 0;
    for (size_t j = 0; j < problem->count; j++) most = fmax(most, fabs(z[j]));
    const double zero = undecided_part * size, least = undecided_part * most;
    if (hold->mode != hold_keeps) {
        double weight = holds_weight(problem, i), way = hold->mode * weight;
        double none = undecided_part * problem->size;
        if (holds_is_on_open(problem, hold) || weight == 0) return t;
        return within(t, way * hold->c, way * answer_to(problem, i, z), none, least / weight);
    }
    if (hold->kind == hold_one_sided) return within(t, hold->force, z[i], zero, least);
    if (hold->press != press_hold || holds_is_on_open(problem, hold)) return 0;
    double P = problem->holds[hold->presses].force, by = z[hold->presses];
    t = within(t, hold->mu_s * P - hold->force, hold->mu_s * by - z[i], zero, least);
    return within(t, hold->mu_s * P + hold->force, hold->mu_s * by + z[i], zero, least);
}

/* Set `step` to half of the largest t, at most to the size of the present forces; false where it is
 * negligible. */
static bool set_step(const struct hold_problem *problem, const double *z, double *step)
{
    double t = HUGE_VAL, size = 0, most = 0;
    for (size_t i = 0; i < problem->count; i++) {
        size = fmax(size, fabs(problem->holds[i].force));
        most = fmax(most, fabs(z[i]));
    }
    for (size_t i = 0; i < problem->count; i++) t = fmin(t, furthest_of(problem, i, z, size));
    t = fmin(t / 2, size / most);
    for (size_t i = 0; i < problem->count; i++) step[i] = t * z[i];
    return t * most > distinct_part * size;
}

/* Friction without a coefficient has no force, whatever its mode. */
static bool has_none(const struct hold *hold)
{
    return hold->kind == hold_friction && hold->press == press_hold && hold->mu_s == 0;
}

/* Scaled forces, f = weight g, make the least change independent of units. */
static double scale_of(const struct hold_problem *problem, size_t i)
{
    double weight = holds_weight(problem, i);
    return weight > 0 ? weight : 1;
}

/* Row i of M f = right for the modes: c_i = 0 of closed or sticking constraints, f_i = 0 of open ones, f_i + mode mu_k P = 0
 * of slipping ones. */
static void set_row(const struct hold_problem *problem, size_t i, double *row)
{
    const struct hold *hold = &problem->holds[i];
    bool holds = hold->mode == hold_keeps && !holds_is_on_open(problem, hold) && !has_none(hold);
    double most = 0;
    for (size_t j = 0; j < problem->count; j++)
        row[j] = holds ? problem->A[i * problem->count + j] : (double)(j == i);
    if (hold->mode != hold_keeps && hold->kind == hold_friction && hold->press == press_hold)
        row[hold->presses] += hold->mode * hold->mu_k;
    for (size_t j = 0; j < problem->count; j++) {
        row[j] *= scale_of(problem, j);
        most = fmax(most, fabs(row[j]));
    }
    for (size_t j = 0; j < problem->count && most > 0; j++) row[j] /= most;
}

/* Orthonormal null vectors of M, row by row; their number, or -1 when memory is out. */
static int find_open(const struct hold_problem *problem, double *M, double *null)
{
    size_t n = problem->count;
    struct qr qr;
    for (size_t i = 0; i < n; i++) set_row(problem, i, M + i * n);
    bool made = qr_decompose(&qr, n, n, M, solved_rounding);
    if (made) qr_set_orthonormal_null(&qr, null);
    qr_free(&qr);
    return made ? (int)(n - qr.rank) : -1;
}

/* Project a unit force at constraint i onto the null space. False where the projection vanishes. */
static bool project(const struct hold_problem *problem, const double *null, int open, size_t i, double *z)
{
    size_t n = problem->count;
    double most = 0;
    for (size_t j = 0; j < n; j++) {
        double sum = 0;
        for (size_t k = 0; k < (size_t)open; k++) sum += null[k * n + i] * null[k * n + j];
        z[j] = scale_of(problem, j) * sum;
        most = fmax(most, fabs(sum));
    }
    return most > undecided_part;
}

int holds_other_forces(struct hold_problem *problem, double *steps)
{
    size_t n = problem->count;
    double *M = calloc(2 * n * n + n + 1, sizeof *M), *null = M ? M + n * n : NULL,
           *z = M ? null + n * n : NULL;
    int open = M ? find_open(problem, M, null) : -1, found = 0;
    for (size_t i = 0; open > 0 && i < n; i++) {
        if (problem->holds[i].kind != hold_one_sided || problem->holds[i].mode != hold_keeps) continue;
        bool moves = project(problem, null, open, i, z);
        for (int side = -1; moves && side <= 1; side += 2) {
            for (size_t j = 0; j < n; j++) z[j] *= -1;
            if (set_step(problem, z, steps + (size_t)found * n)) found++;
        }
    }
    free(M);
    return open >= 0 ? found : -1;
}
