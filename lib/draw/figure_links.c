/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Connections of the bodies in the figure of the system: springs and dampers, actuators, pins, welds, gears, racks. Ropes,
 * rods and belts are in figure_ropes.c, grooves and the ground in figure_ground.c.
 */
#include <string.h>

#include "draw/figure.h"

static const double pi = 3.141592653589793;

/* ---- springs and dampers */

static void zigzag(struct panel *pen, struct vec from, struct vec to)
{
    enum { turns = 12 };
    const struct vec way = vec_sub(to, from);
    const double length = vec_norm(way), lead = 0.15;
    if (!(length > 0)) return;
    const struct vec side = vec_scale(1.8 / length, vec_perp(way));
    struct vec last = from;
    for (int i = 0; i <= turns; i++) {
        const double share = lead + (1 - 2 * lead) * i / turns;
        const double sign = i == 0 || i == turns ? 0 : i % 2 ? 1 : -1;
        const struct vec next = vec_add(vec_add(from, vec_scale(share, way)), vec_scale(sign, side));
        panel_line(pen, "thread", last, next, on_outline);
        last = next;
    }
    panel_line(pen, "thread", last, to, on_outline);
}

/* A cylinder open to one end, with a piston in it. */
static void dashpot(struct panel *pen, struct vec from, struct vec to)
{
    const struct vec way = vec_sub(to, from);
    const double length = vec_norm(way), half = 1.8;
    if (!(length > 0)) return;
    const struct vec u = vec_scale(1 / length, way), n = vec_scale(half, vec_perp(u)),
                     middle = vec_add(from, vec_scale(0.5, way)), base = vec_sub(middle, vec_scale(3, u)),
                     open = vec_add(middle, vec_scale(3, u));
    panel_line(pen, "thread", from, base, on_outline);
    panel_line(pen, "thread", vec_sub(base, n), vec_add(base, n), on_outline);
    panel_line(pen, "thread", vec_sub(base, n), vec_sub(open, n), on_outline);
    panel_line(pen, "thread", vec_add(base, n), vec_add(open, n), on_outline);
    panel_line(pen, "thread", vec_sub(middle, vec_scale(0.8, n)), vec_add(middle, vec_scale(0.8, n)),
               on_outline);
    panel_line(pen, "thread", middle, to, on_outline);
}

/* The letter or the value of a stiffness or damping coefficient. */
static void name_spring(struct figure *figure, const fbd_spring *spring, struct vec from, struct vec to)
{
    const fbd_units units = fbd_model_units(figure->model);
    const struct node *entry =
        letters_entry(&figure->letters, fbd_model_body_name(figure->model, (size_t)spring->body),
                      spring->name);
    const char *unit = arena_printf(&figure->arena, spring->damper ? "%s*s/%s" : "%s/%s", units.force,
                                    units.length),
               *text = unit ? letters_text(&figure->letters, entry,
                                           spring->damper ? "coefficient" : "stiffness", NAN, unit)
                            : NULL;
    const struct vec way = vec_sub(to, from), side = vec_scale(1 / vec_norm(way), vec_perp(way));
    if (text)
        labelling_add(&figure->pen->labels, text, label_size, vec_scale(0.5, vec_add(from, to)), side, 2.6);
}

/* Sine of the slope up to which a line counts as level. */
static const double level = 0.1;

static void draw_spring(struct figure *figure, size_t index)
{
    const fbd_spring spring = fbd_view_spring(figure->view, index);
    struct panel *pen = figure->pen;
    struct vec from = figure_point(figure, spring.body, spring.point), to;
    const bool grounded = spring.partner < 0, placed = !isnan(spring.anchor[0]);
    if (placed) {
        to = figure_point(figure, spring.partner, spring.anchor);
    } else { /* a wall above the body, behind it on a level line; beside that of an earlier one */
        const struct vec e = panel_direction(vec_of(figure->panels[spring.body].pose.along));
        from = vec_add(from, vec_scale(index % 2 ? 3 : -3, vec_perp(e)));
        to = vec_add(from, vec_scale(e.y < -level ? wall_distance : -wall_distance, e));
    }
    const struct vec way = vec_sub(to, from);
    if (!(vec_norm(way) > 0)) return;
    (spring.damper ? dashpot : zigzag)(pen, from, to);
    name_spring(figure, &spring, from, to);
    if (grounded) figure_wall(pen, to, vec_scale(1 / vec_norm(way), way));
}

/* ---- couplings */

/* Teeth as short lines across the pitch circle, whose distance is the same on both wheels; on the inside of a ring
 * gear. */
static void draw_teeth(struct figure *figure, size_t index)
{
    enum { fewest = 12, most = 400 };
    const fbd_coupling_end ends[] = {fbd_view_coupling_end(figure->view, index, 0),
                                     fbd_view_coupling_end(figure->view, index, 1)};
    const double least = fmin(fabs(ends[0].radius), fabs(ends[1].radius));
    for (int k = 0; k < 2 && least > 0; k++) {
        const struct vec center = figure_point(figure, ends[k].body, ends[k].point);
        const double radius = fabs(ends[k].radius) * figure->pen->millimetres,
                     teeth = fmin(most, round(fewest * fabs(ends[k].radius) / least));
        for (int i = 0; i < (int)teeth; i++) {
            const struct vec u = vec_unit(2 * pi * i / teeth);
            svg_line(&figure->pen->under, "thread", vec_add(center, vec_scale(radius - 0.9, u)),
                     vec_add(center, vec_scale(radius + 0.9, u)));
        }
        box_take_circle(&figure->pen->extent, center, radius + 0.9);
    }
}

/* A rack on a body: the line that touches the wheel, with teeth at a twelfth of its circumference. */
static void draw_rack(struct figure *figure, size_t index)
{
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    const fbd_coupling_end wheel = fbd_view_coupling_end(figure->view, index, 0),
                           line = fbd_view_coupling_end(figure->view, index, 1);
    if (line.body < 0 || wheel.place_count == 0) return;
    struct panel *pen = figure->pen;
    const double radius = fabs(wheel.radius) * pen->millimetres, pitch = pi * radius / 6, half = 2.5 * pitch;
    const struct vec touched = figure_place_of(figure, wheel.body, wheel.places[0]),
                     out = vec_sub(touched, figure_point(figure, wheel.body, wheel.point)),
                     n = vec_scale(0.9 / vec_norm(out), out), e = vec_perp(vec_scale(1 / vec_norm(out), out));
    if (!(vec_norm(out) > 0) || !coupling.lined) return;
    panel_line(pen, "thread", vec_sub(touched, vec_scale(half, e)), vec_add(touched, vec_scale(half, e)),
               on_outline);
    for (int i = -2; i <= 2; i++) {
        const struct vec at = vec_add(touched, vec_scale(i * pitch, e));
        panel_line(pen, "thread", vec_sub(at, n), vec_add(at, n), on_outline);
    }
}

/* A cross; at a wall beyond it, seen from the body, if it is one to the ground. */
static void draw_weld(struct figure *figure, size_t index)
{
    const double half = 1.1;
    const fbd_coupling_end ends[] = {fbd_view_coupling_end(figure->view, index, 0),
                                     fbd_view_coupling_end(figure->view, index, 1)};
    const int body = ends[0].body < 0 ? ends[1].body : ends[0].body;
    const struct vec at = figure_point(figure, ends[0].body, ends[0].point),
                     arms[] = {{half, half}, {half, -half}};
    if (ends[0].body < 0 || ends[1].body < 0) {
        const struct vec G =
            panel_point(figure->pen, panel_place(&figure->panels[body], figure->panels[body].G));
        const double far = vec_norm(vec_sub(at, G));
        figure_wall(figure->pen, at, far > half ? vec_scale(1 / far, vec_sub(at, G)) : (struct vec){0, 1});
    }
    for (int i = 0; i < 2; i++)
        panel_line(figure->pen, "thread", vec_sub(at, arms[i]), vec_add(at, arms[i]), 4);
}

/* A pin, with a bearing on the side away from the body where it is on the ground. */
static void draw_pin(struct figure *figure, size_t index)
{
    const fbd_coupling_end ends[] = {fbd_view_coupling_end(figure->view, index, 0),
                                     fbd_view_coupling_end(figure->view, index, 1)};
    const struct vec at = figure_point(figure, ends[0].body, ends[0].point);
    if (ends[1].body < 0) panel_bearing(figure->pen, at, 1);
    svg_circle(&figure->pen->under, "hole", at, pin_radius);
}

/* True for a pin or weld whose points are at one place in the scene: others begin later. */
static bool is_joined(const struct figure *figure, size_t index)
{
    const double apart = 0.1; /* [mm] */
    struct vec at[2];
    for (int k = 0; k < 2; k++) {
        const fbd_coupling_end end = fbd_view_coupling_end(figure->view, index, (size_t)k);
        const struct vec lift = end.body < 0 ? (struct vec){0, 0} : figure->panels[end.body].lift;
        at[k] = vec_sub(figure_place(figure, end.body, end.point), lift);
    }
    return vec_norm(vec_sub(at[1], at[0])) * figure->pen->millimetres < apart;
}

/* Draw a coupling that is seen in front of its bodies. */
static void draw_coupling_over(struct figure *figure, size_t index)
{
    const char *kind = fbd_view_coupling(figure->view, index).kind;
    if (strcmp(kind, "belt") == 0) figure_belt(figure, index);
    if (strcmp(kind, "rope") == 0 || strcmp(kind, "rod") == 0) figure_rope_over(figure, index);
    if (strcmp(kind, "gear") == 0) draw_teeth(figure, index);
    if (strcmp(kind, "rack") == 0) draw_rack(figure, index);
    if (strcmp(kind, "slot") == 0) figure_groove(figure, index);
    if (strcmp(kind, "pin") == 0 && is_joined(figure, index)) draw_pin(figure, index);
    if (strcmp(kind, "weld") == 0 && is_joined(figure, index)) draw_weld(figure, index);
}

/* Draw a coupling that is seen beneath its bodies. */
static void draw_coupling(struct figure *figure, size_t index)
{
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    if (coupling.lined)
        figure_line(figure, index);
    else if (strcmp(coupling.kind, "rod") == 0 || strcmp(coupling.kind, "rope") == 0)
        figure_rope(figure, index);
    else if (strcmp(coupling.kind, "plane") == 0)
        figure_plane(figure, index);
    else if (strcmp(coupling.kind, "contact") == 0)
        figure_peg(figure, index);
}

void figure_links(struct figure *figure)
{
    for (size_t i = 0; i < fbd_view_spring_count(figure->view); i++) draw_spring(figure, i);
    figure_polygons(figure);
    for (size_t i = 0; i < fbd_view_coupling_count(figure->view); i++) draw_coupling(figure, i);
}

/* A cylinder on the first point, with its rod at the second one. */
static void draw_ram(struct figure *figure, struct vec from, struct vec to, const char *name)
{
    const double half = 2, begins = 0.15, ends = 0.65;
    struct panel *pen = figure->pen;
    const struct vec way = vec_sub(to, from), side = vec_scale(half / vec_norm(way), vec_perp(way)),
                     near = vec_add(from, vec_scale(begins, way)), far = vec_add(from, vec_scale(ends, way)),
                     corners[] = {vec_add(near, side), vec_add(far, side), vec_sub(far, side),
                                  vec_sub(near, side)};
    panel_line(pen, "thread", from, to, on_outline);
    svg_polygon(&pen->under, "body", corners, 4);
    for (int i = 0; i < 4; i++) labelling_avoid(&pen->labels, corners[i], corners[(i + 1) % 4], on_outline);
    svg_circle(&pen->under, "hole", from, pin_radius);
    svg_circle(&pen->under, "hole", to, pin_radius);
    labelling_add(&pen->labels, panel_indexed(&figure->arena, name), label_size,
                  vec_add(from, vec_scale((begins + ends) / 2, way)), vec_scale(1 / half, side), half + 0.8);
}

bool figure_has_ram(const struct figure *figure, const char *name)
{
    for (size_t i = 0; i < fbd_model_connection_count(figure->model); i++) {
        const fbd_connection connection = fbd_model_connection(figure->model, i);
        if (strcmp(connection.kind, "actuator") == 0 && strcmp(connection.name, name) == 0)
            return node_find(letters_entry(&figure->letters, "", name), "force") != NULL;
    }
    return false;
}

/* Actuators with a force between two points; those with a moment are arcs. */
static void draw_rams(struct figure *figure)
{
    for (size_t i = 0; i < fbd_model_connection_count(figure->model); i++) {
        const fbd_connection connection = fbd_model_connection(figure->model, i);
        if (strcmp(connection.kind, "actuator") != 0 || !figure_has_ram(figure, connection.name)) continue;
        struct vec at[2];
        for (int k = 0; k < 2; k++) {
            const fbd_connection_end *end = &connection.ends[k];
            const bool center = end->center && end->body >= 0;
            const struct vec G = center ? figure->panels[end->body].G : vec_of(end->point);
            at[k] = figure_point(figure, end->body, (double[]){G.x, G.y});
        }
        if (vec_norm(vec_sub(at[1], at[0])) > 0) draw_ram(figure, at[0], at[1], connection.name);
    }
}

void figure_links_over(struct figure *figure)
{
    draw_rams(figure);
    for (size_t i = 0; i < fbd_view_coupling_count(figure->view); i++) draw_coupling_over(figure, i);
}
