/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Floors that are level, or not quite: crates slide over tiles whose heights differ by less than the level, and over blocks
 * whose heights differ by rounding, hop over others, and are stopped by higher steps.
 *
 * FBD_DRAWS: times as many scenes; FBD_CORNERS_SEED begins elsewhere; FBD_CORNERS_SHOW prints the scenes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "assemblies.h"
#include "fbd_study.h"
#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"
#include "written.h"

static const double g = 9.81;

static uint64_t first_seed(void)
{
    return (uint64_t)number_of("FBD_CORNERS_SEED", 1897) * 1000003u;
}

static void show(const struct written *text)
{
    if (getenv("FBD_CORNERS_SHOW")) printf("%s\n", text->all);
}

static size_t count_of(struct trial *trial, fbd_event_kind kind)
{
    size_t count = fbd_simulation_event_count(trial->simulation), found = 0;
    for (size_t i = 0; i < count; i++) found += fbd_simulation_event(trial->simulation, i).kind == kind;
    return found;
}

/* ---- floors of tiles */

/* Heights of tiles: every other one lower by h, or any between -h and h; the first is level with the floor. */
static void write_tiles(struct random_numbers *numbers, struct written *text, double h, double width,
                        int count)
{
    bool alternate = random_chance(numbers, 0.5);
    add(text, "fbd: 1\nground:\n  polygons:\n");
    for (int i = 0; i < count; i++) {
        double left = -3 + i * width, right = left + width;
        double y = i == 0 ? 0 : alternate ? -h * (i % 2) : random_between(numbers, -h, h);
        add(text, "    t%d: [[%.17g, -0.5], [%.17g, -0.5], [%.17g, %.17g], [%.17g, %.17g]]\n", i, left, right,
            right, y, left, y);
    }
}

static void slide_over_tiles(struct checks *checks, uint64_t seed, double h)
{
    struct random_numbers numbers = {seed};
    static struct assembly body;
    static struct written text;
    double a = random_between(&numbers, 0.2, 0.8), b = random_between(&numbers, 0.1, 0.3),
           mu = random_perhaps(&numbers, 0.7, 0.05, 0.4), width = random_between(&numbers, 0.3, 0.9),
           x0 = random_between(&numbers, -0.5, 0.5), v0 = random_between(&numbers, 1, 6),
           way = random_chance(&numbers, 0.5) ? 1 : -1, T = random_between(&numbers, 0.15, 0.3);
    int count = (int)(6 / width) + 1;
    text.length = 0;
    write_tiles(&numbers, &text, h, width, count);
    assembly_box(&body, 4, a, b, 1 + choose(&numbers, 2), 1);
    add(&text,
        "bodies:\n  box: {parts: {%s}, motion: planar, initial: {x: %.17g, y: %.17g, vx: %.17g}, forces: "
        "[gravity]}\n",
        body.parts.all, x0, b / 2, way * v0);
    add(&text, "contacts:\n");
    for (int i = 0; i < count; i++) add(&text, "  - {between: [box, ground.t%d], static: %.17g}\n", i, mu);
    add(&text, "simulate: {until: %.17g}\n", T);
    show(&text);
    double t = mu > 0 ? fmin(T, v0 / mu / g) : T, v = t < T ? 0 : v0 - mu * g * t;
    struct trial trial = trial_parse(text.all);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    size_t failed = checks->failed;
    check_that(checks, "it ends", trial.outcome == FBD_DONE);
    check_that(checks, "no impact", count_of(&trial, FBD_EVENT_IMPACT) == 0);
    check_close(checks, "box.x", trial_get(&trial, "box.x"), x0 + way * (v0 * t - mu * g * t * t / 2), 1e-9);
    check_close(checks, "box.vx", trial_get(&trial, "box.vx"), way * v, 1e-9);
    check_close(checks, "box.y", trial_get(&trial, "box.y"), b / 2, 1e-9);
    check_close(checks, "box.theta", trial_get(&trial, "box.theta"), 0, 1e-9);
    if (checks->failed > failed) printf("# seed %llu, h = %g\n%s\n", (unsigned long long)seed, h, text.all);
    trial_close(&trial);
}

/* The level is 1e-8 of the scene, which is larger than a metre. */
static void crates_slide_over_level_tiles(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(33); i++) {
        struct random_numbers numbers = {first_seed() + (uint64_t)i};
        int decade = -17 + i % 11; /* the first: none */
        double h = i % 11 == 0 ? 0 : random_between(&numbers, 1, 3) * pow(10, fmin(decade, -9));
        slide_over_tiles(&checks, first_seed() + (uint64_t)i, h);
    }
    checks_end(&checks);
}

/* Two heavy blocks side by side whose tops differ by h, and a crate that slides from one onto the other with v. */
static void write_blocks(struct random_numbers *numbers, struct written *text, double h, double v, double T)
{
    double height[2] = {random_between(numbers, 0.3, 0.7), 0}, width = random_between(numbers, 0.9, 1.2),
           a = random_between(numbers, 0.2, 0.5), b = random_between(numbers, 0.05, 0.15),
           x = random_between(numbers, 0.05, 0.3);
    height[1] = height[0] + h;
    text->length = 0;
    add(text, "fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n");
    for (int i = 0; i < 2; i++)
        add(text,
            "  block%d: {shape: prism, a: %.17g, b: %.17g, mass: 40, motion: planar, initial: {x: %.17g, y: "
            "%.17g}, forces: [gravity]}\n",
            i, width, height[i], (i - 0.5) * width, height[i] / 2);
    add(text,
        "  crate: {shape: prism, a: %.17g, b: %.17g, mass: 1, motion: planar, initial: {x: %.17g, y: %.17g, "
        "vx: "
        "%.17g}, forces: [gravity]}\n",
        a, b, -x, height[x < a / 2 && h > 0] + b / 2, v);
    add(text,
        "contacts:\n  - {between: [block0, ground.floor], static: 0.9}\n  - {between: [block1, "
        "ground.floor], "
        "static: 0.9}\n  - {between: [crate, block0]}\n  - {between: [crate, block1]}\nsimulate: {until: "
        "%.17g}\n",
        T);
}

/* Up to rounding tops are level; a step from there to the level of surfaces is refused, and never stops the crate. */
static void crates_slide_over_level_blocks(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(16); i++) {
        struct random_numbers numbers = {first_seed() + (uint64_t)i};
        static struct written text;
        int decade = -17 + i % 9;
        double h = random_between(&numbers, 1, 9) * pow(10, decade) * (random_chance(&numbers, 0.5) ? 1 : -1),
               v = random_between(&numbers, 0.5, 2), T = random_between(&numbers, 0.1, 0.3);
        write_blocks(&numbers, &text, h, v, T);
        show(&text);
        struct trial trial = trial_parse(text.all);
        trial_start(&trial, NULL);
        do {
            trial.outcome = fbd_simulation_advance(trial.simulation);
        } while (trial.outcome == FBD_GOING);
        size_t failed = checks.failed;
        bool refused = trial.outcome == FBD_FAILED && h > 0 && decade >= -12;
        check_that(&checks, "it ends, or a step is refused", trial.outcome == FBD_DONE || refused);
        if (trial.outcome == FBD_DONE) {
            trial_finish(&trial);
            check_close(&checks, "crate.vx", trial_get(&trial, "crate.vx"), v, 1e-3);
        }
        if (checks.failed > failed) printf("# h = %g\n%s\n", h, text.all);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Tiles far from level, over which a crate hops: the hops that are summed up put it down, and the balance has that. */
static void hops_over_tiles_keep_the_balance(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(40); i++) {
        struct random_numbers numbers = {first_seed() + (uint64_t)i};
        static struct written text;
        double h = random_between(&numbers, 1, 9) * pow(10, -5 + i % 2),
               a = random_between(&numbers, 0.2, 0.8), b = random_between(&numbers, 0.1, 0.3),
               width = random_between(&numbers, 0.3, 0.9);
        int count = (int)(6 / width) + 1;
        text.length = 0;
        write_tiles(&numbers, &text, h, width, count);
        add(&text,
            "bodies: {box: {shape: prism, mass: 1, a: %.17g, b: %.17g, motion: planar, initial: {y: %.17g, "
            "vx: "
            "%.17g}, forces: [gravity]}}\ncontacts:\n",
            a, b, h + b / 2, random_between(&numbers, 0.3, 4));
        for (int k = 0; k < count; k++) add(&text, "  - {between: [box, ground.t%d], restitution: 0.3}\n", k);
        add(&text, "simulate: {until: %.17g}\n", random_between(&numbers, 0.1, 0.6));
        show(&text);
        struct trial trial = trial_parse(text.all);
        trial_run(&trial, NULL);
        check_that(&checks, "it ends", trial.outcome == FBD_DONE);
        bool balanced = trial.result && fbd_result_balanced(trial.result, NULL, NULL);
        check_that(&checks, "in balance", balanced);
        if (!balanced) printf("# h = %g\n%s\n", h, text.all);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A smooth crate that slides against a step, however low, turns about its edge: omega = v b m / 2 (I + m (a^2 + b^2) / 4). */
static void crates_are_stopped_by_steps(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(20); i++) {
        struct random_numbers numbers = {first_seed() + (uint64_t)i};
        static struct written text;
        double h = random_between(&numbers, 1, 9) * pow(10, -7 + i % 4),
               a = random_between(&numbers, 0.2, 0.8), b = random_between(&numbers, 0.1, 0.3),
               v = random_between(&numbers, 1, 3) * pow(10, -choose(&numbers, 3)),
               way = random_chance(&numbers, 0.5) ? 1 : -1, T = random_between(&numbers, 0.01, 0.2), m = 2,
               x = way * (a / 2 + v * T); /* of the step */
        text.length = 0;
        add(&text,
            "fbd: 1\nground:\n  lines: {floor: {along: 0}}\n  polygons: {step: [[%.17g, -0.5], [%.17g, "
            "-0.5], [%.17g, "
            "%.17g], [%.17g, %.17g]]}\n",
            fmin(x, x + way), fmax(x, x + way), fmax(x, x + way), h, fmin(x, x + way), h);
        add(&text,
            "bodies: {box: {shape: prism, mass: %.17g, a: %.17g, b: %.17g, motion: planar, initial: {y: "
            "%.17g, vx: %.17g}, "
            "forces: [gravity]}}\ncontacts: [{between: [box, ground.floor]}, {between: [box, "
            "ground.step]}]\n",
            m, a, b, b / 2, way * v);
        add(&text, "simulate: {until: %.17g}\n", T + 1e-9);
        show(&text);
        struct trial trial = trial_parse(text.all);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        size_t failed = checks.failed;
        check_that(&checks, "it ends", trial.outcome == FBD_DONE);
        check_close(&checks, "box.omega", trial_get(&trial, "box.omega"),
                    -way * v * b / 2 / ((a * a + b * b) / 3), 1e-6 + 100 * h * v);
        if (checks.failed > failed) printf("# h = %g\n%s\n", h, text.all);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crates_slide_over_level_tiles),
        cmocka_unit_test(crates_slide_over_level_blocks),
        cmocka_unit_test(hops_over_tiles_keep_the_balance),
        cmocka_unit_test(crates_are_stopped_by_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
