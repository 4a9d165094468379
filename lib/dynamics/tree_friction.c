/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction of slides between jointed bodies while they slip. It goes with the normal force, and the normal
 * forces of all slides of the tree go with it: tau_j = -c_j (N_j + sum_k A_jk tau_k), linear in the tau. A
 * comes from one solution for each slide with a unit force in its joint.
 */
#include <string.h>

#include "dynamics/friction.h"
#include "dynamics/tree.h"

bool tree_slips(const struct tree *tree, const struct instant *at)
{
    for (int k = 0; k < tree->pair_count; k++)
        if (at->slip[tree->links[tree->pairs[k]].pair] != stick) return true;
    return false;
}

double tree_slip_share(const struct fbd_model *model, const struct instant *at, int i)
{
    int pair = model->tree->links[i].pair;
    if (at->slip[pair] == stick) return 0;
    return at->slip[pair] * at->pull[pair] * formula_value(&model->plan.frictions[pair].mu_k, at);
}

struct vec tree_normal(const struct tree *tree, const struct tree_work *work, int i)
{
    return vec_turn(work->links[tree->links[i].parent].turn, tree->links[i].n);
}

double tree_normal_in(const struct tree *tree, const struct tree_work *work, int i)
{
    struct wrench F = inertia_wrench(&work->links[i].I, work->x[i].A, work->x[i].p);
    return vec_dot(tree_normal(tree, work, i), F.force);
}

static void clear(const struct tree *tree, struct tree_rhs *x)
{
    memset(x, 0, (size_t)tree->count * sizeof *x);
}

/* Gaussian elimination with partial pivoting of the m x m system behind whose rows the right-hand side
 * stands. A singular one (friction that wedges itself) gives what is not finite, and that stops the run. */
static void eliminate(double *rows, int m)
{
    int width = m + 1;
    for (int k = 0; k < m; k++) {
        int best = k;
        for (int i = k + 1; i < m; i++)
            if (fabs(rows[i * width + k]) > fabs(rows[best * width + k])) best = i;
        for (int j = 0; j < width && best != k; j++) {
            double swap = rows[k * width + j];
            rows[k * width + j] = rows[best * width + j];
            rows[best * width + j] = swap;
        }
        for (int i = 0; i < m; i++) {
            if (i == k) continue;
            double factor = rows[i * width + k] / rows[k * width + k];
            for (int j = k; j < width; j++) rows[i * width + j] -= factor * rows[k * width + j];
        }
    }
    for (int k = 0; k < m; k++) rows[k * width + m] /= rows[k * width + k];
}

/* The column of the system that belongs to the friction of slide k. */
static void set_column(const struct fbd_model *model, const struct instant *at, int k)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    int m = tree->pair_count;
    bool sticks = work->links[tree->pairs[k]].locked;
    if (!sticks) {
        clear(tree, work->x);
        work->x[tree->pairs[k]].g = 1;
        tree_inward(tree, work);
        tree_outward(tree, work, work->unit);
    }
    for (int j = 0; j < m; j++) {
        double response =
            sticks ? 0
                   : tree_slip_share(model, at, tree->pairs[j]) * tree_normal_in(tree, work, tree->pairs[j]);
        work->closure[j * (m + 1) + k] = response + (j == k);
    }
}

void tree_add_frictions(const struct fbd_model *model, const struct instant *at, double *a)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    int m = tree->pair_count;
    for (int k = 0; k < m; k++) set_column(model, at, k);
    eliminate(work->closure, m);
    clear(tree, work->x);
    for (int k = 0; k < m; k++)
        if (!work->links[tree->pairs[k]].locked) work->x[tree->pairs[k]].g = work->closure[k * (m + 1) + m];
    tree_inward(tree, work);
    tree_outward(tree, work, work->unit);
    for (int i = 1; i < tree->count; i++) {
        int first = tree->links[i].coordinate, count = joint_freedom(tree->links[i].kind);
        for (int k = first; k < first + count; k++) a[k] += work->unit[k];
    }
}
