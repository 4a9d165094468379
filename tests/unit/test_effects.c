/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Leaving an effect out of a scene gives the scene that is written without it; what cannot be left out says
 * why.
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fbd_study.h"
#include "gallery.h"

enum { times = 241 }; /* of the grid, as documented */

#define SCENE(BODY, UNTIL) "fbd: 1\nbodies:\n  b: {" BODY "}\nsimulate: {until: " UNTIL "}\n"

enum { most_quantities = 8 };

/* A motion on the grid: all coordinates, then all rates. */
struct motion_seen {
    size_t size;
    double y[times][most_quantities];
};

static void watch(const char *text, double until, struct motion_seen *seen)
{
    struct trial trial = trial_parse(text);
    size_t n = fbd_model_coordinate_count(trial.model);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = 1e-12;
    assert_true(2 * n <= most_quantities);
    seen->size = 2 * n;
    trial_start(&trial, &options);
    for (int k = 0; k < times; k++) {
        trial_to(&trial, until * k / (times - 1));
        for (size_t i = 0; i < n; i++) {
            fbd_coordinate coordinate = fbd_model_coordinate(trial.model, i);
            seen->y[k][i] = trial_get(&trial, coordinate.name);
            seen->y[k][n + i] = trial_get(&trial, coordinate.rate_name);
        }
    }
    trial_close(&trial);
}

/* The changes that fbd-cost would report between two scenes. */
static void differ(const char *with, const char *without, double until, double *largest, double *end)
{
    static struct motion_seen a, b;
    double scale[most_quantities] = {0};
    watch(with, until, &a);
    watch(without, until, &b);
    *largest = *end = 0;
    for (int k = 0; k < times; k++)
        for (size_t i = 0; i < a.size; i++) scale[i] = fmax(scale[i], fabs(a.y[k][i]));
    for (int k = 0; k < times; k++) {
        *end = 0;
        for (size_t i = 0; i < a.size; i++) *end = fmax(*end, fabs(a.y[k][i] - b.y[k][i]) / scale[i]);
        *largest = fmax(*largest, *end);
    }
}

struct study {
    fbd_model *model;
    fbd_errors *errors;
    fbd_effects *effects;
};

static struct study study(const char *text)
{
    struct study study = {.errors = fbd_errors_new()};
    fbd_cost_options options = FBD_COST_OPTIONS_DEFAULT;
    options.budget = 5;
    assert_non_null(study.errors);
    study.model = fbd_model_parse(text, strlen(text), "scene", NULL, 0, study.errors);
    assert_non_null(study.model);
    study.effects = fbd_effects_new(study.model, &options, study.errors);
    assert_non_null(study.effects);
    return study;
}

static void end_study(struct study *study)
{
    fbd_effects_free(study->effects);
    fbd_model_free(study->model);
    fbd_errors_free(study->errors);
}

/* The effect of this name whose change starts like that; ends the test when there is none. */
static fbd_effect find(const struct study *study, const char *name, const char *change)
{
    for (size_t i = 0; i < fbd_effects_count(study->effects); i++) {
        const fbd_effect effect = fbd_effects_get(study->effects, i);
        if (strcmp(effect.name, name) == 0 && strncmp(effect.change, change, strlen(change)) == 0)
            return effect;
    }
    fail_msg("no effect %s: %s", name, change);
    return (fbd_effect){0};
}

/* The row says what two scenes written by hand say. 1e-8: both are integrated, at 1e-11 and 1e-12. */
static void hold(struct checks *checks, const char *with, const char *without, double until, const char *name,
                 const char *change)
{
    struct study s = study(with);
    const fbd_effect effect = find(&s, name, change);
    double largest, end;
    differ(with, without, until, &largest, &end);
    check_that(checks, "there is no reason against it", effect.reason[0] == '\0');
    check_close(checks, name, effect.change_max, largest, 1e-8);
    check_close(checks, "at the end", effect.change_end, end, 1e-8);
    check_that(checks, "it was timed", effect.time > 0);
    end_study(&s);
}

#define BLOCK "mass: 2 kg, motion: {slide: {along: 30 deg}}, initial: {v: 3 m/s}"

static void a_force_left_out_is_a_scene_without_it(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    hold(&checks, SCENE(BLOCK ", forces: [gravity, {damper: {coefficient: 0.3}}]", "2 s"),
         SCENE(BLOCK ", forces: [gravity]", "2 s"), 2, "damper", "left out");
    hold(&checks, SCENE(BLOCK ", forces: [gravity, normal, {friction: {static: 0.5, kinetic: 0.4}}]", "2 s"),
         SCENE(BLOCK ", forces: [gravity, normal]", "2 s"), 2, "friction", "left out");
    checks_end(&checks);
}

static void a_spring_between_bodies_is_an_effect(void **unused)
{
#define JOINED(COUPLINGS)                                                                                    \
    "fbd: 1\nbodies:\n  a: {mass: 1 kg, motion: slide, initial: {v: 1 m/s}}\n  b: {mass: 2 kg, motion: "     \
    "slide, initial: {x: 1 m, v: 0.1 m/s}}\n" COUPLINGS "simulate: {until: 2 s}\n"
    struct checks checks = {0};
    (void)unused;
    hold(&checks,
         JOINED(
             "couplings:\n  - spring: {name: s1, between: [a.G, b.G], stiffness: 5 N/m, free_length: 1 m}\n"),
         JOINED(""), 2, "s1", "left out");
    checks_end(&checks);
}

static void a_pull_between_bodies_goes_with_its_reaction(void **unused)
{
#define DRAWN(FORCES)                                                                                        \
    "fbd: 1\nbodies:\n  a: {mass: 3 kg, motion: particle, initial: {vx: 0.5 m/s}}\n  b: {mass: 1 kg, "       \
    "motion: "                                                                                               \
    "particle, initial: {x: 2 m, vy: 1 m/s}" FORCES "}\nsimulate: {until: 2 s}\n"
    struct checks checks = {0};
    const char *with = DRAWN(", forces: [applied: {name: pull, value: '3[N*m^2]/distance^2', toward: a}]");
    (void)unused;
    hold(&checks, with, DRAWN(""), 2, "pull", "left out");
    struct study s = study(with);
    for (size_t i = 0; i < fbd_effects_count(s.effects); i++)
        check_that(&checks, "the reaction is no effect by itself",
                   strcmp(fbd_effects_get(s.effects, i).name, "b.pull") != 0);
    end_study(&s);
    checks_end(&checks);
}

static void wind_is_an_effect(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    hold(&checks, SCENE(BLOCK ", forces: [gravity, drag: {linear: 0.4, wind: ['2[m/s^2]*t', 1 m/s]}]", "2 s"),
         SCENE(BLOCK ", forces: [gravity, drag: {linear: 0.4}]", "2 s"), 2, "drag", "in still air");
    hold(&checks, SCENE(BLOCK ", forces: [gravity, drag: {quadratic: 0.4, wind: [3 m/s, 1 m/s]}]", "2 s"),
         SCENE(BLOCK ", forces: [gravity, drag: {quadratic: 0.4}]", "2 s"), 2, "drag", "in still air");
    checks_end(&checks);
}

/* A block that a growing push breaks loose: static friction decides when. */
static void static_friction_becomes_kinetic(void **unused)
{
#define PUSHED(COEFFICIENTS)                                                                                 \
    SCENE(                                                                                                   \
        "mass: 2 kg, motion: slide, forces: [gravity, normal, {applied: {name: push, value: '5[N/s]*t'}}, "  \
        "{friction: {" COEFFICIENTS "}}]",                                                                   \
        "4 s")
    struct checks checks = {0};
    (void)unused;
    hold(&checks, PUSHED("static: 0.6, kinetic: 0.4"), PUSHED("static: 0.4, kinetic: 0.4"), 4, "friction",
         "static as kinetic");
    struct study s = study(PUSHED("static: 0.4, kinetic: 0.4"));
    for (size_t i = 0; i < fbd_effects_count(s.effects); i++)
        check_that(&checks, "equal coefficients are no effect",
                   strncmp(fbd_effects_get(s.effects, i).change, "static", 6) != 0);
    end_study(&s);
    checks_end(&checks);
}

#define ROD               "rod: {shape: rod, mass: 0.8, from: [0, 0], to: [0, -1]}"
#define BOB               "bob: {shape: sphere, mass: 3, radius: 0.06, center: [0, -1.06]}"
#define HUNG(PARTS, REST) SCENE("motion: pivot, initial: {theta: 60 deg}, parts: {" PARTS "}" REST, "5 s")

static void the_mass_of_a_rod_goes_with_the_rod(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    hold(&checks, HUNG(ROD ", " BOB, ", forces: [gravity]"), HUNG(BOB, ", forces: [gravity]"), 5, "rod",
         "its mass");
    /* All mass in G: a point of 3.8 kg at (0.8 0.5 + 3 1.06) / 3.8 m. */
    hold(&checks, HUNG(ROD ", " BOB, ", forces: [gravity]"),
         HUNG("G0: {shape: point, mass: 3.8, center: [0, '-(0.8*0.5 + 3*1.06)/3.8']}", ", forces: [gravity]"),
         5, "I_G", "all its mass");
    checks_end(&checks);
}

static void gravity_is_linear_about_where_the_body_hangs(void **unused)
{
    /* k = m g L; the second body hangs at theta = -90 deg, and starts nearer to 270 deg. */
    struct checks checks = {0};
    (void)unused;
    hold(&checks,
         SCENE("mass: 2 kg, center: [0, -1 m], motion: pivot, initial: {theta: 60 deg}, forces: [gravity]",
               "5 s"),
         SCENE("mass: 2 kg, center: [0, -1 m], motion: pivot, initial: {theta: 60 deg}, "
               "moments: [{spring: {stiffness: 2*9.81}}]",
               "5 s"),
         5, "gravity", "linear");
    hold(&checks,
         SCENE("mass: 2 kg, center: [1 m, 0], motion: pivot, initial: {theta: 250 deg}, forces: [gravity]",
               "5 s"),
         SCENE("mass: 2 kg, center: [1 m, 0], motion: pivot, initial: {theta: 250 deg}, "
               "moments: [{spring: {stiffness: 2*9.81, neutral: 270 deg}}]",
               "5 s"),
         5, "gravity", "linear");
    checks_end(&checks);
}

static void quadratic_drag_becomes_linear_at_the_largest_speed(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    hold(&checks, SCENE(BLOCK ", forces: [{drag: {quadratic: 0.2}}]", "4 s"),
         SCENE(BLOCK ", forces: [{drag: {linear: 0.6}}]", "4 s"), 4, "drag", "linear"); /* 0.2 3 m/s */
    checks_end(&checks);
}

static void a_law_becomes_its_tangent_at_the_equilibrium(void **unused)
{
#define HARD(FORCE) SCENE("mass: 1 kg, motion: slide, initial: {x: 1}, forces: [" FORCE "]", "4 s")
    struct checks checks = {0};
    (void)unused;
    hold(&checks, HARD("{applied: {name: spring, value: '-4[N/m]*x - 3[N/m^3]*x^3'}}"),
         HARD("{applied: {name: spring, value: '-4[N/m]*x'}}"), 4, "spring", "linear");
    hold(&checks, HARD("{potential: {name: spring, V: '2[N/m]*x^2 + 0.75[N/m^3]*x^4'}}"),
         HARD("{potential: {name: spring, V: '2[N/m]*x^2'}}"), 4, "spring", "linear");
    checks_end(&checks);
}

/* How much the whole double pendulum, released from a straight line at an angle, differs from its
 * linearisation. */
static double linear_double_pendulum_differs(const char *angle)
{
    char text[600];
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n"
             "  one: {mass: 1, shape: rod, from: [0, 0], to: [0, -1], motion: pivot, initial: {theta: %s}, "
             "forces: [gravity]}\n"
             "  two: {mass: 1, shape: rod, from: [0, 0], to: [0, -1], motion: {pivot: {on: one, at: right, "
             "point: left}}, forces: [gravity]}\n"
             "simulate: {until: 3 s}\n",
             angle);
    struct study with = study(text);
    const fbd_effect all = find(&with, "all", "linear about the place of rest");
    assert_string_equal(all.body, "");
    assert_string_equal(all.reason, "");
    double change = all.change_max;
    assert_true(all.time > 0);
    end_study(&with);
    return change;
}

/* What the linearisation leaves out is of the third order: beside the motion it goes with the square of its
 * size. */
static void a_scene_of_joints_becomes_its_linearisation(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    double small = linear_double_pendulum_differs("0.01 rad"),
           large = linear_double_pendulum_differs("0.04 rad");
    check_that(&checks, "small swings are nearly linear", small > 1e-6 && small < 1e-3);
    check_close(&checks, "of second order", large / small, 16, 0.5);
    checks_end(&checks);
}

static void what_cannot_be_left_out_says_why(void **unused)
{
    (void)unused;
    struct study s = study(SCENE(BLOCK ", forces: [gravity, normal, {friction: 0.4}]", "1 s"));
    const fbd_effect normal = find(&s, "normal", "left out");
    assert_non_null(strstr(normal.reason, "`friction` needs it"));
    assert_true(isnan(normal.change_max) && isnan(normal.time));
    end_study(&s);
    s = study(SCENE(
        "shape: disc, mass: 2 kg, radius: 0.1, motion: {pivot: {point: G}}, moments: [{applied: {value: "
        "1 N*m}}]",
        "1 s"));
    assert_non_null(strstr(find(&s, "I_G", "all its mass").reason, "no moment of inertia"));
    end_study(&s);
    s = study(SCENE("mass: 1 kg, motion: slide, initial: {x: 1}, forces: [{applied: {value: "
                    "'-(x - 0.1[m]*sin(3[rad/s]*t))^3*1[N/m^3]'}}]",
                    "1 s"));
    assert_non_null(strstr(find(&s, "applied", "linear").reason, "depends on time"));
    end_study(&s);
}

/* Without gravity a block that is pulled up leaves its surface. */
static void a_scene_that_breaks_without_an_effect_says_so(void **unused)
{
    (void)unused;
    struct study s = study(SCENE("mass: 2 kg, motion: slide, initial: {v: 1}, forces: [gravity, normal, "
                                 "{applied: {name: lift, value: 5 N, angle: 90 deg}}, {friction: 0.2}]",
                                 "1 s"));
    assert_non_null(strstr(find(&s, "gravity", "left out").reason, "leaves its surface"));
    end_study(&s);
}

static void each_simplification_is_a_model(void **unused)
{
    (void)unused;
    const char text[] =
        SCENE("mass: 2 kg, motion: slide, initial: {v: 1 m/s}, forces: [drag: {quadratic: 0.5 kg/m}]", "1 s");
    const double t[] = {0, 0.1}, rows[] = {0, 1, 0.1, 3};
    const fbd_motion motion = {2, t, rows};
    struct trial trial = trial_parse(text);
    fbd_simplifications *list = fbd_simplify(trial.model, &motion, NULL);
    assert_int_equal(fbd_simplifications_count(list), 2);
    const double forces[] = {0, -0.5 * 3 * 1}; /* without drag, and with that which is linear up to 3 m/s */
    for (size_t i = 0; i < 2; i++) {
        fbd_simplification one = fbd_simplifications_get(list, i);
        assert_string_equal(one.body, "b");
        assert_string_equal(one.name, "drag");
        assert_string_equal(one.reason, "");
        fbd_model *simple = fbd_simplifications_model(list, i, NULL);
        fbd_state *state = fbd_state_new(simple);
        fbd_equations *equations = fbd_assemble(state);
        assert_float_equal(fbd_equations_get(equations, 0).sum, forces[i], 1e-12);
        fbd_equations_free(equations);
        fbd_state_free(state);
        fbd_model_free(simple);
    }
    fbd_simplifications_free(list);
    trial_close(&trial);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_force_left_out_is_a_scene_without_it),
        cmocka_unit_test(a_spring_between_bodies_is_an_effect),
        cmocka_unit_test(a_pull_between_bodies_goes_with_its_reaction),
        cmocka_unit_test(wind_is_an_effect),
        cmocka_unit_test(static_friction_becomes_kinetic),
        cmocka_unit_test(the_mass_of_a_rod_goes_with_the_rod),
        cmocka_unit_test(gravity_is_linear_about_where_the_body_hangs),
        cmocka_unit_test(quadratic_drag_becomes_linear_at_the_largest_speed),
        cmocka_unit_test(a_law_becomes_its_tangent_at_the_equilibrium),
        cmocka_unit_test(a_scene_of_joints_becomes_its_linearisation),
        cmocka_unit_test(what_cannot_be_left_out_says_why),
        cmocka_unit_test(each_simplification_is_a_model),
        cmocka_unit_test(a_scene_that_breaks_without_an_effect_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
