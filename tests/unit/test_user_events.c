/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A user event changes nothing but the log: with events or without, a run makes the same steps and ends in
 * the same bits, whatever the method, and stops to be looked at where an event is.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd.h"
#include "fbd_view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scenes.h"
#include "thorough.h"

enum { text_size = 4000, most_values = 8 };

static const char *const methods[] = {"auto",    "dop853",  "rk8pd", "rkf45", "rk4",    "rk2",
                                      "rodas5p", "msadams", "msbdf", "bsimp", "rk4imp", "rk2imp"};

struct eventful {
    const char *name, *values, *bodies, *until, *events;
    size_t more; /* events than without */
};

static const struct eventful scenes[] = {
    {"two groups, one of parabolas", "b.x b.vy p.theta p.omega",
     "  b: {mass: 1, motion: particle, initial: {vx: 1, vy: 9}, forces: [gravity]}\n"
     "  p: {shape: rod, mass: 1, length: 1, motion: {pivot: {at: [0, 0], point: left}}, forces: [gravity]}\n",
     "3", "top: b.vy = 0; flat: p.theta = -90 deg; one: \"t > 0.7\"", 5},
    {"a linear oscillator", "b.x b.v",
     "  b: {mass: 1, motion: slide, initial: {x: 1}, forces: [spring: {stiffness: 40}, damper: 0.1]}\n", "4",
     "zero: b.x = 0; turn: b.v = 0; kinetic: \"0.5[kg]*b.v^2 = 3[J]\"", 32},
    {"a block that sticks and slips", "b.x b.v",
     "  b: {mass: 1, motion: slide, initial: {x: 0.3}, forces: [gravity, normal, friction: {static: 0.4, "
     "kinetic: 0.3}, spring: {stiffness: 30}, applied: {name: u, value: \"6[N]*sin(3[rad/s]*t)\"}]}\n",
     "6", "middle: b.x = 0; work: \"b.x^2 = 0.01[m^2]\"", 15},
    {"a double pendulum", "a.theta a.omega b.theta b.omega",
     "  a: {shape: rod, mass: 1, length: 1, motion: {pivot: {at: [0, 0], point: left}}, forces: [gravity]}\n"
     "  b: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: a, at: right, point: left}}, forces: "
     "[gravity]}\n",
     "4", "low: a.theta = -90 deg; level: b.right.y = 0; dense: \"sin(40*a.theta) = 0.999\"", 130},
    /* Passes positions where all bars are in one line. */
    {"four bars", "v0.theta v0.omega h0.theta v1.theta v1.omega",
     "  v0: {shape: rod, mass: 1, length: 1, motion: {pivot: {at: [0, 0], point: left}}, initial: {theta: 90 "
     "deg, omega: -1}, forces: [gravity]}\n"
     "  h0: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: v0, at: right, point: left}}, initial: "
     "{theta: -90 deg, omega: 1}, forces: [gravity]}\n"
     "  v1: {shape: rod, mass: 1, length: 1, motion: {pivot: {at: [1, 0], point: left}}, initial: {theta: 90 "
     "deg, omega: -1}, forces: [gravity]}\n"
     "couplings:\n  - pin: {name: B1, between: [h0.right, v1.right]}\n",
     "4", "flat: v0.right.y = 0; turn: v0.theta = -270 deg", 5},
    /* The same by dynamics/closed_loops.h, whose dependent coordinates change there. */
    {"two windows of bars", "v0.theta v0.omega h0.theta v1.theta h1.theta v2.theta v2.omega",
     "  v0: {shape: rod, mass: 1, length: 1, motion: {pivot: {at: [0, 0], point: left}}, initial: {theta: 90 "
     "deg, omega: -1}, forces: [gravity]}\n"
     "  h0: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: v0, at: right, point: left}}, initial: "
     "{theta: -90 deg, omega: 1}, forces: [gravity]}\n"
     "  v1: {shape: rod, mass: 1, length: 1, motion: {pivot: {at: [1, 0], point: left}}, initial: {theta: 90 "
     "deg, omega: -1}, forces: [gravity]}\n"
     "  h1: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: v1, at: right, point: left}}, initial: "
     "{theta: -90 deg, omega: 1}, forces: [gravity]}\n"
     "  v2: {shape: rod, mass: 1, length: 1, motion: {pivot: {at: [2, 0], point: left}}, initial: {theta: 90 "
     "deg, omega: -1}, forces: [gravity]}\n"
     "couplings:\n  - pin: {name: p0, between: [h0.right, v1.right]}\n"
     "  - pin: {name: p1, between: [h1.right, v2.right]}\n",
     "6", "flat: v0.right.y = 0; many: sin(7*v0.theta) = 0.5", 48},
};

static void write_scene(const struct eventful *scene, bool events, char *text)
{
    int length =
        snprintf(text, text_size, "fbd: 1\nbodies:\n%ssimulate:\n  until: %s\n", scene->bodies, scene->until);
    if (!events) return;
    length += snprintf(text + length, text_size - (size_t)length, "  events:\n");
    for (const char *at = scene->events; *at;) {
        size_t name = strcspn(at, ":"), size = strcspn(at, ";");
        length += snprintf(text + length, text_size - (size_t)length, "    - {name: %.*s, when: %.*s}\n",
                           (int)name, at, (int)(size - name - 1), at + name + 1);
        at += size + (at[size] == ';');
        at += strspn(at, " ");
    }
}

/* What a run ends with. */
struct ending {
    double t, y[most_values];
    size_t events;
    fbd_outcome outcome;
};

/* A run that is carried on step by step stops at each event. */
static void advance(fbd_simulation *simulation)
{
    size_t told = fbd_simulation_event_count(simulation);
    while (fbd_simulation_advance(simulation) == FBD_GOING) {
        double t;
        fbd_simulation_interval(simulation, NULL, &t);
        for (; told < fbd_simulation_event_count(simulation); told++)
            assert_true(fbd_simulation_event(simulation, told).t == t);
    }
}

static struct ending run(const struct eventful *scene, bool events, const char *method, bool stepwise)
{
    char text[text_size], name[32];
    write_scene(scene, events, text);
    fbd_model *model = model_from(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = method;
    options.tolerance = 1e-7;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    assert_non_null(simulation);
    fbd_state *state = fbd_state_new(model);
    fbd_recording recording = {0};
    if (stepwise)
        advance(simulation);
    else
        fbd_result_free(fbd_simulation_run(simulation, &recording));
    struct ending ending = {.events = fbd_simulation_event_count(simulation),
                            .outcome = fbd_simulation_advance(simulation)};
    fbd_simulation_interval(simulation, NULL, &ending.t);
    assert_true(fbd_simulation_state(simulation, ending.t, state));
    const char *at = scene->values;
    for (size_t k = 0, size; *at; k++, at += size + (at[size] == ' ')) {
        size = strcspn(at, " ");
        snprintf(name, sizeof name, "%.*s", (int)size, at);
        assert_true(k < most_values && fbd_state_get(state, name, &ending.y[k]));
    }
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return ending;
}

static void nothing_changes_but_the_log(void **unused)
{
    (void)unused;
    size_t wrong = 0;
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++)
        for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
            if (!is_in_turn(m, k)) continue;
            struct ending with = run(&scenes[k], true, methods[m], false);
            struct ending step = run(&scenes[k], true, methods[m], true);
            struct ending without = run(&scenes[k], false, methods[m], false);
            bool same = with.t == without.t && with.outcome == without.outcome &&
                        memcmp(with.y, without.y, sizeof with.y) == 0 &&
                        memcmp(with.y, step.y, sizeof with.y) == 0 && with.events == step.events;
            if (same && with.events == without.events + scenes[k].more) continue;
            wrong++;
            print_error("%s, %s: %zu and %zu events; ends at %.17g with %.17g instead of %.17g\n",
                        scenes[k].name, methods[m], with.events, without.events, with.t, with.y[0],
                        without.y[0]);
        }
    assert_int_equal(wrong, 0);
}

/* The coordinates at the end of a run that is carried on from a state for 2 s. */
static void end_of(const fbd_state *from, double y[most_values])
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    double t;
    assert_true(fbd_state_get(from, "t", &t));
    options.until = t + 2;
    fbd_simulation *simulation = fbd_simulation_from(from, &options, NULL);
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    assert_int_equal(fbd_result_outcome(result), FBD_DONE);
    const fbd_state *end = fbd_result_state(result);
    static const char *const names[] = {"v0.theta", "v0.omega", "h0.theta", "v1.theta",
                                        "h1.theta", "v2.theta", "v2.omega"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        assert_true(fbd_state_get(end, names[k], &y[k]));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
}

/* In the middle of a motion with closed loops, after the singular positions, a state, its copy and its pack, unpacked,
 * go on alike. */
static void copies_of_closed_loops_go_on_alike(void **unused)
{
    (void)unused;
    char text[text_size];
    write_scene(&scenes[sizeof scenes / sizeof *scenes - 1], false, text);
    fbd_model *model = model_from(text);
    fbd_simulation *simulation = fbd_simulation_new(model, NULL, NULL);
    fbd_state *state = fbd_state_new(model), *copy = fbd_state_new(model), *unpacked = fbd_state_new(model);
    fbd_outcome outcome = FBD_GOING;
    double t = 0, y[3][most_values] = {{0}}, numbers[100];
    while (outcome == FBD_GOING && t < 3) {
        outcome = fbd_simulation_advance(simulation);
        fbd_simulation_interval(simulation, NULL, &t);
    }
    assert_true(fbd_simulation_state(simulation, t, state));
    assert_true(fbd_state_copy(copy, state));
    const size_t count = fbd_state_pack(state, numbers, sizeof numbers / sizeof *numbers);
    assert_true(count <= sizeof numbers / sizeof *numbers && fbd_state_unpack(unpacked, numbers, count));
    end_of(state, y[0]);
    end_of(copy, y[1]);
    end_of(unpacked, y[2]);
    assert_memory_equal(y[0], y[1], sizeof y[0]);
    assert_memory_equal(y[0], y[2], sizeof y[0]);
    fbd_state_free(unpacked);
    fbd_state_free(copy);
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

/* One step of a body that nothing pushes has 31,830 zeros of sin(10^5 x). */
static void thousands_in_a_step_are_told(void **unused)
{
    (void)unused;
    fbd_model *model =
        model_from("fbd: 1\ngravity: 0\nbodies: {p: {mass: 1, motion: slide, initial: {v: 1}}}\n"
                   "simulate: {until: 1, events: [{name: tick, when: \"sin(1e5*x) = 0\"}]}\n");
    fbd_simulation *simulation = fbd_simulation_new(model, NULL, NULL);
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    const size_t count = fbd_simulation_event_count(simulation);
    assert_int_equal(fbd_result_outcome(result), FBD_DONE);
    assert_int_equal(count, (size_t)(1e5 / acos(-1)));
    for (size_t i = 0; i < count; i++)
        assert_true(fabs(fbd_simulation_event(simulation, i).t - acos(-1) * (double)(i + 1) / 1e5) < 1e-15);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

/* Forces of 1e118 N, which an implicit method cannot follow: where it is in the middle of a step changes with how far the step
 * goes, and events among each other had no end in one. */
static void a_method_at_a_loss_comes_to_its_end(void **unused)
{
    (void)unused;
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = "rk4imp";
    options.tolerance = 1e-12;
    fbd_model *model =
        model_from("fbd: 1\nparameters: {k: 360 deg N/m, k3: 1e100 N/m^3}\nbodies:\n  p:\n    mass: 4.296\n  "
                   "  motion: {slide: {along: 0.5 deg}}\n    "
                   "initial: {x: 1e6}\n"
                   "    forces: [potential: {name: spring, V: \"k*x^3/2 + k3*x^4/4\"}]\n"
                   "simulate: {until: 10, events: [{name: middle, when: \"x = 0\", direction: falling}, "
                   "{name: period, when: "
                   "\"v = 0\", direction: falling}]}\n");
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    assert_int_equal(fbd_result_outcome(result), FBD_FAILED);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_changes_but_the_log),
        cmocka_unit_test(copies_of_closed_loops_go_on_alike),
        cmocka_unit_test(thousands_in_a_step_are_told),
        cmocka_unit_test(a_method_at_a_loss_comes_to_its_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
