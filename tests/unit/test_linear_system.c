/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linear systems with inputs and outputs against closed forms: matrices, poles, zeros, gains and frequency responses.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fbd_linear.h"
#include "gallery.h"
#include "looked.h"

/* ---- a system of a text */

struct system {
    struct looked looked;
    fbd_linear_system *system;
};

static struct system open_system(const char *text, const char *const *outputs, size_t count)
{
    struct system system = {.looked = look(text)};
    const fbd_linear_plan plan = {.size = sizeof plan, .outputs = outputs, .output_count = count};
    assert_non_null(system.looked.linear);
    system.system = fbd_linear_system_new(system.looked.linear, &plan, system.looked.errors);
    return system;
}

static void close_system(struct system *system)
{
    fbd_linear_system_free(system->system);
    end_look(&system->looked);
}

#define OUTPUTS(...)                                                                                         \
    (const char *const[]){__VA_ARGS__}, sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *)

/* ---- comparison */

static void check_numbers(struct checks *checks, const char *what, const double *got, const double *want,
                          size_t count)
{
    for (size_t i = 0; i < count; i++)
        check_close(checks, what, got[i], want[i], 1e-13 * (1 + fabs(want[i])));
}

static double complex evaluate(const fbd_transfer *transfer, double complex s)
{
    double complex H = transfer->gain;
    for (size_t i = 0; i < transfer->zero_count; i++)
        H *= s - (transfer->zeros[i].re + I * transfer->zeros[i].im);
    for (size_t i = 0; i < transfer->pole_count; i++)
        H /= s - (transfer->poles[i].re + I * transfer->poles[i].im);
    return H;
}

typedef double complex closed_form(double complex s);

/* The transfer function, and the response that is solved from the matrices, compared with the closed form: some hundred
 * roundings, and for an acceleration roundings of D, of which most is subtracted at low frequencies. */
static void check_transfer(struct checks *checks, const struct system *system, size_t output, closed_form *H,
                           size_t zeros, size_t poles)
{
    static const double omega[] = {0.01, 0.3, 1, 2.7, 8, 90};
    fbd_transfer *transfer = fbd_transfer_new(system->system, 0, output, NULL);
    assert_non_null(transfer);
    check_that(checks, "number of zeros", transfer->zero_count == zeros);
    check_that(checks, "number of poles", transfer->pole_count == poles);
    for (size_t i = 0; i < sizeof omega / sizeof *omega; i++) {
        fbd_complex response;
        const double complex want = H(I * omega[i]);
        assert_true(fbd_linear_system_response(system->system, 0, output, &omega[i], 1, &response));
        check_close(checks, "response", cabs(response.re + I * response.im - want), 0,
                    1e-12 * cabs(want) + 4e-16 * fabs(transfer->gain));
        check_close(checks, "poles, zeros, gain", cabs(evaluate(transfer, I * omega[i]) - want), 0,
                    1e-11 * cabs(want));
    }
    fbd_transfer_free(transfer);
}

static double static_gain(const struct system *system, size_t output)
{
    fbd_transfer *transfer = fbd_transfer_new(system->system, 0, output, NULL);
    assert_non_null(transfer);
    const double gain = transfer->static_gain;
    fbd_transfer_free(transfer);
    return gain;
}

/* ---- mass, spring, damper: 1/(m s^2 + c s + k) */

static const char mass_spring_damper[] =
    "fbd: 1\ninputs: {F: 0 N}\nbodies:\n  b:\n    {mass: 2 kg, motion: slide, forces: [spring: {stiffness: "
    "50 N/m},\n"
    "     damper: {coefficient: 4 N*s/m}, applied: {name: push, value: F}]}\n";

static double complex place(double complex s)
{
    return 1 / (2 * s * s + 4 * s + 50);
}

static double complex velocity(double complex s)
{
    return s * place(s);
}

static double complex acceleration(double complex s)
{
    return s * s * place(s);
}

static void a_mass_on_a_spring(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct system system = open_system(mass_spring_damper, OUTPUTS("b.x", "b.v", "b.v_dot"));
    assert_non_null(system.system);
    assert_string_equal(fbd_linear_system_input(system.system, 0).name, "F");
    assert_string_equal(fbd_linear_system_output(system.system, 2).unit, "m/s^2");
    check_numbers(&checks, "B", fbd_linear_system_input_matrix(system.system), (const double[]){0, 0.5}, 2);
    check_numbers(&checks, "C", fbd_linear_system_output_matrix(system.system),
                  (const double[]){1, 0, 0, 1, -25, -2}, 6);
    check_numbers(&checks, "D", fbd_linear_system_feedthrough(system.system), (const double[]){0, 0, 0.5}, 3);
    check_transfer(&checks, &system, 0, place, 0, 2);
    check_transfer(&checks, &system, 1, velocity, 1, 2);
    check_transfer(&checks, &system, 2, acceleration, 2, 2);
    check_close(&checks, "static gain", static_gain(&system, 0), 0.02, 1e-16);
    close_system(&system);
    checks_end(&checks);
}

/* ---- two masses on springs, pushed at the first: m1 = 1, m2 = 2, k1 = 30, k2 = 40 between them, c = 0.6 between them */

static const char two_masses[] =
    "fbd: 1\ninputs: {F: 0 N}\nbodies:\n"
    "  a: {mass: 1 kg, motion: slide, forces: [spring: {stiffness: 30 N/m}, applied: {value: F}]}\n"
    "  b: {mass: 2 kg, motion: slide, initial: {x: 1 m}}\n"
    "  other: {mass: 3 kg, motion: slide, forces: [spring: {stiffness: 7 N/m}]}\n"
    "couplings:\n"
    "  - spring: {between: [a.G, b.G], stiffness: 40 N/m, free_length: 1 m}\n"
    "  - damper: {between: [a.G, b.G], coefficient: 0.6 N*s/m}\n";

static double complex determinant(double complex s)
{
    const double complex between = 40 + 0.6 * s;
    return (s * s + 30 + between) * (2 * s * s + between) - between * between;
}

static double complex collocated(double complex s)
{
    return (2 * s * s + 40 + 0.6 * s) / determinant(s);
}

static double complex transferred(double complex s)
{
    return (40 + 0.6 * s) / determinant(s);
}

static double complex nothing(double complex s)
{
    (void)s;
    return 0;
}

static void two_masses_in_a_row(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct system system = open_system(two_masses, OUTPUTS("a.x", "b.x", "other.x"));
    assert_non_null(system.system);
    check_transfer(&checks, &system, 0, collocated, 2, 4);
    check_transfer(&checks, &system, 1, transferred, 1, 4);
    check_transfer(&checks, &system, 2, nothing, 0, 0); /* its poles are no part of any */
    check_close(&checks, "static", static_gain(&system, 1), 1.0 / 30, 1e-15);
    close_system(&system);
    checks_end(&checks);
}

/* ---- an upright rod on a cart: M = 2, m = 1, L = 1; theta from the horizontal, so x_tip = x + L cos(theta)
 *
 *     (M + m) x'' - (m L/2) p'' = F,  -(m L/2) x'' + (m L^2/3) p'' = m g L/2 p,  p = theta - 90 deg
 */

static const char rod_on_cart[] = "fbd: 1\ninputs: {F: 0 N}\nbodies:\n"
                                  "  cart: {mass: 2 kg, motion: slide, forces: [applied: {value: F}]}\n"
                                  "  rod: {shape: rod, mass: 1 kg, length: 1 m, motion: {pivot: {point: "
                                  "left, on: cart}}, initial: {theta: 90 deg}, "
                                  "forces: [gravity]}\n";

static const double g = 9.81;

static double complex upright(double complex s)
{
    return 3 * s * s * (s * s / 3 - g / 2) - s * s * s * s / 4;
}

static double complex cart_place(double complex s)
{
    return (s * s / 3 - g / 2) / upright(s);
}

static double complex rod_angle(double complex s)
{
    return 0.5 * s * s / upright(s);
}

static double complex tip_place(double complex s)
{
    return cart_place(s) - rod_angle(s);
}

static double complex tip_acceleration(double complex s)
{
    return s * s * tip_place(s);
}

/* The cart has a zero in the right half-plane: to go to the right it begins to the left. */
static void a_rod_on_a_cart(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct system system =
        open_system(rod_on_cart, OUTPUTS("cart.x", "rod.theta", "rod.right.x", "rod.right.ax"));
    assert_non_null(system.system);
    check_transfer(&checks, &system, 0, cart_place, 2, 4);
    check_transfer(&checks, &system, 1, rod_angle, 0, 2);
    check_transfer(&checks, &system, 2, tip_place, 2, 4);
    check_transfer(&checks, &system, 3, tip_acceleration, 2, 2);
    fbd_transfer *transfer = fbd_transfer_new(system.system, 0, 0, NULL);
    assert_non_null(transfer);
    check_close(&checks, "right zero", fmax(transfer->zeros[0].re, transfer->zeros[1].re), sqrt(1.5 * g),
                1e-13);
    assert_true(isinf(transfer->static_gain)); /* a force moves the cart without end */
    fbd_transfer_free(transfer);
    check_close(&checks, "both fall with a = F/(M + m)", static_gain(&system, 3), 1.0 / 3, 1e-15);
    close_system(&system);
    checks_end(&checks);
}

/* ---- a slider-crank at rest against a spring, pushed at the crank: independent coordinates by a loop
 *
 * Crank r = 0.3 m at 90 deg, rod l = 0.5 m: slide at x = 0.4 m, dx/dtheta = -r by the sine law of velocities:
 * x = r cos(theta) + sqrt(l^2 - r^2 sin^2(theta)), x' = -r sin(theta) - 0 at 90 deg.
 */
static const char crank[] =
    "fbd: 1\ngravity: 0\ninputs: {M: 0 N*m}\nbodies:\n"
    "  crank: {shape: rod, mass: 1 kg, length: 0.3 m, motion: {pivot: {point: left}},\n"
    "    initial: {theta: 90 deg}, moments: [applied: {value: M}]}\n"
    "  link: {mass: 1 kg, inertia: 0.02 kg*m^2, points: {A: [0, 0], B: [0.5 m, 0]}, motion: planar,\n"
    "    initial: {assemble: true, x: 0, y: 0.3 m, theta: -36.86989764584402 deg}}\n"
    "  piston: {mass: 2 kg, motion: slide, initial: {assemble: true, x: 0.4 m},\n"
    "    forces: [spring: {stiffness: 100 N/m, neutral: 0.4 m}]}\n"
    "couplings:\n  - pin: {between: [crank.right, link.A]}\n  - pin: {between: [link.B, piston.G]}\n";

static void a_closed_loop_has_its_ratio(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct system system = open_system(crank, OUTPUTS("crank.theta", "piston.x", "piston.v"));
    assert_non_null(system.system);
    assert_int_equal(fbd_linearization_size(system.looked.linear), 2);
    const double *A = fbd_linearization_matrix(system.looked.linear);
    const double *B = fbd_linear_system_input_matrix(system.system),
                 *C = fbd_linear_system_output_matrix(system.system);
    /* in terms of the crank: k (dx/dtheta)^2 = 9 N m/rad, and A = -9/I, B = 1/I with one moment of inertia I */
    const double ratio = C[2] / C[0];
    check_close(&checks, "dx/dtheta", ratio, -0.3, 1e-12);
    check_close(&checks, "velocities too", C[5] / C[0], -0.3, 1e-12);
    check_close(&checks, "stiffness", A[2] / B[1] * (fabs(C[0]) == 1 ? 1 : 0), -9, 1e-9);
    close_system(&system);
    checks_end(&checks);
}

/* ---- user states: a motor of two states */

static void user_states_are_part_of_it(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct system system = open_system(
        "fbd: 1\ninputs: {U: 0 V}\n"
        "states:\n  i: {initial: 0 A, rate: \"(U - 2[ohm]*states.i - 0.5[V*s/rad]*b.omega)/0.1[H]\"}\n"
        "bodies:\n  b: {shape: disc, mass: 2 kg, radius: 1 m, motion: pivot,\n"
        "    moments: [applied: {value: \"0.5[N*m/A]*states.i\"}, damper: {coefficient: 0.25 N*m*s}]}\n",
        OUTPUTS("b.omega", "states.i"));
    assert_non_null(system.system);
    /* omega/U = k/((L s + R)(I s + c) + k^2) with I = 1 kg m^2: static gain 0.5/(2*0.25 + 0.25) */
    check_close(&checks, "speed", static_gain(&system, 0), 0.5 / 0.75, 1e-14);
    check_close(&checks, "current", static_gain(&system, 1), 0.25 / 0.75, 1e-14);
    close_system(&system);
    checks_end(&checks);
}

/* ---- texts, and refusals */

static void phases_are_continuous(void **unused)
{
    (void)unused;
    struct system system = open_system(two_masses, OUTPUTS("b.x"));
    char *csv = fbd_linear_system_csv(system.system), *line = csv;
    assert_non_null(csv);
    assert_memory_equal(csv, "omega [rad/s],b.x/F [m/N],b.x/F phase [deg]\n", 44);
    double omega = 0, magnitude, phase = 0, before = 0, last = 0;
    for (line = strchr(line, '\n') + 1; *line; line = strchr(line, '\n') + 1, before = phase) {
        last = omega;
        omega = strtod(line, &line);
        magnitude = strtod(line + 1, &line);
        phase = strtod(line + 1, &line);
        assert_true(omega > last && magnitude > 0 && fabs(phase - before) < 90);
    }
    assert_true(phase < -260 && phase > -275); /* four poles less one zero */
    free(csv);
    close_system(&system);
}

static void assert_refused(const char *text, const char *output, const char *id)
{
    struct system system = open_system(text, OUTPUTS(output));
    assert_null(system.system);
    assert_string_equal(fbd_errors_get(system.looked.errors, 0).id, id);
    close_system(&system);
}

static void wrong_names_are_refused(void **unused)
{
    (void)unused;
    assert_refused(mass_spring_damper, "b.y", "unknown-output");
    assert_refused(mass_spring_damper, "b.G.proper_ax", "unknown-output");
    assert_refused("fbd: 1\nbodies: {b: {mass: 1 kg, motion: slide, forces: [spring: {stiffness: 1 N/m}]}}\n",
                   "b.x", "no-inputs");
    struct looked looked = look(mass_spring_damper);
    const fbd_linear_plan plan = {.inputs = (const char *const[]){"G"}, .input_count = 1};
    assert_null(fbd_linear_system_new(looked.linear, &plan, looked.errors));
    assert_string_equal(fbd_errors_get(looked.errors, 0).id, "unknown-input");
    end_look(&looked);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mass_on_a_spring),
        cmocka_unit_test(two_masses_in_a_row),
        cmocka_unit_test(a_rod_on_a_cart),
        cmocka_unit_test(a_closed_loop_has_its_ratio),
        cmocka_unit_test(user_states_are_part_of_it),
        cmocka_unit_test(phases_are_continuous),
        cmocka_unit_test(wrong_names_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
