/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies, their forces with their origin, and states for comparisons, as fbd_view.h gives them.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "fbd_view.h"
#include "scenes.h"

static const char crate[] = "fbd: 1\n"
                            "bodies:\n"
                            "  crate:\n"
                            "    mass: 2 kg\n"
                            "    motion: {slide: {along: 30 deg}}\n"
                            "    initial: {v: 1 m/s}\n"
                            "    forces:\n"
                            "      - gravity\n"
                            "      - normal\n"
                            "      - friction: {static: 0.4, kinetic: 0.3}\n"
                            "      - applied: {name: push, value: 5 N}\n"
                            "simulate: {until: 1 s}\n";

static const char arm[] = "fbd: 1\n"
                          "bodies:\n"
                          "  arm:\n"
                          "    mass: 3 kg\n"
                          "    inertia: 0.5 kg*m^2\n"
                          "    center: [0.4, 0]\n"
                          "    motion: {pivot: {at: [1, 2]}}\n"
                          "    initial: {theta: 90 deg}\n"
                          "    forces: [gravity]\n"
                          "simulate: {until: 1 s}\n";

static void a_body_has_its_entries_and_its_motion(void **context)
{
    (void)context;
    fbd_model *model = model_from(crate);
    const fbd_body body = fbd_model_body(model, 0);
    assert_string_equal(body.name, "crate");
    assert_int_equal(body.motion, FBD_MOTION_SLIDE);
    assert_int_equal(body.coordinate_count, 1);
    assert_int_equal(body.listed, 4);
    assert_true(body.most_forces >= 4 && body.friction);
    assert_true(body.inertia.mass == 2);
    assert_int_equal(body.line, 3);
    assert_int_equal(body.motion_line, 5);
    assert_string_equal(fbd_model_scene(model).units, "SI");
    assert_true(fbd_model_scene(model).gravity[1] == -9.81);
    fbd_model_free(model);
}

static void a_body_has_its_stops(void **context)
{
    (void)context;
    static const char stopped[] =
        "fbd: 1\n"
        "parameters: {a: 0.5 m}\n"
        "bodies:\n"
        "  free: {mass: 1 kg, motion: slide, forces: [gravity, normal]}\n"
        "  cart: {mass: 1 kg, motion: {slide: {min: -2*a}}, forces: [gravity, normal]}\n"
        "  lever: {mass: 1 kg, inertia: 1 kg*m^2, motion: {pivot: {max: 90 deg}}}\n"
        "simulate: {until: 1 s}\n";
    fbd_model *model = model_from(stopped);
    const fbd_body none = fbd_model_body(model, 0), cart = fbd_model_body(model, 1),
                   lever = fbd_model_body(model, 2);
    assert_true(isnan(none.stops[0]) && isnan(none.stops[1]));
    assert_true(cart.stops[0] == -1 && isnan(cart.stops[1]));
    assert_true(isnan(lever.stops[0]) && fabs(lever.stops[1] - acos(0)) < 1e-15);
    assert_true(isnan(fbd_model_body(model, 3).stops[0]));
    fbd_model_free(model);
}

static void forces_have_their_laws(void **context)
{
    (void)context;
    fbd_model *model = model_from(crate);
    fbd_state *state = fbd_state_new_start(model);
    fbd_listed_force forces[8];
    fbd_arrow arrows[8];
    static const char *const laws[] = {"gravity", "normal", "friction", "applied"};
    assert_int_equal(fbd_state_forces(state, 0, forces, 8), fbd_diagram(state, 0, arrows, 8));
    for (size_t i = 0; i < 4; i++) {
        assert_string_equal(forces[i].law, laws[i]);
        assert_int_equal(forces[i].line, 8 + i);
        assert_true(forces[i].arrow.fx == arrows[i].fx && forces[i].arrow.y == arrows[i].y);
    }
    assert_true(!forces[0].reaction && forces[1].reaction && forces[2].reaction && !forces[3].reaction);
    assert_true(forces[2].mu_s == 0.4 && forces[2].mu_k == 0.3 && forces[3].size == 5);
    assert_true(isnan(forces[0].size) && !forces[3].moment);
    assert_string_equal(forces[1].side, "up");
    assert_true(fabs(forces[1].along[0] + 0.5) < 1e-12 && forces[1].along[1] > 0);
    assert_int_equal(fbd_state_slip(state, 0), 1);
    fbd_named_force normal;
    assert_true(fbd_state_named_force(state, 0, "N", &normal));
    assert_int_equal(normal.force, 1);
    assert_true(fabs(normal.value - hypot(arrows[1].fx, arrows[1].fy)) < 1e-12 && !normal.moment);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void a_pin_has_no_direction(void **context)
{
    (void)context;
    fbd_model *model = model_from(arm);
    fbd_state *state = fbd_state_new_start(model);
    fbd_listed_force forces[4];
    fbd_named_force pin;
    assert_int_equal(fbd_state_forces(state, 0, forces, 4), 2);
    assert_string_equal(forces[1].law, "");
    assert_true(forces[1].reaction && forces[1].free && !forces[1].couples && forces[1].contact < 0);
    assert_true(fbd_state_named_force(state, 0, "pin.y", &pin) && pin.value == forces[1].arrow.fy);
    const fbd_pose pose = fbd_state_pose(state, 0);
    assert_true(fabs(pose.G[0] - 1) < 1e-12 && fabs(pose.G[1] - 2.4) < 1e-12 && fabs(pose.sine - 1) < 1e-12);
    fbd_state_free(state);
    fbd_model_free(model);
}

/* Of a body on another one, right after its coordinates are set. */
static void a_pose_is_that_of_the_coordinates(void **context)
{
    (void)context;
    fbd_model *model = model_from("fbd: 1\n"
                                  "bodies:\n"
                                  "  upper: {mass: 1 kg, center: [1, 0], motion: {pivot: {at: [0, 0]}}}\n"
                                  "  lower:\n"
                                  "    mass: 1 kg\n"
                                  "    center: [0.5, 0]\n"
                                  "    motion: {pivot: {on: upper, at: [2, 0]}}\n"
                                  "simulate: {until: 1 s}\n");
    fbd_state *state = fbd_state_new(model);
    assert_true(fbd_state_set(state, "upper.theta", 1) && fbd_state_set(state, "lower.theta", 0.5));
    const fbd_pose pose = fbd_state_pose(state, 1);
    assert_true(fabs(pose.x - 2 * cos(1)) < 1e-12 && fabs(pose.y - 2 * sin(1)) < 1e-12);
    assert_true(fabs(pose.angle - 1.5) < 1e-12 && fabs(pose.cosine - cos(1.5)) < 1e-12);
    assert_true(fabs(pose.G[0] - 2 * cos(1) - 0.5 * cos(1.5)) < 1e-12);
    fbd_state_free(state);
    fbd_model_free(model);
}

/* A crate that is set to slip downwards does so before any other call. */
static void a_slip_is_that_of_the_rates(void **context)
{
    (void)context;
    fbd_model *model = model_from(crate);
    fbd_state *state = fbd_state_new(model);
    assert_int_equal(fbd_state_slip(state, 0), 1);
    assert_true(fbd_state_set(state, "crate.v", -2));
    assert_int_equal(fbd_state_slip(state, 0), -1);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void states_are_drawn_and_repeat(void **context)
{
    (void)context;
    fbd_model *model = model_from(arm);
    fbd_state *state = fbd_state_new(model);
    double first[3], again[3], theta, a;
    for (int k = 0; k < 2; k++) {
        fbd_sampler *sampler = fbd_sampler_new(model);
        for (int i = 0; i < 3; i++) {
            assert_true(fbd_sampler_draw(sampler, state, 4));
            assert_true(fbd_state_get(state, "arm.theta", k == 0 ? &first[i] : &again[i]));
        }
        assert_true(fbd_sampler_start(sampler, state, false) && fbd_state_get(state, "arm.theta", &theta));
        assert_true(fabs(theta - 1.5707963267948966) < 1e-12);
        assert_true(fbd_sampler_start(sampler, state, true) && fbd_state_get(state, "t", &theta) &&
                    theta > 0);
        fbd_sampler_free(sampler);
    }
    assert_memory_equal(first, again, sizeof first);
    assert_true(first[0] != first[1]);
    assert_true(fbd_state_settle(state));
    assert_int_equal(fbd_state_accelerations(state, &a, 1), 1);
    assert_true(fabs(a) < 1e-9); /* G is above the axis */
    fbd_state_free(state);
    fbd_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_has_its_entries_and_its_motion),
        cmocka_unit_test(a_body_has_its_stops),
        cmocka_unit_test(forces_have_their_laws),
        cmocka_unit_test(a_pin_has_no_direction),
        cmocka_unit_test(a_pose_is_that_of_the_coordinates),
        cmocka_unit_test(a_slip_is_that_of_the_rates),
        cmocka_unit_test(states_are_drawn_and_repeat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
