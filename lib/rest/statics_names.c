/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Named results of statics: the indeterminate reactions, and the forces that would balance a scene that is
 * not in equilibrium.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

#include "fbd_study.h"
#include "model/labels.h"
#include "numeric/svd.h"
#include "rest/statics.h"

/* ---- indeterminate reactions */

/* Does entry i of r change along the null vectors? */
static bool varies(const struct rest_system *system, size_t i)
{
    double most = 0;
    for (size_t k = 0; k < system->basis_count; k++) {
        double sum = 0;
        for (size_t j = 0; j < system->m; j++)
            sum += system->R[i * system->m + j] * system->basis[j * system->basis_count + k];
        most = fmax(most, fabs(sum));
    }
    return most > 1e-8; /* of the change of all reactions together, 1 */
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
    if (coupling->kind != constraint_pin) {
        if (one) add_name(statics, "", coupling_force_name(tree, row), "");
        return;
    }
    if (row > coupling->first_row) return; /* named with the first row */
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

/* Coordinates that move less than a thousandth of the others are not used for a balancing force. */
static const double hardly = 1e-3;

/* Free coordinates without couplings: each has its own balancing force. */
static void hold_each(struct fbd_statics *statics, const struct rest_system *system)
{
    for (size_t k = 0; k < system->n; k++) {
        double force = system->scale[k] * system->Q[k];
        if (fabs(force) > rest_digits * system->force) add_holding(statics, system, k, -force, false);
    }
}

/* A single possible motion: a force along any coordinate of it balances. */
static void hold_alone(struct fbd_statics *statics, const struct rest_system *system, const size_t *free,
                       const struct svd *ways)
{
    double work = 0, most = 0;
    for (size_t i = 0; i < ways->cols; i++) {
        work += svd_null(ways, i, 0) * system->scale[free[i]] * system->Q[free[i]];
        most = fmax(most, fabs(svd_null(ways, i, 0)));
    }
    for (size_t i = 0; i < ways->cols; i++) {
        double share = svd_null(ways, i, 0);
        if (fabs(share) >= hardly * most) add_holding(statics, system, free[i], -work / share, true);
    }
}

/* Several possible motions: as many coordinates, chosen by QR decomposition with pivoting. */
static bool hold_together(struct fbd_statics *statics, const struct rest_system *system, const size_t *free,
                          const struct svd *ways)
{
    size_t count = ways->cols, d = count - ways->rank;
    gsl_matrix *NT = gsl_matrix_alloc(d, count);
    gsl_vector *tau = gsl_vector_alloc(d), *norm = gsl_vector_alloc(count);
    gsl_permutation *order = gsl_permutation_alloc(count);
    double *square = ARENA_ARRAY(&statics->arena, d * d, double),
           *work = ARENA_ARRAY(&statics->arena, d, double);
    double *h = ARENA_ARRAY(&statics->arena, d, double);
    bool made = NT && tau && norm && order && square && work && h;
    for (size_t w = 0; made && w < d; w++)
        for (size_t i = 0; i < count; i++) {
            gsl_matrix_set(NT, w, i, svd_null(ways, i, w));
            work[w] -= svd_null(ways, i, w) * system->scale[free[i]] * system->Q[free[i]];
        }
    int sign;
    made = made && gsl_linalg_QRPT_decomp(NT, tau, order, &sign, norm) == GSL_SUCCESS;
    for (size_t w = 0; made && w < d; w++)
        for (size_t c = 0; c < d; c++) square[w * d + c] = svd_null(ways, gsl_permutation_get(order, c), w);
    struct svd chosen = {0};
    made = made && svd_decompose(&chosen, d, d, square);
    if (made) svd_add_solution(&chosen, work, h);
    for (size_t c = 0; made && c < d; c++)
        if (fabs(h[c]) > rest_digits * system->force)
            add_holding(statics, system, free[gsl_permutation_get(order, c)], h[c], false);
    svd_free(&chosen);
    if (NT) gsl_matrix_free(NT);
    if (tau) gsl_vector_free(tau);
    if (norm) gsl_vector_free(norm);
    if (order) gsl_permutation_free(order);
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
    if (!(statics->left > rest_digits)) return true;
    if (m == 0) {
        hold_each(statics, system);
        return true;
    }
    for (size_t j = 0; j < m; j++)
        for (size_t k = 0; k < count; k++) ET[j * count + k] = system->E[free[k] * m + j];
    struct svd ways;
    bool made = svd_decompose(&ways, m, count, ET);
    if (made && count - ways.rank == 1) hold_alone(statics, system, free, &ways);
    if (made && count - ways.rank > 1) made = hold_together(statics, system, free, &ways);
    svd_free(&ways);
    return made;
}
