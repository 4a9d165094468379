/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Links with bodies of variable mass. Of such a body, with its G at r from O and the radius of gyration k
 * about it, the link has m, m r and m (k^2 + r^2): all proportional to m, and equal to the values at the
 * start plus those of the mass gained since, dm, so that a link of several bodies is a sum.
 */
#include "dynamics/tree.h"

static void restore(const struct tree_link *link, struct tree_state *s)
{
    s->mass = link->mass;
    s->I_O = link->I_O;
    s->mr = link->moment; /* in the frame of the link, until all dm are added */
    s->across = link->across;
}

static void come(const struct tree_bulk *bulk, double dm, struct tree_state *s)
{
    s->mass += dm;
    s->mr = vec_add(s->mr, vec_scale(dm, bulk->G));
    s->I_O += dm * (bulk->square + vec_dot(bulk->G, bulk->G));
}

/* m I_G / I_O: of a single body proportional to m. */
static double across(const struct tree_link *link, const struct tree_state *s, double square)
{
    double I_G = s->I_O - square / s->mass;
    return s->I_O > 0 && link->across > 0 ? fmax(s->mass * I_G / s->I_O, 0) : 0;
}

void tree_weigh(const struct tree *tree, const struct instant *at)
{
    struct tree_state *links = at->tree->links;
    for (size_t i = 0; i < tree->bulk_count; i++)
        restore(&tree->links[tree->bulks[i].link], &links[tree->bulks[i].link]);
    for (size_t i = 0; i < tree->bulk_count; i++) {
        const struct tree_bulk *bulk = &tree->bulks[i];
        come(bulk, formula_value(&bulk->mass, at) - bulk->start, &links[bulk->link]);
    }
    for (size_t i = 0; i < tree->bulk_count; i++) {
        struct tree_state *s = &links[tree->bulks[i].link];
        if (!tree->bulks[i].last) continue;
        s->across = across(&tree->links[tree->bulks[i].link], s, vec_dot(s->mr, s->mr));
        s->mr = vec_turn(s->turn, s->mr);
    }
}

void tree_weights(const struct tree *tree, const struct instant *at)
{
    for (size_t i = 0; i < tree->bulk_count; i++) {
        const struct tree_bulk *bulk = &tree->bulks[i];
        struct tree_rhs *x = &at->tree->x[bulk->link];
        struct vec r = vec_turn(at->tree->links[bulk->link].turn, bulk->G);
        struct vec f = vec_scale(formula_value(&bulk->mass, at), bulk->g);
        x->p.force = vec_sub(x->p.force, f);
        x->p.moment -= vec_cross(r, f);
    }
}

/* At fixed accelerations: the inertial force of more mass minus its weight, and the moment of the weight as
 * the arm turns. */
void tree_bulk_along(const struct tree *tree, const struct instant *at, const struct direction *along)
{
    for (size_t i = 0; i < tree->bulk_count; i++) {
        const struct tree_bulk *bulk = &tree->bulks[i];
        const struct tree_state *s = &at->tree->links[bulk->link];
        struct tree_rhs *x = &at->tree->x[bulk->link];
        double dm, m = formula_along(&bulk->mass, at, along, &dm);
        struct vec r = vec_turn(s->turn, bulk->G);
        struct vec a =
            vec_add(s->A.a, vec_sub(vec_scale(s->A.alpha, vec_perp(r)), vec_scale(s->omega * s->omega, r)));
        struct vec f = vec_scale(dm, vec_sub(a, bulk->g));
        struct vec dr = vec_scale(at->tree->variation[bulk->link].angle, vec_perp(r));
        x->p.force = vec_add(x->p.force, f);
        x->p.moment +=
            vec_cross(r, f) + dm * bulk->square * s->A.alpha - vec_cross(dr, vec_scale(m, bulk->g));
    }
}
