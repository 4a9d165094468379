/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The applied forces and moments of the figure of the system, by their letters: arrows of one length, rows of
 * arrows for distributed loads, arcs.
 */
#include <string.h>

#include "draw/figure.h"
#include "fbd_section.h"

static const double pi = 3.141592653589793, force_length = 15;

static void draw_arrow(struct panel *pen, struct vec tail, struct vec tip)
{
    const struct vec d = vec_sub(tip, tail), u = vec_scale(1 / vec_norm(d), d),
                     back = vec_sub(tip, vec_scale(2.4, u)), side = vec_perp(u),
                     head[] = {tip, vec_add(back, side), vec_sub(back, side)};
    panel_line(pen, "shaft", tail, back, on_arrow);
    svg_polygon(&pen->under, "head", head, 3);
    box_take(&pen->extent, tip);
}

/* A distributed load on its line: from `from` to `to` on paper, in the direction `u`. */
struct row {
    size_t body, force;
    struct vec from, to, u;
    double length; /* of the line in the scene */
};

/* The largest force per length, as fbd_model_spread_density. */
static double largest_density(const struct figure *figure, const struct row *row, int count)
{
    double most = 0;
    for (int i = 0; i <= count; i++)
        most = fmax(most, fabs(fbd_model_spread_density(figure->model, row->body, row->force,
                                                        row->length * i / count)));
    return most;
}

/* Arrows that end at the line, as long as the force per length there, and the line through their tails. */
static void draw_arrows_of_row(struct figure *figure, const struct row *row)
{
    const double apart = 5, longest = 12, least = 3;
    const int count = (int)fmax(4, ceil(vec_norm(vec_sub(row->to, row->from)) / apart));
    const double most = largest_density(figure, row, count);
    struct panel *pen = figure->pen;
    struct vec before = row->from, top = row->from;
    double highest = 0;
    for (int i = 0; i <= count && most > 0; i++) {
        const double share = (double)i / count,
                     w = fbd_model_spread_density(figure->model, row->body, row->force, row->length * share),
                     size = longest * w / most;
        const struct vec tip = vec_add(row->from, vec_scale(share, vec_sub(row->to, row->from))),
                         tail = vec_sub(tip, vec_scale(size, row->u));
        if (fabs(size) > least) draw_arrow(pen, tail, tip);
        if (i > 0) panel_line(pen, "shaft", before, tail, on_arrow);
        const double middle = fabs(size) - 1e-3 * fabs(share - 0.5);
        if (middle > highest) highest = middle, top = tail;
        before = tail;
    }
    panel_note(pen, panel_indexed(&figure->arena, figure->panels[row->body].forces[row->force].symbol), top,
               vec_scale(-1, row->u));
}

/* Draw a distributed load as a row of arrows; false for other forces. */
static bool draw_row(struct figure *figure, size_t body, size_t force, struct vec u)
{
    const fbd_spread line = fbd_model_spread(figure->model, body, force);
    if (!(line.length > 0)) return false;
    const struct row row = {.body = body,
                            .force = force,
                            .from = figure_point(figure, (int)body, line.from),
                            .to = figure_point(figure, (int)body, line.to),
                            .u = u,
                            .length = line.length};
    text_add(&figure->pen->under, "<g class=\"applied row\">\n");
    draw_arrows_of_row(figure, &row);
    text_add(&figure->pen->under, "</g>\n");
    return true;
}

static void draw_force(struct figure *figure, size_t body, size_t index)
{
    const fbd_force *force = &figure->panels[body].forces[index];
    const struct vec lift = figure->panels[body].lift;
    struct panel *pen = figure->pen;
    const struct vec f = {force->arrow.fx, -force->arrow.fy};
    const double size = vec_norm(f);
    if (strcmp(force->kind, "applied") != 0 || !(size > 0) || figure_has_ram(figure, force->symbol)) return;
    const struct vec u = vec_scale(1 / size, f);
    if (draw_row(figure, body, index, u)) return;
    const struct vec tail = panel_point(pen, vec_add((struct vec){force->arrow.x, force->arrow.y}, lift)),
                     tip = vec_add(tail, vec_scale(force_length, u));
    text_add(&pen->under, "<g class=\"applied\">\n");
    draw_arrow(pen, tail, tip);
    text_add(&pen->under, "</g>\n");
    panel_note(pen, panel_indexed(&figure->arena, force->symbol), tip, u);
}

/* A moment is an arc over the axis or the centre of mass. */
static void draw_moment(struct figure *figure, const struct panel *panel, const fbd_force *force)
{
    enum { corners = 16 };
    struct panel *pen = figure->pen;
    const double couple = force->arrow.couple, radius = 9, below = 0.5, half = pi / 2 + below;
    if (strcmp(force->kind, "applied") != 0 || !force->moment || !isfinite(couple) || couple == 0) return;
    const bool pivot = panel->body.motion == FBD_MOTION_PIVOT;
    const struct vec axis = panel_point(pen, panel_place(panel, pivot ? vec_of(panel->body.pin) : panel->G));
    const struct panel_arrow arrow = {.tail = axis,
                                      .radius = radius,
                                      .start = pi / 2 - copysign(half, couple),
                                      .sweep = copysign(2 * half, couple)};
    text_add(&pen->under, "<g class=\"applied\">\n");
    panel_write_arc(&pen->under, &arrow);
    text_add(&pen->under, "</g>\n");
    box_take_circle(&pen->extent, axis, radius);
    struct vec last = axis;
    for (int i = 0; i <= corners; i++) {
        const struct vec u = panel_direction(vec_unit(arrow.start + arrow.sweep * i / corners)),
                         next = vec_add(axis, vec_scale(radius, u));
        if (i > 0) labelling_avoid(&pen->labels, last, next, 8);
        last = next;
    }
    panel_note(pen, panel_indexed(&figure->arena, force->symbol), vec_sub(axis, (struct vec){0, radius}),
               (struct vec){0, -1});
}

void figure_forces(struct figure *figure)
{
    for (size_t b = 0; b < figure->count; b++)
        for (size_t i = 0; i < figure->panels[b].force_count; i++) {
            draw_force(figure, b, i);
            draw_moment(figure, &figure->panels[b], &figure->panels[b].forces[i]);
        }
}
