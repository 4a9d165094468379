/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data of each body for the drawing page, with lengths on paper in millimetres, y down:
 *
 * - name, box: [left, top, width, height] of its picture - points: snap points of forces, {name, paper: [x,
 * y], at}, `at` as in the file, "" for the default point - directions: {name, degrees, angle, body}, `angle`
 * as in the file, `body`: it turns with the body - frame for positions other than the points: {paper: [x, y]
 * of its origin, degrees, millimetres per length}, or null if the body has no size
 */
#include "live/drawing.h"

#include <math.h>
#include <string.h>

#include "base/format.h"
#include "base/json.h"
#include "draw/panel.h"
#include "fbd_export.h"

static const double pi = 3.141592653589793;
static const double same_place = 0.05; /* mm on paper */

enum { most_drawing_points = 48 };

struct cut_free {
    struct panel panel;
    struct vec taken[most_drawing_points]; /* on paper */
    size_t point_count, direction_count;
    struct text *text, *pictures;
};

/* ---- points */

static bool begin_point(struct cut_free *cut, struct vec paper)
{
    for (size_t i = 0; i < cut->point_count; i++)
        if (vec_norm(vec_sub(cut->taken[i], paper)) < same_place) return false;
    if (cut->point_count == most_drawing_points) return false;
    json_comma(cut->text, cut->point_count);
    cut->taken[cut->point_count++] = paper;
    text_add(cut->text, "{");
    json_vector_member(cut->text, "paper", paper);
    return true;
}

static void end_point(struct cut_free *cut, const char *name, const char *at)
{
    json_text_member(cut->text, "name", name);
    json_key(cut->text, "at");
    text_json_string(cut->text, at);
    text_add(cut->text, "}");
}

static struct vec on_paper(const struct cut_free *cut, struct vec point)
{
    return panel_point(&cut->panel, panel_place(&cut->panel, point));
}

static void add_named_point(struct cut_free *cut, const char *name, struct vec point)
{
    if (begin_point(cut, on_paper(cut, point))) end_point(cut, name, name);
}

/* Add a point of the body frame. */
static void add_point(struct cut_free *cut, const char *name, struct vec point)
{
    char at[80];
    format_into(at, sizeof at, "[%.10g, %.10g]", point.x, point.y);
    if (begin_point(cut, on_paper(cut, point))) end_point(cut, name, at);
}

/* Add a point at a constant offset, in the axes of the world, from the centre of a circle. */
static void add_point_beside(struct cut_free *cut, const char *name, struct vec center, struct vec offset)
{
    const struct panel *panel = &cut->panel;
    char at[160], from[80];
    bool is_G = vec_norm(vec_sub(center, panel->G)) < 1e-12 * (1 + vec_norm(center));
    format_into(from, sizeof from, "[%.10g, %.10g]", center.x, center.y);
    format_into(at, sizeof at, "{point: %s, offset: [%.10g, %.10g]}", is_G ? "G" : from, offset.x, offset.y);
    struct vec on_body = vec_scale(panel->millimetres, panel_direction(offset));
    if (begin_point(cut, vec_add(on_paper(cut, center), on_body))) end_point(cut, name, at);
}

/* The nearest of eight directions on paper: "lower left". */
static const char *side_of(struct vec way)
{
    static const char *const words[3][3] = {{"upper left", "upper", "upper right"},
                                            {"left", "inner", "right"},
                                            {"lower left", "lower", "lower right"}};
    const double slight = sin(pi / 8) * vec_norm(way);
    int row = way.y < -slight  ? 0
              : way.y > slight ? 2
                               : 1,
        column = way.x < -slight  ? 0
                 : way.x > slight ? 2
                                  : 1;
    return words[row][column];
}

/* Add corners; corner i is named by the two sides that meet there. */
static void add_corners(struct cut_free *cut, const fbd_shape *part)
{
    char name[60];
    struct vec center = on_paper(cut, vec_of(part->center)), middle[4], way[4];
    for (int i = 0; i < 4; i++) {
        middle[i] = vec_scale(0.5, vec_add(vec_of(part->corners[i]), vec_of(part->corners[(i + 1) % 4])));
        way[i] = vec_sub(on_paper(cut, middle[i]), center);
        way[i] = vec_scale(1 / vec_norm(way[i]), way[i]);
    }
    for (int i = 0; i < 4; i++) {
        snprintf(name, sizeof name, "%s corner", side_of(vec_add(way[(i + 3) % 4], way[i])));
        add_point(cut, name, vec_of(part->corners[i]));
        snprintf(name, sizeof name, "middle of the %s side", side_of(way[i]));
        add_point(cut, name, middle[i]);
    }
}

static void add_rim(struct cut_free *cut, const fbd_shape *part)
{
    static const struct {
        const char *name;
        double x, y;
    } places[] = {{"bottom of the rim", 0, -1},
                  {"top of the rim", 0, 1},
                  {"left of the rim", -1, 0},
                  {"right of the rim", 1, 0}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        add_point_beside(cut, places[i].name, vec_of(part->center),
                         vec_scale(part->radius, (struct vec){places[i].x, places[i].y}));
    add_point(cut, "centre", vec_of(part->center));
}

static size_t shape_count(const struct cut_free *cut)
{
    return fbd_model_shape_count(cut->panel.model, cut->panel.index);
}

static fbd_shape shape_of(const struct cut_free *cut, size_t index)
{
    return fbd_model_shape(cut->panel.model, cut->panel.index, index);
}

static void add_outline(struct cut_free *cut)
{
    for (size_t i = 0; i < shape_count(cut); i++) {
        fbd_shape part = shape_of(cut, i);
        if (part.hole) continue;
        if (part.kind == FBD_SHAPE_POLYGON) add_corners(cut, &part);
        if (part.kind == FBD_SHAPE_CIRCLE) add_rim(cut, &part);
        if (part.kind == FBD_SHAPE_BAR) {
            add_point(cut, "end of a bar", vec_of(part.corners[0]));
            add_point(cut, "end of a bar", vec_of(part.corners[1]));
        }
    }
}

/* From the world to the body frame. */
static struct vec in_body(const struct cut_free *cut, struct vec world)
{
    const fbd_pose *pose = &cut->panel.pose;
    struct vec arm = {world.x - pose->x, world.y - pose->y}, back = {pose->cosine, -pose->sine};
    return vec_add(vec_of(cut->panel.body.pin), vec_turn(back, arm));
}

/* Add the point of action of a coupling, a contact or another body; on a circle, at a constant offset from
 * its centre. */
static void add_place(struct cut_free *cut, const char *acting, struct vec world)
{
    struct vec point = in_body(cut, world), turn = {cut->panel.pose.cosine, cut->panel.pose.sine};
    char name[80];
    snprintf(name, sizeof name, "where `%.*s` acts", (int)fmin(50, (double)strcspn(acting, ".")), acting);
    for (size_t i = 0; i < shape_count(cut); i++) {
        fbd_shape part = shape_of(cut, i);
        struct vec arm = vec_sub(point, vec_of(part.center));
        if (part.kind != FBD_SHAPE_CIRCLE || fabs(vec_norm(arm) - part.radius) > 1e-6 * part.radius) continue;
        add_point_beside(cut, name, vec_of(part.center), vec_turn(turn, arm));
        return;
    }
    add_point(cut, name, point);
}

static void add_places(struct cut_free *cut)
{
    const struct panel *panel = &cut->panel;
    const int index = (int)panel->index;
    for (size_t i = 0; i < fbd_view_coupling_count(panel->view); i++)
        for (size_t end = 0; end < fbd_view_coupling(panel->view, i).end_count; end++) {
            const fbd_coupling_end at = fbd_view_coupling_end(panel->view, i, end);
            for (size_t k = 0; at.body == index && k < at.place_count; k++)
                add_place(cut, at.force, vec_of(at.places[k]));
        }
    for (size_t b = 0; b < fbd_model_body_count(panel->model); b++) { /* a slide acts on its whole surface */
        const fbd_body other = fbd_model_body(panel->model, b);
        const fbd_pose pose = fbd_view_pose(panel->view, b);
        if (other.carrier == index && other.motion != FBD_MOTION_SLIDE)
            add_place(cut, other.name, (struct vec){pose.x, pose.y});
    }
}

static void add_points(struct cut_free *cut)
{
    const struct panel *panel = &cut->panel;
    text_add(cut->text, "\"points\":[");
    add_named_point(cut, "G", panel->G);
    if (panel->body.motion == FBD_MOTION_PIVOT) add_named_point(cut, "O", vec_of(panel->body.pin));
    for (size_t i = 0; i < fbd_model_point_count(panel->model, panel->index); i++) {
        const fbd_named_point point = fbd_model_point(panel->model, panel->index, i);
        add_named_point(cut, point.name, (struct vec){point.x, point.y});
    }
    if (panel->sized) {
        add_outline(cut);
        add_places(cut);
    }
    if (panel->body.motion == FBD_MOTION_SLIDE && begin_point(cut, panel_point(panel, panel->base)))
        end_point(cut, "side of the line", "");
    text_add(cut->text, "],\n");
}

/* ---- directions */

static void add_direction(struct cut_free *cut, const char *name, double world, const char *angle, bool body)
{
    json_comma(cut->text, cut->direction_count++);
    text_add(cut->text, "{");
    json_text_member(cut->text, "name", name);
    json_number_member(cut->text, "degrees", remainder(world * 180 / pi, 360));
    json_key(cut->text, "angle");
    text_json_string(cut->text, angle);
    text_printf(cut->text, ",\"body\":%s}", body ? "true" : "false");
}

/* Add the directions along a line and across it, in both senses. */
static void add_line(struct cut_free *cut, const char *along, const char *across, double angle, bool body)
{
    for (int quarter = 0; quarter < 4; quarter++) {
        char text[40];
        double turned = angle + quarter * pi / 2;
        double degrees = remainder(body ? quarter * 90.0 : turned * 180 / pi, 360);
        format_into(text, sizeof text, "%.10g deg", degrees);
        add_direction(cut, quarter % 2 ? across : along, turned, text, body);
    }
}

static double angle_of(const struct vec way)
{
    return atan2(way.y, way.x);
}

static double angle_of_body(const struct cut_free *cut, int body)
{
    const fbd_pose pose = fbd_view_pose(cut->panel.view, (size_t)body);
    return body == FBD_GROUND ? 0 : angle_of((struct vec){pose.cosine, pose.sine});
}

static struct vec place_of_end(const struct cut_free *cut, const fbd_coupling_end *end)
{
    if (end->body == FBD_GROUND) return vec_of(end->point);
    const fbd_body body = fbd_model_body(cut->panel.model, (size_t)end->body);
    const fbd_pose pose = fbd_view_pose(cut->panel.view, (size_t)end->body);
    return pose_point(&pose, &body, vec_of(end->point));
}

/* Add the directions from a point of a rod or rope on this body to its next point, and back. */
static void add_strand(struct cut_free *cut, const char *coupling, const fbd_coupling_end *from,
                       const fbd_coupling_end *to)
{
    if (from->body != (int)cut->panel.index || from->radius > 0 || to->radius > 0) return;
    struct vec way = vec_sub(place_of_end(cut, to), place_of_end(cut, from));
    if (!(vec_norm(way) > 0)) return;
    for (int back = 0; back < 2; back++) {
        char name[100], text[40];
        double angle = angle_of(way) + back * pi;
        snprintf(name, sizeof name, "%s `%.60s`", back ? "against" : "along", coupling);
        format_into(text, sizeof text, "%.10g deg", remainder(angle * 180 / pi, 360));
        add_direction(cut, name, angle, text, false);
    }
}

static void add_strands(struct cut_free *cut, size_t index, const fbd_coupling *coupling)
{
    for (size_t k = 0; k < coupling->end_count; k++) {
        const fbd_view *view = cut->panel.view;
        const fbd_coupling_end end = fbd_view_coupling_end(view, index, k);
        const fbd_coupling_end before = fbd_view_coupling_end(view, index, k - 1);
        const fbd_coupling_end next = fbd_view_coupling_end(view, index, k + 1);
        if (k > 0) add_strand(cut, coupling->name, &end, &before);
        if (k + 1 < coupling->end_count) add_strand(cut, coupling->name, &end, &next);
    }
}

/* Add the directions along the line of a coupling that this body is an end of, and across it. */
static void add_line_of(struct cut_free *cut, size_t index, const fbd_coupling *coupling)
{
    const fbd_coupling_end first = fbd_view_coupling_end(cut->panel.view, index, 0);
    const fbd_coupling_end second = fbd_view_coupling_end(cut->panel.view, index, 1);
    const int body = (int)cut->panel.index;
    if (first.body != body && second.body != body) return;
    char along[100], across[100];
    snprintf(along, sizeof along, "along the surface of `%.60s`", coupling->name);
    snprintf(across, sizeof across, "normal to the surface of `%.60s`", coupling->name);
    add_line(cut, along, across, coupling->angle + angle_of_body(cut, second.body), false);
}

/* The couplings in the order of the file; of a contact with several points the line is added once. */
static void add_couplings(struct cut_free *cut)
{
    const fbd_view *view = cut->panel.view;
    const size_t count = fbd_view_coupling_count(view);
    size_t last = 0;
    for (size_t i = 0; i < count; i++)
        if (fbd_view_coupling(view, i).entry > last) last = fbd_view_coupling(view, i).entry;
    for (size_t entry = 0; entry <= last; entry++) {
        bool lined = false;
        for (size_t i = 0; i < count; i++) {
            const fbd_coupling coupling = fbd_view_coupling(view, i);
            if (coupling.entry != entry) continue;
            if (coupling.pulls) add_strands(cut, i, &coupling);
            if (coupling.lined && !lined) add_line_of(cut, i, &coupling);
            lined |= coupling.lined;
        }
    }
}

static void add_directions(struct cut_free *cut)
{
    const struct panel *panel = &cut->panel;
    double angle = angle_of((struct vec){panel->pose.cosine, panel->pose.sine});
    text_add(cut->text, "\"directions\":[");
    switch (panel->body.motion) {
    case FBD_MOTION_SLIDE: add_line(cut, "along the line", "normal to the line", angle, true); break;
    case FBD_MOTION_TRACK: add_line(cut, "along the track", "normal to the track", angle, false); break;
    case FBD_MOTION_PIVOT:
    case FBD_MOTION_PLANAR:
    case FBD_MOTION_WELD: add_line(cut, "along the body", "across the body", angle, true); break;
    case FBD_MOTION_PARTICLE: break;
    }
    add_couplings(cut);
    text_add(cut->text, "],\n");
}

/* ---- the body */

static void add_picture(struct cut_free *cut)
{
    const struct panel *panel = &cut->panel;
    struct vec low = panel->extent.low, size = vec_sub(panel->extent.high, low);
    text_add(cut->pictures, "<svg>\n");
    if (panel->under.data) text_add(cut->pictures, panel->under.data);
    panel_write_notes(panel, cut->pictures);
    text_add(cut->pictures, "</svg>\n");
    cut->pictures->failed |= panel->under.failed;
    cut->pictures->odd |= panel->under.odd;
    text_printf(cut->text, "\"box\":[%.6g,%.6g,%.6g,%.6g],\n", low.x, low.y, size.x, size.y);
}

static void add_frame(struct cut_free *cut)
{
    const struct panel *panel = &cut->panel;
    json_key(cut->text, "frame");
    if (!panel->sized) {
        text_add(cut->text, "null}");
        return;
    }
    text_add(cut->text, "{");
    json_vector_member(cut->text, "paper", on_paper(cut, (struct vec){0, 0}));
    json_number_member(cut->text, "degrees",
                       angle_of((struct vec){panel->pose.cosine, panel->pose.sine}) * 180 / pi);
    json_key(cut->text, "millimetres");
    json_number(cut->text, panel->millimetres);
    text_add(cut->text, "}}");
}

bool drawing_add_bodies(struct text *text, struct text *pictures, const fbd_state *state,
                        const fbd_view *view)
{
    const fbd_drawing drawing = {.worksheet = true};
    const size_t count = fbd_model_body_count(fbd_state_model(state));
    struct arena arena = {0};
    text_add(text, "[");
    for (size_t b = 0; b < count && !arena.failed; b++) {
        struct cut_free cut = {.text = text, .pictures = pictures};
        if (!panel_start(&cut.panel, state, view, b, &drawing, &arena)) break;
        const double size = panel_measure(&cut.panel);
        panel_set_scale(&cut.panel, size, size);
        panel_draw(&cut.panel);
        text_add(text, b ? ",\n{" : "{");
        json_text_member(text, "name", cut.panel.body.name);
        add_picture(&cut);
        add_points(&cut);
        add_directions(&cut);
        add_frame(&cut);
        text_free(&cut.panel.under);
    }
    text_add(text, "]");
    bool done = !arena.failed && !text->failed && !pictures->failed;
    arena_free(&arena);
    return done;
}
