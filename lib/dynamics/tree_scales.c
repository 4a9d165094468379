/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How large the diagonals of the system of the constraints could be: what a weak row, and the shift of all rows, are measured
 * against (constraint_solve.c).
 */
#include <float.h>
#include <math.h>

#include "dynamics/tree_system.h"

/* How much the joint of a link could move a point at `arm` from its O, by a unit force in the best direction;
 * where it cannot, the joint before it. */
static double mobility(const struct tree *tree, const struct tree_work *work, int link, struct vec arm)
{
    for (; link > 0; link = tree->links[link].parent) {
        const struct tree_state *s = &work->links[link];
        enum motion_kind kind = tree->links[link].kind;
        double r2 = vec_dot(arm, arm), gives = 0;
        if (kind == motion_pivot)
            gives = s->D * r2;
        else if (kind == motion_slide || kind == motion_track)
            gives = s->D;
        else
            gives = s->inverse[0] + s->inverse[2] + s->D * r2;
        if (!s->locked && gives > 0) return gives;
        arm = vec_add(arm, s->d);
    }
    return 0;
}

/* Of the masses of links: up to here two corrections make up for the shift. */
static const double masses_near = 1e3;

/* A row counts as weak against what its coupling could do in other positions or directions: so a pin, turned in
 * the plane, is the same pin, and a rod notices when all that it joins has come in line with it.
 *
 * What nothing can move has all of that of the order of rounding, when it sits on the axis but for rounding
 * (the pin of a welded body). So whether it moves is measured against the lightest link too, as a whole.
 *
 * Rows that a light body joins differ by what the heavy bodies alone would do: a massless pulley is no singular position.
 * So what is weak, and the shift with it, is measured as if masses were no further apart than the shift allows for. */
void tree_set_scales(const struct tree *tree, struct tree_work *work)
{
    const double apart = fmax(1, tree->mass_ratio / masses_near);
    work->apart = apart > 1;
    double most = 0, lightest = DBL_MAX;
    for (int i = 0; i < tree->coupling_count; i++) {
        int first = tree->couplings[i].first_row, end = first + tree->couplings[i].row_count;
        double scale = 0;
        for (int j = first; j < end; j++) {
            const struct row *row = &work->rows[j];
            if (work->place[j] < 0) continue;
            for (int k = 0; k < row->port_count; k++) {
                int link = row->ports[k].link;
                scale = fmax(scale, mobility(tree, work, link, row->ports[k].arm));
                if (link > 0) lightest = fmin(lightest, tree->links[link].mass);
            }
            scale = fmax(scale, work->diagonal[j]);
        }
        for (int j = first; j < end; j++) work->scale[j] = work->place[j] < 0 ? 1 : scale / apart;
        most = fmax(most, scale);
    }
    for (int k = tree->row_count; k < tree_unknowns(tree); k++) work->scale[k] = work->diagonal[k];
    work->most = fmax(most, 1 / lightest);
}
