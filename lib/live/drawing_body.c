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
#include "draw/page_json.h"
#include "draw/panel.h"
#include "dynamics/constraint.h"
#include "dynamics/tree.h"
#include "fbd_export.h"
#include "model/outline.h"

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
    return panel_point(&cut->panel, point_motion(cut->panel.body, &cut->panel.pose, point).p);
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
    bool is_G = vec_norm(vec_sub(center, panel->body->inertia.G)) < 1e-12 * (1 + vec_norm(center));
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
static void add_corners(struct cut_free *cut, const struct outline_part *part)
{
    char name[60];
    struct vec center = on_paper(cut, part->center), middle[4], way[4];
    for (int i = 0; i < 4; i++) {
        middle[i] = vec_scale(0.5, vec_add(part->corner[i], part->corner[(i + 1) % 4]));
        way[i] = vec_sub(on_paper(cut, middle[i]), center);
        way[i] = vec_scale(1 / vec_norm(way[i]), way[i]);
    }
    for (int i = 0; i < 4; i++) {
        snprintf(name, sizeof name, "%s corner", side_of(vec_add(way[(i + 3) % 4], way[i])));
        add_point(cut, name, part->corner[i]);
        snprintf(name, sizeof name, "middle of the %s side", side_of(way[i]));
        add_point(cut, name, middle[i]);
    }
}

static void add_rim(struct cut_free *cut, const struct outline_part *part)
{
    static const struct {
        const char *name;
        double x, y;
    } places[] = {{"bottom of the rim", 0, -1},
                  {"top of the rim", 0, 1},
                  {"left of the rim", -1, 0},
                  {"right of the rim", 1, 0}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        add_point_beside(cut, places[i].name, part->center,
                         vec_scale(part->radius, (struct vec){places[i].x, places[i].y}));
    add_point(cut, "centre", part->center);
}

static void add_outline(struct cut_free *cut)
{
    const struct body *source = cut->panel.body->source;
    for (size_t i = 0; i < source->part_count; i++) {
        struct outline_part part = outline_of_part(&source->parts[i]);
        if (part.hole) continue;
        if (part.kind == outline_polygon) add_corners(cut, &part);
        if (part.kind == outline_circle) add_rim(cut, &part);
        if (part.kind == outline_bar) {
            add_point(cut, "end of a bar", part.corner[0]);
            add_point(cut, "end of a bar", part.corner[1]);
        }
    }
}

/* From the world to the body frame. */
static struct vec in_body(const struct cut_free *cut, struct vec world)
{
    const struct pose *pose = &cut->panel.pose;
    struct vec arm = vec_sub(world, pose->origin), back = {pose->rotation.x, -pose->rotation.y};
    return vec_add(cut->panel.body->pin, vec_turn(back, arm));
}

/* Add the point of action of a coupling, a contact or another body; on a circle, at a constant offset from
 * its centre. */
static void add_place(struct cut_free *cut, const char *acting, struct vec world)
{
    const struct body *source = cut->panel.body->source;
    struct vec point = in_body(cut, world);
    char name[80];
    snprintf(name, sizeof name, "where `%.*s` acts", (int)fmin(50, (double)strcspn(acting, ".")), acting);
    for (size_t i = 0; i < source->part_count; i++) {
        struct outline_part part = outline_of_part(&source->parts[i]);
        struct vec arm = vec_sub(point, part.center);
        if (part.kind != outline_circle || fabs(vec_norm(arm) - part.radius) > 1e-6 * part.radius) continue;
        add_point_beside(cut, name, part.center, vec_turn(cut->panel.pose.rotation, arm));
        return;
    }
    add_point(cut, name, point);
}

/* Add the points of one end of a coupling or contact; an open one has none. */
static void add_places_of_end(struct cut_free *cut, const struct coupling *coupling, int end)
{
    const struct tree_work *tree = cut->panel.at.tree;
    const struct row *row = &tree->rows[coupling->first_row];
    for (int i = 0; i < row->port_count; i++)
        if (row->ports[i].end == end)
            add_place(cut, coupling->end[end].name[0],
                      vec_add(tree->links[row->ports[i].link].p, row->ports[i].arm));
}

static void add_places(struct cut_free *cut)
{
    const struct fbd_model *model = cut->panel.model;
    const struct tree *tree = model->tree;
    int index = (int)(cut->panel.body - model->bodies);
    for (int i = 0; tree && i < tree->coupling_count; i++)
        for (int end = 0; end < tree->couplings[i].end_count; end++)
            if (tree->couplings[i].end[end].body == index) add_places_of_end(cut, &tree->couplings[i], end);
    for (size_t b = 0; b < model->body_count; b++) { /* a slide acts on its whole surface */
        const struct model_body *other = &model->bodies[b];
        if (other->parent == index && other->kind != motion_slide)
            add_place(cut, other->name, cut->panel.at.tree->links[other->place.link].p);
    }
}

static void add_points(struct cut_free *cut)
{
    const struct panel *panel = &cut->panel;
    const struct body *source = panel->body->source;
    text_add(cut->text, "\"points\":[");
    add_named_point(cut, "G", panel->body->inertia.G);
    if (panel->body->kind == motion_pivot) add_named_point(cut, "O", panel->body->pin);
    for (size_t i = 0; i < source->point_count; i++)
        add_named_point(cut, source->points[i].name, source->points[i].where);
    if (panel->sized) {
        add_outline(cut);
        add_places(cut);
    }
    if (panel->body->kind == motion_slide && begin_point(cut, panel_point(panel, panel->base)))
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

static double angle_of_end(const struct cut_free *cut, int body)
{
    if (body == ground_body) return 0;
    return angle_of(body_pose(&cut->panel.model->bodies[body], &cut->panel.at).rotation);
}

static struct vec place_of_end(const struct cut_free *cut, const struct constraint *source, int end)
{
    const struct model_body *body;
    if (source->body[end] == ground_body) return source->point[end].where;
    body = &cut->panel.model->bodies[source->body[end]];
    const struct point *point = &source->point[end];
    struct pose pose = body_pose(body, &cut->panel.at);
    return point_motion(body, &pose, point->kind == point_fixed ? point->where : body->inertia.G).p;
}

/* Add the directions from a point of a rod or rope on this body to its next point, and back. */
static void add_strand(struct cut_free *cut, const struct constraint *source, int from, int to)
{
    int index = (int)(cut->panel.body - cut->panel.model->bodies);
    if (to < 0 || to >= source->end_count || source->body[from] != index) return;
    if (source->radius[from] > 0 || source->radius[to] > 0) return;
    struct vec way = vec_sub(place_of_end(cut, source, to), place_of_end(cut, source, from));
    if (!(vec_norm(way) > 0)) return;
    for (int back = 0; back < 2; back++) {
        char name[100], text[40];
        double angle = angle_of(way) + back * pi;
        snprintf(name, sizeof name, "%s `%.60s`", back ? "against" : "along", source->name);
        format_into(text, sizeof text, "%.10g deg", remainder(angle * 180 / pi, 360));
        add_direction(cut, name, angle, text, false);
    }
}

static void add_coupling(struct cut_free *cut, const struct constraint *source)
{
    int index = (int)(cut->panel.body - cut->panel.model->bodies);
    bool surface = constraint_laws[source->kind].surface && !source->contact.polygon;
    bool here = source->body[0] == index || source->body[1] == index;
    char along[100], across[100];
    if (constraint_laws[source->kind].length)
        for (int k = 0; k < source->end_count; k++) {
            add_strand(cut, source, k, k - 1);
            add_strand(cut, source, k, k + 1);
        }
    if (!here || (!surface && source->kind != constraint_rack)) return;
    if (source->kind == constraint_contact && !source->contact.line) return;
    snprintf(along, sizeof along, "along the surface of `%.60s`", source->name);
    snprintf(across, sizeof across, "normal to the surface of `%.60s`", source->name);
    add_line(cut, along, across, source->along + angle_of_end(cut, source->body[1]), false);
}

static void add_directions(struct cut_free *cut)
{
    const struct panel *panel = &cut->panel;
    const struct scene *scene = panel->model->scene;
    double angle = angle_of(panel->pose.rotation);
    text_add(cut->text, "\"directions\":[");
    switch (panel->body->kind) {
    case motion_slide: add_line(cut, "along the line", "normal to the line", angle, true); break;
    case motion_track: add_line(cut, "along the track", "normal to the track", angle, false); break;
    case motion_pivot:
    case motion_planar:
    case motion_weld: add_line(cut, "along the body", "across the body", angle, true); break;
    case motion_particle: break;
    }
    for (size_t i = 0; i < scene->constraint_count; i++) add_coupling(cut, &scene->constraints[i]);
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
    json_number_member(cut->text, "degrees", angle_of(panel->pose.rotation) * 180 / pi);
    json_key(cut->text, "millimetres");
    json_number(cut->text, panel->millimetres);
    text_add(cut->text, "}}");
}

bool drawing_add_bodies(struct text *text, struct text *pictures, const struct fbd_state *state)
{
    const fbd_drawing drawing = {.worksheet = true};
    struct arena arena = {0};
    text_add(text, "[");
    for (size_t b = 0; b < state->model->body_count && !arena.failed; b++) {
        struct cut_free cut = {.text = text, .pictures = pictures};
        if (!panel_start(&cut.panel, state, b, &drawing, &arena)) break;
        panel_draw(&cut.panel);
        text_add(text, b ? ",\n{" : "{");
        json_text_member(text, "name", cut.panel.body->name);
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
