/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/equilibrium.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multiroots.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "dynamics/modes.h"
#include "dynamics/project.h"
#include "dynamics/rates.h"
#include "dynamics/statics.h"
#include "dynamics/tree.h"
#include "dynamics/user_states.h"
#include "numeric/lu.h"
#include "numeric/tolerances.h"
#include "rest/balance.h"
#include "rest/independent.h"
#include "rest/ropes.h"
#include "rest/start.h"

struct resting {
    struct fbd_state *state;
    double *work;  /* scratch of state_jacobian: dfdy, then dfdt */
    double *share; /* with couplings S = 1 - P, n x n, else NULL */
    double k;      /* acceleration per length of violation of the couplings */
    double zero;   /* accelerations below this count as zero */
    double *start; /* unknowns: start of the search */
    double *scale; /* unknowns: scales rates of user states to the size of accelerations */
    int *slip;     /* of the modes: those at the start */
    double *Q;     /* n: generalized forces without those of couplings, which do no work along a step */
    double *slots, *lambda; /* for rest_forces; lambda is zero */
};

/* The unknowns: coordinates, and user states, whose rates must vanish as well as the accelerations. */
static size_t unknowns_of(const struct resting *balance)
{
    return plan_rates(&balance->state->model->plan);
}

/* Index of unknown i in y. */
static size_t place_of(const struct fbd_state *state, size_t i)
{
    size_t n = (size_t)state->model->plan.n;
    return i < n ? i : n + i;
}

static void keep_place(const struct fbd_state *state, double *x)
{
    for (size_t i = 0; i < plan_rates(&state->model->plan); i++) x[i] = state->y[place_of(state, i)];
}

/* Set the state to rest at x. */
static void put_place(struct fbd_state *state, const double *x)
{
    size_t n = (size_t)state->model->plan.n;
    for (size_t i = 0; i < plan_rates(&state->model->plan); i++) state->y[place_of(state, i)] = x[i];
    memset(state->y + n, 0, n * sizeof *state->y);
}

/* Set the state to rest at q, or at the nearest position on the couplings. */
static void set_coordinates(struct resting *balance, const gsl_vector *q)
{
    struct fbd_state *state = balance->state;
    size_t n = (size_t)state->model->plan.n;
    for (size_t i = 0; i < q->size; i++) state->y[place_of(state, i)] = gsl_vector_get(q, i);
    memset(state->y + n, 0, n * sizeof *state->y);
    if (balance->share) state_project(state, false);
}

static int forces(const gsl_vector *q, void *context, gsl_vector *f)
{
    struct resting *balance = context;
    struct fbd_state *state = balance->state;
    set_coordinates(balance, q);
    state_evaluate(state);
    for (size_t i = 0; i < f->size; i++) {
        double off = balance->share ? state->y[place_of(state, i)] - gsl_vector_get(q, i) : 0;
        gsl_vector_set(f, i, balance->scale[i] * state->a[i] + balance->k * off);
    }
    return GSL_SUCCESS;
}

/* The derivative of residual i by unknown j, projected onto the couplings. */
static double slope_of(const struct resting *balance, size_t i, size_t j)
{
    const struct plan *plan = &balance->state->model->plan;
    size_t n = (size_t)plan->n;
    const double *row = balance->work + (n + i) * plan_size(plan);
    if (!balance->share || j >= n) return balance->scale[i] * row[place_of(balance->state, j)];
    double slope = 0;
    for (size_t l = 0; l < n; l++) slope += row[l] * balance->share[l * n + j];
    slope *= balance->scale[i];
    if (i < n) slope += balance->k * (balance->share[i * n + j] - (i == j));
    return slope;
}

/* A prescribed coordinate, and a user state whose rate does not depend on the unknowns, stay unchanged. */
static void hold_inert(const struct resting *balance, gsl_matrix *J)
{
    const size_t n = (size_t)balance->state->model->plan.n;
    for (size_t i = 0; i < J->size1; i++) {
        if (i < n && !coordinate_is_driven(balance->state->model, i)) continue;
        double most = 0;
        for (size_t j = 0; j < J->size2; j++) most = larger(most, fabs(gsl_matrix_get(J, i, j)));
        if (most == 0) gsl_matrix_set(J, i, i, -1);
    }
}

static int slopes(const gsl_vector *q, void *context, gsl_matrix *J)
{
    struct resting *balance = context;
    struct fbd_state *state = balance->state;
    size_t size = plan_size(&state->model->plan);
    double *dfdy = balance->work, *dfdt = dfdy + size * size;
    set_coordinates(balance, q);
    if (balance->share) independent_share(state, balance->share);
    struct instant at = state_instant(state);
    state_jacobian(state->model, &at, state->scratch, dfdy, dfdt);
    for (size_t i = 0; i < J->size1; i++)
        for (size_t j = 0; j < J->size2; j++) gsl_matrix_set(J, i, j, slope_of(balance, i, j));
    hold_inert(balance, J);
    return GSL_SUCCESS;
}

static int both(const gsl_vector *q, void *context, gsl_vector *f, gsl_matrix *J)
{
    forces(q, context, f);
    return slopes(q, context, J);
}

double equilibrium_size(const struct fbd_state *state)
{
    double most = vec_norm(state->model->scene->gravity);
    for (int i = 0; i < state->model->plan.n; i++) most = larger(most, fabs(state->a[i]));
    return most;
}

static double imbalance(const gsl_vector *f)
{
    double most = 0;
    for (size_t i = 0; i < f->size; i++) most = larger(most, fabs(gsl_vector_get(f, i)));
    return most;
}

/* ---- pseudo-transient continuation (Kelley and Keyes, SIAM J. Numer. Anal. 35, 1998)
 *
 * Implicit Euler steps of dq/ds = F(q), (1/h - dF/dq) d = F, whose h grows as they get shorter, so that they
 * end as Newton steps. With forces that have a potential this is a descent in the mass metric, to the
 * position where the scene would come to rest, from any distance. */

struct newton {
    size_t n;
    gsl_vector *q, *f;
    gsl_matrix *J;
    double *matrix, *d; /* n x n; n: the step */
    size_t *pivot;
};

static void newton_free(struct newton *newton)
{
    if (newton->q) gsl_vector_free(newton->q);
    if (newton->f) gsl_vector_free(newton->f);
    if (newton->J) gsl_matrix_free(newton->J);
    free(newton->matrix);
    free(newton->pivot);
}

static bool newton_new(struct newton *newton, size_t n)
{
    *newton = (struct newton){.n = n,
                              .q = gsl_vector_alloc(n),
                              .f = gsl_vector_alloc(n),
                              .J = gsl_matrix_alloc(n, n),
                              .matrix = calloc(n * n + n + 1, sizeof(double)),
                              .pivot = calloc(n + 1, sizeof(size_t))};
    if (!newton->q || !newton->f || !newton->J || !newton->matrix || !newton->pivot) return false;
    newton->d = newton->matrix + n * n;
    return true;
}

/* Compute the step for h; false if the matrix is singular. */
static bool newton_step(struct newton *newton, double h)
{
    size_t n = newton->n;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++)
            newton->matrix[i * n + j] = (i == j ? 1 / h : 0) - gsl_matrix_get(newton->J, i, j);
        newton->d[i] = gsl_vector_get(newton->f, i);
    }
    if (!lu_decompose(n, newton->matrix, newton->pivot)) return false;
    lu_solve(n, newton->matrix, newton->pivot, newton->d);
    return true;
}

/* Scale of coordinate i at q: 1 for an angle, or its length. */
static double size_of(const struct resting *balance, size_t i, double q)
{
    const struct fbd_model *model = balance->state->model;
    if (i < (size_t)model->plan.n && model->scene->coordinates[i].angle) return 1;
    return fmax(fabs(q), least_length_scale);
}

/* Copy the state, which satisfies the couplings, to q. */
static void take_coordinates(const struct resting *balance, gsl_vector *q)
{
    for (size_t i = 0; i < q->size; i++) gsl_vector_set(q, i, balance->state->y[place_of(balance->state, i)]);
}

/* The work of the forces along the step, projected onto the couplings. */
static double work_along(const struct resting *balance, const struct newton *newton)
{
    size_t n = newton->n;
    double work = 0;
    for (size_t i = 0; i < n; i++) {
        double d = balance->share ? 0 : newton->d[i];
        for (size_t j = 0; balance->share && j < n; j++) d += balance->share[i * n + j] * newton->d[j];
        work += d * balance->Q[i];
    }
    return work;
}

/* Compute the step for h. Returns its largest component relative to the limit, 0.3 of its scale, or infinity
 * where the step is an ascent: with too large an h unstable directions would lead to the unstable
 * equilibrium. */
static double stride(const struct resting *balance, struct newton *newton, double h)
{
    double most = 0;
    if (!newton_step(newton, h)) return HUGE_VAL;
    for (size_t i = 0; i < newton->n; i++) {
        double size = size_of(balance, i, gsl_vector_get(newton->q, i));
        most = larger(most, fabs(newton->d[i]) / (0.3 * size));
    }
    return work_along(balance, newton) > 0 ? most : HUGE_VAL;
}

/* First h: a step of F alone is at most 0.1, and h is at most half the bound at which the derivatives could
 * reverse it. */
static double first_h(const struct newton *newton)
{
    double most = imbalance(newton->f) / 0.1;
    for (size_t i = 0; i < newton->n; i++) {
        double sum = 0;
        for (size_t j = 0; j < newton->n; j++) sum += fabs(gsl_matrix_get(newton->J, i, j));
        most = larger(most, 2 * sum);
    }
    return most > 0 ? 1 / most : 1;
}

/* Start from the state, or from the nearest position that its ropes allow; returns the imbalance there. */
static double begin_down(struct resting *balance, struct newton *newton, double *h)
{
    take_coordinates(balance, newton->q);
    forces(newton->q, balance, newton->f);
    take_coordinates(balance, newton->q);
    both(newton->q, balance, newton->f, newton->J);
    *h = first_h(newton);
    return imbalance(newton->f);
}

/* One step, and h of the next one; false when there is no descent. */
static bool step_down(struct resting *balance, struct newton *newton, double *h)
{
    const double shortest = DBL_MIN, longest = 1 / DBL_MIN; /* an infinite step cannot be halved */
    take_coordinates(balance, newton->q);
    both(newton->q, balance, newton->f, newton->J);
    struct instant at = state_instant(balance->state);
    rest_forces(balance->state->model, &at, balance->lambda, true, balance->slots, balance->Q);
    double most = stride(balance, newton, *h);
    while (!(most <= 1) && *h > shortest) {
        *h /= 4;
        most = stride(balance, newton, *h);
    }
    if (!(most <= 1)) return false;
    for (size_t i = 0; i < newton->n; i++)
        gsl_vector_set(newton->q, i, gsl_vector_get(newton->q, i) + newton->d[i]);
    forces(newton->q, balance, newton->f);
    *h = fmin(*h * fmin(4, 0.6 / most), longest);
    return true;
}

static bool let_down(struct resting *balance, struct newton *newton)
{
    enum { most_steps = 2000 };
    double h, zero = balance->zero, before = begin_down(balance, newton, &h);
    for (int step = 0; step < most_steps; step++) {
        bool there = before <= zero, began = false;
        if (!there) {
            if (!step_down(balance, newton, &h)) return false;
            began = ropes_take_up(balance->state);
            double after = imbalance(newton->f);
            there = !began && after <= 1e4 * zero && after >= before; /* rounding prevents progress */
            before = after;
        }
        if (there && !ropes_let_go(balance->state)) return true;
        if (there || began) before = begin_down(balance, newton, &h);
    }
    return before <= 1e4 * zero;
}

/* A further Newton step is less than a hundredth of the scale that coordinates had at the start: otherwise
 * forces only decay towards infinity (K/x^2). */
static bool arrived(struct resting *balance, struct newton *newton)
{
    size_t n = newton->n;
    double slope = 0;
    take_coordinates(balance, newton->q);
    both(newton->q, balance, newton->f, newton->J);
    for (size_t i = 0; i < n * n; i++) slope = larger(slope, fabs(gsl_matrix_get(newton->J, i / n, i % n)));
    if (slope == 0) return true;                         /* no force depends on position */
    if (!newton_step(newton, 1e6 / slope)) return false; /* a small 1/h regularizes free coordinates */
    for (size_t i = 0; i < n; i++)
        if (!(fabs(newton->d[i]) <= 0.01 * size_of(balance, i, balance->start[i]))) return false;
    return true;
}

/* ---- the nearest of several equilibria */

/* Newton's method from q until the residual no longer decreases; sets the state to the best point. */
static bool find_balance_from(struct resting *balance, gsl_vector *q, gsl_multiroot_fdfsolver *solver)
{
    enum { most_iterations = 200 };
    gsl_multiroot_function_fdf function = {forces, slopes, both, q->size, balance};
    int status = gsl_multiroot_fdfsolver_set(solver, &function, q);
    double least = imbalance(solver->f);
    /* Already an equilibrium: rounding would displace free coordinates arbitrarily. */
    bool there = least <= balance->zero;
    for (int i = 0; !there && i < most_iterations && status == GSL_SUCCESS && least > 0; i++) {
        status = gsl_multiroot_fdfsolver_iterate(solver);
        bool better = imbalance(solver->f) < least;
        if (!better && least <= balance->zero) break;
        if (!better) continue;
        least = imbalance(solver->f);
        gsl_vector_memcpy(q, solver->x);
    }
    set_coordinates(balance, q);
    state_evaluate(balance->state);
    /* Residuals above `zero` may come from the rounding of positions: still an equilibrium. */
    return least <= 1e4 * balance->zero;
}

/* At an unstable symmetric start the derivative may vanish (that of the moment of a horizontal rod), and
 * Newton's method may leap from near it. So neighbouring starts are tried as well, +-0.1, 0.2, ... 1.6 rad,
 * or this factor times the scale of a coordinate; the equilibrium nearest to the state is used. */
static void set_start(gsl_vector *q, const struct fbd_model *model, const double *origin, int trial)
{
    double share = trial == 0 ? 0 : ldexp(0.1, (trial - 1) / 2) * (trial % 2 ? -1 : 1);
    for (size_t i = 0; i < q->size; i++) {
        bool angle = i < (size_t)model->plan.n && model->scene->coordinates[i].angle;
        double size = angle ? 1 : fmax(fabs(origin[i]), least_length_scale);
        gsl_vector_set(q, i, origin[i] + share * size);
    }
}

static double distance_between(const double *a, const double *b, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) most = larger(most, fabs(a[i] - b[i]));
    return most;
}

/* 1 found, 0 none near, -1 out of memory. */
static int search(struct resting *balance)
{
    enum { most_trials = 11 };
    struct fbd_state *state = balance->state;
    size_t n = unknowns_of(balance);
    gsl_vector *q = gsl_vector_alloc(n);
    double *origin = calloc(3 * n + 1, sizeof *origin), *best = origin ? origin + n : NULL,
           *there = origin ? best + n : NULL, nearest = HUGE_VAL;
    gsl_multiroot_fdfsolver *solver = gsl_multiroot_fdfsolver_alloc(gsl_multiroot_fdfsolver_hybridsj, n);
    bool made = q && origin && solver;
    if (made) keep_place(state, origin);
    for (int trial = 0; made && trial < most_trials; trial++) {
        set_start(q, state->model, origin, trial);
        if (!find_balance_from(balance, q, solver) || ropes_are_too_long(state)) continue;
        keep_place(state, there);
        double distance = distance_between(there, origin, n);
        /* Of two at equal distance to rounding, keep the first. */
        if (!(distance < nearest * (1 - undecided_part))) continue;
        nearest = distance;
        memcpy(best, there, n * sizeof *best);
    }
    if (made && nearest < HUGE_VAL) {
        put_place(state, best);
        state_evaluate(state);
    }
    if (solver) gsl_multiroot_fdfsolver_free(solver);
    if (q) gsl_vector_free(q);
    free(origin);
    return made ? nearest < HUGE_VAL : -1;
}

/* The size of the mechanism. */
static double reach_of(const struct fbd_state *state)
{
    double reach = 0;
    for (int i = 1; i < state->model->tree->joined; i++)
        reach = fmax(reach, vec_norm(state->tree->links[i].p));
    return reach > 0 ? reach : 1;
}

/* Set the scales from the accelerations at rest at the start; false when they are not finite. */
static bool measure(struct resting *balance)
{
    struct fbd_state *state = balance->state;
    size_t n = (size_t)state->model->plan.n;
    memset(state->y + n, 0, n * sizeof *state->y);
    if (balance->share) state_project(state, false);
    state_evaluate(state);
    double size = equilibrium_size(state);
    /* A start in equilibrium has accelerations at round-off level only, which are no scale. */
    balance->zero = fmax(negligible_part * size, round_off(8, balance_size(state)));
    for (size_t i = 0; i < unknowns_of(balance); i++) balance->scale[i] = 1;
    for (size_t i = n; i < unknowns_of(balance); i++) {
        double rate = fabs(state->a[i]) + user_state_rate_size(state, (int)(i - n));
        if (rate > 0 && size > 0 && isfinite(rate)) balance->scale[i] = size / rate;
    }
    if (balance->share) balance->k = size / reach_of(state);
    return isfinite(size);
}

static void balance_free(struct resting *balance)
{
    free(balance->work);
    free(balance->share);
    free(balance->start);
    free(balance->slip);
}

/* 1 made, 0 the start is not finite, -1 out of memory. */
static int balance_new(struct resting *balance, struct fbd_state *state)
{
    size_t n = (size_t)state->model->plan.n, size = plan_size(&state->model->plan),
           unknowns = plan_rates(&state->model->plan);
    bool coupled = state->model->tree->coupling_count > 0;
    size_t slots = (size_t)state->model->plan.slots;
    size_t rows = coupled ? (size_t)state->model->tree->row_count : 0;
    *balance = (struct resting){.state = state,
                                .work = calloc(size * size + size + 1, sizeof(double)),
                                .share = coupled ? calloc(n * n + 1, sizeof(double)) : NULL,
                                .start = calloc(2 * unknowns + n + slots + rows + 1, sizeof(double)),
                                .slip = calloc(state->model->plan.mode_count + 1, sizeof(int))};
    if (!balance->work || !balance->start || !balance->slip || (coupled && !balance->share)) return -1;
    balance->scale = balance->start + unknowns;
    balance->Q = balance->scale + unknowns;
    balance->slots = balance->Q + n;
    balance->lambda = balance->slots + slots;
    keep_place(state, balance->start);
    memcpy(balance->slip, state->slip, state->model->plan.mode_count * sizeof *balance->slip);
    return measure(balance);
}

/* Return to the start of the search and its modes. */
static void go_back(struct resting *balance)
{
    struct fbd_state *state = balance->state;
    put_place(state, balance->start);
    memcpy(state->slip, balance->slip, state->model->plan.mode_count * sizeof *balance->slip);
    state_evaluate(state);
}

int equilibrium_settle(struct fbd_state *state)
{
    struct resting balance;
    struct newton newton = {0};
    int made = balance_new(&balance, state);
    if (made > 0 && !newton_new(&newton, unknowns_of(&balance))) made = -1;
    bool downhill = state->model->plan.own == 0; /* user states have no potential energy */
    int found = made > 0 ? downhill && let_down(&balance, &newton) && arrived(&balance, &newton) : made;
    if (made > 0 && found == 0) {
        go_back(&balance);
        found = search(&balance);
        if (found > 0) found = arrived(&balance, &newton);
    }
    newton_free(&newton);
    balance_free(&balance);
    return found;
}

/* Where slack ropes prevent all equilibria found without them, descend until they are taut. */
int equilibrium_search(struct fbd_state *state)
{
    struct resting balance;
    int made = balance_new(&balance, state), found = made > 0 ? search(&balance) : made;
    if (made > 0 && found == 0) go_back(&balance);
    balance_free(&balance);
    return found == 0 && ropes_are_slack(state) ? equilibrium_settle(state) : found;
}
