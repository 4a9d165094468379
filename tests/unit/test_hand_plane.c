/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies in the plane: forces along x and y and moments about G, against formulas written out by hand.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

static const double g = 9.81;

static void drag_couples_the_components_by_the_speed(void **unused)
{
    (void)unused;
    const double m = 0.45, c = 5e-3;
    static const double velocities[][2] = {{17, 17}, {-3, 20}, {12, -9}, {-0.5, -25}, {0, 8}};
    struct checks checks = {0};
    struct trial trial = trial_open("plane/projectile_with_drag.yaml", NULL);
    for (size_t i = 0; i < 5; i++) {
        double vx = velocities[i][0], vy = velocities[i][1], speed = sqrt(vx * vx + vy * vy);
        trial_set(&trial, "vx", vx);
        trial_set(&trial, "vy", vy);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"drag", -c * speed * vx}},
                                       .acceleration = -c / m * speed * vx});
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "y",
                                       .inertia = m,
                                       .terms = {{"gravity", -m * g}, {"drag", -c * speed * vy}},
                                       .acceleration = -g - c / m * speed * vy});
    }
    trial_close(&trial);
    checks_end(&checks);
}

static void a_spring_pulls_toward_its_point_or_pushes_off(void **unused)
{
    (void)unused;
    const double m = 1.2, k = 60, l0 = 0.8;
    static const double places[][2] = {{0.7, -0.7}, {-0.2, -1.5}, {0.3, 0.4}, {-0.1, -0.05}};
    struct checks checks = {0};
    struct trial trial = trial_open("plane/spring_pendulum.yaml", NULL);
    for (size_t i = 0; i < 4; i++) {
        double x = places[i][0], y = places[i][1], r = sqrt(x * x + y * y), pull = k * (r - l0);
        trial_set(&trial, "x", x);
        trial_set(&trial, "y", y);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"spring", -pull * x / r}},
                                       .acceleration = -pull * x / (r * m)});
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "y",
                                       .inertia = m,
                                       .terms = {{"gravity", -m * g}, {"spring", -pull * y / r}},
                                       .acceleration = -g - pull * y / (r * m)});
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* Three equations of a planar body at (x, y, theta, omega), given its forces and its moment about G. */
static void set_pose(struct trial *trial, const double pose[4])
{
    trial_set(trial, "x", pose[0]);
    trial_set(trial, "y", pose[1]);
    trial_set(trial, "theta", pose[2]);
    trial_set(trial, "omega", pose[3]);
}

static const double poses[][4] = {{0, 0.1, 0.1, 0},
                                  {0.3, -0.2, -0.7, 2},
                                  {-0.1, 0.25, 2.4, -5},
                                  {0.05, 0.4, -2.8, 1}};
enum { pose_count = sizeof poses / sizeof *poses };

static void weight_has_no_moment_about_the_centre_of_mass(void **unused)
{
    (void)unused;
    const double m = 0.6, I_G = 0.6 * 0.8 * 0.8 / 12;
    struct checks checks = {0};
    struct trial trial = trial_open("plane/thrown_rod.yaml", NULL);
    for (size_t i = 0; i < pose_count; i++) {
        set_pose(&trial, poses[i]);
        check_equation(&checks, &trial, &(fbd_expected){.coordinate = "x", .inertia = m});
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "y",
                                       .inertia = m,
                                       .terms = {{"gravity", -m * g}},
                                       .acceleration = -g});
        check_equation(&checks, &trial, &(fbd_expected){.coordinate = "theta", .inertia = I_G});
    }
    trial_close(&trial);
    checks_end(&checks);
}

struct pull {
    double fx, fy, moment;
};

/* A spring from the end of a bar, `arm` along it from G, to a point of the ground. */
static struct pull end_spring(const double pose[4], double arm, double ground_x, double ground_y, double k)
{
    const double l0 = 0.5;
    double rx = arm * cos(pose[2]), ry = arm * sin(pose[2]);
    double dx = pose[0] + rx - ground_x, dy = pose[1] + ry - ground_y, d = sqrt(dx * dx + dy * dy);
    double tension = k * (d - l0), fx = -tension * dx / d, fy = -tension * dy / d;
    return (struct pull){fx, fy, rx * fy - ry * fx};
}

static void springs_off_the_axis_have_moments(void **unused)
{
    (void)unused;
    const double m = 4, a = 0.6, h = 0.4, I_G = m * 4 * a * a / 12;
    struct checks checks = {0};
    struct trial trial = trial_open("plane/two_springs_off_axis.yaml", NULL);
    for (size_t i = 0; i < pose_count; i++) {
        set_pose(&trial, poses[i]);
        struct pull A = end_spring(poses[i], -a, -a, -h, 300), B = end_spring(poses[i], a, a, -h, 500);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"spring_A", A.fx}, {"spring_B", B.fx}},
                                       .acceleration = (A.fx + B.fx) / m});
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "y",
                                       .inertia = m,
                                       .terms = {{"gravity", -m * g}, {"spring_A", A.fy}, {"spring_B", B.fy}},
                                       .acceleration = (A.fy + B.fy) / m - g});
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "theta",
                                       .inertia = I_G,
                                       .terms = {{"spring_A", A.moment}, {"spring_B", B.moment}},
                                       .acceleration = (A.moment + B.moment) / I_G});
    }
    trial_close(&trial);
    checks_end(&checks);
}

static void a_jet_turns_with_its_body(void **unused)
{
    (void)unused;
    const double m = 1.5, F = 0.3, l = 1, c = 0.02, I_G = m * l * l / 12;
    struct checks checks = {0};
    struct trial trial = trial_open("plane/rod_with_jet.yaml", NULL);
    for (size_t i = 0; i < pose_count; i++) {
        double theta = poses[i][2], omega = poses[i][3];
        set_pose(&trial, poses[i]);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"jet", -F * sin(theta)}},
                                       .acceleration = -F / m * sin(theta)});
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "y",
                                       .inertia = m,
                                       .terms = {{"jet", F * cos(theta)}},
                                       .acceleration = F / m * cos(theta)});
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "theta",
                                       .inertia = I_G,
                                       .terms = {{"jet", F * l / 2}, {"damper", -c * omega}},
                                       .acceleration = (F * l / 2 - c * omega) / I_G});
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* The frame's origin is the left end of the rod here, G lies l/2 along it: the equations are those of G all
 * the same, and the acceleration of the origin follows from a_G = a_O + alpha k x r - omega^2 r. */
static void an_eccentric_frame_keeps_the_equations_of_its_centre_of_mass(void **unused)
{
    (void)unused;
    static const char text[] =
        "fbd: 1\n"
        "bodies:\n"
        "  rod:\n"
        "    shape: rod\n"
        "    mass: 2 kg\n"
        "    from: [0, 0]\n"
        "    to: [1.2 m, 0]\n"
        "    motion: planar\n"
        "    forces:\n"
        "      - gravity\n"
        "      - applied: {name: push, fx: 3 N, fy: -7 N, at: left}\n"
        "    hand:\n"
        "      - \"I_G*omega_dot = 7[N]*0.6[m]*cos(theta) + 3[N]*0.6[m]*sin(theta)\"\n";
    const double m = 2, arm = 0.6, I_G = 2 * 1.2 * 1.2 / 12;
    struct checks checks = {0};
    struct trial trial = trial_parse(text);
    for (size_t i = 0; i < pose_count; i++) {
        double c = cos(poses[i][2]), s = sin(poses[i][2]);
        double moment = -arm * c * -7 + arm * s * 3; /* (left - G) x f */
        set_pose(&trial, poses[i]);
        check_equation(
            &checks, &trial,
            &(fbd_expected){.coordinate = "x", .inertia = m, .terms = {{"push", 3}}, .acceleration = 3 / m});
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "y",
                                       .inertia = m,
                                       .terms = {{"gravity", -m * g}, {"push", -7}},
                                       .acceleration = -g - 7 / m});
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "theta",
                                       .inertia = I_G,
                                       .terms = {{"push", moment}},
                                       .acceleration = moment / I_G});
    }
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drag_couples_the_components_by_the_speed),
        cmocka_unit_test(a_spring_pulls_toward_its_point_or_pushes_off),
        cmocka_unit_test(weight_has_no_moment_about_the_centre_of_mass),
        cmocka_unit_test(springs_off_the_axis_have_moments),
        cmocka_unit_test(a_jet_turns_with_its_body),
        cmocka_unit_test(an_eccentric_frame_keeps_the_equations_of_its_centre_of_mass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
