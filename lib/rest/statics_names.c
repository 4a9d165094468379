/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Named results of statics: the indeterminate reactions, and the forces that would balance a scene that is
 * not in equilibrium.
 */
#include <math.h>

#include "fbd_study.h"
#include "model/labels.h"
#include "numeric/qr.h"
#include "numeric/tolerances.h"
#include "rest/statics.h"

/* ---- indeterminate reactions */

/* Does entry i of r change along the null vectors? */
static bool varies(const struct rest_system *system, size_t i)
{
    double most = 0;
    for (size_t k = 0; k < system->basis_count; k++) {
        double sum = 0;
        for (size_t j = 0; j < system->m; j++)
            sum += system->R[j * system->reactions + i] * system->basis[j * system->basis_count + k];
        most = fmax(most, fabs(sum));
    }
    return most > pivoting_difference; /* of the change of all reactions together, 1 */
}

static void add_name(struct fbd_statics *statics, const char *body, const char *name, const char *part)
{
    const char *dot = body[0] ? "." : "";
    statics->undetermined[statics->undetermined_count++] =
        arena_printf(&statics->arena, "%s%s%s%s", body, dot, name, part);
}

static const char *name_of_load(const struct fbd_model *model, const struct model_body *body,
                                enum load_kind kind, const char *otherwise)
{
    for (int i = body->first_load; i < body->first_load + body->load_count; i++)
        if (model->loads[i].source->kind == kind) return model->loads[i].source->name;
    return otherwise;
}

/* Name of the friction or drive that holds the coordinate of a joint. */
static const char *holder_name(const struct fbd_statics *statics, const struct model_body *body)
{
    struct instant at = state_instant(statics->state);
    int pair = rest_holder(statics->model, &at, body->first);
    return pair < 0 ? NULL : statics->model->loads[statics->model->plan.modes[pair].load].source->name;
}

static void name_joint(struct fbd_statics *statics, const struct rest_system *system, int i)
{
    const struct fbd_model *model = statics->model;
    const struct model_body *body = &model->bodies[model->tree->links[i].body];
    size_t entry = 3 * (size_t)(i - 1);
    bool first = varies(system, entry), second = varies(system, entry + 1),
         couple = varies(system, entry + 2);
    const char *holder = holder_name(statics, body);
    if (body->joint->has_axis) {
        if (first || second)
            add_name(statics, body->name, body->joint->force, !second ? " in x" : !first ? " in y" : "");
        if (couple && holder) add_name(statics, body->name, holder, "");
    }
    if (body->joint->path == path_line) {
        const char *across = name_of_load(model, body, load_normal, body->joint->force);
        if (first && holder) add_name(statics, body->name, holder, "");
        if (second) add_name(statics, body->name, across, "");
        if (couple) add_name(statics, body->name, across, " (couple)");
    }
    if (body->joint->prevents_turning && couple && body->reaction)
        add_name(statics, body->name, body->reaction, " (couple)");
}

static void name_coupling(struct fbd_statics *statics, const struct rest_system *system, size_t j)
{
    const struct tree *tree = statics->model->tree;
    int row = system->rows[j];
    const struct coupling *coupling = &tree->couplings[tree->coupling_of_row[row]];
    bool one = varies(system, rest_entry_of_row(system, j));
    const int place = row - coupling->first_row;
    if ((coupling->kind != constraint_pin && coupling->kind != constraint_weld) || place == 2) {
        if (one) add_name(statics, "", coupling_force_name(tree, row), "");
        return;
    }
    if (place > 0) return; /* named with the first row */
    bool other = varies(system, rest_entry_of_row(system, j + 1));
    if (one && other) add_name(statics, "", coupling->name, "");
    if (one != other) add_name(statics, "", coupling_row_name(tree, one ? row : row + 1), "");
}

bool rest_name_undetermined(struct fbd_statics *statics, const struct rest_system *system)
{
    const struct tree *tree = statics->model->tree;
    statics->indeterminacy = system->basis_count;
    if (system->basis_count == 0) return true;
    statics->undetermined = ARENA_ARRAY(&statics->arena, system->reactions + 1, const char *);
    if (!statics->undetermined) return false;
    for (int i = 1; i < tree->joined; i++) name_joint(statics, system, i);
    for (size_t j = 0; j < system->m; j++) name_coupling(statics, system, j);
    return !statics->arena.failed;
}

/* ---- balancing forces h along free coordinates with N^T h = -N^T Q, N the possible motions
 *
 * Scaled like E, so that a moment counts as a force at an arm of the length. */

static void add_holding(struct fbd_statics *statics, const struct rest_system *system, size_t k, double h,
                        bool alone)
{
    const struct label *label = &statics->model->labels[k];
    statics->unbalanced[statics->unbalanced_count++] =
        (fbd_unbalanced){label->name, label->force_unit, h / system->scale[k], alone};
}

/* Free coordinates without couplings: each has its own balancing force. */
static void hold_each(struct fbd_statics *statics, const struct rest_system *system)
{
    for (size_t k = 0; k < system->n; k++) {
        double force = system->scale[k] * system->Q[k];
        if (fabs(force) > six_digits * system->force) add_holding(statics, system, k, -force, false);
    }
}

/* A single possible motion: a force along any coordinate of it balances. */
static void hold_alone(struct fbd_statics *statics, const struct rest_system *system, const size_t *free,
                       size_t count, const double *motion)
{
    double work = 0, most = 0;
    for (size_t i = 0; i < count; i++) {
        work += motion[i] * system->scale[free[i]] * system->Q[free[i]];
        most = fmax(most, fabs(motion[i]));
    }
    for (size_t i = 0; i < count; i++)
        if (fabs(motion[i]) >= balancing_motion * most)
            add_holding(statics, system, free[i], -work / motion[i], true);
}

/* Several possible motions: as many coordinates, those of the basis of their columns. */
static bool hold_together(struct fbd_statics *statics, const struct rest_system *system, const size_t *free,
                          size_t count, const double *motions, size_t d)
{
    double *work = ARENA_ARRAY(&statics->arena, d, double), *h = ARENA_ARRAY(&statics->arena, count, double);
    struct qr qr = {0};
    bool made = work && h && qr_decompose(&qr, d, count, motions, solved_rounding);
    for (size_t k = 0; made && k < d; k++)
        for (size_t i = 0; i < count; i++)
            work[k] -= motions[k * count + i] * system->scale[free[i]] * system->Q[free[i]];
    if (made) qr_add_solution(&qr, work, h);
    for (size_t c = 0; made && c < qr.rank; c++)
        if (fabs(h[qr.column[c]]) > six_digits * system->force)
            add_holding(statics, system, free[qr.column[c]], h[qr.column[c]], false);
    qr_free(&qr);
    return made;
}

bool rest_find_unbalanced(struct fbd_statics *statics, const struct rest_system *system)
{
    size_t count = 0, n = system->n, m = system->m;
    size_t *free = ARENA_ARRAY(&statics->arena, n + 1, size_t);
    double *ET = ARENA_ARRAY(&statics->arena, n * m + 1, double);
    statics->unbalanced = ARENA_ARRAY(&statics->arena, n + 1, fbd_unbalanced);
    if (!free || !ET || !statics->unbalanced) return false;
    for (size_t k = 0; k < n; k++)
        if (!system->held[k]) free[count++] = k;
    statics->mobility = count - system->qr.rank;
    for (size_t k = 0; k < count; k++)
        statics->left = larger(statics->left, fabs(system->scale[free[k]] * system->Q[free[k]]) /
                                                  (system->force > 0 ? system->force : 1));
    if (!(statics->left > six_digits)) return true;
    if (m == 0) {
        hold_each(statics, system);
        return true;
    }
    for (size_t j = 0; j < m; j++)
        for (size_t k = 0; k < count; k++) ET[j * count + k] = system->E[free[k] * m + j];
    struct qr qr;
    double *motions = ARENA_ARRAY(&statics->arena, count * count + 1, double);
    bool made = motions && qr_decompose(&qr, m, count, ET, solved_rounding);
    if (!made) return false;
    qr_set_orthonormal_null(&qr, motions);
    if (count - qr.rank == 1) hold_alone(statics, system, free, count, motions);
    if (count - qr.rank > 1) made = hold_together(statics, system, free, count, motions, count - qr.rank);
    qr_free(&qr);
    return made;
}
