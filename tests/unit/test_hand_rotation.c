/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies on an axis: inertia, moments, angular acceleration and pin forces against formulas written out by
 * hand (A05, A07, D03, D06).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_view.h"
#include "gallery.h"

static const double g = 9.81;

/* Angles on both sides of each quarter turn and rates of both signs: sin, cos and their signs all differ. */
static const double swings[][2] = {{0.3, 0}, {-1.1, 2}, {2.5, -3}, {-2.9, -0.4}, {7, 1.5}};
enum { swing_count = sizeof swings / sizeof *swings };

/* Sums of a few products, each rounded. */
static const double roundings = 1e-14;

static void set_swing(struct trial *trial, size_t i)
{
    trial_set(trial, "theta", swings[i][0]);
    trial_set(trial, "omega", swings[i][1]);
}

static void a_constant_moment_turns_a_disc_about_its_centre(void **unused)
{
    (void)unused;
    const double I_O = 8 * 0.35 * 0.35 / 2;
    struct checks checks = {0};
    struct trial trial = trial_open("rotation/fixed_axis.yaml", NULL);
    for (size_t i = 0; i < swing_count; i++) {
        set_swing(&trial, i);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "theta",
                                       .inertia = I_O,
                                       .terms = {{"drive", 3}},
                                       .acceleration = 3 / I_O});
    }
    check_close(&checks, "L", fbd_model_inertia(trial.model, 0).L, 0, 0);
    trial_close(&trial);
    checks_end(&checks);
}

static void bearing_friction_opposes_the_spin_or_holds(void **unused)
{
    (void)unused;
    const double I_O = 0.49;
    static const double states[][4] = {/* t, omega, drive, brake */
                                       {1, 5, 3, 0},
                                       {3, 5, 0, -0.5},
                                       {3, -5, 0, 0.5},
                                       {3, 0, 0, 0}};
    struct checks checks = {0};
    struct trial trial = trial_open("rotation/bearing_friction.yaml", NULL);
    for (size_t i = 0; i < 4; i++) {
        double drive = states[i][2], brake = states[i][3];
        trial_set(&trial, "t", states[i][0]);
        trial_set(&trial, "omega", states[i][1]);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "theta",
                                       .inertia = I_O,
                                       .terms = {{"drive", drive}, {"brake", brake}},
                                       .acceleration = (drive + brake) / I_O});
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* The pin makes G go round: along the rod -m (l/2) omega^2, across it m (l/2) alpha. */
static void the_pin_of_a_driven_rod_carries_its_centre_round(void **unused)
{
    (void)unused;
    const double m = 3, l = 1.2, I_O = m * l * l / 3, alpha = 3 / I_O;
    struct checks checks = {0};
    struct trial trial = trial_open("rotation/rod_in_horizontal_plane.yaml", NULL);
    for (size_t i = 0; i < swing_count; i++) {
        double theta = swings[i][0], omega = swings[i][1];
        double along = -m * l / 2 * omega * omega, across = m * l / 2 * alpha;
        set_swing(&trial, i);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "theta",
                                       .inertia = I_O,
                                       .terms = {{"drive", 3}},
                                       .acceleration = alpha});
        fbd_arrow pin = trial_arrow(&trial, "pin");
        double size = fabs(along) + fabs(across);
        check_close(&checks, "pin fx", pin.fx, along * cos(theta) - across * sin(theta), roundings * size);
        check_close(&checks, "pin fy", pin.fy, along * sin(theta) + across * cos(theta), roundings * size);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* A pendulum whose G is L below the axis at theta = 0, with what else turns it: I_O alpha = -m g L sin(theta)
 * + extra. Its pin holds m (a_G - g):
 *     R_x =       m L (alpha cos(theta) - omega^2 sin(theta))
 *     R_y = m g + m L (alpha sin(theta) + omega^2 cos(theta)) */
struct pendulum {
    double m, L, I_O;
    const char *extra;
    double damping; /* extra = -damping omega */
};

static void check_pendulum(struct checks *checks, struct trial *trial, const struct pendulum *p)
{
    fbd_inertia inertia = fbd_model_inertia(trial->model, 0);
    check_close(checks, "m", inertia.mass, p->m, roundings * p->m);
    check_close(checks, "I_O", inertia.I_O, p->I_O, roundings * p->I_O);
    check_close(checks, "I_G", inertia.I_G, p->I_O - p->m * p->L * p->L, roundings * p->I_O);
    check_close(checks, "L", inertia.L, p->L, roundings * p->L);
    for (size_t i = 0; i < swing_count; i++) {
        double theta = swings[i][0], omega = swings[i][1], s = sin(theta), c = cos(theta);
        double alpha = -(p->m * g * p->L * s + p->damping * omega) / p->I_O;
        set_swing(trial, i);
        check_equation(checks, trial,
                       &(fbd_expected){.coordinate = "theta",
                                       .inertia = p->I_O,
                                       .terms = {{"gravity", -p->m * g * p->L * s},
                                                 {p->extra, -p->damping * omega}},
                                       .acceleration = alpha});
        fbd_arrow pin = trial_arrow(trial, "pin");
        double size = p->m * (g + p->L * (fabs(alpha) + omega * omega));
        check_close(checks, "pin fx", pin.fx, p->m * p->L * (alpha * c - omega * omega * s),
                    roundings * size);
        check_close(checks, "pin fy", pin.fy, p->m * g + p->m * p->L * (alpha * s + omega * omega * c),
                    roundings * size);
    }
}

static void the_compound_pendulum_has_rod_and_bob_by_the_parallel_axes(void **unused)
{
    (void)unused;
    const double m_R = 0.8, L_R = 1, m_C = 3, R = 0.06, L_C = 1.06, m = m_R + m_C;
    double rod = m_R * L_R * L_R / 12 + m_R * (L_R / 2) * (L_R / 2);
    double bob = 2 * m_C * R * R / 5 + m_C * L_C * L_C;
    struct checks checks = {0};
    struct trial trial = trial_open("rotation/compound_pendulum.yaml", NULL);
    check_pendulum(&checks, &trial,
                   &(struct pendulum){m, (m_R * L_R / 2 + m_C * L_C) / m, rod + bob, NULL, 0});
    trial_close(&trial);
    trial = trial_open("rotation/compound_pendulum.yaml", SET("m_R=0")); /* the rod neglected */
    check_pendulum(&checks, &trial, &(struct pendulum){m_C, L_C, bob, NULL, 0});
    trial_close(&trial);
    trial = trial_open("rotation/pendulum_light_rod.yaml", NULL);
    check_pendulum(&checks, &trial, &(struct pendulum){m_C, L_C, bob, NULL, 0});
    trial_close(&trial);
    checks_end(&checks);
}

static void the_simple_pendulum_is_the_same_for_every_mass(void **unused)
{
    (void)unused;
    static const char *const settings[] = {"bob_mass=0.02", "bob_mass=3", "bob_mass=700"};
    static const double masses[] = {0.02, 3, 700};
    const double L = 1.06;
    struct checks checks = {0};
    for (size_t k = 0; k < 3; k++) {
        struct trial trial = trial_open("rotation/simple_pendulum.yaml", SET(settings[k]));
        check_pendulum(&checks, &trial, &(struct pendulum){masses[k], L, masses[k] * L * L, NULL, 0});
        for (size_t i = 0; i < swing_count; i++) {
            set_swing(&trial, i);
            double want = -g / L * sin(swings[i][0]);
            check_close(&checks, "omega_dot = -g/L sin(theta)", trial_acceleration(&trial, "theta"), want,
                        roundings * g / L);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void a_rod_swings_about_its_end_at_any_size(void **unused)
{
    (void)unused;
    static const char *const lengths[] = {"length=1e-6 m", "length=1 m", "length=1e6 m"};
    static const char *const weights[] = {"rod_mass=1e-9 kg", "rod_mass=1 kg", "rod_mass=1e12 kg"};
    static const double l[] = {1e-6, 1, 1e6}, m[] = {1e-9, 1, 1e12};
    struct checks checks = {0};
    for (size_t k = 0; k < 3; k++) {
        struct trial trial = trial_open("rotation/rod_pendulum.yaml", SET(lengths[k], weights[k]));
        check_pendulum(&checks, &trial, &(struct pendulum){m[k], l[k] / 2, m[k] * l[k] * l[k] / 3, NULL, 0});
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void a_viscous_bearing_adds_a_moment_against_the_spin(void **unused)
{
    (void)unused;
    const double m = 2.5, I_O = 0.5 / 3 + 2, L = (0.5 * 0.5 + 2) / m;
    struct checks checks = {0};
    struct trial trial = trial_open("rotation/damped_pendulum.yaml", NULL);
    check_pendulum(&checks, &trial, &(struct pendulum){m, L, I_O, "bearing", 0.5});
    trial_close(&trial);
    checks_end(&checks);
}

static void a_twisted_wire_turns_the_disc_back(void **unused)
{
    (void)unused;
    const double I_O = 2 * 0.1 * 0.1 / 2, k = 0.9, c = 0.006;
    struct checks checks = {0};
    struct trial trial = trial_open("rotation/torsional_pendulum.yaml", NULL);
    for (size_t i = 0; i < swing_count; i++) {
        double theta = swings[i][0], omega = swings[i][1];
        set_swing(&trial, i);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "theta",
                                       .inertia = I_O,
                                       .terms = {{"wire", -k * theta}, {"damper", -c * omega}},
                                       .acceleration = -k / I_O * theta - c / I_O * omega});
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* theta from the upright: gravity drives it away, and the bar pushes where it stands and pulls where it
 * hangs. */
static void next_to_the_upright_gravity_drives_the_pendulum_away(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("rotation/near_upright.yaml", NULL);
    for (size_t i = 0; i < swing_count; i++) {
        double theta = swings[i][0], omega = swings[i][1];
        set_swing(&trial, i);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "theta",
                                       .inertia = 1,
                                       .terms = {{"gravity", g * sin(theta)}},
                                       .acceleration = g * sin(theta)});
        fbd_arrow pin = trial_arrow(&trial, "pin");
        /* Along the bar, outward: m (g cos(theta) - omega^2 L). */
        double outward = -pin.fx * sin(theta) + pin.fy * cos(theta);
        check_close(&checks, "bar force", outward, g * cos(theta) - omega * omega,
                    roundings * (g + omega * omega));
    }
    trial_close(&trial);
    checks_end(&checks);
}

static void a_plate_lacks_what_its_hole_had(void **unused)
{
    (void)unused;
    const double M = 3, s = 0.4, R = 0.08, d = 0.4, pi = 3.14159265358979323846;
    double M_h = M * pi * R * R / (s * s), m = M - M_h, mL = M * s / sqrt(2) - M_h * d;
    double I_O = M * s * s / 6 + M * s * s / 2 - M_h * (R * R / 2 + d * d);
    struct checks checks = {0};
    struct trial trial = trial_open("plane/plate_with_hole.yaml", NULL);
    check_pendulum(&checks, &trial, &(struct pendulum){m, mL / m, I_O, NULL, 0});
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_moment_turns_a_disc_about_its_centre),
        cmocka_unit_test(bearing_friction_opposes_the_spin_or_holds),
        cmocka_unit_test(the_pin_of_a_driven_rod_carries_its_centre_round),
        cmocka_unit_test(the_compound_pendulum_has_rod_and_bob_by_the_parallel_axes),
        cmocka_unit_test(the_simple_pendulum_is_the_same_for_every_mass),
        cmocka_unit_test(a_rod_swings_about_its_end_at_any_size),
        cmocka_unit_test(a_viscous_bearing_adds_a_moment_against_the_spin),
        cmocka_unit_test(a_twisted_wire_turns_the_disc_back),
        cmocka_unit_test(next_to_the_upright_gravity_drives_the_pendulum_away),
        cmocka_unit_test(a_plate_lacks_what_its_hole_had),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
