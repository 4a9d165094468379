/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Coordinates of links without mass: levers, pulleys and rods whose mass is negligible.
 *
 * Such a coordinate may have inertia by the bodies that its link carries (a light lever with a bob on a pivot):
 * the recursion finds that. Otherwise it has inertia by couplings only, and the mass matrix M is singular,
 * though positive definite for all motions that the couplings allow. Then an inertia w is added to the joint, and
 * a force f along it cancels its effect:
 *
 *     (M + w e e^T) a = tau + J^T lambda + e f,   J a = gamma,   f = w e^T a
 *
 * with e the coordinate. These equations have the solution of M a = tau + J^T lambda for any w > 0. The forces f
 * are unknowns of the system of the multipliers, eliminated after all rows: their pivots are -1/w times the share
 * of the inertia of the couplings in the sum of both, which is above zero exactly if M is positive definite for
 * the motions that remain.
 *
 * As modes are tried some ropes and contacts are loose, and the pivot may be zero: then a millionth of w is left
 * (constraint_solve.c).
 *
 * The result is most accurate if w is of the size of the inertia by the couplings: w is the geometric mean of
 * the smallest and the largest mass of the scene, for rotations times the square of the distance of the
 * farthest joint or coupling.
 */
#include "model/builder.h"

/* The distance of the farthest child or end of a coupling from the O of a link. */
static double reach_of(const struct tree *tree, int link)
{
    double reach = 0;
    for (int i = link + 1; i < tree->links[link].end; i++)
        if (tree->links[i].parent == link) reach = fmax(reach, vec_norm(tree->links[i].at));
    for (int i = 0; i < tree->coupling_count; i++)
        for (int k = 0; k < tree->couplings[i].end_count; k++) {
            const struct coupling_end *end = &tree->couplings[i].end[k];
            if (end->link == link) reach = fmax(reach, vec_norm(end->point) + fabs(end->radius));
        }
    return reach > 0 ? reach : 1;
}

/* Has the link no inertia of its own along a coordinate of its joint? */
static bool is_massless(const struct tree_link *link, int local)
{
    if (link_joint(link)->has_axis) return link->I_O == 0;
    return local == link_joint(link)->angle ? link->I_G == 0 : link->mass == 0;
}

bool tree_find_massless(struct fbd_model *model)
{
    struct tree *tree = model->tree;
    const struct mass_range masses = tree_masses(tree);
    const double mass = masses.most > 0 ? sqrt(masses.most) * sqrt(masses.least) : 1;
    tree->massless = ARENA_ARRAY(&model->arena, (size_t)model->plan.n, struct tree_massless);
    if (!tree->massless) return false;
    for (int i = 1; i < tree->joined; i++) {
        struct tree_link *link = &tree->links[i];
        for (int local = 0; local < link_joint(link)->count; local++) {
            const bool turns = local == link_joint(link)->angle;
            if (!is_massless(link, local)) continue;
            const double reach = turns ? reach_of(tree, i) : 1, added = mass * reach * reach;
            link->added[turns && local > 0] = added;
            tree->massless[tree->massless_count++] = (struct tree_massless){i, local, added};
        }
    }
    return true;
}
