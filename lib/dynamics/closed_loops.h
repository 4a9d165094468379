/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rates of trees of pivots and slides whose loops are closed by pins, in independent coordinates.
 *
 * With d independent coordinates u the others follow from the pins, g(q) = 0. They are found pin by pin: each pin
 * has two dependent coordinates of its own beside coordinates that are known, so that the Jacobian matrix of all
 * pins in the dependent ones is block triangular with 2 x 2 blocks. One substitution through the blocks, x such
 * that J x = r with x given in u, serves for
 *
 *     positions        Newton's method, r = -g and 0 in u
 *     the null space   r = 0 and a unit vector in u: the columns of N, J N = 0
 *     velocities       r = 0 and the rates of u
 *     accelerations    r = -J' v and 0 in u: the particular part a_p
 *
 * and q'' = a_p + N s with N^T M N s = N^T (Q - M a_p) (Lagrange's equations on the null space: Bayo and Ledesma,
 * Nonlinear Dynamics 9, 1996, 113). N^T M N and the right-hand side are sums over the links of their
 * accelerations along N, and neither a mass matrix nor multipliers are formed.
 *
 * All coordinates are integrated, but rates depend on the independent ones only: the dependent numbers of a stage
 * are the start of Newton's method, and choose the branch. So the errors of a stage across the pins do not act
 * back on the motion.
 *
 * With s the determinant of a pin as a share of the largest possible one, rounding e causes an error e / s of
 * the dependent coordinates, e / s^2 of their rates, and e / s^3 of their accelerations: near a singular position,
 * as all bars of a window come into one line, this is the shape of the exact motion of a mechanism that does not
 * quite fit, and no smaller step avoids it. So a correction is made only where it exceeds its own rounding: gaps
 * and rates of the pins that are rounding stay, and right-hand sides of a_p that are explained by such gaps and
 * rates, e / s^2, are zero. Then a row of parallelograms passes its singular positions exactly.
 *
 * The choice of dependent coordinates is changed where it is ill-conditioned, by steps alone: evaluations
 * between them, for events and output, hold it, so that the motion does not depend on it. Where every choice is, or where
 * Newton's method would have to move farther than a fraction of s, and so perhaps to another branch, these
 * rates are refused: constraint_solve.c serves there.
 */
#ifndef FBD_DYNAMICS_CLOSED_LOOPS_H
#define FBD_DYNAMICS_CLOSED_LOOPS_H

#include "dynamics/tree.h"

enum { most_independent = 4 };

/* A joint that moves one end of a pin. */
struct loop_arm {
    int link, end;
    struct vec slope; /* d(p_A - p_B) / dq */
};

struct loop_pin {
    const struct coupling *coupling;
    struct loop_arm *arms; /* the first two are those of its dependent coordinates */
    int count;
    struct vec r[2];    /* its points, from the O of their links */
    struct vec gap;     /* p_A - p_B */
    struct vec rest;    /* a right-hand side, */
    double level;       /* and its rounding: it is zero up to that */
    double determinant; /* of the first two slopes */
};

struct closed_loops {
    const struct tree *tree;
    struct loop_pin *pins; /* in the order of substitution */
    int pin_count, independent_count;
    int independent[most_independent];            /* their links */
    double *unit;                                 /* of a joint: 1 / sqrt(its inertia) */
    double *q, *v, *a, *basis[most_independent];  /* of the joints, by link */
    struct acceleration *A, *B[most_independent]; /* of the links, for a and each basis */
    bool *known;
    double reach;   /* the largest distance of a pin from the origin of the world */
    double share;   /* smallest determinant of a pin, as a share of the largest possible one */
    double chosen;  /* that at the last choice of dependent coordinates; negative before the first */
    bool even;      /* the last well-conditioned a_p was zero */
    bool unfit;     /* no choice exists, or a singular position has been met: refused for good */
    bool suspended; /* refused for a step */
    bool held;      /* the choice, `even` and `unfit` are not changed */
};

/* Has the scene such loops? Their memory in bytes (a multiple of the size of a double), 0 if not. */
size_t closed_loops_size(const struct fbd_model *model);
void closed_loops_init(struct closed_loops *loops, const struct fbd_model *model, void *memory);

/* Rates dydt of the jointed links at an instant under the forces in their joints. False where they are refused:
 * dydt is not written. */
bool closed_loops_rates(struct closed_loops *loops, const struct instant *at, int n, const double *slots,
                        double *dydt);

/* Close the loops at y[2n]: dependent coordinates and rates follow from the independent ones. False where that
 * is refused: y is not written. */
bool closed_loops_close(struct closed_loops *loops, struct tree_work *work, int n, double *y);

/* For a step with a Jacobian of state_jacobian, which is that of all coordinates: refuse rates that depend on the
 * independent ones only. `loops` may be NULL. */
static inline void closed_loops_suspend(struct closed_loops *loops, bool suspended)
{
    if (loops) loops->suspended = suspended;
}

/* From the end of a step to the begin of the next: hold the choice of dependent coordinates, and `even` and `unfit`.
 * `loops` may be NULL. */
static inline void closed_loops_hold(struct closed_loops *loops, bool held)
{
    if (loops) loops->held = held;
}

/* Close the loops of another state of the scene as the rates `loops` of the last step have done; or NULL. */
static inline void closed_loops_agree(struct closed_loops *other, const struct closed_loops *loops)
{
    if (!loops) return;
    other->even = loops->even;
    other->suspended = loops->suspended || loops->unfit;
}

/* ---- parts */

/* Choose the dependent coordinates at the present slopes, and set `share` (closed_loops_choice.c). */
void closed_loops_choose(struct closed_loops *loops);

#endif
