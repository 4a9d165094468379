/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What `--check-hand` says of derivations with the slips that are made on paper.
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

static const char block[] = "fbd: 1\n"
                            "parameters: {phi: 30 deg, f1: 5 N, mu: 0.5, k: 3 N/m, M: 2 kg}\n"
                            "bodies:\n"
                            "  block:\n"
                            "    mass: M\n"
                            "    motion: {slide: {along: phi}}\n"
                            "    initial: {v: 3 m/s}\n"
                            "    forces:\n"
                            "      - gravity\n"
                            "      - normal\n"
                            "      - friction: {static: mu, kinetic: mu}\n"
                            "      - applied: {name: push, value: f1}\n"
                            "      - spring: {stiffness: k}\n"
                            "    hand: '%s'\n"
                            "simulate: {until: 2 s}\n";

static const char pendulum[] = "fbd: 1\n"
                               "parameters: {c: 0.3 N*m*s}\n"
                               "bodies:\n"
                               "  bob:\n"
                               "    motion: {pivot: {at: [0, 0]}}\n"
                               "    parts:\n"
                               "      rod: {shape: rod, mass: 0.5 kg, from: [0, 0], to: [0, -1 m]}\n"
                               "      bob: {shape: point, mass: 2 kg, center: [0, -1 m]}\n"
                               "    initial: {theta: 60 deg}\n"
                               "    forces: [gravity]\n"
                               "    moments: [{damper: {coefficient: c}}]\n"
                               "    hand: '%s'\n"
                               "simulate: {until: 2 s}\n";

struct slip_of_the_pen {
    const char *scene, *equation;
    const char *says; /* up to three phrases, separated by | */
};

static const struct slip_of_the_pen slips[] = {
    {block, "m*v_dot = f1 + m*g*sin(phi) - mu*m*g*cos(phi)*sign(v) - k*x",
     "the term `gravity` has the wrong sign"},
    {block, "m*v_dot = f1 - m*g*sin(phi) - 2*mu*m*g*cos(phi)*sign(v) - k*x",
     "the term `friction` is off by a factor 2: the equation has twice of it"},
    {block, "m*v_dot = f1 - m*g*cos(phi) - mu*m*g*cos(phi)*sign(v) - k*x",
     "sine and cosine are exchanged in the term `gravity`"},
    {block, "m*v_dot = f1 - mu*m*g*cos(phi)*sign(v) - k*x", "the term `gravity` is missing"},
    {block, "m*v_dot*1e-310 = 7*f1 - m*g*sin(phi) - k*x",
     "differs at 288"}, /* over that inertia both overflow */
    {block, "m*v_dot = f1 - m*g*sin(phi) - mu*m*g*sign(v) - k*x",
     "`friction` differs from that of the equation, `-mu*m*g*sign(v)`|the factor cos(along) is missing"},
    {block, "m*v_dot + k*x = f1*cos(phi) - m*g*sin(phi) - mu*m*g*cos(phi)*sign(v)",
     "`push` differs from that of the equation, `f1*cos(phi)`|the factor cos(along) is too many"},
    {block, "v_dot = f1/m - m*g*sin(phi)/1[kg] - mu*g*cos(phi)*sign(v) - k*x/m",
     "`-m*g*sin(phi)/1[kg]`|the factor m is too many"},
    {block, "m*v_dot = f1 - m*g*cos(phi) - mu*m*g*sin(phi)*sign(v) - k*x",
     "it has cos(along) where sin(along) belongs|it has sin(along) where cos(along) belongs"},
    {block, "m*v_dot = f1 - m*g*sin(phi) - mu*m*g*sign(v) + k*x",
     "the factor cos(along) is missing|`spring` differs from that of the equation, `k*x`|its sign is "
     "wrong"},
    {block, "v_dot = f1/m - g*sin(phi) - mu*g*cos(phi)*sign(v) - k*x/m + 1[m/s^2]",
     "`1[m/s^2]` is no force that the body lists"},
    {block, "m*v_dot = f1 - m*g*sin(phi) - f1 - mu*m*g*cos(phi)*sign(v)",
     "`-f1` cancels a term of the equation|the term `spring` is missing"},
    {block, "m*v_dot = (f1 + 2*f1)/3 - m*g*sin(phi) - mu*m*g*cos(phi)*sign(v) - k*x - k*x - f1/7",
     "`-k*x` is counted twice|`-f1/7`"},
    {pendulum, "I_G*alpha = -m*g*L*sin(theta) - c*omega", "wrong reference point"},
    {pendulum, "m*L^2*alpha = -m*g*L*sin(theta) - c*omega", "that of a point mass"},
    {pendulum, "I_O*alpha = -m*g*1[m]*sin(theta) - c*omega", "the moment arm is missing: the term `gravity`"},
    {pendulum, "I_O*alpha = -m*g*L*theta - c*omega", "it has theta where sin(theta) belongs"},
    {pendulum, "I_O*alpha = -m*g*L - c*omega", "the factor sin(theta) is missing"},
    {pendulum, "I_O*alpha = -m*g*L*sin(theta) - c*theta*1[1/s]", "it has theta where omega belongs"},
    {pendulum, "I_O*alpha = -m*g*L*sin(theta) - c*omega^2*1[s]", "the factor omega is too many"},
    {pendulum, "alpha = 0", "the term `gravity` is missing|the term `damper` is missing"},
};

static bool says_all(const char *verdict, const char *phrases)
{
    for (const char *phrase = phrases; *phrase;) {
        char one[160];
        size_t length = strcspn(phrase, "|");
        snprintf(one, sizeof one, "%.*s", (int)length, phrase);
        if (!strstr(verdict, one)) return false;
        phrase += length + (phrase[length] == '|');
    }
    return true;
}

static char *verdict_of(const char *scene, const char *equation, int *wrong)
{
    char text[1600];
    size_t differing;
    snprintf(text, sizeof text, scene, equation);
    fbd_model *model = model_from(text);
    char *verdict = fbd_check_hand(model, 1, &differing);
    *wrong = (int)differing;
    fbd_model_free(model);
    assert_non_null(verdict);
    return verdict;
}

static void slips_are_named(void **unused)
{
    (void)unused;
    int failed = 0;
    for (size_t i = 0; i < sizeof slips / sizeof *slips; i++) {
        int wrong;
        char *verdict = verdict_of(slips[i].scene, slips[i].equation, &wrong);
        if (wrong != 1 || !says_all(verdict, slips[i].says)) {
            print_error("expected `%s` in:\n%s", slips[i].says, verdict);
            failed++;
        }
        free(verdict);
    }
    assert_int_equal(failed, 0);
}

/* Terms in another order, on the other side, put together or taken apart are no slips. */
static void right_derivations_pass_however_they_are_written(void **unused)
{
    (void)unused;
    static const struct slip_of_the_pen right[] = {
        {block, "m*v_dot = f1 - m*g*sin(phi) - mu*m*g*cos(phi)*sign(v) - k*x", ""},
        {block, "0 = f1 - m*v_dot - (m*g*sin(phi) + k*x) - mu*N*sign(v)", ""},
        {block, "-k*x/m - v_dot = g*(sin(phi) + mu*cos(phi)*sign(v)) - f1/(2*m) - 0.5*f1/m", ""},
        {pendulum, "alpha + c*omega/I_O = -(m*g*L/I_O)*sin(theta)", ""},
        {pendulum, "(I_G + m*L^2)*alpha = -m*g*L*sin(theta) - c*omega", ""},
    };
    for (size_t i = 0; i < sizeof right / sizeof *right; i++) {
        int wrong;
        free(verdict_of(right[i].scene, right[i].equation, &wrong));
        assert_int_equal(wrong, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slips_are_named),
        cmocka_unit_test(right_derivations_pass_however_they_are_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
