/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Minimum-norm forces where the modes leave them indeterminate. Modes are found within tolerances that
 * disregard how large forces may be at nearly redundant constraints, as at two points of a body very close
 * together: there a mode may be closed with forces of 1e6 and a residual acceleration of 1e-3. So the forces
 * are solved for once more, M f = right with rows of comparable sizes, until the residual is rounding; modes
 * without such forces are no solution.
 *
 *     1. M with a small compliance, iterated until the residual vanishes (iterated Tikhonov regularization):
 *        minimum-norm forces with or without redundancy, O(n^2) after one factorization;
 *     2. where near redundancy makes this too slow: singular values, the largest first, until the residual
 *        vanishes (truncated by the residual, not at a threshold);
 *     3. where the minimum-norm forces exceed their limits: the original forces, corrected by 2.
 */
#include "holds/trial.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/lu.h"
#include "numeric/svd.h"

/* M f = right, f and the residual right - M f. */
struct sharing {
    struct trial *trial;
    size_t n;
    double *M, *right, *f, *rest, *before;
    double *zero;    /* tolerance of the residual: */
    double rounding; /* relative to `right` and to beside_c */
};

/* Compute the residual; is it at round-off level? That of n products, which with nearly redundant constraints
 * are far larger than their sum. */
static bool is_satisfied(struct sharing *sharing)
{
    size_t n = sharing->n;
    bool satisfied = true;
    for (size_t i = 0; i < n; i++) {
        double products = 0;
        sharing->rest[i] = sharing->right[i];
        for (size_t j = 0; j < n; j++) {
            double product = sharing->M[i * n + j] * sharing->f[j];
            sharing->rest[i] -= product;
            products += fabs(product);
        }
        satisfied &= fabs(sharing->rest[i]) <= sharing->zero[i] + 4 * DBL_EPSILON * products;
    }
    return satisfied;
}

/* Set friction forces at round-off level, relative to the largest force, to zero. */
static void drop_nothing(struct sharing *sharing)
{
    const double rounding = 1e-11;
    const struct hold_problem *problem = sharing->trial->problem;
    double most = 0, *f = sharing->f;
    for (size_t i = 0; i < sharing->n; i++) most = fmax(most, fabs(f[i]));
    for (size_t i = 0; i < sharing->n; i++)
        if (problem->holds[i].kind == hold_friction && fabs(f[i]) <= rounding * most) f[i] = 0;
}

static bool agrees(struct sharing *sharing)
{
    drop_nothing(sharing);
    trial_take_forces(sharing->trial->problem, sharing->f);
    return holds_agree(sharing->trial->problem);
}

static bool correct_with_give(struct sharing *sharing)
{
    enum { most_corrections = 20 };
    const double give = 1e-5; /* indeterminate forces have an error of rounding/give */
    struct trial *trial = sharing->trial;
    trial_set_system(trial, give);
    if (!lu_decompose(sharing->n, trial->A, trial->pivot)) return false;
    for (int k = 0; k < most_corrections; k++) {
        if (is_satisfied(sharing)) return true;
        lu_solve(sharing->n, trial->A, trial->pivot, sharing->rest);
        for (size_t i = 0; i < sharing->n; i++) sharing->f[i] += sharing->rest[i];
    }
    return is_satisfied(sharing);
}

/* f += the component of M^+ rest along singular vector k; columns of M are divided by weights. */
static void add_part(struct sharing *sharing, const struct svd *svd, size_t k)
{
    size_t n = sharing->n;
    const double *U = svd->U + k * n;
    double share = 0;
    for (size_t i = 0; i < n; i++) share += U[i] * sharing->rest[i];
    share /= svd->S[k] * svd->S[k];
    for (size_t j = 0; j < n; j++) {
        double weight = holds_weight(sharing->trial->problem, j);
        sharing->f[j] += share * svd->V[k * n + j] * (weight > 0 ? weight : 1);
    }
}

/* With scaled forces, f = weight g. Repeated from the start, since rounding affects components of small
 * singular values. */
static bool correct_by_singular_values(struct sharing *sharing, bool *made)
{
    enum { rounds = 3 };
    size_t n = sharing->n;
    struct svd svd = {0};
    double *scaled = calloc(n * n + 1, sizeof *scaled);
    for (size_t j = 0; scaled && j < n; j++) {
        double weight = holds_weight(sharing->trial->problem, j);
        for (size_t i = 0; i < n; i++) scaled[i * n + j] = sharing->M[i * n + j] * (weight > 0 ? weight : 1);
    }
    *made = scaled && svd_decompose(&svd, n, n, scaled);
    bool satisfied = *made && is_satisfied(sharing);
    for (int round = 0; *made && !satisfied && round < rounds; round++)
        for (size_t k = 0; !satisfied && k < n && svd.S[k] > (double)n * DBL_EPSILON * svd.S[0]; k++) {
            add_part(sharing, &svd, k);
            satisfied = is_satisfied(sharing);
        }
    svd_free(&svd);
    free(scaled);
    return satisfied;
}

static void set_equations(struct sharing *sharing)
{
    struct trial *trial = sharing->trial;
    const struct hold_problem *problem = trial->problem;
    size_t n = sharing->n;
    for (size_t g = 0; g < problem->guide_count; g++) trial->side[g] = problem->guides[g].N < 0 ? -1 : 1;
    trial_set_system(trial, 0);
    memcpy(sharing->M, trial->A, n * n * sizeof *sharing->M);
    memcpy(sharing->right, trial->f, n * sizeof *sharing->right);
    double size = 0;
    for (size_t i = 0; i < n; i++) size = fmax(size, fabs(sharing->right[i]));
    for (size_t i = 0; i < n; i++) {
        double weight = holds_weight(problem, i), own = trial->row[i] * weight;
        sharing->zero[i] = sharing->rounding * fmax(size, own > 0 ? problem->beside_c / own : 0);
    }
}

/* Forces of the present modes; holds_lost, with forces restored, where none satisfy the equations and limits. */
static enum holds_found share(struct sharing *sharing)
{
    size_t n = sharing->n, bytes = n * sizeof *sharing->f;
    bool made = true;
    set_equations(sharing);
    memset(sharing->f, 0, bytes);
    bool solved = correct_with_give(sharing);
    if (!solved) {
        memset(sharing->f, 0, bytes);
        solved = correct_by_singular_values(sharing, &made);
    }
    if (solved && agrees(sharing)) return holds_decided;
    memcpy(sharing->f, sharing->before, bytes);
    if (solved && correct_by_singular_values(sharing, &made) && agrees(sharing)) return holds_decided;
    trial_take_forces(sharing->trial->problem, sharing->before);
    return made ? holds_lost : holds_no_memory;
}

/* Close open constraints that approach by more than rounding, which was within the tolerance of the search.
 * Returns whether there is any. */
static bool hold_what_closes(struct hold_problem *problem, double rounding)
{
    size_t n = problem->count;
    double size = problem->beside_c;
    bool any = false;
    for (size_t i = 0; i < n; i++) size = fmax(size, holds_weight(problem, i) * fabs(problem->holds[i].free));
    for (size_t i = 0; i < n; i++) {
        struct hold *hold = &problem->holds[i];
        if (hold->kind != hold_one_sided || hold->mode == hold_keeps) continue;
        double products = 0;
        for (size_t j = 0; j < n; j++) products += fabs(problem->A[i * n + j] * problem->holds[j].force);
        double weight = holds_weight(problem, i),
               zero = rounding * size + 8 * DBL_EPSILON * weight * products;
        if (!(weight * hold->c < -zero)) continue;
        hold->mode = hold_keeps;
        any = true;
    }
    return any;
}

/* Let friction stick that slips at round-off level. Returns whether there is any. */
static bool keep_still(struct hold_problem *problem)
{
    const double still = 1e-9;
    bool any = false;
    for (size_t i = 0; i < problem->count; i++) {
        struct hold *hold = &problem->holds[i];
        if (hold->kind != hold_friction || hold->slip != 0 || hold->mode == hold_keeps) continue;
        if (holds_is_on_open(problem, hold) || !holds_is_still(problem, i, still)) continue;
        hold->mode = hold_keeps;
        any = true;
    }
    return any;
}

static bool sharing_new(struct sharing *sharing, struct trial *trial)
{
    size_t n = trial->problem->count;
    *sharing = (struct sharing){.trial = trial, .n = n, .M = calloc(n * n + 5 * n + 1, sizeof(double))};
    if (!sharing->M) return false;
    sharing->right = sharing->M + n * n;
    sharing->f = sharing->right + n;
    sharing->rest = sharing->f + n;
    sharing->before = sharing->rest + n;
    sharing->zero = sharing->before + n;
    for (size_t i = 0; i < n; i++) sharing->before[i] = trial->problem->holds[i].force;
    return true;
}

static void set_modes(struct hold_problem *problem, const int *modes)
{
    for (size_t i = 0; i < problem->count; i++) problem->holds[i].mode = modes[i];
}

/* Forces of the modes, if possible of those in which friction slipping by rounding sticks. */
static enum holds_found share_within(struct sharing *sharing, const int *modes)
{
    struct hold_problem *problem = sharing->trial->problem;
    enum holds_found found = holds_lost;
    set_modes(problem, modes);
    if (keep_still(problem)) found = share(sharing);
    if (found == holds_lost) {
        set_modes(problem, modes);
        found = share(sharing);
    }
    while (found == holds_decided && hold_what_closes(problem, fmax(1e-12, sharing->rounding)))
        found = share(sharing);
    return found;
}

/* Positions of points are accurate to 1e-12 of the scene, and the directions of slip of two points of one
 * face differ by as much: redundant constraints contradict each other by that, more where many are stacked.
 * Near a dead centre responses are small differences of large numbers. */
enum holds_found holds_share(struct hold_problem *problem)
{
    static const double roundings[] = {1e-13, 1e-11, 1e-10};
    struct trial trial;
    struct sharing sharing = {0};
    int *modes = calloc(problem->count + 1, sizeof *modes);
    bool made = trial_new(&trial, problem) && modes && sharing_new(&sharing, &trial);
    enum holds_found found = made ? holds_lost : holds_no_memory;
    for (size_t i = 0; made && i < problem->count; i++) modes[i] = problem->holds[i].mode;
    for (size_t k = 0; found == holds_lost && k < sizeof roundings / sizeof *roundings; k++) {
        sharing.rounding = roundings[k];
        found = share_within(&sharing, modes);
    }
    trial_free(&trial);
    free(sharing.M);
    free(modes);
    return found;
}

/* The zero tolerance of holds_agree grows with the forces. With forces far larger than those required by the
 * free accelerations, as in modes without a solution, which compliance makes finite, it would accept these
 * accelerations as zero. */
static bool has_far_larger_forces(const struct hold_problem *problem)
{
    const double far = 1e3;
    double most = 0, size = problem->beside_c;
    for (size_t i = 0; i < problem->count; i++) {
        double weight = holds_weight(problem, i);
        size = fmax(size, weight * fabs(problem->holds[i].free));
        for (size_t j = 0; j < problem->count; j++)
            most = fmax(most, weight * fabs(problem->A[i * problem->count + j] * problem->holds[j].force));
    }
    return most > far * size;
}

enum holds_found holds_meet(struct hold_problem *problem)
{
    return has_far_larger_forces(problem) ? holds_share(problem) : holds_decided;
}
