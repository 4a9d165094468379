/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Views of a scene for drawings, against closed forms: shapes and tracks in body coordinates, poses, forces
 * with their symbols, springs and couplings where they act.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "fbd_view.h"
#include "scenes.h"

static const double pi = 3.141592653589793;

static void near(double value, double wanted)
{
    if (!(fabs(value - wanted) <= 1e-12 * (1 + fabs(wanted)))) fail_msg("%.17g is not %.17g", value, wanted);
}

static void near_point(const double point[static 2], double x, double y)
{
    near(point[0], x);
    near(point[1], y);
}

/* ---- bodies */

static const char block[] = "fbd: 1\n"
                            "bodies:\n"
                            "  block:\n"
                            "    mass: 2 kg\n"
                            "    shape: prism\n"
                            "    a: 0.4 m\n"
                            "    b: 0.2 m\n"
                            "    motion: {slide: {along: 30 deg}}\n"
                            "    initial: {x: 0.5 m, v: 1 m/s}\n"
                            "    forces: [gravity, normal, friction: {static: 0.3, kinetic: 0.2}]\n"
                            "  arm:\n"
                            "    mass: 3 kg\n"
                            "    shape: rod\n"
                            "    length: 2 m\n"
                            "    motion: {pivot: {at: [1, 2], point: left}}\n"
                            "    initial: {theta: 90 deg}\n"
                            "    forces: [gravity]\n"
                            "simulate: {until: 1 s}\n";

static void bodies_and_shapes_are_those_of_the_file(void **unused)
{
    (void)unused;
    fbd_model *model = model_from(block);
    const fbd_body slide = fbd_model_body(model, 0), pivot = fbd_model_body(model, 1);
    assert_string_equal(fbd_model_units(model).inertia, "kg*m^2");
    assert_string_equal(slide.name, "block");
    assert_true(slide.motion == FBD_MOTION_SLIDE && slide.carrier == FBD_GROUND && slide.angle == -1);
    assert_true(slide.surface && !slide.two_sided);
    near_point(slide.along, cos(pi / 6), sin(pi / 6));
    near_point(slide.normal, -sin(pi / 6), cos(pi / 6));
    assert_true(pivot.motion == FBD_MOTION_PIVOT && pivot.coordinate == 1 && pivot.angle == 1);
    near_point(pivot.joint, 1, 2);
    near_point(pivot.pin, -1, 0);
    assert_int_equal(fbd_model_shape_count(model, 0), 1);
    const fbd_shape prism = fbd_model_shape(model, 0, 0), rod = fbd_model_shape(model, 1, 0);
    assert_true(prism.kind == FBD_SHAPE_POLYGON && prism.corner_count == 4 && !prism.hole);
    near_point(prism.corners[0], 0.2, 0.1);
    near_point(prism.corners[2], -0.2, -0.1);
    assert_true(rod.kind == FBD_SHAPE_BAR && rod.corner_count == 2);
    near_point(rod.corners[0], -1, 0);
    near(fbd_model_extent(model, 0, (double[]){0.05, 0}, (double[]){1, 0}), 0.15);
    near(fbd_model_extent(model, 0, (double[]){0, 0}, (double[]){0.6, 0.8}), 0.2 * 0.6 + 0.1 * 0.8);
    near(fbd_model_extent(model, 1, (double[]){-1, 0}, (double[]){-1, 0}), 0);
    assert_string_equal(fbd_model_point(model, 1, 0).name, "left");
    near(fbd_model_point(model, 1, 0).x, -1);
    assert_true(isnan(fbd_model_track(model, 0).length));
    fbd_model_free(model);
}

static void a_view_has_poses_and_forces_with_symbols(void **unused)
{
    (void)unused;
    fbd_model *model = model_from(block);
    fbd_state *state = fbd_state_new(model);
    fbd_view *view = fbd_view_new(state, NULL);
    assert_non_null(view);
    fbd_state_set(state, "block.x", 9); /* the view stays */
    const fbd_pose slide = fbd_view_pose(view, 0), pivot = fbd_view_pose(view, 1);
    near(slide.x, 0.5 * cos(pi / 6));
    near(slide.y, 0.5 * sin(pi / 6));
    near(slide.angle, pi / 6);
    near_point(slide.normal, -sin(pi / 6), cos(pi / 6));
    near(pivot.x, 1);
    near(pivot.cosine, 0);
    near(pivot.sine, 1);
    assert_string_equal(fbd_view_mass(view, 0).printed, "m₁");
    near(fbd_view_mass(view, 1).I_O, 3 * 4.0 / 3);

    const double g = 9.81, N = 2 * g * cos(pi / 6);
    assert_int_equal(fbd_view_force_count(view, 0), 3);
    const fbd_force weight = fbd_view_force(view, 0, 0), normal = fbd_view_force(view, 0, 1),
                    friction = fbd_view_force(view, 0, 2);
    assert_string_equal(weight.kind, "gravity");
    assert_string_equal(weight.symbol, "m_1 g");
    assert_string_equal(weight.printed, "m₁g");
    assert_int_equal(weight.slide, -1);
    near(weight.arrow.fy, -2 * g);
    assert_string_equal(normal.kind, "reaction");
    assert_true(normal.slide == 0 && normal.normal);
    near(hypot(normal.arrow.fx, normal.arrow.fy), N);
    assert_string_equal(friction.kind, "friction");
    assert_string_equal(friction.symbol, "mu_k N");
    assert_string_equal(friction.printed, "μₖN");
    assert_true(friction.slide == 0 && !friction.normal && !friction.moment);
    near(hypot(friction.arrow.fx, friction.arrow.fy), 0.2 * N);
    fbd_view_free(view);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void a_track_is_a_curve_by_its_length(void **unused)
{
    (void)unused;
    fbd_model *model = model_from(
        "fbd: 1\n"
        "bodies:\n"
        "  bead:\n"
        "    mass: 1 kg\n"
        "    motion: {track: {x: '2[m]*cos(p)', y: '2[m]*sin(p)', from: 0, to: 360 deg, closed: true}}\n"
        "    forces: [gravity]\n"
        "simulate: {until: 1 s}\n");
    const fbd_track track = fbd_model_track(model, 0);
    near(track.start, 0);
    near(track.length, 4 * pi);
    assert_true(track.closed);
    const fbd_track_place top = fbd_model_track_place(model, 0, pi);
    assert_true(fabs(top.x) < 1e-12);
    near(top.y, 2);
    near_point(top.tangent, -1, 0);
    near(top.curvature, 0.5);
    assert_true(isnan(fbd_model_track_place(model, 0, NAN).x));
    fbd_model_free(model);
}

/* ---- between bodies */

static void couplings_and_springs_have_their_ends(void **unused)
{
    (void)unused;
    fbd_model *model =
        model_from("fbd: 1\n"
                   "ground:\n"
                   "  points: {hook: [0, 3]}\n"
                   "bodies:\n"
                   "  ball:\n"
                   "    mass: 1 kg\n"
                   "    motion: particle\n"
                   "    initial: {x: 3 m, y: -1 m}\n"
                   "    forces: [gravity]\n"
                   "couplings:\n"
                   "  - spring: {name: soft, between: [ball.G, ground.hook], stiffness: 2 N/m}\n"
                   "  - rod: {name: bar, between: [ball.G, ground.hook]}\n"
                   "simulate: {until: 1 s}\n");
    fbd_state *state = fbd_state_new(model);
    fbd_view *view = fbd_view_new(state, NULL);
    assert_non_null(view);
    assert_int_equal(fbd_view_spring_count(view), 1);
    const fbd_spring spring = fbd_view_spring(view, 0);
    assert_string_equal(spring.name, "soft");
    assert_true(!spring.damper && spring.body == 0 && spring.partner == FBD_GROUND);
    near_point(spring.anchor, 0, 3);
    assert_int_equal(fbd_view_coupling_count(view), 1);
    const fbd_coupling rod = fbd_view_coupling(view, 0);
    assert_string_equal(rod.kind, "rod");
    assert_string_equal(rod.name, "bar");
    assert_true(rod.pulls && !rod.lined && rod.end_count == 2);
    near(rod.length, 5);
    const fbd_coupling_end ball = fbd_view_coupling_end(view, 0, 0), hook = fbd_view_coupling_end(view, 0, 1);
    assert_true(ball.body == 0 && hook.body == FBD_GROUND && !hook.force);
    assert_string_equal(ball.force, "bar");
    near_point(hook.point, 0, 3);
    assert_int_equal(ball.place_count, 1);
    near_point(ball.places[0], 3, -1);
    fbd_view_free(view);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void a_rolling_disc_touches_its_line(void **unused)
{
    (void)unused;
    fbd_model *model = model_from("fbd: 1\n"
                                  "ground:\n"
                                  "  lines: {floor: {along: 0}}\n"
                                  "bodies:\n"
                                  "  disc:\n"
                                  "    mass: 1 kg\n"
                                  "    shape: disc\n"
                                  "    radius: 0.5 m\n"
                                  "    motion: planar\n"
                                  "    initial: {x: 2 m, y: 0.5 m}\n"
                                  "    forces: [gravity]\n"
                                  "couplings:\n"
                                  "  - roll: {name: tread, body: disc, on: floor}\n"
                                  "simulate: {until: 1 s}\n");
    fbd_state *state = fbd_state_new(model);
    fbd_view *view = fbd_view_new(state, NULL);
    assert_non_null(view);
    const fbd_coupling roll = fbd_view_coupling(view, 0);
    assert_true(roll.lined && !roll.pulls && roll.side == 1);
    near(roll.angle, 0);
    const fbd_coupling_end end = fbd_view_coupling_end(view, 0, 0);
    near(end.radius, 0.5);
    assert_int_equal(end.place_count, 1);
    near_point(end.places[0], 2, 0);
    assert_string_equal(fbd_view_force(view, 0, 1).kind, "reaction");
    fbd_view_free(view);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void connections_have_their_lines(void **unused)
{
    (void)unused;
    fbd_model *model =
        model_from("fbd: 1\n"
                   "plane: horizontal\n"
                   "ground:\n"
                   "  polygons: {step: [[0, 0], [2, 0], [2, 1]]}\n"
                   "bodies:\n"
                   "  cam: {mass: 1 kg, inertia: 1 kg*m^2, motion: {pivot: {at: [5, 0]}}}\n"
                   "  pin: {mass: 1 kg, motion: particle, initial: {x: 7 m}}\n"
                   "  ball: {mass: 1 kg, motion: particle, initial: {x: -3 m}}\n"
                   "couplings:\n"
                   "  - slot: {between: [pin, cam], side: right, x: 2*cos(p), y: 2*sin(p), from: 0,"
                   " to: 360 deg, closed: true}\n"
                   "contacts: [{between: [ball, ground.step]}]\n"
                   "simulate: {until: 1 s}\n");
    double point[2];
    fbd_path path = fbd_model_path(model, 0);
    assert_true(path.closed && path.side == -1 && path.point_count > 2);
    assert_true(fbd_model_path_point(model, 0, 0, point));
    near_point(point, 2, 0); /* in the frame of the cam, by the length of the curve */
    assert_true(fbd_model_path_point(model, 0, path.point_count / 4, point));
    near_point(point, 0, 2);
    assert_false(fbd_model_path_point(model, 0, path.point_count, point));
    path = fbd_model_path(model, 1);
    assert_true(path.closed && path.side == 0 && path.point_count == 3);
    assert_true(fbd_model_path_point(model, 1, 2, point));
    near_point(point, 2, 1);
    near(fbd_model_scene(model).pressing, 9.81);
    fbd_model_free(model);
}

static void a_rope_round_a_bollard_touches_it_twice(void **unused)
{
    (void)unused;
    fbd_model *model = model_from(
        "fbd: 1\n"
        "ground: {points: {bollard: [0, 0]}}\n"
        "bodies:\n"
        "  left: {mass: 1 kg, motion: {slide: {along: 90 deg, through: [-0.1, -1]}}, forces: [gravity]}\n"
        "  right: {mass: 1 kg, motion: {slide: {along: 90 deg, through: [0.1, -1]}}, forces: [gravity]}\n"
        "couplings:\n"
        "  - rope: {through: [left, ground.bollard, right], around: {on: ground.bollard, radius: 0.1 m,"
        " static: 0.3}}\n"
        "simulate: {until: 1 s}\n");
    fbd_state *state = fbd_state_new(model);
    fbd_view *view = fbd_view_new(state, NULL);
    assert_non_null(view);
    assert_false(fbd_view_coupling(view, 0).lined);
    const fbd_coupling_end bollard = fbd_view_coupling_end(view, 0, 1);
    assert_int_equal(bollard.place_count, 2);
    near_point(bollard.places[0], -0.1, 0);
    near_point(bollard.places[1], 0.1, 0);
    for (size_t i = 0; i < fbd_view_force_count(view, 0); i++)
        assert_int_equal(fbd_view_force(view, 0, i).slide, -1); /* no surface under the body */
    fbd_view_free(view);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void a_state_that_is_not_finite_has_no_view(void **unused)
{
    (void)unused;
    fbd_model *model = model_from("fbd: 1\n"
                                  "bodies:\n"
                                  "  block:\n"
                                  "    mass: 1 kg\n"
                                  "    motion: {slide: {along: 0}}\n"
                                  "    forces: [applied: {name: pull, value: '1[N*m]/x'}]\n"
                                  "simulate: {until: 1 s}\n");
    fbd_errors *errors = fbd_errors_new();
    fbd_state *state = fbd_state_new(model);
    assert_null(fbd_view_new(state, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, "not-finite");
    fbd_state_free(state);
    fbd_errors_free(errors);
    fbd_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_and_shapes_are_those_of_the_file),
        cmocka_unit_test(a_view_has_poses_and_forces_with_symbols),
        cmocka_unit_test(a_track_is_a_curve_by_its_length),
        cmocka_unit_test(couplings_and_springs_have_their_ends),
        cmocka_unit_test(a_rolling_disc_touches_its_line),
        cmocka_unit_test(connections_have_their_lines),
        cmocka_unit_test(a_rope_round_a_bollard_touches_it_twice),
        cmocka_unit_test(a_state_that_is_not_finite_has_no_view),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
