/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "contact_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "random_numbers.h"

static const double weight = 9.81;

void contact_rows_new(struct contact_rows *of, size_t bodies, size_t most)
{
    *of = (struct contact_rows){.body_count = bodies, .most = most};
    of->bodies = calloc(bodies, sizeof *of->bodies);
    of->problem.rows = calloc(most, sizeof *of->problem.rows);
    of->A = calloc(most * most, sizeof *of->A);
    of->J = calloc(most * 3 * bodies, sizeof *of->J);
    if (!of->bodies || !of->problem.rows || !of->A || !of->J) exit(1);
}

void contact_rows_free(struct contact_rows *of)
{
    free(of->bodies);
    free(of->problem.rows);
    free(of->A);
    free(of->J);
}

static void add_body(const struct contact_rows *of, int body, double side, struct vec point, struct vec along,
                     double *J)
{
    if (body == the_ground) return;
    struct vec arm = vec_sub(point, of->bodies[body].at);
    J += 3 * (size_t)body;
    J[0] = side * along.x;
    J[1] = side * along.y;
    J[2] = side * (arm.x * along.y - arm.y * along.x);
}

static void add_row(struct contact_rows *of, int upper, int lower, struct vec point, struct vec along,
                    struct pivoting_row row)
{
    size_t i = of->problem.count++;
    if (i >= of->most) exit(1);
    double *J = of->J + i * 3 * of->body_count;
    add_body(of, upper, 1, point, along, J);
    add_body(of, lower, -1, point, along, J);
    of->problem.rows[i] = row;
}

void contact_rows_add(struct contact_rows *of, int upper, int lower, struct vec point, struct vec normal,
                      double mu)
{
    int i = (int)of->problem.count;
    add_row(of, upper, lower, point, normal,
            (struct pivoting_row){.high = HUGE_VAL, .of = -1, .mode = at_low});
    if (!(mu > 0)) return;
    struct vec along = {normal.y, -normal.x};
    add_row(of, upper, lower, point, along,
            (struct pivoting_row){.of = i, .low_share = -mu, .high_share = mu, .mode = at_low});
}

/* Component k of a velocity: its inverse inertia, and its acceleration without contacts. */
static double answer_of(const struct plane_body *body, size_t k)
{
    return k < 2 ? 1 / body->mass : 1 / body->inertia;
}

static double free_of(const struct plane_body *body, size_t k)
{
    return k == 0 ? body->a.x : k == 1 ? body->a.y : body->alpha;
}

void contact_rows_assemble(struct contact_rows *of)
{
    size_t n = of->problem.count, width = 3 * of->body_count;
    of->problem.A = of->A;
    for (size_t i = 0; i < n; i++) {
        const double *own = of->J + i * width;
        struct pivoting_row *row = &of->problem.rows[i];
        row->b = 0;
        row->mode = at_low;
        for (size_t c = 0; c < width; c++) row->b += own[c] * free_of(&of->bodies[c / 3], c % 3);
        for (size_t j = 0; j < n; j++) {
            double sum = 0;
            for (size_t c = 0; c < width; c++)
                if (own[c] != 0) sum += own[c] * answer_of(&of->bodies[c / 3], c % 3) * of->J[j * width + c];
            of->A[i * n + j] = sum;
        }
    }
}

static void set_brick(struct plane_body *brick, double x, double y)
{
    *brick = (struct plane_body){.at = {x, y}, .a = {0, -weight}, .mass = 2, .inertia = 2 * (4 + 1) / 12.0};
}

/* The lower side of brick k touches what lies below at both ends of what they share. */
static void lay_brick(struct contact_rows *of, int k, int wide, double mu)
{
    const struct vec up = {0, 1};
    struct vec at = of->bodies[k].at;
    for (int l = k / wide == 0 ? the_ground : (k / wide - 1) * wide; l < (k / wide) * wide; l++) {
        double left = at.x - 1, right = at.x + 1;
        if (l != the_ground) {
            left = fmax(left, of->bodies[l].at.x - 1);
            right = fmin(right, of->bodies[l].at.x + 1);
        }
        if (right - left < 0.5) continue;
        contact_rows_add(of, k, l, (struct vec){left, at.y - 0.5}, up, mu);
        contact_rows_add(of, k, l, (struct vec){right, at.y - 0.5}, up, mu);
        if (l == the_ground) return;
    }
}

void contact_rows_wall(struct contact_rows *of, int courses, int wide, double mu)
{
    int count = courses * wide;
    contact_rows_new(of, (size_t)count, (size_t)count * 8);
    for (int k = 0; k < count; k++) {
        int course = k / wide;
        set_brick(&of->bodies[k], 2 * (k % wide) + course % 2, 0.5 + course);
    }
    for (int k = 0; k < count; k++) lay_brick(of, k, wide, mu);
    contact_rows_assemble(of);
}

/* Rows of three and of two discs in turn, which touch the walls with three. */
static struct vec place_of_disc(int k)
{
    int pair = k / 5, in = k % 5;
    const double half = 1.25, up = sqrt(4 - half * half);
    if (in < 3) return (struct vec){1 + 2 * half * in, 1 + 2 * up * pair};
    return (struct vec){1 + half + 2 * half * (in - 3), 1 + up + 2 * up * pair};
}

void contact_rows_bin(struct contact_rows *of, int count, double mu)
{
    contact_rows_new(of, (size_t)count, (size_t)count * 12);
    for (int k = 0; k < count; k++)
        of->bodies[k] =
            (struct plane_body){.at = place_of_disc(k), .a = {0, -weight}, .mass = 1, .inertia = 0.5};
    for (int k = 0; k < count; k++) {
        struct vec at = of->bodies[k].at;
        if (k < 3) contact_rows_add(of, k, the_ground, (struct vec){at.x, at.y - 1}, (struct vec){0, 1}, mu);
        if (k % 5 == 0)
            contact_rows_add(of, k, the_ground, (struct vec){at.x - 1, at.y}, (struct vec){1, 0}, mu);
        if (k % 5 == 2)
            contact_rows_add(of, k, the_ground, (struct vec){at.x + 1, at.y}, (struct vec){-1, 0}, mu);
        for (int l = 0; l < k; l++) {
            struct vec apart = vec_sub(at, of->bodies[l].at);
            if (hypot(apart.x, apart.y) > 2 + 1e-9) continue;
            struct vec normal = vec_scale(0.5, apart);
            contact_rows_add(of, k, l, vec_add(of->bodies[l].at, normal), normal, mu);
        }
    }
    contact_rows_assemble(of);
}

void contact_rows_block(struct contact_rows *of, int points, struct random_numbers *numbers)
{
    contact_rows_new(of, 1, 2 * (size_t)points);
    of->bodies[0] =
        (struct plane_body){.at = {0, random_between(numbers, 0.2, 1)},
                            .a = {random_between(numbers, -5, 5), random_between(numbers, -10, 1)},
                            .mass = random_between(numbers, 0.5, 3),
                            .inertia = random_between(numbers, 0.1, 2),
                            .alpha = random_between(numbers, -3, 3)};
    double mu = random_between(numbers, 0, 0.8);
    for (int k = 0; k < points; k++)
        contact_rows_add(of, 0, the_ground, (struct vec){random_between(numbers, -1, 1), 0},
                         (struct vec){0, 1}, mu);
    contact_rows_assemble(of);
}

/* By how much a row violates its law, with x and w of unit diagonal. */
static double row_error(double x, double w, double low, double high)
{
    double error = fmax(fmax(low - x, x - high), 0);
    return fmax(error, fmax(fmin(fmax(0, w), x - low), fmin(fmax(0, -w), high - x)));
}

double contact_rows_error(const struct contact_rows *of)
{
    size_t n = of->problem.count;
    double worst = 0, size = 0;
    for (size_t i = 0; i < n; i++) {
        const struct pivoting_row *row = &of->problem.rows[i];
        double own = sqrt(of->A[i * n + i]), w = row->b, x = row->of >= 0 ? of->problem.rows[row->of].x : 0;
        for (size_t j = 0; j < n; j++) w += of->A[i * n + j] * of->problem.rows[j].x;
        double low = row->low + row->low_share * x, high = row->high + row->high_share * x;
        worst = fmax(worst, row_error(own * row->x, w / own, own * low, own * high));
        size = fmax(size, fabs(row->b) / own);
    }
    return size > 0 ? worst / size : worst;
}
