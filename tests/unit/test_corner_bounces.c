/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A box lands nearly flat, slips, and bounces on its two lower corners until it rests on both: against flights in closed form
 * and impacts that slip throughout, down to heights of 1e-16 m. All friction of the series counts, whatever the height at
 * which the run cuts it.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { corners = 2 };

static const double g = 9.81;

/* Of the center above its height at rest. */
struct box {
    double a, b, m, mu, e;
    double t, x, y, theta, vx, vy, omega;
};

/* The corner from the center, and its height, without the loss of digits of 1 - cos theta. */
static void find_corner(const struct box *box, int k, double theta, double r[2])
{
    const double side = (k == 0 ? -0.5 : 0.5) * box->a;
    r[0] = side * cos(theta) + box->b / 2 * sin(theta);
    r[1] = side * sin(theta) - box->b / 2 * cos(theta);
}

static double height(const struct box *box, int k, double t)
{
    const double theta = box->theta + box->omega * t, half = sin(theta / 2);
    const double side = (k == 0 ? -0.5 : 0.5) * box->a;
    return box->y + box->vy * t - g * t * t / 2 + side * sin(theta) + box->b * half * half;
}

static double rate(const struct box *box, int k, double t)
{
    double r[2];
    find_corner(box, k, box->theta + box->omega * t, r);
    return box->vy - g * t + box->omega * r[0];
}

/* The first touch of a corner: its height is above h + h' s - most s^2/2, whose roots approach it. */
static double touches_after(const struct box *box, int k)
{
    const double most = g + box->omega * box->omega * hypot(box->a, box->b) / 2;
    double t = 0;
    for (int i = 0; i < 200; i++) {
        const double h = fmax(0, height(box, k, t)), v = rate(box, k, t);
        const double root = sqrt(v * v + 2 * most * h), step = v > 0 ? (v + root) / most : 2 * h / (root - v);
        if (!(step > 1e-15 * t)) break;
        t += step;
    }
    return t;
}

static void fly(struct box *box, double t)
{
    box->t += t;
    box->x += box->vx * t;
    box->y += box->vy * t - g * t * t / 2;
    box->theta += box->omega * t;
    box->vy -= g * t;
}

/* False where the slip would not keep its direction. */
static bool strike(struct box *box, int k)
{
    double r[2];
    find_corner(box, k, box->theta, r);
    const double I = box->m * (box->a * box->a + box->b * box->b) / 12;
    const double f = box->vx - box->omega * r[1] > 0 ? -box->mu : box->mu;
    const double turn = (r[0] - r[1] * f) / I, answer = 1 / box->m + r[0] * turn;
    const double p = -(1 + box->e) * (box->vy + box->omega * r[0]) / answer;
    box->vx += f * p / box->m;
    box->vy += p / box->m;
    box->omega += turn * p;
    return answer > 0 && (box->vx - box->omega * r[1]) * f < 0;
}

/* To the end of all bounces. False for a motion of another kind: it turns over, or its slip ends. */
static bool settle(struct box *box)
{
    enum { most_impacts = 4000 };
    const double low = 1e-16;
    for (int i = 0; i < most_impacts; i++) {
        const double t[corners] = {touches_after(box, 0), touches_after(box, 1)};
        const int k = t[1] < t[0] ? 1 : 0;
        fly(box, t[k]);
        if (!strike(box, k) || fabs(box->theta) > 0.3) return false;
        const double v = fmax(fabs(rate(box, 0, 0)), fabs(rate(box, 1, 0)));
        if (v * v < 2 * g * low && fabs(height(box, 1 - k, 0)) < low) return true;
    }
    return false;
}

/* It slides on. */
static void slide(struct box *box, double t)
{
    const double a = box->vx > 0 ? -box->mu * g : box->mu * g;
    box->t += t;
    box->x += box->vx * t + a * t * t / 2;
    box->vx += a * t;
}

static struct box draw(struct random_numbers *numbers)
{
    return (struct box){.a = random_between(numbers, 0.2, 0.4),
                        .b = random_between(numbers, 0.05, 0.2),
                        .m = random_between(numbers, 0.5, 3),
                        .mu = random_between(numbers, 0.1, 0.4),
                        .e = random_between(numbers, 0.01, 0.6),
                        .y = random_between(numbers, 0.02, 0.1),
                        .theta = random_between(numbers, -0.05, 0.05),
                        .vx = random_between(numbers, 2, 4) * (random_chance(numbers, 0.5) ? 1 : -1),
                        .omega = random_between(numbers, -0.5, 0.5)};
}

static void check_box(struct checks *checks, const struct box *start, const struct box *end)
{
    char text[1000];
    snprintf(
        text, sizeof text,
        "fbd: 1\ngravity: %.17g\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n"
        "  box: {mass: %.17g, shape: prism, a: %.17g, b: %.17g, c: 0.1, axis: z, motion: planar, initial: "
        "{y: %.17g, theta: %.17g, vx: %.17g, omega: %.17g}, forces: [gravity]}\n"
        "contacts:\n  - {between: [box, ground.floor], restitution: %.17g, kinetic: %.17g}\n"
        "simulate: {until: %.17g, tolerance: 1e-11}\n",
        g, start->m, start->a, start->b, start->b / 2 + start->y, start->theta, start->vx, start->omega,
        start->e, start->mu, end->t);
    const size_t failed = checks->failed;
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    const double same = 1e-7; /* the speed of the reference at its end, and growth of errors by the impacts */
    check_close(checks, "x", trial_get(&trial, "box.x"), end->x, same);
    check_close(checks, "y", trial_get(&trial, "box.y"), end->b / 2, same);
    check_close(checks, "vx", trial_get(&trial, "box.vx"), end->vx, same);
    check_close(checks, "vy", trial_get(&trial, "box.vy"), 0, same);
    check_close(checks, "omega", trial_get(&trial, "box.omega"), 0, same);
    if (checks->failed > failed) print_message("# %s", text);
    trial_close(&trial);
}

static void the_cut_of_a_series_keeps_all_of_its_friction(void **unused)
{
    (void)unused;
    enum { seed = 568 };
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    int compared = 0;
    printf("# seed %d\n", seed);
    for (int left = draws_of(600); left > 0; left--) {
        const struct box start = draw(&numbers);
        struct box end = start;
        if (!settle(&end) || fabs(end.vx) < 0.5) continue;
        slide(&end, 0.02);
        check_box(&checks, &start, &end);
        compared++;
    }
    printf("# %d boxes\n", compared);
    check_that(&checks, "boxes settle", compared > 0);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cut_of_a_series_keeps_all_of_its_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
