/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Marks of a panel: the bush of a bearing with friction, the clamp of a body that is welded to the ground, and the forces
 * across a horizontal plane, which is seen from above.
 */
#include <string.h>

#include "draw/panel.h"
#include "fbd_view.h"

void panel_bush(struct panel *panel, struct vec axis)
{
    const double radius = 1.9, bore = 1.1;
    svg_circle(&panel->under, "mass", axis, radius);
    svg_circle(&panel->under, "hole", axis, bore);
    panel_avoid_circle(panel, axis, radius);
}

void panel_clamp(struct panel *panel)
{
    const struct vec at = panel_point(panel, panel_place(panel, vec_of(panel->body.pin))),
                     way = vec_sub(at, panel_point(panel, panel_place(panel, panel->G)));
    const double far = vec_norm(way), half = 5;
    const struct vec into = far > 1 ? vec_scale(1 / far, way) : (struct vec){0, 1},
                     side = vec_scale(half, vec_perp(into));
    if (panel->body.carrier == FBD_GROUND && panel->drawing->supports)
        panel_hatched_line(panel, vec_sub(at, side), vec_add(at, side), into);
}

/* True for a body that lies on the plane or on another body with friction. */
static bool lies(const struct panel *panel)
{
    for (size_t i = 0; i < fbd_view_coupling_count(panel->view); i++)
        if (strcmp(fbd_view_coupling(panel->view, i).kind, "plane") == 0 &&
            fbd_view_coupling_end(panel->view, i, 0).body == (int)panel->index)
            return true;
    return false;
}

void panel_gravity(struct panel *panel)
{
    const double pressing = fbd_model_scene(panel->model).pressing;
    const fbd_mass mass = fbd_view_mass(panel->view, panel->index);
    if (!(pressing > 0) || !(mass.mass > 0)) return;
    const char *weight = panel->symbols
                             ? arena_printf(panel->arena, "%sg", panel_indexed(panel->arena, mass.symbol))
                             : arena_printf(panel->arena, "gravity %s",
                                            panel_value(panel, mass.mass * pressing, panel->units.force)),
               *text =
                   weight ? arena_printf(panel->arena, "⊗ %s%s", weight, lies(panel) ? ", ⊙ N" : "") : NULL;
    if (text)
        panel_note(panel, text, panel_point(panel, panel_place(panel, panel->G)), (struct vec){0.8, 0.6});
}
