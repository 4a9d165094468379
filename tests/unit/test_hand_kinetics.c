/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies on a line: the assembled equations against Newton's law written out by hand (A01 to A04).
 *
 * Every formula is evaluated at several states on both sides of zero, with angles and forces that make no two
 * terms equal, so that a wrong sign, a sine for a cosine or a lost factor cannot hide.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

static const double DEG = 3.14159265358979323846 / 180;

static double sign(double v)
{
    return v > 0 ? 1 : v < 0 ? -1 : 0;
}

static void a_dropped_object_feels_its_weight_wherever_x_is_counted_from(void **unused)
{
    (void)unused;
    static const char *const files[] = {"kinetics/drop_us.yaml", "kinetics/drop_us_from_platform.yaml"};
    static const double states[][2] = {{30, 0}, {20, -5}, {0, -35}, {-4, 12}};
    struct checks checks = {0};
    for (size_t f = 0; f < 2; f++) {
        struct trial trial = trial_open(files[f], NULL);
        for (size_t i = 0; i < 4; i++) {
            trial_set(&trial, "x", states[i][0]);
            trial_set(&trial, "v", states[i][1]);
            check_equation(&checks, &trial,
                           &(fbd_expected){.coordinate = "x",
                                           .inertia = 2,
                                           .terms = {{"gravity", -2 * 32.2}},
                                           .acceleration = -32.2});
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void equations_carry_the_units_of_their_system(void **unused)
{
    (void)unused;
    static const char *const files[] = {"kinetics/drop_us.yaml", "kinetics/incline.yaml",
                                        "rotation/compound_pendulum.yaml"};
    static const char *const words[][6] = {
        {"m", "slug", "lbf", "v_dot", "ft/s^2", "x"},
        {"m", "kg", "N", "v_dot", "m/s^2", "x"},
        {"I_O", "kg*m^2", "N*m", "omega_dot", "rad/s^2", "theta"},
    };
    for (size_t f = 0; f < 3; f++) {
        struct trial trial = trial_open(files[f], NULL);
        fbd_equations *all = fbd_assemble(trial.state);
        assert_non_null(all);
        assert_int_equal(fbd_equations_count(all), 1);
        const fbd_equation equation = fbd_equations_get(all, 0);
        assert_string_equal(equation.inertia_name, words[f][0]);
        assert_string_equal(equation.inertia_unit, words[f][1]);
        assert_string_equal(equation.unit, words[f][2]);
        assert_string_equal(equation.acceleration_name, words[f][3]);
        assert_string_equal(equation.acceleration_unit, words[f][4]);
        assert_string_equal(equation.coordinate, words[f][5]);
        fbd_equations_free(all);
        trial_close(&trial);
    }
}

static void quadratic_drag_opposes_the_velocity_either_way(void **unused)
{
    (void)unused;
    const double m = 0.4, g = 9.81, c = 0.01;
    static const double speeds[] = {-19, -1, 0, 7};
    struct checks checks = {0};
    struct trial trial = trial_open("kinetics/falling_with_drag.yaml", NULL);
    for (size_t i = 0; i < 4; i++) {
        double v = speeds[i];
        trial_set(&trial, "v", v);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"gravity", -m * g}, {"drag", -c * fabs(v) * v}},
                                       .acceleration = -g - c * fabs(v) * v / m});
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* A block of mass m on the flat, pulled by f1 at `angle` above +x, at velocity v. */
static void check_flat(struct checks *checks, struct trial *trial, double f1, double angle, double v)
{
    const double m = 5, g = 9.81, mu_s = 0.5, mu_k = 0.4;
    double push = f1 * cos(angle), N = m * g - f1 * sin(angle);
    double friction = -mu_k * N * sign(v);
    if (v == 0) friction = fabs(push) <= mu_s * N ? -push : -mu_k * N * sign(push);
    bool held = v == 0 && friction == -push;
    trial_set(trial, "v", v);
    check_equation(checks, trial,
                   &(fbd_expected){.coordinate = "x",
                                   .inertia = m,
                                   .terms = {{"push", push}, {"friction", friction}},
                                   .acceleration = held ? 0 : push / m + friction / m,
                                   .normal = N});
}

static void friction_on_the_flat_holds_or_opposes(void **unused)
{
    (void)unused;
    static const struct {
        const char *f1, *angle;
        double newton, degrees;
    } pushes[] = {{"f1=20", "angle=0 deg", 20, 0},     {"f1=30", "angle=0 deg", 30, 0},
                  {"f1=-30", "angle=0 deg", -30, 0},   {"f1=30", "angle=20 deg", 30, 20},
                  {"f1=30", "angle=-20 deg", 30, -20}, {"f1=30", "angle=160 deg", 30, 160}};
    static const double speeds[] = {-3, 0, 0.25};
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof pushes / sizeof *pushes; i++) {
        struct trial trial = trial_open("kinetics/flat_coulomb.yaml", SET(pushes[i].f1, pushes[i].angle));
        for (size_t k = 0; k < 3; k++)
            check_flat(&checks, &trial, pushes[i].newton, pushes[i].degrees * DEG, speeds[k]);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void a_push_that_ends_leaves_friction_alone(void **unused)
{
    (void)unused;
    const double m = 5, g = 9.81, mu_k = 0.4, f1 = 30;
    static const double states[][2] = {{0.5, 1}, {1.9, 4}, {2.1, 4}, {2.5, -1}};
    struct checks checks = {0};
    struct trial trial = trial_open("kinetics/flat_push_ends.yaml", NULL);
    for (size_t i = 0; i < 4; i++) {
        double t = states[i][0], v = states[i][1], push = t < 2 ? f1 : 0;
        trial_set(&trial, "t", t);
        trial_set(&trial, "v", v);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"push", push}, {"friction", -mu_k * m * g * sign(v)}},
                                       .acceleration = push / m - mu_k * g * sign(v),
                                       .normal = m * g});
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* m v_dot = f1 - m g sin(phi) - mu_k m g cos(phi) sign(v); at rest friction is what holds, up to mu_s N. */
static void check_incline(struct checks *checks, struct trial *trial, double phi, double f1, double mu_s,
                          double mu_k, double v)
{
    const double m = 2, g = 9.81;
    double N = m * g * cos(phi), along = f1 - m * g * sin(phi);
    double friction = -mu_k * N * sign(v), acceleration = f1 / m - g * (sin(phi) + mu_k * cos(phi) * sign(v));
    if (v == 0 && fabs(along) <= mu_s * N) friction = -along, acceleration = 0;
    if (v == 0 && fabs(along) > mu_s * N) {
        friction = -mu_k * N * sign(along);
        acceleration = along / m - mu_k * g * cos(phi) * sign(along);
    }
    trial_set(trial, "v", v);
    check_equation(
        checks, trial,
        &(fbd_expected){.coordinate = "x",
                        .inertia = m,
                        .terms = {{"gravity", -m * g * sin(phi)}, {"friction", friction}, {"push", f1}},
                        .acceleration = acceleration,
                        .normal = N});
}

static void the_incline_splits_the_weight_and_friction_opposes(void **unused)
{
    (void)unused;
    static const struct {
        const char *phi, *f1;
        double degrees, newton;
    } variants[] = {{"phi=30 deg", "f1=50", 30, 50},
                    {"phi=30 deg", "f1=5", 30, 5},
                    {"phi=30 deg", "f1=-20", 30, -20},
                    {"phi=-20 deg", "f1=1", -20, 1},
                    {"phi=57 deg", "f1=0", 57, 0}};
    static const double speeds[] = {3, -1.5, 0};
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof variants / sizeof *variants; i++) {
        struct trial trial = trial_open("kinetics/incline.yaml", SET(variants[i].phi, variants[i].f1));
        for (size_t k = 0; k < 3; k++)
            check_incline(&checks, &trial, variants[i].degrees * DEG, variants[i].newton, 0.5, 0.5,
                          speeds[k]);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Without a push the incline has no term of that name. */
static void a_block_that_cannot_be_held_slides_back(void **unused)
{
    (void)unused;
    const double m = 2, g = 9.81, mu_k = 0.2, phi = 30 * DEG;
    static const double speeds[] = {3, 0, -2};
    struct checks checks = {0};
    struct trial trial = trial_open("kinetics/incline_slides_back.yaml", NULL);
    for (size_t i = 0; i < 3; i++) {
        double up = speeds[i] > 0 ? 1 : -1, N = m * g * cos(phi);
        trial_set(&trial, "v", speeds[i]);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"gravity", -m * g * sin(phi)},
                                                 {"friction", -mu_k * N * up}},
                                       .acceleration = -g * (sin(phi) + up * mu_k * cos(phi)),
                                       .normal = N});
    }
    trial_close(&trial);
    checks_end(&checks);
}

static double ramp(double t)
{
    return 4 * t;
}

static double ramp_up_and_down(double t)
{
    return t < 5 ? 4 * t : 20 - 8 * (t - 5);
}

static void check_ramp(struct checks *checks, const char *file, double (*force)(double))
{
    const double m = 2, g = 9.81, mu_s = 0.6, mu_k = 0.4;
    static const double states[][2] = {{1, 0}, {2.9, 0}, {2.95, 0}, {4, 1}, {6, -2}, {9, 3}, {10, 0}};
    struct trial trial = trial_open(file, NULL);
    for (size_t i = 0; i < sizeof states / sizeof *states; i++) {
        double t = states[i][0], v = states[i][1], pull = force(t), N = m * g;
        bool held = v == 0 && fabs(pull) <= mu_s * N;
        double friction = held ? -pull : -mu_k * N * sign(v != 0 ? v : pull);
        trial_set(&trial, "t", t);
        trial_set(&trial, "v", v);
        check_equation(checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"pull", pull}, {"friction", friction}},
                                       .acceleration = held ? 0 : (pull + friction) / m,
                                       .normal = N});
    }
    trial_close(&trial);
}

static void a_ramped_force_is_held_until_the_static_limit(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    check_ramp(&checks, "kinetics/ramp_breakaway.yaml", ramp);
    check_ramp(&checks, "kinetics/ramp_up_and_down.yaml", ramp_up_and_down);
    checks_end(&checks);
}

/* On a slope of 15 deg a pull that grows with time, 50 deg above the horizontal: 35 deg above the slope. */
static void an_oblique_pull_that_varies_loads_and_unloads_the_surface(void **unused)
{
    (void)unused;
    static const char text[] = "fbd: 1\n"
                               "bodies:\n"
                               "  block:\n"
                               "    mass: 3 kg\n"
                               "    motion: {slide: {along: 15 deg}}\n"
                               "    forces:\n"
                               "      - gravity\n"
                               "      - normal\n"
                               "      - friction: {static: 0.4, kinetic: 0.25}\n"
                               "      - applied: {name: pull, value: \"2[N/s]*t\", angle: 50 deg}\n";
    const double m = 3, g = 9.81, slope = 15 * DEG, above = 35 * DEG;
    static const double states[][2] = {{1, 2}, {6, 0.5}, {4, -1}, {10, -0.1}};
    struct checks checks = {0};
    struct trial trial = trial_parse(text);
    for (size_t i = 0; i < 4; i++) {
        double pull = 2 * states[i][0], v = states[i][1];
        double N = m * g * cos(slope) - pull * sin(above), friction = -0.25 * N * sign(v);
        double along = pull * cos(above), weight = -m * g * sin(slope);
        trial_set(&trial, "t", states[i][0]);
        trial_set(&trial, "v", v);
        check_equation(
            &checks, &trial,
            &(fbd_expected){.coordinate = "x",
                            .inertia = m,
                            .terms = {{"gravity", weight}, {"friction", friction}, {"pull", along}},
                            .acceleration = pull / m * (cos(above) + 0.25 * sin(above) * sign(v)) -
                                            g * (sin(slope) + 0.25 * cos(slope) * sign(v)),
                            .normal = N});
    }
    trial_close(&trial);
    checks_end(&checks);
}

static void the_diagram_of_the_incline_balances_across_it(void **unused)
{
    (void)unused;
    const double m = 2, g = 9.81, phi = 30 * DEG, N = m * g * cos(phi), slip = 0.5 * N;
    struct checks checks = {0};
    struct trial trial = trial_open("kinetics/incline.yaml", NULL);
    const struct {
        const char *name;
        double fx, fy;
    } want[] = {{"gravity", 0, -m * g},
                {"normal", -N * sin(phi), N * cos(phi)},
                {"friction", -slip * cos(phi), -slip * sin(phi)},
                {"push", 5 * cos(phi), 5 * sin(phi)}};
    const double rounding = 1e-14 * m * g; /* of components of forces of the size of the weight */
    for (size_t i = 0; i < 4; i++) {
        fbd_arrow arrow = trial_arrow(&trial, want[i].name);
        check_close(&checks, want[i].name, arrow.fx, want[i].fx, rounding);
        check_close(&checks, want[i].name, arrow.fy, want[i].fy, rounding);
    }
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_dropped_object_feels_its_weight_wherever_x_is_counted_from),
        cmocka_unit_test(equations_carry_the_units_of_their_system),
        cmocka_unit_test(quadratic_drag_opposes_the_velocity_either_way),
        cmocka_unit_test(friction_on_the_flat_holds_or_opposes),
        cmocka_unit_test(a_push_that_ends_leaves_friction_alone),
        cmocka_unit_test(the_incline_splits_the_weight_and_friction_opposes),
        cmocka_unit_test(a_block_that_cannot_be_held_slides_back),
        cmocka_unit_test(a_ramped_force_is_held_until_the_static_limit),
        cmocka_unit_test(an_oblique_pull_that_varies_loads_and_unloads_the_surface),
        cmocka_unit_test(the_diagram_of_the_incline_balances_across_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
