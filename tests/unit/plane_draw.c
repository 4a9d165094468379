/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "plane.h"

bool chance(struct random_numbers *numbers, double share)
{
    return random_between(numbers, 0, 1) < share;
}

struct push draw_push(struct random_numbers *numbers, double size)
{
    return (struct push){chance(numbers, 0.6) ? random_between(numbers, 0, size) : 0,
                         random_between(numbers, 0.5, 12), random_between(numbers, 0, 6),
                         chance(numbers, 0.5) ? random_between(numbers, -size / 2, size / 2) : 0};
}

double push_at(const struct push *push, double t)
{
    return push->A * sin(push->w * t + push->phase) + push->B;
}

void add_push(struct written *text, const struct push *push)
{
    add(text, "\"%.17g*sin(%.17g*t + %.17g) + %.17g\"", push->A, push->w, push->phase, push->B);
}

struct moreau_row *row_of(struct moreau_rows *rows, enum moreau_kind kind)
{
    struct moreau_row *row = &rows->row[rows->count++];
    *row = (struct moreau_row){.kind = kind, .normal = -1};
    return row;
}

void draw_stops(struct random_numbers *numbers, struct body *body, double size, bool plastic)
{
    double x = body->q[0], *v = &body->v[0];
    body->has_min = chance(numbers, 0.4);
    body->min = x - (chance(numbers, 0.25) ? 0 : random_between(numbers, 0.01, size));
    body->has_max = chance(numbers, 0.4);
    body->max = x + (body->min < x && chance(numbers, 0.25) ? 0 : random_between(numbers, 0.01, size));
    body->e = plastic ? 0 : random_between(numbers, 0, 0.9);
    if ((body->has_min && body->min == x && *v < 0) || (body->has_max && body->max == x && *v > 0)) *v = -*v;
}

void add_stops(struct written *text, const struct body *body)
{
    if (body->has_min) add(text, ", min: %.17g", body->min);
    if (body->has_max) add(text, ", max: %.17g", body->max);
    if (body->has_min || body->has_max) add(text, ", restitution: %.17g", body->e);
}

void rope_rows(const struct scene *scene, const double *q, struct moreau_rows *rows)
{
    for (int j = 0; j < scene->ropes; j++) {
        const struct rope *rope = &scene->rope[j];
        double w[moreau_most] = {0}, now = 0;
        for (int end = 0; end < 2; end++) {
            int b = end ? rope->other : rope->body;
            if (b < 0) continue;
            double dx = q[3 * b] - rope->at[0], dy = q[3 * b + 1] - rope->at[1], d = hypot(dx, dy);
            w[3 * b] = -dx / d;
            w[3 * b + 1] = -dy / d;
            now += d;
        }
        if (now >= rope->length) memcpy(row_of(rows, moreau_gap)->w, w, sizeof w);
    }
}
