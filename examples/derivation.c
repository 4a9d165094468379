/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A unit test of a hand derivation: the equation of a pendulum with a rod and a bob, as derived on paper, against what
 * fbd assembles from the free-body diagram, at many states. The model is in the test.
 *
 *     cc -o derivation derivation.c $(pkg-config --cflags --libs fbd gsl) -lm && ./derivation
 */
#include <fbd.h>
#include <gsl/gsl_errno.h>
#include <string.h>

static const char scene[] = "fbd: 1\n"
                            "bodies:\n"
                            "  pendulum:\n"
                            "    motion: {pivot: {at: [0, 0]}}\n"
                            "    parts:\n"
                            "      rod: {shape: rod, mass: 0.5 kg, from: [0, 0], to: [0, -1 m]}\n"
                            "      bob: {shape: point, mass: 2 kg, center: [0, -1 m]}\n"
                            "    forces: [gravity]\n"
                            "    moments: [damper: {coefficient: 0.1 N*m*s/rad}]\n";

/* On paper: (m_r l^2 / 3 + m_b l^2) omega_dot = -(m_r l / 2 + m_b l) g sin(theta) - c omega */
static double by_hand(double theta, double omega)
{
    const double m_r = 0.5, m_b = 2, l = 1, c = 0.1, g = 9.81;
    return (-(m_r * l / 2 + m_b * l) * g * sin(theta) - c * omega) / (m_r * l * l / 3 + m_b * l * l);
}

/* What fbd says of the same state; NAN when it cannot. */
static double assembled(fbd_state *state, double theta, double omega)
{
    if (!fbd_state_set(state, "pendulum.theta", theta) || !fbd_state_set(state, "pendulum.omega", omega))
        return NAN;
    fbd_equations *equations = fbd_assemble(state);
    const fbd_equation equation = fbd_equations_find(equations, "pendulum.theta");
    double acceleration = equation.acceleration;
    fbd_equations_free(equations);
    return acceleration;
}

int main(void)
{
    gsl_set_error_handler_off();
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(scene, strlen(scene), "pendulum in derivation.c", NULL, 0, errors);
    fbd_state *state = model ? fbd_state_new(model) : NULL;
    fbd_errors_print(errors, stderr);
    int tried = 0, failed = state ? 0 : 1;
    for (double theta = -3; state && theta <= 3; theta += 0.25)
        for (double omega = -5; omega <= 5; omega += 0.5, tried++) {
            double want = by_hand(theta, omega), got = assembled(state, theta, omega);
            if (fabs(got - want) <= 1e-13 * (10 + fabs(want))) continue;
            printf("theta = %g, omega = %g: by hand %.17g, assembled %.17g\n", theta, omega, want, got);
            failed++;
        }
    printf("%d states, %d differ\n", tried, failed);
    fbd_state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return failed > 0;
}
