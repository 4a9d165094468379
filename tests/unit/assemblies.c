/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "assemblies.h"

static void add_mass(struct assembly *body, double m, struct vec c, double I)
{
    body->G = vec_add(body->G, vec_scale(m, c));
    body->I += I + m * vec_dot(c, c);
    body->m += m;
}

static void close_assembly(struct assembly *body)
{
    body->G = vec_scale(1 / body->m, body->G);
    body->I -= body->m * vec_dot(body->G, body->G);
}

static void add_corner(struct assembly *body, double x, double y)
{
    assert_true(body->corner_count < most_corners);
    body->corner[body->corner_count++] = (struct vec){x, y};
}

static void add_prism(struct assembly *body, double m, double a, double b, double x, double y)
{
    add(&body->parts, "%sp%d: {shape: prism, mass: %.17g, a: %.17g, b: %.17g, center: [%.17g, %.17g]}",
        body->part_count > 0 ? ", " : "", body->part_count, m, a, b, x, y);
    body->part_count++;
    add_mass(body, m, (struct vec){x, y}, m * (a * a + b * b) / 12);
    for (int k = 0; k < 4; k++) add_corner(body, x + (k % 2 ? a : -a) / 2, y + (k / 2 ? b : -b) / 2);
}

static void add_rod(struct assembly *body, double m, struct vec from, struct vec to)
{
    struct vec d = vec_sub(to, from);
    add(&body->parts, "%sp%d: {shape: rod, mass: %.17g, from: [%.17g, %.17g], to: [%.17g, %.17g]}",
        body->part_count > 0 ? ", " : "", body->part_count, m, from.x, from.y, to.x, to.y);
    body->part_count++;
    add_mass(body, m, vec_scale(0.5, vec_add(from, to)), m * vec_dot(d, d) / 12);
    add_corner(body, from.x, from.y);
    add_corner(body, to.x, to.y);
}

void assembly_draw(struct random_numbers *numbers, struct assembly *body)
{
    double a = random_between(numbers, 0.1, 0.8), b = random_between(numbers, 0.1, 0.8);
    int count = 2 + choose(numbers, 3);
    *body = (struct assembly){0};
    switch (choose(numbers, 4)) {
    case 0:
        for (int k = 0; k < count; k++) add_prism(body, random_between(numbers, 0.2, 3), a, b, 0, 0);
        break;
    case 1: {
        const struct vec at[] = {{-a / 2, -b / 2}, {a / 2, -b / 2}, {a / 2, b / 2}, {-a / 2, b / 2}};
        for (int k = 0; k < 4; k++) add_rod(body, random_between(numbers, 0.2, 3), at[k], at[(k + 1) % 4]);
        break;
    }
    case 2:
        for (int k = 0; k < count; k++) {
            double angle = 0.5 + (k + random_between(numbers, 0, 0.7)) * 2.1 / count;
            struct vec to = {a * cos(angle), a * sin(angle)};
            add_rod(body, random_between(numbers, 0.2, 3), (struct vec){0, 0}, to);
        }
        break;
    default:
        add_prism(body, random_between(numbers, 0.2, 3), a, b, 0, 0);
        add_rod(body, random_between(numbers, 0.2, 3), (struct vec){-a / 2, -b / 2},
                (struct vec){a / 2, -b / 2});
        if (count > 2)
            add_rod(body, random_between(numbers, 0.2, 3), (struct vec){-a / 2, -b / 2},
                    (struct vec){-a / 2, b / 2});
        if (count > 3) add_prism(body, random_between(numbers, 0.2, 3), a, b, 0, 0);
    }
    close_assembly(body);
}

void assembly_draw_block(struct random_numbers *numbers, struct assembly *body)
{
    double left = random_between(numbers, 0.3, 1), right = random_between(numbers, 0.3, 1),
           b = random_between(numbers, 0.2, 1);
    int count = 2 + choose(numbers, 3);
    *body = (struct assembly){0};
    for (int k = 0; k < count; k++) {
        double a = k % 2 ? right : left;
        add_prism(body, random_between(numbers, 0.2, 3), a, b, k % 2 ? a / 2 : -a / 2, -b / 2);
    }
    close_assembly(body);
}

void assembly_box(struct assembly *body, double m, double a, double b, int columns, int rows)
{
    *body = (struct assembly){0};
    for (int i = 0; i < columns; i++)
        for (int j = 0; j < rows; j++)
            add_prism(body, m / columns / rows, a / columns, b / rows, ((i + 0.5) / columns - 0.5) * a,
                      ((j + 0.5) / rows - 0.5) * b);
}
