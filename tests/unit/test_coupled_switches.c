/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Switches whose speeds couplings make one: closed forms.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"
#include "written.h"

#include <stdlib.h>

static const char *const methods[] = {NULL, "dop853", "rkf45", "rodas5p"};

enum { method_count = sizeof methods / sizeof *methods };

/* * Two bodies on a rope, or wheels in a train of gears, each with its own -R_i sign(v_i), driven by A sin(w t) from rest: one
 * body of the mass M and the friction R, the sums of those of the parts by how fast they go. It rests while |A sin(w t)| <= R,
 * and slides with M v' = A sin(w t) -+ R until v is 0. What the shares of the parts at rest are is not determined: in
 * proportion to R_i.
 *
 * One of them may be a declared friction: the switches hold first, and it takes the rest. */

enum { most_wheels = 12 };

struct as_one {
    double M, R, A, w;
};

/* v at t, of what began to move to `side` at `from`. */
static double speed_as_one(const struct as_one *one, double from, int side, double t)
{
    return (one->A / one->w * (cos(one->w * from) - cos(one->w * t)) - side * one->R * (t - from)) / one->M;
}

static double way_as_one(const struct as_one *one, double from, int side, double t)
{
    double h = t - from, w = one->w;
    return (one->A / w * (cos(w * from) * h - (sin(w * t) - sin(w * from)) / w) - side * one->R * h * h / 2) /
           one->M;
}

/* When what began to move to `side` at `from` comes to rest: it does within the period. */
static double rest_as_one(const struct as_one *one, double from, int side)
{
    const double step = 0.005 / one->w;
    double low = from + step;
    while (side * speed_as_one(one, from, side, low + step) > 0) low += step;
    double high = low + step;
    for (int i = 0; i < 60; i++) {
        double middle = (low + high) / 2;
        *(side * speed_as_one(one, from, side, middle) > 0 ? &low : &high) = middle;
    }
    return high;
}

/* Where it is at the end, and how fast. */
static void follow_as_one(const struct as_one *one, double end, double *x, double *v)
{
    const double pi = acos(-1), least = one->A > one->R ? asin(one->R / one->A) : pi;
    double t = 0;
    *x = *v = 0;
    while (one->A > one->R) {
        double half = floor(one->w * t / pi), phase = one->w * t - half * pi;
        if (phase >= pi - least) half++, phase = 0;
        double from = phase > least ? t : (half * pi + least) / one->w;
        int side = fmod(half, 2) == 0 ? 1 : -1;
        if (from >= end) return;
        t = fmin(rest_as_one(one, from, side), end);
        *x += way_as_one(one, from, side, t);
        *v = t < end ? 0 : speed_as_one(one, from, side, end);
        if (t == end) return;
    }
}

static void draw_on_rope(struct random_numbers *numbers, bool declared, struct written *text,
                         struct as_one *one)
{
    const double m = random_between(numbers, 0.5, 2), weight = random_between(numbers, 0.5, 2);
    const double R[] = {random_between(numbers, 0.2, 1) * weight,
                        random_between(numbers, 0.2, 1) * weight}; /* taut: of 10 weight */
    *one = (struct as_one){m + weight, R[0] + R[1], (R[0] + R[1]) * random_between(numbers, 0.5, 1.9),
                           random_between(numbers, 1, 9)};
    add(text,
        "fbd: 1\ngravity: 10\nground: {points: {P: [9, 0]}}\nbodies:\n  a:\n    mass: %.17g\n    motion: "
        "{slide: {along: 0, through: [0, 0]}}\n    forces: [gravity, normal, ",
        m);
    if (declared)
        add(text, "friction: %.17g", R[0] / (10 * m));
    else
        add(text, "applied: {name: rub, value: \"-%.17g[N]*sign(v)\"}", R[0]);
    add(text, ", applied: \"%.17g[N]*sin(%.17g[1/s]*t) - %.17g[N]\"]\n", one->A, one->w, 10 * weight);
    add(text,
        "  b:\n    mass: %.17g\n    motion: {slide: {along: -90 deg, through: [9, 0]}}\n    initial: {x: "
        "9}\n    "
        "forces: [gravity, applied: {name: rub, value: \"%.17g[N]*sign(-v)\"}]\n"
        "couplings: [rope: {through: [a.G, ground.P, b.G], length: 18}]\n",
        weight, R[1]);
}

/* Wheel k goes r_0 / r_k times as fast as the first, to one side and the other. */
/* `declared`: the wheel with the declared friction, -1 for none. */
static void draw_train(struct random_numbers *numbers, int wheels, int declared, struct written *text,
                       struct as_one *one)
{
    double r[most_wheels], R[most_wheels], J[most_wheels], at = 0;
    *one = (struct as_one){.w = random_between(numbers, 1, 9)};
    for (int k = 0; k < wheels; k++) {
        r[k] = random_between(numbers, 0.3, 1);
        R[k] = random_between(numbers, 0.2, 2);
        J[k] = random_between(numbers, 0.2, 2);
        one->M += J[k] * r[0] / r[k] * r[0] / r[k];
        one->R += R[k] * r[0] / r[k];
    }
    one->A = one->R * random_between(numbers, 0.5, 3);
    add(text, "fbd: 1\nbodies:\n");
    for (int k = 0; k < wheels; k++) {
        at += k > 0 ? r[k - 1] + r[k] : 0;
        add(text, "  w%d: {mass: 1, inertia: %.17g, motion: {pivot: {at: [%.17g, 0]}}, moments: [", k, J[k],
            at);
        if (k == declared)
            add(text, "friction: {kinetic: %.17g N*m}", R[k]);
        else
            add(text, "applied: {name: rub, value: \"-%.17g[N*m]*sign(omega)\"}", R[k]);
        if (k == 0) add(text, ", applied: \"%.17g[N*m]*sin(%.17g[1/s]*t)\"", one->A, one->w);
        add(text, "]}\n");
    }
    add(text, "couplings:\n");
    for (int k = 1; k < wheels; k++)
        add(text, "  - gear: {between: [w%d, w%d], radii: [%.17g, %.17g]}\n", k - 1, k, r[k - 1], r[k]);
}

static void check_as_one(struct random_numbers *numbers, bool declared, int i, struct written *text,
                         struct checks *checks)
{
    struct as_one one;
    double x, v, end = random_between(numbers, 1, 4);
    bool rope = i % 2;
    int wheels = 2 + i / 2 % (most_wheels - 1);
    text->length = 0;
    if (rope)
        draw_on_rope(numbers, declared, text, &one);
    else
        draw_train(numbers, wheels, declared ? i / 2 % wheels : -1, text, &one);
    add(text, "simulate: {until: %.17g}\n", end);
    follow_as_one(&one, end, &x, &v);
    struct trial trial = trial_parse(text->all);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = methods[i / 2 % method_count];
    options.tolerance = 1e-10;
    trial_run(&trial, &options);
    bool same = check_that(checks, "it comes to its end", trial.outcome == FBD_DONE);
    same = same && check_close(checks, "place", trial_get(&trial, rope ? "a.x" : "w0.theta"), x, 1e-7);
    same = same && check_close(checks, "speed", trial_get(&trial, rope ? "a.v" : "w0.omega"), v, 1e-7);
    if (!same) printf("# draw %d\n%s", i, text->all);
    trial_close(&trial);
}

static void check_draws(uint64_t seed, bool declared)
{
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    struct written *text = calloc(1, sizeof *text);
    assert_non_null(text);
    for (int i = 0; i < draws_of(200); i++) check_as_one(&numbers, declared, i, text, &checks);
    free(text);
    checks_end(&checks);
}

static void switches_on_a_coupling_hold_together(void **unused)
{
    (void)unused;
    check_draws(2203, false);
}

static void friction_holds_with_switches_on_its_coupling(void **unused)
{
    (void)unused;
    check_draws(2207, true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(switches_on_a_coupling_hold_together),
        cmocka_unit_test(friction_holds_with_switches_on_its_coupling),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
