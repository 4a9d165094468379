/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Unit tests of a derivation by hand with plain `assert`: a pendulum of a rod and a bob, as derived on paper, against the
 * equation that fbd assembles from the free-body diagram of pendulum.yaml.
 *
 *     cc -o pendulum pendulum.c $(pkg-config --cflags --libs fbd) -lm && ./pendulum
 */
#undef NDEBUG /* with which `assert` would check nothing */
#include <assert.h>
#include <fbd_test.h>

static const double m_r = 0.5, m_b = 2, l = 1, c = 0.1, g = 9.81;

/* omega_dot alone, at theta = x[0], omega = x[1] */
static fbd_expected by_hand(const double x[])
{
    double sum = -(m_r / 2 + m_b) * g * l * sin(x[0]) - c * x[1];
    return (fbd_expected){.coordinate = "theta", .acceleration = sum / ((m_r / 3 + m_b) * l * l)};
}

int main(void)
{
    assert(fbd_check_derivation("pendulum.yaml", (fbd_range[]){{"theta", -3, 3}, {"omega", -5, 5}, {0}},
                                by_hand));
    assert(fbd_check_lines("pendulum.yaml")); /* the lines that the model has under `hand` */
    return 0;
}
