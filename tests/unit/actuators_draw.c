/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "actuators.h"

static const double pi = 3.14159265358979323846;

/* The second derivatives of the natural spline, by elimination of its three diagonals. */
static void bend(struct act_table *table)
{
    double diagonal[act_points], right[act_points];
    const double *x = table->x, *y = table->y;
    const int last = act_points - 1;
    table->bend[0] = table->bend[last] = 0;
    for (int k = 1; k < last; k++) {
        double before = x[k] - x[k - 1], behind = x[k + 1] - x[k];
        diagonal[k] = 2 * (before + behind);
        right[k] = 6 * ((y[k + 1] - y[k]) / behind - (y[k] - y[k - 1]) / before);
        if (k == 1) continue;
        diagonal[k] -= before * before / diagonal[k - 1];
        right[k] -= before / diagonal[k - 1] * right[k - 1];
    }
    for (int k = last - 1; k > 0; k--)
        table->bend[k] = (right[k] - (x[k + 1] - x[k]) * table->bend[k + 1]) / diagonal[k];
}

static void draw_table(struct random_numbers *numbers, struct act_table *table, double from, double to,
                       double size)
{
    table->interpolation = (enum act_interpolation)random_between(numbers, 0, 2.999);
    table->beyond =
        (enum act_beyond)random_between(numbers, 0, table->interpolation == act_cubic ? 1.999 : 2.999);
    double x = from, step = (to - from) / act_points;
    for (int k = 0; k < act_points; k++) {
        table->x[k] = x, table->y[k] = random_between(numbers, -size, size);
        x += step * random_between(numbers, 0.2, 1.8);
    }
    if (table->beyond == act_repeat) table->y[act_points - 1] = table->y[0];
    bend(table);
}

static void draw_act(struct random_numbers *numbers, struct act_scene *scene, const struct act_body *body,
                     struct act *act)
{
    double *p = act->p, F = body->m * random_between(numbers, 1, 8), w = random_between(numbers, 1, 12);
    act->kind = (enum act_kind)random_between(numbers, 0, act_kinds - 0.001);
    if (act->kind == act_joined && scene->count == 1) act->kind = act_wave;
    act->state = act->kind == act_motor || act->kind == act_control ? scene->states++ : -1;
    switch (act->kind) {
    case act_motor: /* period, U, R, k, L */
        p[0] = random_between(numbers, 0.1, 1), p[2] = random_between(numbers, 0.5, 2);
        p[3] = random_between(numbers, 0.3, 2), p[4] = p[2] * random_between(numbers, 0.02, 0.3);
        p[1] = F * p[2] / p[3];
        break;
    case act_control: /* r, w, kp, ki, kd, F, bounds */
        p[0] = random_between(numbers, 0, 0.3), p[1] = w, p[2] = body->m * random_between(numbers, 5, 100);
        p[3] = p[2] * random_between(numbers, 0, 5), p[4] = body->m * random_between(numbers, 0, 8), p[5] = F;
        p[6] = random_between(numbers, 0.005, 0.1);
        break;
    case act_timed:
        draw_table(numbers, &act->table, random_between(numbers, -0.2, 0.2), scene->until, F);
        break;
    case act_placed: draw_table(numbers, &act->table, body->x - 0.3, body->x + 0.3, F); break;
    case act_relay:
        p[0] = random_between(numbers, -1, 1) * F, p[1] = body->x + random_between(numbers, -0.2, 0.05);
        p[2] = p[1] + random_between(numbers, 0.01, 0.2);
        break;
    case act_bumper:
        p[0] = body->x + random_between(numbers, 0, 0.2), p[1] = body->m * random_between(numbers, 20, 500);
        p[2] = body->m * random_between(numbers, 0, 10);
        break;
    case act_drag: /* gusts, w, updraught, linear, quadratic */
        p[0] = random_between(numbers, 0, 3), p[1] = w, p[2] = random_between(numbers, -2, 2);
        p[3] = body->m * random_between(numbers, 0, 0.8), p[4] = body->m * random_between(numbers, 0, 0.8);
        break;
    case act_load: /* at both ends, length, direction, share that waves, w */
        p[0] = random_between(numbers, 0.1, 1) * F, p[1] = random_between(numbers, 0.1, 1) * F, p[2] = 0.5;
        p[3] = random_between(numbers, -pi, pi), p[4] = random_between(numbers, 0, 1.5), p[5] = w;
        break;
    case act_sliding:
        p[0] = F, p[1] = body->x + random_between(numbers, -0.2, 0.2),
        p[2] = random_between(numbers, 0.05, 0.5);
        break;
    case act_joined:
        p[0] = body->m * random_between(numbers, 0, 60), p[1] = body->m * random_between(numbers, 0, 3);
        break;
    default: p[0] = F, p[1] = w, p[2] = random_between(numbers, 0, 6); break;
    }
}

static void draw_body(struct random_numbers *numbers, struct act_scene *scene, struct act_body *body)
{
    body->m = exp(random_between(numbers, -1, 1));
    body->along = random_perhaps(numbers, 0.6, -0.4, 0.4);
    body->x = random_between(numbers, -0.2, 0.2);
    body->v = random_perhaps(numbers, 0.6, -1.5, 1.5);
    if (random_chance(numbers, 0.3)) {
        body->comes = random_chance(numbers, 0.5);
        body->flow = body->m * random_between(numbers, 0.1, 0.5) / scene->until * (body->comes ? 1 : -1);
        body->jet = random_between(numbers, -2, 5);
    }
    body->mu = random_between(numbers, 0.02, 0.5);
    body->stribeck = random_perhaps(numbers, 0.3, 0, 0.3), body->scale = random_between(numbers, 0.05, 0.5);
    body->pulse = random_perhaps(numbers, 0.3, 0, 0.8), body->pulse_w = random_between(numbers, 1, 10);
    body->belt = random_perhaps(numbers, 0.4, -0.5, 0.5);
    body->belt_shaken = random_perhaps(numbers, 0.3, 0, 0.5), body->belt_w = random_between(numbers, 1, 15);
    body->e = random_perhaps(numbers, 0.7, 0, 0.9);
    for (int side = 0; side < 2; side++) {
        body->has_stop[side] = random_chance(numbers, 0.4);
        body->stop[side] = body->x + (side ? 1 : -1) * random_between(numbers, 0.01, 0.3);
    }
    body->has_rope = random_chance(numbers, 0.25);
    body->has_stop[1] &= !body->has_rope; /* a winch would haul it into that */
    body->anchor = body->x + random_between(numbers, 1.5, 2);
    body->length = body->anchor - body->x + random_between(numbers, 0.01, 0.2);
    body->haul = random_perhaps(numbers, 0.6, -0.3, 0.3), body->haul_w = random_between(numbers, 0.5, 6);
    body->acts = 1 + (int)random_between(numbers, 0, act_most - 0.001);
    for (int k = 0; k < body->acts; k++) draw_act(numbers, scene, body, &body->act[k]);
}

void act_draw(uint64_t seed, void *drawn)
{
    struct act_scene *scene = drawn;
    struct random_numbers numbers = {1000003u * seed + 7};
    *scene = (struct act_scene){.count = 1 + (int)random_between(&numbers, 0, 2.2),
                                .until = random_between(&numbers, 0.4, 2)};
    for (int i = 0; i < scene->count; i++) draw_body(&numbers, scene, &scene->body[i]);
}
