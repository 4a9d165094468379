/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "exact_motions.h"

#include <gsl/gsl_sf_elljac.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

static const double pi = 3.14159265358979323846, gravity = 9.81;

/* x'' = -w^2 x - 2 zeta w x' from x0 at rest. */
static void damped(double x0, double w, double zeta, double t, double *x, double *v)
{
    double root = sqrt(1 - zeta * zeta), wd = w * root, decay = exp(-zeta * w * t);
    *x = x0 * decay * (cos(wd * t) + zeta / root * sin(wd * t));
    *v = -x0 * decay * w / root * sin(wd * t);
}

static void damped_oscillator(double t, double *y)
{
    damped(1, 10, 0.05, t, &y[0], &y[1]);
}

static void torsional_pendulum(double t, double *y)
{
    const double inertia = 0.01, w = sqrt(0.9 / inertia);
    damped(20 * pi / 180, w, 0.006 / (2 * inertia * w), t, &y[0], &y[1]);
}

static void hanging_spring(double t, double *y)
{
    const double m = 1.5, k = 80, c = 0.4, w = sqrt(k / m), sag = m * gravity / k;
    damped(sag, w, c / (2 * m * w), t, &y[0], &y[1]);
    y[0] -= 0.3 + sag;
}

/* The buoy swings against the ship by the reduced mass; their centre of mass rests. */
static void mass_ratio(double t, double *y)
{
    const double ship = 1e9, buoy = 1, all = ship + buoy, w = sqrt(100 * all / (ship * buoy));
    y[0] = buoy / all * (1 - cos(w * t));
    y[1] = (buoy + ship * cos(w * t)) / all;
    y[2] = buoy / all * w * sin(w * t);
    y[3] = -ship / all * w * sin(w * t);
}

static void falling_with_drag(double t, double *y)
{
    const double terminal = sqrt(0.4 * gravity / 0.01);
    y[0] = 100 - terminal * terminal / gravity * log(cosh(gravity * t / terminal));
    y[1] = -terminal * tanh(gravity * t / terminal);
}

static void drop_us(double t, double *y)
{
    y[0] = 30 - 16.1 * t * t;
    y[1] = -32.2 * t;
}

static void fixed_axis(double t, double *y)
{
    const double acceleration = 3 / (8 * 0.35 * 0.35 / 2);
    y[0] = acceleration * t * t / 2;
    y[1] = acceleration * t;
}

static void thrown_rod(double t, double *y)
{
    y[0] = 4 * t;
    y[1] = 1.5 + 6 * t - gravity * t * t / 2;
    y[2] = 20 * pi / 180 + 9 * t;
    y[3] = 4;
    y[4] = 6 - gravity * t;
    y[5] = 9;
}

/* sin(theta/2) = k sn(K + w t), k = sin(theta0/2); sn(K + u) = cn/dn, cn(K + u) = -k' sn/dn (Abramowitz &
 * Stegun 16.8). */
static void simple_pendulum(double t, double *y)
{
    const double w = sqrt(gravity / 1.06), k = sin(pi / 6), complement = cos(pi / 6);
    double sn, cn, dn;
    gsl_sf_elljac_e(w * t, k * k, &sn, &cn, &dn);
    y[0] = 2 * asin(k * cn / dn);
    y[1] = -2 * k * w * complement * sn / dn;
}

static void incline(double t, double *y)
{
    const double phi = pi / 6, a = 5.0 / 2 - gravity * sin(phi) - 0.5 * gravity * cos(phi), stop = -3 / a;
    double s = fmin(t, stop);
    y[0] = 3 * s + a * s * s / 2;
    y[1] = t < stop ? 3 + a * t : 0;
}

/* tests/hard/test_stick_slip_belt.c has the derivation. */
static void stick_slip_belt(double t, double *y)
{
    const double w = 10, belt = 0.2, mu_s = 0.4, mu_d = 0.25, k = 100;
    const double amplitude = (mu_s - mu_d) * gravity / k, middle = mu_d * gravity / k,
                 slip = (2 * pi - 2 * atan(amplitude * w / belt)) / w, stick = 2 * amplitude / belt,
                 first = mu_s * gravity / (k * belt);
    double s = fmod(t - first, slip + stick);
    if (t < first || s >= slip) {
        y[0] = t < first ? belt * t : middle - amplitude + belt * (s - slip);
        y[1] = belt;
        return;
    }
    y[0] = middle + amplitude * cos(w * s) + belt / w * sin(w * s);
    y[1] = -amplitude * w * sin(w * s) + belt * cos(w * s);
}

static const struct {
    const char *name;
    exact_motion *motion;
} motions[] = {
    {"hard/mass_ratio.yaml", mass_ratio},
    {"hard/stick_slip_belt.yaml", stick_slip_belt},
    {"kinetics/drop_us.yaml", drop_us},
    {"kinetics/falling_with_drag.yaml", falling_with_drag},
    {"kinetics/incline.yaml", incline},
    {"plane/thrown_rod.yaml", thrown_rod},
    {"rotation/fixed_axis.yaml", fixed_axis},
    {"rotation/simple_pendulum.yaml", simple_pendulum},
    {"rotation/torsional_pendulum.yaml", torsional_pendulum},
    {"vibration/damped_oscillator.yaml", damped_oscillator},
    {"vibration/hanging_spring.yaml", hanging_spring},
};

exact_motion *exact_motion_of(const char *path)
{
    size_t length = strlen(path);
    for (size_t i = 0; i < sizeof motions / sizeof *motions; i++) {
        size_t own = strlen(motions[i].name);
        if (length >= own && strcmp(path + length - own, motions[i].name) == 0) return motions[i].motion;
    }
    return NULL;
}
