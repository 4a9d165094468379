/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A ratio: g = sum c_i q_i - g_0 with coordinates q_i in joints.
 *
 * Positions and rates are those of the state. The second rate of a coordinate follows from the accelerations of its
 * link and of its parent P, since the equations of motion are solved for those. Of an angle it is alpha - alpha_P. Of
 * a length, in the direction e that turns with P, or of the tangent e of a track,
 *
 *     q'' = e . (a - a_P - alpha_P k x d + omega_P^2 d - 2 omega_P k x w),  w = v - v_P - omega_P k x d
 *
 * with the origins O of both links, d from that of P: the acceleration relative to P. That along a track is s'', as
 * the centripetal acceleration is normal to e.
 *
 * The force of a unit multiplier is c_i e at O of the link, and -c_i e at the same place of its parent; of an angle
 * the couple c_i and its opposite, each as two forces at the ends of a diameter of radius |c_i|.
 */
#include "dynamics/constraint_view.h"

/* A coordinate: of the joint of `link` on `parent`. */
struct place {
    int link, parent, local, index;
};

static struct place place_of(const struct view *view, const struct coupling *coupling, int k)
{
    const int link = coupling->end[k].link, local = coupling->source->terms[k].coordinate;
    const struct tree_link *joint = &view->tree->links[link];
    return (struct place){link, joint->parent, local, joint->coordinate + local};
}

static bool is_angle(const struct view *view, const struct place *place)
{
    return place->local == link_joint(&view->tree->links[place->link])->angle;
}

/* ---- quantities with their variations alone: x and d of a jet */

static struct jet varied(double x, double d)
{
    return (struct jet){.x = x, .d = d};
}

static struct jet_vec varied_vec(struct vec p, struct vec d)
{
    return (struct jet_vec){varied(p.x, d.x), varied(p.y, d.y)};
}

/* The direction of a length in the world. */
static struct jet_vec direction_of(const struct view *view, const struct place *place)
{
    const struct jet_vec e = varied_vec(view->work->links[place->link].e, variation_of(view, place->link)->e);
    return place->local == 0 ? e : jet_perp(e);
}

/* The acceleration of O relative to the parent, see above. */
static struct jet_vec relative_acceleration(const struct view *view, const struct place *place)
{
    const struct tree_state *s = &view->work->links[place->link], *P = &view->work->links[place->parent];
    const struct tree_variation *ds = variation_of(view, place->link),
                                *dP = variation_of(view, place->parent);
    const struct jet omega = varied(P->omega, dP->omega), alpha = varied(P->A.alpha, dP->A.alpha);
    const struct jet_vec d = varied_vec(s->d, ds->d), k_d = jet_perp(d);
    const struct jet_vec v = varied_vec(vec_sub(s->v, P->v), vec_sub(ds->v, dP->v));
    const struct jet_vec w = jet_vec_sub(v, jet_vec_times(omega, k_d));
    struct jet_vec a = varied_vec(vec_sub(s->A.a, P->A.a), vec_sub(ds->A.a, dP->A.a));
    a = jet_vec_sub(a, jet_vec_times(alpha, k_d));
    a = jet_vec_sub(a, jet_vec_times(jet_scale(-1, jet_mul(omega, omega)), d));
    return jet_vec_sub(a, jet_vec_times(jet_scale(2, omega), jet_perp(w)));
}

/* ---- the row */

static struct jet coordinate_of(const struct view *view, const struct place *place)
{
    const int n = view->model->plan.n, i = place->index;
    const double *y = view->at->y, *dy = view->varied ? view->along->dy : NULL;
    struct jet q = {.x = y[i], .x1 = y[n + i], .d = dy ? dy[i] : 0, .d1 = dy ? dy[n + i] : 0};
    struct jet second;
    if (is_angle(view, place)) {
        second =
            varied(view->work->links[place->link].A.alpha - view->work->links[place->parent].A.alpha,
                   variation_of(view, place->link)->A.alpha - variation_of(view, place->parent)->A.alpha);
    } else {
        second = jet_dot(direction_of(view, place), relative_acceleration(view, place));
    }
    q.x2 = second.x;
    q.d2 = second.d;
    return q;
}

/* c_i e, or its opposite on the parent. */
static void add_force(const struct view *view, const struct coupling *coupling, int k,
                      const struct place *place, double size, struct row *row)
{
    const struct vec none = {0, 0};
    const struct jet_vec e = direction_of(view, place);
    const bool below = coupling->source->terms[k].opposite;
    const struct vec arm = below ? view->work->links[place->link].d : none;
    const struct vec d_arm = below ? variation_of(view, place->link)->d : none;
    row->ports[row->port_count++] =
        (struct port){coupling->end[k].link,         k,     arm,
                      vec_scale(size, jet_value(e)), d_arm, vec_scale(size, jet_variation(e))};
}

static void add_couple(const struct coupling *coupling, int k, double size, struct row *row)
{
    const struct vec none = {0, 0};
    const double r = fabs(size);
    for (int side = 1; side >= -1; side -= 2)
        row->ports[row->port_count++] =
            (struct port){coupling->end[k].link, k, {side * r, 0}, {0, side * size / (2 * r)}, none, none};
}

void ratio_row(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
               struct row *row)
{
    struct jet g = jet_constant(-state->zero);
    struct place place = {0, 0, 0, 0};
    start_row(row, g);
    for (int k = 0; k < coupling->end_count; k++) {
        const struct ratio_term *term = &coupling->source->terms[k];
        if (!term->opposite) {
            place = place_of(view, coupling, k);
            g = jet_add(g, jet_scale(term->factor, coordinate_of(view, &place)));
        }
        const double size = term->opposite ? -term->factor : term->factor;
        if (is_angle(view, &place))
            add_couple(coupling, k, size, row);
        else
            add_force(view, coupling, k, &place, size, row);
    }
    row->g = g;
}
