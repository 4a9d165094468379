/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fit: parameters of a model by least squares to measured data.
 *
 * With the residuals r_i = (y_i(p) - m_i)/s_i at the times of the data, the Levenberg-Marquardt method minimizes
 * sum r_i^2. At the minimum the covariance of p is C = (J^T J)^-1 with J = dr/dp where the standard deviations s_i
 * are given; else s_i = 1 and C = sigma^2 (J^T J)^-1 with sigma^2 = sum r_i^2/(values - parameters) (Bates and
 * Watts, Nonlinear Regression Analysis, 1988, section 2.2).
 */
#ifndef FBD_STUDY_FIT_H
#define FBD_STUDY_FIT_H

#include "base/arena.h"
#include "base/diag.h"
#include "base/text.h"
#include "fbd_find.h"

/* One measured value. */
struct fit_value {
    double t, value, deviation; /* value in the unit of the model; deviation 1 where none is given */
    size_t column;
};

enum { fit_curve_rows = 501 };

struct fit_data {
    struct fit_value *values; /* in the order of time */
    size_t count;
    const char **columns; /* names of quantities */
    const char **units;   /* theirs */
    const char *unit;     /* of all columns; "" if weighted */
    size_t column_count;
    bool weighted;
};

/* Read a CSV text for a model (fbd_fit_parse). Returns false with notes in `errors`; memory comes from `arena`. */
bool fit_data_read(struct fit_data *data, struct arena *arena, const char *text, size_t length,
                   const char *name, const fbd_model *model, fbd_errors *errors);

struct fbd_fit {
    struct arena arena;
    const char *source, *name; /* of the model file */
    size_t source_length;
    const char *data_name;
    const fbd_fit_plan *plan; /* of the caller, during the fit */
    fbd_errors *errors;
    double tolerance; /* of the runs */

    struct fit_data data;
    double *curve; /* fit_curve_rows rows of the fitted run: t, then the columns */
    fbd_fitted *fitted;
    size_t count;
    double *covariance; /* count x count: of the determined parameters, NAN for others */
    double squares;
    size_t iterations, runs;
    fbd_errors *run_errors; /* notes of the last run */
    const char *reason;     /* why the last run failed */
    bool stopped;
};

/* Residuals of data with these values of the parameters, one for each value. Returns false with fit->reason when the
 * run fails, or stopped. */
bool fit_residuals(struct fbd_fit *fit, const struct fit_data *data, const double *p, double *r);

/* Compute the values of the fitted run at equal intervals. Returns false as fit_residuals, or when memory is out
 * (fit_plot.c). */
bool fit_make_curve(struct fbd_fit *fit);

/* Minimize. Returns false with notes. */
bool fit_solve(struct fbd_fit *fit);

#endif
