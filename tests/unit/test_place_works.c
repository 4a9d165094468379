/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Works of random forces and moments that depend on the coordinate of their body - at fixed and at following angles, at any
 * point, on discs on pivots and blocks on slides, alone and joined by gears, racks, springs, links and carried bodies -
 * against quadrature of r x f (of f . e) over the coordinate, and against the change of kinetic energy.
 * FBD_PLACE_WORKS=1000 tries so many, FBD_PLACE_WORKS_SEED=17 begins there, FBD_PLACE_WORKS_SHOW=1 prints the models.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { most_loads = 3, room = 4000 };

enum aim { in_the_world, with_the_body, by_formula, by_components, moment, aims };
enum joint { alone, geared, racked, sprung, with_pendulum, with_rod, joints };

struct load {
    enum aim aim;
    double a, k, p; /* a sin(k q + p), q in units of 1 rad or 1 m */
    double b, c;    /* fy = b cos(c q) by components; the angle by formula: b + c q */
    double angle;   /* [rad] */
    double x, y;    /* point */
};

struct scene {
    bool slides;
    double along; /* of the slide */
    enum joint joint;
    int loads;
    struct load load[most_loads];
    double mass, radius, q, rate, until;
};

static struct scene draw(struct random_numbers *numbers)
{
    struct scene s = {.slides = random_chance(numbers, 0.3)};
    s.along = random_between(numbers, -3, 3);
    s.joint = (enum joint)(random_bits(numbers) % joints);
    s.loads = 1 + (int)(random_bits(numbers) % most_loads);
    for (int i = 0; i < s.loads; i++) {
        struct load *load = &s.load[i];
        load->aim = (enum aim)(random_bits(numbers) % (s.slides ? moment : aims));
        load->a = random_between(numbers, -2, 2);
        load->k = random_between(numbers, 0.5, 3);
        load->p = random_perhaps(numbers, 0.5, -2, 2);
        load->b = random_between(numbers, -2, 2);
        load->c = random_between(numbers, -2, 2);
        load->angle = random_between(numbers, -3, 3);
        load->x = random_between(numbers, -0.4, 0.4);
        load->y = random_between(numbers, -0.4, 0.4);
    }
    s.mass = random_between(numbers, 0.5, 4);
    s.radius = random_between(numbers, 0.1, 0.4);
    s.q = random_perhaps(numbers, 0.7, -1, 1);
    s.rate = random_between(numbers, -2, 2);
    s.until = random_between(numbers, 0.3, 1.5);
    return s;
}

static double value_of(const struct load *load, double q)
{
    return load->a * sin(load->k * q + load->p);
}

/* dW/dq of a load. */
static double generalized(const struct scene *s, const struct load *load, double q)
{
    double f = value_of(load, q), turned = s->slides ? s->along : q, angle = load->angle, x, y;
    if (load->aim == moment) return f;
    if (load->aim == with_the_body) angle += turned;
    if (load->aim == by_formula) angle = load->b + load->c * q;
    x = f * cos(angle);
    y = f * sin(angle);
    if (load->aim == by_components) x = f, y = load->b * cos(load->c * q);
    if (s->slides) return x * cos(s->along) + y * sin(s->along);
    return (load->x * cos(q) - load->y * sin(q)) * y - (load->x * sin(q) + load->y * cos(q)) * x;
}

/* Simpson's rule with 4000 intervals: exact to 1e-12 for these functions over a few radians. */
static double work_between(const struct scene *s, const struct load *load, double from, double to)
{
    enum { intervals = 4000 };
    double sum = 0, h = (to - from) / intervals;
    for (int i = 0; i <= intervals; i++)
        sum += (i == 0 || i == intervals ? 1 : i % 2 ? 4 : 2) * generalized(s, load, from + i * h);
    return sum * h / 3;
}

__attribute__((format(printf, 2, 3))) static void add(char *text, const char *format, ...)
{
    size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, room - length, format, arguments);
    va_end(arguments);
}

static void write_load(const struct scene *s, int i, char *text)
{
    const struct load *load = &s->load[i];
    const char *q = s->slides ? "x/1[m]" : "theta", *unit = load->aim == moment ? "N*m" : "N";
    const char *key = load->aim == by_components ? "fx" : "value";
    add(text, "    - applied: {name: f%d, %s: '%.17g[%s]*sin(%.17g*%s + %.17g)'", i, key, load->a, unit,
        load->k, q, load->p);
    if (load->aim == by_components) add(text, ", fy: '%.17g[N]*cos(%.17g*%s)'", load->b, load->c, q);
    if (load->aim == in_the_world) add(text, ", angle: %.17g", load->angle);
    if (load->aim == with_the_body) add(text, ", angle: %.17g, frame: body", load->angle);
    if (load->aim == by_formula) add(text, ", angle: '%.17g + %.17g*%s'", load->b, load->c, q);
    if (load->aim != moment) add(text, ", at: [%.17g, %.17g]", load->x, load->y);
    add(text, "}\n");
}

static void write_loads(const struct scene *s, bool moments, char *text)
{
    bool any = false;
    for (int i = 0; i < s->loads; i++) {
        if ((s->load[i].aim == moment) != moments) continue;
        if (!any) add(text, "    %s:\n", moments ? "moments" : "forces");
        any = true;
        write_load(s, i, text);
    }
}

/* The other body of the joint, and the coupling. Pivots of the two are 1 m apart. */
static void write_others(const struct scene *s, char *text)
{
    const double other = 1 - s->radius;
    switch (s->joint) {
    case alone:
    case joints: break;
    case geared:
        if (s->slides) break;
        add(text,
            "  wheel: {mass: 2, shape: disc, radius: %.17g, motion: {pivot: {at: [1, 0]}}, initial: "
            "{assemble: true}}\n",
            other);
        add(text, "couplings: [gear: {name: mesh, between: [b, wheel]}]\n");
        break;
    case racked:
        if (s->slides) break;
        add(text,
            "  bar: {mass: 1, motion: {slide: {along: 0, through: [0, %.17g]}}, initial: {assemble: true}}\n",
            -s->radius);
        add(text, "couplings: [rack: {name: mesh, between: [b, bar]}]\n");
        break;
    case sprung:
        add(text, "  ball: {mass: 1, motion: particle, initial: {x: 1, y: 0.5}}\n");
        add(text, "couplings: [spring: {between: [b.a, ball], stiffness: 20, free_length: 0.7}]\n");
        break;
    case with_pendulum:
        add(text,
            "  hang: {mass: 1, motion: {pivot: {on: b, at: [0.1, 0], point: [0, 0.3]}}, inertia: 0.1}\n");
        break;
    case with_rod:
        add(text, "  ball: {mass: 1, motion: particle, initial: {x: 1, y: 0.5, assemble: true}}\n");
        add(text, "couplings: [rod: {between: [b.a, ball], length: 1.2}]\n");
        break;
    }
}

static void write(const struct scene *s, char *text)
{
    *text = '\0';
    add(text, "fbd: 1\ngravity: 0\nbodies:\n  b:\n    mass: %.17g\n    shape: disc\n    radius: %.17g\n",
        s->mass, s->radius);
    add(text, "    points: {a: [0.1, 0.05]}\n");
    if (s->slides)
        add(text, "    motion: {slide: {along: %.17g}}\n    initial: {x: %.17g, v: %.17g}\n", s->along, s->q,
            s->rate);
    else
        add(text, "    motion: {pivot: {at: [0, 0]}}\n    initial: {theta: %.17g, omega: %.17g}\n", s->q,
            s->rate);
    write_loads(s, false, text);
    write_loads(s, true, text);
    write_others(s, text);
    add(text, "simulate: {until: %.17g, tolerance: 1e-11}\n", s->until);
}

static void compare(struct checks *checks, const struct scene *s, int number)
{
    char text[room], label[80], name[8];
    write(s, text);
    if (getenv("FBD_PLACE_WORKS_SHOW")) puts(text);
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    snprintf(label, sizeof label, "scene %d comes to its end", number);
    if (!check_that(checks, label, trial.outcome == FBD_DONE)) {
        trial_close(&trial);
        return;
    }
    fbd_energy energy = fbd_result_energy(trial.result);
    double end = trial_get(&trial, s->slides ? "b.x" : "b.theta"), sum = 0;
    for (int i = 0; i < s->loads; i++) {
        double want = work_between(s, &s->load[i], s->q, end);
        snprintf(name, sizeof name, "f%d", i);
        snprintf(label, sizeof label, "scene %d, work of %s", number, name);
        double got = fbd_result_work(trial.result, "b", name);
        check_close(checks, label, got, want, 1e-8 * (1 + fabs(want)));
        sum += got;
    }
    snprintf(label, sizeof label, "scene %d, residual", number);
    check_close(checks, label, energy.residual, 0, 1e-8 * (1 + energy.kinetic));
    snprintf(label, sizeof label, "scene %d, change of kinetic energy", number);
    if (s->joint != sprung)
        check_close(checks, label, energy.kinetic - energy.initial_kinetic, sum, 1e-8 * (1 + energy.kinetic));
    trial_close(&trial);
}

static void works_are_integrals_over_the_coordinate(void **unused)
{
    const int draws = number_of("FBD_PLACE_WORKS", draws_of(150)),
              first = number_of("FBD_PLACE_WORKS_SEED", 1);
    struct checks checks = {0};
    (void)unused;
    for (int i = first; i < first + draws; i++) {
        struct random_numbers numbers = {(uint64_t)i};
        struct scene scene = draw(&numbers);
        compare(&checks, &scene, i);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(works_are_integrals_over_the_coordinate)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
