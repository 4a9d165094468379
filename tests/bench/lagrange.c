/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "lagrange.h"

#include <math.h>

static const double g = 9.81;

int lagrange_double_pendulum(double t, const double y[], double dydt[], void *params)
{
    (void)t, (void)params;
    double th1 = y[0], th2 = y[0] + y[1], w1 = y[2], w2 = y[2] + y[3];
    double s1 = sin(th1), c1 = cos(th1), s2 = sin(th2), c2 = cos(th2);
    double half_cos = 0.5 * (c1 * c2 + s1 * s2), half_sin = 0.5 * (s1 * c2 - c1 * s2);
    double f1 = -half_sin * w2 * w2 - 1.5 * g * s1, f2 = half_sin * w1 * w1 - 0.5 * g * s2;
    double inverse = 1 / (4.0 / 9 - half_cos * half_cos);
    double a1 = (f1 * (1.0 / 3) - half_cos * f2) * inverse, a2 = (4.0 / 3 * f2 - half_cos * f1) * inverse;
    dydt[0] = y[2];
    dydt[1] = y[3];
    dydt[2] = a1;
    dydt[3] = a2 - a1;
    return 0;
}

int lagrange_three_rods(double t, const double y[], double dydt[], void *params)
{
    (void)t, (void)params;
    double p1 = y[0], p2 = p1 + y[1], p3 = p2 + y[2], w1 = y[3], w2 = w1 + y[4], w3 = w2 + y[5];
    double s1 = sin(p1), c1 = cos(p1), s2 = sin(p2), c2 = cos(p2), s3 = sin(p3), c3 = cos(p3);
    double m12 = 1.5 * (c1 * c2 + s1 * s2), m13 = 0.5 * (c1 * c3 + s1 * s3), m23 = 0.5 * (c2 * c3 + s2 * s3);
    double n12 = 1.5 * (s1 * c2 - c1 * s2), n13 = 0.5 * (s1 * c3 - c1 * s3), n23 = 0.5 * (s2 * c3 - c2 * s3);
    double q1 = w1 * w1, q2 = w2 * w2, q3 = w3 * w3;
    double f1 = -n12 * q2 - n13 * q3 - 2.5 * g * c1, f2 = n12 * q1 - n23 * q3 - 1.5 * g * c2;
    double f3 = n13 * q1 + n23 * q2 - 0.5 * g * c3;
    /* Elimination from the last; the diagonal is 7/3, 4/3, 1/3. */
    double k1 = 3 * m13, k2 = 3 * m23;
    double a11 = 7.0 / 3 - k1 * m13, a12 = m12 - k1 * m23, a22 = 4.0 / 3 - k2 * m23;
    double b1 = f1 - k1 * f3, b2 = f2 - k2 * f3, inverse = 1 / (a11 * a22 - a12 * a12);
    double a1 = (b1 * a22 - a12 * b2) * inverse, a2 = (a11 * b2 - a12 * b1) * inverse;
    double a3 = 3 * f3 - k1 * a1 - k2 * a2;
    dydt[0] = y[3];
    dydt[1] = y[4];
    dydt[2] = y[5];
    dydt[3] = a1;
    dydt[4] = a2 - a1;
    dydt[5] = a3 - a2;
    return 0;
}

int lagrange_cart_pole(double t, const double y[], double dydt[], void *params)
{
    const double cart = 0.5, bob = 1;
    (void)t, (void)params;
    double s = sin(y[1]), c = cos(y[1]), w = y[3];
    double a = bob * s * (w * w + g * c) / (cart + bob * s * s);
    dydt[0] = y[2];
    dydt[1] = w;
    dydt[2] = a;
    dydt[3] = -(g * s + c * a);
    return 0;
}

/* ---- slider-crank: sin(psi) = -(r/l) sin(theta) of the rod, x = r cos(theta) + l cos(psi) */

static const double r = 0.2, l = 0.5, m1 = 1, m2 = 1.5, m3 = 2, moment = 5;

int lagrange_slider_crank(double t, const double y[], double dydt[], void *params)
{
    (void)t, (void)params;
    double s = sin(y[0]), c = cos(y[0]), w = y[3];
    double sp = -(r / l) * s, cp = sqrt(1 - sp * sp);
    /* psi = p(theta): p' = -(r/l) c / cp, p'' = ((r/l) s + sp p'^2) / cp; x' and x'' likewise */
    double inverse = 1 / cp, p1 = -(r / l) * c * inverse, p2 = ((r / l) * s + sp * p1 * p1) * inverse;
    double x1 = -r * s - l * sp * p1, x2 = -r * c - l * (cp * p1 * p1 + sp * p2);
    /* The centre of the rod: G' and G'' by theta. */
    double gx1 = -r * s - 0.5 * l * sp * p1, gx2 = -r * c - 0.5 * l * (cp * p1 * p1 + sp * p2);
    double gy1 = r * c + 0.5 * l * cp * p1, gy2 = -r * s + 0.5 * l * (cp * p2 - sp * p1 * p1);
    double rod = m2 * l * l / 12;
    double J = m1 * r * r / 3 + m2 * (gx1 * gx1 + gy1 * gy1) + rod * p1 * p1 + m3 * x1 * x1;
    double half = m2 * (gx1 * gx2 + gy1 * gy2) + rod * p1 * p2 + m3 * x1 * x2; /* J' / 2 */
    double a = (moment - g * (0.5 * m1 * r * c + m2 * gy1) - half * w * w) / J;
    dydt[0] = w;
    dydt[1] = (p1 - 1) * w;
    dydt[2] = x1 * w;
    dydt[3] = a;
    dydt[4] = (p1 - 1) * a + p2 * w * w;
    dydt[5] = x1 * a + x2 * w * w;
    return 0;
}

void lagrange_slider_crank_close(double y[])
{
    double sp = -(r / l) * sin(y[0]), cp = sqrt(1 - sp * sp), dydt[6];
    y[1] = atan2(sp, cp) - y[0];
    y[2] = r * cos(y[0]) + l * cp;
    lagrange_slider_crank(0, y, dydt, (void *)0);
    y[4] = dydt[1];
    y[5] = dydt[2];
}
