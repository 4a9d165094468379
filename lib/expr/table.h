/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tables: functions of one argument given by points, such as measured data.
 *
 * Between two knots x_i and x_(i+1) a table is a polynomial in u = x - x_i,
 *
 *   f = c_0 + u (c_1 + u (c_2 + u c_3)),
 *
 * and that polynomial is its piece i, also beyond the ends of the piece. So a table is a switch like floor
 * (expr.h): the branch is the piece, evaluation with a given branch is smooth and needs no search, and no
 * step of an integrator contains a knot. Piece -1 is before the first knot and piece count - 1 from the last
 * one on; with `repeat` the pieces are numbered through all periods, piece p + k (count - 1) being piece p, k
 * periods later.
 *
 * The coefficients of cubic (natural, or periodic with `repeat`), Akima and Steffen splines are those of
 * GSL's gsl_interp, from its derivatives at the knots; c_3 follows from continuity.
 *
 * Sources: C. de Boor, A Practical Guide to Splines, 1978; H. Akima, J. ACM 17 (1970) 589; M. Steffen,
 * Astron. Astrophys. 239 (1990) 443.
 */
#ifndef FBD_EXPR_TABLE_H
#define FBD_EXPR_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/double_double.h"
#include "expr/dim.h"

/* Pieces of periods are numbered up to this; beyond, a table has no value. */
enum { table_most_pieces = 2147483647 };

enum table_interpolation {
    table_linear,
    table_step,    /* f(x_i) from x_i on */
    table_cubic,   /* natural cubic spline: continuous up to the second derivative */
    table_akima,   /* continuous first derivative, without overshoot beside steps */
    table_steffen, /* likewise, and monotonic between points */
};

enum table_beyond {
    table_hold, /* the first and the last value */
    table_zero,
    table_repeat, /* with the period x_(count - 1) - x_0 */
    table_error,  /* no value: a run that gets there ends */
};

struct table {
    const char *name;
    struct dim x_dim, y_dim;
    bool x_free, y_free; /* given without units: any dimension is accepted */
    enum table_interpolation interpolation;
    enum table_beyond beyond;
    size_t count;                /* knots */
    double *x;                   /* count, ascending */
    double *c;                   /* 4 for each of the count - 1 pieces */
    double before, after;        /* the values beyond the ends */
    double per_knot;             /* knots per unit of x, if equidistant: first guess of the search */
    struct double_double period; /* of `repeat` */
};

enum table_status {
    table_made,
    table_no_memory,
    table_too_few,   /* fewer points than table_least */
    table_open,      /* `repeat` of a spline whose ends differ */
    table_too_steep, /* differences of points overflow */
};

/* The minimum number of points of an interpolation. */
size_t table_least(enum table_interpolation interpolation, enum table_beyond beyond);

/* Make a table of `count` points. x ascends strictly, and all values are finite. The caller sets
 * `interpolation` and `beyond`; `x` and `c` are allocated, see table_drop. */
enum table_status table_make(struct table *table, size_t count, const double *x, const double *y);
void table_drop(struct table *table);

/* The piece that contains `x`; 0 for NaN. In O(1) if the knots are about equidistant, else in O(log count). */
double table_piece(const struct table *table, double x);

/* The ends of a piece; -HUGE_VAL and HUGE_VAL if it has none. */
void table_ends(const struct table *table, double piece, struct double_double *low,
                struct double_double *high);

/* The polynomial of a piece: u = x - the knot `from`, and its coefficients. */
struct table_polynomial {
    double from;
    double c[4];
};
struct table_polynomial table_polynomial(const struct table *table, double piece);

/* The value of a piece at x; table_slopes also gives the first two derivatives. */
double table_value(const struct table *table, double piece, double x);
/* Bound of the rounding error of that value, including that of x. */
double table_rounding(const struct table *table, double piece, double x);
void table_slopes(const struct table *table, double piece, double x, double *f, double *d, double *dd);

/* True if the piece is beyond an end with table_error. */
bool table_has_ended(const struct table *table, double piece);

/* The degree of the pieces: 0, 1 or 3. */
int table_degree(const struct table *table);

/* The number of derivatives that are continuous at the start of `piece`, up to 2: -1 where the value jumps, 0
 * at a corner. Determined numerically, so collinear points count as smooth. */
int table_smoothness(const struct table *table, double piece);

#endif
