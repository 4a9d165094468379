/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Mixed complementarity problems of unilateral constraints, Coulomb friction and bounded multipliers.
 *
 * With w = A x + b, A = J M^-1 J^T symmetric and positive semi-definite, each row i has limits of its multiplier x_i
 *
 *     low + low_share x_k <= x_i <= high + high_share x_k,     k = `of`, or no other row (-1)
 *
 * and w_i >= 0 at the lower limit, w_i <= 0 at the upper one, w_i = 0 between. So
 *
 *     half-line (contact, rope, stop)      0, infinity
 *     interval (bearing, bounded drive)    low, high
 *     Coulomb friction, mu N_k             0, 0 with shares -mu, mu
 *     equality (joint)                     -infinity, infinity
 *     fixed (kinetic friction, side s)     0, 0 with both shares s mu: w_i is then of any sign, and the problem unsymmetric
 *
 * Row k has no shares of its own, and low >= 0; or it is an equality whose multiplier, the normal force of a guide, may have
 * either sign: `load` selects the number in place of x_k in the limits of others.
 *
 * Limits fall by the part `loss` where w_i is not zero: static above kinetic friction. The rows that slip are found with the
 * limits as they are, then get their loss, and the others are decided again.
 *
 * Modes that the caller supplies are tried first (pivoting_modes.c). Else Lemke's path leads from all forces at their
 * limits to a basis (lcp.h; Cottle, Pang and Stone, The Linear Complementarity Problem, section 4.4), whose modes are solved
 * in the same way. So forces are a function of A, b, limits and modes, never of other forces: they do not depend on history.
 *
 * Where A leaves forces indeterminate they are the admissible ones with the least sum of A_ii x_i^2, which is independent of
 * units. Rows that do not touch are solved independently, each block in an order by its contents: the order in which rows
 * are supplied does not change a bit of the result (unless rows cannot be distinguished by their contents at all).
 *
 * Without shares and losses the accelerations w are unique. With friction there may be several solutions, or none. A block of
 * at most pivoting_few rows is enumerated where `examine` demands it, and one of at most pivoting_most_modes combinations of
 * modes where Lemke's path ends in a ray: that proves `several` and `none`. Of larger blocks a ray proves nothing. By its law a
 * row with a loss may also slip where it can stick; a solution that slips where another one sticks, in addition to all rows
 * that stick in it, does not count.
 */
#ifndef FBD_NUMERIC_PIVOTING_H
#define FBD_NUMERIC_PIVOTING_H

#include <stdbool.h>
#include <stddef.h>

enum { pivoting_few = 8, pivoting_most_modes = 70000 }; /* of eight contacts with friction */

enum pivoting_mode { at_low = -1, between = 0, at_high = 1 };

enum pivoting_load { load_is_force, load_of_both_sides, load_of_one_side }; /* x_k, |x_k|, max(0, x_k) */

struct pivoting_row {
    double b; /* w without forces */
    double low, high;
    int of;
    double low_share, high_share;
    double loss; /* 0 to 1 */
    int slips;   /* enum pivoting_mode: held at this limit, less its loss, with w of any sign; 0: it is not */
    enum pivoting_load load; /* of an equality */
    int mode;                /* enum pivoting_mode: where to start; then: sign of -w, `between` where w = 0 */
    double x, w;             /* found; w = 0 exactly where it is round-off */
};

struct pivoting_problem {
    size_t count;
    struct pivoting_row *rows;
    const double *A; /* count x count, row by row */
    bool basic;      /* the forces of a basis, as many as can be at their limits, in place of the least */
    bool coarse;     /* rows that are independent by less than `dependent_row` depend on others */
    bool examine;    /* enumerate all solutions of blocks of at most pivoting_few rows */
    double size;     /* a size of w / sqrt(A_ii) relative to which w may be round-off, beside that of b */
};

/* In the order of their weight: of several blocks the last one counts. */
enum pivoting {
    pivoting_solved,     /* and no other accelerations are possible */
    pivoting_unexamined, /* solved; whether other accelerations are possible was not examined */
    pivoting_several,    /* solved, and there are others, by enumeration */
    pivoting_ray,        /* Lemke's path ended without a solution */
    pivoting_none,       /* there is no solution, by enumeration */
    pivoting_no_memory
};

/* Set mode, x and w of all rows; undefined for blocks without a solution. */
enum pivoting pivoting_solve(struct pivoting_problem *problem);

#endif
