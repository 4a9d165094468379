/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Moment equations of derivations by hand that say about which point they are, and what is said of false ones: the point that
 * would fit, the moment that is missing, the reaction that stands in the place of another.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_grade.h"
#include "scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A bar that hangs on a crank and on a piston. */
static const char mechanism[] =
    "fbd: 1\n"
    "parameters: {R: 0.2 m, B: 0.6 m, M: 2 N*m}\n"
    "ground: {points: {O: [0, 0], P: [0.3, 0.4]}}\n"
    "bodies:\n"
    "  crank:\n"
    "    shape: rod\n"
    "    mass: 1 kg\n"
    "    length: R\n"
    "    motion: {pivot: {at: O, point: left}}\n"
    "    initial: {theta: 50 deg, omega: 3 rad/s}\n"
    "    forces: [gravity]\n"
    "    moments: [{applied: {name: engine, value: M}}]\n"
    "    hand: %s\n"
    "  bar:\n"
    "    shape: rod\n"
    "    mass: 2 kg\n"
    "    length: B\n"
    "    motion: {pivot: {on: crank, at: right, point: left}}\n"
    "    initial: {assemble: true}\n"
    "    forces: [gravity]\n"
    "    hand: %s\n"
    "  piston: {mass: 3 kg, motion: slide, initial: {x: 0.7 m, assemble: true}, forces: [gravity, normal]}\n"
    "couplings: [{pin: {name: wrist, between: [bar.right, piston.G]}}]\n"
    "simulate: {until: 0.5 s}\n";

#define I_LEFT_TERMS "I_left*angle_ddot + m*B/2*(cos(angle)*left.a_y - sin(angle)*left.a_x)"
#define I_G_TERMS    "I_G*angle_ddot + m*B/2*(cos(angle)*a_y - sin(angle)*a_x)"
#define WEIGHT       "m*g*B/2*cos(angle)"
#define WRIST        "B*cos(angle)*wrist.y - B*sin(angle)*wrist.x"
#define BOTH         "B/2*cos(angle)*(wrist.y - pin.y) - B/2*sin(angle)*(wrist.x - pin.x)"
/* Arms from the point P of the ground. */
#define MOMENTS_ABOUT_P                                                                                      \
    "(pin.at.x - 0.3[m])*pin.y - (pin.at.y - 0.4[m])*pin.x + (wrist.at.x - 0.3[m])*wrist.y"                  \
    " - (wrist.at.y - 0.4[m])*wrist.x - (bar.G.x - 0.3[m])*m*g"
#define INERTIA_ABOUT_P "I_G*angle_ddot + m*((bar.G.x - 0.3[m])*a_y - (bar.G.y - 0.4[m])*a_x)"

static const struct {
    const char *body, *about, *equation;
    const char *says; /* NULL: it agrees */
} lines[] = {
    {"bar", "left", I_LEFT_TERMS " = -" WEIGHT " + " WRIST, NULL},
    {"bar", "O", I_G_TERMS " = -" WEIGHT " + " WRIST, NULL},
    {"bar", "pin", I_LEFT_TERMS " = -" WEIGHT " + " WRIST, NULL},
    {"bar", "crank.right", I_LEFT_TERMS " = -" WEIGHT " + " WRIST, NULL},
    {"bar", "G", "I_G*angle_ddot = " BOTH, NULL},
    {"bar", "ground.P", INERTIA_ABOUT_P " = " MOMENTS_ABOUT_P, NULL},
    {"bar", "P", INERTIA_ABOUT_P " = " MOMENTS_ABOUT_P, NULL},
    {"crank", "O", "I_O*alpha = M - m*g*R/2*cos(theta) - R*cos(theta)*R_2y + R*sin(theta)*R_2x", NULL},
    /* true ones, about another point than they say */
    {"bar", "right", I_LEFT_TERMS " = -" WEIGHT " + " WRIST, "moments about `O`, not about `right`"},
    {"bar", "wrist", "I_G*angle_ddot = " BOTH, "moments about `G`, not about `wrist`"},
    {"crank", "G", "I_O*alpha = M - m*g*R/2*cos(theta) - R*cos(theta)*R_2y + R*sin(theta)*R_2x",
     "moments about `O`, not about `G`"},
    /* false ones */
    {"bar", "left", I_LEFT_TERMS " = " BOTH, "wrong point: the arms are those about `G`, not about `left`"},
    {"bar", "ground.P", "I_G*angle_ddot = " MOMENTS_ABOUT_P,
     "wrong point: the inertia is that about `G`, not about `ground.P`"},
    {"bar", NULL, I_LEFT_TERMS " = " BOTH, "the arms are those about `G`, the inertia is that about `O`"},
    {"bar", "left", I_LEFT_TERMS " = " WRIST, "the moment of `gravity` about `left` is missing"},
    {"bar", "left", I_LEFT_TERMS " = -" WEIGHT " + B*cos(angle)*wrist.y",
     "the moment of `wrist.x` about `left` is missing"},
    {"bar", "left", I_LEFT_TERMS " = -" WEIGHT, "the moment of `wrist` about `left` is missing"},
    {"bar", "left",
     "I_G*angle_ddot + m*B/2*(cos(angle)*left.a_y - sin(angle)*left.a_x) = -" WEIGHT " + " WRIST,
     "wrong point: `I_G` stands where `I_O` belongs"},
    {"bar", "left", "I_left*angle_ddot + m*B/2*(cos(angle)*a_y - sin(angle)*a_x) = -" WEIGHT " + " WRIST,
     "belongs"},
    {"bar", "left", I_LEFT_TERMS " = -" WEIGHT " + B*cos(angle)*pin.y - B*sin(angle)*wrist.x",
     "wrong reaction: `pin.y` stands where `wrist.y` belongs"},
    {"bar", "left", "(" I_LEFT_TERMS ")/(m*B) = (" WEIGHT " + " WRIST ")/(m*B)",
     "the moment of `gravity` about `left` has the wrong sign"},
    {"crank", "O", "I_O*alpha = M - m*g*R/2*cos(theta) - R*cos(theta)*R_1y + R*sin(theta)*R_2x",
     "wrong reaction: `R_1y` stands where `R_2y` belongs"},
    {"crank", "O", "I_O*alpha = M - m*g*R/2*cos(theta) + R*cos(theta)*R_2y + R*sin(theta)*R_2x",
     "the summand `R*cos(theta)*R_2y` has the wrong sign"},
};

static void write_model(char *text, size_t room, const char *body, const char *about, const char *equation)
{
    char hand[600], point[60] = "";
    if (about) snprintf(point, sizeof point, "about: %s, ", about);
    snprintf(hand, sizeof hand, "{%sequation: '%s'}", point, equation);
    const bool bar = strcmp(body, "bar") == 0;
    snprintf(text, room, mechanism, bar ? "[]" : hand, bar ? hand : "[]");
}

static void moments_about_a_point(void **unused)
{
    (void)unused;
    int failed = 0;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char text[3000];
        size_t differing = 0;
        write_model(text, sizeof text, lines[i].body, lines[i].about, lines[i].equation);
        fbd_model *model = model_from(text);
        char *verdict = fbd_check_hand(model, 1, &differing);
        assert_non_null(verdict);
        const bool fine = lines[i].says ? differing == 1 && strstr(verdict, lines[i].says) : differing == 0;
        if (!fine) print_error("line %zu, about %s: %s", i, lines[i].about, verdict);
        failed += !fine;
        free(verdict);
        fbd_model_free(model);
    }
    assert_int_equal(failed, 0);
}

static void a_point_that_is_not_there(void **unused)
{
    (void)unused;
    char text[3000];
    fbd_errors *errors = fbd_errors_new();
    write_model(text, sizeof text, "bar", "middle", "m*a_x = pin.x + wrist.x");
    assert_null(fbd_model_parse(text, strlen(text), "model.yaml", NULL, 0, errors));
    assert_int_equal(fbd_errors_count(errors), 1);
    fbd_error error = fbd_errors_get(errors, 0);
    assert_string_equal(error.id, "unknown-point");
    assert_int_equal(error.line, 21);
    assert_int_equal(error.column, 19);
    fbd_errors_free(errors);
}

/* Of two lines of a key, by the reactions that they name. */
static void reactions_count_by_themselves(void **unused)
{
    (void)unused;
    static const struct {
        const char *hand;
        double points;
    } answers[] = {
        {"['I_G*alpha = L*(R_x*sin(theta) - R_y*cos(theta))', 'R_x = m*a_x', 'R_y = m*g + m*a_y']", 3},
        {"['m*a_x - R_x = 0', 'R_y - m*g = m*a_y']", 2},
        {"['R_x = m*a_x', '2*R_x = 2*m*a_x']", 1},
        {"['R_x = m*a_y', 'R_y = m*g + m*a_y']", 1},
        {"{about: G, equation: 'I_G*alpha = L*(R_x*sin(theta) - R_y*cos(theta))'}", 1},
        {"{about: right, equation: 'I_G*alpha = L*(R_x*sin(theta) - R_y*cos(theta))'}", 0},
    };
    static const char scene[] = "fbd: 1\n"
                                "grading: {reactions: none, points: {force: 0, derivation: 1}}\n"
                                "bodies:\n"
                                "  rod:\n"
                                "    {shape: rod, mass: 2 kg, length: 0.8 m, initial: {theta: 40 deg},\n"
                                "     motion: {pivot: {at: [0, 0], point: left}}, forces: [gravity],\n"
                                "     hand: %s}\n"
                                "simulate: {until: 1 s}\n";
    char text[1200];
    snprintf(text, sizeof text, scene, answers[0].hand);
    fbd_errors *errors = fbd_errors_new();
    fbd_key *key = fbd_key_parse(text, strlen(text), "key.yaml", NULL, 0, errors);
    assert_non_null(key);
    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++) {
        snprintf(text, sizeof text, scene, answers[i].hand);
        fbd_grade *grade = fbd_grade_parse(key, text, strlen(text), "anna", errors);
        assert_non_null(grade);
        if (fbd_grade_points(grade) != answers[i].points) print_error("%s\n", answers[i].hand);
        assert_true(fbd_grade_points(grade) == answers[i].points);
        fbd_grade_free(grade);
    }
    fbd_key_free(key);
    fbd_errors_free(errors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_about_a_point),
        cmocka_unit_test(a_point_that_is_not_there),
        cmocka_unit_test(reactions_count_by_themselves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
