/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Holds: what keeps something from moving within a limit. All that touch each other are decided together.
 *
 * Two kinds of hold, with f the force along its own direction and c the acceleration (of impacts: the speed
 * after) along it:
 *
 *   one-sided   f >= 0, c >= 0, f c = 0: a surface (N, gap), a rope (tension, slack), a stop
 *   friction    |f| <= mu_s P, and f = -mu_k P sign(c) when c is not 0; where it slips already, on its side,
 *               f = -mu_k P slip. P is what presses: a one-sided hold, a guide, or 1 for a bearing, whose
 *               coefficients are the limits themselves.
 *
 * A guide is a normal force N of a joint that cannot open: P = |N| when it has two sides, max(0, N) when it
 * has one (N < 0 then means that the joint's surface is lost, which is for the caller to say).
 *
 * Everything else answers linearly, c = c_0 + A f and N = N_0 + B f, with A = J M^-1 J^T (Delassus' matrix,
 * the other constraints included) and c_0, N_0 what there is without holds. So it is a linear
 * complementarity problem (Glocker, Set-Valued Force Laws, 2001, chapter 8): with f = r - mu P and c = c' -
 * c''
 *
 *   one-sided         z = f     w = c
 *   guide             z = N'    w = N''      N = N' - N''
 *   friction at rest  z = r     w = c'       r = mu P + f
 *                     z = c''   w = l        l = mu P - f = 2 mu P - r
 *
 * and friction that slips is no unknown, its force is that share of its P. With mu_k < mu_s what has to slip
 * is found with mu_s, then slips with mu_k, and the others are decided again.
 *
 * Where Lemke's method ends without a solution all modes are tried, if they are not too many: then `none` is
 * proved, as in Painleve's paradox, and so is that there are several.
 */
#ifndef FBD_HOLDS_HOLDS_H
#define FBD_HOLDS_HOLDS_H

#include <stdbool.h>
#include <stddef.h>

enum hold_kind { hold_one_sided, hold_friction };
enum hold_press { press_constant, press_hold, press_guide };

/* The numbers of enum slip: friction sticks (0) or slips; what is one-sided is closed (0) or open (1). */
enum hold_mode { hold_slips_back = -1, hold_keeps = 0, hold_gives = 1 };

struct hold {
    enum hold_kind kind;
    double free;           /* c_0 */
    double mu_s, mu_k;     /* friction; of a bearing its limits */
    enum hold_press press; /* friction: what presses, */
    int presses;           /* and its number among holds or guides */
    int slip;              /* friction: the side on which it slips already, 0 at rest */
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
    /* Of a part: the largest acceleration (weighted, see holds.c) and force without holds in the whole. */
    double beside_c, beside_force;
};

/* The weight that makes accelerations of distances and of angles comparable: their own mobility. */
double holds_weight(const struct hold_problem *problem, size_t i);

enum holds_found {
    holds_decided,
    holds_several, /* decided, and there are other solutions with other accelerations */
    holds_none,    /* there is no solution */
    holds_lost,    /* none was found, and there were too many modes to try */
    holds_no_memory
};

/* Friction on a surface that is open? And its mode there: the way that it moves. */
bool holds_is_on_open(const struct hold_problem *problem, const struct hold *hold);
void holds_set_open(struct hold_problem *problem);

/* Is its acceleration no more than that share of the largest? */
bool holds_is_still(const struct hold_problem *problem, size_t i, double share);

/* Room for the problem, all zero; false when memory is out. */
bool holds_new(struct hold_problem *problem, size_t count, size_t guide_count);
void holds_free(struct hold_problem *problem);

enum holds_found holds_decide(struct hold_problem *problem);

/* Are the forces and accelerations that are there those of the modes, within limits? O(count). */
bool holds_agree(const struct hold_problem *problem);

/* What the mode of hold i has come to by its force and acceleration. */
enum hold_breach {
    hold_breaks_nothing,
    hold_overloaded, /* the force that keeps it is beyond its limits */
    hold_moves_back, /* what gives does so against its own way */
};

enum hold_breach holds_breach(const struct hold_problem *problem, size_t i);

/* Of forces that are not determined, those of the least size, where they are within their limits; modes are as they
 * were, but that what slips by rounding keeps still. holds_lost where no forces do what the modes say. */
enum holds_found holds_share(struct hold_problem *problem);

/* Do forces that agree (holds_agree) do what the modes say when they are large, too? Then they are shared; else
 * holds_lost. */
enum holds_found holds_meet(struct hold_problem *problem);

/* The number of solutions with different accelerations, by trying all modes; the first is left in the
 * problem. -1 when there are too many modes (over `most`), -2 when memory is out. */
int holds_try_all(struct hold_problem *problem, size_t most);

/* Is the motion of the solution that stands in the problem the only one that agrees, by trying all modes? Friction sticks
 * where it can: a solution that slips where another one sticks, beside all that it sticks at itself, does not count. The
 * problem is left in any modes. 1 or 0; -1 and -2 as above. */
int holds_is_unique(struct hold_problem *problem, size_t most);

#endif
