/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The matrix S of the constraints and of the friction of slipping slides, and the response of the trees to its
 * unknowns.
 *
 * A unit multiplier of a row is a wrench on one or two links, which only the links between them and the ground
 * pass on. Inward along these paths joint i receives the force u_i, and as M^-1 is L^T D L with D the inverse
 * inertias of the joints and L the sweep inward (Rodriguez, Jain and Kreutz-Delgado, The Int. J. of Robotics
 * Research 10, 1991, 371), an entry of S is a sum over the joints that two paths share:
 *
 *     S_jk = sum u_ij D_i u_ik
 *
 * Friction of slipping slides depends on normal forces, which are not among these: a system with it is
 * assembled from the accelerations of all links for each unknown.
 */
#include <string.h>

#include "dynamics/friction.h"
#include "dynamics/plane_friction.h"
#include "dynamics/tree_unknowns.h"

/* ---- the unknowns: rows of couplings, then frictions of slides, then forces along massless coordinates */

int tree_unknowns(const struct tree *tree)
{
    return tree->row_count + tree->pair_count + tree->massless_count;
}

bool tree_lacks_inertia(const struct tree *tree, const struct tree_work *work)
{
    for (int k = 0; k < tree->massless_count; k++)
        if (tree_added(tree, work, &tree->massless[k]) > 0) return true;
    return false;
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
    if (unknown_is_massless(tree, k))
        return !at->tree->placing && tree_added(tree, at->tree, massless_of(tree, k)) > 0;
    if (!unknown_is_row(tree, k)) {
        int link = tree->pairs[k - tree->row_count];
        return !at->tree->projecting && at->slip[tree->links[link].pair] != stick;
    }
    const struct coupling *coupling = &tree->couplings[tree->coupling_of_row[k]];
    if (coupling_is_gone(at->tree, coupling)) return false;
    if (coupling->kind == constraint_contact) return contact_takes_part(coupling, at, k);
    bool has_mode = coupling->kind == constraint_rope || coupling->kind == constraint_plane ||
                    (coupling->pair >= 0 && k == coupling->along_row);
    int surface = coupling->surface >= 0 ? at->slip[coupling->surface] : stick;
    bool open = surface != stick &&
                (surface != loose || k == coupling->first_row); /* rolling without friction continues */
    return !open && (!has_mode || at->slip[coupling->pair] == stick);
}

bool tree_rows_are_idle(const struct tree *tree, const struct instant *at)
{
    for (int j = 0; j < tree->row_count; j++)
        if (tree_takes_part(tree, at, j)) return false;
    return true;
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
static bool is_rubbing(const struct tree *tree, int index, const struct instant *at)
{
    const struct coupling *coupling = &tree->couplings[index];
    return coupling_rubs(coupling) && coupling->kind != constraint_plane &&
           !coupling_is_gone(at->tree, coupling) && slip_side(at->slip[coupling->pair]) != 0 &&
           (coupling->surface < 0 || at->slip[coupling->surface] == stick);
}

/* The friction of a body that slips on a surface, per normal force: -slip mu_k along its line; 0 if it does
 * not slip. */
double tree_rubbing_share(const struct fbd_model *model, const struct instant *at, int index)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    if (at->tree->projecting || !is_rubbing(model->tree, index, at)) return 0;
    const struct formula *mu = &model->plan.modes[coupling->pair].mu_k;
    return -at->slip[coupling->pair] * at->pull[coupling->pair] *
           friction_coefficient(model, coupling->pair, mu, at, NULL, NULL);
}

/* With slip the friction acts along another row: apply that of coupling `index` for its normal force. */
static void apply_rubbing(const struct fbd_model *model, const struct instant *at, int index, double normal)
{
    double share = index < 0 ? 0 : tree_rubbing_share(model, at, index);
    if (share == 0) return;
    row_apply(&at->tree->rows[model->tree->couplings[index].along_row], share * normal, at->tree->x);
}

/* Is row k a normal force with friction that slips? */
static bool row_rubs(const struct fbd_model *model, const struct instant *at, int k)
{
    const int index = model->tree->coupling_of_row[k];
    const struct coupling *coupling = &model->tree->couplings[index];
    if (k != coupling->normal_row) return false;
    return tree_rubbing_share(model, at, index) != 0 ||
           (coupling->resistance >= 0 && tree_rubbing_share(model, at, coupling->resistance) != 0);
}

/* A force along a coordinate of a joint. */
static void apply_along(const struct tree *tree, struct tree_work *work, const struct tree_massless *of,
                        double size)
{
    const struct tree_state *s = &work->links[of->link];
    struct tree_rhs *x = &work->x[of->link];
    const int count = joint_freedom(tree->links[of->link].kind);
    if (count == 1 || of->local == 2)
        x->g += size;
    else
        x->gf = vec_add(x->gf, vec_scale(size, of->local == 0 ? s->e : vec_perp(s->e)));
}

static void apply_unknown(const struct fbd_model *model, const struct instant *at, int k, double size)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    if (unknown_is_massless(tree, k)) {
        apply_along(tree, work, massless_of(tree, k), size);
        return;
    }
    if (!unknown_is_row(tree, k)) {
        work->x[tree->pairs[k - tree->row_count]].g += size;
        return;
    }
    row_apply(&work->rows[k], size, work->x);
    const int index = tree->coupling_of_row[k];
    if (k != tree->couplings[index].normal_row) return;
    apply_rubbing(model, at, index, size);
    apply_rubbing(model, at, tree->couplings[index].resistance, size);
}

/* The trees that unknown k joins: their first links. */
static int roots_of(const struct tree *tree, int k, const int **roots)
{
    if (unknown_is_massless(tree, k)) {
        *roots = &tree->links[massless_of(tree, k)->link].root;
        return 1;
    }
    if (!unknown_is_row(tree, k)) {
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
    apply_unknown(model, at, k, 1);
    for (int i = 0; i < count; i++) {
        tree_inward(tree, work, roots[i], tree->links[roots[i]].end);
        tree_outward(tree, work, roots[i], tree->links[roots[i]].end, work->unit);
    }
}

/* The acceleration along massless coordinate j, less f / w. */
static double massless_entry(const struct tree *tree, const struct tree_work *work, int j, int k)
{
    const struct tree_massless *of = massless_of(tree, j);
    const double own = j == k ? 1 / of->added : 0;
    if (work->mark[tree->links[of->link].root] != k + 1) return -own;
    return work->unit[tree->links[of->link].coordinate + of->local] - own;
}

/* Row j of the system for the response to unknown k. */
static double entry(const struct fbd_model *model, const struct instant *at, int j, int k)
{
    const struct tree *tree = model->tree;
    if (unknown_is_row(tree, j)) return row_answer(at->tree, tree, &at->tree->rows[j], k + 1);
    if (unknown_is_massless(tree, j)) return massless_entry(tree, at->tree, j, k);
    int link = tree->pairs[j - tree->row_count];
    if (at->tree->mark[tree->links[link].root] != k + 1) return j == k;
    return tree_slip_share(model, at, link) * tree_normal_in(tree, at->tree, link) + (j == k);
}

/* Chain the active unknowns that act on a tree: an entry of place p is p times most_constraint_ends, plus the number
 * of the tree among its own. A row begins at the first of those that act on its trees, but not before the place in
 * work->first, where it begins if all unknowns are active. */
static void set_chains(const struct tree *tree, struct tree_work *work)
{
    int *oldest = work->mark;
    size_t size = 0;
    for (int i = 0; i < tree->count; i++) work->newest[i] = -1;
    for (int p = 0; p < work->count; p++) {
        const int *roots;
        int count = roots_of(tree, work->unknown_at[p], &roots), first = p;
        for (int i = 0, entry = p * most_constraint_ends; i < count; i++, entry++) {
            if (work->newest[roots[i]] < 0) oldest[roots[i]] = p;
            if (oldest[roots[i]] < first) first = oldest[roots[i]];
            work->older[entry] = work->newest[roots[i]];
            work->newest[roots[i]] = entry;
        }
        if (first > work->first[p]) work->first[p] = first;
        work->envelope[p] = size;
        size += (size_t)(p - work->first[p]);
    }
    work->envelope_size = size;
}

/* Number the active unknowns. Open contacts and slipping friction have no cost in the following. */
static void set_places(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) work->rows[j].redundant = work->rows[j].weak = false;
    if (work->placed) return;
    int count = 0, all = tree_unknowns(tree);
    for (int p = 0; p < all; p++) {
        int k = tree->unknown_at[p];
        work->rank[p] = count;
        work->place[k] = -1;
        work->diagonal[k] = 1;
        if (!tree_takes_part(tree, at, k)) continue;
        work->place[k] = count;
        work->unknown_at[count] = k;
        work->first[count++] = work->rank[tree->first[p]];
    }
    work->count = count;
    set_chains(tree, work);
    work->placed = model->plan.mode_count == 0 && !tree->ends && tree->massless_count == 0;
}

/* Set the entry in row q of column p, or in the upper part. */
static void put(struct tree_work *work, int q, int p, double value)
{
    double *lower = work->whole, *upper = lower + work->envelope_size;
    if (q < p) *system_entry(work, upper, p, q) = value;
    if (q == p) work->diagonal[work->unknown_at[p]] = value;
    if (q > p && work->first[q] <= p) *system_entry(work, lower, q, p) = value;
}

/* By the accelerations for each unknown. Column p has entries in the rows q that act on its trees. */
static void assemble_columns(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    memset(work->mark, 0, (size_t)tree->count * sizeof *work->mark);
    for (int p = 0; p < work->count; p++) {
        const int *roots, k = work->unknown_at[p];
        int count = roots_of(tree, k, &roots);
        answer_unit(model, at, k);
        for (int i = 0; i < count; i++)
            for (int next = work->newest[roots[i]]; next >= 0; next = work->older[next]) {
                int q = next / most_constraint_ends;
                put(work, q, p, entry(model, at, work->unknown_at[q], k));
            }
    }
}

/* S of the rows at two places; the links of the second are marked by its forces. */
static double shared(const struct tree_work *work, int j, int place)
{
    double sum = 0;
    for (int i = work->push_end[j]; i < work->push_end[j + 1]; i++) {
        const struct tree_push *push = &work->pushes[i];
        int mark = work->mark[push->link];
        if (mark <= work->push_end[place]) continue;
        const struct tree_push *other = &work->pushes[mark - 1];
        sum += push->u * other->alone + vec_dot(push->uf, other->alone_f);
    }
    return sum;
}

int tree_path_size(const struct tree *tree, const struct coupling *coupling)
{
    int count = 0;
    for (int k = 0; k < coupling->end_count; k++)
        for (int i = coupling->end[k].link; i > 0; i = tree->links[i].parent) count++;
    return count;
}

/* The forces on the joints by a unit multiplier; returns their number. */
static int push(const struct tree *tree, const struct tree_work *work, const struct row *row,
                struct tree_push *pushes)
{
    int at[2 * most_constraint_ends];
    struct wrench p[2 * most_constraint_ends];
    for (int k = 0; k < row->port_count; k++) {
        const struct port *port = &row->ports[k];
        at[k] = port->link;
        p[k] = (struct wrench){-vec_cross(port->arm, port->force), vec_scale(-1, port->force)};
    }
    return tree_push(tree, work, at, p, row->port_count, pushes);
}

static void assemble_paths(const struct tree *tree, struct tree_work *work)
{
    double *lower = work->whole, *upper = lower + work->envelope_size;
    memset(work->mark, 0, (size_t)tree->count * sizeof *work->mark);
    work->push_end[0] = 0;
    for (int p = 0; p < work->count; p++) {
        int k = work->unknown_at[p], from = work->push_end[p];
        int end = from + push(tree, work, &work->rows[k], work->pushes + from);
        work->push_end[p + 1] = end;
        for (int i = from; i < end; i++) work->mark[work->pushes[i].link] = i + 1;
        work->diagonal[k] = shared(work, p, p);
        for (int q = work->first[p]; q < p; q++)
            *system_entry(work, lower, p, q) = *system_entry(work, upper, p, q) = shared(work, q, p);
    }
}

/* Is there no friction among the active unknowns? */
static bool has_rows_only(const struct fbd_model *model, const struct instant *at)
{
    const struct tree_work *work = at->tree;
    for (int p = 0; p < work->count; p++) {
        int k = work->unknown_at[p];
        if (!unknown_is_row(model->tree, k) || row_rubs(model, at, k)) return false;
    }
    return true;
}

void tree_system_assemble(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    set_places(model, at);
    if (work->count == 0) return;
    work->symmetric = (model->plan.mode_count == 0 && tree->massless_count == 0) || has_rows_only(model, at);
    if (system_has_paths(tree, work)) {
        assemble_paths(tree, work);
    } else {
        memset(work->whole, 0, 2 * work->envelope_size * sizeof *work->whole);
        assemble_columns(model, at);
    }
    tree_set_scales(tree, work);
}

/* No response to no forces. */
static void answer_none(const struct fbd_model *model, struct tree_work *work)
{
    clear_range(work->x, 0, model->tree->count);
    memset(work->unit, 0, (size_t)model->plan.n * sizeof *work->unit);
}

void tree_system_empty(const struct fbd_model *model, struct tree_work *work)
{
    const struct tree *tree = model->tree;
    for (int j = 0; j < tree->row_count; j++) work->rows[j].redundant = work->rows[j].weak = false;
    for (int k = 0; k < tree_unknowns(tree); k++) {
        work->place[k] = -1;
        work->z[k] = 0;
    }
    work->count = 0;
    work->placed = false;
    answer_none(model, work);
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

void tree_want_massless(const struct tree *tree, const struct tree_work *work, const double *a, double *z)
{
    for (int k = tree->row_count + tree->pair_count; k < tree_unknowns(tree); k++) {
        const struct tree_massless *of = massless_of(tree, k);
        const bool active = tree_added(tree, work, of) > 0;
        z[k] = active ? -a[tree->links[of->link].coordinate + of->local] : 0;
    }
}

/* The same by the forces on the joints of the rows. */
static void answer_pushes(const struct tree *tree, struct tree_work *work, const double *z)
{
    struct tree_rhs *x = work->x;
    for (int i = 1; i < tree->count; i++) {
        x[i].u = 0;
        x[i].uf = (struct vec){0, 0};
    }
    for (int p = 0; p < work->count; p++)
        for (int i = work->push_end[p]; i < work->push_end[p + 1]; i++) {
            const struct tree_push *push = &work->pushes[i];
            double lambda = z[work->unknown_at[p]];
            x[push->link].u += lambda * push->u;
            x[push->link].uf = vec_add(x[push->link].uf, vec_scale(lambda, push->uf));
        }
}

void tree_system_answer(const struct fbd_model *model, const struct instant *at, const double *z)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    if (work->count == 0) {
        answer_none(model, work);
        return;
    }
    if (work->rates_only && system_has_paths(tree, work) && !work->apart) {
        answer_pushes(tree, work, z);
    } else {
        clear_range(work->x, 0, tree->count);
        for (int k = 0; k < tree_unknowns(tree); k++)
            if (z[k] != 0) apply_unknown(model, at, k, z[k]);
        tree_inward(tree, work, 1, tree->count);
    }
    tree_outward(tree, work, 1, tree->count, work->unit);
}

void tree_take_multipliers(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) work->rows[j].lambda = work->z[j];
    if (tree->plane_count > 0) planes_take_multipliers(model, at);
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (is_rubbing(tree, i, at))
            work->rows[coupling->along_row].lambda =
                tree_rubbing_share(model, at, i) * work->z[coupling->normal_row];
    }
}

void tree_apply_variations(const struct fbd_model *model, const struct instant *at,
                           const struct direction *along)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) apply_ports_along(&work->rows[j], work->x);
    if (tree->plane_count > 0) planes_apply_variations(model, at, along);
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (!is_rubbing(tree, i, at)) continue;
        double d_mu;
        friction_coefficient(model, coupling->pair, &model->plan.modes[coupling->pair].mu_k, at, along,
                             &d_mu);
        row_apply(&work->rows[coupling->along_row],
                  -at->slip[coupling->pair] * at->pull[coupling->pair] * d_mu *
                      work->rows[coupling->normal_row].lambda,
                  work->x);
    }
}
