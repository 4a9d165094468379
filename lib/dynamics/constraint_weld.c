/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A weld: a pin at the place p_A of its first end, where it was in the frame of its second body at the start of the
 * weld, and a row for the angle,
 *
 *     g = (p_A - p_B) . x,    g = (p_A - p_B) . y,    g = r (theta_A - theta_B) - g_0
 *
 * with a length r (model/coupling.c), so that all rows have one unit. The force of a unit multiplier of the last row is
 * the couple r on A and -r on B, each as two forces of 1/2 at the ends of a diameter of radius r.
 */
#include "dynamics/constraint_view.h"

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
