/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The ground in the figure of the system: lines and polygons under contacts, curved and straight grooves, and the patch
 * of a horizontal plane on which a body rubs.
 */
#include <string.h>

#include "draw/figure.h"

/* ---- lines */

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
                     center = figure_place(figure, end.body, end.point);
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
void figure_line(struct figure *figure, size_t index)
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

void figure_take_lines(const struct figure *figure, struct box *box)
{
    for (size_t i = 0; i < fbd_view_coupling_count(figure->view); i++) {
        const struct strip strip = strip_of(figure, i);
        if (strip.there) box_take(box, strip.foot);
    }
}

/* ---- points and polygons */

void figure_peg(struct figure *figure, size_t index)
{
    const fbd_coupling_end peg = fbd_view_coupling_end(figure->view, index, 1);
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    if (peg.body >= 0 || fbd_model_path(figure->model, coupling.entry).point_count > 0) return;
    const struct vec at = figure_point(figure, peg.body, peg.point);
    figure_hatched_disc(figure->pen, at, 3);
    svg_circle(&figure->pen->under, "mass", at, 0.8);
}

static struct vec corner_of(const struct figure *figure, size_t connection, size_t index)
{
    double point[2];
    fbd_model_path_point(figure->model, connection, index, point);
    return vec_of(point);
}

/* Parts of an edge, as shares of its length. */
struct span {
    double from, to;
};

/* The part of the line from `from` to `to` that is on the inner side of all edges of a convex polygon, counter-clockwise;
 * from >= to for none. */
static struct span inside_of(const struct vec *corners, size_t count, struct vec from, struct vec to)
{
    struct span span = {0, 1};
    for (size_t i = 0; i < count; i++) {
        const struct vec a = corners[i], edge = vec_sub(corners[(i + 1) % count], a);
        const double at_from = vec_cross(edge, vec_sub(from, a)), at_to = vec_cross(edge, vec_sub(to, a)),
                     change = at_to - at_from;
        if (at_from < 0 && at_to < 0) return (struct span){1, 0};
        if (at_from < 0) span.from = fmax(span.from, -at_from / change);
        if (at_to < 0) span.to = fmin(span.to, -at_from / change);
    }
    return span;
}

/* An edge of a polygon in the world, with its outer unit normal. */
struct edge {
    struct vec from, to, out;
};

static struct vec along_edge(const struct edge *edge, double share)
{
    return vec_add(edge->from, vec_scale(share, vec_sub(edge->to, edge->from)));
}

/* True for the first contact of a polygon that several ones have. */
static bool is_first(const struct figure *figure, size_t connection)
{
    const fbd_path path = fbd_model_path(figure->model, connection);
    for (size_t i = 0; i < connection; i++) {
        const fbd_path other = fbd_model_path(figure->model, i);
        bool same = other.closed && other.point_count == path.point_count;
        for (size_t k = 0; same && k < path.point_count; k++)
            same = vec_norm(vec_sub(corner_of(figure, i, k), corner_of(figure, connection, k))) == 0;
        if (same) return false;
    }
    return true;
}

static bool is_polygon(const struct figure *figure, size_t connection)
{
    return strcmp(fbd_model_connection(figure->model, connection).kind, "contact") == 0 &&
           fbd_model_path(figure->model, connection).point_count > 0;
}

static struct vec *corners_of(struct figure *figure, size_t connection, size_t *count)
{
    *count = fbd_model_path(figure->model, connection).point_count;
    struct vec *corners = ARENA_ARRAY(&figure->arena, *count, struct vec);
    for (size_t i = 0; corners && i < *count; i++) corners[i] = corner_of(figure, connection, i);
    if (!corners) *count = 0;
    return corners;
}

/* The corners of number `index` of the solids of the ground: a polygon, or a half plane as a large rectangle; none, though
 * there may be more, with a count of 0. */
static const struct vec *solid_corners(struct figure *figure, size_t index, size_t *count)
{
    const size_t polygons = fbd_model_connection_count(figure->model);
    *count = 0;
    if (index < polygons)
        return is_polygon(figure, index) && is_first(figure, index) ? corners_of(figure, index, count) : NULL;
    const struct strip strip = strip_of(figure, index - polygons);
    struct vec *corners = strip.there ? ARENA_ARRAY(&figure->arena, 4, struct vec) : NULL;
    if (!corners) return NULL;
    const struct box *box = &figure->scene;
    const double far = 100 * fmax(box->high.x - box->low.x, box->high.y - box->low.y);
    const struct vec e = vec_scale(-far, vec_perp(strip.n)), deep = vec_scale(-far, strip.n);
    corners[0] = vec_sub(vec_add(strip.foot, deep), e);
    corners[1] = vec_add(vec_add(strip.foot, deep), e);
    corners[2] = vec_add(strip.foot, e);
    corners[3] = vec_sub(strip.foot, e);
    *count = 4;
    return corners;
}

/* Draw the parts of an edge that none of the solids from number `next` on covers: slightly outside of them is no solid. */
static void draw_edge(struct figure *figure, const struct edge *edge, struct span span, size_t next)
{
    const double outside = 0.05, shortest = 0.1; /* [mm] */
    struct panel *pen = figure->pen;
    const struct vec from = along_edge(edge, span.from), to = along_edge(edge, span.to),
                     shift = vec_scale(outside / pen->millimetres, edge->out);
    const size_t solids = fbd_model_connection_count(figure->model) + fbd_view_coupling_count(figure->view);
    if (!(vec_norm(vec_sub(to, from)) * pen->millimetres > shortest) || span.from >= span.to) return;
    for (size_t i = next; i < solids; i++) {
        size_t count;
        const struct vec *corners = solid_corners(figure, i, &count);
        if (!corners) continue;
        const struct span hidden =
            inside_of(corners, count, vec_add(edge->from, shift), vec_add(edge->to, shift));
        if (hidden.from >= hidden.to || hidden.from >= span.to || hidden.to <= span.from) continue;
        draw_edge(figure, edge, (struct span){span.from, fmin(span.to, hidden.from)}, i + 1);
        draw_edge(figure, edge, (struct span){fmax(span.from, hidden.to), span.to}, i + 1);
        return;
    }
    panel_hatched_line(pen, panel_point(pen, from), panel_point(pen, to),
                       panel_direction(vec_scale(-1, edge->out)));
}

/* An underside of the ground: it faces down, and no body is in front of it. */
static bool is_underside(const struct figure *figure, const struct edge *edge)
{
    bool before_one = false;
    for (size_t i = 0; i < figure->count; i++) {
        const struct vec G = panel_place(&figure->panels[i], figure->panels[i].G);
        before_one |= vec_dot(edge->out, vec_sub(G, edge->from)) > 0;
    }
    return edge->out.y < 0 && !before_one;
}

/* Draw the polygon of a contact within a square around the bodies. */
static void draw_polygon(struct figure *figure, size_t connection)
{
    const struct box *box = &figure->scene;
    const double half =
        fmax(box->high.x - box->low.x, box->high.y - box->low.y) / 2 + 20 / figure->pen->millimetres;
    const struct vec middle = vec_scale(0.5, vec_add(box->low, box->high)),
                     low = vec_sub(middle, (struct vec){half, half}),
                     high = vec_add(middle, (struct vec){half, half}),
                     window[] = {low, {high.x, low.y}, high, {low.x, high.y}};
    size_t count;
    const struct vec *corners = corners_of(figure, connection, &count);
    for (size_t i = 0; i < count; i++) {
        const struct vec from = corners[i], to = corners[(i + 1) % count], d = vec_sub(to, from);
        const struct edge edge = {from, to, vec_scale(-1 / vec_norm(d), vec_perp(d))};
        if (!is_underside(figure, &edge)) draw_edge(figure, &edge, inside_of(window, 4, from, to), 0);
    }
}

void figure_polygons(struct figure *figure)
{
    for (size_t i = 0; i < fbd_model_connection_count(figure->model); i++)
        if (is_polygon(figure, i) && is_first(figure, i)) draw_polygon(figure, i);
}

/* The distance from a point to the nearest point of a segment. */
static double distance_to(struct vec point, struct vec from, struct vec to)
{
    const struct vec d = vec_sub(to, from), way = vec_sub(point, from);
    const double square = vec_dot(d, d), share = square > 0 ? vec_dot(way, d) / square : 0;
    return vec_norm(vec_sub(way, vec_scale(fmin(fmax(share, 0), 1), d)));
}

void figure_take_polygons(const struct figure *figure, struct box *box)
{
    for (size_t i = 0; i < fbd_model_connection_count(figure->model); i++) {
        if (!is_polygon(figure, i)) continue;
        const size_t count = fbd_model_path(figure->model, i).point_count;
        const int body = fbd_model_connection(figure->model, i).ends[0].body;
        const struct vec G = panel_place(&figure->panels[body], figure->panels[body].G);
        double least = HUGE_VAL;
        for (size_t k = 0; k < count; k++)
            least =
                fmin(least, distance_to(G, corner_of(figure, i, k), corner_of(figure, i, (k + 1) % count)));
        box_take_circle(box, G, least);
    }
}

/* ---- grooves */

static const double groove_half_width = 1.7;

/* A point of the curve of a slot on paper. */
static struct vec curve_point(struct figure *figure, size_t connection, size_t index)
{
    double point[2];
    fbd_model_path_point(figure->model, connection, index, point);
    return figure_point(figure, fbd_model_connection(figure->model, connection).ends[1].body, point);
}

/* Both sides of a curved groove, or the hatched ground beside a curve that the point stays on one side of. */
static void draw_curve(struct figure *figure, size_t connection, fbd_path path)
{
    struct panel *pen = figure->pen;
    const bool ground = fbd_model_connection(figure->model, connection).ends[1].body < 0;
    for (size_t i = 0; i + !path.closed < path.point_count; i++) {
        const struct vec from = curve_point(figure, connection, i),
                         to = curve_point(figure, connection, (i + 1) % path.point_count),
                         d = vec_sub(to, from);
        if (!(vec_norm(d) > 0)) continue;
        const struct vec side = vec_scale(groove_half_width / vec_norm(d), vec_perp(d));
        if (path.side != 0) {
            panel_line(pen, ground ? "ground" : "thread", from, to, on_outline);
            continue;
        }
        panel_line(pen, "thread", vec_add(from, side), vec_add(to, side), on_outline);
        panel_line(pen, "thread", vec_sub(from, side), vec_sub(to, side), on_outline);
    }
}

/* A straight groove, at its pin where it has no ends. */
static void draw_groove(struct figure *figure, const fbd_coupling *coupling, struct vec at, fbd_path path)
{
    const double half = 13;
    const fbd_connection groove = fbd_model_connection(figure->model, coupling->entry);
    const double turned = groove.ends[1].body < 0 ? 0 : figure->panels[groove.ends[1].body].pose.angle;
    const struct vec e = panel_direction(vec_unit(coupling->angle + turned)), way = vec_scale(half, e),
                     side = vec_scale(groove_half_width, vec_perp(e));
    struct panel *pen = figure->pen;
    const bool ends = path.point_count == 2;
    const struct vec from = ends ? curve_point(figure, coupling->entry, 0) : vec_sub(at, way),
                     to = ends ? curve_point(figure, coupling->entry, 1) : vec_add(at, way);
    panel_line(pen, "thread", vec_sub(from, side), vec_sub(to, side), on_outline);
    panel_line(pen, "thread", vec_add(from, side), vec_add(to, side), on_outline);
    panel_line(pen, "thread", vec_sub(from, side), vec_add(from, side), on_outline);
    panel_line(pen, "thread", vec_sub(to, side), vec_add(to, side), on_outline);
}

static bool is_cam(const struct figure *figure, size_t connection)
{
    const int body = fbd_model_connection(figure->model, connection).ends[1].body;
    return body >= 0 && figure->panels[body].plate.cam == (int)connection;
}

/* Where the point is in its groove, whether or not its body is drawn there. */
static struct vec pin_of(const struct figure *figure, const fbd_coupling_end *pin, int groove)
{
    return pin->place_count > 0 ? figure_place_of(figure, groove, pin->places[0])
                                : figure_point(figure, pin->body, pin->point);
}

/* From the block of a follower to its point on the cam. */
static void draw_stem(struct panel *pen, struct vec way, struct vec at, const struct panel *follower)
{
    const double length = vec_norm(way);
    panel_line(pen, "thread", at, vec_add(at, vec_scale(1 - follower->block.x / length, way)), on_outline);
}

void figure_groove(struct figure *figure, size_t index)
{
    const fbd_coupling coupling = fbd_view_coupling(figure->view, index);
    const fbd_coupling_end pin = fbd_view_coupling_end(figure->view, index, 0);
    const struct vec at = pin_of(figure, &pin, fbd_view_coupling_end(figure->view, index, 1).body);
    const fbd_path path = fbd_model_path(figure->model, coupling.entry);
    if (path.point_count <= 2)
        draw_groove(figure, &coupling, at, path);
    else if (!is_cam(figure, coupling.entry))
        draw_curve(figure, coupling.entry, path);
    const struct vec block = figure_point(figure, pin.body, pin.point);
    if (path.side != 0 && pin.body >= 0 && vec_norm(vec_sub(at, block)) > follower_stem)
        draw_stem(figure->pen, vec_sub(block, at), at, &figure->panels[pin.body]);
    svg_circle(&figure->pen->under, "hole", at, pin_radius);
}

/* ---- planes seen from above */

void figure_hatched_disc(struct panel *pen, struct vec center, double radius)
{
    const double step = 2.4;
    const struct vec e = vec_unit(-0.7853981633974483), n = vec_perp(e); /* at 45 degrees */
    text_add(&pen->under, "<path class=\"hatch\" d=\"");
    const int count = (int)round(2 * radius / step);
    for (int i = 0; i < count; i++) {
        const double off = (i + 0.5) * step - radius, half = sqrt(radius * radius - off * off);
        const struct vec middle = vec_add(center, vec_scale(off, n));
        text_add(&pen->under, " M");
        svg_point(&pen->under, vec_sub(middle, vec_scale(half, e)));
        text_add(&pen->under, " L");
        svg_point(&pen->under, vec_add(middle, vec_scale(half, e)));
    }
    text_add(&pen->under, "\"/>\n");
    box_take_circle(&pen->extent, center, radius);
}

void figure_plane(struct figure *figure, size_t index)
{
    const double around = 6;
    const fbd_coupling_end end = fbd_view_coupling_end(figure->view, index, 0);
    if (end.body < 0 || fbd_view_coupling_end(figure->view, index, 1).body >= 0) return; /* on another body */
    const struct panel *panel = &figure->panels[end.body];
    double reach = 0;
    for (int k = 0; k < 8; k++) {
        const double far =
            shapes_reach(figure->model, panel->index, panel->G, vec_unit(k * 0.7853981633974483));
        if (isfinite(far)) reach = fmax(reach, far);
    }
    figure_hatched_disc(figure->pen, panel_point(figure->pen, panel_place(panel, panel->G)),
                        reach * figure->pen->millimetres + around);
}
