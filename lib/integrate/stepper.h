/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One accepted step at a time, with any method of method.h: the body of an integration loop.
 *
 * In addition to gsl_odeiv2_evolve_apply: the error norm does not depend on units (error_norm.h); a rejected
 * step leaves the state unchanged; NaN is never accepted; the reason of each rejection is counted; the step
 * can be evaluated inside (dense.h) and redone in part; multistep methods get the driver they require.
 *
 * Use: stepper_reset at the start and after every discontinuity of state or right-hand side, then
 * stepper_step until t == t_limit. Time runs forward. Only stepper_alloc allocates memory.
 */
#ifndef FBD_INTEGRATE_STEPPER_H
#define FBD_INTEGRATE_STEPPER_H

#include "base/time_dd.h"
#include "integrate/layout.h"
#include "integrate/method.h"
#include "integrate/stepper_state_view.h"
#include "integrate/system.h"

struct stepper;

struct stepper_options {
    const struct method *method;
    struct layout layout;
    double tolerance; /* relative to the scales of error_norm.h, for each step; above 0 */
    double h_max;     /* no step is larger; 0: no bound */
    double h_fixed;   /* above 0: the size of all steps, whatever their error and h_max */
};

enum stepper_status {
    stepper_ok,
    stepper_underflow,    /* rejected until t + h == t; the reason is in stepper_counts.last */
    stepper_bad_function, /* the right-hand side returned GSL_EBADFUNC: stop */
    stepper_fixed_failed, /* a step of fixed size could not be made; the reason is in stepper_counts.last */
    stepper_misuse,       /* t_limit <= t, *h <= 0, another dimension, no Jacobian for an implicit method */
    stepper_no_memory     /* of a switcher, for its other method */
};

/* Why an attempt was rejected. */
enum rejection {
    rejected_error,      /* error above tolerance */
    rejected_rhs,        /* right-hand side or Jacobian returned a code other than 0 */
    rejected_not_finite, /* right-hand side, Jacobian or new state was not finite */
    rejected_iteration,  /* an implicit equation was not solved */
    rejection_kinds
};

struct stepper_counts {
    unsigned long accepted;
    unsigned long rejected[rejection_kinds];
    enum rejection last; /* of the latest step with a rejection; rhs or not finite if among its reasons */
    double growth;       /* upper limit of the next step over the last one, by errors and stability */
};

/* NULL when memory is out or an option is unusable. */
struct stepper *stepper_alloc(const struct stepper_options *options);
void stepper_free(struct stepper *stepper);

/* Forget all steps, evaluate f = f(t, y) and choose the size *h of the first step towards t_limit (one more
 * evaluation). The scales of the error norm are kept and updated by y. GSL_SUCCESS, GSL_EINVAL for t_limit <=
 * t, or the code of the right-hand side; then *h is not set. */
int stepper_reset(struct stepper *stepper, struct counted_system *system, struct time_dd t, const double *y,
                  double *f, struct time_dd t_limit, double *h);

/* The same for an exact method, with the slopes f at (t, y) given. */
int stepper_restart(struct stepper *stepper, struct time_dd t, const double *y, const double *f,
                    struct time_dd t_limit, double *h);

/* Make one accepted step from (*t, y) with slopes f = f(*t, y), not beyond t_limit. On stepper_ok *t, y and f
 * are those of its end, and *h is the size proposed for the next one. On any other status *t, y and f are
 * unchanged; reset before the next step.
 *
 * *h is the size to try first. A step that would end within 1 % of t_limit ends there, *t == t_limit exactly;
 * if less than a second step of this size would remain, the remaining time is halved. Such a cut does not
 * reduce the proposal. Other steps end at doubles, unless they are as short as the spacing of doubles. */
enum stepper_status stepper_step(struct stepper *stepper, struct counted_system *system, struct time_dd *t,
                                 double *y, double *f, double *h, struct time_dd t_limit);

/* State at time t within the last accepted step, t0 <= t <= t1; at its ends bit for bit the states of the
 * step. Explicit methods and msadams use the interpolants of dense.h, msbdf the polynomial of its last points
 * (history.h), rodas5p its own. Other implicit one-step methods repeat the step up to Chebyshev points or,
 * where no polynomial converges, up to t (dense_by_resteps.h), since slopes do not help over a stiff step,
 * and bsimp makes steps too long for an interpolant. If that fails, only the ends are used
 * (dense_eval_plain). The system of that step is evaluated and must still exist. GSL_SUCCESS, or GSL_EINVAL
 * without a last step or for t outside it; a double next to an end counts as that end. */
int stepper_dense(struct stepper *stepper, struct time_dd t, double *y);

/* The degree of the polynomials of stepper_dense; where it is not a polynomial (*negligible above 0), the
 * degree that approximates the state to that part of its size over most steps. */
int stepper_degree(const struct stepper *stepper, double *negligible);

/* Component i from `from` to `to` within the last step, as by dense_powers; -1 also for methods whose dense
 * output is not a polynomial. */
int stepper_powers(struct stepper *stepper, struct time_dd from, struct time_dd to, size_t i, double *c);

/* The same as by dense_powers_of_ends. */
int stepper_powers_of_ends(struct stepper *stepper, struct time_dd from, struct time_dd to, size_t i,
                           double *c);

/* State y and slopes f at time t within the last accepted step with the full accuracy of the method:
 * one-step methods make a step from its start to t, multistep methods, and others where that fails, use
 * stepper_dense. Codes as there, or that of a right-hand side that fails at t. */
int stepper_partial(struct stepper *stepper, struct time_dd t, double *y, double *f);

/* Is the interpolant of the last step good up to an event at *t? Where it is far from a separate step to a point before *t,
 * that step replaces the last one: a narrow peak behind *t may have affected the stages that serve the interpolant alone. The
 * point is not *t itself, since the direction of a velocity that ends there is round-off. Returns 1 if replaced, with its end
 * in *t and y and f there; 0 if unchanged; or a code as above. */
int stepper_shorten(struct stepper *stepper, struct time_dd *t, double *y, double *f);

/* State and slopes by as many steps as the tolerance requires (substeps.h). GSL_EFAILED if they do not reach
 * t, GSL_ENOMEM, GSL_EINVAL for a multistep method. The last step is unchanged. */
int stepper_walk(struct stepper *stepper, struct time_dd t, double *y, double *f);

/* Try a step of size h from the start of the last step of another stepper and discard it. Returns its error
 * ratio (at most 1 would be accepted), INFINITY if it fails or for a multistep method. The last steps of both
 * are unchanged. */
double stepper_attempt(struct stepper *stepper, struct counted_system *system, const struct stepper *other,
                       double h);

/* linear_set_matrix for a stepper of that method; no effect for others. */
void stepper_set_linear(struct stepper *stepper, const double *A, double rho);

/* The size of the last step times the fastest rate of the system that the method has detected lately
 * (error_norm_rate); INFINITY if it does not detect rates. */
double stepper_h_rate(const struct stepper *stepper);

/* The Jacobian at the start of the last step, row by row, if rodas5p evaluated it; else NULL. */
const double *stepper_jacobian(const struct stepper *stepper);

const struct stepper_counts *stepper_get_counts(const struct stepper *stepper);

/* Copy the data that the next step depends on to `view`, for another integrator, and copy them back; the next
 * step starts from there, and until then dense output is unavailable. False if the next step depends on more
 * data: a fixed or bounded step size, a stability limit, a multistep method. */
bool stepper_lend(const struct stepper *stepper, struct stepper_state_view *view);
void stepper_settle(struct stepper *stepper, const struct stepper_state_view *view);

/* The error control, for error_norm_set_floor. */
gsl_odeiv2_control *stepper_control(struct stepper *stepper);

#endif
