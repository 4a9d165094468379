/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "generate.h"

#include <stdio.h>
#include <string.h>

static const double pi = 3.141592653589793;

/* ---- bodies */

static struct vec2 random_vec(struct random *random, double size)
{
    double x = random_between(random, -size, size);
    return (struct vec2){x, random_between(random, -size, size)};
}

static void random_piece(struct random *random, struct piece *piece, bool turns)
{
    piece->shape = (enum shape)random_below(random, given_inertia + 1);
    if (turns && piece->shape == point_shape) piece->shape = rod_shape;
    piece->mass = random_between(random, 0.5, 3);
    for (int i = 0; i < 3; i++) piece->size[i] = random_between(random, 0.3, 1.2);
    if (piece->shape == tube_shape) piece->size[1] = round(500 * piece->size[0]) / 1000;
    if (piece->shape == given_inertia && random_chance(random, 0.5)) piece->size[1] = piece->size[2] = 0;
    if (piece->shape == disc_shape || piece->shape == ring_shape) piece->lies = random_chance(random, 0.2);
    if (random_chance(random, 0.5)) piece->center = random_vec(random, 0.4);
    bool has_axis =
        piece->shape != given_inertia && piece->shape != point_shape && piece->shape != sphere_shape;
    if (has_axis && random_chance(random, 0.3)) piece->angle = random_between(random, -pi, pi);
}

void random_disc(struct random *random, struct body *body, double radius)
{
    body->piece_count = 1;
    body->piece[0] =
        (struct piece){.shape = disc_shape, .mass = random_between(random, 0.5, 3), .size = {radius}};
    if (!random_chance(random, 0.3)) return;
    body->piece[1] = (struct piece){.shape = point_shape,
                                    .mass = random_between(random, 0.1, 0.5),
                                    .center = random_vec(random, 0.6 * radius)};
    body->piece_count = 2;
}

int random_point(struct random *random, struct body *body)
{
    if (body->point_count == most_points || (body->point_count > 0 && random_chance(random, 0.3)))
        return random_below(random, body->point_count);
    body->points[body->point_count] = random_vec(random, 0.8);
    return body->point_count++;
}

static struct spot random_spot(struct random *random, struct scene *scene, int b)
{
    if (b < 0) return (struct spot){at_pair, random_vec(random, 1.5)};
    switch (random_below(random, 4)) {
    case 0: return (struct spot){.point = at_G};
    case 1: return (struct spot){.point = at_origin};
    case 2: return (struct spot){at_pair, random_vec(random, 0.8)};
    default: return (struct spot){.point = random_point(random, &scene->body[b])};
    }
}

static double arm_of(const struct body *body)
{
    struct mass mass = mass_of(body);
    struct vec2 O = spot_of(body, &body->point);
    return mass.I_G + mass.m * ((mass.G.x - O.x) * (mass.G.x - O.x) + (mass.G.y - O.y) * (mass.G.y - O.y));
}

struct path random_path(struct random *random, bool closed)
{
    struct path path = {.form = closed || random_chance(random, 0.5) ? path_oval : path_wave};
    path.along = random_chance(random, 0.5) ? 0 : random_between(random, -pi, pi);
    if (path.form == path_oval) {
        path.a = random_between(random, closed ? 0.6 : 1, 1.8);
        path.b = random_between(random, closed ? 0.6 : 1, 1.8);
        path.from = closed ? 0 : -3;
        path.to = closed ? 2 * pi : 3;
    } else {
        path.a = random_between(random, 0.1, 0.5);
        path.b = random_between(random, -pi, pi);
        path.wave = random_between(random, 0.5, 1.2);
        path.from = -5;
        path.to = 5;
    }
    return path;
}

struct body *random_body(struct random *random, struct scene *scene, enum motion motion, int on)
{
    int b = scene->body_count++;
    struct body *body = &scene->body[b];
    memset(body, 0, sizeof *body);
    snprintf(body->name, sizeof body->name, "b%d", b);
    body->motion = motion;
    body->on = on;
    body->at.point = body->point.point = at_origin;
    body->piece_count = random_chance(random, 0.6) ? 1 : 2 + random_below(random, 2);
    for (int i = 0; i < body->piece_count; i++)
        random_piece(random, &body->piece[i], i == 0 && (motion == pivot || motion == planar));
    if (motion == slide || motion == weld) body->along = random_between(random, -pi, pi);
    if (motion == slide || motion == pivot || motion == weld || motion == track)
        body->at = random_spot(random, scene, on);
    if (motion == track) {
        body->path = random_path(random, false);
        body->keeps_direction = random_chance(random, 0.4);
    }
    if ((motion == pivot || motion == weld || motion == track) && random_chance(random, 0.6))
        body->point = random_spot(random, scene, b);
    if (motion == pivot && arm_of(body) < 0.02) body->piece[0].mass += 1;
    for (int i = 0; i < coordinate_count(motion); i++) {
        bool angle = motion == pivot || i == 2;
        body->q[i] = random_between(random, angle ? -pi : -1.5, angle ? pi : 1.5);
        body->v[i] = random_between(random, -1.5, 1.5);
        if (fabs(body->v[i]) < 0.3) body->v[i] = 0.5;
    }
    return body;
}

static enum motion random_motion(struct random *random, int on, enum focus focus)
{
    if (focus == of_tracks && random_chance(random, 0.6)) return track;
    static const enum motion motions[] = {slide,    slide,  pivot,  pivot, pivot,
                                          particle, planar, planar, weld,  track};
    enum motion motion = motions[random_below(random, 10)];
    return motion == weld && on < 0 ? pivot : motion;
}

static void random_tree(struct random *random, struct scene *scene, int count, enum focus focus)
{
    while (scene->body_count < count) {
        int on = scene->body_count > 0 && random_chance(random, 0.65)
                     ? random_below(random, scene->body_count)
                     : -1;
        struct body *body = random_body(random, scene, random_motion(random, on, focus), on);
        if (body->motion != slide && body->motion != pivot && body->motion != track) continue;
        if (!random_chance(random, 0.12)) continue;
        body->driven = true;
        body->drive = random_drive(random, body->motion != pivot ? dim_length : dim_angle);
    }
}

/* ---- the whole */

static void random_world(struct random *random, struct scene *scene)
{
    double g = random_chance(random, 0.5) ? 9.81 : random_between(random, 2, 12);
    double down = random_chance(random, 0.6) ? 0 : random_between(random, -pi, pi);
    scene->us = random_chance(random, 0.25);
    scene->gravity = (struct vec2){g * sin(down), -g * cos(down)};
    if (random_chance(random, 0.1)) scene->gravity = (struct vec2){0, 0};
    scene->parameter_count = random_below(random, most_parameters + 1);
    for (int i = 0; i < scene->parameter_count; i++) scene->parameter[i] = random_between(random, 0.3, 1.5);
}

/* Joint coordinates back into the scene. */
static void keep_start(struct scene *scene, const struct absolute *absolute)
{
    double q[3 * most_bodies], v[3 * most_bodies];
    int k = 0;
    absolute_coordinates(absolute, q, v);
    for (int b = 0; b < scene->body_count; b++)
        for (int i = 0; i < coordinate_count(scene->body[b].motion); i++, k++)
            scene->body[b].v[i] =
                fabs(v[k]) < 1e-8 ? 0 : v[k]; /* rounding of what stands still, by a short lever too */
}

/* One-sided surfaces are turned to the side on which they push. */
static void turn_surfaces(struct scene *scene, const struct absolute *absolute)
{
    for (int i = 0; i < absolute->grip_count; i++) {
        const struct grip *grip = &absolute->grip[i];
        if (grip->kind != grip_contact || grip->press * absolute->lambda[grip->normal] >= 0) continue;
        if (absolute->row[grip->row].kind == row_slot && scene->coupling[grip->owner].radius[0] == 0)
            scene->coupling[grip->owner].side = grip->press > 0 ? right_side : left_side;
        if (grip->load < 0) continue;
        struct load *load = &scene->body[grip->owner].load[grip->load];
        load->side = load->side == left_side ? right_side : left_side;
    }
}

static bool is_good(const struct absolute *absolute)
{
    return absolute->consistent && absolute->accelerations_unique && absolute->condition < 1e4 &&
           absolute->acceleration_size < 1e3 && absolute->acceleration_size > 1e-6;
}

bool scene_settle(const struct scene *scene, struct absolute *absolute)
{
    absolute_start(absolute, scene);
    return absolute_settle(absolute) && is_good(absolute);
}

bool scene_fit(struct scene *scene, struct absolute *absolute)
{
    absolute_start(absolute, scene);
    if (absolute_gap(absolute, true) > 1e-9 || shortest_pull(absolute) < 0.3) return false;
    for (int i = 0; i < 2; i++) absolute_project(absolute, false); /* once more for the digits */
    keep_start(scene, absolute);
    absolute_start(absolute, scene);
    return absolute_gap(absolute, false) <= 1e-9; /* drives may leave no way to move */
}

static struct taste random_taste(struct random *random, enum focus focus)
{
    struct taste taste = {.focus = focus,
                          .couplings = random_chance(random, 0.6),
                          .frictions = random_chance(random, 0.35),
                          .kinks = random_chance(random, 0.1)};
    taste.couplings |= focus == of_slots || focus == of_windings || focus == of_rolls || focus == of_spools;
    if (focus == of_tracks || focus == of_slots) taste.frictions = true;
    return taste;
}

bool scene_generate(struct scene *scene, struct absolute *absolute, uint64_t seed, enum focus focus)
{
    struct random random = {seed * 0x2545f4914f6cdd1du + 1};
    struct taste taste = random_taste(&random, focus);
    memset(scene, 0, sizeof *scene);
    scene->seed = seed;
    random_world(&random, scene);
    if (random_chance(&random, 0.3)) random_tables(&random, scene, taste.kinks);
    if (random_chance(&random, 0.3)) scene->state_count = 1 + random_below(&random, most_states);
    random_tree(&random, scene, 1 + random_below(&random, focus == any_scene ? 5 : 3), focus);
    int couplings = taste.couplings ? 1 + random_below(&random, 2) : 0;
    for (int i = 0; i < couplings; i++) random_coupling(&random, scene, &taste);
    for (int b = 0; b < scene->body_count; b++) random_mass(&random, scene, b, &taste);
    for (int b = 0; b < scene->body_count; b++) random_loads(&random, scene, b, &taste);
    random_states(&random, scene);
    if (!scene_fit(scene, absolute)) return false;
    for (int i = 0; i < absolute->grip_count; i++) absolute->grip[i].mode = holds;
    absolute_solve(absolute, true);
    turn_surfaces(scene, absolute);
    return scene_settle(scene, absolute);
}
