/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/table.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- construction */

static const gsl_interp_type *type_of(enum table_interpolation interpolation, enum table_beyond beyond)
{
    bool periodic = beyond == table_repeat;
    switch (interpolation) {
    case table_cubic: return periodic ? gsl_interp_cspline_periodic : gsl_interp_cspline;
    case table_akima: return periodic ? gsl_interp_akima_periodic : gsl_interp_akima;
    case table_steffen: return gsl_interp_steffen;
    default: return NULL;
    }
}

size_t table_least(enum table_interpolation interpolation, enum table_beyond beyond)
{
    const gsl_interp_type *type = type_of(interpolation, beyond);
    size_t least = type ? gsl_interp_type_min_size(type) : 2;
    return least < 2 ? 2 : least;
}

/* Set c_0 and c_1: linear between points, or constant for steps. */
static void make_lines(struct table *table, const double *y)
{
    bool steps = table->interpolation == table_step;
    for (size_t i = 0; i + 1 < table->count; i++) {
        double *c = table->c + 4 * i;
        c[0] = y[i];
        c[1] = steps ? 0 : (y[i + 1] - y[i]) / (table->x[i + 1] - table->x[i]);
    }
}

/* The derivatives at the start of each piece are GSL's; the last coefficient makes the piece continuous at
 * its end. */
static bool make_spline(struct table *table, const double *y)
{
    size_t count = table->count;
    gsl_interp *spline = gsl_interp_alloc(type_of(table->interpolation, table->beyond), count);
    gsl_interp_accel *near = gsl_interp_accel_alloc();
    bool fine = spline && near && gsl_interp_init(spline, table->x, y, count) == GSL_SUCCESS;
    for (size_t i = 0; fine && i + 1 < count; i++) {
        double *c = table->c + 4 * i, h = table->x[i + 1] - table->x[i], curve;
        fine = gsl_interp_eval_deriv_e(spline, table->x, y, table->x[i], near, &c[1]) == GSL_SUCCESS &&
               gsl_interp_eval_deriv2_e(spline, table->x, y, table->x[i], near, &curve) == GSL_SUCCESS;
        if (!fine) break;
        c[0] = y[i];
        c[2] = curve / 2;
        c[3] = ((((y[i + 1] - y[i]) / h - c[1]) / h) - c[2]) / h;
    }
    gsl_interp_free(spline);
    gsl_interp_accel_free(near);
    return fine;
}

static bool is_finite(const struct table *table)
{
    for (size_t k = 0; k < 4 * (table->count - 1); k++)
        if (!isfinite(table->c[k])) return false;
    return isfinite(table->period.x);
}

enum table_status table_make(struct table *table, size_t count, const double *x, const double *y)
{
    bool spline = type_of(table->interpolation, table->beyond) != NULL;
    if (count < table_least(table->interpolation, table->beyond)) return table_too_few;
    if (spline && table->beyond == table_repeat && y[0] != y[count - 1]) return table_open;
    table->count = count;
    table->x = calloc(count, sizeof *table->x);
    table->c = calloc(4 * (count - 1), sizeof *table->c);
    enum table_status status = table_no_memory;
    if (table->x && table->c) {
        memcpy(table->x, x, count * sizeof *x);
        if (!spline) make_lines(table, y);
        bool made = !spline || make_spline(table, y);
        table->period = dd_sum(x[count - 1], -x[0]);
        table->before = table->beyond == table_hold ? y[0] : table->beyond == table_zero ? 0 : (double)NAN;
        table->after = table->beyond == table_hold ? y[count - 1] : table->before;
        table->per_knot = (double)(count - 1) / table->period.x;
        status = !made ? table_no_memory : is_finite(table) ? table_made : table_too_steep;
    }
    if (status != table_made) table_drop(table);
    return status;
}

void table_drop(struct table *table)
{
    free(table->x);
    free(table->c);
    table->x = table->c = NULL;
}

/* ---- pieces */

/* The piece in [0, count - 2] whose start is the last knot at or below x. */
static size_t search(const struct table *table, double x)
{
    const double *knots = table->x;
    size_t low = 0, high = table->count - 1;
    double guess = (x - knots[0]) * table->per_knot;
    if (guess >= 0 && guess < (double)high) {
        size_t i = (size_t)guess;
        if (knots[i] <= x && x < knots[i + 1]) return i;
        if (knots[i] > x)
            high = i;
        else
            low = i + 1;
    }
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (knots[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low < table->count - 1 ? low : table->count - 2;
}

/* Tolerance of the ends with table_error: within rounding beyond its last knot a table has not ended. */
static double slack(const struct table *table)
{
    const double rounding = 1e-12;
    return table->beyond == table_error ? rounding * table->period.x : 0;
}

double table_piece(const struct table *table, double x)
{
    double first = table->x[0], last = table->x[table->count - 1], pieces = (double)(table->count - 1);
    if (isnan(x)) return 0;
    if (table->beyond == table_repeat) {
        double k = floor((x - first) / table->period.x);
        if (!isfinite(k)) return 0;
        double in_period = (x - k * table->period.x) - k * table->period.rest;
        return k * pieces + (double)search(table, fmin(fmax(in_period, first), last));
    }
    if (x < first - slack(table)) return -1;
    if (x > last + slack(table) || (x == last && table->beyond != table_error)) return pieces;
    return (double)search(table, x);
}

/* The piece within the first period, and the number of periods before it. */
static size_t within(const struct table *table, double piece, double *periods)
{
    double pieces = (double)(table->count - 1);
    *periods = floor(piece / pieces);
    double rest = piece - *periods * pieces;
    return rest < pieces ? (size_t)rest : 0;
}

static struct double_double knot(const struct table *table, size_t i, double periods)
{
    struct double_double x = {table->x[i], 0};
    if (periods == 0) return x;
    return dd_add(x, dd_multiply((struct double_double){periods, 0}, table->period));
}

static bool is_beyond(const struct table *table, double piece)
{
    return table->beyond != table_repeat && (piece < 0 || piece >= (double)(table->count - 1));
}

void table_ends(const struct table *table, double piece, struct double_double *low,
                struct double_double *high)
{
    size_t last = table->count - 1;
    if (is_beyond(table, piece)) {
        *low = piece < 0 ? (struct double_double){-HUGE_VAL, 0}
                         : (struct double_double){table->x[last] + slack(table), 0};
        *high = piece < 0 ? (struct double_double){table->x[0] - slack(table), 0}
                          : (struct double_double){HUGE_VAL, 0};
        return;
    }
    double periods = 0;
    size_t i = table->beyond == table_repeat ? within(table, piece, &periods) : (size_t)piece;
    *low = knot(table, i, periods);
    *high = knot(table, i + 1, periods);
    if (i == 0) low->x -= slack(table);
    if (i + 1 == last) high->x += slack(table);
}

struct table_polynomial table_polynomial(const struct table *table, double piece)
{
    struct table_polynomial p = {0};
    if (is_beyond(table, piece)) {
        p.c[0] = piece < 0 ? table->before : table->after;
        return p;
    }
    if (fabs(piece) >= table_most_pieces) {
        p.c[0] = (double)NAN;
        return p;
    }
    double periods = 0;
    size_t i = table->beyond == table_repeat ? within(table, piece, &periods) : (size_t)piece;
    p.from = knot(table, i, periods).x;
    memcpy(p.c, table->c + 4 * i, sizeof p.c);
    return p;
}

double table_value(const struct table *table, double piece, double x)
{
    struct table_polynomial p = table_polynomial(table, piece);
    double u = x - p.from;
    if (isnan(u)) return u;
    return p.c[0] +
           (table->interpolation == table_linear ? u * p.c[1] : u * (p.c[1] + u * (p.c[2] + u * p.c[3])));
}

double table_rounding(const struct table *table, double piece, double x)
{
    struct table_polynomial p = table_polynomial(table, piece);
    double u = fabs(x - p.from), slope = fabs(p.c[1]) + u * (2 * fabs(p.c[2]) + 3 * u * fabs(p.c[3]));
    double size = fabs(p.c[0]) + u * (fabs(p.c[1]) + u * (fabs(p.c[2]) + u * fabs(p.c[3])));
    return 2 * DBL_EPSILON * (size + slope * (fabs(p.from) + fabs(x)));
}

void table_slopes(const struct table *table, double piece, double x, double *f, double *d, double *dd)
{
    struct table_polynomial p = table_polynomial(table, piece);
    double u = x - p.from;
    *f = table_value(table, piece, x);
    *d = p.c[1] + u * (2 * p.c[2] + 3 * u * p.c[3]);
    *dd = 2 * p.c[2] + 6 * u * p.c[3];
}

bool table_has_ended(const struct table *table, double piece)
{
    return table->beyond == table_error && is_beyond(table, piece);
}

int table_degree(const struct table *table)
{
    return table->interpolation == table_step ? 0 : table->interpolation == table_linear ? 1 : 3;
}

/* True if two numbers agree up to the rounding of terms of magnitude `size`. */
static bool agree(double a, double b, double size)
{
    const double rounding = 1e-10;
    return fabs(a - b) <= rounding * size;
}

int table_smoothness(const struct table *table, double piece)
{
    struct double_double low, start, high;
    double f[2], d[2], dd[2];
    table_ends(table, piece - 1, &low, &start);
    table_ends(table, piece, &start, &high);
    table_slopes(table, piece - 1, start.x, &f[0], &d[0], &dd[0]);
    table_slopes(table, piece, start.x, &f[1], &d[1], &dd[1]);
    double h = fmin(start.x - low.x, high.x - start.x); /* one of them is finite */
    double slope = fabs(d[0]) + fabs(d[1]), curve = fabs(dd[0]) + fabs(dd[1]);
    double bend = curve * h, size = fabs(f[0]) + fabs(f[1]) + (slope + bend) * h;
    if (!agree(f[0], f[1], size)) return -1;
    if (!agree(d[0], d[1], slope + bend + size / h)) return 0;
    return agree(dd[0], dd[1], curve + slope / h) ? 2 : 1;
}
