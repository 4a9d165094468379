/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Multipliers: M a = tau + J^T lambda with J a = gamma.
 *
 * The accelerations a_0 without constraints leave g'' = g''_0 in each row; the multipliers compensate it, S
 * lambda = -g''_0 with S = J M^-1 J^T (constraint_matrix.c). Rows without a common joint have a zero entry,
 * and S is kept in its envelope: a chain of loops whose rows are numbered along it takes time proportional to
 * its length.
 *
 * Dry friction of slipping slides is in the same system: tau_k + c_k N_k = 0, with N_k the normal force,
 * which depends on all multipliers and all other frictions. So the matrix is not symmetric, and is factored
 * as L D U in its envelope (Duff, Erisman and Reid, Direct Methods for Sparse Matrices, chapter 8), without
 * pivoting: S is positive definite, and the corrections below compensate the rounding by small pivots of
 * friction.
 *
 * Where rows are linearly dependent, always or at some positions (all bars of a parallelogram in one line), S
 * is singular. So S + epsilon D is factored (epsilon: shift_of_rows), and the solution is corrected by the residual of the true
 * system: after n corrections a direction of S with the relative size s has the relative error (epsilon /
 * (epsilon + s))^(n + 1), which is rounding after two for s > 1e-3, and after eight for s > 1e-6, as for a
 * light coupler between heavy bodies; multipliers of a redundant row are those of the least norm; and near a
 * singular position the solution stays smooth, so that the motion passes it. (The augmented Lagrangian method
 * of Bayo and Ledesma, Nonlinear Dynamics 9, 1996, does the same.)
 *
 * Signs: a unit multiplier is the forces grad g on the links, so that lambda > 0 increases g; a surface has
 * lambda > 0 (g the gap) and a rope lambda < 0 (g the excess of its path over its length). The unknown of a
 * slipping slide is the force f along +q, with f + slip mu_k pull N = 0. Points, arms and forces of the ports
 * are in the world, arms from the O of their link.
 *
 * Checked by Newton's and Euler's equations of each body with the computed forces, and by differences of the
 * rates, in random trees with loops (tests/unit/test_tree.c), and with dependent rows (test_couplings.c).
 *
 * D is not the diagonal of S, which vanishes with the slope of a row: then the damping would vanish exactly
 * where it is needed. It is the diagonal that the rows of a coupling could have at other positions
 * (tree_scales.c).
 */
#include <float.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/tree_unknowns.h"
#include "numeric/tolerances.h"

/* ---- L D U in the envelope: row i from column first[i], column i from row first[i]; rows and columns are
 * places in the order of elimination (model/coupling_order.c), of the active unknowns */

/* A row with a smaller relative diagonal, as of a rod on the axis of a pivot, is immovable and has no
 * multiplier, which would be rounding. */
static const double nothing = 1e-15;

/* The relative pivot below which a row is weak: the shifts of earlier rows add to it. */
static const double weak_share = 1e-4;

/* Does a motion remain that no inertia resists? Its accelerations are not finite then. */
static bool has_no_inertia(const struct tree *tree, int unknown, double pivot)
{
    const double nothing_left = 1e-11;
    return -pivot * massless_of(tree, unknown)->added <= nothing_left;
}

/* As modes are tried, constraints that give a coordinate its inertia are loose, and this share of the added
 * one remains in place of none. With all of it a pulley without mass would take a moment to be accelerated, and
 * its ropes would become slack in other modes than those of the motion; forces of sticking friction do not
 * depend on it. */
static void keep_some_inertia(struct tree_work *work, int unknown)
{
    const double kept = 1e-6;
    work->scale[unknown] = kept / work->unmoved->added;
    work->diagonal[unknown] -= work->scale[unknown];
}

/* Factor row and column j up to the diagonal, given those before. */
static void factor_row(const struct tree *tree, struct tree_work *work, int j, double epsilon)
{
    const int *first = work->first, unknown = work->unknown_at[j];
    double shift = epsilon * work->scale[unknown], pivot = work->diagonal[unknown] + shift;
    for (int i = first[j]; i < j; i++) {
        double *lower = system_entry(work, work->lower, j, i), *upper = system_entry(work, work->upper, j, i);
        for (int k = first[i] > first[j] ? first[i] : first[j]; k < i; k++) {
            *upper -= *system_entry(work, work->lower, i, k) * *system_entry(work, work->upper, j, k);
            if (!system_has_paths(tree, work))
                *lower -= *system_entry(work, work->lower, j, k) * *system_entry(work, work->upper, i, k);
        }
        *lower = work->inverse[i] * (system_has_paths(tree, work) ? *upper : *lower);
        pivot -= *lower * *upper;
    }
    /* The diagonal of a friction is 1 plus the response of its normal force, which may be less than -1; that
     * of a surface with friction includes the response to that friction, and may be negative (Painleve). */
    bool movable = !unknown_is_row(tree, unknown) || fabs(work->diagonal[unknown]) > nothing * work->most;
    work->inverse[j] = movable && pivot != 0 ? 1 / pivot : 0;
    if (unknown_is_massless(tree, unknown) && has_no_inertia(tree, unknown, pivot)) {
        work->unmoved = massless_of(tree, unknown);
        if (work->tentative) keep_some_inertia(work, unknown);
        work->inverse[j] = work->tentative ? -1 / work->scale[unknown] : NAN;
    }
    if (!unknown_is_row(tree, unknown)) return;
    work->rows[unknown].redundant = !movable || !(fabs(pivot) > 10 * shift);
    work->rows[unknown].weak = !movable || !(fabs(pivot) > weak_share / shift_of_rows * shift);
}

/* rest = right - S z. */
static void rest_of(const struct tree_work *work, const double *right, const double *z, double *rest)
{
    const double *lower = work->whole, *upper = lower + work->envelope_size, *diagonal = work->diagonal;
    for (int j = 0; j < work->count; j++) {
        rest[j] = right[j] - diagonal[work->unknown_at[j]] * z[j];
        for (int k = work->first[j]; k < j; k++) {
            rest[j] -= system_value(work, lower, j, k) * z[k];
            rest[k] -= system_value(work, upper, j, k) * z[j];
        }
    }
}

static void substitute(const struct tree_work *work, double *z)
{
    int m = work->count;
    for (int j = 0; j < m; j++)
        for (int k = work->first[j]; k < j; k++) z[j] -= *system_entry(work, work->lower, j, k) * z[k];
    for (int j = m - 1; j >= 0; j--) {
        z[j] *= work->inverse[j];
        for (int k = work->first[j]; k < j; k++) z[k] -= *system_entry(work, work->upper, j, k) * z[j];
    }
}

static double largest(const double *values, int count)
{
    double most = 0;
    for (int j = 0; j < count; j++) most = fmax(most, fabs(values[j]));
    return most;
}

static void solve(struct tree_work *work, double *unknowns)
{
    enum { least_corrections = 2, most_corrections = 8 };
    int m = work->count, corrections = work->projecting || work->direct ? 0 : most_corrections;
    double *right = work->right, *rest = work->rest, *z = work->ordered;
    for (int p = 0; p < m; p++) z[p] = right[p] = unknowns[work->unknown_at[p]];
    substitute(work, z);
    for (int pass = 0; pass < corrections; pass++) {
        rest_of(work, right, z, rest);
        if (pass >= least_corrections && largest(rest, m) <= evaluation_rounding * largest(right, m)) break;
        substitute(work, rest);
        for (int j = 0; j < m; j++) z[j] += rest[j];
    }
    for (int p = 0; p < m; p++) unknowns[work->unknown_at[p]] = z[p];
}

static void copy_system(struct tree_work *work)
{
    size_t bytes = work->envelope_size * sizeof *work->lower;
    memcpy(work->lower, work->whole, bytes);
    memcpy(work->upper, work->whole + work->envelope_size, bytes);
}

static void factor_shifted(const struct tree *tree, struct tree_work *work, double epsilon)
{
    copy_system(work);
    for (int j = 0; j < work->count; j++) factor_row(tree, work, j, epsilon);
}

/* If no row is weak S is positive definite without a shift, and elimination without pivoting is stable for it
 * (N. J. Higham, Accuracy and Stability of Numerical Algorithms, SIAM 2002, 10.1), so that no corrections are
 * needed. Tried in steps, and elsewhere for few rows; false if some row is weak. */
static bool factor_as_it_stands(const struct tree *tree, struct tree_work *work)
{
    enum { few = 8 };
    bool steps = work->rates_only && system_has_paths(tree, work);
    if (work->projecting || !work->symmetric || (!steps && work->count > few)) return false;
    copy_system(work);
    for (int j = 0; j < work->count; j++) {
        factor_row(tree, work, j, 0);
        if (!(work->inverse[j] > 0 && work->inverse[j] * weak_share * work->scale[work->unknown_at[j]] < 1))
            return false;
    }
    return true;
}

void tree_system_refactor(const struct tree *tree, struct tree_work *work)
{
    work->unmoved = NULL;
    work->direct = factor_as_it_stands(tree, work);
    /* A projection must not change the state by much to satisfy a row without slope. */
    if (!work->direct) factor_shifted(tree, work, work->projecting ? work->damping : shift_of_rows);
}

void tree_system_factor(const struct fbd_model *model, const struct instant *at)
{
    tree_system_assemble(model, at);
    tree_system_refactor(model->tree, at->tree);
}

/* The residual of a massless coordinate; its scale is by keep_some_inertia. */
static double massless_answer(const struct tree *tree, const struct tree_work *work, int j, double f)
{
    const struct tree_massless *of = massless_of(tree, j);
    return work->unit[tree->links[of->link].coordinate + of->local] - f * (1 / of->added + work->scale[j]);
}

/* For a light body the rounding of a force is an acceleration that violates its rows. Solve for the residual
 * of the accelerations, and add the resulting accelerations rather than the forces, whose sum would be
 * rounded again. */
static void refine(const struct fbd_model *model, const struct instant *at, double *z)
{
    enum { passes = 2 };
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    const size_t links = (size_t)tree->count, n = (size_t)model->plan.n;
    double *left = work->left;
    for (int pass = 0; pass < passes; pass++) {
        memcpy(work->sum, work->x, links * sizeof *work->sum);
        memcpy(work->sum_unit, work->unit, n * sizeof *work->sum_unit);
        for (int j = 0; j < tree_unknowns(tree); j++)
            left[j] = work->place[j] < 0             ? 0
                      : unknown_is_row(tree, j)      ? work->wanted[j] - tree_row_answer(work, j)
                      : unknown_is_massless(tree, j) ? work->wanted[j] - massless_answer(tree, work, j, z[j])
                                                     : 0;
        solve(work, left);
        tree_system_answer(model, at, left);
        for (size_t i = 0; i < links; i++) {
            struct tree_rhs *x = &work->x[i];
            const struct tree_rhs *sum = &work->sum[i];
            x->p = (struct wrench){x->p.moment + sum->p.moment, vec_add(x->p.force, sum->p.force)};
            x->A = (struct acceleration){x->A.alpha + sum->A.alpha, vec_add(x->A.a, sum->A.a)};
        }
        for (size_t i = 0; i < n; i++) work->unit[i] += work->sum_unit[i];
        for (int j = 0; j < tree_unknowns(tree); j++) z[j] += left[j];
    }
}

void tree_system_solve(const struct fbd_model *model, const struct instant *at, double *z)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    int m = tree_unknowns(tree);
    for (int k = 0; k < m; k++)
        if (work->place[k] < 0) z[k] = 0;
    memcpy(work->wanted, z, (size_t)m * sizeof *z);
    solve(work, z);
    tree_system_answer(model, at, z);
    if (work->count > 0 && work->apart && !work->projecting) refine(model, at, z);
}
