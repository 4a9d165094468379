/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Our default method against SUNDIALS' CVODE at equal measured error, on three scenes with closed forms.
 *
 * Both sides run a ladder of tolerances; time and work at the errors 1e-6 and 1e-10 are interpolated between
 * the rungs (log-log). CVODE gets a hand-written right-hand side, the exact Jacobian, the method that suits
 * the scene (Adams or BDF), and its own root finding for the belt. Times are medians of runs taken in turn.
 */
#include <cvode/cvode.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "fbd.h"
#include "timing.h"

enum { rungs = 12, repeats = 7 };

/* What one run gave. */
struct outcome {
    double error, seconds;
    double rhs, jacobians;
};

struct scene {
    const char *name, *model; /* the model as text, for fbd */
    const char *coordinate, *rate;
    double times[4]; /* where the error is measured, ascending; the last one ends the run */
    int time_count;
    void (*exact)(const struct scene *scene, double t, double *x, double *v);
    double scale_x, scale_v;
    int multistep; /* CV_ADAMS or CV_BDF */
    double (*acceleration)(const struct scene *scene, double x, double v);
    void (*slopes)(const struct scene *scene, double x, double v, double *by_x, double *by_v);
    double x0, v0, k, c;
    bool belt;
};

static double error_at(const struct scene *scene, double t, double x, double v)
{
    double exact_x, exact_v;
    scene->exact(scene, t, &exact_x, &exact_v);
    return fmax(fabs(x - exact_x) / scene->scale_x, fabs(v - exact_v) / scene->scale_v);
}

/* ---- the scenes */

static double pendulum_acceleration(const struct scene *scene, double x, double v)
{
    (void)scene, (void)v;
    return -9.81 * sin(x);
}

static void pendulum_slopes(const struct scene *scene, double x, double v, double *by_x, double *by_v)
{
    (void)scene, (void)v;
    *by_x = -9.81 * cos(x);
    *by_v = 0;
}

/* sin(theta/2) = k sn(K + w t, k), k = sin(theta0/2), w = sqrt(g/L) */
static void pendulum_exact(const struct scene *scene, double t, double *x, double *v)
{
    double k = sin(scene->x0 / 2), w = sqrt(9.81), K = gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE), sn, cn, dn;
    double u = fmod(K + w * t, 4 * K);
    gsl_sf_elljac_e(u, k * k, &sn, &cn, &dn);
    *x = 2 * asin(k * sn);
    *v = 2 * k * w * cn;
}

static double oscillator_acceleration(const struct scene *scene, double x, double v)
{
    return -scene->k * x - scene->c * v;
}

static void oscillator_slopes(const struct scene *scene, double x, double v, double *by_x, double *by_v)
{
    (void)x, (void)v;
    *by_x = -scene->k;
    *by_v = -scene->c;
}

/* x'' + c x' + k x = 0 from rest at x0, critically or over damped (m = 1): a pair of real rates, taken
 * without cancellation. */
static void oscillator_exact(const struct scene *scene, double t, double *x, double *v)
{
    double half = scene->c / 2, root = sqrt(fmax(half * half - scene->k, 0));
    double fast = -half - root, slow = scene->k / fast;
    if (root == 0) {
        double e = exp(-half * t);
        *x = scene->x0 * (1 + half * t) * e;
        *v = -scene->x0 * half * half * t * e;
        return;
    }
    double A = scene->x0 * fast / (fast - slow), B = -scene->x0 * slow / (fast - slow);
    *x = A * exp(slow * t) + B * exp(fast * t);
    *v = A * slow * exp(slow * t) + B * fast * exp(fast * t);
}

/* Belt: m = 1 kg, k = 100 N/m, mu_s = 0.4, mu_k = 0.25, belt at 0.2 m/s, start sticking at x = 0 (reference
 * case C07). */
static const double belt_speed = 0.2, belt_static = 0.4 * 9.81, belt_kinetic = 0.25 * 9.81, belt_k = 100;

static double belt_acceleration(const struct scene *scene, double x, double v)
{
    (void)scene, (void)v;
    return belt_kinetic - belt_k * x;
}

static void belt_slopes(const struct scene *scene, double x, double v, double *by_x, double *by_v)
{
    (void)scene, (void)x, (void)v;
    *by_x = -belt_k;
    *by_v = 0;
}

static void belt_exact(const struct scene *scene, double t, double *x, double *v)
{
    (void)scene;
    double w = 10, A = (belt_static - belt_kinetic) / belt_k, centre = belt_kinetic / belt_k;
    double first = belt_static / belt_k / belt_speed; /* first breakaway */
    double slip = (2 * acos(-1) - 2 * atan(A * w / belt_speed)) / w, stick = 2 * A / belt_speed;
    double s = fmod(t - first, slip + stick);
    if (s < slip) {
        *x = centre + A * cos(w * s) + belt_speed / w * sin(w * s);
        *v = -A * w * sin(w * s) + belt_speed * cos(w * s);
    } else {
        *x = centre - A + belt_speed * (s - slip);
        *v = belt_speed;
    }
}

/* ---- ours */

static struct outcome run_ours(const struct scene *scene, double tolerance)
{
    struct outcome outcome = {.error = NAN};
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(scene->model, strlen(scene->model), scene->name, NULL, 0, errors);
    if (!model) {
        fbd_errors_print(errors, stderr);
        exit(1);
    }
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = scene->times[scene->time_count - 1];
    options.tolerance = tolerance;
    fbd_state *state = fbd_state_new(model);
    double start = wall_seconds(), error = 0, from, to, x = NAN, v = NAN;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_outcome end = FBD_GOING;
    for (int next = 0; end == FBD_GOING;) {
        end = fbd_simulation_advance(simulation);
        fbd_simulation_interval(simulation, &from, &to);
        for (; next < scene->time_count && scene->times[next] <= to; next++) {
            if (!fbd_simulation_state(simulation, scene->times[next], state) ||
                !fbd_state_get(state, scene->coordinate, &x) || !fbd_state_get(state, scene->rate, &v))
                exit(1);
            error = fmax(error, error_at(scene, scene->times[next], x, v));
        }
    }
    outcome.seconds = wall_seconds() - start;
    fbd_stats stats = fbd_simulation_stats(simulation);
    outcome.rhs = (double)stats.rhs;
    outcome.jacobians = (double)stats.jacobians;
    if (end == FBD_DONE) outcome.error = error;
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return outcome;
}

/* ---- CVODE */

struct cvode_side {
    const struct scene *scene;
    bool sticking;
    long rhs;
};

static int cv_rhs(realtype t, N_Vector y, N_Vector dydt, void *context)
{
    (void)t;
    struct cvode_side *side = context;
    const double *s = NV_DATA_S(y);
    double *d = NV_DATA_S(dydt);
    side->rhs++;
    d[0] = side->sticking ? belt_speed : s[1];
    d[1] = side->sticking ? 0 : side->scene->acceleration(side->scene, s[0], s[1]);
    return 0;
}

static int cv_jacobian(realtype t, N_Vector y, N_Vector f, SUNMatrix J, void *context, N_Vector a, N_Vector b,
                       N_Vector c)
{
    (void)t, (void)f, (void)a, (void)b, (void)c;
    struct cvode_side *side = context;
    double by_x, by_v;
    side->scene->slopes(side->scene, NV_Ith_S(y, 0), NV_Ith_S(y, 1), &by_x, &by_v);
    SM_ELEMENT_D(J, 0, 1) = 1;
    SM_ELEMENT_D(J, 1, 0) = by_x;
    SM_ELEMENT_D(J, 1, 1) = by_v;
    return 0;
}

static int cv_roots(realtype t, N_Vector y, realtype *g, void *context)
{
    (void)t;
    struct cvode_side *side = context;
    g[0] = side->sticking ? belt_static - belt_k * NV_Ith_S(y, 0) : NV_Ith_S(y, 1) - belt_speed;
    return 0;
}

/* Integrate to the end, from event to event on the belt. */
static bool cv_integrate(void *cvode, struct cvode_side *side, N_Vector y, double until)
{
    realtype t = 0;
    for (;;) {
        int flag = CVode(cvode, until, y, &t, CV_NORMAL);
        if (flag == CV_SUCCESS) return true;
        if (flag != CV_ROOT_RETURN) return false;
        side->sticking = !side->sticking;
        NV_Ith_S(y, 1) = belt_speed;
        if (CVodeReInit(cvode, t, y) != CV_SUCCESS) return false;
    }
}

static struct outcome run_cvode(const struct scene *scene, double tolerance)
{
    struct outcome outcome = {.error = NAN};
    struct cvode_side side = {.scene = scene, .sticking = scene->belt};
    SUNContext context;
    double start = wall_seconds();
    if (SUNContext_Create(NULL, &context) != 0) exit(1);
    N_Vector y = N_VNew_Serial(2, context), absolute = N_VNew_Serial(2, context);
    SUNMatrix A = SUNDenseMatrix(2, 2, context);
    SUNLinearSolver solver = SUNLinSol_Dense(y, A, context);
    void *cvode = CVodeCreate(scene->multistep, context);
    NV_Ith_S(y, 0) = scene->x0;
    NV_Ith_S(y, 1) = scene->v0;
    NV_Ith_S(absolute, 0) = tolerance * scene->scale_x;
    NV_Ith_S(absolute, 1) = tolerance * scene->scale_v;
    CVodeInit(cvode, cv_rhs, 0, y);
    CVodeSVtolerances(cvode, tolerance, absolute);
    CVodeSetUserData(cvode, &side);
    CVodeSetMaxNumSteps(cvode, 100000000);
    CVodeSetLinearSolver(cvode, solver, A);
    CVodeSetJacFn(cvode, cv_jacobian);
    if (scene->belt) CVodeRootInit(cvode, 1, cv_roots);
    outcome.error = 0;
    for (int i = 0; i < scene->time_count; i++) {
        bool done = cv_integrate(cvode, &side, y, scene->times[i]);
        double error = done ? error_at(scene, scene->times[i], NV_Ith_S(y, 0), NV_Ith_S(y, 1)) : NAN;
        outcome.error = error <= outcome.error ? outcome.error : error;
    }
    outcome.seconds = wall_seconds() - start;
    long jacobians = 0;
    CVodeGetNumJacEvals(cvode, &jacobians);
    outcome.rhs = (double)side.rhs;
    outcome.jacobians = (double)jacobians;
    CVodeFree(&cvode);
    SUNLinSolFree(solver);
    SUNMatDestroy(A);
    N_VDestroy(y);
    N_VDestroy(absolute);
    SUNContext_Free(&context);
    return outcome;
}

/* ---- comparing */

/* Both sides at the same rung in turn; times are medians. */
static void climb(const struct scene *scene, struct outcome *ours, struct outcome *theirs)
{
    for (int r = 0; r < rungs; r++) {
        double tolerance = pow(10, -3 - r), a[repeats], b[repeats];
        for (int k = 0; k < repeats; k++) {
            ours[r] = run_ours(scene, tolerance);
            theirs[r] = run_cvode(scene, tolerance);
            a[k] = ours[r].seconds;
            b[k] = theirs[r].seconds;
        }
        ours[r].seconds = median(a, repeats);
        theirs[r].seconds = median(b, repeats);
    }
}

static double between(double a, double b, double share)
{
    return a > 0 && b > 0 ? exp(log(a) + share * (log(b) - log(a))) : a;
}

/* Cost of an error: the cheapest way along the ladder, between the last rung above it and the first one
 * below. */
static bool cost_of(const struct outcome *ladder, double error, struct outcome *cost)
{
    for (int r = 0; r < rungs; r++) {
        if (!(ladder[r].error <= error)) continue;
        *cost = ladder[r];
        if (r > 0 && ladder[r - 1].error > error && ladder[r].error > 0) {
            double share = log(ladder[r - 1].error / error) / log(ladder[r - 1].error / ladder[r].error);
            cost->seconds = between(ladder[r - 1].seconds, ladder[r].seconds, share);
            cost->rhs = between(ladder[r - 1].rhs, ladder[r].rhs, share);
            cost->jacobians = between(ladder[r - 1].jacobians, ladder[r].jacobians, share);
        }
        return true;
    }
    return false;
}

static void compare(const struct scene *scene)
{
    static struct outcome ours[rungs], theirs[rungs];
    climb(scene, ours, theirs);
    for (int k = 0; k < 2; k++) {
        double error = k == 0 ? 1e-6 : 1e-10;
        struct outcome a, b;
        bool have_a = cost_of(ours, error, &a), have_b = cost_of(theirs, error, &b);
        printf("%-28s %.0e  ", scene->name, error);
        if (have_a) printf("%9.3f ms %8.0f rhs %6.0f jac  ", 1e3 * a.seconds, a.rhs, a.jacobians);
        if (!have_a) printf("not reached                            ");
        if (have_b) printf("%9.3f ms %8.0f rhs %6.0f jac  ", 1e3 * b.seconds, b.rhs, b.jacobians);
        if (!have_b) printf("not reached                            ");
        if (have_a && have_b) printf("%6.3f", a.seconds / b.seconds);
        printf("\n");
    }
}

#define OSCILLATOR(C)                                                                                        \
    "fbd: 1\nbodies:\n  body: {mass: 1 kg, motion: slide, initial: {x: 1 m}, forces: [{spring: {stiffness: " \
    "1e6 N/m}}, "                                                                                            \
    "{damper: {coefficient: " C " N*s/m}}]}\nsimulate: {until: 1 s}\n"

static const char pendulum[] =
    "fbd: 1\nbodies:\n  body: {shape: point, mass: 1 kg, center: [0, -1 m], motion: pivot, "
    "initial: {theta: 2 rad}, forces: [gravity]}\nsimulate: {until: 100 s}\n";
static const char belt[] =
    "fbd: 1\nbodies:\n  body: {mass: 1 kg, motion: slide, initial: {v: 0.2 m/s}, forces: [gravity, "
    "normal, "
    "{spring: {stiffness: 100 N/m}}, {friction: {static: 0.4, kinetic: 0.25, surface_speed: 0.2 m/s}}]}\n"
    "simulate: {until: 200 s}\n";
static const struct scene scenes[] = {
    {"pendulum 100 s from 2 rad",
     pendulum,
     "body.theta",
     "body.omega",
     {100},
     1,
     pendulum_exact,
     2,
     5.27,
     CV_ADAMS,
     pendulum_acceleration,
     pendulum_slopes,
     2,
     0,
     0,
     0,
     false},
    {"belt stick-slip 200 s",
     belt,
     "body.x",
     "body.v",
     {200},
     1,
     belt_exact,
     0.04,
     0.25,
     CV_ADAMS,
     belt_acceleration,
     belt_slopes,
     0,
     0.2,
     0,
     0,
     true},
    {"stiff oscillator c = 2e3",
     OSCILLATOR("2e3"),
     "body.x",
     "body.v",
     {1e-3, 1e-2, 0.1, 1},
     4,
     oscillator_exact,
     1,
     1e3,
     CV_BDF,
     oscillator_acceleration,
     oscillator_slopes,
     1,
     0,
     1e6,
     2e3,
     false},
    {"stiff oscillator c = 1e4",
     OSCILLATOR("1e4"),
     "body.x",
     "body.v",
     {1e-3, 1e-2, 0.1, 1},
     4,
     oscillator_exact,
     1,
     1e3,
     CV_BDF,
     oscillator_acceleration,
     oscillator_slopes,
     1,
     0,
     1e6,
     1e4,
     false},
    {"stiff oscillator c = 1e5",
     OSCILLATOR("1e5"),
     "body.x",
     "body.v",
     {1e-3, 1e-2, 0.1, 1},
     4,
     oscillator_exact,
     1,
     1e3,
     CV_BDF,
     oscillator_acceleration,
     oscillator_slopes,
     1,
     0,
     1e6,
     1e5,
     false},
};

int main(void)
{
    gsl_set_error_handler_off();
    printf("%-28s %-6s %-41s %-41s ratio of times\n", "scene", "error", "fbd, default method", "CVODE");
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) compare(&scenes[i]);
    return 0;
}
