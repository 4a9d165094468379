/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Multipliers: M a = tau + J^T lambda with J a = gamma.
 *
 * The accelerations a_0 without constraints leave g'' = g''_0 in each row; the multipliers make up for it,
 * S lambda = -g''_0 with S = J M^-1 J^T. A column of S is the answer of the trees that a row joins to its
 * unit force, by the recursion; rows that join no common tree do not meet, and S is kept in its envelope: a
 * chain of loops whose rows are numbered along it costs time in proportion to its length.
 *
 * Dry friction of slides that slip is in the same system: tau_k + c_k N_k = 0, with N_k the normal force, on
 * which all multipliers and all other frictions bear. So it is not symmetric, and is factored as L D U in its
 * envelope (Duff, Erisman and Reid, Direct Methods for Sparse Matrices, chapter 8), without pivoting: S is
 * positive definite, and friction shifts it by less than its diagonal.
 *
 * Where a row says nothing that others do not say, always or in passing (all bars of a parallelogram in one
 * line), S is singular. So what is factored is S + epsilon diag(S), and two corrections by what is left over
 * of the true system make up for it: a direction of S with the relative size s comes out right to (epsilon /
 * (epsilon + s))^3, which is rounding for s > 1e-3; multipliers of a redundant row are those of the least
 * norm; and near a singular position everything stays smooth, so that motion passes it. (The augmented
 * Lagrangian method of Bayo and Ledesma, Nonlinear Dynamics 9, 1996, does the same.)
 */
#include <float.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/tree_system.h"

/* ---- the unknowns: rows of ties, then frictions of slides */

int tree_unknowns(const struct tree *tree)
{
    return tree->row_count + tree->pair_count;
}

static bool is_row(const struct tree *tree, int k)
{
    return k < tree->row_count;
}

/* Does unknown k take part in the present modes? */
bool tree_takes_part(const struct tree *tree, const struct instant *at, int k)
{
    if (!is_row(tree, k)) {
        int link = tree->pairs[k - tree->row_count];
        return !at->tree->projecting && at->slip[tree->links[link].pair] != stick;
    }
    const struct tie *tie = &tree->ties[tree->tie_of_row[k]];
    bool has_mode = tie->kind == constraint_rope || (tie->pair >= 0 && k == tie->first_row + 1);
    return !has_mode || at->slip[tie->pair] == stick;
}

/* ---- forces of an unknown on the links */

static void apply_ports(const struct row *row, double lambda, struct tree_rhs *x)
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

/* The friction of a rolling body that slips, per normal force: -slip mu_k along its line; 0 when it does not.
 */
static double rolling_share(const struct fbd_model *model, const struct instant *at, int k)
{
    const struct tie *tie = &model->tree->ties[model->tree->tie_of_row[k]];
    if (tie->kind != constraint_roll || at->tree->projecting || tie->pair < 0 || k != tie->first_row ||
        at->slip[tie->pair] == stick)
        return 0;
    return -at->slip[tie->pair] * formula_value(&model->plan.frictions[tie->pair].mu_k, at);
}

static void apply_unknown(const struct fbd_model *model, const struct instant *at, int k, double size)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    if (!is_row(tree, k)) {
        work->x[tree->pairs[k - tree->row_count]].g += size;
        return;
    }
    apply_ports(&work->rows[k], size, work->x);
    double share = rolling_share(model, at, k);
    if (share != 0) apply_ports(&work->rows[k + 1], share * size, work->x);
}

/* The trees that unknown k joins: their first links. */
static int roots_of(const struct tree *tree, int k, const int **roots)
{
    if (!is_row(tree, k)) {
        *roots = &tree->links[tree->pairs[k - tree->row_count]].root;
        return 1;
    }
    const struct tie *tie = &tree->ties[tree->tie_of_row[k]];
    *roots = tie->root;
    return tie->root_count;
}

static void clear_range(struct tree_rhs *x, int from, int to)
{
    memset(&x[from], 0, (size_t)(to - from) * sizeof *x);
}

/* The answer of its trees to unknown k alone. */
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
    apply_unknown(model, at, k, 1);
    for (int i = 0; i < count; i++) {
        tree_inward(tree, work, roots[i], tree->links[roots[i]].end);
        tree_outward(tree, work, roots[i], tree->links[roots[i]].end, work->unit);
    }
}

/* Row j of the system for the answer to unknown k. */
static double entry(const struct fbd_model *model, const struct instant *at, int j, int k)
{
    const struct tree *tree = model->tree;
    if (is_row(tree, j)) return row_answer(at->tree, tree, &at->tree->rows[j], k + 1);
    int link = tree->pairs[j - tree->row_count];
    if (at->tree->mark[tree->links[link].root] != k + 1) return j == k;
    return tree_slip_share(model, at, link) * tree_normal_in(tree, at->tree, link) + (j == k);
}

/* ---- L D U in the envelope: row i from column first[i], column i from row first[i] */

/* Entry k of the row or column j, which is kept from `from` on. */
static double *entry_of(const struct tree *tree, double *kept, int j, int k)
{
    return &kept[tree->envelope[j] + (size_t)(k - tree->first[j])];
}

/* Row and column j up to the diagonal, given those before. */
static void factor_row(const struct tree *tree, struct tree_work *work, int j, double epsilon)
{
    const int *first = tree->first;
    double pivot = work->diagonal[j] * (1 + epsilon);
    for (int i = first[j]; i < j; i++) {
        double *lower = entry_of(tree, work->lower, j, i), *upper = entry_of(tree, work->upper, j, i);
        for (int k = first[i] > first[j] ? first[i] : first[j]; k < i; k++) {
            *upper -= *entry_of(tree, work->lower, i, k) * *entry_of(tree, work->upper, j, k);
            *lower -= *entry_of(tree, work->lower, j, k) * *entry_of(tree, work->upper, i, k);
        }
        *lower *= work->inverse[i];
        pivot -= *lower * *upper;
    }
    if (j < tree->row_count) work->rows[j].redundant = !(pivot > 10 * epsilon * work->diagonal[j]);
    bool immovable = !(work->diagonal[j] > work->least);
    work->inverse[j] = immovable ? 0 : 1 / pivot;
    if (immovable && j < tree->row_count) work->rows[j].redundant = true;
}

static void keep(const struct tree *tree, struct tree_work *work)
{
    size_t bytes = tree->envelope_size * sizeof *work->lower, m = (size_t)tree_unknowns(tree);
    memcpy(work->whole, work->lower, bytes);
    memcpy(work->whole + tree->envelope_size, work->upper, bytes);
    memcpy(work->whole + 2 * tree->envelope_size, work->diagonal, m * sizeof *work->diagonal);
}

/* rest = right - S z. */
static void rest_of(const struct tree *tree, const struct tree_work *work, const double *right,
                    const double *z, double *rest)
{
    double *lower = work->whole, *upper = lower + tree->envelope_size,
           *diagonal = upper + tree->envelope_size;
    int m = tree_unknowns(tree);
    for (int j = 0; j < m; j++) {
        rest[j] = right[j] - diagonal[j] * z[j];
        for (int k = tree->first[j]; k < j; k++) {
            rest[j] -= *entry_of(tree, lower, j, k) * z[k];
            rest[k] -= *entry_of(tree, upper, j, k) * z[j];
        }
    }
}

static void substitute(const struct tree *tree, const struct tree_work *work, double *z)
{
    int m = tree_unknowns(tree);
    for (int j = 0; j < m; j++)
        for (int k = tree->first[j]; k < j; k++) z[j] -= *entry_of(tree, work->lower, j, k) * z[k];
    for (int j = m - 1; j >= 0; j--) {
        z[j] *= work->inverse[j];
        for (int k = tree->first[j]; k < j; k++) z[k] -= *entry_of(tree, work->upper, j, k) * z[j];
    }
}

static void solve(const struct tree *tree, struct tree_work *work, double *z)
{
    int m = tree_unknowns(tree), corrections = work->projecting ? 0 : 2;
    size_t bytes = (size_t)m * sizeof *z;
    double *right = work->right, *rest = work->rest;
    memcpy(right, z, bytes);
    substitute(tree, work, z);
    for (int pass = 0; pass < corrections; pass++) {
        rest_of(tree, work, right, z, rest);
        substitute(tree, work, rest);
        for (int j = 0; j < m; j++) z[j] += rest[j];
    }
}

void tree_system_factor(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    int m = tree_unknowns(tree);
    memset(work->lower, 0, tree->envelope_size * sizeof *work->lower);
    memset(work->upper, 0, tree->envelope_size * sizeof *work->upper);
    memset(work->mark, 0, (size_t)tree->count * sizeof *work->mark);
    for (int k = 0; k < m; k++) {
        bool part = tree_takes_part(tree, at, k);
        if (part) answer_unit(model, at, k);
        /* Column k meets rows j whose envelope reaches it, and those in its own. */
        for (int j = tree->first[k]; j < m && j < tree->reach[k]; j++) {
            bool both = part && tree_takes_part(tree, at, j);
            double value = both ? entry(model, at, j, k) : j == k;
            if (j < k) *entry_of(tree, work->upper, k, j) = value;
            if (j == k) work->diagonal[k] = value;
            if (j > k && tree->first[j] <= k) *entry_of(tree, work->lower, j, k) = value;
        }
    }
    /* A projection must not throw the state about for what a row with no slope has left. */
    const double epsilon = work->projecting ? work->damping : 1e-8;
    keep(tree, work);
    /* A row that nothing can move, as a rod on the axis of a pivot, has no multiplier. */
    work->least = 0;
    for (int j = 0; j < tree->row_count; j++)
        if (tree_takes_part(tree, at, j)) work->least = fmax(work->least, 1e-15 * work->diagonal[j]);
    for (int j = 0; j < m; j++) factor_row(tree, work, j, epsilon);
}

void tree_system_solve(const struct fbd_model *model, const struct instant *at, double *z)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    int m = tree_unknowns(tree);
    for (int k = 0; k < m; k++)
        if (!tree_takes_part(tree, at, k)) z[k] = 0;
    solve(tree, work, z);
    clear_range(work->x, 0, tree->count);
    for (int k = 0; k < m; k++)
        if (z[k] != 0) apply_unknown(model, at, k, z[k]);
    tree_inward(tree, work, 1, tree->count);
    tree_outward(tree, work, 1, tree->count, work->unit);
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

void tree_take_multipliers(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) work->rows[j].lambda = work->z[j];
    for (int i = 0; i < tree->tie_count; i++) {
        int j = tree->ties[i].first_row;
        if (tree->ties[i].kind != constraint_roll) continue;
        if (tree->ties[i].pair >= 0 && at->slip[tree->ties[i].pair] != stick)
            work->rows[j + 1].lambda = rolling_share(model, at, j) * work->z[j];
    }
}

void tree_apply_variations(const struct fbd_model *model, const struct instant *at,
                           const struct direction *along)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) apply_ports_along(&work->rows[j], work->x);
    for (int i = 0; i < tree->tie_count; i++) {
        const struct tie *tie = &tree->ties[i];
        if (tie->kind != constraint_roll || tie->pair < 0 || at->slip[tie->pair] == stick) continue;
        double d_mu;
        formula_along(&model->plan.frictions[tie->pair].mu_k, at, along, &d_mu);
        apply_ports(&work->rows[tie->first_row + 1],
                    -at->slip[tie->pair] * d_mu * work->rows[tie->first_row].lambda, work->x);
    }
}
