/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivations by hand that name the forces of the diagrams: by their names there, by their letters.
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

static const char hoist[] = "fbd: 1\n"
                            "parameters: {M1: 3 kg, M2: 2 kg, mu: 0.3}\n"
                            "ground: {points: {top: [2, 0]}}\n"
                            "bodies:\n"
                            "  block:\n"
                            "    mass: M1\n"
                            "    motion: slide\n"
                            "    initial: {v: 1 m/s}\n"
                            "    forces: [gravity, normal, {friction: mu}]\n"
                            "%s"
                            "  weight:\n"
                            "    mass: M2\n"
                            "    motion: {slide: {along: -90 deg, through: [2, -1]}}\n"
                            "    forces: [gravity]\n"
                            "%s"
                            "couplings: [{rope: {name: cord, through: [block.G, ground.top, weight.G]}}]\n"
                            "simulate: {until: 1 s}\n";

static const char crank[] = "fbd: 1\n"
                            "parameters: {R: 0.2 m, B: 0.6 m, M: 2 N*m}\n"
                            "ground: {points: {O: [0, 0]}}\n"
                            "bodies:\n"
                            "  crank:\n"
                            "    shape: rod\n"
                            "    mass: 1 kg\n"
                            "    length: R\n"
                            "    motion: {pivot: {at: O, point: left}}\n"
                            "    initial: {theta: 50 deg, omega: 3 rad/s}\n"
                            "    forces: [gravity]\n"
                            "    moments: [{applied: {name: engine, value: M}}]\n"
                            "%s"
                            "  bar:\n"
                            "    shape: rod\n"
                            "    mass: 2 kg\n"
                            "    length: B\n"
                            "    motion: {pivot: {on: crank, at: right, point: left}}\n"
                            "    initial: {assemble: true}\n"
                            "    forces: [gravity]\n"
                            "%s"
                            "  piston:\n"
                            "    mass: 3 kg\n"
                            "    motion: slide\n"
                            "    initial: {x: 0.7 m, assemble: true}\n"
                            "couplings: [{pin: {name: wrist, between: [bar.right, piston.G]}}]\n"
                            "simulate: {until: 1 s}\n";

/* Three supports for a rigid beam, and letters of the file's own. */
static const char beam[] = "fbd: 1\n"
                           "parameters: {P: 300 N}\n"
                           "ground: {points: {A: [0, 0], under_B: [2, -0.5], under_C: [4, -0.5]}}\n"
                           "symbols: {B_y: -B, C_y: -C}\n"
                           "bodies:\n"
                           "  beam:\n"
                           "    shape: rod\n"
                           "    mass: 20 kg\n"
                           "    length: 4 m\n"
                           "    points: {load: [-1 m, 0]}\n"
                           "    motion: planar\n"
                           "    initial: {x: 2 m}\n"
                           "    forces: [gravity, {applied: {name: P, value: [0, -P], at: load}}]\n"
                           "    symbols: {S: [A.y, -B, -C]}\n"
                           "%s%s"
                           "couplings:\n"
                           "  - pin: {name: A, between: [beam.left, ground.A]}\n"
                           "  - rod: {name: B, between: [beam.G, ground.under_B]}\n"
                           "  - rod: {name: C, between: [beam.right, ground.under_C]}\n"
                           "simulate: {until: 1 s}\n";

/* A pin and a link to a point under the other end: a mirror image of it, where the link hangs, is 0.25 rad off. */
static const char two_supports[] = "fbd: 1\n"
                                   "parameters: {P: 300 N}\n"
                                   "ground: {points: {A: [0, 0], under_B: [4, -0.5]}}\n"
                                   "bodies:\n"
                                   "  beam:\n"
                                   "    shape: rod\n"
                                   "    mass: 20 kg\n"
                                   "    length: 4 m\n"
                                   "    motion: planar\n"
                                   "    initial: {x: 2 m}\n"
                                   "    points: {load: [-1 m, 0]}\n"
                                   "    forces: [gravity, {applied: {name: P, value: [0, -P], at: load}}]\n"
                                   "%s%s"
                                   "couplings:\n"
                                   "  - pin: {name: A, between: [beam.left, ground.A]}\n"
                                   "  - rod: {name: B, between: [beam.right, ground.under_B]}\n"
                                   "simulate: {until: 1 s}\n";

/* Turns about the origin, and cannot turn. */
static const char ladder[] =
    "fbd: 1\n"
    "parameters: {P: 800 N, s: 3 m}\n"
    "ground: {points: {C: [3.5, '5[m]*sin(60[deg])']}}\n"
    "bodies:\n"
    "  ladder:\n"
    "    shape: rod\n"
    "    from: [0, 0]\n"
    "    to: [5 m, 0]\n"
    "    mass: 20 kg\n"
    "    points: {rung: [s, 0]}\n"
    "    motion: {pivot: {at: [0, 0]}}\n"
    "    initial: {theta: 60 deg}\n"
    "    forces: [gravity, {applied: {name: person, value: [0, -P], at: rung}}]\n"
    "%s%s"
    "couplings: [{rod: {name: wall, between: [ladder.right, ground.C], length: 1 m}}]\n"
    "simulate: {until: 1 s}\n";

/* Above a floor; %s of the second line: what moves beside it. */
static const char flight[] = "fbd: 1\n"
                             "ground: {lines: {floor: {along: 0 deg}}}\n"
                             "bodies:\n"
                             "  ball:\n"
                             "    mass: 0.5 kg\n"
                             "    shape: sphere\n"
                             "    radius: 0.1 m\n"
                             "    motion: planar\n"
                             "    initial: {y: 0.12 m, vx: 1 m/s}\n"
                             "    forces: [gravity]\n"
                             "%s"
                             "  other:\n"
                             "    mass: 2 kg\n"
                             "    shape: disk\n"
                             "    radius: 0.2 m\n"
                             "    motion: planar\n"
                             "    initial: {x: 0.33 m, y: 0.2 m}\n"
                             "    forces: [gravity]\n"
                             "%s"
                             "contacts:\n"
                             "  - {name: floor, between: [ball, ground.floor], restitution: 0.5}\n"
                             "  - {name: ground, between: [other, ground.floor], restitution: 0}\n"
                             "  - {name: blow, between: [ball, other], restitution: 0.5}\n"
                             "simulate: {until: 1 s}\n";

static const char stops[] = "fbd: 1\n"
                            "parameters: {b: 1 m}\n"
                            "bodies:\n"
                            "  rod:\n"
                            "    shape: rod\n"
                            "    mass: 2 kg\n"
                            "    from: [0, 0]\n"
                            "    to: [0, -b]\n"
                            "    motion: {pivot: {min: -0.2 rad, max: 1 rad, restitution: 0.5}}\n"
                            "    initial: {theta: 0.9 rad}\n"
                            "    forces: [gravity]\n"
                            "%s%s"
                            "simulate: {until: 1 s}\n";

struct line {
    const char *scene;
    int body; /* 0 or 1 */
    const char *equation;
    bool right;
};

static const struct line lines[] = {
    {hoist, 0, "T - f = m*a", true},
    {hoist, 0, "cord - f = m*a", true},
    {hoist, 0, "cord.x - f = m*a", true},
    {hoist, 0, "cord.x + friction.x = m*a", true},
    {hoist, 0, "T + f = m*a", false},
    {hoist, 0, "-T - f = m*a", false},
    {hoist, 0, "T = m*a", false},
    {hoist, 0, "N - m*g = 0", true},
    {hoist, 0, "N1 = m*g", true},
    {hoist, 0, "N + m*g = 0", false},
    {hoist, 0, "f = mu*N*sign(v)", true},
    {hoist, 0, "f = -mu*N*sign(v)", false},
    {hoist, 0, "friction = f", true},
    {hoist, 0, "weight.T = T", true},
    {hoist, 0, "weight.cord.y = T", true},
    {hoist, 1, "m*g - T = m*a", true},
    {hoist, 1, "m*g + T = m*a", false},
    {hoist, 1, "block.N = M1*g", true},
    {hoist, 1, "N = 0", true}, /* its guide, across which nothing acts */
    {hoist, 1, "guide.x = 0", true},
    {crank, 0, "pin.x + bar.pin.x = m*crank.a_x", true},
    {crank, 0, "pin.y + bar.pin.y - m*g = m*crank.a_y", true},
    {crank, 0, "pin.y - bar.pin.y - m*g = m*crank.a_y", false},
    {crank, 0, "R_1x - R_2x = m*a_x", true},
    {crank, 0, "R_1x + R_2x = m*a_x", false},
    {crank, 0, "I_O*alpha = M - m*g*R/2*cos(theta) - R*cos(theta)*R_2y + R*sin(theta)*R_2x", true},
    {crank, 0, "I_O*alpha = M - m*g*R/2*cos(theta) - R*cos(theta)*R_2x + R*sin(theta)*R_2x", false},
    {crank, 1, "pin.x + wrist.x = m*a_x", true},
    {crank, 1, "R_2x + R_3x = m*a_x", true},
    {crank, 1, "R_2y + R_3y - m*g = m*a_y", true},
    {crank, 1, "R_2y + R_3y = m*a_y", false},
    {crank, 1, "I_G*bar.angle_ddot = 0", false},
    {crank, 1, "I_G*angle_ddot = (wrist.y - pin.y)*B/2*cos(angle) - (wrist.x - pin.x)*B/2*sin(angle)", true},
    {crank, 1,
     "I_left*angle_ddot + m*(G.x - left.x)*left.a_y - m*(G.y - left.y)*left.a_x = (G.x - left.x)*(-m*g) + "
     "(right.x - left.x)*wrist.y - (right.y - left.y)*wrist.x",
     true},
    {crank, 1,
     "I_G*angle_ddot + m*(G.x - left.x)*left.a_y - m*(G.y - left.y)*left.a_x = (G.x - left.x)*(-m*g) + "
     "(right.x - left.x)*wrist.y - (right.y - left.y)*wrist.x",
     false},
    {crank, 1, "piston.wrist.x = -wrist.x", true},
    {beam, 0, "A.y + B_y + C_y - m*g - P = 0", true},
    {beam, 0, "S = m*g + P", true},
    {beam, 0, "S = m*g", false},
    {beam, 0, "1[m]*P - 2[m]*A.y + 2[m]*C_y = I_G*angle_ddot", true},
    {beam, 0, "1[m]*P - 2[m]*A.y - 2[m]*C_y = I_G*angle_ddot", false},
    {beam, 0, "A.x = 0", true},
    {beam, 0, "A.y = A.y", true},
    {beam, 0, "A.y = (m*g + P)/3 + P/8", false}, /* is not unique, as */
    {beam, 0, "B_y = (m*g + P)/3", false},       /* this, which the least reactions have */
    {crank, 1, "piston.R_x = wrist.x", true},    /* the letter stands for the force on the bar */
    {two_supports, 0, "A.x = 0", true},
    {two_supports, 0, "A.y = 0", false},
    {two_supports, 0, "m*vx_dot = 0", true},
    {two_supports, 0, "m*vx_dot = 1e-6*P", false},
    {two_supports, 0, "B.y*4[m] - P*1[m] - m*g*2[m] = 0", true},
    {two_supports, 0, "B.y*4[m] - P*2[m] - m*g*2[m] = 0", false},
    {ladder, 0, "R_x = -S", true},
    {ladder, 0, "R_x = S", false},
    {ladder, 0, "S*5[m]*sin(theta) + m*g*5[m]/2*cos(theta) + P*s*cos(theta) = 0", true},
    {ladder, 0, "S*5[m]*sin(theta) + m*g*5[m]/2*cos(theta) + P*s*sin(theta) = 0", false},
    {flight, 0, "m*vy_dot = -m*g", true},
    {flight, 0, "m*vy_dot = m*g", false},
    {flight, 0, "m*vx_dot = 0", true},
    {flight, 0, "vx_dot = 1[m/s^2]", false},
    {flight, 0, "I_G*alpha = 0", true},
    {flight, 0, "floor.normal.y = 0", true},
    {flight, 0, "floor.normal.y = m*g", false},
    {flight, 0, "max(0.1[m] - y, 0[m]) = 0", true}, /* in no state in the floor */
    {flight, 0, "max(0.3[m] - hypot(x - other.x, y - other.y), 0[m]) = 0", true},
    {flight, 1, "y = 0.2[m]", true}, /* on the floor at the start, and there */
    {flight, 1, "ground.normal.y = m*g", true},
    {flight, 1, "ground.normal.y = 0", false},
    {stops, 0, "I_O*alpha = -m*g*b/2*sin(theta)", true},
    {stops, 0, "I_O*alpha = -m*g*b*sin(theta)", false},
    {stops, 0, "R_y - m*g = m*a_y", true},
    {stops, 0, "max(theta - 1, 0) = 0", true},
};

static int check(const struct line *line)
{
    char text[2400], hand[400];
    size_t differing = 0;
    snprintf(hand, sizeof hand, "    hand: '%s'\n", line->equation);
    snprintf(text, sizeof text, line->scene, line->body == 0 ? hand : "", line->body == 1 ? hand : "");
    fbd_model *model = model_from(text);
    char *verdict = fbd_check_hand(model, 1, &differing);
    bool fine = verdict && (differing == 0) == line->right && !strstr(verdict, "not checked");
    if (!fine)
        print_error("%s should be %s:\n%s\n", line->equation, line->right ? "right" : "wrong", verdict);
    free(verdict);
    fbd_model_free(model);
    return fine ? 0 : 1;
}

static void forces_are_known_by_name_and_letter(void **unused)
{
    (void)unused;
    int failed = 0;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) failed += check(&lines[i]);
    assert_int_equal(failed, 0);
}

static void slips_are_named(void **unused)
{
    (void)unused;
    static const struct {
        const char *equation, *says;
    } slips[] = {
        {"T + f = m*a", "the summand `f` has the wrong sign"},
        {"T - 2*f = m*a", "the summand `2*f` is right with the factor 0.5"},
        {"T - f + N = m*a", "the summand `N` is one too many"},
        {"(T + f)/m = a", "`f` has the wrong sign"},
        {"2*(T + f) = 2*m*a", "`f` has the wrong sign"},
        {"T = m*a", "the component along x of `friction` is missing"},
        {"a = -f/m", "the component along x of `cord` is missing"},
        {"N - f = m*a", "wrong reaction: `N` stands where `T` belongs"},
        {"T - N = m*a", "wrong reaction: `N` stands where `f` belongs"},
    };
    for (size_t i = 0; i < sizeof slips / sizeof *slips; i++) {
        char text[2400], hand[400];
        size_t differing = 0;
        snprintf(hand, sizeof hand, "    hand: '%s'\n", slips[i].equation);
        snprintf(text, sizeof text, hoist, hand, "");
        fbd_model *model = model_from(text);
        char *verdict = fbd_check_hand(model, 1, &differing);
        assert_int_equal(differing, 1);
        assert_non_null(strstr(verdict, slips[i].says));
        free(verdict);
        fbd_model_free(model);
    }
}

/* What is called nothing there is told with what is. */
static void an_unknown_name_is_answered_with_the_forces(void **unused)
{
    (void)unused;
    char text[2400];
    fbd_errors *errors = fbd_errors_new();
    snprintf(text, sizeof text, hoist, "    hand: Q - f = m*a\n", "");
    fbd_model *model = fbd_model_parse(text, strlen(text), "model.yaml", NULL, 0, errors);
    assert_null(model);
    assert_int_equal(fbd_errors_count(errors), 1);
    fbd_error error = fbd_errors_get(errors, 0);
    assert_string_equal(error.id, "unknown-name");
    assert_int_equal(error.line, 10);
    assert_int_equal(error.column, 11);
    assert_non_null(strstr(error.hint, "friction.x"));
    assert_non_null(strstr(error.hint, "cord"));
    fbd_errors_free(errors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_are_known_by_name_and_letter),
        cmocka_unit_test(slips_are_named),
        cmocka_unit_test(an_unknown_name_is_answered_with_the_forces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
