/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Multipliers: M a = tau + J^T lambda with J a = gamma.
 *
 * The accelerations a_0 without constraints leave g'' = g''_0 in each row; the multipliers compensate it, S
 * lambda = -g''_0 with S = J M^-1 J^T. A column of S is the response of the trees that a row joins to its
 * unit force, by the recursion; rows without a common tree have a zero entry, and S is kept in its envelope:
 * a chain of loops whose rows are numbered along it takes time proportional to its length.
 *
 * Dry friction of slipping slides is in the same system: tau_k + c_k N_k = 0, with N_k the normal force,
 * which depends on all multipliers and all other frictions. So the matrix is not symmetric, and is factored
 * as L D U in its envelope (Duff, Erisman and Reid, Direct Methods for Sparse Matrices, chapter 8), without
 * pivoting: S is positive definite, and the corrections below compensate the rounding by small pivots of
 * friction.
 *
 * Where rows are linearly dependent, always or at some positions (all bars of a parallelogram in one line), S
 * is singular. So S + epsilon D is factored, and the solution is corrected by the residual of the true
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
#include "dynamics/friction.h"
#include "dynamics/tree_system.h"

/* ---- the unknowns: rows of couplings, then frictions of slides */

int tree_unknowns(const struct tree *tree)
{
    return tree->row_count + tree->pair_count;
}

static bool is_row(const struct tree *tree, int k)
{
    return k < tree->row_count;
}

/* The row normal to a surface is active while it is closed, the row along it while it sticks. */
static bool contact_takes_part(const struct coupling *coupling, const struct instant *at, int k)
{
    if (at->slip[coupling->surface] != stick) return false;
    return k == coupling->first_row ||
           (coupling->pair >= 0 && at->slip[coupling->pair] == stick && !at->tree->settling_down);
}

/* Is unknown k active in the present modes? */
bool tree_takes_part(const struct tree *tree, const struct instant *at, int k)
{
    if (!is_row(tree, k)) {
        int link = tree->pairs[k - tree->row_count];
        return !at->tree->projecting && at->slip[tree->links[link].pair] != stick;
    }
    const struct coupling *coupling = &tree->couplings[tree->coupling_of_row[k]];
    if (coupling->kind == constraint_contact) return contact_takes_part(coupling, at, k);
    bool has_mode =
        coupling->kind == constraint_rope || (coupling->pair >= 0 && k == coupling->first_row + 1);
    int surface = coupling->surface >= 0 ? at->slip[coupling->surface] : stick;
    bool open = surface != stick &&
                (surface != loose || k == coupling->first_row); /* rolling without friction continues */
    return !open && (!has_mode || at->slip[coupling->pair] == stick);
}

/* ---- forces of an unknown on the links */

void row_apply(const struct row *row, double lambda, struct tree_rhs *x)
{
    for (int i = 0; i < row->port_count; i++) {
        const struct port *port = &row->ports[i];
        struct wrench *p = &x[port->link].p;
        p->force = vec_sub(p->force, vec_scale(lambda, port->force));
        p->moment -= lambda * vec_cross(port->arm, port->force);
    }
}

static void apply_ports_along(const struct row *row, struct tree_rhs *x)
{
    for (int i = 0; i < row->port_count; i++) {
        const struct port *port = &row->ports[i];
        struct wrench *p = &x[port->link].p;
        p->force = vec_sub(p->force, vec_scale(row->lambda, port->d_force));
        p->moment -=
            row->lambda * (vec_cross(port->d_arm, port->force) + vec_cross(port->arm, port->d_force));
    }
}

/* J a for the accelerations x.A of links whose tree is marked. */
static double row_answer(const struct tree_work *work, const struct tree *tree, const struct row *row,
                         int mark)
{
    double sum = 0;
    for (int i = 0; i < row->port_count; i++) {
        const struct port *port = &row->ports[i];
        const struct acceleration *A = &work->x[port->link].A;
        if (port->link == 0 || work->mark[tree->links[port->link].root] != mark) continue;
        sum += vec_dot(port->force, A->a) + vec_cross(port->arm, port->force) * A->alpha;
    }
    return sum;
}

/* Does it slip on its surface with friction? */
static bool is_rubbing(const struct coupling *coupling, const struct instant *at)
{
    return coupling->law->surface && coupling->pair >= 0 && slip_side(at->slip[coupling->pair]) != 0 &&
           (coupling->surface < 0 || at->slip[coupling->surface] == stick);
}

/* The friction of a body that slips on a surface, per normal force: -slip mu_k along its line; 0 if it does
 * not slip. */
double tree_rubbing_share(const struct fbd_model *model, const struct instant *at, int k)
{
    const struct coupling *coupling = &model->tree->couplings[model->tree->coupling_of_row[k]];
    if (at->tree->projecting || k != coupling->first_row || !is_rubbing(coupling, at)) return 0;
    const struct formula *mu = &model->plan.modes[coupling->pair].mu_k;
    return -at->slip[coupling->pair] * at->pull[coupling->pair] *
           friction_coefficient(model, coupling->pair, mu, at, NULL, NULL);
}

/* Returns whether the unknown is one row only; with slip the friction acts along another. */
static bool apply_unknown(const struct fbd_model *model, const struct instant *at, int k, double size)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    if (!is_row(tree, k)) {
        work->x[tree->pairs[k - tree->row_count]].g += size;
        return false;
    }
    row_apply(&work->rows[k], size, work->x);
    double share = tree_rubbing_share(model, at, k);
    if (share != 0) row_apply(&work->rows[k + 1], share * size, work->x);
    return share == 0;
}

/* The trees that unknown k joins: their first links. */
static int roots_of(const struct tree *tree, int k, const int **roots)
{
    if (!is_row(tree, k)) {
        *roots = &tree->links[tree->pairs[k - tree->row_count]].root;
        return 1;
    }
    const struct coupling *coupling = &tree->couplings[tree->coupling_of_row[k]];
    *roots = coupling->root;
    return coupling->root_count;
}

static void clear_range(struct tree_rhs *x, int from, int to)
{
    memset(&x[from], 0, (size_t)(to - from) * sizeof *x);
}

/* The response of the trees to unknown k. */
static void answer_unit(const struct fbd_model *model, const struct instant *at, int k)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    const int *roots;
    int count = roots_of(tree, k, &roots);
    for (int i = 0; i < count; i++) {
        clear_range(work->x, roots[i], tree->links[roots[i]].end);
        work->mark[roots[i]] = k + 1;
    }
    work->symmetric &= apply_unknown(model, at, k, 1);
    for (int i = 0; i < count; i++) {
        tree_inward(tree, work, roots[i], tree->links[roots[i]].end);
        tree_outward(tree, work, roots[i], tree->links[roots[i]].end, work->unit);
    }
}

/* Row j of the system for the response to unknown k. */
static double entry(const struct fbd_model *model, const struct instant *at, int j, int k)
{
    const struct tree *tree = model->tree;
    if (is_row(tree, j)) return row_answer(at->tree, tree, &at->tree->rows[j], k + 1);
    int link = tree->pairs[j - tree->row_count];
    if (at->tree->mark[tree->links[link].root] != k + 1) return j == k;
    return tree_slip_share(model, at, link) * tree_normal_in(tree, at->tree, link) + (j == k);
}

/* ---- L D U in the envelope: row i from column first[i], column i from row first[i]; rows and columns are
 * places in the order of elimination (model/coupling_order.c), of the active unknowns */

/* Number the active unknowns. Open contacts and slipping friction have no cost in the following. */
static void set_places(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) work->rows[j].redundant = work->rows[j].weak = false;
    if (work->placed) return;
    int count = 0, all = tree_unknowns(tree);
    size_t size = 0;
    for (int p = 0; p < all; p++) {
        int k = tree->unknown_at[p];
        work->rank[p] = count;
        work->place[k] = -1;
        work->diagonal[k] = 1;
        if (!tree_takes_part(tree, at, k)) continue;
        work->place[k] = count;
        work->unknown_at[count] = k;
        work->first[count] = work->rank[tree->first[p]];
        work->reach[count] = tree->reach[p];
        work->envelope[count] = size;
        size += (size_t)(count - work->first[count]);
        count++;
    }
    work->rank[all] = count;
    for (int r = 0; r < count; r++) work->reach[r] = work->rank[work->reach[r]];
    work->count = count;
    work->envelope_size = size;
    work->placed = model->plan.mode_count == 0;
}

/* Entry k of the row or column j, stored from column or row first[j]. */
static double *entry_of(const struct tree_work *work, double *kept, int j, int k)
{
    return &kept[work->envelope[j] + (size_t)(k - work->first[j])];
}

static double entry_in(const struct tree_work *work, const double *kept, int j, int k)
{
    return kept[work->envelope[j] + (size_t)(k - work->first[j])];
}

/* A row with a smaller relative diagonal, as of a rod on the axis of a pivot, is immovable and has no
 * multiplier, which would be rounding. */
static const double nothing = 1e-15;

/* Epsilon of the header, and the relative pivot below which a row is weak: the shifts of earlier rows add to
 * it. */
static const double shift_of_rows = 1e-8, weak_share = 1e-4;

/* Factor row and column j up to the diagonal, given those before. */
static void factor_row(const struct tree *tree, struct tree_work *work, int j, double epsilon)
{
    const int *first = work->first, unknown = work->unknown_at[j];
    double shift = epsilon * work->scale[unknown], pivot = work->diagonal[unknown] + shift;
    for (int i = first[j]; i < j; i++) {
        double *lower = entry_of(work, work->lower, j, i), *upper = entry_of(work, work->upper, j, i);
        for (int k = first[i] > first[j] ? first[i] : first[j]; k < i; k++) {
            *upper -= *entry_of(work, work->lower, i, k) * *entry_of(work, work->upper, j, k);
            *lower -= *entry_of(work, work->lower, j, k) * *entry_of(work, work->upper, i, k);
        }
        *lower *= work->inverse[i];
        pivot -= *lower * *upper;
    }
    /* The diagonal of a friction is 1 plus the response of its normal force, which may be less than -1; that
     * of a surface with friction includes the response to that friction, and may be negative (Painleve). */
    bool movable = !is_row(tree, unknown) || fabs(work->diagonal[unknown]) > nothing * work->most;
    work->inverse[j] = movable && pivot != 0 ? 1 / pivot : 0;
    if (!is_row(tree, unknown)) return;
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
            rest[j] -= entry_in(work, lower, j, k) * z[k];
            rest[k] -= entry_in(work, upper, j, k) * z[j];
        }
    }
}

static void substitute(const struct tree_work *work, double *z)
{
    int m = work->count;
    for (int j = 0; j < m; j++)
        for (int k = work->first[j]; k < j; k++) z[j] -= *entry_of(work, work->lower, j, k) * z[k];
    for (int j = m - 1; j >= 0; j--) {
        z[j] *= work->inverse[j];
        for (int k = work->first[j]; k < j; k++) z[k] -= *entry_of(work, work->upper, j, k) * z[j];
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
        if (pass >= least_corrections && largest(rest, m) <= 1e-14 * largest(right, m)) break;
        substitute(work, rest);
        for (int j = 0; j < m; j++) z[j] += rest[j];
    }
    for (int p = 0; p < m; p++) unknowns[work->unknown_at[p]] = z[p];
}

static void assemble(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    set_places(model, at);
    double *lower = work->whole, *upper = lower + work->envelope_size;
    memset(lower, 0, 2 * work->envelope_size * sizeof *lower);
    memset(work->mark, 0, (size_t)tree->count * sizeof *work->mark);
    work->symmetric = true;
    for (int p = 0; p < work->count; p++) {
        int k = work->unknown_at[p];
        answer_unit(model, at, k);
        /* Column p has entries in rows q whose envelope contains it, and in its own envelope. */
        for (int q = work->first[p]; q < work->reach[p]; q++) {
            double value = entry(model, at, work->unknown_at[q], k);
            if (q < p) *entry_of(work, upper, p, q) = value;
            if (q == p) work->diagonal[k] = value;
            if (q > p && work->first[q] <= p) *entry_of(work, lower, q, p) = value;
        }
    }
    tree_set_scales(tree, work);
}

static void factor_shifted(const struct tree *tree, struct tree_work *work, double epsilon)
{
    size_t bytes = work->envelope_size * sizeof *work->lower;
    memcpy(work->lower, work->whole, bytes);
    memcpy(work->upper, work->whole + work->envelope_size, bytes);
    for (int j = 0; j < work->count; j++) factor_row(tree, work, j, epsilon);
}

/* If no row is weak S is positive definite without a shift, and elimination without pivoting is stable for it
 * (N. J. Higham, Accuracy and Stability of Numerical Algorithms, SIAM 2002, 10.1), so that no corrections are
 * needed. Tried for few rows; false if some row is weak. */
static bool factor_as_it_stands(const struct tree *tree, struct tree_work *work)
{
    enum { few = 8 };
    if (!work->symmetric || work->count > few) return false;
    factor_shifted(tree, work, 0);
    for (int j = 0; j < work->count; j++)
        if (!(work->inverse[j] > 0 && work->inverse[j] * weak_share * work->scale[work->unknown_at[j]] < 1))
            return false;
    return true;
}

void tree_system_refactor(const struct tree *tree, struct tree_work *work)
{
    work->direct = !work->projecting && factor_as_it_stands(tree, work);
    /* A projection must not change the state by much to satisfy a row without slope. */
    if (!work->direct) factor_shifted(tree, work, work->projecting ? work->damping : shift_of_rows);
}

void tree_system_factor(const struct fbd_model *model, const struct instant *at)
{
    assemble(model, at);
    tree_system_refactor(model->tree, at->tree);
}

double tree_row_answer(const struct tree_work *work, int j)
{
    const struct row *row = &work->rows[j];
    double sum = 0;
    for (int i = 0; i < row->port_count; i++) {
        const struct port *port = &row->ports[i];
        const struct acceleration *A = &work->x[port->link].A;
        if (port->link == 0) continue;
        sum += vec_dot(port->force, A->a) + vec_cross(port->arm, port->force) * A->alpha;
    }
    return sum;
}

/* The response of the trees to all unknowns. */
static void answer_all(const struct fbd_model *model, const struct instant *at, const double *z)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    clear_range(work->x, 0, tree->count);
    for (int k = 0; k < tree_unknowns(tree); k++)
        if (z[k] != 0) apply_unknown(model, at, k, z[k]);
    tree_inward(tree, work, 1, tree->count);
    tree_outward(tree, work, 1, tree->count, work->unit);
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
            left[j] = is_row(tree, j) && work->place[j] >= 0 ? work->wanted[j] - tree_row_answer(work, j) : 0;
        solve(work, left);
        answer_all(model, at, left);
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
    answer_all(model, at, z);
    if (work->apart && !work->projecting) refine(model, at, z);
}

void tree_take_multipliers(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) work->rows[j].lambda = work->z[j];
    for (int i = 0; i < tree->coupling_count; i++) {
        int j = tree->couplings[i].first_row;
        if (is_rubbing(&tree->couplings[i], at))
            work->rows[j + 1].lambda = tree_rubbing_share(model, at, j) * work->z[j];
    }
}

void tree_apply_variations(const struct fbd_model *model, const struct instant *at,
                           const struct direction *along)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) apply_ports_along(&work->rows[j], work->x);
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (!is_rubbing(coupling, at)) continue;
        double d_mu;
        friction_coefficient(model, coupling->pair, &model->plan.modes[coupling->pair].mu_k, at, along,
                             &d_mu);
        row_apply(&work->rows[coupling->first_row + 1],
                  -at->slip[coupling->pair] * at->pull[coupling->pair] * d_mu *
                      work->rows[coupling->first_row].lambda,
                  work->x);
    }
}
