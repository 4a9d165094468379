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
 * the other constraints included) and c_0, N_0 the values without unilateral constraints. The result is a
 * linear complementarity problem (Glocker, Set-Valued Force Laws, 2001, chapter 8): with f = r - mu P and c =
 * c' - c''
 *
 *     one-sided         z = f     w = c
 *     guide             z = N'    w = N''      N = N' - N''
 *     friction at rest  z = r     w = c'       r = mu P + f
 *                       z = c''   w = l        l = mu P - f = 2 mu P - r
 *
 * Slipping friction is no unknown: its force is mu_k P. With mu_k < mu_s the slipping set is found with mu_s,
 * then gets mu_k, and the others are decided again.
 *
 * Where Lemke's method ends without a solution all modes are enumerated, if they are not too many: this
 * proves that there is no solution, as in Painleve's paradox, or that there are several.
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
    /* Of a part: the largest acceleration (weighted, see holds.c) and force of the whole without constraints. */
    double beside_c, beside_force;
};

/* The weight that makes accelerations of distances and of angles comparable: that of the constraint's
 * mobility. */
double holds_weight(const struct hold_problem *problem, size_t i);

enum holds_found {
    holds_decided,
    holds_several, /* decided, but other accelerations are solutions, too */
    holds_none,    /* there is no solution */
    holds_lost,    /* none was found, with too many modes to enumerate */
    holds_no_memory
};

/* Is the surface of the friction open? holds_set_open sets its mode there from its direction of motion. */
bool holds_is_on_open(const struct hold_problem *problem, const struct hold *hold);
void holds_set_open(struct hold_problem *problem);

/* Is its acceleration at most `share` of the largest one? */
bool holds_is_still(const struct hold_problem *problem, size_t i, double share);

/* Allocate the problem, all zero; false when memory is out. */
bool holds_new(struct hold_problem *problem, size_t count, size_t guide_count);
void holds_free(struct hold_problem *problem);

enum holds_found holds_decide(struct hold_problem *problem);

/* Are the present forces and accelerations consistent with the modes and limits? O(count). */
bool holds_agree(const struct hold_problem *problem);

/* How force and acceleration of constraint i violate its mode. */
enum hold_breach {
    hold_breaks_nothing,
    hold_overloaded, /* closed or sticking: the force exceeds its limits */
    hold_moves_back, /* open or slipping: it moves in the opposite direction */
};

enum hold_breach holds_breach(const struct hold_problem *problem, size_t i);

/* Minimum-norm forces where they are indeterminate and these are within their limits; modes are unchanged,
 * except that constraints slipping by rounding stick. holds_lost where no forces satisfy the modes. */
enum holds_found holds_share(struct hold_problem *problem);

/* If consistent forces (holds_agree) are very large, check that they satisfy the modes, by holds_share;
 * holds_lost if they do not. */
enum holds_found holds_meet(struct hold_problem *problem);

/* The number of solutions with different accelerations, by enumeration of all modes; the problem holds the
 * first. -1 when there are too many modes (over `most`), -2 when memory is out. */
int holds_try_all(struct hold_problem *problem, size_t most);

/* Is the motion of the present solution unique, by enumeration of all modes? Friction sticks where it can: a
 * solution that slips where another one sticks, in addition to all that it sticks at itself, does not count.
 * The modes of the problem are undefined afterwards. 1 or 0; -1 and -2 as above. */
int holds_is_unique(struct hold_problem *problem, size_t most);

#endif
