/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The same scene with its bodies in another order, or with one of them in two pieces.
 */
#include <math.h>
#include <stdio.h>

#include "variants.h"

/* ---- in another order */

static void renumber(struct formula *formula, const int *place)
{
    for (int k = 0; k < formula->count; k++)
        for (int i = 0; i < formula->summand[k].count; i++)
            formula->summand[k].variable[i].body = place[formula->summand[k].variable[i].body];
}

void vary_order(const struct scene *scene, struct random *random, struct scene *other)
{
    int place[most_bodies], n = scene->body_count;
    for (int b = 0; b < n; b++) place[b] = b;
    for (int b = n - 1; b > 0; b--) {
        int k = random_below(random, b + 1), keep = place[b];
        place[b] = place[k];
        place[k] = keep;
    }
    for (int b = 0; b < n; b++) {
        struct body *body = &other->body[place[b]];
        *body = scene->body[b];
        if (body->on >= 0) body->on = place[body->on];
        renumber(&body->drive, place);
        renumber(&body->mass, place);
        for (int i = 0; i < body->load_count; i++) {
            renumber(&body->load[i].value, place);
            renumber(&body->load[i].second, place);
            renumber(&body->load[i].surface, place);
            for (int k = 0; k < 2; k++) renumber(&body->load[i].offset[k], place);
            for (int k = 0; k < 2; k++) renumber(&body->load[i].wind[k], place);
            if (body->load[i].target >= 0) body->load[i].target = place[body->load[i].target];
        }
    }
    for (int i = 0; i < scene->state_count; i++) renumber(&other->state[i].rate, place);
    for (int c = 0; c < scene->coupling_count; c++) {
        struct coupling *coupling = &other->coupling[scene->coupling_count - 1 - c];
        *coupling = scene->coupling[c];
        for (int k = 0; k < coupling->count; k++)
            if (coupling->end[k].body >= 0) coupling->end[k].body = place[coupling->end[k].body];
    }
}

/* ---- split: the last part as a body of its own, welded on where it was */

static void pin_down(struct spot *spot, struct vec2 G)
{
    if (spot->point == at_G) *spot = (struct spot){at_pair, G};
}

/* What points to G of the body, too: it takes a point of a name. */
static bool keep_ends(struct scene *scene, int b, struct vec2 G)
{
    struct body *body = &scene->body[b];
    for (int i = 0; i < scene->body_count; i++)
        for (int k = 0; k < scene->body[i].load_count; k++) {
            struct load *load = &scene->body[i].load[k];
            bool points = load->kind == applied && load->form == toward_point && load->target == b;
            if (!points || load->end.point != at_G) continue;
            if (body->point_count == most_points) return false;
            body->points[body->point_count] = G;
            load->end.point = body->point_count++;
        }
    return true;
}

/* What was said of G stays where it was. */
static bool keep_centre(struct scene *scene, int b, struct vec2 G)
{
    struct body *body = &scene->body[b];
    pin_down(&body->point, G);
    for (int i = 0; i < body->load_count; i++)
        if (body->load[i].kind != gravity) pin_down(&body->load[i].at, G);
    for (int i = 0; i < scene->body_count; i++)
        if (scene->body[i].on == b) pin_down(&scene->body[i].at, G);
    if (!keep_ends(scene, b, G)) return false;
    for (int c = 0; c < scene->coupling_count; c++)
        for (int k = 0; k < scene->coupling[c].count; k++) {
            struct end *end = &scene->coupling[c].end[k];
            bool circle = end->pulley || scene->coupling[c].kind == gear || scene->coupling[c].kind == rack ||
                          scene->coupling[c].kind == belt || scene->coupling[c].kind == roll;
            if (end->body != b || circle || end->at.point != at_G) continue;
            if (body->point_count == most_points) return false;
            body->points[body->point_count] = G;
            end->at.point = body->point_count++;
        }
    return true;
}

bool vary_split(struct scene *scene, struct random *random, struct view *view)
{
    int b = 0;
    for (; b < scene->body_count; b++) {
        const struct body *body = &scene->body[b];
        const struct piece *last = &body->piece[body->piece_count - 1];
        if (body->motion != slide && body->piece_count > 1 && round_piece(body) != last) break;
    }
    if (b == scene->body_count || scene->body_count == most_bodies) return false;
    struct body *body = &scene->body[b], *part = &scene->body[scene->body_count];
    if (!keep_centre(scene, b, mass_of(body).G)) return false;
    struct piece piece = body->piece[--body->piece_count];
    struct mass left = mass_of(body);
    if (body->motion == planar && left.I_G < 0.05) return false;
    *part = (struct body){.motion = weld, .on = b, .piece_count = 1, .along = random_between(random, -3, 3)};
    snprintf(part->name, sizeof part->name, "part_of_%d", b);
    part->point = (struct spot){at_pair, {random_between(random, -1, 1), random_between(random, -1, 1)}};
    struct vec2 center = {random_between(random, -1, 1), random_between(random, -1, 1)};
    struct vec2 arm =
        turned((struct vec2){center.x - part->point.where.x, center.y - part->point.where.y}, part->along);
    part->at = (struct spot){at_pair, {piece.center.x - arm.x, piece.center.y - arm.y}};
    struct vec2 about = turned((struct vec2){piece.size[1], piece.size[2]}, -part->along);
    if (piece.shape == given_inertia) piece.size[1] = about.x, piece.size[2] = about.y;
    piece.center = center;
    bool has_axis = piece.shape != given_inertia && piece.shape != point_shape && piece.shape != sphere_shape;
    if (has_axis) piece.angle -= part->along;
    part->piece[0] = piece;
    for (int i = 0; i < body->load_count; i++)
        if (body->load[i].kind == gravity) part->load[part->load_count++] = body->load[i];
    scene->body_count++;
    view->changed = b;
    return true;
}
