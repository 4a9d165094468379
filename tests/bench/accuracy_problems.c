/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The gallery, with right-hand sides by hand and closed forms.
 */
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <math.h>

#include "accuracy.h"

double problem_error(const struct problem *problem, double t, const double *y)
{
    double known[2];
    problem->exact(problem, t, known);
    return fmax(fabs(y[0] - known[0]) / problem->scale[0], fabs(y[1] - known[1]) / problem->scale[1]);
}

/* ---- pendulum of 1 m: sin(theta/2) = k sn(K + w t, k), k = sin(theta0/2), w = sqrt(g/L) */

static int pendulum_rhs(double t, const double y[], double f[], void *context)
{
    (void)t, (void)context;
    f[0] = y[1];
    f[1] = -9.81 * sin(y[0]);
    return 0;
}

static int pendulum_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *context)
{
    (void)t, (void)context;
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -9.81 * cos(y[0]);
    dfdy[3] = 0;
    dfdt[0] = dfdt[1] = 0;
    return 0;
}

static void pendulum_exact(const struct problem *problem, double t, double *y)
{
    double k = sin(problem->y0[0] / 2), w = sqrt(9.81), K = gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE), sn, cn,
           dn;
    gsl_sf_elljac_e(fmod(K + w * t, 4 * K), k * k, &sn, &cn, &dn);
    y[0] = 2 * asin(k * sn);
    y[1] = 2 * k * w * cn;
}

/* ---- oscillator, m = 1 kg, k = 1e6 N/m, critically or over damped: a pair of real rates, without
 * cancellation */

static int oscillator_rhs(double t, const double y[], double f[], void *context)
{
    const struct mode *mode = context;
    (void)t;
    f[0] = y[1];
    f[1] = -1e6 * y[0] - mode->problem->c * y[1];
    return 0;
}

static int oscillator_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *context)
{
    const struct mode *mode = context;
    (void)t, (void)y;
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -1e6;
    dfdy[3] = -mode->problem->c;
    dfdt[0] = dfdt[1] = 0;
    return 0;
}

static void oscillator_exact(const struct problem *problem, double t, double *y)
{
    double half = problem->c / 2, root = sqrt(fmax(half * half - 1e6, 0));
    if (root == 0) {
        y[0] = (1 + half * t) * exp(-half * t);
        y[1] = -half * half * t * exp(-half * t);
        return;
    }
    double fast = -half - root, slow = 1e6 / fast;
    double A = fast / (fast - slow), B = -slow / (fast - slow);
    y[0] = A * exp(slow * t) + B * exp(fast * t);
    y[1] = A * slow * exp(slow * t) + B * fast * exp(fast * t);
}

/* ---- belt, from x = 0 in stick (reference case C07) */

static int belt_rhs(double t, const double y[], double f[], void *context)
{
    const struct mode *mode = context;
    (void)t;
    f[0] = mode->sticking ? BELT_SPEED : y[1];
    f[1] = mode->sticking ? 0 : BELT_KINETIC - BELT_K * y[0];
    return 0;
}

static int belt_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *context)
{
    const struct mode *mode = context;
    (void)t, (void)y;
    dfdy[0] = dfdy[3] = 0;
    dfdy[1] = mode->sticking ? 0 : 1;
    dfdy[2] = mode->sticking ? 0 : -BELT_K;
    dfdt[0] = dfdt[1] = 0;
    return 0;
}

double belt_event(const struct mode *mode, const double *y, double *rate)
{
    *rate = mode->sticking ? -BELT_K * BELT_SPEED : BELT_K * y[0] - BELT_KINETIC;
    return mode->sticking ? BELT_STATIC - BELT_K * y[0] : BELT_SPEED - y[1];
}

static void belt_exact(const struct problem *problem, double t, double *y)
{
    (void)problem;
    double w = 10, A = (BELT_STATIC - BELT_KINETIC) / BELT_K, centre = BELT_KINETIC / BELT_K;
    double first = BELT_STATIC / BELT_K / BELT_SPEED; /* first breakaway */
    double slip = (2 * acos(-1) - 2 * atan(A * w / BELT_SPEED)) / w, stick = 2 * A / BELT_SPEED;
    double s = fmod(t - first, slip + stick);
    bool slips = s < slip;
    y[0] =
        slips ? centre + A * cos(w * s) + BELT_SPEED / w * sin(w * s) : centre - A + BELT_SPEED * (s - slip);
    y[1] = slips ? -A * w * sin(w * s) + BELT_SPEED * cos(w * s) : BELT_SPEED;
}

/* ---- square wave: each period adds WAVE_SIZE WAVE_HALF^2 to x and nothing to v */

static int square_rhs(double t, const double y[], double f[], void *context)
{
    const struct mode *mode = context;
    (void)t;
    f[0] = y[1];
    f[1] = mode->force;
    return 0;
}

static int square_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *context)
{
    (void)t, (void)y, (void)context;
    dfdy[0] = dfdy[2] = dfdy[3] = 0;
    dfdy[1] = 1;
    dfdt[0] = dfdt[1] = 0;
    return 0;
}

static void square_exact(const struct problem *problem, double t, double *y)
{
    (void)problem;
    const double a = WAVE_SIZE, h = WAVE_HALF;
    double periods = floor(t / (2 * h)), s = t - periods * 2 * h, rest = s - h;
    y[0] = periods * a * h * h + (s < h ? a * s * s / 2 : a * h * h / 2 + a * h * rest - a * rest * rest / 2);
    y[1] = s < h ? a * s : a * (h - rest);
}

/* ---- the gallery */

#define PENDULUM                                                                                             \
    .coordinate = "pendulum.theta", .rate = "pendulum.omega", .exact = pendulum_exact, .rhs = pendulum_rhs,  \
    .jacobian = pendulum_jacobian
#define BLOCK .coordinate = "block.x", .rate = "block.v"
#define OSCILLATOR(C, VALUE)                                                                                 \
    {                                                                                                        \
        .name = "stiff oscillator, k = 1e6 N/m, c = " C " N s/m",                                            \
        .model = "models/vibration/damped_oscillator.yaml",                                                  \
        .options = "--set k='1e6 N/m' --set c='" C " N*s/m' --until 1",                                      \
        .settings = {{"k", "1e6 N/m"}, {"c", C " N*s/m"}}, .setting_count = 2, BLOCK, .stiff = true,         \
        .times = {1e-3, 1e-2, 0.1, 1}, .time_count = 4, .y0 = {1, 0}, .scale = {1, 1e3}, .c = (VALUE),       \
        .exact = oscillator_exact, .rhs = oscillator_rhs, .jacobian = oscillator_jacobian                    \
    }

const struct problem problems[] = {
    {.name = "pendulum, 100 s from 2 rad",
     .model = "models/hard/long_pendulum.yaml",
     .options = "--set theta0='2 rad' --until 100",
     .settings = {{"theta0", "2 rad"}},
     .setting_count = 1,
     PENDULUM,
     .times = {100},
     .time_count = 1,
     .y0 = {2, 0},
     .scale = {2, 5.27}},
    {.name = "belt stick-slip, 200 s",
     .model = "models/hard/stick_slip_belt.yaml",
     .options = "--until 200",
     BLOCK,
     .kind = belt,
     .times = {200},
     .time_count = 1,
     .y0 = {0, BELT_SPEED},
     .scale = {0.04, 0.25},
     .exact = belt_exact,
     .rhs = belt_rhs,
     .jacobian = belt_jacobian},
    OSCILLATOR("2e3", 2e3),
    OSCILLATOR("1e4", 1e4),
    OSCILLATOR("1e5", 1e5),
    {.name = "square-wave force, 1000 periods",
     .model = "models/hard/square_wave.yaml",
     .options = "--until 699.6",
     BLOCK,
     .kind = square,
     .times = {699.6},
     .time_count = 1,
     .scale = {WAVE_SIZE * WAVE_HALF * WAVE_HALF * 1000, WAVE_SIZE *WAVE_HALF},
     .exact = square_exact,
     .rhs = square_rhs,
     .jacobian = square_jacobian},
    {.name = "pendulum, 10 000 swings from 60 deg",
     .model = "models/hard/long_pendulum.yaml",
     .options = "",
     PENDULUM,
     .times = {21600},
     .time_count = 1,
     .y0 = {1.0471975511965976, 0},
     .scale = {1.05, 3.13}},
};

const size_t problem_count = sizeof problems / sizeof *problems;
