/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene.h"

#include <math.h>
#include <stddef.h>

#include "absolute.h"

int coordinate_count(enum motion motion)
{
    static const int count[] = {
        [slide] = 1, [pivot] = 1, [particle] = 2, [planar] = 3, [weld] = 0, [track] = 1};
    return count[motion];
}

/* The table of moments of inertia about the centre of mass, for the axis that faces the plane. */
static double own_inertia(const struct piece *piece)
{
    const double m = piece->mass, *s = piece->size;
    switch (piece->shape) {
    case point_shape: return 0;
    case rod_shape: return m * s[0] * s[0] / 12;
    case sphere_shape: return 2 * m * s[0] * s[0] / 5;
    case disc_shape: return piece->lies ? m * (3 * s[0] * s[0] + s[2] * s[2]) / 12 : m * s[0] * s[0] / 2;
    case tube_shape: return m * (s[0] * s[0] + s[1] * s[1]) / 2;
    case prism_shape: return m * (s[0] * s[0] + s[1] * s[1]) / 12;
    case ring_shape: return piece->lies ? m * s[0] * s[0] / 2 : m * s[0] * s[0];
    case given_inertia: return s[0];
    }
    return 0;
}

struct mass mass_of(const struct body *body)
{
    struct mass mass = {0, 0, {0, 0}};
    for (int i = 0; i < body->piece_count; i++) {
        const struct piece *p = &body->piece[i];
        mass.m += p->mass;
        mass.G.x += p->mass * p->center.x;
        mass.G.y += p->mass * p->center.y;
    }
    mass.G.x /= mass.m;
    mass.G.y /= mass.m;
    for (int i = 0; i < body->piece_count; i++) {
        const struct piece *p = &body->piece[i];
        double x = p->center.x - mass.G.x, y = p->center.y - mass.G.y;
        mass.I_G += own_inertia(p) + p->mass * (x * x + y * y);
    }
    return mass;
}

struct vec2 spot_of(const struct body *body, const struct spot *spot)
{
    if (spot->point == at_origin) return (struct vec2){0, 0};
    if (spot->point == at_G) return mass_of(body).G;
    return spot->point == at_pair ? spot->where : body->points[spot->point];
}

const struct piece *round_piece(const struct body *body)
{
    for (int i = 0; i < body->piece_count; i++) {
        const struct piece *p = &body->piece[i];
        bool is_round = p->shape == sphere_shape || p->shape == disc_shape || p->shape == ring_shape ||
                        p->shape == tube_shape;
        if (is_round && p->mass > 0) return p;
    }
    return NULL;
}

double circle_of(const struct scene *scene, const struct coupling *coupling, int k, struct vec2 *centre)
{
    const struct end *end = &coupling->end[k];
    if (end->body < 0) { /* a rope is wound on the ground */
        *centre = end->at.where;
        return end->radius;
    }
    const struct body *body = &scene->body[end->body];
    const struct piece *piece = round_piece(body);
    double given = end->wound ? end->radius : k < 2 ? coupling->radius[k] : 0;
    bool about_point = coupling->centered || (end->wound && end->at.point != at_G);
    *centre = piece && !about_point ? piece->center : spot_of(body, &end->at);
    return given > 0 ? given : piece ? piece->size[0] : 0;
}

struct formula constant_formula(enum dimension dimension, double value)
{
    return (struct formula){dimension, 1, {{.factor = value, .parameter = -1, .function = f_one}}};
}

bool formula_is_constant(const struct formula *formula)
{
    for (int i = 0; i < formula->count; i++)
        if (formula->summand[i].function != f_one) return false;
    return true;
}

/* The body keeps its shape, and its moment of inertia goes with the mass. */
void absolute_masses(struct absolute *absolute)
{
    for (int b = 0; b < absolute->scene->body_count; b++) {
        const struct body *body = &absolute->scene->body[b];
        if (!body->mass_varies) continue;
        double m = formula_value(absolute, &body->mass), first = absolute->first_mass[b].m;
        absolute->mass[b].m = m;
        absolute->mass[b].I_G = absolute->first_mass[b].I_G * m / first;
    }
}
