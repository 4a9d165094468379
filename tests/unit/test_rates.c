/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rates: every row gives the bits of the general path, in every mode, and each scene gets the rows that it
 * should.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "dynamics/modes.h"
#include "dynamics/project.h"
#include "dynamics/rates.h"
#include "dynamics/tree.h"
#include "dynamics/tree_bare.h"
#include "random_numbers.h"
#include "scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { points = 60, most_size = 64 };

static const unsigned seed = 1848;

static struct fbd_state *settled(const fbd_model *model)
{
    struct fbd_state *state = fbd_state_new(model);
    assert_non_null(state);
    assert_true(modes_settle(state, NULL));
    return state;
}

static void call(struct rates *rates, double t, const double *y, double *dydt)
{
    void *params;
    rates_function *function = rates_call(rates, &params);
    assert_int_equal(function(t, y, dydt, params), 0);
}

/* ---- the same bits */

/* Equal to `roundings` of the largest rate; 0: to the last bit. */
static void check_scene(const struct named_scene *scene, struct random_numbers *numbers, double roundings)
{
    fbd_model *model = model_from(scene->text);
    struct fbd_state *state = settled(model);
    struct rates *rows = rates_new(state, rates_by_rows), *general = rates_new(state, rates_general);
    size_t size = 2 * (size_t)model->plan.n;
    double y[most_size], got[most_size], want[most_size];
    assert_true(rows && general && size <= most_size);
    for (int point = 0; point < points; point++) {
        for (size_t i = 0; i < size; i++) y[i] = random_between(numbers, -2, 2);
        for (size_t i = 0; i < model->plan.mode_count; i++) {
            state->slip[i] = (int)(random_bits(numbers) % 3) - 1;
            if (model->plan.modes[i].two_sided) state->pull[i] = random_bits(numbers) % 2 ? 1 : -1;
        }
        rates_bind(rows);
        double t = random_between(numbers, 0, 3);
        call(rows, t, y, got);
        call(general, t, y, want);
        double largest = 0;
        for (size_t i = 0; i < size; i++) largest = fmax(largest, fabs(want[i]));
        for (size_t i = 0; i < size; i++)
            if (!(fabs(got[i] - want[i]) <= roundings * DBL_EPSILON * largest) &&
                !(got[i] == want[i] || (isnan(got[i]) && isnan(want[i]))))
                fail_msg("seed %u: `%s`: rate %zu is %.17g by its row and %.17g in general", seed,
                         scene->name, i, got[i], want[i]);
    }
    rates_free(rows);
    rates_free(general);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void rows_give_the_bits_of_the_general_path(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {seed};
    for (size_t i = 0; i < all_scenes_count; i++) check_scene(&all_scenes[i], &numbers, 0);
}

/* A particle at the ends of its springs, next to them and so far away that squares of lengths are beyond all numbers. */
static void springs_have_the_bits_of_the_general_path_anywhere(void **unused)
{
    static const double places[] = {0, 5e-324, 1e-170, 1e-140, 1, 1e139, 1e141, 1e160};
    enum { count = sizeof places / sizeof *places };
    (void)unused;
    fbd_model *model =
        model_from("fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: {particle: {}}\n    forces:\n"
                   "      - spring: {name: s1, stiffness: 40, to: [0, 0]}\n"
                   "      - spring: {name: s2, stiffness: 60, free_length: 0.5, to: [1, 0]}\n"
                   "      - applied: {name: push, value: 3*sin(7*t), angle: 90 deg}\n"
                   "simulate: {until: 1}\n");
    struct fbd_state *state = settled(model);
    struct rates *rows = rates_new(state, rates_by_rows), *general = rates_new(state, rates_general);
    assert_true(rows && general);
    for (int i = 0; i < count * count; i++) {
        double y[4] = {places[i / count], places[i % count], 1, -2}, got[4], want[4];
        call(rows, 0.3, y, got);
        call(general, 0.3, y, want);
        for (int k = 0; k < 4; k++)
            if (got[k] != want[k] && !(isnan(got[k]) && isnan(want[k])))
                fail_msg("at %g, %g: %.17g and %.17g", y[0], y[1], got[k], want[k]);
    }
    rates_free(rows);
    rates_free(general);
    fbd_state_free(state);
    fbd_model_free(model);
}

/* Up to three chains of `least` pivots or one more, on the ground or on a slide, with gravity, constant forces, springs,
 * dampers and moments in joints, and what is welded to a link. */
static void add_chain(struct random_numbers *numbers, int chain, int least, FILE *out)
{
    int count = least + (int)(random_bits(numbers) % 2);
    bool slides = random_bits(numbers) % 2;
    for (int i = 0; i < count; i++) {
        double m = random_between(numbers, 0.1, 3), x = random_between(numbers, -1, 1),
               angle = random_between(numbers, -3, 3);
        fprintf(out,
                "  b%d_%d:\n    shape: rod\n    mass: %.17g\n    from: [%.17g, 0.1]\n    to: [0.3, %.17g]\n",
                chain, i, m, x, random_between(numbers, 0.5, 2));
        if (i == 0 && slides)
            fprintf(out, "    motion: {slide: {along: %.17g rad}}\n", angle);
        else if (i == 0)
            fprintf(out, "    motion: {pivot: {at: [0.2, %d]}}\n", chain);
        else
            fprintf(out, "    motion: {pivot: {on: b%d_%d, at: [%.17g, 0.4], point: left}}\n", chain, i - 1,
                    x);
        fprintf(out,
                "    forces:\n      - gravity\n      - applied: {name: f, value: %.17g, angle: %.17g rad, "
                "at: right}\n",
                m, angle);
        if ((i > 0 || !slides) && random_bits(numbers) % 2)
            fprintf(out,
                    "    moments:\n      - spring: {stiffness: 3, neutral: %.17g rad}\n      - damper: "
                    "{coefficient: 0.2}\n"
                    "%s",
                    angle, count == 5 ? "      - applied: {name: drive, value: 2}\n" : "");
    }
    if (random_bits(numbers) % 2)
        fprintf(out,
                "  tip%d: {shape: point, mass: 0.7, motion: {weld: {on: b%d_%d, at: right}}, forces: "
                "[gravity]}\n",
                chain, chain, count - 1);
}

/* Short ones have a closed form, which rounds otherwise, and mass ratios to 30 multiply that. */
static void check_chains(int least, double roundings)
{
    struct random_numbers numbers = {seed};
    int bare = 0;
    for (int draw = 0; draw < 120; draw++) {
        char *text;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        assert_non_null(out);
        fprintf(out, "fbd: 1\nbodies:\n");
        for (int chain = (int)(random_bits(&numbers) % 3); chain >= 0; chain--)
            add_chain(&numbers, chain, least, out);
        fprintf(out, "simulate: {until: 1}\n");
        assert_int_equal(fclose(out), 0);
        struct named_scene scene = {"chains", text};
        fbd_model *model = model_from(text);
        bare += model->tree && tree_is_bare(model);
        fbd_model_free(model);
        check_scene(&scene, &numbers, roundings);
        free(text);
    }
    assert_true(bare > 20); /* the others have constant moments, some or, of five links, all */
}

static void long_bare_chains_give_the_bits_of_the_general_path(void **unused)
{
    (void)unused;
    check_chains(4, 0);
}

static void short_bare_chains_are_the_general_path_to_rounding(void **unused)
{
    (void)unused;
    check_chains(2, 1000);
}

/* ---- a loop of three links */

/* A link on `motion`, of any mass and shape, under gravity and now and then under what else may act on it. */
static void add_link(struct random_numbers *numbers, char name, const char *motion, bool slides, FILE *out)
{
    fprintf(out, "  %c:\n    mass: %.17g\n    inertia: %.17g\n", name, random_between(numbers, 0.1, 3),
            random_between(numbers, 0.05, 0.5));
    fprintf(out, "    center: [%.17g, %.17g]\n    points: {o: [0, 0], p: [%.17g, %.17g]}\n",
            random_between(numbers, -0.3, 0.5), random_between(numbers, -0.3, 0.3),
            random_between(numbers, 0.4, 1.5), random_between(numbers, -0.2, 0.2));
    fprintf(out, "    motion: %s\n    forces:\n      - gravity\n", motion);
    fprintf(out, "      - applied: {name: f, value: %.17g, angle: 1 rad, at: p}\n",
            random_between(numbers, -3, 3));
    if (slides && random_bits(numbers) % 2) fprintf(out, "      - applied: {name: push, value: 3}\n");
    if (slides && random_bits(numbers) % 2)
        fprintf(out, "      - applied: {name: gas, value: \"2*sin(3*t) + 3[N/m]*x\"}\n");
    if (slides && random_bits(numbers) % 2) fprintf(out, "      - spring: {stiffness: 4}\n");
    if (slides && random_bits(numbers) % 2) fprintf(out, "      - normal: {two_sided: true}\n");
    if (slides) return;
    fprintf(out, "    moments:\n      - applied: {name: couple, value: %.17g}\n",
            random_between(numbers, -1, 1));
    if (random_bits(numbers) % 2) fprintf(out, "      - damper: {coefficient: 0.3}\n");
    if (random_bits(numbers) % 2)
        fprintf(out, "      - applied: {name: drive, value: \"2*sin(3*t) - 1[N*m*s]*omega\"}\n");
}

/* Two links in a chain and one by itself, or all three in one: slider-cranks, four-bars and elbows. */
static void write_loop(struct random_numbers *numbers, FILE *out)
{
    static const char slide[] = "{slide: {along: 20 deg}}", pivot[] = "{pivot: {at: [0.2, 0.1]}}",
                      on_a[] = "{pivot: {on: a, at: p}}", on_b[] = "{pivot: {on: b, at: p}}";
    bool first = random_bits(numbers) % 2, last = random_bits(numbers) % 2,
         alone_first = random_bits(numbers) % 2;
    int shape = (int)(random_bits(numbers) % 3);
    fprintf(out, "fbd: 1\nbodies:\n");
    if (shape > 0 && alone_first) add_link(numbers, 'c', last ? slide : pivot, last, out);
    add_link(numbers, 'a', first ? slide : pivot, first, out);
    add_link(numbers, 'b', on_a, false, out);
    if (shape > 0 && !alone_first) add_link(numbers, 'c', last ? slide : pivot, last, out);
    if (shape == 0) add_link(numbers, 'c', on_b, false, out);
    if (random_bits(numbers) % 2)
        fprintf(out, "  tip: {shape: point, mass: 0.7, motion: {weld: {on: b, at: p}}, forces: [gravity]}\n");
    fprintf(out, "ground: {points: {E: [1, 0]}}\ncouplings:\n  - pin: {name: closure, between: [%s]}\n",
            shape == 0   ? "c.p, ground.E"
            : shape == 1 ? "b.p, c.o"
                         : "c.p, b.p");
    fprintf(out, "simulate: {until: 1}\n");
}

static int count_by_loop(const fbd_model *model, struct random_numbers *numbers)
{
    struct tree_loop loop;
    int count = 0;
    assert_true(tree_loop_find(model, &loop));
    for (int point = 0; point < points; point++) {
        double y[6], a[3], f[3] = {0, 0, 0};
        for (int i = 0; i < 6; i++) y[i] = random_between(numbers, -2, 2);
        count += tree_loop_rates(&loop, f, y, y + 3, a);
    }
    return count;
}

static void loops_are_the_general_path_to_rounding(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {seed};
    int by_loop = 0, draws = 200;
    for (int draw = 0; draw < draws; draw++) {
        char *text;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        assert_non_null(out);
        write_loop(&numbers, out);
        assert_int_equal(fclose(out), 0);
        struct named_scene scene = {text, text};
        fbd_model *model = model_from(text);
        by_loop += count_by_loop(model, &numbers);
        fbd_model_free(model);
        check_scene(&scene, &numbers, 1e4);
        free(text);
    }
    assert_true(by_loop > draws * points / 2); /* the others are next to singular positions */
}

/* From a state that is off by about `off`: both ways back end at the pin, with changes of the least size, so that what is
 * between them is of second order. */
static bool check_return(struct fbd_state *state, struct random_numbers *numbers, double off)
{
    const double damped = 1e-4; /* what rows with little slope leave in general, see project.c */
    struct instant at = state_instant(state);
    double by_loop[6], in_general[6], size = 1;
    for (int i = 0; i < 6; i++) {
        by_loop[i] = in_general[i] = state->y[i] + off * random_between(numbers, -1, 1);
        size = fmax(size, fabs(state->y[i]));
    }
    struct tree_loop *loop = state->tree->loop;
    if (!tree_loop_return(loop, by_loop)) return false;
    state->tree->loop = NULL;
    return_to_constraints(state->model, &at, in_general);
    state->tree->loop = loop;
    memcpy(state->scratch, state->y, sizeof by_loop);
    memcpy(state->y, by_loop, sizeof by_loop);
    struct misfit misfit = state_misfit(state);
    memcpy(state->y, state->scratch, sizeof by_loop);
    assert_true(misfit.position <= 1e-14 * size && misfit.velocity <= 1e-12 * size);
    for (int i = 0; i < 6; i++)
        if (!(fabs(by_loop[i] - in_general[i]) <= 100 * size * (off * off + damped * off + 1e-14)))
            fail_msg("off by %g: component %d is %.17g by the loop and %.17g in general", off, i, by_loop[i],
                     in_general[i]);
    return true;
}

static void loops_return_to_their_pins_as_in_general(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {seed};
    int returned = 0, draws = 300;
    for (int draw = 0; draw < draws; draw++) {
        char *text;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        assert_non_null(out);
        write_loop(&numbers, out);
        assert_int_equal(fclose(out), 0);
        fbd_model *model = model_from(text);
        struct fbd_state *state = state_new(model);
        assert_non_null(state);
        for (int i = 0; i < 6; i++) state->y[i] = random_between(&numbers, -2, 2);
        if (state_project(state, false))
            for (int digits = 3; digits < 13; digits++)
                returned += check_return(state, &numbers, pow(10, -digits));
        state_free(state);
        fbd_model_free(model);
        free(text);
    }
    assert_true(returned > 3 * draws); /* of most draws the loop cannot be closed, or is next to singular */
}

/* ---- which rows */

#define BODY(motion, rest)                                                                                   \
    "fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: {" motion "}\n" rest "simulate: {until: 1}\n"
#define SLIDE      "slide: {along: 30 deg}"
#define ON_SURFACE "      - gravity\n      - normal\n"

struct expectation {
    const char *name, *text;
    struct rates_census rows;
};

static void check_census(const struct expectation *want)
{
    fbd_model *model = model_from(want->text);
    struct fbd_state *state = settled(model);
    struct rates *rates = rates_new(state, rates_by_rows);
    assert_non_null(rates);
    struct rates_census got = rates_census(rates);
    if (memcmp(&got, &want->rows, sizeof got) != 0)
        fail_msg("%s: %d scalar, %d held, %d alone, %d bare, %d whole", want->name, got.scalar, got.held,
                 got.alone, got.bare, got.whole);
    rates_free(rates);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void every_scene_gets_the_least_row_that_does(void **unused)
{
    (void)unused;
    static const struct expectation rows[] = {
        {"a free particle", BODY("particle: {}", ""), {.scalar = 2}},
        {"a particle that falls", BODY("particle: {}", "    forces: [gravity]\n"), {.scalar = 2}},
        {"a block that slips on a line",
         BODY(SLIDE, "    initial: {v: 3}\n    forces:\n" ON_SURFACE "      - friction: 0.5\n"),
         {.scalar = 1}},
        {"a block that sticks",
         BODY(SLIDE, "    forces:\n" ON_SURFACE "      - friction: 0.8\n"),
         {.held = 1}},
        {"friction under a push across the line that varies",
         BODY(SLIDE, "    initial: {v: 3}\n    forces:\n" ON_SURFACE
                     "      - friction: 0.5\n      - applied: {name: f, value: 2*cos(3*t), angle: 0 deg}\n"),
         {.alone = 1}},
        {"spring and quadratic drag",
         BODY(SLIDE, "    forces:\n      - spring: {stiffness: 5}\n      - drag: {quadratic: 1}\n"),
         {.scalar = 1}},
        {"a place in the world that a derivation by hand alone names",
         BODY(SLIDE, "    forces:\n      - spring: {stiffness: 5}\n    hand: \"m*v_dot = -5[N/m]*b.G.x\"\n"),
         {.scalar = 1}},
        {"a harmonic force",
         BODY(SLIDE, "    forces:\n      - applied: {name: f, value: 3*sin(2*t)}\n"),
         {.scalar = 1}},
        {"another formula",
         BODY(SLIDE, "    forces:\n      - applied: {name: f, value: \"3*exp(-2*t)\"}\n"),
         {.scalar = 1}},
        {"a particle on a spring",
         BODY("particle: {}", "    forces:\n      - spring: {stiffness: 5, free_length: 1, to: [0, 3]}\n"),
         {.alone = 1}},
        {"a pendulum",
         "fbd: 1\nbodies:\n  b:\n    motion: {pivot: {at: [0, 0]}}\n    shape: point\n    mass: 2\n"
         "    center: [0, -1 m]\n    forces: [gravity]\nsimulate: {until: 1}\n",
         {.scalar = 1}},
        {"a double pendulum",
         "fbd: 1\nbodies:\n  a: {shape: rod, mass: 1, length: 1, motion: {pivot: {point: left}}, forces: "
         "[gravity]}\n"
         "  b: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: a, at: right, point: left}}, forces: "
         "[gravity]}\n"
         "simulate: {until: 1}\n",
         {.bare = 1}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) check_census(&rows[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_give_the_bits_of_the_general_path),
        cmocka_unit_test(springs_have_the_bits_of_the_general_path_anywhere),
        cmocka_unit_test(long_bare_chains_give_the_bits_of_the_general_path),
        cmocka_unit_test(short_bare_chains_are_the_general_path_to_rounding),
        cmocka_unit_test(loops_are_the_general_path_to_rounding),
        cmocka_unit_test(loops_return_to_their_pins_as_in_general),
        cmocka_unit_test(every_scene_gets_the_least_row_that_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
