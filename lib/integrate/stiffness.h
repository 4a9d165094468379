/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The choice between an explicit and an implicit method during a run, in both directions.
 *
 * At intervals the other method attempts the step that has just been accepted, from the same state and of the
 * same size. The ratio r of its error to the level (error_norm_ratio) gives the factor by which its step
 * could be longer: gain = r^(-1/k) for an estimate that is O(h^k). Two votes in a row, the second a few steps
 * after the first, make the switch. The attempt is discarded, so the accepted steps do not change.
 *
 * Hairer's test (HNW II, IV.2) uses h rho with the spectral radius rho estimated from two stages of the
 * explicit method: stiff where this stays at the limit of stability. It is free, but fails where the explicit
 * method is slowed down otherwise: a stiff oscillator that follows a forcing keeps dop853 at h rho = 1.7 for
 * a tolerance of 1e-10, 10 times shorter than rodas5p, while motions for which dop853 is best have h rho up
 * to 1.4. The gain separates them. Measured with dop853, gain of rodas5p for tolerances of 1e-4 ... 1e-13:
 * 2.3 ... 14 in stiff motion, 0.15 ... 0.8 in oscillations that have to be followed. In the other direction,
 * gain of dop853: 0.05 ... 0.4 in stiff forced motion, 1.7 ... 11 in oscillations.
 *
 * The switch back to the explicit method has a further condition: h times the fastest rate of the system has
 * to be well within the limit of stability: 5.2 for rk8pd with decay, 3.7 with oscillation; about 6 for
 * dop853 in all directions. One attempt does not show it, as the implicit method may have damped the fast
 * components to 1e-100, and their growth appears only after many steps: without the condition van der Pol's
 * oscillator (mu = 1000) and a spring of 1e8 N/m with a strong damper became unstable with dop853.
 *
 * In stiff motion the error of the implicit method falls not as h^k, but as slowly as h^2: for a pendulum on
 * a stiff, damped spring its step finally is 85 times as long, where the gain is 7. So an attempt with
 * slightly too little gain is repeated with a step of stiffness_reach times the size, which decides.
 *
 * The gain must exceed the cost. A step of rodas5p takes 8 evaluations, a Jacobian and a decomposition, one
 * of rk8pd takes 13 evaluations. Measured for a chain of n rods, the former takes the time of 8 + 4 n
 * evaluations (n from 1 to 64), for a row of four-bars two thirds of that: from n = 4 on it costs (n + 2)/6
 * times as much as the thresholds assume. The other method attempts a step longer by that factor (when
 * switching back: shorter), as the error of a short step may be rounding alone and then does not predict that
 * of a longer one; and the waits between attempts grow by the same factor.
 *
 * The functions only keep the account; the caller makes the attempts. They cost one in 64 steps where nothing
 * changes, and one in 256 where the motion is far from stiff.
 */
#ifndef FBD_INTEGRATE_STIFFNESS_H
#define FBD_INTEGRATE_STIFFNESS_H

#include <stdbool.h>
#include <stddef.h>

struct stiffness {
    bool implicit; /* the method that is to be used now */
    int interval;  /* accepted steps from the last attempt to the next one */
    int wait;      /* ... and those that remain */
    int votes;     /* votes in a row for the other method */
    int calm;      /* attempts in a row that were put off because the motion was not stiff */
    double dear;   /* cost of a step of the implicit method relative to that in a small system, >= 1 */
};

/* Start with the explicit method, for a system of so many coordinates. */
void stiffness_start(struct stiffness *stiffness, size_t coordinates);

/* After a discontinuity of state or right-hand side: discard earlier votes. The method stays, and so does the
 * time of the next attempt; otherwise frequent events could postpone it forever. */
void stiffness_forget(struct stiffness *stiffness);

/* Count an accepted step; true when the other method is to attempt it now. `h_rate` is the size of the step
 * times the fastest rate that the explicit method has detected in it: while that is far from stiff, the
 * attempt is put off. In a small system that is for three more waits, in a large one, where an attempt costs
 * as much as many steps, for more steps, each of which is checked. */
bool stiffness_due(struct stiffness *stiffness, double h_rate);

/* The size of the step that the other method attempts, relative to that of the accepted step. */
double stiffness_stride(const struct stiffness *stiffness);

/* Size ratio of the second attempt of the implicit method, if the first is inconclusive. */
enum { stiffness_reach = 4 };

/* Is the error ratio of the implicit method's attempt inconclusive: not enough gain, but nearly? */
bool stiffness_doubts(const struct stiffness *stiffness, double ratio, int estimate_order);

/* Enter the error ratio of that attempt (infinite or NaN when it failed) and the k of the method that made
 * it; true when `implicit` has changed, so that the integration continues with the other method. `h_rate` is
 * the size of the attempt times stiffness_rate; it is used for the switch back only. */
bool stiffness_decide(struct stiffness *stiffness, double ratio, int estimate_order, double h_rate);

/* A bound [1/s] for the rates |lambda| of an n by n Jacobian, row by row, which does not depend on the units
 * of the components. For oscillators it is the circular frequency, with a damper at most twice the largest
 * rate. `work` takes 2 n numbers. NaN or infinite if the Jacobian is. */
double stiffness_rate(size_t n, const double *jacobian, double *work);

#endif
