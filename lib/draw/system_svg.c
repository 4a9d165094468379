/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The figure of the system: every body is a panel with one origin, one scale and one labelling; between them
 * springs, dampers, rods, ropes and belts; on them the applied forces by their letters. Gravity and reactions
 * are not drawn.
 */
#include "draw/system_svg.h"

#include <string.h>

#include "base/diag.h"
#include "draw/figure.h"
#include "fbd_view.h"

static const double margin = 5, heading = 14, figure_size = 110;

/* ---- size */

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
        box_take(box, figure_place(figure, figure->panels[b].body.carrier, (double[]){at.x, at.y}));
    }
}

/* The curve of a slot, or its limited line. */
static void take_curve(const struct figure *figure, size_t connection, struct box *box)
{
    const fbd_connection slot = fbd_model_connection(figure->model, connection);
    double point[2];
    if (strcmp(slot.kind, "slot") != 0) return;
    for (size_t i = 0; fbd_model_path_point(figure->model, connection, i, point); i++)
        box_take(box, figure_place(figure, slot.ends[1].body, point));
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
        box_take(&box, figure_place(figure, spring.body, spring.point));
        if (!isnan(spring.anchor[0])) box_take(&box, figure_place(figure, spring.partner, spring.anchor));
    }
    for (size_t i = 0; i < fbd_view_coupling_count(figure->view); i++) {
        const fbd_coupling coupling = fbd_view_coupling(figure->view, i);
        for (size_t k = 0; k < coupling.end_count; k++) {
            const fbd_coupling_end end = fbd_view_coupling_end(figure->view, i, k);
            if (coupling.lined && end.body < 0) continue; /* a line of the ground has no ends */
            if (end.body < 0 && fbd_model_path(figure->model, coupling.entry).point_count > 0) continue;
            box_take_circle(&box, figure_place(figure, end.body, end.point), fabs(end.radius));
        }
    }
    figure_take_lines(figure, &box);
    figure_take_polygons(figure, &box);
    figure_take_stops(figure, &box);
    for (size_t i = 0; i < fbd_model_connection_count(figure->model); i++) take_curve(figure, i, &box);
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

/* Distance on paper below which blocks are drawn beside each other instead of smaller [mm]. */
static const double at_one_place = 0.1;

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
            if (distance > at_one_place) share = fmin(share, apart * distance / width);
        }
    return fmax(share, least);
}

static bool are_joined(const struct figure *figure, size_t a, size_t b)
{
    for (size_t i = 0; i < fbd_view_spring_count(figure->view); i++) {
        const fbd_spring spring = fbd_view_spring(figure->view, i);
        if ((spring.body == (int)a && spring.partner == (int)b) ||
            (spring.body == (int)b && spring.partner == (int)a))
            return true;
    }
    return false;
}

/* Blocks that start at one place are drawn beside each other: those that a spring joins along their line, others
 * across it; to the right or downwards. */
static struct vec aside_of(const struct figure *figure, size_t body)
{
    const struct panel *panel = &figure->panels[body];
    struct vec aside = {0, 0};
    for (size_t a = 0; a < body && is_sizeless(panel); a++) {
        const struct panel *other = &figure->panels[a];
        const double distance = vec_norm(vec_sub(vec_of(panel->pose.G), vec_of(other->pose.G)));
        if (!is_sizeless(other) || other->body.carrier >= 0 || distance * panel->millimetres > at_one_place)
            continue;
        const bool along = are_joined(figure, a, body);
        const struct vec e = vec_of(panel->pose.along), line = along ? e : vec_perp(e);
        const double step = 2 * (along ? panel->block.x : panel->block.y) + (along ? wall_distance : 10),
                     sign = line.x - 2 * line.y > 0 ? 1 : -1;
        aside = vec_add(aside, vec_scale(sign * step / panel->millimetres, line));
    }
    return aside;
}

/* The one-sided slot whose point is on this block, as a number of coupling; their number for none. */
static size_t cam_under(const struct figure *figure, size_t body)
{
    const size_t count = fbd_view_coupling_count(figure->view);
    for (size_t i = 0; i < count && is_sizeless(&figure->panels[body]); i++) {
        const size_t entry = fbd_view_coupling(figure->view, i).entry;
        if (strcmp(fbd_view_coupling(figure->view, i).kind, "slot") == 0 &&
            fbd_model_path(figure->model, entry).side != 0 &&
            fbd_view_coupling_end(figure->view, i, 0).body == (int)body)
            return i;
    }
    return count;
}

/* A block that follows a cam is drawn beyond its point on it, with a stem (figure_follower). */
static struct vec beyond_cam(const struct figure *figure, size_t body, size_t coupling)
{
    const struct panel *panel = &figure->panels[body];
    const fbd_coupling_end cam = fbd_view_coupling_end(figure->view, coupling, 1);
    const struct vec e = vec_of(panel->pose.along),
                     axis = cam.body < 0 ? vec_of(cam.point)
                                         : panel_place(&figure->panels[cam.body],
                                                       vec_of(figure->panels[cam.body].body.pin)),
                     way = vec_sub(vec_of(panel->pose.G), axis);
    return vec_scale((panel->block.x + follower_stem) / panel->millimetres,
                     vec_dot(way, e) < 0 ? vec_scale(-1, e) : e);
}

/* The displacement of a body from its place in the scene: a body on a surface of a sliding body stands on top of
 * it, and carries along those on it. */
static struct vec lift_of(const struct figure *figure, size_t body)
{
    const struct panel *panel = &figure->panels[body];
    const size_t cam = cam_under(figure, body);
    if (cam < fbd_view_coupling_count(figure->view)) return beyond_cam(figure, body, cam);
    if (panel->body.carrier < 0) return aside_of(figure, body);
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

/* ---- the whole */

/* Draw a part of a body with the labelling and the text of those before, so that labels avoid all of them. */
static void draw_of_body(struct figure *figure, size_t b, void (*draw)(struct panel *panel))
{
    struct panel *panel = &figure->panels[b];
    panel->under = figure->pen->under;
    panel->labels = figure->pen->labels;
    panel->extent = figure->pen->extent;
    draw(panel);
    *figure->pen = *panel;
    panel->under = (struct text){0};
}

/* True for a body on a surface or track: it lies before that, others behind their bearing and angle. */
static bool lies_on_path(const struct panel *panel)
{
    return panel->body.motion == FBD_MOTION_SLIDE || panel->body.motion == FBD_MOTION_TRACK;
}

static void draw_bodies(struct figure *figure)
{
    for (size_t b = 0; b < figure->count; b++) {
        if (lies_on_path(&figure->panels[b])) draw_of_body(figure, b, panel_fixtures);
        draw_of_body(figure, b, panel_body);
    }
    for (size_t b = 0; b < figure->count; b++)
        if (!lies_on_path(&figure->panels[b])) draw_of_body(figure, b, panel_fixtures);
}

static bool prepare(struct figure *figure, const fbd_state *state, const fbd_drawing *drawing)
{
    figure->count = fbd_model_body_count(figure->model);
    figure->panels = ARENA_ARRAY(&figure->arena, figure->count, struct panel);
    figure->pen = ARENA_NEW(&figure->arena, struct panel);
    if (!figure->panels || !figure->pen || !letters_open(&figure->letters, figure->model, &figure->arena))
        return false;
    for (size_t b = 0; b < figure->count; b++) {
        if (!panel_start(&figure->panels[b], state, figure->view, b, drawing, &figure->arena)) return false;
        panel_measure(&figure->panels[b]);
        figure->panels[b].slope = letters_slope(&figure->letters, figure->panels[b].body.name);
    }
    const struct box box = figure->scene = extent_of(figure);
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
    figure_links(figure);
    draw_bodies(figure);
    figure_links_over(figure);
    figure_surfaces(figure);
    figure_forces(figure);
    figure_marks(figure);
    figure_dimensions(figure);
    labelling_solve(&figure->pen->labels);
    for (size_t i = 0; i < figure->pen->labels.label_count; i++) {
        const struct box box = labelling_box(&figure->pen->labels.labels[i]);
        box_join(&figure->pen->extent, &box);
    }
}

/* Write the letters of the figure with their values below it, in lines of at most `width`; returns the height. */
static double write_list(struct figure *figure, struct text *text, struct vec at, double width)
{
    const double line = 5, apart = 5, top = at.y, left = at.x;
    const char *entry;
    for (size_t i = 0; (entry = figure_listed(figure, i)); i++) {
        const double wide = svg_text_width(entry, label_size);
        if (i == 0 || at.x + wide > left + width) at = (struct vec){left, at.y + line};
        if (text) svg_text_at(text, "given", at, entry);
        at.x += wide + apart;
    }
    return at.y - top;
}

static void write(struct figure *figure, const fbd_drawing *drawing, struct text *text)
{
    const char *given = fbd_model_title(figure->model), *title = given[0] ? given : "System";
    const struct box extent = figure->pen->extent;
    const double top = drawing->untitled ? margin : heading;
    struct vec size = vec_add(vec_sub(extent.high, extent.low), (struct vec){2 * margin, top + margin});
    if (!drawing->untitled) size.x = fmax(size.x, 2 * margin + svg_text_width(title, 4.8));
    const char *entry;
    for (size_t i = 0; (entry = figure_listed(figure, i)); i++)
        size.x = fmax(size.x, 2 * margin + svg_text_width(entry, label_size));
    const double list_width = size.x - 2 * margin, bottom = size.y - margin;
    size.y += write_list(figure, NULL, (struct vec){margin, bottom}, list_width);
    svg_begin(text, size, fmin(1, fmin(190 / size.x, 270 / size.y)), title,
              "The system: bodies joined, with supports and applied forces");
    if (!drawing->untitled) svg_text_at(text, "heading", (struct vec){margin, margin + 4}, title);
    text_add(text, "<g id=\"system\" transform=\"translate(");
    svg_point(text, (struct vec){margin - extent.low.x, top - extent.low.y});
    text_add(text, ")\">\n");
    if (figure->pen->under.data) text_add(text, figure->pen->under.data);
    panel_write_notes(figure->pen, text);
    text_add(text, "</g>\n");
    write_list(figure, text, (struct vec){margin, bottom}, list_width);
    text_add(text, "</svg>\n");
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
