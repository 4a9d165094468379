/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The gallery, with right-hand sides by hand and known solutions.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <math.h>
#include <string.h>

#include "accuracy.h"
#include "lagrange.h"

double problem_error(const struct problem *problem, double t, const double *y)
{
    double known[most_size], error = 0;
    problem->exact(problem, t, known);
    for (size_t i = 0; i < problem->size; i++) error = fmax(error, fabs(y[i] - known[i]) / problem->scale[i]);
    return error;
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

/* No closed form: a run of rk8pd at 1e-15, made once for each problem. */
static void by_reference(const struct problem *problem, double t, double *y)
{
    static double known[16][most_size];
    static bool made[16];
    size_t at = (size_t)(problem - problems);
    if (!made[at]) {
        struct mode mode = {.problem = problem};
        gsl_odeiv2_system system = {problem->rhs, NULL, problem->size, &mode};
        gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_scaled_new(&system, gsl_odeiv2_step_rk8pd, 1e-3,
                                                                       1e-15, 1e-15, 1, 0, problem->scale);
        double now = 0;
        memcpy(known[at], problem->y0, sizeof known[at]);
        made[at] = driver && gsl_odeiv2_driver_apply(driver, &now, t, known[at]) == GSL_SUCCESS;
        gsl_odeiv2_driver_free(driver);
    }
    for (size_t i = 0; i < problem->size; i++) y[i] = made[at] ? known[at][i] : NAN;
}

/* ---- eight windows: nine uprights turn together, and eight crossbars go along a circle (IFToMM A02) */

static int windows_rhs(double t, const double y[], double f[], void *context)
{
    (void)t, (void)context;
    f[0] = y[1];
    f[1] = -(9.0 / 2 + 8) / (9.0 / 3 + 8) * 9.81 * cos(y[0]);
    return 0;
}

/* ---- a ball that bounces: the n-th bounce lasts 2 e^n sqrt(2 h / g) */

static int ball_rhs(double t, const double y[], double f[], void *context)
{
    (void)t, (void)context;
    f[0] = y[1];
    f[1] = -9.81;
    return 0;
}

double ball_event(const struct mode *mode, const double *y, double *rate)
{
    (void)mode;
    *rate = y[1];
    return y[0] - BALL_RADIUS;
}

static void ball_exact(const struct problem *problem, double t, double *y)
{
    const double g = 9.81;
    double fall = sqrt(2 * (problem->y0[0] - BALL_RADIUS) / g), v = BALL_RESTITUTION * g * fall;
    double s = t - fall; /* since the last bounce; t is beyond the first */
    for (; s > 2 * v / g; v *= BALL_RESTITUTION) s -= 2 * v / g;
    y[0] = BALL_RADIUS + s * (v - g * s / 2);
    y[1] = v - g * s;
}

/* ---- slider-crank of one coordinate, y = [theta, omega] */

static int crank_rhs(double t, const double y[], double f[], void *context)
{
    double all[6] = {[0] = y[0], [3] = y[1]}, rates[6];
    int status = lagrange_slider_crank(t, all, rates, context);
    f[0] = y[1];
    f[1] = rates[3];
    return status;
}

/* ---- light cart-pole, m = 1e-6 kg under M = 1 kg, l = 1 m, theta from straight down:
 *     (m + M sin^2) x'' = M sin(theta) (omega^2 + g cos(theta)),   theta'' = -(g sin(theta) + cos(theta) x'') */

static int cart_rhs(double t, const double y[], double f[], void *context)
{
    (void)t, (void)context;
    const double g = 9.81, m = 1e-6;
    double s = sin(y[1]), c = cos(y[1]), w = y[3], a = s * (w * w + g * c) / (m + s * s);
    f[0] = y[2];
    f[1] = w;
    f[2] = a;
    f[3] = -(g * s + c * a);
    return 0;
}

/* Extrapolated midpoint rule in long double at 1e-19; x and theta are those of the benchmark (1.99976328246,
 * -1.54912944190). */
static void cart_exact(const struct problem *problem, double t, double *y)
{
    static const double known[] = {1.9997632824709220, -1.5491294418948260, -0.0141284578069656,
                                   0.6521277749764965};
    (void)t;
    for (size_t i = 0; i < problem->size; i++) y[i] = known[i];
}

/* ---- the gallery */

#define PENDULUM                                                                                             \
    .size = 2, .names = {"pendulum.theta", "pendulum.omega"}, .exact = pendulum_exact, .rhs = pendulum_rhs,  \
    .jacobian = pendulum_jacobian
#define BLOCK .size = 2, .names = {"block.x", "block.v"}
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
    {.name = "double pendulum, 5 s",
     .model = "models/trees/double_pendulum.yaml",
     .options = "",
     .size = 4,
     .names = {"rod1.theta", "rod2.theta", "rod1.omega", "rod2.omega"},
     .times = {5},
     .time_count = 1,
     .y0 = {1.5707963267948966, -0.7853981633974483, 0, 0},
     .scale = {1.57, 0.961, 4.22, 9.43},
     .exact = by_reference,
     .rhs = lagrange_double_pendulum},
    {.name = "three rods, 5 s",
     .model = "tests/bench/scenes/three_rods.yaml",
     .options = "",
     .size = 6,
     .names = {"a.theta", "b.theta", "c.theta", "a.omega", "b.omega", "c.omega"},
     .times = {5},
     .time_count = 1,
     .y0 = {0, -0.5235987755982988, 0.3490658503988659},
     .scale = {3, 3, 3, 8, 15, 20},
     .exact = by_reference,
     .rhs = lagrange_three_rods},
    {.name = "cart-pole, 10 s",
     .model = "tests/bench/scenes/cart_pole.yaml",
     .options = "",
     .size = 4,
     .names = {"cart.x", "pole.theta", "cart.v", "pole.omega"},
     .times = {10},
     .time_count = 1,
     .y0 = {0, 1.5707963267948966, 0, 0},
     .scale = {1.3, 1.57, 5, 8},
     .exact = by_reference,
     .rhs = lagrange_cart_pole},
    {.name = "slider-crank, 5 s",
     .model = "tests/bench/scenes/slider_crank.yaml",
     .options = "",
     .size = 2,
     .names = {"crank.theta", "crank.omega"},
     .times = {5},
     .time_count = 1,
     .y0 = {0.5235987755982988, 0},
     .scale = {100, 40},
     .exact = by_reference,
     .rhs = crank_rhs},
    {.name = "N-four-bar, eight windows, 10 s",
     .model = "models/couplings/n_four_bar.yaml",
     .options = "",
     .size = 2,
     .names = {"v0.theta", "v0.omega"},
     .times = {10},
     .time_count = 1,
     .y0 = {1.5707963267948966, -1},
     .scale = {4.71, 6.75},
     .exact = by_reference,
     .rhs = windows_rhs},
    {.name = "bouncing ball, twelve bounces",
     .model = "models/contact/bouncing_ball.yaml",
     .options = "--until 3.8",
     .kind = bounce,
     .size = 2,
     .names = {"ball.y", "ball.vy"},
     .times = {3.8},
     .time_count = 1,
     .y0 = {1 + BALL_RADIUS, 0},
     .scale = {1, 4.43},
     .exact = ball_exact,
     .rhs = ball_rhs},
    {.name = "light cart-pole, 10 s",
     .model = "tests/bench/scenes/light_cart_pole.yaml",
     .options = "",
     .size = 4,
     .names = {"cart.x", "pole.theta", "cart.v", "pole.omega"},
     .times = {10},
     .time_count = 1,
     .y0 = {0, 1.5707963267948966, 0, 0},
     .scale = {2, 1.57, 4.43, 4.43},
     .exact = cart_exact,
     .rhs = cart_rhs},
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
