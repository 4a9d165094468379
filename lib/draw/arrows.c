/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces as arrows to scale, moments as arcs.
 *
 * Arrows that would overlap on the same line of action end at their points instead of starting there (a normal force
 * below its contact, a weight above G), or are drawn side by side.
 */
#include <float.h>
#include <string.h>

#include "draw/panel.h"
#include "fbd_view.h"

static const double pi = 3.141592653589793, side_step = 2.4, head_length = 3, head_width = 2.2;
static const double first_radius = 10, next_radius = 3.6, least_sweep = 0.7;

/* A force is not resolved if its smaller component is less than this fraction. */
static const double least_component = 0.02;

/* ---- selection */

static struct vec force_of(const fbd_force *force)
{
    return (struct vec){force->arrow.fx, force->arrow.fy};
}

/* True for values at the round-off level of the largest. */
static bool is_nothing(double value, double largest)
{
    return !(fabs(value) > 64 * DBL_EPSILON * largest);
}

struct arrow_scale panel_largest(const struct panel *panel)
{
    struct arrow_scale most = {0, 0};
    for (size_t i = 0; i < panel->force_count; i++) {
        double force = vec_norm(force_of(&panel->forces[i])), moment = fabs(panel->forces[i].arrow.couple);
        if (isfinite(force)) most.force = fmax(most.force, force);
        if (isfinite(moment)) most.moment = fmax(most.moment, moment);
    }
    return most;
}

double panel_line_of_action(const fbd_force *force, struct vec along)
{
    double lever = vec_cross(along, force_of(force));
    return lever != 0 ? force->arrow.couple / lever : 0;
}

static bool has_size(const struct panel *panel, int body)
{
    struct vec low, high;
    return shapes_size(panel->model, (size_t)body, &low, &high);
}

bool panel_is_shifted(const struct panel *panel, const fbd_force *force)
{
    return force->normal && has_size(panel, force->slide) &&
           !is_nothing(vec_norm(force_of(force)), panel->largest.force);
}

/* The point of a slide's surface where its force acts, for the slide or the body under it. */
static struct vec place_on_surface(const struct panel *panel, const fbd_force *force)
{
    const size_t slide = (size_t)force->slide;
    const fbd_body body = fbd_model_body(panel->model, slide);
    const fbd_pose pose = fbd_view_pose(panel->view, slide);
    struct vec e = vec_of(pose.along), down = vec_scale(-1, vec_of(pose.normal));
    struct vec G = vec_of(fbd_model_inertia(panel->model, slide).G);
    double reach =
        shapes_reach(panel->model, slide, G, (struct vec){vec_dot(down, e), vec_dot(down, vec_perp(e))});
    double along = panel_is_shifted(panel, force) ? panel_line_of_action(force, e) : 0;
    return vec_add(pose_point(&pose, &body, G), vec_add(vec_scale(reach, down), vec_scale(along, e)));
}

/* The start of the arrow; the forces of a slide's surface start at the point of contact. */
static struct vec tail_of(const struct panel *panel, const fbd_force *force)
{
    const struct vec point = {force->arrow.x, force->arrow.y};
    const bool own = force->slide == (int)panel->index;
    if (force->slide < 0) return panel_point(panel, point);
    if (!own && force->slide == panel->plate.rider) return panel->seat;
    if (has_size(panel, force->slide)) return panel_point(panel, place_on_surface(panel, force));
    return panel_point(panel, own ? panel->base : point);
}

/* ---- forces */

/* True if two arrows overlap on nearly the same line. */
static bool lie_together(const struct panel_arrow *a, const struct panel_arrow *b)
{
    if (a->radius > 0 || b->radius > 0) return false;
    struct vec d = vec_sub(a->head, a->tail), e = vec_sub(b->head, b->tail);
    double length = vec_norm(d);
    const double parallel = 0.05, near = 1.6, touch = 0.6;
    if (length == 0 || fabs(vec_cross(d, e)) > parallel * length * vec_norm(e)) return false;
    struct vec unit = vec_scale(1 / length, d), tail = vec_sub(b->tail, a->tail);
    if (fabs(vec_cross(unit, tail)) > near) return false;
    double from = vec_dot(unit, tail), to = from + vec_dot(unit, e);
    return fmin(length, fmax(from, to)) - fmax(0, fmin(from, to)) > touch;
}

static bool is_free(const struct panel *panel, const struct panel_arrow *arrow)
{
    bool free = true;
    for (size_t i = 0; i < panel->drawn_count; i++)
        free &= &panel->drawn[i] == arrow || !lie_together(arrow, &panel->drawn[i]);
    return free;
}

/* Move a force with its components. */
static void move_arrow(struct panel *panel, struct panel_arrow *arrow, struct vec way)
{
    for (struct panel_arrow *other = panel->drawn; other < panel->drawn + panel->drawn_count; other++) {
        const bool part = !arrow->component && other->component && other->source == arrow->source;
        if (other != arrow && !part) continue;
        other->tail = vec_add(other->tail, way);
        other->head = vec_add(other->head, way);
    }
}

/* A force that does not point away from the body may end at its point: a force that presses from outside, a
 * weight from above. */
static bool may_end_at_point(const struct panel *panel, const struct panel_arrow *arrow)
{
    struct vec out = vec_sub(arrow->tail, panel_point(panel, panel_place(panel, panel->G)));
    const double outward = 0.5; /* mm */
    return !arrow->component && vec_dot(out, vec_sub(arrow->head, arrow->tail)) <=
                                    outward * vec_norm(vec_sub(arrow->head, arrow->tail));
}

/* Let the arrow end where it starts; undone by a second call. */
static void reverse_end(struct panel *panel, struct panel_arrow *arrow)
{
    struct vec back = vec_sub(arrow->tail, arrow->head);
    move_arrow(panel, arrow, arrow->ends_at_point ? vec_scale(-1, back) : back);
    arrow->ends_at_point = !arrow->ends_at_point;
}

static void step_aside(struct panel *panel, struct panel_arrow *arrow)
{
    enum { most_steps = 8 };
    struct vec d = vec_sub(arrow->head, arrow->tail);
    struct vec across = vec_scale(side_step / vec_norm(d), vec_perp(d));
    int now = 0;
    for (int step = 0; step <= most_steps && !is_free(panel, arrow); step++) {
        int aside = (step + 1) / 2 * (step % 2 ? 1 : -1); /* 0, 1, -1, 2, -2, ... */
        move_arrow(panel, arrow, vec_scale(aside - now, across));
        now = aside;
    }
}

/* Separate two arrows on one line: either or both end at their points; else the weight, or the second, steps
 * aside, so that a reaction stays at its contact. */
static void separate_pair(struct panel *panel, struct panel_arrow *a, struct panel_arrow *b)
{
    const bool may_a = may_end_at_point(panel, a), may_b = may_end_at_point(panel, b);
    for (int choice = 1; choice <= 3; choice++) {
        const bool turn_b = choice & 1, turn_a = choice & 2;
        if ((turn_a && !may_a) || (turn_b && !may_b)) continue;
        if (turn_a) reverse_end(panel, a);
        if (turn_b) reverse_end(panel, b);
        if (is_free(panel, a) && is_free(panel, b)) return;
        if (turn_a) reverse_end(panel, a);
        if (turn_b) reverse_end(panel, b);
    }
    const bool weight = strcmp(a->source->kind, "gravity") == 0 && !a->component;
    step_aside(panel, weight ? a : b);
}

static void separate_arrows(struct panel *panel)
{
    for (size_t b = 0; b < panel->drawn_count; b++)
        for (size_t a = 0; a < b; a++)
            if (lie_together(&panel->drawn[a], &panel->drawn[b]))
                separate_pair(panel, &panel->drawn[a], &panel->drawn[b]);
}

const char *panel_symbol(const struct panel *panel, const struct panel_arrow *arrow)
{
    const size_t i = (size_t)(arrow->source - panel->forces);
    return arrow->radius > 0 ? panel->moments[i] : panel->symbols[i];
}

static const char *label_of(struct panel *panel, const struct panel_arrow *arrow, const char *name,
                            const char *unit)
{
    if (panel->moments && !arrow->component) return panel_symbol(panel, arrow);
    return arena_printf(panel->arena, "%s %s", name, panel_value(panel, arrow->value, unit));
}

static void avoid_arrow(struct panel *panel, const struct panel_arrow *arrow)
{
    labelling_avoid(&panel->labels, arrow->tail, arrow->head, on_arrow);
    struct vec d = vec_sub(arrow->head, arrow->tail);
    double length = vec_norm(d);
    struct vec back = vec_sub(arrow->head, vec_scale(head_length / length, d)),
               side = vec_scale(head_width / 2 / length, vec_perp(d));
    labelling_avoid(&panel->labels, vec_add(back, side), vec_sub(back, side), on_arrow);
}

static void draw_force(struct panel *panel, const fbd_force *source, struct vec force, const char *name,
                       const char *suffix)
{
    double size = vec_norm(force), length = 10 * size / panel->scale.force;
    struct panel_arrow *arrow = &panel->drawn[panel->drawn_count];
    *arrow = (struct panel_arrow){.source = source,
                                  .suffix = suffix,
                                  .component = suffix[0] != '\0',
                                  .small = length < shortest_arrow,
                                  .value = size,
                                  .tail = tail_of(panel, source)};
    struct vec unit = panel_direction(vec_scale(1 / size, force));
    arrow->head = vec_add(arrow->tail, vec_scale(fmax(length, shortest_arrow), unit));
    arrow->text = label_of(panel, arrow, name, panel->units.force);
    panel->drawn_count++;
}

/* Label a force at its head; at its tail where it ends at the body. */
static void label_force(struct panel *panel, struct panel_arrow *arrow)
{
    struct vec d = vec_sub(arrow->head, arrow->tail), unit = vec_scale(1 / vec_norm(d), d);
    struct vec free_end = arrow->ends_at_point ? arrow->tail : arrow->head;
    struct vec out = arrow->ends_at_point ? vec_scale(-1, unit) : unit;
    arrow->label = labelling_add(&panel->labels, arrow->text, label_size, free_end, out, 1.2);
    avoid_arrow(panel, arrow);
    box_take(&panel->extent, arrow->tail);
    box_take(&panel->extent, arrow->head);
}

/* Draw components along the axes of the world; on a slide along and across it; none if one of them nearly
 * equals the force. */
static void draw_components(struct panel *panel, const fbd_force *source, double largest)
{
    bool slide = panel->body.motion == FBD_MOTION_SLIDE || panel->body.motion == FBD_MOTION_TRACK;
    struct vec x = vec_of(panel->pose.along), y = vec_of(panel->pose.normal), force = force_of(source);
    double along = vec_dot(force, x), across = vec_dot(force, y);
    double size = vec_norm(force);
    if (is_nothing(size, largest) || fmin(fabs(along), fabs(across)) < least_component * size) return;
    const char *names[] = {arena_printf(panel->arena, "%s_{x}", source->arrow.name),
                           arena_printf(panel->arena, slide ? "%s_{n}" : "%s_{y}", source->arrow.name)};
    if (!names[0] || !names[1]) return;
    draw_force(panel, source, vec_scale(along, x), names[0], "-x");
    draw_force(panel, source, vec_scale(across, y), names[1], slide ? "-n" : "-y");
}

/* ---- moments */

static struct vec arc_point(const struct panel_arrow *arrow, double share)
{
    double angle = arrow->start + share * arrow->sweep;
    return vec_add(arrow->tail,
                   vec_scale(arrow->radius, panel_direction((struct vec){cos(angle), sin(angle)})));
}

/* The centre of an arc: where the force of a couple acts, else the axis of a pivot, else G. */
static struct vec arc_center(const struct panel *panel, const fbd_force *source, bool with_force)
{
    if (with_force && source->slide < 0) return (struct vec){source->arrow.x, source->arrow.y};
    return panel_place(panel, panel->body.motion == FBD_MOTION_PIVOT ? vec_of(panel->body.pin) : panel->G);
}

static void draw_moment(struct panel *panel, const fbd_force *source, int index, bool with_force)
{
    struct vec axis = arc_center(panel, source, with_force);
    double sweep = pi / 2 * source->arrow.couple / panel->scale.moment;
    struct panel_arrow *arrow = &panel->drawn[panel->drawn_count];
    *arrow = (struct panel_arrow){.source = source,
                                  .suffix = with_force ? "-moment" : "",
                                  .small = fabs(sweep) < least_sweep,
                                  .value = fabs(source->arrow.couple), /* the arc shows the sign */
                                  .tail = panel_point(panel, axis),
                                  .radius = first_radius + next_radius * index,
                                  .start = 0.35 + 1.1 * index};
    arrow->sweep = arrow->small ? copysign(least_sweep, sweep) : sweep;
    arrow->text = label_of(panel, arrow, source->arrow.name, panel->units.moment);
    panel->drawn_count++;
}

static void label_moment(struct panel *panel, struct panel_arrow *arrow)
{
    struct vec tip = arc_point(arrow, 1);
    struct vec out = vec_scale(1 / arrow->radius, vec_sub(tip, arrow->tail));
    arrow->label = labelling_add(&panel->labels, arrow->text, label_size, tip, out, 1.8);
    enum { pieces = 12 };
    for (int i = 0; i < pieces; i++) {
        struct vec from = arc_point(arrow, (double)i / pieces), to = arc_point(arrow, (i + 1.0) / pieces);
        labelling_avoid(&panel->labels, from, to, on_arrow);
        box_take(&panel->extent, from);
        box_take(&panel->extent, to);
    }
}

void panel_arrows(struct panel *panel)
{
    enum { most_pieces = 4 }; /* a force, a moment, two components */
    struct arrow_scale most = panel->largest;
    panel->drawn = ARENA_ARRAY(panel->arena, most_pieces * panel->force_count + 1, struct panel_arrow);
    if (!panel->drawn) return;
    int moments = 0;
    for (size_t i = 0; i < panel->force_count; i++) {
        const fbd_force *source = &panel->forces[i];
        bool force =
            isfinite(vec_norm(force_of(source))) && !is_nothing(vec_norm(force_of(source)), most.force);
        if (force) draw_force(panel, source, force_of(source), source->arrow.name, "");
        if (force && panel->drawing->components) draw_components(panel, source, most.force);
        if (isfinite(source->arrow.couple) && !is_nothing(source->arrow.couple, most.moment) &&
            !panel_is_shifted(panel, source))
            draw_moment(panel, source, moments++, force);
    }
    separate_arrows(panel);
    for (size_t i = 0; i < panel->drawn_count; i++)
        (panel->drawn[i].radius > 0 ? label_moment : label_force)(panel, &panel->drawn[i]);
}

/* ---- writing */

static void write_head(struct text *text, struct vec tip, struct vec direction)
{
    struct vec back = vec_sub(tip, vec_scale(head_length, direction)),
               side = vec_scale(head_width / 2, vec_perp(direction));
    struct vec corners[] = {tip, vec_add(back, side), vec_sub(back, side)};
    svg_polygon(text, "head", corners, 3);
}

static void write_force(struct text *text, const struct panel_arrow *arrow)
{
    struct vec d = vec_sub(arrow->head, arrow->tail);
    struct vec unit = vec_scale(1 / vec_norm(d), d);
    svg_line(text, "shaft", arrow->tail, vec_sub(arrow->head, vec_scale(head_length * 0.8, unit)));
    write_head(text, arrow->head, unit);
}

void panel_write_arc(struct text *text, const struct panel_arrow *arrow)
{
    double bow = head_length * 0.8 / arrow->radius; /* length of the head as an angle */
    double shaft = 1 - bow / fabs(arrow->sweep);
    text_add(text, "<path class=\"shaft\" d=\"M");
    svg_point(text, arc_point(arrow, 0));
    text_printf(text, " A%.2f %.2f 0 %d %d ", arrow->radius, arrow->radius, shaft * fabs(arrow->sweep) > pi,
                arrow->sweep < 0);
    svg_point(text, arc_point(arrow, shaft));
    text_add(text, "\"/>\n");
    /* the direction of the head is the chord of its arc */
    struct vec tip = arc_point(arrow, 1), chord = vec_sub(tip, arc_point(arrow, shaft));
    write_head(text, tip, vec_scale(1 / vec_norm(chord), chord));
}

static void write_title(const struct panel *panel, const struct panel_arrow *arrow, struct text *text)
{
    const fbd_force *source = arrow->source;
    text_printf(text, "<title>%s on %s: ", source->arrow.name, panel->body.name);
    if (arrow->radius > 0) {
        text_number(text, source->arrow.couple, 9);
        text_printf(text, " %s</title>\n", panel->units.moment);
        return;
    }
    text_add(text, "(");
    text_number(text, source->arrow.fx, 9);
    text_add(text, ", ");
    text_number(text, source->arrow.fy, 9);
    text_printf(text, ") %s, ", panel->units.force);
    text_number(text, vec_norm(force_of(source)), 9);
    text_printf(text, " %s at ", panel->units.force);
    text_number(text, atan2(source->arrow.fy, source->arrow.fx) * 180 / pi, 6);
    text_add(text, "° from x; acts at (");
    text_number(text, source->arrow.x, 9);
    text_add(text, ", ");
    text_number(text, source->arrow.y, 9);
    text_printf(text, ") %s</title>\n", panel->units.length);
}

void panel_write_arrows(const struct panel *panel, struct text *text)
{
    for (size_t i = 0; i < panel->drawn_count; i++) {
        const struct panel_arrow *arrow = &panel->drawn[i];
        const struct label_place *label = &panel->labels.labels[arrow->label];
        text_printf(text, "<g class=\"arrow %s%s%s\" id=\"%s-%s%s\">\n", arrow->source->kind,
                    arrow->component ? " component" : "", arrow->small ? " small" : "", panel->body.name,
                    arrow->source->arrow.name, arrow->suffix);
        write_title(panel, arrow, text);
        if (arrow->radius > 0)
            panel_write_arc(text, arrow);
        else
            write_force(text, arrow);
        if (label->leader) svg_line(text, "leader", label->anchor, labelling_leader(label));
        svg_text(text, "label", label->center, label_size, label->text);
        text_add(text, "</g>\n");
    }
}
