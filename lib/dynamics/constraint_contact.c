/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows of contacts: a circle or a point at a line, two circles, a joint at its stop.
 */
#include "dynamics/constraint_view.h"

/* The surface is that of end 1, and runs counter-clockwise round it: with n the normal from end 1 to end 0 its velocity
 * is s k x n. The tangent of circles is k x u with u from the base to the circle; whichever of both is end 1, the rate
 * of g has -s. At a line the tangent e has n = +-side k x e with + for a base that is end 1, and again the rate is that
 * of the circle relative to the base, so that it has +side s in both cases. A line of the ground has its direction. */
static void row_move(const struct view *view, const struct coupling *coupling, double sign, struct row *along)
{
    if (!coupling->moves || sign == 0) return;
    double rate = 0, second = 0, same, dt = view->along ? view->along->dt : 0;
    double speed = coupling->surface_speed.constant;
    const struct expr *expr = coupling->surface_speed.expr;
    along->g.x = 0;
    if (expr && view->at)
        speed = expr_eval_second(expr, view->at->t, view->at->y, 0, 0,
                                 formula_branches(&coupling->surface_speed, view->at), &rate, &same, &second);
    along->surface = sign * speed;
    along->g =
        jet_sub(along->g, jet_scale(sign, (struct jet){0, speed, rate, speed * dt, rate * dt, second * dt}));
}

void row_line(const struct view *view, const struct coupling *coupling, const struct at_line *at, double zero,
              struct row *normal, struct row *along)
{
    struct jet_vec C = point_of(view, &at->circle), d = jet_vec_sub(C, point_of(view, &at->base));
    struct jet_vec e = turning(view, at->base.link, at->e);
    double s = at->side, R = at->circle.radius;
    struct jet_vec n = jet_vec_times(jet_constant(s), jet_perp(e));
    struct jet_vec Q = jet_vec_sub(C, jet_vec_times(jet_constant(R), n));
    struct jet turned = jet_sub(angle_of(view, at->circle.link), angle_of(view, at->base.link));
    struct jet g = jet_add(jet_dot(e, d), jet_scale(s * R, turned));
    start_row(along, jet_sub(g, jet_constant(zero)));
    row_move(view, coupling, at->moves, along);
    add_port(view, along, coupling, at->k, Q, e);
    add_port(view, along, coupling, 1 - at->k, Q, negative(e));
    if (!normal) return;
    start_row(normal, jet_sub(jet_dot(n, d), jet_constant(R)));
    add_port(view, normal, coupling, at->k, Q, n);
    add_port(view, normal, coupling, 1 - at->k, Q, negative(n));
}

/* Two circles, one of which may be a point: the normal is the line of centres, from 2 to 1. */
static void circles(const struct view *view, const struct coupling *coupling, const struct at_line *at,
                    double zero, struct row *normal, struct row *along)
{
    double R1 = at->circle.radius, R2 = at->base.radius;
    const double turn = 6.283185307179586;
    struct jet_vec C1 = point_of(view, &at->circle), d = jet_vec_sub(C1, point_of(view, &at->base));
    struct jet length = jet_norm(d), phi = jet_angle(d);
    struct jet_vec u = jet_vec_times(jet_inverse(length), d), t = jet_perp(u);
    struct jet_vec Q = jet_vec_sub(C1, jet_vec_times(jet_constant(R1), u));
    start_row(normal, jet_sub(length, jet_constant(R1 + R2)));
    add_port(view, normal, coupling, at->k, Q, u);
    add_port(view, normal, coupling, 1 - at->k, Q, negative(u));
    struct jet g = jet_add(jet_scale(R1, jet_sub(phi, angle_of(view, at->circle.link))),
                           jet_scale(R2, jet_sub(phi, angle_of(view, at->base.link))));
    start_row(along, nearest(jet_sub(g, jet_constant(zero)), turn * (R1 + R2)));
    row_move(view, coupling, 1, along);
    add_port(view, along, coupling, at->k, Q, t);
    add_port(view, along, coupling, 1 - at->k, Q, negative(t));
}

/* The ends of a contact in the order of its feature. */
static struct at_line at_feature(const struct view *view, const struct coupling *coupling,
                                 const struct coupling_state *state, bool *are_circles)
{
    const struct tree *tree = view->tree;
    const struct meeting *meeting = &tree->meetings[coupling->meeting];
    struct touch touch = meeting_touch(meeting, state->feature);
    int k = touch.moving;
    const double side = touch.side != 0 ? touch.side : state->side[0];
    *are_circles = touch.circles;
    return (struct at_line){
        .k = k,
        .circle = {.link = meeting->shape[k].link, .point = touch.point, .radius = touch.radius},
        .base = {.link = meeting->shape[1 - k].link, .point = touch.base, .radius = touch.base_radius},
        .e = touch.e,
        .side = side,
        .moves = coupling->source->contact.line ? 1 : -side};
}

/* A unit moment on a link, as two forces of a couple. */
static void add_couple(const struct view *view, struct row *row, const struct coupling *coupling, int k,
                       double size)
{
    for (int side = -1; side <= 1; side += 2) {
        struct jet_vec Q = origin_of(view, coupling->end[k].link);
        Q.x = jet_add(Q.x, jet_constant(0.5 * side));
        add_port(view, row, coupling, k, Q, (struct jet_vec){jet_constant(0), jet_constant(size * side)});
    }
}

/* A stop of a joint: s (q - limit), and a zero row along it. */
static void stop(const struct view *view, const struct coupling *coupling, const struct meeting *meeting,
                 struct row *rows)
{
    const struct tree_link *link = &view->tree->links[meeting->shape[0].link];
    int own = meeting->shape[0].link;
    double s = meeting->stop;
    start_row(&rows[1], jet_constant(0));
    if (link_joint(link)->has_axis) {
        struct jet q = jet_sub(angle_of(view, own), angle_of(view, link->parent));
        start_row(&rows[0], jet_scale(s, jet_sub(q, jet_constant(link->along + meeting->limit))));
        add_couple(view, &rows[0], coupling, 0, s);
        add_couple(view, &rows[0], coupling, 1, -s);
        return;
    }
    struct coupling_end zero = {.link = link->parent, .point = link->at};
    struct jet_vec O = origin_of(view, own), e = turning(view, link->parent, link->e);
    struct jet q = jet_dot(e, jet_vec_sub(O, point_of(view, &zero)));
    struct jet_vec f = jet_vec_times(jet_constant(s), e);
    start_row(&rows[0], jet_scale(s, jet_sub(q, jet_constant(meeting->limit))));
    add_port(view, &rows[0], coupling, 0, O, f);
    add_port(view, &rows[0], coupling, 1, O, negative(f));
}

void contact_rows(const struct view *view, const struct coupling *coupling,
                  const struct coupling_state *state, struct row *rows)
{
    bool are_circles;
    if (state->feature == no_feature) {
        if (rows[0].port_count == 0) return; /* they are zero already */
        start_row(&rows[0], jet_constant(0));
        start_row(&rows[1], jet_constant(0));
        return;
    }
    if (view->tree->meetings[coupling->meeting].stop != 0) {
        stop(view, coupling, &view->tree->meetings[coupling->meeting], rows);
        return;
    }
    struct at_line at = at_feature(view, coupling, state, &are_circles);
    if (are_circles)
        circles(view, coupling, &at, state->zero, &rows[0], &rows[1]);
    else
        row_line(view, coupling, &at, state->zero, &rows[0], &rows[1]);
}
