/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows of pins and welds.
 *
 * A weld is a pin at the place p_A of its first end, where it was in the frame of its second body at the start of the
 * weld, and a row for the angle,
 *
 *     g = (p_A - p_B) . x,    g = (p_A - p_B) . y,    g = r (theta_A - theta_B) - g_0
 *
 * with a length r (model/coupling.c), so that all rows have one unit. The force of a unit multiplier of the last row is
 * the couple r on A and -r on B, each as two forces of 1/2 at the ends of a diameter of radius r.
 */
#include "dynamics/constraint_view.h"

/* With their variations. */
static void pin_along(const struct view *view, const struct coupling *coupling, struct row *rows)
{
    struct jet_vec A = point_of(view, &coupling->end[0]), B = point_of(view, &coupling->end[1]),
                   d = jet_vec_sub(A, B);
    struct jet_vec unit[2] = {{jet_constant(1), jet_constant(0)}, {jet_constant(0), jet_constant(1)}};
    for (int k = 0; k < 2; k++) {
        start_row(&rows[k], k == 0 ? d.x : d.y);
        add_port(view, &rows[k], coupling, 0, A, unit[k]);
        add_port(view, &rows[k], coupling, 1, B, negative(unit[k]));
    }
}

/* Position, velocity and acceleration of a point, with its arm: the numbers of point_of without their
 * variations. */
struct place {
    struct vec p, v, a, arm;
};

static struct place place_of(const struct view *view, const struct coupling_end *end)
{
    const struct tree_state *s = &view->work->links[end->link];
    struct vec r = vec_turn(s->turn, end->point), k_r = vec_perp(r), p = vec_add(s->p, r);
    struct vec turning = vec_sub(vec_scale(s->A.alpha, k_r), vec_scale(s->omega * s->omega, r));
    return (struct place){p, vec_add(s->v, vec_scale(s->omega, k_r)), vec_add(s->A.a, turning),
                          vec_sub(p, s->p)};
}

void pin_rows(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
              struct row *rows)
{
    (void)state;
    if (view->varied) {
        pin_along(view, coupling, rows);
        return;
    }
    struct place A = place_of(view, &coupling->end[0]), B = place_of(view, &coupling->end[1]);
    struct vec d = vec_sub(A.p, B.p), v = vec_sub(A.v, B.v), a = vec_sub(A.a, B.a), none = {0, 0};
    start_row(&rows[0], (struct jet){.x = d.x, .x1 = v.x, .x2 = a.x});
    start_row(&rows[1], (struct jet){.x = d.y, .x1 = v.y, .x2 = a.y});
    for (int k = 0; k < 2; k++) {
        struct vec unit = {k == 0, k == 1};
        rows[k].port_count = 2;
        rows[k].ports[0] = (struct port){coupling->end[0].link, 0, A.arm, unit, none, none};
        rows[k].ports[1] = (struct port){coupling->end[1].link, 1, B.arm, vec_scale(-1, unit), none, none};
    }
}

void add_couples(const struct coupling *coupling, double r, double force, struct row *row)
{
    const struct vec none = {0, 0};
    for (int i = 0; i < 4; i++) {
        const int k = i / 2, side = i % 2 == 0 ? 1 : -1;
        const struct vec f = {0, (k == 0 ? side : -side) * force};
        row->ports[row->port_count++] = (struct port){coupling->end[k].link, k, {side * r, 0}, f, none, none};
    }
}

/* End 1: where end 0 was at the start. */
static struct coupling_end welded_end(const struct coupling *coupling, const struct coupling_state *state)
{
    struct coupling_end end = coupling->end[1];
    end.point = (struct vec){state->laid[0], state->laid[1]};
    return end;
}

void weld_rows(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
               struct row *rows)
{
    struct coupling as_pin = *coupling;
    const double r = coupling->end[0].radius;
    as_pin.end[1] = welded_end(coupling, state);
    pin_along(view, &as_pin, rows);
    if (!coupling_has_couple(coupling)) return;
    struct jet turned = jet_sub(angle_of(view, coupling->end[0].link), angle_of(view, coupling->end[1].link));
    start_row(&rows[2], jet_sub(jet_scale(r, turned), jet_constant(state->zero)));
    add_couples(coupling, r, 0.5, &rows[2]);
}

void weld_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *rows)
{
    const struct tree_state *base = &view->work->links[coupling->end[1].link];
    const struct vec apart = vec_sub(jet_value(point_of(view, &coupling->end[0])), base->p);
    state->laid[0] = vec_dot(base->turn, apart);
    state->laid[1] = vec_cross(base->turn, apart);
    weld_rows(view, coupling, state, rows);
    if (coupling_has_couple(coupling)) state->zero = rows[2].g.x;
}
