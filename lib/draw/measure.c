/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The size of a body on a sheet: its outline, and the points where forces act; blocks and wedges of conventional
 * size for slides without a shape; and the scale.
 */
#include "draw/panel.h"
#include "fbd_view.h"

/* Extend a rectangle in the frame of the body. */
static void take_point(struct vec *low, struct vec *high, struct vec point)
{
    *low = (struct vec){fmin(low->x, point.x), fmin(low->y, point.y)};
    *high = (struct vec){fmax(high->x, point.x), fmax(high->y, point.y)};
}

static void take_plate(const fbd_model *model, const struct plate *plate, struct vec *low, struct vec *high)
{
    double point[2];
    for (size_t i = 0; plate->cam >= 0 && fbd_model_path_point(model, (size_t)plate->cam, i, point); i++)
        take_point(low, high, vec_of(point));
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
    take_plate(panel->model, &panel->plate, &low, &high);
    take_forces(panel, &low, &high);
    if (panel->body.motion == FBD_MOTION_PIVOT) take_point(&low, &high, vec_of(panel->body.pin));
    panel->middle = panel_place(panel, vec_scale(0.5, vec_add(low, high)));
    return vec_norm(vec_sub(high, low));
}

static const double body_size = 54;

/* ---- blocks and wedges of conventional size, and scale */

bool panel_carries_level(const struct panel *panel)
{
    if (!panel->joined || panel->plate.rider < 0) return false;
    const struct vec e = vec_of(fbd_view_pose(panel->view, (size_t)panel->plate.rider).along),
                     own = vec_of(panel->pose.along);
    return fabs(vec_dot(e, own) * vec_cross(e, own)) < 1e-9;
}

struct vec panel_block(const struct panel *panel)
{
    const double wide = 2;
    if (!panel_carries_level(panel)) return panel->block;
    const struct vec e = vec_of(fbd_view_pose(panel->view, (size_t)panel->plate.rider).along);
    const bool along = fabs(vec_dot(e, vec_of(panel->pose.along))) > 0.5;
    return along ? (struct vec){wide * panel->block.x, panel->block.y}
                 : (struct vec){panel->block.y, wide * panel->block.x};
}

double panel_reach(const struct panel *panel, struct vec world)
{
    const struct vec e = {panel->pose.cosine, panel->pose.sine}, half = panel_block(panel);
    if (panel->shaped)
        return shapes_reach(panel->model, panel->index, panel->G,
                            (struct vec){vec_dot(world, e), vec_dot(world, vec_perp(e))});
    return (fabs(vec_dot(world, vec_of(panel->pose.along))) * half.x +
            fabs(vec_dot(world, vec_of(panel->pose.normal))) * half.y) /
           panel->millimetres;
}

void panel_wedge(struct panel *panel, struct vec corners[static 4])
{
    const fbd_body rider = fbd_model_body(panel->model, (size_t)panel->plate.rider);
    const double half = panel->block.x * 19 / 9, over = 6;
    struct vec turn = {panel->pose.cosine, panel->pose.sine}, e = vec_turn(turn, vec_of(rider.along)),
               n = vec_turn(turn, vec_of(rider.normal));
    struct vec G = panel_point(panel, panel_place(panel, panel->G));
    if (e.x < 0) e = vec_scale(-1, e);
    panel->seat = vec_add(G, panel_direction(vec_scale(over, n)));
    if (panel->joined) { /* under the sliding body, a block without a size */
        const struct vec on =
            vec_add(vec_of(fbd_view_pose(panel->view, (size_t)panel->plate.rider).G), panel->lift);
        panel->seat = vec_sub(panel_point(panel, on), panel_direction(vec_scale(panel->block.y, n)));
    }
    struct vec way = panel_direction(vec_scale(half, e)), left = vec_sub(panel->seat, way),
               right = vec_add(panel->seat, way);
    double base = fmax(fmax(left.y, right.y), G.y + panel->block.y);
    corners[0] = left;
    corners[1] = right;
    corners[2] = (struct vec){right.x, base};
    corners[3] = (struct vec){left.x, base};
}

/* Set the base from the distance between the centre of mass and the surface. */
static void set_base(struct panel *panel)
{
    struct vec G = panel->G, down = vec_scale(-1, vec_of(panel->pose.normal));
    double reach = panel_reach(panel, down);
    if (panel->plate.rider >= 0 && !panel_carries_level(panel)) {
        struct vec corners[4];
        panel_wedge(panel, corners);
        reach = (corners[2].y - panel_point(panel, panel_place(panel, G)).y) / panel->millimetres;
    }
    panel->base = vec_add(panel_place(panel, G), vec_scale(reach, down));
}

void panel_set_scale(struct panel *panel, double size, double largest)
{
    const double least = 8; /* mm on paper */
    double scale = largest > 0 ? 10 / round_up(10 * largest / body_size) : 1;
    panel->block = conventional_block;
    panel->enlarged = size > 1e-9 * largest && size * scale < least;
    panel->sized = size > 1e-9 * largest;
    panel->millimetres = panel->enlarged ? 10 / round_up(10 * size / (body_size / 3)) : scale;
    if (panel->body.motion == FBD_MOTION_SLIDE) set_base(panel);
}

void panel_join(struct panel *panel, struct vec middle, double millimetres, double share)
{
    panel->joined = true;
    panel->sized = true;
    panel->middle = middle;
    panel->millimetres = millimetres;
    panel->block = vec_scale(share, conventional_block);
    if (panel->body.motion == FBD_MOTION_SLIDE) set_base(panel);
}

void panel_lift(struct panel *panel, struct vec lift)
{
    panel->lift = lift;
    panel->pose.x += lift.x;
    panel->pose.y += lift.y;
    if (panel->body.motion == FBD_MOTION_SLIDE) set_base(panel);
}
