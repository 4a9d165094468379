/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The fixtures of a panel: outline and centre of mass of the body, its surface or axis, and its coordinate.
 */

#include <string.h>

#include "draw/panel.h"
#include "fbd_view.h"

static const double pi = 3.141592653589793, surface_half = 34, free_half = 20, hatch_step = 2.4;

/* Of a point mass, and of a body without a size that turns. */
static const double dot_radius = 1.6, conventional_disc = 8;

struct vec panel_point(const struct panel *panel, struct vec world)
{
    return vec_scale(panel->millimetres, panel_direction(vec_sub(world, panel->middle)));
}

void panel_line(struct panel *panel, const char *css, struct vec from, struct vec to, double cost)
{
    svg_line(&panel->under, css, from, to);
    box_take(&panel->extent, from);
    box_take(&panel->extent, to);
    if (cost > 0) labelling_avoid(&panel->labels, from, to, cost);
}

void panel_note(struct panel *panel, const char *string, struct vec anchor, struct vec toward)
{
    labelling_add(&panel->labels, string, label_size, anchor, toward, 1);
}

static bool on_ground(const struct panel *panel)
{
    return panel->body.carrier == FBD_GROUND;
}

/* ---- the body */

/* Avoid both edges of a bar, which has round ends. */
static void avoid_bar(struct panel *panel, struct vec from, struct vec to)
{
    const double half_width = 1.3;
    struct vec d = vec_sub(to, from);
    const double length = vec_norm(d);
    if (length == 0) return;
    const struct vec end = vec_scale(half_width / length, d), side = vec_perp(end);
    from = vec_sub(from, end);
    to = vec_add(to, end);
    labelling_avoid(&panel->labels, vec_add(from, side), vec_add(to, side), on_outline);
    labelling_avoid(&panel->labels, vec_sub(from, side), vec_sub(to, side), on_outline);
}

void panel_avoid_circle(struct panel *panel, struct vec center, double radius)
{
    enum { sides = 32 };
    for (int i = 0; i < sides; i++) {
        const struct vec from = vec_unit(2 * pi * i / sides), to = vec_unit(2 * pi * (i + 1) / sides);
        labelling_avoid(&panel->labels, vec_add(center, vec_scale(radius, from)),
                        vec_add(center, vec_scale(radius, to)), on_outline);
    }
}

static void draw_part(struct panel *panel, const fbd_shape *part)
{
    struct text *text = &panel->under;
    struct vec center = panel_point(panel, panel_place(panel, vec_of(part->center))),
               corners[FBD_MOST_CORNERS] = {{0, 0}};
    const char *css = part->hole ? "hole" : "body";
    for (size_t i = 0; i < part->corner_count; i++)
        corners[i] = panel_point(panel, panel_place(panel, vec_of(part->corners[i])));
    switch (part->kind) {
    case FBD_SHAPE_DOT: svg_circle(text, "mass", center, dot_radius); break;
    case FBD_SHAPE_CIRCLE:
        svg_circle(text, css, center, part->radius * panel->millimetres);
        if (part->inner > 0) svg_circle(text, "hole", center, part->inner * panel->millimetres);
        break;
    case FBD_SHAPE_BAR:
        svg_line(text, "bar", corners[0], corners[1]);
        svg_line(text, "bar-inside", corners[0], corners[1]);
        avoid_bar(panel, corners[0], corners[1]);
        break;
    case FBD_SHAPE_POLYGON:
        svg_polygon(text, css, corners, part->corner_count);
        for (size_t i = 0; i < part->corner_count; i++)
            labelling_avoid(&panel->labels, corners[i], corners[(i + 1) % part->corner_count], on_outline);
        break;
    case FBD_SHAPE_UNKNOWN: break;
    }
}

static void take_part(struct panel *panel, const fbd_shape *part)
{
    double reach = part->kind == FBD_SHAPE_CIRCLE ? part->radius * panel->millimetres : dot_radius;
    struct vec center = panel_point(panel, panel_place(panel, vec_of(part->center)));
    box_take(&panel->extent, (struct vec){center.x - reach, center.y - reach});
    box_take(&panel->extent, (struct vec){center.x + reach, center.y + reach});
    for (size_t i = 0; i < part->corner_count; i++)
        box_take(&panel->extent, panel_point(panel, panel_place(panel, vec_of(part->corners[i]))));
    if (part->kind == FBD_SHAPE_CIRCLE) panel_avoid_circle(panel, center, reach);
}

/* Draw the edge of the body. */
static void edge(struct panel *panel, const struct vec *corners, size_t count)
{
    svg_polygon(&panel->under, "body", corners, count);
    for (size_t i = 0; i < count; i++) {
        labelling_avoid(&panel->labels, corners[i], corners[(i + 1) % count], on_outline);
        box_take(&panel->extent, corners[i]);
    }
}

static void draw_cam(struct panel *panel)
{
    const size_t connection = (size_t)panel->plate.cam,
                 count = fbd_model_path(panel->model, connection).point_count;
    struct vec *corners = ARENA_ARRAY(panel->arena, count, struct vec);
    double point[2];
    for (size_t i = 0; corners && fbd_model_path_point(panel->model, connection, i, point); i++)
        corners[i] = panel_point(panel, panel_place(panel, vec_of(point)));
    if (corners) edge(panel, corners, count);
}

/* Draw the outline of a cam; a wheel with a spoke that shows its angle; or a bar or plate through the points. */
static void draw_plate(struct panel *panel)
{
    const struct plate *plate = &panel->plate;
    if (plate->cam >= 0) {
        draw_cam(panel);
    } else if (plate->wheel > 0) {
        fbd_shape disc = {.kind = FBD_SHAPE_CIRCLE,
                          .center = {plate->hub.x, plate->hub.y},
                          .radius = plate->wheel};
        draw_part(panel, &disc);
        take_part(panel, &disc);
        struct vec hub = panel_point(panel, panel_place(panel, plate->hub)),
                   spoke = panel_direction((struct vec){panel->pose.cosine, panel->pose.sine});
        panel_line(panel, "thread", hub, vec_add(hub, vec_scale(plate->wheel * panel->millimetres, spoke)),
                   on_outline);
    } else if (plate->count == 2) {
        fbd_shape bar = {.kind = FBD_SHAPE_BAR,
                         .corner_count = 2,
                         .corners = {{plate->points[0].x, plate->points[0].y},
                                     {plate->points[1].x, plate->points[1].y}}};
        draw_part(panel, &bar);
        take_part(panel, &bar);
    } else if (plate->count > 2) {
        struct vec corners[most_plate_points];
        for (size_t i = 0; i < plate->count; i++)
            corners[i] = panel_point(panel, panel_place(panel, plate->points[i]));
        edge(panel, corners, plate->count);
    }
    for (size_t i = 0; i < plate->count; i++)
        svg_circle(&panel->under, "hole", panel_point(panel, panel_place(panel, plate->points[i])),
                   pin_radius);
}

/* Draw a body without a size: a block on a slide, a disc elsewhere. */
static void draw_sizeless(struct panel *panel)
{
    struct vec G = panel_point(panel, panel_place(panel, panel->G));
    if (panel->plate.cam >= 0 || panel->plate.wheel > 0 || panel->plate.count > 1) {
        draw_plate(panel);
        return;
    }
    if (panel->plate.rider >= 0 && !panel_carries_level(panel)) {
        struct vec corners[4];
        panel_wedge(panel, corners);
        edge(panel, corners, 4);
        return;
    }
    if (panel->body.motion == FBD_MOTION_PIVOT && !(panel->joined && panel_fixtures_in_front(panel)))
        return; /* the bearing shows its position */
    if (panel->body.motion != FBD_MOTION_SLIDE) {
        bool point = panel->body.motion == FBD_MOTION_PARTICLE || panel->body.motion == FBD_MOTION_TRACK;
        const double radius = point ? dot_radius : conventional_disc;
        svg_circle(&panel->under, point ? "mass" : "body", G, radius);
        panel_avoid_circle(panel, G, radius);
        return;
    }
    if (panel->joined && panel->plate.rods > 1) { /* the end of a truss, on a roller */
        const double r = panel->block.y / 2;
        const struct vec n = panel_direction(vec_of(panel->pose.normal));
        svg_circle(&panel->under, "support", vec_sub(G, vec_scale(r, n)), r);
        svg_circle(&panel->under, "hole", G, pin_radius);
        return;
    }
    const struct vec half = panel_block(panel);
    struct vec along = vec_scale(half.x, panel_direction(vec_of(panel->pose.along))),
               up = vec_scale(half.y, panel_direction(vec_of(panel->pose.normal)));
    struct vec corners[] = {vec_add(G, vec_add(along, up)), vec_add(G, vec_sub(up, along)),
                            vec_sub(G, vec_add(along, up)), vec_add(G, vec_sub(along, up))};
    edge(panel, corners, 4);
}

/* Draw the mark of a centre of mass: a circle of four quarters. */
static void draw_center(struct panel *panel)
{
    const double r = 1.5;
    struct vec G = panel_point(panel, panel_place(panel, panel->G));
    svg_circle(&panel->under, "center", G, r);
    text_add(&panel->under, "<path class=\"center-dark\" d=\"M");
    svg_point(&panel->under, G);
    text_printf(&panel->under,
                " v%.2f a%.2f %.2f 0 0 1 %.2f %.2f z m0,0 v%.2f a%.2f %.2f 0 0 1 %.2f %.2f z\"/>\n", -r, r, r,
                r, r, r, r, r, -r, -r);
    labelling_avoid(&panel->labels, (struct vec){G.x - r, G.y}, (struct vec){G.x + r, G.y}, on_outline);
    labelling_add(&panel->labels, "G", label_size, G, (struct vec){-0.8, -0.6}, r + 0.4);
}

/* True for a body of one part whose centre of mass is not the middle of its drawing: an eccentric wheel, an arm without a
 * shape. */
static bool hides_center(const struct panel *panel)
{
    const struct plate *plate = &panel->plate;
    const fbd_shape part = fbd_model_shape(panel->model, panel->index, 0);
    const bool shaped = part.kind != FBD_SHAPE_UNKNOWN,
               arm = panel->body.motion == FBD_MOTION_PIVOT && plate->count < 2 && plate->cam < 0;
    if (fbd_model_shape_count(panel->model, panel->index) != 1 || !(shaped || arm || plate->wheel > 0))
        return false;
    const struct vec pin = plate->wheel > 0 ? plate->hub : vec_of(panel->body.pin),
                     shown = shaped ? vec_of(part.center) : pin;
    return vec_norm(vec_sub(panel->G, shown)) * panel->millimetres > pin_radius;
}

void panel_body(struct panel *panel)
{
    const size_t shapes = fbd_model_shape_count(panel->model, panel->index);
    text_printf(&panel->under, "<g class=\"outline\" id=\"%s-outline\">\n", panel->body.name);
    if (panel->body.motion == FBD_MOTION_PIVOT) { /* threads from the axis to the parts */
        struct vec axis = panel_point(panel, panel_place(panel, vec_of(panel->body.pin)));
        for (size_t i = 0; i < shapes; i++) {
            fbd_shape part = fbd_model_shape(panel->model, panel->index, i);
            panel_line(panel, "thread", axis, panel_point(panel, panel_place(panel, vec_of(part.center))),
                       on_outline);
        }
    }
    struct vec low, high;
    if (!shapes_size(panel->model, panel->index, &low, &high)) draw_sizeless(panel);
    for (int holes = 0; holes < 2; holes++)
        for (size_t i = 0; i < shapes; i++) {
            fbd_shape part = fbd_model_shape(panel->model, panel->index, i);
            if (part.hole != (holes == 1)) continue;
            const bool block = panel->joined && panel->body.motion == FBD_MOTION_SLIDE;
            bool plain_dot = part.kind == FBD_SHAPE_DOT && (!panel->sized || block);
            if (!plain_dot) draw_part(panel, &part);
            take_part(panel, &part);
        }
    if (!panel->joined || hides_center(panel)) draw_center(panel);
    text_add(&panel->under, "</g>\n");
}

/* ---- the ground under it */

void panel_hatched_line(struct panel *panel, struct vec from, struct vec to, struct vec into)
{
    struct vec d = vec_sub(to, from);
    double length = vec_norm(d);
    struct vec unit = vec_scale(1 / length, d);
    panel_line(panel, "ground", from, to, on_outline);
    text_add(&panel->under, "<path class=\"hatch\" d=\"");
    int count = (int)(length / hatch_step);
    for (int i = 0; i <= count; i++) {
        struct vec start = vec_add(from, vec_scale(i * hatch_step, unit));
        struct vec end = vec_add(start, vec_scale(hatch_step, vec_sub(into, vec_scale(0.8, unit))));
        text_add(&panel->under, i ? " M" : "M");
        svg_point(&panel->under, start);
        text_add(&panel->under, " L");
        svg_point(&panel->under, end);
        box_take(&panel->extent, end);
    }
    text_add(&panel->under, "\"/>\n");
    struct vec deep = vec_scale(hatch_step * 0.6, into);
    labelling_avoid(&panel->labels, vec_add(from, deep), vec_add(to, deep), 2);
}

void panel_axis(struct panel *panel, struct vec from, struct vec to, const char *name)
{
    struct vec d = vec_sub(to, from), unit = vec_scale(1 / vec_norm(d), d);
    struct vec back = vec_sub(to, vec_scale(2, unit)), side = vec_scale(0.8, vec_perp(unit));
    struct vec head[] = {to, vec_add(back, side), vec_sub(back, side)};
    panel_line(panel, "axis", from, back, 4);
    svg_polygon(&panel->under, "axis-head", head, 3);
    box_take(&panel->extent, to);
    panel_note(panel, name, to, unit);
}

void panel_turn(struct panel *panel, struct vec center, double radius, double a, double sweep,
                const char *name)
{
    double end = a + sweep, bow = fmin(fabs(sweep), 1.8 / radius);
    double shaft = end - copysign(bow, sweep);
    struct vec from = vec_add(center, vec_scale(radius, panel_direction(vec_unit(a)))),
               to = vec_add(center, vec_scale(radius, panel_direction(vec_unit(shaft)))),
               tip = vec_add(center, vec_scale(radius, panel_direction(vec_unit(end))));
    text_add(&panel->under, "<path class=\"axis\" d=\"M");
    svg_point(&panel->under, from);
    text_printf(&panel->under, " A%.2f %.2f 0 %d %d ", radius, radius, fabs(sweep) - bow > pi, sweep < 0);
    svg_point(&panel->under, to);
    text_add(&panel->under, "\"/>\n");
    struct vec chord = vec_sub(tip, to);
    double length = vec_norm(chord);
    if (length > 0.3) {
        struct vec side = vec_scale(0.7 / length, vec_perp(chord));
        struct vec head[] = {tip, vec_add(to, side), vec_sub(to, side)};
        svg_polygon(&panel->under, "axis-head", head, 3);
    }
    enum { pieces = 8 };
    struct vec last = from;
    for (int i = 1; i <= pieces; i++) {
        struct vec next =
            vec_add(center, vec_scale(radius, panel_direction(vec_unit(a + sweep * i / pieces))));
        labelling_avoid(&panel->labels, last, next, 8);
        box_take(&panel->extent, next);
        last = next;
    }
    struct vec out = panel_direction(vec_unit(a + sweep / 2));
    panel_note(panel, name, vec_add(center, vec_scale(radius, out)), out);
}

const char *panel_degrees(struct panel *panel, const char *name, double angle)
{
    double degrees = angle * 180 / pi;
    const bool finite = isfinite(degrees);
    return arena_printf(panel->arena, "%s%s%s", name, panel_number(panel->arena, finite ? degrees : angle),
                        finite ? "°" : " rad");
}

void panel_slope(struct panel *panel, struct vec foot, struct vec up)
{
    const double side = up.x < 0 ? -1 : 1, turn = atan2(up.y, fabs(up.x));
    panel_line(panel, "reference", foot, vec_add(foot, (struct vec){18 * side, 0}), 3);
    const char *text = panel_degrees(panel, "", turn);
    if (text) panel_turn(panel, foot, 13, side < 0 ? pi : 0, side * turn, text);
}

static void draw_slide(struct panel *panel)
{
    struct vec e = panel_direction(vec_of(panel->pose.along)),
               into = panel_direction(vec_scale(-1, vec_of(panel->pose.normal))),
               base = panel_point(panel, panel->base);
    bool surface = panel->body.surface, guide = panel->body.two_sided, supports = panel->drawing->supports;
    if (panel->joined && !on_ground(panel)) return; /* the body under it is in the figure */
    const double reach = supports ? surface_half : free_half;
    struct vec half = vec_scale(reach, e);
    if (surface && !supports) panel_line(panel, "reference", vec_sub(base, half), base, 2);
    if (surface && supports) panel_hatched_line(panel, vec_sub(base, half), vec_add(base, half), into);
    if (guide && supports) {
        struct vec G = panel_point(panel, panel_place(panel, panel->G));
        struct vec over = vec_sub(vec_scale(2, G), base);
        panel_hatched_line(panel, vec_add(over, half), vec_sub(over, half), vec_scale(-1, into));
    }
    struct vec far = vec_add(base, vec_scale(reach + 9, e));
    if (!surface) {
        struct vec G = panel_point(panel, panel_place(panel, panel->G));
        panel_line(panel, "reference", vec_sub(G, half), vec_add(G, half), 2);
        far = vec_add(G, vec_scale(reach + 9, e));
    }
    panel_axis(panel, vec_sub(far, vec_scale(9, e)), far, "x");
    double along = atan2(panel->pose.along[1], panel->pose.along[0]);
    if (fabs(remainder(along, pi / 2)) < 1e-9) return;
    /* the angle from the horizontal, at the low end of the line */
    struct vec foot = vec_sub(far, vec_scale(2 * reach + 9, e));
    double turn = along;
    panel_line(panel, "reference", foot, vec_add(foot, (struct vec){18, 0}), 3);
    const char *name = panel->slope ? arena_printf(panel->arena, "%s = ", panel->slope) : "",
               *text = name ? panel_degrees(panel, name, turn) : NULL;
    if (text) panel_turn(panel, foot, 13, 0, turn, text);
}

double panel_coordinate(const struct panel *panel, size_t index)
{
    double value = NAN;
    fbd_state_get(panel->state, fbd_model_coordinate(panel->model, index).name, &value);
    return value;
}

/* In the figure of a long chain each text of an angle is written once. */
static bool is_repeated(const struct panel *panel, const char *text)
{
    const size_t most_bodies = 4;
    if (!panel->joined || fbd_model_body_count(panel->model) <= most_bodies) return false;
    for (size_t i = 0; i < panel->labels.label_count; i++)
        if (strcmp(panel->labels.labels[i].text, text) == 0) return true;
    return false;
}

/* Draw the angle of rotation of a body, from the direction `zero` in the world. */
static void draw_angle(struct panel *panel, struct vec center, double zero, double length)
{
    double theta = panel_coordinate(panel, (size_t)panel->body.angle), turn = remainder(theta, 2 * pi);
    struct vec end = vec_add(center, vec_scale(length, panel_direction(vec_unit(zero))));
    const char *text = panel_degrees(panel, "θ = ", theta);
    if (!text || is_repeated(panel, text)) return;
    panel_line(panel, "reference", center, end, 5);
    if (fabs(turn) < 0.03)
        panel_note(panel, text, end, panel_direction(vec_unit(zero)));
    else
        panel_turn(panel, center, panel->body.motion == FBD_MOTION_PLANAR ? length - 3 : fmin(length - 2, 17),
                   zero, turn, text);
}

void panel_bearing(struct panel *panel, struct vec axis, double down)
{
    const struct vec d = {0, down}, foot = vec_add(axis, vec_scale(6, d)), side = {3.6, 0}, wide = {7, 0};
    const struct vec corners[] = {axis, vec_add(foot, side), vec_sub(foot, side)};
    svg_polygon(&panel->under, "support", corners, 3);
    for (int i = 0; i < 3; i++) labelling_avoid(&panel->labels, corners[i], corners[(i + 1) % 3], on_outline);
    panel_hatched_line(panel, vec_sub(foot, wide), vec_add(foot, wide), d);
}

/* Draw a bearing on the side away from the body. */
static void draw_pivot(struct panel *panel)
{
    struct vec axis = panel_point(panel, panel_place(panel, vec_of(panel->body.pin)));
    struct vec G = vec_sub(panel_point(panel, panel_place(panel, panel->G)), axis);
    bool hangs = vec_norm(G) > 1;
    struct vec d = {0, hangs && G.y > -0.3 * vec_norm(G) ? -1 : 1};
    if (on_ground(panel) && panel->drawing->supports) panel_bearing(panel, axis, d.y);
    if (panel->body.friction && panel->drawing->supports) panel_bush(panel, axis);
    if (panel->joined) svg_circle(&panel->under, "hole", axis, pin_radius);
    /* theta is zero where the body's frame is parallel to that of its parent */
    double parent = panel->pose.angle - panel_coordinate(panel, panel->body.coordinate);
    struct vec arm = vec_sub(panel->G, vec_of(panel->body.pin));
    double zero = parent + (hangs ? atan2(arm.y, arm.x) : 0);
    draw_angle(panel, axis, zero, hangs ? fmin(fmax(0.7 * vec_norm(G), 14), 26) : 20);
}

static void draw_axis_of_body(struct panel *panel, struct vec center, double length)
{
    struct vec x = panel_direction((struct vec){panel->pose.cosine, panel->pose.sine});
    panel_line(panel, "reference", center, vec_add(center, vec_scale(length, x)), 5);
}

/* True for a body that turns about its middle, which would hide the bearing behind it. */
bool panel_fixtures_in_front(const struct panel *panel)
{
    return panel->body.motion == FBD_MOTION_PIVOT &&
           fbd_model_inertia(panel->model, panel->index).L * panel->millimetres < 1;
}

/* Draw the curve near the body; for a body without a size at a separate scale. */
static void draw_track(struct panel *panel)
{
    const int segments = panel->joined ? 120 : 40;
    const double half = 2 * (panel->drawing->supports ? surface_half : free_half);
    const fbd_track track = fbd_model_track(panel->model, panel->index);
    const double here = panel_coordinate(panel, panel->body.coordinate);
    const fbd_track_place now = fbd_model_track_place(panel->model, panel->index, here);
    double scale =
        panel->sized ? panel->millimetres : fmax(12 * fabs(now.curvature), 6 * half / track.length);
    double first = here - half / scale, last = here + half / scale;
    if (panel->joined) first = track.start, last = track.start + track.length;
    if (!track.closed) first = fmax(first, track.start), last = fmin(last, track.start + track.length);
    struct vec e = vec_of(panel->pose.along), tangent = vec_of(now.tangent);
    struct vec frame = {vec_dot(tangent, e), vec_cross(tangent, e)}; /* rotation of the curve */
    struct vec P = panel_point(panel, panel_place(panel, vec_of(panel->body.pin))), before = P;
    for (int i = 0; i <= segments; i++) {
        fbd_track_place place =
            fbd_model_track_place(panel->model, panel->index, first + (last - first) * i / segments);
        struct vec way = vec_scale(scale, vec_turn(frame, (struct vec){place.x - now.x, place.y - now.y}));
        struct vec at = vec_add(P, panel_direction(way));
        if (i > 0) panel_line(panel, panel->drawing->supports ? "ground" : "reference", before, at, 4);
        before = at;
    }
    struct vec from = vec_add(P, vec_scale(-9, panel_direction(vec_of(panel->pose.normal))));
    panel_axis(panel, from, vec_add(from, vec_scale(9, panel_direction(e))), "s");
}

void panel_fixtures(struct panel *panel)
{
    text_printf(&panel->under, "<g class=\"fixtures\" id=\"%s-fixtures\">\n", panel->body.name);
    if (panel->body.motion == FBD_MOTION_SLIDE) draw_slide(panel);
    if (panel->body.motion == FBD_MOTION_PIVOT) draw_pivot(panel);
    if (panel->body.motion == FBD_MOTION_TRACK) draw_track(panel);
    if (panel->body.motion == FBD_MOTION_WELD) panel_clamp(panel);
    if (panel->body.motion == FBD_MOTION_PLANAR && !panel->joined) {
        struct vec G = panel_point(panel, panel_place(panel, panel->G));
        double theta = panel_coordinate(panel, (size_t)panel->body.angle);
        double reach =
            shapes_reach(panel->model, panel->index, panel->G, (struct vec){1, 0}) * panel->millimetres;
        draw_axis_of_body(panel, G, reach + 12);
        draw_angle(panel, G, panel->pose.angle - theta, reach + 12);
    }
    if (!panel->joined && !panel->drawing->worksheet) panel_gravity(panel);
    text_add(&panel->under, "</g>\n");
}
