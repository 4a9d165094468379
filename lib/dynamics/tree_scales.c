/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Upper bounds for the diagonals of the system of the constraints: the scales of weak rows, and of the shift
 * of all rows (constraint_solve.c).
 */
#include <float.h>
#include <math.h>

#include "dynamics/tree_unknowns.h"

/* The acceleration of a point at `arm` from the O of a link by a unit force in the best direction, through
 * its joint, or if that is locked, through the joint before it. */
static double mobility(const struct tree *tree, const struct tree_work *work, int link, struct vec arm)
{
    for (; link > 0; link = tree->links[link].parent) {
        const struct tree_state *s = &work->links[link];
        const struct joint_type *joint = link_joint(&tree->links[link]);
        double gives = joint->path != path_none ? s->D : s->D * vec_dot(arm, arm);
        if (joint->count > 1) gives = s->inverse[0] + s->inverse[2] + gives;
        if (!s->locked && gives > 0) return gives;
        arm = vec_add(arm, s->d);
    }
    return 0;
}

/* Has a row, as of the same pin, been evaluated with the same port? */
static bool has_arm(const struct row *row, int port, int link, struct vec arm)
{
    const struct port *other = &row->ports[port];
    return port < row->port_count && other->link == link && other->arm.x == arm.x && other->arm.y == arm.y;
}

/* The ratio of masses up to which two corrections compensate the shift. */
static const double masses_near = 1e3;

/* The scale of a row is the largest response of its coupling in other positions or directions: so it does not
 * change as a pin turns in the plane, and a rod becomes weak when all joined parts are in line with it.
 *
 * An immovable row has a response of rounding only, if its port is on the axis up to rounding (the pin of a
 * welded body). So `most`, with which it is compared, includes the response of the lightest link.
 *
 * Rows of a light body differ by the responses of the heavy bodies only: a massless pulley is no singular
 * position. So the scales are those for a ratio of masses that the shift allows. */
void tree_set_scales(const struct tree *tree, struct tree_work *work)
{
    const double apart = fmax(1, tree->mass_ratio / masses_near);
    work->apart = apart > 1 || tree->plane_count > 0;
    double most = 0, lightest = DBL_MAX;
    for (int i = 0; i < tree->coupling_count; i++) {
        int first = tree->couplings[i].first_row, end = first + tree->couplings[i].row_count;
        double scale = 0;
        for (int j = first; j < end; j++) {
            const struct row *row = &work->rows[j];
            if (work->place[j] < 0) continue;
            for (int k = 0; k < row->port_count; k++) {
                int link = row->ports[k].link;
                if (j > first && work->place[first] >= 0 &&
                    has_arm(&work->rows[first], k, link, row->ports[k].arm))
                    continue;
                const enum constraint_kind kind = tree->couplings[i].kind;
                double size = mobility(tree, work, link, row->ports[k].arm);
                if (kind == constraint_resistance || kind == constraint_ratio)
                    size *= vec_dot(row->ports[k].force, row->ports[k].force);
                scale = fmax(scale, size);
                if (link > 0 && tree->links[link].mass > 0) lightest = fmin(lightest, tree->links[link].mass);
            }
            scale = fmax(scale, work->diagonal[j]);
        }
        for (int j = first; j < end; j++) work->scale[j] = work->place[j] < 0 ? 1 : scale / apart;
        most = fmax(most, scale);
    }
    for (int k = tree->row_count; k < tree_unknowns(tree); k++)
        work->scale[k] = unknown_is_massless(tree, k) ? 0 : work->diagonal[k];
    work->most = fmax(most, 1 / lightest);
}
