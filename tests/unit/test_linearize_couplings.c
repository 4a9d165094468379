/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linearisation of scenes with couplings: against closed forms, and of random chains and loops that are written
 * twice, as bodies that move on each other and as bodies that are free but for pins.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <string.h>

#include "fbd_study.h"
#include "looked.h"
#include "random_numbers.h"
#include "thorough.h"

static const double g = 9.81;

static void assert_linear(const struct looked *looked)
{
    if (!looked->linear) print_error("%s\n", fbd_errors_get(looked->errors, 0).message);
    assert_non_null(looked->linear);
}

static void assert_refused(const char *text, const char *id, const char *words)
{
    struct looked looked = look(text);
    assert_null(looked.linear);
    const fbd_error error = fbd_errors_get(looked.errors, 0);
    assert_string_equal(error.id, id);
    if (!strstr(error.message, words)) print_error("%s\n", error.message);
    assert_non_null(strstr(error.message, words));
    end_look(&looked);
}

static void assert_close(double got, double want, double tolerance)
{
    if (fabs(got - want) <= tolerance) return;
    fail_msg("%.15g, expected %.15g, off by %.3g of %.3g", got, want, fabs(got - want), tolerance);
}

/* One degree of freedom, w0 and the damping ratio. */
static void assert_one_mode(const char *text, double w0, double zeta)
{
    struct looked looked = look(text);
    assert_linear(&looked);
    assert_int_equal(fbd_linearization_size(looked.linear), 2);
    fbd_mode mode = fbd_linearization_mode(looked.linear, 0);
    assert_close(mode.frequency, w0, 1e-10 * w0);
    assert_close(mode.damping_ratio, zeta, 1e-10);
    assert_true(fbd_linearization_coordinate(looked.linear, 0) < fbd_model_coordinate_count(looked.model));
    assert_true(fbd_linearization_coordinate(looked.linear, 1) == (size_t)-1);
    end_look(&looked);
}

/* A beam of 3 kg on three rods of 1 kg and 0.8 m, of which one is redundant: it hangs level, and its points move
 * on circles. w0^2 = g (M + 3 m/2) / (L (M + 3 m/3)). */
static void a_swing_on_three_rods(void **unused)
{
    (void)unused;
    char text[1600];
    int length = snprintf(text, sizeof text, "fbd: 1\nbodies:\n");
    for (int i = 0; i < 3; i++)
        length +=
            snprintf(text + length, sizeof text - (size_t)length,
                     "  rod%d: {shape: rod, mass: 1 kg, from: [0, 0], to: [0, -0.8 m], motion: {pivot: {at: "
                     "[%d, 0]}}, initial: {theta: 0.3}, forces: [gravity]}\n",
                     i, i);
    snprintf(
        text + length, sizeof text - (size_t)length,
        "  beam: {shape: rod, mass: 3 kg, length: 2 m, motion: planar, initial: {x: 1.2, y: -0.7, assemble: "
        "true}, "
        "forces: [gravity]}\ncouplings:\n  - pin: {between: [rod0.right, beam.left]}\n  - pin: {between: "
        "[rod1.right, beam.G]}\n  - pin: {between: [rod2.right, beam.right]}\n");
    assert_one_mode(text, sqrt(g / 0.8 * (3 + 1.5) / (3 + 1)), 0);
}

/* What rolls has the inertia m + I/R^2, by a condition or by friction that holds. */
static void a_wheel_on_a_spring(void **unused)
{
    static const char *const rolls[] = {"", ", static: 0.5, kinetic: 0.4"};
    const double k = 50, c = 3, m = 2 * 1.5;
    (void)unused;
    for (int i = 0; i < 2; i++) {
        char text[800];
        snprintf(
            text, sizeof text,
            "fbd: 1\nground: {lines: {floor: {along: 0 deg}}, points: {wall: [-1, 0.2 m]}}\nbodies:\n  "
            "wheel: "
            "{shape: disc, radius: 0.2 m, mass: 2 kg, motion: planar, initial: {x: 0.1, y: 0.2}, forces: "
            "[gravity]}\ncouplings:\n  - roll: {body: wheel, on: floor%s}\n  - spring: {between: [wheel, "
            "ground.wall], stiffness: 50 N/m, free_length: 1 m}\n  - damper: {between: [wheel, ground.wall], "
            "coefficient: 3 N*s/m}\n",
            rolls[i]);
        assert_one_mode(text, sqrt(k / m), c / (2 * sqrt(k * m)));
    }
}

/* Two weights on a rope over a pulley, one on a spring to the floor: k / (m_1 + m_2 + I/R^2). */
static void weights_on_a_rope(void **unused)
{
    (void)unused;
    assert_one_mode(
        "fbd: 1\nground: {points: {floor: [0.2, -3]}}\nbodies:\n  pulley: {mass: 1 kg, shape: disc, radius: "
        "0.2 m, motion: {pivot: {at: [0, 0]}}}\n  a: {mass: 3 kg, motion: {slide: {along: -90 deg, "
        "through: [-0.2, -1]}}, forces: [gravity]}\n  b: {mass: 2 kg, motion: {slide: {along: -90 deg, "
        "through: [0.2, -1]}}, forces: [gravity]}\ncouplings:\n  - rope: {through: [a, pulley, b]}\n"
        "  - spring: {between: [b, ground.floor], stiffness: 80 N/m, free_length: 2 m}\n",
        sqrt(80 / 5.5), 0);
}

/* Stops that are open, and a cubic force beside a coupling, are as they are without couplings. */
static void open_stops_and_dying_slopes(void **unused)
{
    (void)unused;
    assert_one_mode(
        "fbd: 1\nbodies:\n  p: {shape: rod, mass: 1 kg, length: 2 m, motion: {pivot: {point: left, min: -150 "
        "deg, max: -30 deg}}, initial: {theta: -80 deg}, forces: [gravity]}\n",
        sqrt(1.5 * g / 2), 0);
    struct looked looked = look("fbd: 1\nbodies:\n  a: {mass: 1 kg, motion: slide, initial: {x: 0.1 m}, "
                                "forces: [applied: {name: pull, "
                                "value: \"-4[N/m^3]*x^3\"}]}\n  wheel: {mass: 1 kg, shape: disc, radius: 0.1 "
                                "m, motion: {pivot: {at: [0, 0.1]}}}\n"
                                "couplings:\n  - rack: {between: [wheel, a], radius: 0.1 m}\n");
    assert_linear(&looked);
    assert_string_equal(fbd_errors_get(looked.errors, 0).id, "degenerate-equilibrium");
    assert_true(fbd_linearization_mode(looked.linear, 0).frequency == 0);
    end_look(&looked);
}

/* Where to one side it goes another way than to the other there is no linear motion; nor where nothing can move. */
static void what_has_no_linear_motion_is_refused(void **unused)
{
    (void)unused;
    assert_refused(
        "fbd: 1\nbodies:\n  a: {mass: 1 kg, motion: slide, initial: {x: 1 m}, forces: [spring: {stiffness: 9 "
        "N/m, free_length: 1 m, to: [0, 0]}]}\nground: {points: {O: [0, 0]}}\ncouplings:\n  - rope: {name: "
        "leash, through: [a, ground.O]}\n",
        "at-limit", "`leash` is at the limit");
    assert_refused(
        "fbd: 1\nbodies:\n  a: {shape: rod, mass: 1 kg, length: 1 m, motion: {pivot: {point: left}}, forces: "
        "[gravity]}\nground: {points: {P: [0.5, 1]}}\ncouplings:\n  - rod: {name: stay, between: [a.right, "
        "ground.P]}\n",
        "sticks", "nothing can move");
    assert_refused("fbd: 1\nbodies:\n  a: {mass: 1 kg, motion: {slide: {x: \"1[m]*sin(1[1/s]*t)\"}}}\n",
                   "not-independent", "prescribed");
}

/* ---- the same scene written twice */

enum { most_rods = 4, room = 6000 };

struct chain {
    int count;
    bool loop; /* the end of the last rod is pinned to the ground */
    double length[most_rods], mass[most_rods], angle[most_rods]; /* of the rod, from the downward vertical */
    double stiffness[most_rods], damping[most_rods], anchor[most_rods][2];
};

struct place {
    double x, y;
};

static struct place end_of(const struct chain *chain, int rods)
{
    struct place end = {0, 0};
    for (int i = 0; i < rods; i++) {
        end.x += chain->length[i] * sin(chain->angle[i]);
        end.y -= chain->length[i] * cos(chain->angle[i]);
    }
    return end;
}

static void draw_chain(struct random_numbers *numbers, struct chain *chain, bool loop)
{
    *chain = (struct chain){.count = 2 + (int)(random_bits(numbers) % (most_rods - 1)), .loop = loop};
    if (loop && chain->count < 3) chain->count = 3;
    for (int i = 0; i < chain->count; i++) {
        chain->length[i] = random_between(numbers, 0.5, 1.5);
        chain->mass[i] = random_between(numbers, 0.5, 3);
        chain->angle[i] = loop ? -0.6 + 1.8 * i / (chain->count - 1) + random_between(numbers, -0.1, 0.1)
                               : random_between(numbers, -0.2, 0.2);
        chain->stiffness[i] = random_between(numbers, 0, 20);
        chain->damping[i] = random_between(numbers, 0, 2);
        for (int k = 0; k < 2; k++) chain->anchor[i][k] = random_between(numbers, -3, 3);
    }
}

static void write_bodies(const struct chain *chain, bool free_bodies, char *text)
{
    int length = snprintf(text, room, "fbd: 1\nbodies:\n");
    for (int i = 0; i < chain->count; i++) {
        struct place from = end_of(chain, i), to = end_of(chain, i + 1);
        double before = i > 0 && !free_bodies ? chain->angle[i - 1] : 0;
        length += snprintf(text + length, (size_t)(room - length),
                           "  rod%d: {shape: rod, mass: %.17g, length: %.17g, forces: [gravity], motion: ", i,
                           chain->mass[i], chain->length[i]);
        if (free_bodies)
            length +=
                snprintf(text + length, (size_t)(room - length), "planar, initial: {x: %.17g, y: %.17g, ",
                         (from.x + to.x) / 2, (from.y + to.y) / 2);
        else if (i == 0)
            length += snprintf(text + length, (size_t)(room - length), "{pivot: {point: left}}, initial: {");
        else
            length += snprintf(text + length, (size_t)(room - length),
                               "{pivot: {on: rod%d, at: right, point: left}}, initial: {", i - 1);
        length += snprintf(text + length, (size_t)(room - length), "theta: %.17g rad}}\n",
                           chain->angle[i] - before - (free_bodies || i == 0 ? acos(-1) / 2 : 0));
    }
}

static void write_couplings(const struct chain *chain, bool free_bodies, char *text)
{
    struct place end = end_of(chain, chain->count);
    int length = (int)strlen(text);
    length += snprintf(text + length, (size_t)(room - length),
                       "ground:\n  points:\n    O: [0, 0]\n    E: [%.17g, %.17g]\n", end.x, end.y);
    for (int i = 0; i < chain->count; i++)
        length += snprintf(text + length, (size_t)(room - length), "    A%d: [%.17g, %.17g]\n", i,
                           chain->anchor[i][0], chain->anchor[i][1]);
    length += snprintf(text + length, (size_t)(room - length), "couplings:\n");
    for (int i = 0; i < chain->count; i++)
        length += snprintf(
            text + length, (size_t)(room - length),
            "  - spring: {between: [rod%d, ground.A%d], stiffness: %.17g}\n  - damper: {between: [rod%d, "
            "ground.A%d], coefficient: %.17g}\n",
            i, i, chain->stiffness[i], i, i, chain->damping[i]);
    for (int i = 0; free_bodies && i < chain->count; i++)
        length += i == 0 ? snprintf(text + length, (size_t)(room - length),
                                    "  - pin: {between: [rod0.left, ground.O]}\n")
                         : snprintf(text + length, (size_t)(room - length),
                                    "  - pin: {between: [rod%d.left, rod%d.right]}\n", i, i - 1);
    if (chain->loop)
        snprintf(text + length, (size_t)(room - length), "  - pin: {between: [rod%d.right, ground.E]}\n",
                 chain->count - 1);
}

static struct looked look_at_chain(const struct chain *chain, bool free_bodies)
{
    char *text = test_malloc(room);
    write_bodies(chain, free_bodies, text);
    write_couplings(chain, free_bodies, text);
    struct looked looked = look(text);
    if (!looked.linear) print_error("%s", text);
    test_free(text);
    return looked;
}

/* Both are to start where the chain balances: from elsewhere the nearest balance is not that of the same scene in
 * other coordinates. */
static void go_to_balance(struct chain *chain)
{
    char *text = test_malloc(room);
    write_bodies(chain, false, text);
    write_couplings(chain, false, text);
    fbd_model *model = model_from(text);
    fbd_state *state = fbd_state_new(model);
    assert_true(fbd_find_equilibrium(state, NULL));
    double angle = acos(-1) / 2;
    for (int i = 0; i < chain->count; i++) {
        char name[20];
        double theta = NAN;
        snprintf(name, sizeof name, "rod%d.theta", i);
        assert_true(fbd_state_get(state, name, &theta));
        chain->angle[i] = angle += theta;
    }
    fbd_state_free(state);
    fbd_model_free(model);
    test_free(text);
}

static void written_twice(bool loop)
{
    struct random_numbers numbers = {loop ? 5 : 4};
    for (int trial = 0; trial < draws_of(30); trial++) {
        struct chain chain;
        draw_chain(&numbers, &chain, loop);
        go_to_balance(&chain);
        struct looked on = look_at_chain(&chain, false), pinned = look_at_chain(&chain, true);
        assert_linear(&on);
        assert_linear(&pinned);
        size_t size = fbd_linearization_size(on.linear);
        assert_int_equal(size, 2 * (size_t)(chain.count - (loop ? 2 : 0)));
        assert_int_equal(fbd_linearization_size(pinned.linear), size);
        double most = 0;
        for (size_t i = 0; i < size; i++) most = fmax(most, fbd_linearization_mode(on.linear, i).frequency);
        for (size_t i = 0; i < size; i++) {
            fbd_mode a = fbd_linearization_mode(on.linear, i), b = fbd_linearization_mode(pinned.linear, i);
            assert_close(b.re, a.re, 1e-8 * most);
            assert_close(b.im, a.im, 1e-8 * most);
        }
        end_look(&on);
        end_look(&pinned);
    }
}

static void chains_of_free_rods_are_chains(void **unused)
{
    (void)unused;
    written_twice(false);
}

static void loops_of_free_rods_are_loops(void **unused)
{
    (void)unused;
    written_twice(true);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_swing_on_three_rods),
        cmocka_unit_test(a_wheel_on_a_spring),
        cmocka_unit_test(weights_on_a_rope),
        cmocka_unit_test(open_stops_and_dying_slopes),
        cmocka_unit_test(what_has_no_linear_motion_is_refused),
        cmocka_unit_test(chains_of_free_rods_are_chains),
        cmocka_unit_test(loops_of_free_rods_are_loops),
    };
    return cmocka_run_group_tests_name("linearize couplings", tests, NULL, NULL);
}
