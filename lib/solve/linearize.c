/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/linearize.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/call.h"
#include "base/diag.h"
#include "dynamics/finite.h"
#include "dynamics/friction.h"
#include "dynamics/modes.h"
#include "solve/equilibrium.h"
#include "solve/start.h"

/* ---- eigenvalues */

/* By frequency, then the one with the positive imaginary part first. */
static int by_frequency(const void *left, const void *right)
{
    const fbd_mode *a = left, *b = right;
    double difference = a->frequency - b->frequency;
    if (fabs(difference) > 1e-12 * (a->frequency + b->frequency)) return difference < 0 ? -1 : 1;
    return a->im > b->im ? -1 : a->im < b->im ? 1 : a->re < b->re ? -1 : 1;
}

/* 1 found, 0 the iteration does not end, -1 out of memory. */
static int find_modes(struct fbd_linearization *linear)
{
    size_t size = linear->size, bytes = size * size * sizeof *linear->A;
    double *A = malloc(bytes); /* a copy, which is overwritten */
    gsl_vector_complex *values = gsl_vector_complex_alloc(size);
    gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc(size);
    bool made = A && values && work, done = false;
    if (made) {
        memcpy(A, linear->A, bytes);
        gsl_matrix_view view = gsl_matrix_view_array(A, size, size);
        gsl_eigen_nonsymm_params(0, 1, work); /* balanced: coordinates have different units */
        done = gsl_eigen_nonsymm(&view.matrix, values, work) == GSL_SUCCESS;
        for (size_t i = 0; done && i < size; i++) {
            gsl_complex lambda = gsl_vector_complex_get(values, i);
            double re = GSL_REAL(lambda), im = GSL_IMAG(lambda), frequency = hypot(re, im);
            linear->modes[i] = (fbd_mode){re, im, frequency, frequency > 0 ? -re / frequency : NAN};
            done = isfinite(frequency) && (frequency == 0 || isfinite(1 / frequency));
        }
        if (done) qsort(linear->modes, size, sizeof *linear->modes, by_frequency);
    }
    if (work) gsl_eigen_nonsymm_free(work);
    if (values) gsl_vector_complex_free(values);
    free(A);
    return made ? done : -1;
}

/* ---- the whole */

/* With loops the coordinates are not independent, and with a prescribed motion there is no state of rest. */
static bool refuse_closed(const struct fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    bool tied = model->tree && model->tree->tie_count > 0;
    int driven = -1;
    for (size_t b = 0; b < model->body_count; b++)
        if (model->bodies[b].drive >= 0) driven = (int)b;
    if (!tied && driven < 0) return false;
    struct pos at = tied ? model->scene->constraints[model->tree->ties[0].constraint].at
                         : model->bodies[driven].source->motion.at;
    diag_add(errors, FBD_ERROR, "not-independent", at,
             "simulate it, from a start near the equilibrium; a tree of bodies can be linearised",
             tied ? "the coupling `%s` makes coordinates depend on each other"
                  : "the motion of `%s` is prescribed: it is never at rest",
             tied ? model->tree->ties[0].name : model->bodies[driven].name);
    return true;
}

/* What is at rest sticks to a surface at rest; under a surface that moves on it slips, and its friction is a
 * force like others. */
static bool refuse_sticking(const struct fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    const struct plan *plan = &model->plan;
    struct instant at = state_instant(state);
    for (size_t i = 0; i < plan->friction_count; i++) {
        double acceleration;
        if (friction_surface_speed(&plan->frictions[i], &at, &acceleration) != 0) continue;
        diag_add(errors, FBD_ERROR, "sticks", model->loads[plan->frictions[i].load].source->at,
                 "leave the friction out to see the motion about the balance of the other forces",
                 "`%s` has dry friction: at rest it sticks, and a body that sticks has no linear motion",
                 model->bodies[plan->frictions[i].body].name);
        return true;
    }
    return false;
}

static fbd_linearization *linearization_new(const struct fbd_model *model)
{
    size_t n = (size_t)model->plan.n, size = 2 * n;
    fbd_linearization *linear = calloc(1, sizeof *linear);
    if (!linear) return NULL;
    *linear = (struct fbd_linearization){
        .model = model,
        .size = size,
        .A = calloc(size * size + size + 1, sizeof(double)), /* df/dt behind it */
        .modes = calloc(size + 1, sizeof(fbd_mode)),
        .q = calloc(n + 1, sizeof(double)),
    };
    if (linear->A && linear->modes && linear->q) return linear;
    fbd_linearization_free(linear);
    return NULL;
}

/* The Jacobian at the state into `work` (df/dt behind it), and the largest slope that each acceleration
 * has along a coordinate. */
static void slopes_at(struct fbd_state *state, double *work, double *most)
{
    size_t n = (size_t)state->model->plan.n, size = 2 * n;
    struct instant at = state_instant(state);
    state_jacobian(state->model, &at, state->scratch, work, work + size * size);
    for (size_t i = 0; i < n; i++) {
        most[i] = 0;
        for (size_t j = 0; j < n; j++) most[i] = fmax(most[i], fabs(work[(n + i) * size + j]));
    }
}

/* Where the slope of a force dies out toward the equilibrium (f = -k x^3), Newton never quite arrives, and
 * what is left of the slope is no frequency: in the limit it is zero. Told by this, that the slope was larger
 * at the start, and is so already a little of the way back to there. */
static void drop_dying_slopes(struct fbd_linearization *linear, const double *before, const double *beside,
                              const double *there, fbd_errors *errors)
{
    const double died_out = 1e-4, of_beside = 0.1;
    size_t n = linear->size / 2;
    for (size_t i = 0; i < n; i++) {
        if (!(there[i] < died_out * before[i] && there[i] < of_beside * beside[i])) continue;
        for (size_t j = 0; j < n; j++) linear->A[(n + i) * linear->size + j] = 0;
        linear->degenerate = true;
        diag_add(errors, FBD_WARNING, "degenerate-equilibrium", (struct pos){0, 0},
                 "the motion about it is not linear, however small: simulate it",
                 "the forces along `%s` have no slope at the equilibrium: it has no linear frequency",
                 linear->model->labels[i].name);
    }
}

/* Find the balance and A there; 1 found, 0 none near, -1 out of memory. */
static int find_matrix(struct fbd_linearization *linear, struct fbd_state *state, fbd_errors *errors)
{
    const double little = 1e-3; /* of the way back to the start */
    size_t n = linear->size / 2;
    double *origin = calloc(4 * n + 1, sizeof *origin);
    if (!origin) return -1;
    double *before = origin + n, *beside = before + n, *there = beside + n;
    memcpy(origin, state->y, n * sizeof *origin);
    slopes_at(state, linear->A, before);
    int found = equilibrium_search(state);
    if (found > 0) {
        memcpy(linear->q, state->y, n * sizeof *linear->q);
        for (size_t i = 0; i < n; i++) state->y[i] += little * (origin[i] - linear->q[i]);
        slopes_at(state, linear->A, beside);
        memcpy(state->y, linear->q, n * sizeof *linear->q);
        state_evaluate(state);
        slopes_at(state, linear->A, there); /* leaves the Jacobian in A */
        drop_dying_slopes(linear, before, beside, there, errors);
    }
    free(origin);
    return found;
}

/* The balance, and every slope there. */
static bool is_finite(const struct fbd_linearization *linear, struct fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = linear->model;
    size_t size = linear->size, n = size / 2;
    if (!start_question(state, true, errors)) return false;
    for (size_t i = 0; i < size * size; i++) {
        if (isfinite(linear->A[i])) continue;
        size_t row = i / size % n, column = i % size;
        const struct label *label = &model->labels[column % n];
        diag_add(errors, FBD_ERROR, "not-finite", (struct pos){0, 0}, NULL,
                 "at the equilibrium the slope of the acceleration along `%s` with `%s` is not finite: %s",
                 model->labels[row].name, column < n ? label->name : label->rate_name,
                 not_finite_reason(linear->A[i]));
        return false;
    }
    return true;
}

/* `found` is 0 where there is no balance, or with `balanced` no eigenvalues; else memory is out. */
static void note_failure(const struct fbd_model *model, bool settled, int found, bool balanced,
                         fbd_errors *errors)
{
    struct pos nowhere = {0, 0};
    if (!settled)
        diag_add(errors, FBD_ERROR, "unsettled", nowhere, "look from another state, with --at",
                 "at the start no choice of branches agrees with the forces");
    else if (found != 0)
        diag_out_of_memory(errors);
    else if (balanced)
        diag_add(errors, FBD_ERROR, "not-finite", nowhere, NULL,
                 "the eigenvalues of the motion about the equilibrium (`%s`, ...) are not found, or not "
                 "finite: its slopes are too far apart",
                 model->labels[0].name);
    else
        diag_add(errors, FBD_ERROR, "no-equilibrium", nowhere,
                 "start nearer to it: set the initial values, or give --at",
                 "no equilibrium was found near the start");
}

static fbd_linearization *linearize(fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    diag_in_file(errors, model->scene->file);
    size_t n = (size_t)model->plan.n;
    if (model->plan.friction_count > 0) memset(state->y + n, 0, n * sizeof *state->y); /* modes of rest */
    bool settled = modes_settle(state, NULL);
    if (!start_question(state, settled, errors) || refuse_closed(state, errors) ||
        refuse_sticking(state, errors))
        return NULL;
    fbd_linearization *linear = linearization_new(model);
    int found = linear && settled ? find_matrix(linear, state, errors) : -1;
    bool said = found > 0 && !is_finite(linear, state, errors);
    int modes = found > 0 && !said ? find_modes(linear) : -1;
    if (modes > 0) return linear;
    if (!said) note_failure(model, settled, found > 0 ? modes : found, found > 0, errors);
    fbd_linearization_free(linear);
    return NULL;
}

fbd_linearization *fbd_linearize(fbd_state *state, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_linearization *linear = state ? linearize(state, errors) : call_refuse(errors, "there is no state");
    diag_end(&call);
    return linear;
}

void fbd_linearization_free(fbd_linearization *linearization)
{
    if (!linearization) return;
    free(linearization->A);
    free(linearization->modes);
    free(linearization->q);
    free(linearization);
}

size_t fbd_linearization_size(const fbd_linearization *linearization)
{
    if (!linearization) return 0;
    return linearization->size;
}

const double *fbd_linearization_matrix(const fbd_linearization *linearization)
{
    if (!linearization) return NULL;
    return linearization->A;
}

fbd_mode fbd_linearization_mode(const fbd_linearization *linearization, size_t index)
{
    return linearization && index < linearization->size ? linearization->modes[index]
                                                        : (fbd_mode){NAN, NAN, NAN, NAN};
}
