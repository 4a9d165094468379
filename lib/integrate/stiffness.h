/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The choice between an explicit and an implicit method while a run goes on, both ways.
 *
 * Now and then the other method attempts the step that has just been accepted, from the same state and of the
 * same size. The ratio r of its error to the level (error_norm_ratio) tells by how much longer its step could
 * be: gain = r^(-1/k) for an estimate that is O(h^k). Two answers in a row, the second a few steps after the
 * first, make the switch. The attempt is thrown away, so the accepted steps stay what they were.
 *
 * Hairer's test (HNW II, IV.2) looks at h rho with the spectral radius rho as two stages of the explicit
 * method show it: stiff where this stays at the limit of stability. It is free, but blind where the explicit
 * method is slowed down otherwise: a stiff oscillator that follows a forcing keeps dop853 at h rho = 1.7 for
 * a tolerance of 1e-10, 10 times shorter than rodas5p, while motions that dop853 is best for have h rho up
 * to 1.4. The gain tells them apart. Measured with dop853, gain of rodas5p for tolerances
 * of 1e-4 ... 1e-13: 2.3 ... 14 in stiff motion, 0.15 ... 0.8 in oscillations that have to be followed. The
 * other way round, gain of dop853: 0.05 ... 0.4 in stiff forced motion, 1.7 ... 11 in oscillations.
 *
 * The way back to the explicit method asks for more: h times the fastest rate of the system has to be well
 * within the limit of stability: 5.2 for rk8pd where something dies out, 3.7 where it oscillates; about 6 for
 * dop853 in all directions. One attempt does not show it, as the implicit method may have damped the fast components to 1e-100, and it takes steps until their growth is
 * seen. Van der Pol's oscillator (mu = 1000) and a spring of 1e8 N/m with a strong damper were sent to dop853
 * that way, and blew up.
 *
 * In stiff motion the error of the implicit method does not go with h^k, but as slowly as h^2: of a pendulum on a
 * stiff, damped spring its step is 85 times as long in the end, where the gain says 7. So one that seems not to
 * gain enough is tried again with a step of stiffness_reach times the size, and is believed what that shows.
 *
 * Longer steps are worth what they save. A step of rodas5p takes 8 evaluations, a Jacobian and a decomposition,
 * one of rk8pd takes 13 evaluations. Measured for a chain of n rods, the former takes 8 + 4 n evaluations' time
 * (n from 1 to 64), for a row of four-bars two thirds of that: from n = 4 on it is dearer by (n + 2)/6 than what
 * the thresholds allow for. The other method attempts a step longer by that much (on the way back: shorter), as
 * the error of a short step may be rounding alone and then tells nothing of a longer one; and the waits between
 * attempts grow alike.
 *
 * The functions are pure bookkeeping; making the attempt is up to the caller. Its cost is that of one in 64
 * steps where nothing changes, and of one in 256 where nothing looks stiff.
 */
#ifndef FBD_INTEGRATE_STIFFNESS_H
#define FBD_INTEGRATE_STIFFNESS_H

#include <stdbool.h>
#include <stddef.h>

struct stiffness {
    bool implicit; /* the method that is to be used now */
    int interval;  /* accepted steps from the last attempt to the next one */
    int wait;      /* ... and what is left of them */
    int votes;     /* answers in a row for the other method */
    int calm;      /* how often in a row an attempt was due and nothing looked stiff */
    double dear;   /* how much dearer a step of the implicit method is than in a small system, >= 1 */
};

/* Start with the explicit method, for a system of so many coordinates. */
void stiffness_start(struct stiffness *stiffness, size_t coordinates);

/* After a discontinuity of state or right-hand side: what was found before it does not count. The method
 * stays, and so does the time of the next attempt, lest frequent events put it off for ever. */
void stiffness_forget(struct stiffness *stiffness);

/* Count an accepted step; true when the other method is to attempt it now. `h_rate` is the size of the step times the
 * fastest rate that the explicit method has seen in it: while that is far from stiff an attempt is put off. In a small
 * system, for three more waits. In a large one, where it costs as much as many steps, for more steps, each of which asks again. */
bool stiffness_due(struct stiffness *stiffness, double h_rate);

/* The size of the step that the other method attempts, for one of the step that has been made. */
double stiffness_stride(const struct stiffness *stiffness);

/* How much longer a step the implicit method attempts where the first one leaves doubt. */
enum { stiffness_reach = 4 };

/* Does the error ratio of the implicit method's attempt leave doubt: not enough gain, though nearly? */
bool stiffness_doubts(const struct stiffness *stiffness, double ratio, int estimate_order);

/* Take in the error ratio of that attempt (infinite or NaN when it failed) and the k of the method that made
 * it; true when `implicit` has changed, so that the integration goes on with the other method. `h_rate` is
 * the size of the attempt times stiffness_rate; it is looked at on the way back only. */
bool stiffness_decide(struct stiffness *stiffness, double ratio, int estimate_order, double h_rate);

/* A bound [1/s] for the rates |lambda| of an n by n Jacobian, row by row, which does not depend on the units
 * of the components. For oscillators it is the circular frequency, with a damper at most twice the largest
 * rate. `work` takes 2 n numbers. NaN or infinite if the Jacobian is. */
double stiffness_rate(size_t n, const double *jacobian, double *work);

#endif
