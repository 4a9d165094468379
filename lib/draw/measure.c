/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The size of a body on a sheet: its outline, and the points where forces act.
 */
#include "draw/panel.h"
#include "fbd_view.h"

/* Extend a rectangle in the frame of the body. */
static void take_point(struct vec *low, struct vec *high, struct vec point)
{
    *low = (struct vec){fmin(low->x, point.x), fmin(low->y, point.y)};
    *high = (struct vec){fmax(high->x, point.x), fmax(high->y, point.y)};
}

static void take_plate(const struct plate *plate, struct vec *low, struct vec *high)
{
    const struct vec reach = {plate->wheel, plate->wheel};
    for (size_t i = 0; i < plate->count; i++) take_point(low, high, plate->points[i]);
    if (!(plate->wheel > 0)) return;
    take_point(low, high, vec_sub(plate->hub, reach));
    take_point(low, high, vec_add(plate->hub, reach));
}

/* The points where forces act, without those of surfaces, which are drawn at the surface. */
static void take_forces(const struct panel *panel, struct vec *low, struct vec *high)
{
    const fbd_pose *pose = &panel->pose;
    for (size_t i = 0; i < panel->force_count; i++) {
        const fbd_arrow *arrow = &panel->forces[i].arrow;
        const struct vec way = {arrow->x - pose->x, arrow->y - pose->y};
        if (panel->forces[i].slide >= 0 || !isfinite(way.x) || !isfinite(way.y)) continue;
        const struct vec back = {pose->cosine, -pose->sine};
        take_point(low, high, vec_add(vec_of(panel->body.pin), vec_turn(back, way)));
    }
}

double panel_measure(struct panel *panel)
{
    const struct vec G = panel->G;
    struct vec low, high;
    panel->shaped = shapes_size(panel->model, panel->index, &low, &high);
    if (!panel->shaped) low = high = G;
    take_point(&low, &high, G);
    panel->plate = plate_of(panel->model, panel->view, panel->index);
    take_plate(&panel->plate, &low, &high);
    take_forces(panel, &low, &high);
    if (panel->body.motion == FBD_MOTION_PIVOT) take_point(&low, &high, vec_of(panel->body.pin));
    panel->middle = panel_place(panel, vec_scale(0.5, vec_add(low, high)));
    return vec_norm(vec_sub(high, low));
}
