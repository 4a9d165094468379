/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Curves: x(p) and y(p) as expressions of one variable, by arc length.
 *
 * The range of p is cut where the formulas switch (pieces, on each of which they are smooth) and further into
 * panels, on which p(s) is a Chebyshev series accurate to rounding. So a point of the curve costs one sum and
 * the formulas themselves: position, direction and curvature are those of the expressions, by exact
 * derivatives, at that p. With r' = dr/dp:
 *
 *   ds/dp = |r'|,   e = r' / |r'|,   de/ds = kappa k x e,   kappa = (r' x r'') / |r'|^3
 *
 * The rate of the curvature is the derivative of its series on the panel. Beyond an end of a piece the curve
 * continues along its circle of curvature, for steps that look ahead.
 *
 * Lengths of panels are integrals of the series of |r'| (Clenshaw-Curtis); see L. N. Trefethen, Approximation
 * Theory and Approximation Practice, 2013, chapters 3 and 19.
 */
#ifndef FBD_EXPR_CURVE_H
#define FBD_EXPR_CURVE_H

#include "base/arena.h"
#include "base/vec.h"
#include "expr/expr.h"
#include "expr/table.h"

enum curve_fault {
    curve_made,
    curve_no_memory,
    curve_not_finite,   /* a position, direction or curvature is not finite */
    curve_stands_still, /* |r'| = 0: a cusp, or a stationary parameter */
    curve_corner,       /* its direction jumps */
    curve_jump,         /* its position jumps */
    curve_rough,        /* no series converges: some derivative is infinite */
    curve_intricate,    /* too many pieces or panels */
    curve_open,         /* `closed`, but its ends do not meet */
    curve_bent,         /* `closed`, but its ends meet at an angle */
};

struct curve_panel;
struct curve_piece;

struct curve {
    const struct expr *x, *y; /* over slot 1 */
    double from, to;          /* the range of p, ascending */
    bool closed;              /* periodic: s continues over many rounds */
    double start, length;     /* s at `from`; s = 0 is where p = 0, or at `from` if p has no zero */
    double turning;           /* angle between both ends, including whole turns */
    int piece_count, panel_count;
    struct curve_piece *pieces;
    struct curve_panel *panels;
    struct table *ends; /* ends of the pieces in s, as a table (table.h); NULL for one piece without ends */
    bool kinked;        /* the curvature jumps */
    double kink;        /* p of the first jump */
};

/* Geometry of the curve at the arc length s. */
struct curve_place {
    struct vec r, e;
    double angle;       /* of e, continuous */
    double bend, slope; /* kappa, d kappa / ds */
};

/* Make a curve; the caller sets x, y, from, to and closed. On a fault *place is its parameter. All memory is
 * in `arena`. */
enum curve_fault curve_make(struct curve *curve, struct arena *arena, const char *name, double *place);

/* The geometry at s in piece *piece, numbered on over all rounds; NULL for the piece that contains s. */
struct curve_place curve_at(const struct curve *curve, const int *piece, double s);

/* d2 kappa / ds2. */
double curve_slope_rate(const struct curve *curve, const int *piece, double s);

/* The arc length of the sample point nearest to r: an initial value for the projection of r onto the curve. */
double curve_near(const struct curve *curve, struct vec r);

/* The same if it is nearer than `distance`; else NAN. */
double curve_nearer(const struct curve *curve, struct vec r, double distance);

/* The arc length at parameter p within its range, and back. */
double curve_length_at(const struct curve *curve, double p);
double curve_parameter(const struct curve *curve, double s);

#endif
