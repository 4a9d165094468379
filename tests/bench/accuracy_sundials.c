/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Programs by hand on SUNDIALS: CVODE (Adams, BDF) and ARKODE (explicit of order 8, diagonally implicit of
 * order 5), with its root finding for the belt.
 */
#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "accuracy.h"

const char sundials_version[] = SUNDIALS_VERSION;

static int rhs(realtype t, N_Vector y, N_Vector f, void *context)
{
    const struct mode *mode = context;
    return mode->problem->rhs(t, NV_DATA_S(y), NV_DATA_S(f), context);
}

static int jacobian(realtype t, N_Vector y, N_Vector f, SUNMatrix J, void *context, N_Vector a, N_Vector b,
                    N_Vector c)
{
    (void)f, (void)a, (void)b, (void)c;
    const struct mode *mode = context;
    double rows[4], dfdt[2];
    mode->problem->jacobian(t, NV_DATA_S(y), rows, dfdt, context);
    for (int i = 0; i < 4; i++) SM_ELEMENT_D(J, i / 2, i % 2) = rows[i];
    return 0;
}

static int roots(realtype t, N_Vector y, realtype *g, void *context)
{
    double rate;
    (void)t;
    g[0] = belt_event(context, NV_DATA_S(y), &rate);
    return 0;
}

/* ---- what the two families have in common: a program is these calls */

struct program {
    void *memory;
    int (*advance)(void *memory, realtype until, N_Vector y, realtype *t, int task);
    int (*again)(void *memory, realtype t, N_Vector y);
    int (*stop_at)(void *memory, realtype t);
    int root, reached, stopped; /* what `advance` returns */
};

static int cvode_advance(void *memory, realtype until, N_Vector y, realtype *t, int task)
{
    return CVode(memory, until, y, t, task);
}

static int erk_again(void *memory, realtype t, N_Vector y)
{
    return ERKStepReInit(memory, rhs, t, y);
}

static int ark_again(void *memory, realtype t, N_Vector y)
{
    return ARKStepReInit(memory, NULL, rhs, t, y);
}

/* Integrate to `until`, from event to event. */
static bool integrate(const struct program *program, struct mode *mode, N_Vector y, realtype *t, double until)
{
    enum { normal = 1 }; /* CV_NORMAL, ARK_NORMAL */
    while (*t < until) {
        double next = until;
        if (mode->problem->kind == square) {
            double half = floor(*t / WAVE_HALF + 0.5);
            next = fmin((half + 1) * WAVE_HALF, until);
            mode->force = fmod(half, 2) == 0 ? WAVE_SIZE : -WAVE_SIZE;
            if (program->again(program->memory, *t, y) != 0) return false;
        }
        if (program->stop_at(program->memory, next) != 0) return false;
        int flag = program->advance(program->memory, next, y, t, normal);
        if (flag == program->root) {
            mode->sticking = !mode->sticking;
            NV_Ith_S(y, 1) = BELT_SPEED;
            if (program->again(program->memory, *t, y) != 0) return false;
        } else if (flag != program->reached && flag != program->stopped) {
            return false;
        }
    }
    return true;
}

static double measure(const struct program *program, struct mode *mode, N_Vector y)
{
    const struct problem *problem = mode->problem;
    double error = 0;
    realtype t = 0;
    for (size_t i = 0; i < problem->time_count; i++) {
        if (!integrate(program, mode, y, &t, problem->times[i])) return NAN;
        error = fmax(error, problem_error(problem, problem->times[i], NV_DATA_S(y)));
    }
    return error;
}

/* ---- CVODE */

struct vectors {
    SUNContext context;
    N_Vector y, absolute;
    SUNMatrix A;
    SUNLinearSolver solver;
};

static void vectors_make(struct vectors *v, const struct problem *problem, double tolerance)
{
    SUNContext_Create(NULL, &v->context);
    v->y = N_VNew_Serial((sunindextype)problem->size, v->context);
    v->absolute = N_VNew_Serial((sunindextype)problem->size, v->context);
    v->A = SUNDenseMatrix((sunindextype)problem->size, (sunindextype)problem->size, v->context);
    v->solver = SUNLinSol_Dense(v->y, v->A, v->context);
    for (size_t i = 0; i < problem->size; i++) {
        NV_Ith_S(v->y, i) = problem->y0[i];
        NV_Ith_S(v->absolute, i) = tolerance * problem->scale[i];
    }
}

static void vectors_free(struct vectors *v)
{
    SUNLinSolFree(v->solver);
    SUNMatDestroy(v->A);
    N_VDestroy(v->y);
    N_VDestroy(v->absolute);
    SUNContext_Free(&v->context);
}

enum { most_steps = 100000000 };

static double by_cvode(const struct problem *problem, int family, double tolerance)
{
    struct mode mode = {.problem = problem, .sticking = problem->kind == belt};
    struct vectors v;
    vectors_make(&v, problem, tolerance);
    void *memory = CVodeCreate(family, v.context);
    CVodeInit(memory, rhs, 0, v.y);
    CVodeSVtolerances(memory, tolerance, v.absolute);
    CVodeSetUserData(memory, &mode);
    CVodeSetMaxNumSteps(memory, most_steps);
    CVodeSetErrFile(memory, NULL);
    CVodeSetLinearSolver(memory, v.solver, v.A);
    if (problem->jacobian) CVodeSetJacFn(memory, jacobian);
    if (problem->kind == belt) CVodeRootInit(memory, 1, roots);
    const struct program program = {memory,         cvode_advance, CVodeReInit,    CVodeSetStopTime,
                                    CV_ROOT_RETURN, CV_SUCCESS,    CV_TSTOP_RETURN};
    double error = measure(&program, &mode, v.y);
    CVodeFree(&memory);
    vectors_free(&v);
    return error;
}

static double run_adams(const struct problem *problem, const fbd_model *model, double tolerance)
{
    (void)model;
    return by_cvode(problem, CV_ADAMS, tolerance);
}

static double run_bdf(const struct problem *problem, const fbd_model *model, double tolerance)
{
    (void)model;
    return by_cvode(problem, CV_BDF, tolerance);
}

/* ---- ARKODE */

static double run_erk(const struct problem *problem, const fbd_model *model, double tolerance)
{
    struct mode mode = {.problem = problem, .sticking = problem->kind == belt};
    struct vectors v;
    (void)model;
    vectors_make(&v, problem, tolerance);
    void *memory = ERKStepCreate(rhs, 0, v.y, v.context);
    ERKStepSetOrder(memory, 8);
    ERKStepSVtolerances(memory, tolerance, v.absolute);
    ERKStepSetUserData(memory, &mode);
    ERKStepSetMaxNumSteps(memory, most_steps);
    ERKStepSetErrFile(memory, NULL);
    if (problem->kind == belt) ERKStepRootInit(memory, 1, roots);
    const struct program program = {memory,          ERKStepEvolve, erk_again,       ERKStepSetStopTime,
                                    ARK_ROOT_RETURN, ARK_SUCCESS,   ARK_TSTOP_RETURN};
    double error = measure(&program, &mode, v.y);
    ERKStepFree(&memory);
    vectors_free(&v);
    return error;
}

static double run_dirk(const struct problem *problem, const fbd_model *model, double tolerance)
{
    struct mode mode = {.problem = problem};
    struct vectors v;
    (void)model;
    vectors_make(&v, problem, tolerance);
    void *memory = ARKStepCreate(NULL, rhs, 0, v.y, v.context);
    ARKStepSetOrder(memory, 5);
    ARKStepSVtolerances(memory, tolerance, v.absolute);
    ARKStepSetUserData(memory, &mode);
    ARKStepSetMaxNumSteps(memory, most_steps);
    ARKStepSetErrFile(memory, NULL);
    ARKStepSetLinearSolver(memory, v.solver, v.A);
    ARKStepSetJacFn(memory, jacobian);
    const struct program program = {memory,          ARKStepEvolve, ark_again,       ARKStepSetStopTime,
                                    ARK_ROOT_RETURN, ARK_SUCCESS,   ARK_TSTOP_RETURN};
    double error = measure(&program, &mode, v.y);
    ARKStepFree(&memory);
    vectors_free(&v);
    return error;
}

const struct solver sundials_solvers[] = {
    {.name = "CVODE Adams", .for_others = true, .run = run_adams},
    {.name = "CVODE BDF", .for_stiff = true, .run = run_bdf},
    {.name = "ARKODE, explicit order 8", .for_others = true, .run = run_erk},
    {.name = "ARKODE, DIRK order 5", .for_stiff = true, .run = run_dirk},
};
const size_t sundials_solver_count = sizeof sundials_solvers / sizeof *sundials_solvers;
