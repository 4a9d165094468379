/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rounding errors due to couplings in accelerations that are zero, as of bodies that friction, or a switch in
 * a sliding mode, holds through couplings.
 *
 * The forces of rows on a link may be large and cancel, as on a wheel between two others at rest. The error
 * is relative to the sum of the accelerations by each force, and to that sum for the links that a row joins.
 * There is one rounding for each link along a sum: up to 4 eps for each occur
 * (tests/unit/test_coupled_switches.c), 8 are assumed.
 */
#include <float.h>
#include <math.h>

#include "dynamics/tree_system.h"
#include "numeric/tolerances.h"

/* A movable joint at a port, or below: the generalized forces of a unit force of the row, and the inverse
 * inertias. */
struct lever {
    int first, count; /* of the coordinates */
    double gain[3], inverse[3];
};

static struct lever lever_at(const struct tree *tree, const struct tree_work *work, const struct port *port,
                             int i)
{
    const struct tree_link *link = &tree->links[i];
    const struct tree_state *s = &work->links[i];
    struct vec arm = vec_sub(vec_add(work->links[port->link].p, port->arm), s->p);
    double force = vec_norm(port->force), moment = fabs(vec_cross(arm, port->force));
    struct lever lever = {link->coordinate,
                          s->locked ? 0 : joint_freedom(link->kind),
                          {force, force, moment},
                          {1 / s->mass, 1 / s->mass, 1 / s->I_O}};
    if (lever.count == 1) lever.inverse[0] = s->D;
    if (link->added[0] > 0 && lever.count > 1)
        lever.inverse[0] = lever.inverse[1] = s->inverse[0] + s->inverse[2];
    if (link->added[1] > 0) lever.inverse[2] = s->D;
    if (link_joint(link)->has_axis) lever.gain[0] = moment;
    if (link_joint(link)->path == path_curve) lever.gain[0] += fabs(s->turning) * moment;
    return lever;
}

/* The acceleration of the row by its own unit force through these coordinates. */
static double answer_of(const struct lever *lever)
{
    double sum = 0;
    for (int k = 0; k < lever->count; k++) sum += lever->gain[k] * lever->gain[k] * lever->inverse[k];
    return sum;
}

/* Add the accelerations by a force of this size at a port, of the joints of the link and below. */
static void add_taken(const struct tree *tree, const struct tree_work *work, const struct port *port,
                      double size, double *taken)
{
    for (int i = port->link; i > 0; i = tree->links[i].parent) {
        struct lever lever = lever_at(tree, work, port, i);
        for (int k = 0; k < lever.count; k++)
            taken[lever.first + k] += size * lever.gain[k] * lever.inverse[k];
    }
}

/* A row makes its ends move together: the rounding of one is that of the others, unless the row hardly moves
 * them. */
static void spread_taken(const struct tree *tree, const struct tree_work *work, const struct row *row,
                         double *taken)
{
    struct lever levers[2 * most_constraint_ends];
    double most = 0, whole = 0;
    for (int p = 0; p < row->port_count; p++) {
        int i = row->ports[p].link;
        while (i > 0 && joint_freedom(tree->links[i].kind) == 0) i = tree->links[i].parent;
        levers[p] = i > 0 ? lever_at(tree, work, &row->ports[p], i) : (struct lever){0};
        whole += answer_of(&levers[p]);
        for (int k = 0; k < levers[p].count; k++)
            most = fmax(most, levers[p].gain[k] * taken[levers[p].first + k]);
    }
    for (int p = 0; p < row->port_count; p++) {
        double answer = answer_of(&levers[p]);
        for (int k = 0; k < levers[p].count && answer > distinct_part * whole; k++) {
            double *own = &taken[levers[p].first + k];
            *own = fmax(*own, most * levers[p].gain[k] * levers[p].inverse[k] / answer);
        }
    }
}

/* In both directions along a train, as couplings are mostly numbered along it. */
static void spread(const struct tree *tree, const struct instant *at)
{
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++)
        if (tree_takes_part(tree, at, j)) spread_taken(tree, work, &work->rows[j], work->taken);
    for (int j = tree->row_count; j-- > 0;)
        if (tree_takes_part(tree, at, j)) spread_taken(tree, work, &work->rows[j], work->taken);
}

const double *tree_rounding(const struct fbd_model *model, const struct instant *at, bool along)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    int n = model->plan.n;
    for (int i = 0; i < n; i++) work->taken[i] = tree->coupling_count > 0 ? fabs(work->unit[i]) : 0;
    for (int j = 0; j < tree->row_count; j++) {
        const struct row *row = &work->rows[j];
        double size = fabs(along ? work->z[j] : row->lambda);
        if (size == 0 || !tree_takes_part(tree, at, j)) continue;
        for (int k = 0; k < row->port_count; k++) add_taken(tree, work, &row->ports[k], size, work->taken);
    }
    spread(tree, at);
    for (int i = 0; i < n; i++) work->taken[i] *= round_off(8, tree->count);
    return work->taken;
}

void tree_rest(const struct fbd_model *model, const struct instant *at, bool along, double *a)
{
    if (model->tree->coupling_count == 0 || model->tree->meeting_count > 0)
        return; /* contacts: drop_rounding in tree.c */
    const double *rounding = tree_rounding(model, at, along);
    for (int i = 0; i < model->plan.n; i++)
        if (fabs(a[i]) <= rounding[i]) a[i] = 0;
}
