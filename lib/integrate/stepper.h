/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One accepted step at a time, with any method of method.h: the body of an integration loop.
 *
 * It does what gsl_odeiv2_evolve_apply does and what that leaves undone: the error is measured without
 * units (error_norm.h); a step that is rejected, for whatever reason, leaves nothing behind; NaN is never
 * accepted; the reason of each rejection is counted; the step can be looked into (dense.h) and redone in
 * part; multistep methods get the driver they ask for.
 *
 * Use: stepper_reset at the start and after every discontinuity of state or right-hand side, then
 * stepper_step until t == t_limit. Time runs forward. Only stepper_alloc takes memory.
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
    stepper_underflow,    /* rejected until t + h == t; stepper_counts.last tells why */
    stepper_bad_function, /* the right-hand side returned GSL_EBADFUNC: stop */
    stepper_fixed_failed, /* a step of fixed size could not be made; stepper_counts.last tells why */
    stepper_misuse        /* t_limit <= t, *h <= 0, another dimension, no Jacobian for an implicit method */
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
    enum rejection last; /* in the latest step with any; rhs or not finite if that was among its reasons */
    double
        growth; /* by how much longer than the last step the next may be, for all that errors and stability say */
};

/* NULL when memory is out or an option is unusable. */
struct stepper *stepper_alloc(const struct stepper_options *options);
void stepper_free(struct stepper *stepper);

/* Forget all steps, evaluate f = f(t, y) and choose the size *h of the first step towards t_limit (one more
 * evaluation). The scales of the error measure are kept and take in y. GSL_SUCCESS, GSL_EINVAL for t_limit
 * <= t, or the code of the right-hand side; then *h is not set. */
int stepper_reset(struct stepper *stepper, struct counted_system *system, struct time_dd t, const double *y,
                  double *f, struct time_dd t_limit, double *h);

/* Make one accepted step from (*t, y) with slopes f = f(*t, y), not beyond t_limit. On stepper_ok *t, y and
 * f are those of its end, and *h is the size proposed for the next one. On any other status *t, y and f are
 * as they were; reset before going on.
 *
 * *h is the size to try first. A step that would end within 1 % of t_limit ends there, *t == t_limit
 * exactly; one that would leave less than its own length is made half the way. Such a cut does not shrink
 * the proposal. Other steps end at doubles, unless they are as short as those are apart. */
enum stepper_status stepper_step(struct stepper *stepper, struct counted_system *system, struct time_dd *t,
                                 double *y, double *f, double *h, struct time_dd t_limit);

/* State at time t within the last accepted step, t0 <= t <= t1, bit for bit that of the step at its ends.
 * Explicit methods and msadams have the interpolants of dense.h, msbdf the polynomial of its last points
 * (history.h), rodas5p its own. Other implicit one-step methods redo the step, up to Chebyshev points or,
 * where no polynomial follows it, up to t (dense_by_resteps.h): slopes are of no use over a stiff step, and bsimp makes
 * steps longer than an interpolant follows. Where that fails, the ends have to do (dense_eval_plain). The
 * system of that step is used and has to be there still. GSL_SUCCESS, or GSL_EINVAL without a last step or
 * for t outside of it, where a double next to an end counts as that. */
int stepper_dense(struct stepper *stepper, struct time_dd t, double *y);

/* The degree of the polynomials that stepper_dense gives; where they are none (*negligible above
 * 0), one that follows the state to that share of its size over most steps. */
int stepper_degree(const struct stepper *stepper, double *negligible);

/* Component i from `from` to `to` within the last step as dense_powers has it; -1 also for methods whose inside is no
 * polynomial. */
int stepper_powers(struct stepper *stepper, struct time_dd from, struct time_dd to, size_t i, double *c);

/* The same as dense_powers_of_ends has it. */
int stepper_powers_of_ends(struct stepper *stepper, struct time_dd from, struct time_dd to, size_t i,
                           double *c);

/* State y and slopes f at time t within the last accepted step with the full accuracy of the method:
 * one-step methods make a step from its start to t, multistep methods, and others where that fails, use
 * stepper_dense. Codes as there, or that of a right-hand side that fails at t. */
int stepper_partial(struct stepper *stepper, struct time_dd t, double *y, double *f);

/* The last step ends at t from here on, by a step of its own, where its inside is far from what such a step has there: what it
 * has passed behind t, as a narrow peak, may have met the stages that are for the inside alone. 1: it does, with y and f
 * at t; 0: it stays what it was; or a code as there. */
int stepper_shorten(struct stepper *stepper, struct time_dd t, double *y, double *f);

/* State and slopes by as many steps as the tolerance asks for (substeps.h). GSL_EFAILED when that does not come to t,
 * GSL_ENOMEM, GSL_EINVAL for a multistep method. The last step stays what it was. */
int stepper_walk(struct stepper *stepper, struct time_dd t, double *y, double *f);

/* Try a step of size h from where the last step of another stepper began and throw it away: its largest error in
 * units of what is allowed (at most 1 would be accepted), infinite where it cannot be made, or by a multistep method.
 * The last steps of both stay what they were. */
double stepper_attempt(struct stepper *stepper, struct counted_system *system, const struct stepper *other,
                       double h);

/* linear_set_matrix for a stepper of that method; nothing for others. */
void stepper_set_linear(struct stepper *stepper, const double *A, double rho);

/* The size of the last step times the fastest rate of the system that the method has seen lately (error_norm_rate);
 * INFINITY where it sees none. */
double stepper_h_rate(const struct stepper *stepper);

/* The Jacobian at the start of the last step, row by row, where rodas5p made it; else NULL. */
const double *stepper_jacobian(const struct stepper *stepper);

/* Take a state that another stepper has reached into the scales of the error measure. */
void stepper_note(struct stepper *stepper, const double *y, const double *f);

const struct stepper_counts *stepper_get_counts(const struct stepper *stepper);

/* Lend what steps go by to somebody who makes them, and take back what has become of it; the next step starts from there,
 * and until then none can be looked into. False where more than `lent` has is gone by: a step of fixed or bounded size, a
 * limit of stability, a method that remembers steps. */
bool stepper_lend(const struct stepper *stepper, struct stepper_state_view *view);
void stepper_settle(struct stepper *stepper, const struct stepper_state_view *view);

/* The error control, for error_norm_set_floor. */
gsl_odeiv2_control *stepper_control(struct stepper *stepper);

#endif
