/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Curves: x(p) and y(p) as expressions of one variable, by arc length.
 *
 * The range of p is cut where the formulas switch (pieces: on each of them they are smooth) and further into panels, on
 * which p(s) is a Chebyshev series to rounding. So a place on the curve costs one sum and the formulas themselves:
 * position, direction and curvature are those of the expressions, by exact derivatives, at that p. With r' = dr/dp:
 *
 *     ds/dp = |r'|,   e = r' / |r'|,   de/ds = kappa k x e,   kappa = (r' x r'') / |r'|^3
 *
 * The rate of the curvature is the derivative of its series on the panel. Beyond an end of a piece the curve goes on
 * along its circle of curvature there, for steps that look ahead.
 *
 * Lengths of panels are by the integral of the series of |r'| (Clenshaw-Curtis); see L. N. Trefethen, Approximation
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
    curve_not_finite,   /* a place, direction or curvature is no number */
    curve_stands_still, /* |r'| = 0: a cusp, or a parameter that rests */
    curve_corner,       /* its direction jumps */
    curve_jump,         /* it is torn */
    curve_rough,        /* no series gets hold of it: some derivative is infinite */
    curve_intricate,    /* too many pieces or panels */
    curve_open,         /* `closed`, and its ends do not meet */
    curve_bent,         /* `closed`, and its ends meet at an angle */
};

struct curve_panel;
struct curve_piece;

struct curve {
    const struct expr *x, *y; /* over slot 1 */
    double from, to;          /* the range of p, ascending */
    bool closed;              /* it repeats: s goes on, round after round */
    double start, length;     /* s at `from`; s = 0 is where p = 0, or `from` where p has no zero */
    double turning;           /* the angle between both ends, whole turns with it */
    int piece_count, panel_count;
    struct curve_piece *pieces;
    struct curve_panel *panels;
    struct table
        *ends;   /* where the pieces begin and end in s, as a table (table.h): NULL when there is but one that
                           has no end. Its pieces are those of the curve. */
    bool kinked; /* the curvature jumps somewhere, */
    double kink; /* there (p) */
};

/* All that a body on it needs, s being the length along it. */
struct curve_place {
    struct vec r, e;
    double angle;       /* of e, without jumps */
    double bend, slope; /* kappa, d kappa / ds */
};

/* x, y, from, to and closed are set before. On a fault *place is the parameter where it is. All memory is of `arena`. */
enum curve_fault curve_make(struct curve *curve, struct arena *arena, const char *name, double *place);

/* In piece number *piece, counted on round after round; NULL for the one in which s lies. */
struct curve_place curve_at(const struct curve *curve, const int *piece, double s);

/* d2 kappa / ds2. */
double curve_slope_rate(const struct curve *curve, const int *piece, double s);

/* The arc length of the place that is nearest to r among sixteen of each panel: where to begin to look for the foot. */
double curve_near(const struct curve *curve, struct vec r);

/* The same where that is nearer than `distance`; NAN where none of them is. */
double curve_nearer(const struct curve *curve, struct vec r, double distance);

/* The arc length at parameter p within its range, and back. */
double curve_length_at(const struct curve *curve, double p);
double curve_parameter(const struct curve *curve, double s);

#endif
