/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Unilateral constraints and friction, decided together for all that touch each other.
 *
 * Two kinds, with f the force along the direction of the constraint and c the acceleration (of impacts: the
 * speed after) along it:
 *
 *     one-sided   f >= 0, c >= 0, f c = 0: a surface (N, gap), a rope (tension, slack), a stop
 *     friction    |f| <= mu_s P, and f = -mu_k P sign(c) when c is not 0; where it slips already, in its
 *                 direction, f = -mu_k P slip. P is the normal force: of a one-sided constraint, a guide,
 *                 or 1 for a bearing, whose coefficients are the limits themselves.
 *
 * A guide is a normal force N of a joint that cannot open: P = |N| when it has two sides, max(0, N) when it
 * has one (N < 0 then means that the joint loses its surface, which the caller reports).
 *
 * All other forces respond linearly, c = c_0 + A f and N = N_0 + B f, with A = J M^-1 J^T (Delassus' matrix,
 * the other constraints included) and c_0, N_0 the values without unilateral constraints. So constraints are
 * rows of numeric/pivoting.h, and a guide is an equality with the force N,
 *
 *     alpha (N - N_0 - B f) = 0,    c = c_0 + alpha B^T N_0 + (A + alpha B^T B) f - alpha B^T N
 *
 * which is symmetric for any alpha > 0; alpha is the largest A_ii of the friction on it. With mu_k < mu_s the
 * slipping set is found with mu_s, then gets mu_k, and the others are decided again.
 */
#ifndef FBD_HOLDS_HOLDS_H
#define FBD_HOLDS_HOLDS_H

#include <stdbool.h>
#include <stddef.h>

enum hold_kind { hold_one_sided, hold_friction };
enum hold_press { press_constant, press_hold, press_guide };

/* The values of enum slip: friction sticks (0) or slips; a one-sided constraint is closed (0) or open (1). */
enum hold_mode { hold_slips_back = -1, hold_keeps = 0, hold_gives = 1 };

struct hold {
    enum hold_kind kind;
    double free;           /* c_0 */
    double mu_s, mu_k;     /* friction; of a bearing its limits */
    enum hold_press press; /* friction: the kind of its normal force, */
    int presses;           /* and its index among holds or guides */
    double preload;        /* a normal force that adds to that of the other one */
    int slip;              /* friction: direction of present slip, 0 at rest */
    /* found: */
    int mode; /* enum hold_mode */
    double force, c;
};

struct hold_guide {
    double free; /* N_0 */
    bool two_sided;
    double N; /* found */
};

struct hold_problem {
    size_t count, guide_count;
    struct hold *holds;
    struct hold_guide *guides;
    double *A; /* count x count, row by row */
    double *B; /* guide_count x count */
    bool
        basic; /* of forces that are indeterminate, decide those of a basis, as many as can be at their limits */
    bool
        coarse; /* resolve no more than the equations of motion, whose rows are shifted (constraint_solve.c) */
    double size; /* an acceleration (weighted, see holds_weight) relative to which others are round-off */
};

/* 1 / sqrt(A_ii), which makes accelerations of distances and of angles comparable. */
double holds_weight(const struct hold_problem *problem, size_t i);

enum holds_found {
    holds_decided,
    holds_several, /* decided, but other accelerations are solutions, too */
    holds_none,    /* there is no solution */
    holds_lost,    /* none was found, with too many modes to enumerate */
    holds_no_memory
};

/* Is the surface of the friction open? */
bool holds_is_on_open(const struct hold_problem *problem, const struct hold *hold);

/* Is its acceleration at most `share` of the largest one? */
bool holds_is_still(const struct hold_problem *problem, size_t i, double share);

/* Allocate the problem, all zero; false when memory is out. */
bool holds_new(struct hold_problem *problem, size_t count, size_t guide_count);
void holds_free(struct hold_problem *problem);

/* Decide all of them, with the least admissible forces where these are indeterminate, unless `basic`. */
enum holds_found holds_decide(struct hold_problem *problem);

#endif
