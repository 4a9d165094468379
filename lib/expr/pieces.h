/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pieces: stretches of one variable on which formulas keep their branches, found with proof by enclosures of their
 * margins (expr.h): a stretch that is not proved to be one is halved.
 *
 * Within a piece the formulas are smooth, and levels of what wakes up in a small range (build_levels) are ends of pieces:
 * a rule of quadrature on each piece does not miss a bell.
 */
#ifndef FBD_EXPR_PIECES_H
#define FBD_EXPR_PIECES_H

#include "expr/expr.h"

enum { pieces_no_memory = 0, pieces_too_many = -1 };

/* Cut [from, to], from < to, where `count` formulas that depend on slot `slot` alone switch; those that depend on more are
 * not cut. What is narrower than some roundings is no piece; what is longer than numbers go has too many. `ends` has room
 * for most + 1 numbers and gets one more than there are pieces. Returns their number, or one of the two above; ends[most]
 * is then where the search stopped. */
int pieces_cut(const struct expr *const *formulas, size_t count, int slot, double from, double to, int most,
               double *ends);

/* The branches of one formula within a piece. False when memory is out. */
bool pieces_branches(const struct expr *formula, int slot, double from, double to, int *branch);

#endif
