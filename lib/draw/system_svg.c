/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The figure of the system: every body is a panel with one origin, one scale and one labelling; between them
 * springs, dampers, rods, ropes and belts; on them the applied forces by their letters. Gravity and reactions
 * are not drawn.
 */
#include "draw/system_svg.h"

#include <string.h>

#include "base/diag.h"
#include "draw/panel.h"
#include "fbd_view.h"

static const double pi = 3.141592653589793, margin = 5, heading = 14, figure_size = 110, wall_distance = 26,
                    force_length = 15, drum_radius = 4;

struct figure {
    struct arena arena;
    const fbd_model *model;
    fbd_view *view;
    struct panel *panels;
    size_t count;
    struct panel *pen; /* of the lines between the bodies */
};

/* A point of a body, or of the ground, in the world. */
static struct vec place(const struct figure *figure, int body, struct vec point)
{
    return body < 0 ? point : panel_place(&figure->panels[body], point);
}

static struct vec on_paper(const struct figure *figure, int body, const double point[2])
{
    return panel_point(figure->pen, place(figure, body, vec_of(point)));
}

/* A place of the scene where something acts on a body. */
static struct vec at_place(const struct figure *figure, int body, const double world[2])
{
    const struct vec lift = body < 0 ? (struct vec){0, 0} : figure->panels[body].lift;
    return panel_point(figure->pen, vec_add(vec_of(world), lift));
}

/* ---- size */

static void take_circle(struct box *box, struct vec center, double radius)
{
    box_take(box, vec_sub(center, (struct vec){radius, radius}));
    box_take(box, vec_add(center, (struct vec){radius, radius}));
}

/* The corners of the rectangle around the parts of a body, its centre of mass and its pin. */
static void take_body(const struct figure *figure, size_t b, struct box *box)
{
    const struct panel *panel = &figure->panels[b];
    struct vec low, high;
    box_take(box, panel_place(panel, panel->G));
    box_take(box, panel_place(panel, vec_of(panel->body.pin)));
    if (!shapes_size(figure->model, b, &low, &high)) return;
    const struct vec corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
    for (int i = 0; i < 4; i++) box_take(box, panel_place(panel, corners[i]));
}

/* The whole curve that a body moves along. */
static void take_track(const struct figure *figure, size_t b, struct box *box)
{
    enum { pieces = 40 };
    if (figure->panels[b].body.motion != FBD_MOTION_TRACK) return;
    const fbd_track track = fbd_model_track(figure->model, b);
    for (int i = 0; i <= pieces; i++) {
        const double s = track.start + track.length * i / pieces;
        const fbd_track_place at = fbd_model_track_place(figure->model, b, s);
        box_take(box, place(figure, figure->panels[b].body.carrier, (struct vec){at.x, at.y}));
    }
}

static struct box extent_of(const struct figure *figure)
{
    struct box box = box_nothing;
    for (size_t b = 0; b < figure->count; b++) {
        take_body(figure, b, &box);
        take_track(figure, b, &box);
    }
    for (size_t i = 0; i < fbd_view_spring_count(figure->view); i++) {
        const fbd_spring spring = fbd_view_spring(figure->view, i);
        box_take(&box, place(figure, spring.body, vec_of(spring.point)));
        if (!isnan(spring.anchor[0])) box_take(&box, place(figure, spring.partner, vec_of(spring.anchor)));
    }
    for (size_t i = 0; i < fbd_view_coupling_count(figure->view); i++) {
        const fbd_coupling coupling = fbd_view_coupling(figure->view, i);
        for (size_t k = 0; k < coupling.end_count; k++) {
            const fbd_coupling_end end = fbd_view_coupling_end(figure->view, i, k);
            if (coupling.lined && end.body < 0) continue; /* a line of the ground has no ends */
            take_circle(&box, place(figure, end.body, vec_of(end.point)), fabs(end.radius));
        }
    }
    return box;
}

/* ---- blocks of conventional size */

static bool carries(const struct figure *figure, int carrier, int body)
{
    while (body >= 0 && body != carrier) body = figure->panels[body].body.carrier;
    return body >= 0;
}

static bool is_sizeless(const struct panel *panel)
{
    return panel->body.motion == FBD_MOTION_SLIDE && !panel->shaped;
}

/* The share of their conventional size that blocks have, so that those beside each other do not overlap: their
 * width is at most `apart` of the distance. Bodies at one place would overlap at any size. */
static double share_of(const struct figure *figure, double millimetres)
{
    const double apart = 0.8, least = 0.15, width = 2 * conventional_block.x;
    double share = 1;
    for (size_t a = 0; a < figure->count; a++)
        for (size_t b = 0; b < a; b++) {
            const struct panel *one = &figure->panels[a], *other = &figure->panels[b];
            if (!is_sizeless(one) || !is_sizeless(other) || carries(figure, (int)a, (int)b) ||
                carries(figure, (int)b, (int)a))
                continue;
            const double distance =
                millimetres * vec_norm(vec_sub(vec_of(one->pose.G), vec_of(other->pose.G)));
            if (distance > 1e-6) share = fmin(share, apart * distance / width);
        }
    return fmax(share, least);
}

/* How far a body is moved from its place in the scene: one that slides on a surface of a sliding body stands on
 * top of it, and carries along those on it. */
static struct vec lift_of(const struct figure *figure, size_t body)
{
    const struct panel *panel = &figure->panels[body];
    if (panel->body.carrier < 0) return (struct vec){0, 0};
    const struct panel *under = &figure->panels[panel->body.carrier];
    const struct vec lift = lift_of(figure, (size_t)panel->body.carrier);
    const struct vec n = vec_of(panel->pose.normal), e = vec_of(under->pose.along);
    const bool stands = panel->body.motion == FBD_MOTION_SLIDE && panel->body.surface &&
                        !panel->body.two_sided && under->body.motion == FBD_MOTION_SLIDE;
    if (!stands || fabs(vec_dot(n, e) * vec_cross(n, e)) > 1e-9) return lift; /* on a slope: a wedge */
    const double high = vec_dot(n, vec_sub(vec_of(panel->pose.G), vec_of(under->pose.G)));
    const double least = panel_reach(panel, vec_scale(-1, n)) + panel_reach(under, n);
    return vec_add(lift, vec_scale(fmax(0, least - high), n));
}

static bool stack(struct figure *figure)
{
    struct vec *lift = ARENA_ARRAY(&figure->arena, figure->count, struct vec);
    for (size_t b = 0; lift && b < figure->count; b++) lift[b] = lift_of(figure, b);
    for (size_t b = 0; lift && b < figure->count; b++) panel_lift(&figure->panels[b], lift[b]);
    return lift != NULL;
}

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

static void wall(struct panel *pen, struct vec at, struct vec into)
{
    const struct vec side = vec_scale(5, vec_perp(into));
    panel_hatched_line(pen, vec_sub(at, side), vec_add(at, side), into);
}

static void draw_spring(struct figure *figure, size_t index)
{
    const fbd_spring spring = fbd_view_spring(figure->view, index);
    struct panel *pen = figure->pen;
    struct vec from = on_paper(figure, spring.body, spring.point), to;
    const bool grounded = spring.partner < 0, placed = !isnan(spring.anchor[0]);
    if (placed) {
        to = on_paper(figure, spring.partner, spring.anchor);
    } else { /* a wall behind the body, beside that of an earlier one */
        const struct vec e = panel_direction(vec_of(figure->panels[spring.body].pose.along));
        from = vec_add(from, vec_scale(index % 2 ? 3 : -3, vec_perp(e)));
        to = vec_sub(from, vec_scale(wall_distance, e));
    }
    const struct vec way = vec_sub(to, from);
    if (!(vec_norm(way) > 0)) return;
    (spring.damper ? dashpot : zigzag)(pen, from, to);
    if (grounded) wall(pen, to, vec_scale(1 / vec_norm(way), way));
}

/* ---- couplings */

/* The ground under a rolling circle or a contact. */
struct strip {
    bool there;
    struct vec foot, e, n; /* below the body, along the ground and out of it, in the world */
    double reach;          /* to each side, on paper */
};

static struct strip strip_of(const struct figure *figure, size_t index)
{
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    if (!coupling.lined) return (struct strip){.there = false};
    const fbd_coupling_end end = fbd_view_coupling_end(figure->view, index, 0),
                           line = fbd_view_coupling_end(figure->view, index, 1);
    if (line.body >= 0 || end.body < 0) return (struct strip){.there = false};
    const struct vec e = vec_unit(coupling.angle), n = vec_scale(coupling.side, vec_perp(e)),
                     center = place(figure, end.body, vec_of(end.point));
    const double high = vec_dot(n, vec_sub(center, vec_of(line.point)));
    const struct vec foot = vec_sub(center, vec_scale(high, n)),
                     touch = end.place_count > 0 ? vec_of(end.places[0]) : foot;
    const double far = fmax(fabs(end.radius), fabs(vec_dot(e, vec_sub(touch, foot))));
    return (struct strip){
        .there = true, .foot = foot, .e = e, .n = n, .reach = fmax(30, far * figure->pen->millimetres + 20)};
}

/* True if both are on one side of one line. */
static bool on_one_line(const struct figure *figure, const struct strip *a, const struct strip *b)
{
    const double off = vec_dot(a->n, vec_sub(b->foot, a->foot)) * figure->pen->millimetres;
    return a->there && b->there && fabs(vec_cross(a->e, b->e)) < 1e-9 && vec_dot(a->n, b->n) > 0 &&
           fabs(off) < 0.05;
}

/* Draw the ground under all bodies on one line, once. */
static void draw_line(struct figure *figure, size_t index)
{
    struct panel *pen = figure->pen;
    const struct strip strip = strip_of(figure, index);
    double low = 0, high = 0;
    for (size_t i = 0; i < fbd_view_coupling_count(figure->view); i++) {
        const struct strip other = strip_of(figure, i);
        if (!on_one_line(figure, &strip, &other)) continue;
        if (i < index) return;
        const double at = vec_dot(strip.e, vec_sub(other.foot, strip.foot)) * pen->millimetres;
        low = fmin(low, at - other.reach);
        high = fmax(high, at + other.reach);
    }
    if (!strip.there) return;
    const struct vec foot = panel_point(pen, strip.foot), e = panel_direction(strip.e),
                     from = vec_add(foot, vec_scale(low, e)), to = vec_add(foot, vec_scale(high, e));
    panel_hatched_line(pen, from, to, vec_scale(-1, panel_direction(strip.n)));
    if (fabs(strip.e.x * strip.e.y) < 1e-9) return;
    const bool rises = strip.e.y > 0;
    panel_slope(pen, rises ? from : to, rises ? strip.e : vec_scale(-1, strip.e));
}

/* A point of the ground that a rod, rope or belt ends at: a drum where the length of the rope changes. */
static void draw_anchor(struct figure *figure, const fbd_coupling *coupling, struct vec at)
{
    struct panel *pen = figure->pen;
    if (strcmp(coupling->kind, "rope") == 0 && coupling->length == 0) {
        svg_circle(&pen->under, "body", at, drum_radius);
        svg_circle(&pen->under, "hole", at, 0.8);
        take_circle(&pen->extent, at, drum_radius);
    } else if (strcmp(coupling->kind, "rod") == 0) {
        panel_bearing(pen, at, 1);
        svg_circle(&pen->under, "hole", at, 1.1);
    } else {
        wall(pen, at, (struct vec){0, -1});
    }
}

/* A rod, rope or belt: lines between the places where it acts. */
static void draw_links(struct figure *figure, const fbd_coupling *coupling, size_t index)
{
    struct vec last = {0, 0};
    for (size_t k = 0; k < coupling->end_count; k++) {
        const fbd_coupling_end end = fbd_view_coupling_end(figure->view, index, k);
        struct vec center = on_paper(figure, end.body, end.point), first = center, leaves = center;
        if (end.place_count > 0) first = leaves = at_place(figure, end.body, end.places[0]);
        if (end.place_count > 1) leaves = at_place(figure, end.body, end.places[1]);
        if (end.radius > 0 && end.body < 0) {
            const double radius = end.radius * figure->pen->millimetres;
            svg_circle(&figure->pen->under, "body", center, radius);
            take_circle(&figure->pen->extent, center, radius);
        }
        if (k > 0) panel_line(figure->pen, "thread", last, first, on_outline);
        if (end.body < 0 && !(end.radius > 0)) draw_anchor(figure, coupling, center);
        last = leaves;
    }
}

static void draw_coupling(struct figure *figure, size_t index)
{
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    if (coupling.lined)
        draw_line(figure, index);
    else if (strcmp(coupling.kind, "rod") == 0 || strcmp(coupling.kind, "rope") == 0)
        draw_links(figure, &coupling, index);
    else if (strcmp(coupling.kind, "pin") == 0) {
        const fbd_coupling_end end = fbd_view_coupling_end(figure->view, index, 0);
        const struct vec at = on_paper(figure, end.body, end.point);
        if (fbd_view_coupling_end(figure->view, index, 1).body < 0) panel_bearing(figure->pen, at, 1);
        svg_circle(&figure->pen->under, "hole", at, 1.1);
    }
}

/* ---- applied forces */

static void draw_force(struct figure *figure, const fbd_force *force, struct vec lift)
{
    struct panel *pen = figure->pen;
    const struct vec f = {force->arrow.fx, -force->arrow.fy};
    const double size = vec_norm(f);
    if (strcmp(force->kind, "applied") != 0 || !(size > 0)) return;
    const struct vec u = vec_scale(1 / size, f),
                     tail = panel_point(pen, vec_add((struct vec){force->arrow.x, force->arrow.y}, lift)),
                     tip = vec_add(tail, vec_scale(force_length, u)), back = vec_sub(tip, vec_scale(2.4, u)),
                     side = vec_scale(1, vec_perp(u)),
                     head[] = {tip, vec_add(back, side), vec_sub(back, side)};
    text_add(&pen->under, "<g class=\"applied\">\n");
    panel_line(pen, "shaft", tail, back, 8);
    svg_polygon(&pen->under, "head", head, 3);
    text_add(&pen->under, "</g>\n");
    box_take(&pen->extent, tip);
    panel_note(pen, panel_indexed(&figure->arena, force->symbol), tip, u);
}

/* A moment is an arc over the axis or the centre of mass. */
static void draw_moment(struct figure *figure, const struct panel *panel, const fbd_force *force)
{
    enum { corners = 8 };
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
    take_circle(&pen->extent, axis, radius);
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

/* ---- the whole */

/* Draw each body with the labelling and the text of the one before, so that labels avoid all of them. */
static void draw_bodies(struct figure *figure)
{
    struct panel before = *figure->pen;
    for (size_t b = 0; b < figure->count; b++) {
        struct panel *panel = &figure->panels[b];
        panel->under = before.under;
        panel->labels = before.labels;
        panel->extent = before.extent;
        const bool in_front = panel_fixtures_in_front(panel);
        if (!in_front) panel_fixtures(panel);
        panel_body(panel);
        if (in_front) panel_fixtures(panel);
        before = *panel;
        panel->under = (struct text){0};
    }
    *figure->pen = before;
}

static bool prepare(struct figure *figure, const fbd_state *state, const fbd_drawing *drawing)
{
    figure->count = fbd_model_body_count(figure->model);
    figure->panels = ARENA_ARRAY(&figure->arena, figure->count, struct panel);
    figure->pen = ARENA_NEW(&figure->arena, struct panel);
    if (!figure->panels || !figure->pen) return false;
    for (size_t b = 0; b < figure->count; b++) {
        if (!panel_start(&figure->panels[b], state, figure->view, b, drawing, &figure->arena)) return false;
        panel_measure(&figure->panels[b]);
    }
    const struct box box = extent_of(figure);
    const struct vec size = vec_sub(box.high, box.low), middle = vec_scale(0.5, vec_add(box.low, box.high));
    const double largest = fmax(size.x, size.y);
    const double millimetres = largest > 0 ? 10 / round_up(10 * largest / figure_size) : 1;
    const double share = share_of(figure, millimetres);
    for (size_t b = 0; b < figure->count; b++) panel_join(&figure->panels[b], middle, millimetres, share);
    if (!stack(figure)) return false;
    *figure->pen = figure->panels[0];
    return true;
}

static void draw(struct figure *figure)
{
    for (size_t i = 0; i < fbd_view_spring_count(figure->view); i++) draw_spring(figure, i);
    for (size_t i = 0; i < fbd_view_coupling_count(figure->view); i++) draw_coupling(figure, i);
    draw_bodies(figure);
    for (size_t b = 0; b < figure->count; b++)
        for (size_t i = 0; i < figure->panels[b].force_count; i++) {
            draw_force(figure, &figure->panels[b].forces[i], figure->panels[b].lift);
            draw_moment(figure, &figure->panels[b], &figure->panels[b].forces[i]);
        }
    labelling_solve(&figure->pen->labels);
    for (size_t i = 0; i < figure->pen->labels.label_count; i++) {
        const struct box box = labelling_box(&figure->pen->labels.labels[i]);
        box_join(&figure->pen->extent, &box);
    }
}

static void write(struct figure *figure, const fbd_drawing *drawing, struct text *text)
{
    const char *given = fbd_model_title(figure->model), *title = given[0] ? given : "System";
    const struct box extent = figure->pen->extent;
    const double top = drawing->untitled ? margin : heading;
    struct vec size = vec_add(vec_sub(extent.high, extent.low), (struct vec){2 * margin, top + margin});
    if (!drawing->untitled) size.x = fmax(size.x, 2 * margin + svg_text_width(title, 4.8));
    svg_begin(text, size, fmin(1, fmin(190 / size.x, 270 / size.y)), title,
              "The system: bodies joined, with supports and applied forces");
    if (!drawing->untitled) svg_text_at(text, "heading", (struct vec){margin, margin + 4}, title);
    text_add(text, "<g id=\"system\" transform=\"translate(");
    svg_point(text, (struct vec){margin - extent.low.x, top - extent.low.y});
    text_add(text, ")\">\n");
    if (figure->pen->under.data) text_add(text, figure->pen->under.data);
    panel_write_notes(figure->pen, text);
    text_add(text, "</g>\n</svg>\n");
    text->failed |= figure->pen->under.failed || figure->arena.failed;
    text->odd |= figure->pen->under.odd;
}

char *system_svg(fbd_state *state, const fbd_drawing *given, fbd_errors *errors)
{
    struct figure figure = {.model = fbd_state_model(state)};
    struct text text = {0};
    fbd_drawing drawing = *given;
    drawing.supports = true;
    diag_in_file(errors, fbd_model_file(figure.model));
    figure.view = fbd_view_new(state, errors);
    if (!figure.view) return NULL;
    const bool ready = prepare(&figure, state, &drawing);
    if (ready) {
        draw(&figure);
        write(&figure, &drawing, &text);
        text_free(&figure.pen->under);
    }
    arena_free(&figure.arena);
    fbd_view_free(figure.view);
    if (ready && !text.failed && !text.odd) return text.data;
    if (ready && !text.failed)
        diag_add(errors, FBD_ERROR, "not-finite", (struct pos){0, 0}, NULL,
                 "the system cannot be drawn: a length is too large or too small for any scale");
    else
        diag_out_of_memory(errors);
    text_free(&text);
    return NULL;
}
