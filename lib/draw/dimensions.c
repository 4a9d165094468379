/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dimensions of the figure of the system: lengths of rods and sides of rectangles and plates between extension lines,
 * radii as arrows from the centre, and masses. Each has a letter or a value (letters.h), the same one once.
 *
 * A dimension line is on that side of the body, and at that distance, where it crosses the fewest lines. Where
 * each would cross an outline, the text alone is at the body.
 */
#include <string.h>

#include "draw/figure.h"

static const double pi = 3.141592653589793;

/* Distances of a dimension line from the body, and the shortest one [mm]. */
static const double first_offset = 6, next_offset = 5, overhang = 1.5, shortest = 7;

enum { most_offsets = 3, radius_directions = 16, most_bodies = 4 };

/* The texts that the figure has already. */
struct dimensioning {
    struct figure *figure;
    const char **texts;
    size_t count;
};

static bool is_value(const char *text)
{
    return *text >= '0' && *text <= '9';
}

/* True for the first quantity with this text; in a small system each value has its place. */
static bool is_new(struct dimensioning *all, const char *text)
{
    if (!text) return false;
    if (is_value(text) && all->figure->count <= most_bodies) return true;
    for (size_t i = 0; i < all->count; i++)
        if (strcmp(all->texts[i], text) == 0) return false;
    all->texts[all->count++] = text;
    return true;
}

/* ---- lines */

static void head(struct panel *pen, struct vec tip, struct vec unit)
{
    const struct vec back = vec_sub(tip, vec_scale(2, unit)), side = vec_scale(0.7, vec_perp(unit)),
                     corners[] = {tip, vec_add(back, side), vec_sub(back, side)};
    svg_polygon(&pen->under, "axis-head", corners, 3);
}

struct dimension_line {
    struct vec from, to, out; /* ends of the length, unit vector towards the line */
    double offset;
};

static struct vec out_by(const struct dimension_line *line, struct vec point, double distance)
{
    return vec_add(point, vec_scale(distance, line->out));
}

static double cost_of(const struct panel *pen, const struct dimension_line *line)
{
    const double far = line->offset + overhang, near = 2;
    const struct labelling *labels = &pen->labels;
    return labelling_crossed(labels, out_by(line, line->from, line->offset),
                             out_by(line, line->to, line->offset)) +
           labelling_crossed(labels, out_by(line, line->from, near), out_by(line, line->from, far)) +
           labelling_crossed(labels, out_by(line, line->to, near), out_by(line, line->to, far));
}

/* Find the line of the least cost; downwards and to the right first. False if each crosses an outline. */
static bool choose_line(const struct panel *pen, struct dimension_line *line)
{
    const struct vec d = vec_sub(line->to, line->from), n = vec_scale(1 / vec_norm(d), vec_perp(d)),
                     out = n.x + 2 * n.y > 0 ? n : vec_scale(-1, n);
    double least = on_outline;
    struct dimension_line best = *line;
    for (int i = 0; i < 2 * most_offsets; i++) {
        line->out = vec_scale(i % 2 ? -1 : 1, out);
        const int step = i / 2;
        line->offset = first_offset + next_offset * step;
        const double cost = cost_of(pen, line) + line->offset / 2;
        if (cost >= least) continue;
        least = cost;
        best = *line;
    }
    *line = best;
    return least < on_outline;
}

static void draw_length(struct dimensioning *all, struct vec from, struct vec to, const char *text)
{
    struct panel *pen = all->figure->pen;
    struct dimension_line line = {.from = from, .to = to};
    if (!is_new(all, text) || !(vec_norm(vec_sub(to, from)) > 0)) return;
    const struct vec middle = vec_scale(0.5, vec_add(from, to));
    if (vec_norm(vec_sub(to, from)) < shortest || !choose_line(pen, &line)) {
        panel_note(pen, text, middle, (struct vec){0, 0});
        return;
    }
    const struct vec a = out_by(&line, from, line.offset), b = out_by(&line, to, line.offset),
                     d = vec_sub(b, a), unit = vec_scale(1 / vec_norm(d), d);
    panel_line(pen, "dimension", out_by(&line, from, 2), out_by(&line, a, overhang), on_outline);
    panel_line(pen, "dimension", out_by(&line, to, 2), out_by(&line, b, overhang), on_outline);
    panel_line(pen, "dimension", a, b, on_outline);
    head(pen, a, vec_scale(-1, unit));
    head(pen, b, unit);
    panel_note(pen, text, vec_scale(0.5, vec_add(a, b)), line.out);
}

/* A radius without a letter is marked as on drawings: R 5 mm. */
static const char *radius_text(struct dimensioning *all, const char *text)
{
    return text && is_value(text) ? arena_printf(&all->figure->arena, "R %s", text) : text;
}

/* An arrow from the centre to the circle; of a small circle the text alone. */
static void draw_radius(struct dimensioning *all, struct vec center, double radius, const char *text)
{
    struct panel *pen = all->figure->pen;
    const double near = fmin(3, radius / 3), far = radius - 2;
    double least = on_outline;
    struct vec best = panel_direction(vec_unit(pi / 4));
    text = radius_text(all, text);
    if (!is_new(all, text)) return;
    for (int k = 0; k < radius_directions && radius >= shortest; k++) {
        const struct vec u = panel_direction(vec_unit(pi / 4 + 2 * pi * k / radius_directions));
        const double cost = labelling_crossed(&pen->labels, vec_add(center, vec_scale(near, u)),
                                              vec_add(center, vec_scale(far, u)));
        if (cost < least) least = cost, best = u;
    }
    const struct vec tip = vec_add(center, vec_scale(radius, best));
    if (least >= on_outline) {
        panel_note(pen, text, tip, best);
        return;
    }
    panel_line(pen, "dimension", center, tip, on_outline);
    head(pen, tip, best);
    panel_note(pen, text, vec_add(center, vec_scale(0.6 * radius, best)), vec_perp(best));
}

/* ---- quantities of a part */

struct part_of {
    const struct panel *panel;
    const struct node *keys;
    fbd_shape shape;
    size_t index;
};

static struct vec corner(const struct part_of *part, int k)
{
    return panel_point(part->panel, panel_place(part->panel, vec_of(part->shape.corners[k])));
}

static const char *text_of(struct dimensioning *all, const struct part_of *part, const char *key,
                           double value)
{
    return letters_text(&all->figure->letters, part->keys, key, value, part->panel->units.length);
}

static bool is_prism(const struct node *keys, char *axis)
{
    const struct pair *shape = node_find(keys, "shape"), *given = node_find(keys, "axis");
    *axis = given && given->value->kind == node_scalar ? given->value->text[0] : 'z';
    return shape && shape->value->kind == node_scalar && strcmp(shape->value->text, "prism") == 0;
}

/* A rod that is given by its ends has no key for its length, but may have a letter: to: [L, 0]. */
static const char *length_text(struct dimensioning *all, const struct part_of *part)
{
    const double length = vec_norm(vec_sub(vec_of(part->shape.corners[1]), vec_of(part->shape.corners[0])));
    const char *const ends[] = {"from", "to"};
    return node_find(part->keys, "from") && node_find(part->keys, "to")
               ? letters_same(&all->figure->letters, part->keys, ends, length, part->panel->units.length)
               : text_of(all, part, "length", length);
}

/* The first side is along the x axis of the shape. */
static void draw_sides(struct dimensioning *all, const struct part_of *part)
{
    char axis;
    if (!is_prism(part->keys, &axis)) return;
    const struct vec *corners = (struct vec[]){vec_of(part->shape.corners[0]), vec_of(part->shape.corners[1]),
                                               vec_of(part->shape.corners[2])};
    const double wide = vec_norm(vec_sub(corners[1], corners[0])),
                 high = vec_norm(vec_sub(corners[2], corners[1]));
    draw_length(all, corner(part, 2), corner(part, 3), text_of(all, part, axis == 'x' ? "b" : "a", wide));
    draw_length(all, corner(part, 3), corner(part, 0), text_of(all, part, axis == 'z' ? "b" : "c", high));
}

/* A length of a plate, if it has the letter of a parameter that the corners name. */
static void draw_lettered(struct dimensioning *all, const struct part_of *part, struct vec from,
                          struct vec to)
{
    static const char *const keys[] = {"corners", "corners"};
    const struct panel *panel = part->panel;
    const char *text = letters_same(&all->figure->letters, part->keys, keys, vec_norm(vec_sub(to, from)),
                                    panel->units.length);
    if (text && !is_value(text))
        draw_length(all, panel_point(panel, panel_place(panel, from)),
                    panel_point(panel, panel_place(panel, to)), text);
}

/* The sides of a plate, its width and its height in the frame of the body. */
static void draw_plate(struct dimensioning *all, const struct part_of *part)
{
    const fbd_shape *shape = &part->shape;
    struct box box = box_nothing;
    for (size_t i = 0; i < shape->corner_count; i++) {
        box_take(&box, vec_of(shape->corners[i]));
        draw_lettered(all, part, vec_of(shape->corners[i]),
                      vec_of(shape->corners[(i + 1) % shape->corner_count]));
    }
    draw_lettered(all, part, box.low, (struct vec){box.high.x, box.low.y});
    draw_lettered(all, part, (struct vec){box.high.x, box.low.y}, box.high);
}

static void draw_size(struct dimensioning *all, const struct part_of *part)
{
    const fbd_shape *shape = &part->shape;
    const double millimetres = part->panel->millimetres;
    const struct vec center = panel_point(part->panel, panel_place(part->panel, vec_of(shape->center)));
    if (shape->kind == FBD_SHAPE_BAR)
        draw_length(all, corner(part, 0), corner(part, 1), length_text(all, part));
    if (shape->kind == FBD_SHAPE_POLYGON)
        (node_find(part->keys, "corners") ? draw_plate : draw_sides)(all, part);
    if (shape->kind != FBD_SHAPE_CIRCLE) return;
    draw_radius(all, center, shape->radius * millimetres, text_of(all, part, "radius", shape->radius));
    draw_radius(all, center, shape->radius * millimetres, text_of(all, part, "outer_radius", shape->radius));
    draw_radius(all, center, shape->inner * millimetres, text_of(all, part, "inner_radius", shape->inner));
}

/* The middle of a part as drawn: that of a wedge is in its lower half. */
static struct vec middle_of(const struct part_of *part)
{
    struct panel panel = *part->panel;
    const bool shaped = part->shape.kind != FBD_SHAPE_UNKNOWN && part->shape.kind != FBD_SHAPE_DOT;
    if (shaped || panel.plate.rider < 0 || panel_carries_level(&panel))
        return panel_point(&panel, panel_place(&panel, shaped ? vec_of(part->shape.center) : panel.G));
    struct vec corners[4];
    panel_wedge(&panel, corners);
    return vec_scale(0.25, vec_add(vec_add(corners[0], corners[1]), vec_add(corners[2], corners[3])));
}

static void write_mass(struct dimensioning *all, const struct part_of *part)
{
    struct figure *figure = all->figure;
    const struct panel *panel = part->panel;
    const double mass = fbd_model_shape_inertia(figure->model, panel->index, part->index).mass;
    const char *text = letters_text(&figure->letters, part->keys, "mass", mass, panel->units.mass);
    if (!(mass > 0) || !is_new(all, text)) return;
    labelling_add(&figure->pen->labels, text, label_size, middle_of(part), (struct vec){0, 0},
                  part->shape.kind == FBD_SHAPE_BAR ? 2 : 1.8);
}

void figure_dimensions(struct figure *figure)
{
    enum { most_of_a_part = FBD_MOST_CORNERS + 3 };
    struct dimensioning all = {.figure = figure};
    size_t parts = 0;
    for (size_t b = 0; b < figure->count; b++) parts += fbd_model_shape_count(figure->model, b);
    all.texts = ARENA_ARRAY(&figure->arena, most_of_a_part * parts + 1, const char *);
    if (!all.texts) return;
    for (size_t b = 0; b < figure->count; b++)
        for (size_t i = 0; i < fbd_model_shape_count(figure->model, b); i++) {
            const struct part_of part = {.panel = &figure->panels[b],
                                         .keys =
                                             letters_part(&figure->letters, figure->panels[b].body.name, i),
                                         .shape = fbd_model_shape(figure->model, b, i),
                                         .index = i};
            draw_size(&all, &part);
            write_mass(&all, &part);
        }
}
