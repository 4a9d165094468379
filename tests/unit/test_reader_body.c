/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a right model file becomes: shapes, parts, points, motion, coordinates.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "scene_fixture.h"

static const double pi = 3.14159265358979323846;

static struct vec point_called(const struct body *body, const char *name)
{
    for (size_t i = 0; i < body->point_count; i++)
        if (strcmp(body->points[i].name, name) == 0) return body->points[i].where;
    fail_msg("%s has no point %s", body->name, name);
    return (struct vec){0, 0};
}

/* ---- what a body is */

static void each_shape_keeps_its_dimensions_and_faces_the_plane(void **state)
{
    (void)state;
    static const struct {
        const char *keys;
        struct part part;
    } cases[] = {
        {"{mass: 3}", {.shape = shape_point, .axis = 'z', .mass = 3}},
        {"{mass: 3, shape: rod, length: 2}", {.shape = shape_rod, .axis = 'z', .mass = 3, .length = 2}},
        {"{mass: 3, shape: sphere, radius: 2 cm}",
         {.shape = shape_sphere, .axis = 'z', .mass = 3, .radius = 0.02}},
        {"{mass: 3, shape: disc, radius: 2}", {.shape = shape_cylinder, .axis = 'x', .mass = 3, .radius = 2}},
        {"{mass: 3, shape: disk, radius: 2}", {.shape = shape_cylinder, .axis = 'x', .mass = 3, .radius = 2}},
        {"{mass: 3, shape: solid_cylinder, radius: 2, length: 5, axis: y}",
         {.shape = shape_cylinder, .axis = 'y', .mass = 3, .radius = 2, .length = 5}},
        {"{mass: 3, shape: hollow_cylinder, outer_radius: 2, inner_radius: 1}",
         {.shape = shape_hollow_cylinder, .axis = 'x', .mass = 3, .radius = 2, .inner_radius = 1}},
        {"{mass: 3, shape: rectangular_prism, a: 1, b: 2}",
         {.shape = shape_prism, .axis = 'z', .mass = 3, .side = {1, 2, 0}}},
        {"{mass: 3, shape: prism, c: 1, b: 2, axis: x}",
         {.shape = shape_prism, .axis = 'x', .mass = 3, .side = {0, 2, 1}}},
        {"{mass: 3, shape: thin_ring, radius: 2}",
         {.shape = shape_ring, .axis = 'x', .mass = 3, .radius = 2}},
        {"{mass: -3, center: [1, 2]}", {.shape = shape_point, .axis = 'z', .mass = -3, .center = {1, 2}}},
        {"{mass: 0}", {.shape = shape_point, .axis = 'z', .mass = 0}},
        {"{mass: 3, inertia: 0.5}", {.shape = shape_given, .axis = 'z', .mass = 3, .inertia = 0.5}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[300];
        snprintf(text, sizeof text, "fbd: 1\nbodies: {b: {motion: planar, parts: {p: %s}}}", cases[i].keys);
        struct reading r = read_right(text);
        const struct part *got = &r.scene->bodies[0].parts[0], *wanted = &cases[i].part;
        assert_string_equal(got->name, "p");
        assert_int_equal(got->shape, wanted->shape);
        assert_int_equal(got->axis, wanted->axis);
        assert_close(got->mass, wanted->mass);
        assert_close(got->length, wanted->length);
        assert_close(got->radius, wanted->radius);
        assert_close(got->inner_radius, wanted->inner_radius);
        for (int k = 0; k < 3; k++) assert_close(got->side[k], wanted->side[k]);
        assert_vec(got->center, wanted->center.x, wanted->center.y);
        assert_close(got->inertia, wanted->inertia);
        end_reading(&r);
    }
}

static void a_rod_is_placed_by_its_ends_or_by_its_centre(void **state)
{
    (void)state;
    struct reading r = read_right(
        "fbd: 1\nbodies:\n"
        "  a: {mass: 1, shape: rod, from: [1, 2], to: [1, -1], motion: planar}\n"
        "  b: {mass: 1, shape: rod, length: 3, center: [1, 0.5], angle: -90 deg, motion: planar}\n");
    for (size_t i = 0; i < 2; i++) {
        const struct body *body = &r.scene->bodies[i];
        assert_close(body->parts[0].length, 3);
        assert_close(body->parts[0].angle, -pi / 2);
        assert_vec(body->parts[0].center, 1, 0.5);
        assert_vec(point_called(body, "left"), 1, 2);
        assert_vec(point_called(body, "right"), 1, -1);
    }
    end_reading(&r);
}

static void parts_lend_their_points_under_their_names(void **state)
{
    (void)state;
    struct reading r = read_right("fbd: 1\nbodies:\n"
                                  "  p:\n"
                                  "    motion: {pivot: {point: rod.right}}\n"
                                  "    points: {P: [0, 2]}\n"
                                  "    parts:\n"
                                  "      rod: {shape: rod, mass: 1, from: [0, 0], to: [4, 0]}\n"
                                  "      bob: {mass: 3, center: [4, 0]}\n");
    const struct body *body = &r.scene->bodies[0];
    assert_vec(point_called(body, "rod.left"), 0, 0);
    assert_vec(point_called(body, "bob.G"), 4, 0);
    assert_vec(point_called(body, "P"), 0, 2);
    assert_vec(body->motion.point, 4, 0);
    end_reading(&r);
}

static void inertia_may_be_stated_about_any_point(void **state)
{
    (void)state;
    struct reading r =
        read_right("fbd: 1\nbodies:\n"
                   "  a: {mass: 1, inertia: {value: 2, about: O}, motion: pivot}\n"
                   "  b: {mass: 1, inertia: {value: 2, about: P}, points: {P: [3, 4]}, motion: planar}\n"
                   "  c: {mass: 1, inertia: {value: 2, about: [1, 1]}, motion: planar}\n"
                   "  d: {mass: 1, inertia: {value: 2, about: G}, motion: planar}\n");
    assert_true(r.scene->bodies[0].parts[0].about_pivot);
    assert_int_equal(r.scene->bodies[1].parts[0].about.kind, point_fixed);
    assert_vec(r.scene->bodies[1].parts[0].about.where, 3, 4);
    assert_vec(r.scene->bodies[2].parts[0].about.where, 1, 1);
    assert_int_equal(r.scene->bodies[3].parts[0].about.kind, point_G);
    end_reading(&r);
}

/* ---- how it moves */

static void a_motion_is_a_word_or_a_mapping(void **state)
{
    (void)state;
    static const struct {
        const char *motion;
        enum motion_kind kind;
        double along;
        struct vec through, point;
    } cases[] = {
        {"slide", motion_slide, 0, {0, 0}, {0, 0}},
        {"{slide: {along: 90 deg, through: [1, 2]}}", motion_slide, pi / 2, {1, 2}, {0, 0}},
        {"{slide: {line: ramp}}", motion_slide, pi / 6, {3, 4}, {0, 0}},
        {"{slide: {through: A}}", motion_slide, 0, {5, 6}, {0, 0}},
        {"{slide: }", motion_slide, 0, {0, 0}, {0, 0}},
        {"pivot", motion_pivot, 0, {0, 0}, {0, 0}},
        {"{pivot: {at: A}}", motion_pivot, 0, {5, 6}, {0, 0}},
        {"{pivot: {at: [7, 8], point: left}}", motion_pivot, 0, {7, 8}, {-1, 0}},
        {"{pivot: {point: G}}", motion_pivot, 0, {0, 0}, {0, 0}},
        {"{pivot: {point: [0, 3]}}", motion_pivot, 0, {0, 0}, {0, 3}},
        {"particle", motion_particle, 0, {0, 0}, {0, 0}},
        {"{particle: {}}", motion_particle, 0, {0, 0}, {0, 0}},
        {"planar", motion_planar, 0, {0, 0}, {0, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "fbd: 1\n"
                 "ground: {points: {A: [5, 6], B: [3, 4]}, lines: {ramp: {along: 30 deg, through: B}}}\n"
                 "bodies: {b: {mass: 1, shape: rod, length: 2, motion: %s}}",
                 cases[i].motion);
        struct reading r = read_right(text);
        const struct motion *motion = &r.scene->bodies[0].motion;
        assert_int_equal(motion->kind, cases[i].kind);
        assert_close(motion->along, cases[i].along);
        assert_vec(motion->through, cases[i].through.x, cases[i].through.y);
        assert_vec(motion->point, cases[i].point.x, cases[i].point.y);
        end_reading(&r);
    }
}

static void a_body_may_hang_by_its_centre_of_mass(void **state)
{
    (void)state;
    struct reading r = read_right("fbd: 1\nbodies:\n"
                                  "  p:\n"
                                  "    motion: {pivot: {point: G}}\n"
                                  "    parts:\n"
                                  "      a: {mass: 1, center: [0, 0]}\n"
                                  "      b: {mass: 3, center: [4, 8]}\n");
    assert_vec(r.scene->bodies[0].motion.point, 3, 6);
    end_reading(&r);
}

static void coordinates_are_numbered_in_the_order_of_the_file(void **state)
{
    (void)state;
    struct reading r =
        read_right("fbd: 1\nbodies:\n"
                   "  a: {mass: 1, motion: slide, initial: {x: 1, v: 2}}\n"
                   "  b: {mass: 1, inertia: 1, motion: planar,\n"
                   "      initial: {x: 3, y: 4, theta: 30 deg, vx: 5, vy: 6, omega: 60 rpm}}\n"
                   "  c: {mass: 1, motion: particle, initial: {vy: 7}}\n"
                   "  d: {mass: 1, inertia: 1, motion: pivot, initial: {theta: 1, omega: 2}}\n");
    static const struct {
        int body;
        const char *name, *rate, *acceleration;
        double initial, initial_rate;
    } wanted[] = {{0, "x", "v", "v_dot", 1, 2},
                  {1, "x", "vx", "vx_dot", 3, 5},
                  {1, "y", "vy", "vy_dot", 4, 6},
                  {1, "theta", "omega", "omega_dot", 3.14159265358979323846 / 6, 2 * 3.14159265358979323846},
                  {2, "x", "vx", "vx_dot", 0, 0},
                  {2, "y", "vy", "vy_dot", 0, 7},
                  {3, "theta", "omega", "omega_dot", 1, 2}};
    const size_t count = sizeof wanted / sizeof *wanted;
    assert_int_equal(r.scene->coordinate_count, count);
    for (size_t i = 0; i < count; i++) {
        const struct coordinate *c = &r.scene->coordinates[i];
        assert_int_equal(c->body, wanted[i].body);
        assert_string_equal(c->name, wanted[i].name);
        assert_string_equal(c->rate_name, wanted[i].rate);
        assert_string_equal(c->acceleration_name, wanted[i].acceleration);
        assert_close(c->initial, wanted[i].initial);
        assert_close(c->initial_rate, wanted[i].initial_rate);
        bool angle = strcmp(wanted[i].name, "theta") == 0;
        assert_int_equal(c->angle, angle);
        assert_true(dim_equal(c->dim, angle ? DIM_NONE : DIM_LENGTH));
        assert_true(dim_equal(c->rate_dim, angle ? DIM_RATE : DIM_VELOCITY));
    }
    assert_int_equal(r.scene->bodies[2].first, 4);
    assert_int_equal(r.scene->bodies[2].count, 2);
    end_reading(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_shape_keeps_its_dimensions_and_faces_the_plane),
        cmocka_unit_test(a_rod_is_placed_by_its_ends_or_by_its_centre),
        cmocka_unit_test(parts_lend_their_points_under_their_names),
        cmocka_unit_test(inertia_may_be_stated_about_any_point),
        cmocka_unit_test(a_motion_is_a_word_or_a_mapping),
        cmocka_unit_test(a_body_may_hang_by_its_centre_of_mass),
        cmocka_unit_test(coordinates_are_numbered_in_the_order_of_the_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
