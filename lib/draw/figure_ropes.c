/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ropes, rods and belts in the figure of the system: straight pieces beneath the bodies, and arcs over the discs that
 * they pass.
 */
#include <string.h>

#include "draw/figure.h"

static const double pi = 3.141592653589793, drum_radius = 4;

/* An end on paper, with the places where the piece before it ends and the piece behind it begins. */
struct stop {
    fbd_coupling_end end;
    struct vec center, first, last;
    double radius;
};

static struct stop stop_of(const struct figure *figure, size_t index, size_t k)
{
    const fbd_coupling_end end = fbd_view_coupling_end(figure->view, index, k);
    struct stop stop = {.end = end,
                        .center = figure_point(figure, end.body, end.point),
                        .radius = fabs(end.radius) * figure->pen->millimetres};
    stop.first = stop.last = stop.center;
    if (end.place_count > 0) stop.first = stop.last = figure_place_of(figure, end.body, end.places[0]);
    if (end.place_count > 1) stop.last = figure_place_of(figure, end.body, end.places[1]);
    return stop;
}

/* A point of the ground that a rod or rope ends at: where the length of the rope changes a drum, which it touches there;
 * `way` is the direction of the rope. */
static void draw_anchor(struct figure *figure, const fbd_coupling *coupling, struct vec at, struct vec way)
{
    if (!(vec_norm(way) > 0)) way = (struct vec){0, 1};
    struct panel *pen = figure->pen;
    if (strcmp(coupling->kind, "rope") == 0 && coupling->length == 0) {
        const struct vec side = vec_scale(drum_radius / vec_norm(way), vec_perp(way)),
                         center = vec_add(at, side.y < 0 ? side : vec_scale(-1, side));
        svg_circle(&pen->under, "body", center, drum_radius);
        svg_circle(&pen->under, "hole", center, 0.8);
        panel_avoid_circle(pen, center, drum_radius);
        box_take_circle(&pen->extent, center, drum_radius);
    } else if (strcmp(coupling->kind, "rod") == 0) {
        panel_bearing(pen, at, way.y > 0 ? -1 : 1);
        svg_circle(&pen->under, "hole", at, pin_radius);
    } else {
        figure_wall(pen, at, vec_scale(-1 / vec_norm(way), way));
    }
}

/* A drum of the ground is hatched inside: it does not turn. */
static void draw_drum(struct figure *figure, const struct stop *stop)
{
    struct panel *pen = figure->pen;
    svg_circle(&pen->under, "body", stop->center, stop->radius);
    figure_hatched_disc(pen, stop->center, stop->radius);
    panel_avoid_circle(pen, stop->center, stop->radius);
    box_take_circle(&pen->extent, stop->center, stop->radius);
}

void figure_rope(struct figure *figure, size_t index)
{
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    const char *css = strcmp(coupling.kind, "rope") == 0 ? "rope" : "thread";
    struct stop before = {.radius = 0};
    for (size_t k = 0; k < coupling.end_count; k++) {
        const struct stop stop = stop_of(figure, index, k);
        if (stop.end.body < 0 && stop.radius > 0) draw_drum(figure, &stop);
        if (k > 0) panel_line(figure->pen, css, before.last, stop.first, on_outline);
        before = stop;
    }
}

/* The points of the ground where a rope or rod ends, or that it passes. */
static void draw_anchors(struct figure *figure, size_t index)
{
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    for (size_t k = 0; k < coupling.end_count; k++) {
        const struct stop stop = stop_of(figure, index, k);
        if (stop.end.body >= 0 || stop.radius > 0) continue;
        if (k == 0 || k + 1 == coupling.end_count)
            draw_anchor(figure, &coupling, stop.center,
                        vec_sub(stop_of(figure, index, k == 0 ? 1 : k - 1).first, stop.center));
        else
            svg_circle(&figure->pen->under, "support", stop.center, pin_radius);
    }
}

/* The arc of a circle between two points, that on the side of `through`. */
static void draw_arc(struct panel *pen, struct vec center, struct vec from, struct vec to, struct vec through)
{
    enum { pieces = 24 };
    const struct vec a = vec_sub(from, center), b = vec_sub(to, center);
    const double radius = vec_norm(a), first = atan2(a.y, a.x), two_pi = 2 * pi,
                 forward = fmod(atan2(b.y, b.x) - first + 2 * two_pi, two_pi),
                 middle = fmod(atan2(through.y, through.x) - first + 2 * two_pi, two_pi),
                 sweep = middle <= forward ? forward : forward - two_pi;
    if (!(radius > 0) || sweep == 0) return;
    text_add(&pen->under, "<path class=\"rope\" d=\"M");
    svg_point(&pen->under, from);
    text_printf(&pen->under, " A%.3f %.3f 0 %d %d ", radius, radius, fabs(sweep) > pi, sweep > 0);
    svg_point(&pen->under, to);
    text_add(&pen->under, "\"/>\n");
    struct vec last = from;
    for (int i = 1; i <= pieces; i++) {
        const struct vec next = vec_add(center, vec_scale(radius, vec_unit(first + sweep * i / pieces)));
        labelling_avoid(&pen->labels, last, next, on_outline);
        last = next;
    }
}

/* The direction on paper in which a rope lies on a disc between two places: it arrives along `way` and goes on in this
 * sense of rotation. */
static struct vec middle_of_arc(const struct stop *stop, struct vec way)
{
    const struct vec a = vec_sub(stop->first, stop->center), b = vec_sub(stop->last, stop->center);
    const double sense = vec_cross(a, way) > 0 ? 1 : -1,
                 sweep = fmod(sense * (atan2(b.y, b.x) - atan2(a.y, a.x)) + 4 * pi, 2 * pi);
    return vec_unit(atan2(a.y, a.x) + sense * sweep / 2);
}

void figure_rope_over(struct figure *figure, size_t index)
{
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    draw_anchors(figure, index);
    for (size_t k = 0; k < coupling.end_count; k++) {
        const struct stop stop = stop_of(figure, index, k);
        if (!(stop.radius > 0)) continue;
        if (stop.end.place_count < 2) { /* wound on a drum */
            svg_circle(&figure->pen->under, "rope", stop.center, stop.radius);
            panel_avoid_circle(figure->pen, stop.center, stop.radius);
            continue;
        }
        const struct vec way = vec_sub(stop.first, stop_of(figure, index, k - 1).last);
        draw_arc(figure->pen, stop.center, stop.first, stop.last, middle_of_arc(&stop, way));
    }
}

/* Both strands of a belt: between the places of the view, and their mirror images at the line of centres; and the arcs
 * on the far sides of both discs. */
void figure_belt(struct figure *figure, size_t index)
{
    const struct stop stops[] = {stop_of(figure, index, 0), stop_of(figure, index, 1)};
    const struct vec way = vec_sub(stops[1].center, stops[0].center),
                     unit = vec_scale(1 / vec_norm(way), way);
    struct vec mirrored[2];
    if (!(vec_norm(way) > 0)) return;
    for (int k = 0; k < 2; k++) {
        const struct vec out = vec_sub(stops[k].first, stops[k].center);
        mirrored[k] = vec_add(stops[k].center, vec_sub(vec_scale(2 * vec_dot(out, unit), unit), out));
        draw_arc(figure->pen, stops[k].center, stops[k].first, mirrored[k], vec_scale(k ? 1 : -1, unit));
    }
    panel_line(figure->pen, "rope", stops[0].first, stops[1].first, on_outline);
    panel_line(figure->pen, "rope", mirrored[0], mirrored[1], on_outline);
}
