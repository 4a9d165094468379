/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Arrows of surfaces that run, springs about an axis, and stops of slides and pivots in the figure of the system, with the
 * letters of the file.
 */
#include <string.h>

#include "draw/figure.h"

static const double pi = 3.141592653589793;

/* ---- surfaces that run */

/* The speed of a surface: its letter or value, or the expression of the file; NULL where it rests. */
static const char *speed_text(struct figure *figure, const struct node *entry)
{
    const struct pair *speed = entry ? node_find(entry, "surface_speed") : NULL;
    const char *unit = arena_printf(&figure->arena, "%s/s", fbd_model_units(figure->model).length),
               *text = NULL;
    if (!speed || speed->value->kind != node_scalar) return NULL;
    if (unit) text = letters_text(&figure->letters, entry, "surface_speed", NAN, unit);
    return text ? text : speed->value->text;
}

/* An arrow in the ground below `at`, along the unit vector `e`. */
static void draw_speed(struct figure *figure, const char *text, struct vec at, struct vec e, struct vec into)
{
    const double below = 5, half = 7;
    const struct vec middle = vec_add(at, vec_scale(below, into)), way = vec_scale(half, e);
    panel_axis(figure->pen, vec_sub(middle, way), vec_add(middle, way), text);
}

/* The surface of the ground under a slide. */
static void draw_belt(struct figure *figure, const struct panel *panel)
{
    for (size_t i = 0; i < panel->force_count; i++) {
        const fbd_force *force = &panel->forces[i];
        if (strcmp(force->kind, "friction") != 0 || force->slide != (int)panel->index) continue;
        const char *text =
            speed_text(figure, letters_entry(&figure->letters, panel->body.name, force->arrow.name));
        const struct vec into = panel_direction(vec_scale(-1, vec_of(panel->pose.normal)));
        if (text)
            draw_speed(figure, text, panel_point(figure->pen, panel->base),
                       panel_direction(vec_of(panel->pose.along)), into);
    }
}

/* A surface that runs counter-clockwise round a polygon or a body. */
static void draw_circulation(struct figure *figure, const char *text, size_t connection, int body)
{
    const double radius = 6, least = -0.3 * pi, sweep = 1.6 * pi;
    const fbd_path path = fbd_model_path(figure->model, connection);
    struct vec middle = body < 0 ? (struct vec){0, 0} : figure->panels[body].G;
    double point[2];
    for (size_t i = 0; body < 0 && fbd_model_path_point(figure->model, connection, i, point); i++)
        middle = vec_add(middle, vec_scale(1 / (double)path.point_count, vec_of(point)));
    panel_turn(figure->pen, figure_point(figure, body, (double[]){middle.x, middle.y}), radius, least, sweep,
               text);
}

/* The surface of a contact or roll, once for all points of a contact. */
static void draw_running(struct figure *figure, size_t index)
{
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    const fbd_coupling_end end = fbd_view_coupling_end(figure->view, index, 0),
                           other = fbd_view_coupling_end(figure->view, index, 1);
    if (index > 0 && fbd_view_coupling(figure->view, index - 1).entry == coupling.entry) return;
    const char *text = speed_text(figure, letters_entry(&figure->letters, "", coupling.name));
    if (!text) return;
    if (!coupling.lined) {
        draw_circulation(figure, text, coupling.entry, other.body);
        return;
    }
    struct vec x = {1, 0};
    if (other.body >= 0)
        x = (struct vec){figure->panels[other.body].pose.cosine, figure->panels[other.body].pose.sine};
    const struct vec e = panel_direction(vec_turn(x, vec_unit(coupling.angle))),
                     n = vec_scale(-coupling.side, vec_perp(e)),
                     at = figure_point(figure, end.body, end.point),
                     line = figure_point(figure, other.body, other.point);
    draw_speed(figure, text, vec_sub(at, vec_scale(vec_dot(n, vec_sub(at, line)), n)), e, vec_scale(-1, n));
}

/* ---- springs about an axis */

/* A spiral around the axis, with the letter or the value of its stiffness. */
static void draw_coil(struct figure *figure, const struct panel *panel, const struct node *entry)
{
    enum { pieces = 60 };
    const double inner = 2.2, outer = 7, turns = 2.75;
    const bool pivot = panel->body.motion == FBD_MOTION_PIVOT;
    const struct vec axis =
        panel_point(figure->pen, panel_place(panel, pivot ? vec_of(panel->body.pin) : panel->G));
    const char *unit = arena_printf(&figure->arena, "%s/rad", panel->units.moment),
               *text = unit ? letters_text(&figure->letters, entry, "stiffness", NAN, unit) : NULL;
    struct vec last = vec_add(axis, (struct vec){inner, 0});
    for (int i = 1; i <= pieces; i++) {
        const double share = (double)i / pieces, radius = inner + (outer - inner) * share;
        const struct vec next =
            vec_add(axis, vec_scale(radius, panel_direction(vec_unit(2 * pi * turns * share))));
        panel_line(figure->pen, "thread", last, next, on_outline);
        last = next;
    }
    if (text)
        labelling_add(&figure->pen->labels, text, label_size, axis, (struct vec){0.7, 0.7}, outer + 0.6);
}

static void draw_coils(struct figure *figure, const struct panel *panel)
{
    for (size_t i = 0; i < panel->body.listed; i++) { /* without reactions of springs on other bodies */
        const fbd_force *force = &panel->forces[i];
        if (force->moment && strcmp(force->kind, "spring") == 0)
            draw_coil(figure, panel, letters_entry(&figure->letters, panel->body.name, force->arrow.name));
    }
}

/* ---- stops */

/* "x ≤ L", "θ ≥ −30°": a stop by its letter or value. */
static const char *stop_text(struct figure *figure, const struct panel *panel, bool high)
{
    const bool turns = panel->body.motion == FBD_MOTION_PIVOT;
    const double limit = panel->body.stops[high];
    const struct node *motion = letters_motion(&figure->letters, panel->body.name);
    const char *unit = panel->units.length, *text = NULL;
    if (!turns) text = letters_text(&figure->letters, motion, high ? "max" : "min", limit, unit);
    if (!text) text = turns ? panel_degrees(figure->pen, "", limit) : panel_text(&figure->arena, limit, unit);
    return arena_printf(&figure->arena, "%s %s %s", turns ? "θ" : "x", high ? "≤" : "≥", text ? text : "");
}

/* The place of the centre of mass, or for `touching` that of the end of the body, where a slide is at its limit. */
static struct vec stop_place(const struct panel *panel, bool high, bool touching)
{
    const struct vec e = vec_of(panel->pose.along), out = vec_scale(high ? 1 : -1, e);
    const double way = panel->body.stops[high] - panel_coordinate(panel, panel->body.coordinate),
                 reach = touching ? panel_reach(panel, out) : 0;
    return vec_add(panel_place(panel, panel->G), vec_add(vec_scale(way, e), vec_scale(reach, out)));
}

/* True for a stop that is there. */
static bool stops(const struct panel *panel, bool high)
{
    return !isnan(panel->body.stops[high]);
}

void figure_take_stops(const struct figure *figure, struct box *box)
{
    for (size_t b = 0; b < figure->count; b++)
        for (int high = 0; high < 2 && figure->panels[b].body.motion == FBD_MOTION_SLIDE; high++)
            if (stops(&figure->panels[b], high)) box_take(box, stop_place(&figure->panels[b], high, false));
}

/* A wall that the body touches at its limit. */
static void draw_wall(struct figure *figure, const struct panel *panel, bool high)
{
    const struct vec out = panel_direction(vec_scale(high ? 1 : -1, vec_of(panel->pose.along))),
                     at = panel_point(figure->pen, stop_place(panel, high, true)),
                     up = panel_direction(vec_of(panel->pose.normal));
    const char *text = stop_text(figure, panel, high);
    figure_wall(figure->pen, at, out);
    if (text) panel_note(figure->pen, text, vec_add(at, vec_scale(5, up)), up);
}

/* A short wall along the line of the body at its limit, hatched on the far side. */
static void draw_stop_of_pivot(struct figure *figure, const struct panel *panel, bool high)
{
    const double near = 9, far = 16, hub = 1;
    const struct vec axis = panel_place(panel, vec_of(panel->body.pin)),
                     x = {panel->pose.cosine, panel->pose.sine},
                     arm = vec_sub(panel_place(panel, panel->G), axis);
    const double turn = panel->body.stops[high] - panel_coordinate(panel, panel->body.coordinate);
    const struct vec line = vec_norm(arm) * panel->millimetres > hub ? vec_scale(1 / vec_norm(arm), arm) : x,
                     u = panel_direction(vec_turn(vec_unit(turn), line)), at = panel_point(figure->pen, axis);
    const char *text = stop_text(figure, panel, high);
    panel_hatched_line(figure->pen, vec_add(at, vec_scale(near, u)), vec_add(at, vec_scale(far, u)),
                       vec_scale(high ? -1 : 1, vec_perp(u)));
    if (text) panel_note(figure->pen, text, vec_add(at, vec_scale(far, u)), u);
}

void figure_surfaces(struct figure *figure)
{
    for (size_t b = 0; b < figure->count; b++) {
        const struct panel *panel = &figure->panels[b];
        draw_belt(figure, panel);
        draw_coils(figure, panel);
        for (int high = 0; high < 2; high++)
            if (stops(panel, high))
                (panel->body.motion == FBD_MOTION_SLIDE ? draw_wall : draw_stop_of_pivot)(figure, panel,
                                                                                          high);
    }
    for (size_t i = 0; i < fbd_view_coupling_count(figure->view); i++) draw_running(figure, i);
}
