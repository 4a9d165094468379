/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points in the world: velocities and accelerations that are written against the differences of places along the
 * motion, for a point of every body of the gallery.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gallery.h"
#include "output/world.h"

/* The state a time h later on the parabola that touches the motion: places there are those of the motion to h^3. */
static void look_at(struct fbd_state *state, const struct fbd_state *from, double h, int body,
                    struct vec point, double values[world_parts])
{
    int n = from->model->plan.n;
    state_copy(state, from);
    for (int i = 0; i < n; i++) {
        state->y[i] = from->y[i] + h * (from->y[n + i] + h / 2 * from->a[i]);
        state->y[n + i] = from->y[n + i] + h * from->a[i];
    }
    state->t = from->t + h;
    state_evaluate(state);
    world_values(state, body, point, values);
}

static void check_body(struct checks *checks, const char *path, const struct fbd_state *state, int b)
{
    const double h = 1e-4;
    const struct model_body *body = &state->model->bodies[b];
    const struct vec point = {body->inertia.G.x + 0.3, body->inertia.G.y - 0.2};
    double now[world_parts], before[world_parts], after[world_parts];
    struct fbd_state *other = state_new(state->model);
    assert_non_null(other);
    look_at(other, state, -h, b, point, before);
    look_at(other, state, h, b, point, after);
    look_at(other, state, 0, b, point, now);
    for (int axis = 0; axis < 2; axis++) {
        double v = (after[axis] - before[axis]) / (2 * h),
               a = (after[axis] - 2 * now[axis] + before[axis]) / (h * h);
        double size = 1 + fabs(now[world_ax]) + fabs(now[world_ay]) + fabs(now[world_x]) + fabs(now[world_y]);
        bool fine = check_close(checks, "velocity", now[world_vx + axis], v, 1e-6 * size * size);
        if (!check_close(checks, "acceleration", now[world_ax + axis], a, 1e-5 * size * size) || !fine)
            print_message("%s, `%s`\n", path, body->name);
    }
    state_free(other);
}

static void check_model(struct checks *checks, const char *path)
{
    struct trial trial = trial_open(path, NULL);
    struct fbd_state *state = trial.state;
    const char *drive[] = {"driven", "shaken", "crank"}; /* what is prescribed does not follow the parabola */
    for (size_t i = 0; i < sizeof drive / sizeof *drive; i++)
        if (strstr(path, drive[i])) state = NULL;
    if (state) state_evaluate(state);
    for (size_t b = 0; state && b < state->model->body_count; b++) check_body(checks, path, state, (int)b);
    trial_close(&trial);
}

static void points_move_as_they_say(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    assert_true(each_model(&checks, check_model) > 40);
    checks_end(&checks);
}

/* A turning rod thrown: known without differences. */
static void an_end_of_a_thrown_rod(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse(
        "fbd: 1\nbodies:\n  c: {mass: 1, shape: rod, length: 2, motion: planar, initial: {x: 3, y: 1, theta: "
        "90 deg, vx: 1, vy: 2, omega: 3}, forces: [gravity]}\noutput: {points: [c.right, c]}\nsimulate: "
        "{until: 1}\n");
    state_evaluate(trial.state);
    const struct fbd_model *model = trial.state->model;
    assert_int_equal(model->scene->output_point_count, 2);
    assert_string_equal(model->scene->output_points[1].name, "c.G");
    struct world_quantity found;
    assert_true(world_find(model, "c.right.ay", &found));
    assert_int_equal(found.part, world_ay);
    assert_false(world_find(model, "c.nothing.ay", &found));
    assert_false(world_find(model, "c.right.z", &found));
    assert_false(world_find(model, "c.y", &found));
    double values[world_parts];
    world_values(trial.state, 0, model->output_points[0], values);
    const double want[world_parts] = {3, 2, 1 - 3, 2, 0, -9.81 - 9, -9, 0};
    for (int part = 0; part < world_parts; part++)
        check_close(&checks, world_part_name((enum world_part)part), values[part], want[part], 1e-14);
    trial_close(&trial);
    checks_end(&checks);
}

/* a - g in the axes of the body. */
static void an_accelerometer_shows_the_closed_form(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    const double g = 9.81, theta = 0.4, omega = 3, length = 2;
    /* A rod about its end: alpha = -3 g cos(theta) / (2 L); at r the axial component is g sin(theta) - omega^2 r, the
     * transverse one alpha r + g cos(theta), which vanishes at the centre of percussion r = 2 L / 3. */
    const double r = 2 * length / 3, alpha = -1.5 * g * cos(theta) / length;
    const struct {
        const char *text, *point;
        double x, y;
    } cases[] = {
        {"bodies: {c: {mass: 1, shape: rod, length: 2, motion: planar, initial: {theta: 0.7, vy: 3, omega: "
         "3}, "
         "forces: [gravity]}}",
         "c.G", 0, 0},
        {"bodies: {c: {mass: 1, shape: rod, length: 2, motion: {pivot: {point: left}}, points: {P: "
         "['1[m]/3', 0]}, "
         "initial: {theta: 0.4, omega: 3}, forces: [gravity]}}",
         "c.P", g * sin(theta) - omega * omega * r, 0},
        {"bodies: {c: {mass: 1, shape: rod, length: 2, motion: {pivot: {point: left}}, "
         "initial: {theta: 0.4, omega: 3}, forces: [gravity]}}",
         "c.right", g * sin(theta) - omega * omega * length, alpha * length + g * cos(theta)},
        {"bodies: {c: {mass: 1, shape: disc, radius: 2, motion: pivot, points: {rim: [0, 2]}, "
         "initial: {theta: 0.4, omega: 3}}}",
         "c.rim", 0, -omega * omega * 2},
        {"plane: horizontal\nbodies: {c: {mass: 1, motion: {slide: {along: 30 deg}}, forces: [{applied: "
         "5}]}}",
         "c.G", 5, 0},
        {"bodies: {c: {mass: 1, motion: {slide: {along: 0.4}}, forces: [gravity, normal]}}", "c.G", 0,
         g * cos(theta)},
        {"bodies: {c: {mass: 1, motion: particle, initial: {vx: 3}}, other: {mass: 1, motion: particle, "
         "forces: "
         "[gravity]}}",
         "c.G", 0, g},
        {"bodies: {c: {mass: 1, motion: particle, initial: {vx: 3}}}", "c.G", 0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text, "fbd: 1\n%s\nsimulate: {until: 1}\n", cases[i].text);
        struct trial trial = trial_parse(text);
        state_evaluate(trial.state);
        char name[32];
        struct world_quantity found;
        double values[world_parts];
        snprintf(name, sizeof name, "%s.proper_ax", cases[i].point);
        assert_true(world_find(trial.state->model, name, &found));
        assert_int_equal(found.part, world_proper_ax);
        world_values(trial.state, found.body, world_point(trial.state->model, found.body, found.point),
                     values);
        check_close(&checks, name, values[world_proper_ax], cases[i].x, 1e-13);
        check_close(&checks, name, values[world_proper_ay], cases[i].y, 1e-13);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_move_as_they_say),
        cmocka_unit_test(an_end_of_a_thrown_rod),
        cmocka_unit_test(an_accelerometer_shows_the_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
