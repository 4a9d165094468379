/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pieces: intervals of one variable on which formulas keep their branches, proved by enclosures of their
 * margins (expr.h): an interval without a proof is halved.
 *
 * Within a piece the formulas are smooth, and the levels of functions that vary in a small range
 * (build_levels) are ends of pieces: a quadrature rule on each piece does not miss a peak.
 */
#ifndef FBD_EXPR_PIECES_H
#define FBD_EXPR_PIECES_H

#include "expr/expr.h"

enum { pieces_no_memory = 0, pieces_too_many = -1 };

/* Cut [from, to], from < to, at the switches of `count` formulas that depend on slot `slot` alone; if one
 * depends on more, nothing is cut. Intervals of a few roundings are no pieces; a range of infinite length has
 * too many. `ends` has room for most + 1 numbers and receives one more than there are pieces. Returns their
 * number, or one of the two codes above; ends[most] is then where the search stopped. */
int pieces_cut(const struct expr *const *formulas, size_t count, int slot, double from, double to, int most,
               double *ends);

/* The branches of one formula within a piece. False when memory is out. */
bool pieces_branches(const struct expr *formula, int slot, double from, double to, int *branch);

#endif
