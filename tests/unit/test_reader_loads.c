/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a right model file becomes: forces, moments, derivations by hand, and the names in their expressions.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "scene_fixture.h"

#include <stdlib.h>
#include <time.h>

static const double pi = 3.14159265358979323846;

/* A body with this motion and these lists. */
static struct reading read_body(const char *motion, const char *lists)
{
    char text[1000];
    snprintf(text, sizeof text,
             "fbd: 1\n"
             "ground: {points: {A: [1, 2]}}\n"
             "bodies:\n"
             "  b:\n"
             "    mass: 2\n"
             "    shape: rod\n"
             "    length: 4\n"
             "    points: {P: [0.5, 0.25]}\n"
             "    motion: %s\n"
             "%s\n",
             motion, lists);
    return read_right(text);
}

static const struct load *load_at(const struct reading *r, size_t index)
{
    assert_true(index < r->scene->bodies[0].load_count);
    return &r->scene->bodies[0].loads[index];
}

/* ---- kinds */

static void forces_come_before_moments_in_file_order(void **state)
{
    (void)state;
    struct reading r = read_body("pivot", "    moments: [{applied: 3 N*m}, {damper: 0.5 N*m*s/rad}]\n"
                                          "    forces: [gravity, {spring: {stiffness: 10, to: A}}]");
    static const enum load_kind wanted[] = {load_gravity, load_spring, moment_applied, moment_damper};
    assert_int_equal(r.scene->bodies[0].load_count, 4);
    for (size_t i = 0; i < 4; i++) assert_int_equal(load_at(&r, i)->kind, wanted[i]);
    assert_close(expr_value(load_at(&r, 2)->value.expr), 3);
    assert_close(load_at(&r, 3)->coefficient, 0.5);
    end_reading(&r);
}

static void a_single_entry_needs_no_list(void **state)
{
    (void)state;
    struct reading r = read_body("{pivot: {point: G}}", "    forces: gravity\n    moments: {applied: 3 N*m}");
    assert_int_equal(load_at(&r, 0)->kind, load_gravity);
    assert_int_equal(load_at(&r, 1)->kind, moment_applied);
    end_reading(&r);
}

static void an_applied_force_has_a_size_or_components(void **state)
{
    (void)state;
    struct reading r = read_body("planar", "    forces:\n"
                                           "      - applied: {value: 5, angle: 30 deg, at: P, frame: body}\n"
                                           "      - applied: {value: [1 N, 2 N], at: right}\n"
                                           "      - applied: {fy: 3, at: G}\n"
                                           "      - applied: [4, 5]");
    const struct load *size = load_at(&r, 0), *pair = load_at(&r, 1), *fy = load_at(&r, 2);
    assert_close(expr_value(size->value.expr), 5);
    assert_close(expr_value(size->angle.expr), pi / 6);
    assert_null(size->fx.expr);
    assert_true(size->body_frame);
    assert_vec(size->point.where, 0.5, 0.25);
    assert_null(pair->value.expr);
    assert_close(expr_value(pair->fx.expr), 1);
    assert_close(expr_value(pair->fy.expr), 2);
    assert_false(pair->body_frame);
    assert_vec(pair->point.where, 2, 0);
    assert_close(expr_value(fy->fx.expr), 0);
    assert_close(expr_value(fy->fy.expr), 3);
    assert_int_equal(fy->point.kind, point_G);
    assert_int_equal(load_at(&r, 3)->point.kind, point_absent);
    end_reading(&r);
}

static void on_a_slide_a_force_needs_no_angle(void **state)
{
    (void)state;
    struct reading r =
        read_body("slide", "    forces: [{applied: 5 N}, {applied: {value: 2 N, angle: 20 deg}}]");
    assert_null(load_at(&r, 0)->angle.expr);
    assert_close(expr_value(load_at(&r, 1)->angle.expr), pi / 9);
    end_reading(&r);
}

static void springs_and_dampers_go_to_the_ground_or_along_the_slide(void **state)
{
    (void)state;
    struct reading r =
        read_body("slide", "    forces:\n"
                           "      - spring: {stiffness: 200 N/m, neutral: 0.1 m}\n"
                           "      - spring: {stiffness: 200 N/m, free_length: 0.2 m}\n"
                           "      - spring: {stiffness: 1, free_length: 0.3, to: A, at: left}\n"
                           "      - damper: 3 N*s/m\n"
                           "      - damper: {coefficient: 4, to: [5, 6]}");
    assert_int_equal(load_at(&r, 0)->anchor.kind, point_absent);
    assert_close(load_at(&r, 0)->stiffness, 200);
    assert_close(load_at(&r, 0)->free_length, 0.1);
    assert_close(load_at(&r, 1)->free_length, 0.2);
    assert_int_equal(load_at(&r, 2)->anchor.kind, point_fixed);
    assert_vec(load_at(&r, 2)->anchor.where, 1, 2);
    assert_vec(load_at(&r, 2)->point.where, -2, 0);
    assert_close(load_at(&r, 3)->coefficient, 3);
    assert_vec(load_at(&r, 4)->anchor.where, 5, 6);
    end_reading(&r);
}

static void one_coefficient_of_friction_stands_for_both(void **state)
{
    (void)state;
    static const struct {
        const char *friction;
        double mu_s, mu_k;
    } cases[] = {{"0.5", 0.5, 0.5},
                 {"{coefficient: 0.4}", 0.4, 0.4},
                 {"{static: 0.6}", 0.6, 0.6},
                 {"{kinetic: 0.3}", 0.3, 0.3},
                 {"{static: 0.6, kinetic: 0.4, surface_speed: 2 m/s}", 0.6, 0.4},
                 {"{static: 0, kinetic: 0}", 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char lists[200];
        snprintf(lists, sizeof lists, "    forces: [{friction: %s}, normal, gravity]", cases[i].friction);
        struct reading r = read_body("slide", lists);
        assert_close(expr_value(load_at(&r, 0)->mu_s.expr), cases[i].mu_s);
        assert_close(expr_value(load_at(&r, 0)->mu_k.expr), cases[i].mu_k);
        assert_int_equal(load_at(&r, 0)->surface_speed.expr != NULL, i == 4);
        end_reading(&r);
    }
}

static void a_surface_may_be_a_guide_on_any_side(void **state)
{
    (void)state;
    struct reading r = read_body("slide", "    forces: [{normal: {side: left, two_sided: true}}]");
    assert_int_equal(load_at(&r, 0)->side, side_left);
    assert_true(load_at(&r, 0)->two_sided);
    end_reading(&r);
}

static void a_potential_and_drag_are_read(void **state)
{
    (void)state;
    struct reading r = read_body("slide", "    forces:\n"
                                          "      - potential: 50[N/m]*x^2\n"
                                          "      - potential: {V: \"2[J/m^4]*x^4\"}\n"
                                          "      - drag: {linear: 0.5, quadratic: 0.25, at: P}");
    const double y[] = {3, 0};
    assert_close(expr_eval(load_at(&r, 0)->potential.expr, 0, y, NULL), 450);
    assert_close(expr_eval(load_at(&r, 1)->potential.expr, 0, y, NULL), 162);
    assert_close(load_at(&r, 2)->linear, 0.5);
    assert_close(load_at(&r, 2)->quadratic, 0.25);
    end_reading(&r);
}

static void moments_have_their_own_dimensions(void **state)
{
    (void)state;
    struct reading r =
        read_body("pivot", "    moments:\n"
                           "      - spring: {stiffness: 5 N*m/rad, neutral: 30 deg}\n"
                           "      - friction: {static: 0.6 N*m, kinetic: 0.5 N*m, surface_speed: 3 rad/s}\n"
                           "      - potential: 5[N*m]*(1 - cos(theta))\n"
                           "      - applied: -2[N*m*s]*omega");
    const double y[] = {pi / 2, 3};
    assert_close(load_at(&r, 0)->stiffness, 5);
    assert_close(load_at(&r, 0)->free_length, pi / 6);
    assert_close(expr_value(load_at(&r, 1)->mu_k.expr), 0.5);
    assert_close(expr_eval(load_at(&r, 2)->potential.expr, 0, y, NULL), 5);
    assert_close(expr_eval(load_at(&r, 3)->value.expr, 0, y, NULL), -6);
    end_reading(&r);
}

/* ---- names of loads */

static void loads_without_a_name_are_numbered(void **state)
{
    (void)state;
    struct reading r = read_body("pivot", "    forces:\n"
                                          "      - applied: [1, 0]\n"
                                          "      - applied: {name: applied_2, value: [1, 0]}\n"
                                          "      - applied: [1, 0]\n"
                                          "      - gravity: {name: weight}\n"
                                          "    moments: [applied: 1, damper: 1]");
    static const char *const wanted[] = {"applied", "applied_2", "applied_3",
                                         "weight",  "applied_4", "damper"};
    for (size_t i = 0; i < 6; i++) assert_string_equal(load_at(&r, i)->name, wanted[i]);
    end_reading(&r);
}

/* ---- names in expressions */

static void a_load_may_speak_of_what_the_body_has(void **state)
{
    (void)state;
    struct reading r =
        read_right("fbd: 1\n"
                   "parameters: {k: 3 N/m, c: 5 N*s/m}\n"
                   "bodies:\n"
                   "  a: {mass: 2, motion: slide, forces: [{applied: \"-k*x - c*v + m*g*t/1[s]\"}]}\n"
                   "  b: {mass: 2, motion: particle, forces: [{applied: [k*a.x, c*(vy - a.v)]}]}\n");
    /* q: a.x, b.x, b.y; v: a.v, b.vx, b.vy */
    const double y[] = {2, 0, 0, 3, 0, 10};
    assert_close(expr_eval(r.scene->bodies[0].loads[0].value.expr, 0, y, NULL), -6 - 15);
    assert_close(expr_eval(r.scene->bodies[0].loads[0].value.expr, 1, y, NULL), -6 - 15 + 2 * 9.81);
    assert_close(expr_eval(r.scene->bodies[1].loads[0].fx.expr, 0, y, NULL), 6);
    assert_close(expr_eval(r.scene->bodies[1].loads[0].fy.expr, 0, y, NULL), 35);
    end_reading(&r);
}

static void parameters_shadow_all_but_coordinates(void **state)
{
    (void)state;
    struct reading r = read_right("fbd: 1\n"
                                  "parameters: {m: 3 kg, g: 2 m/s^2, N: 7 N, a: 11 N}\n"
                                  "bodies:\n"
                                  "  b:\n"
                                  "    mass: 5\n"
                                  "    motion: slide\n"
                                  "    forces: [normal, {applied: m*g}, gravity]\n"
                                  "    hand: m*v_dot = N + a\n");
    const struct hand *hand = &r.scene->bodies[0].hands[0];
    assert_close(expr_value(r.scene->bodies[0].loads[1].value.expr), 6);
    assert_close(expr_value(hand->right), 18);
    end_reading(&r);
}

static void a_derivation_speaks_of_the_whole_equation(void **state)
{
    (void)state;
    struct reading r =
        read_right("fbd: 1\n"
                   "parameters: {phi: 0.5}\n"
                   "bodies:\n"
                   "  b:\n"
                   "    mass: 2\n"
                   "    motion: {slide: {along: phi}}\n"
                   "    forces: [gravity, normal, {friction: 0.5}]\n"
                   "    hand:\n"
                   "      - equation: m*v_dot = -m*g*sin(phi) - mu*N\n"
                   "        when: v > 0\n"
                   "      - m*a = -mu_k*N + mu_s*x_ddot*m\n"
                   "  p: {mass: 1, inertia: 1, motion: pivot, hand: I_O*alpha = -m*g*L*sin(theta)}\n");
    const struct body *b = &r.scene->bodies[0], *p = &r.scene->bodies[1];
    /* q: x, theta; v: v, omega; then the slots of enum hand_slot */
    double y[4 + hand_slots] = {0, 0, 1, 0};
    y[4 + hand_acceleration] = 3;
    y[4 + hand_mass] = 2;
    y[4 + hand_N] = 10;
    y[4 + hand_mu_s] = 0.5;
    y[4 + hand_mu_k] = 0.25;
    assert_int_equal(b->hand_count, 2);
    assert_string_equal(b->hands[0].text, "m*v_dot = -m*g*sin(phi) - mu*N");
    assert_close(expr_eval(b->hands[0].left, 0, y, NULL), 6);
    assert_close(expr_eval(b->hands[0].right, 0, y, NULL), -2 * 9.81 * sin(0.5) - 2.5);
    assert_close(expr_eval(b->hands[0].when, 0, y, NULL), 1);
    assert_close(expr_eval(b->hands[1].right, 0, y, NULL), -2.5 + 3);
    assert_null(b->hands[1].when);
    y[1] = pi / 2;
    y[4 + hand_I_O] = 7;
    y[4 + hand_L] = 4;
    assert_close(expr_eval(p->hands[0].left, 0, y, NULL), 21);
    assert_close(expr_eval(p->hands[0].right, 0, y, NULL), -2 * 9.81 * 4);
    end_reading(&r);
}

/* ---- cost */

static double seconds_for(size_t bodies)
{
    const size_t longest = 400;
    char *text = malloc(bodies * longest + 20);
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, "fbd: 1\nbodies:\n");
    for (size_t i = 0; i < bodies; i++)
        used += (size_t)snprintf(text + used, longest,
                                 "  b%zu:\n"
                                 "    mass: 2 kg\n"
                                 "    motion: {slide: {along: 30 deg}}\n"
                                 "    forces:\n"
                                 "      - gravity\n"
                                 "      - normal\n"
                                 "      - friction: {static: 0.5, kinetic: 0.4}\n"
                                 "      - applied: -3[N/m]*b%zu.x\n",
                                 i, i * 7919 % bodies);
    clock_t start = clock();
    struct reading r = read_right(text);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    assert_int_equal(r.scene->body_count, bodies);
    end_reading(&r);
    free(text);
    return seconds;
}

/* Ten times the bodies take about ten times as long; a search through all bodies for each name would take a
 * hundred times as long. */
static void ten_thousand_bodies_are_read_in_linear_time(void **state)
{
    (void)state;
    double few = seconds_for(1000), many = seconds_for(10000);
    assert_true(many < 50 * few + 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_come_before_moments_in_file_order),
        cmocka_unit_test(a_single_entry_needs_no_list),
        cmocka_unit_test(an_applied_force_has_a_size_or_components),
        cmocka_unit_test(on_a_slide_a_force_needs_no_angle),
        cmocka_unit_test(springs_and_dampers_go_to_the_ground_or_along_the_slide),
        cmocka_unit_test(one_coefficient_of_friction_stands_for_both),
        cmocka_unit_test(a_surface_may_be_a_guide_on_any_side),
        cmocka_unit_test(a_potential_and_drag_are_read),
        cmocka_unit_test(moments_have_their_own_dimensions),
        cmocka_unit_test(loads_without_a_name_are_numbered),
        cmocka_unit_test(a_load_may_speak_of_what_the_body_has),
        cmocka_unit_test(parameters_shadow_all_but_coordinates),
        cmocka_unit_test(a_derivation_speaks_of_the_whole_equation),
        cmocka_unit_test(ten_thousand_bodies_are_read_in_linear_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
