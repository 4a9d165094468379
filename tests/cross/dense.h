/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dense linear systems A x = b by Householder reflections with exchange of columns, which shows the rank.
 */
#ifndef CROSS_DENSE_H
#define CROSS_DENSE_H

enum { dense_room = 128 };

struct dense {
    int n, rank;
    double a[dense_room][dense_room]; /* columns: a[j] is column j of A, later of R and the reflections */
    double b[dense_room];
    int order[dense_room]; /* column j of R was column order[j] of A */
    double condition;      /* largest over smallest diagonal entry of R up to the rank */
    double gap;      /* first diagonal entry behind the rank over the largest: rounding, or no clear rank */
    double leftover; /* what of b no x can give, over b */
};

/* Factor, and solve with zeros for what is free. `x` may be b. */
void dense_solve(struct dense *dense, double *x);

/* Vector k of the null space (k from 0 to n - rank - 1). */
void dense_null(const struct dense *dense, int k, double *x);

/* By elimination with exchange of rows, where the rank is known to be full: a third of the work. */
void dense_solve_regular(struct dense *dense, double *x);

#endif
