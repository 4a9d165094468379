/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_find: values of a parameter at which an outcome changes or an equation holds, and the fit of parameters to data. The rules
 * of fbd.h apply.
 */
#ifndef FBD_FIND_H
#define FBD_FIND_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- at which value? */

/* The values of a parameter at which a run, or the equilibrium, changes or has a given property. */
typedef struct fbd_find fbd_find;

/* How they are searched. */
typedef struct fbd_find_plan {
    size_t size;                 /* sizeof(fbd_find_plan), or 0 */
    const fbd_setting *settings; /* the other parameters */
    size_t setting_count;
    const fbd_options *run; /* NULL for the file's; without error bars and accuracy */
    bool statics;           /* the scene at rest at its start, instead of a run */
    size_t runs;            /* of the scan of the range, ends included, at least 3; 0: 33 */
    fbd_watch *progress;    /* called after every run, or NULL; nonzero ends the search (`stopped`) */
    void *progress_context;
} fbd_find_plan;

/* Search a question
 *
 *     PARAMETER [= FROM..TO [UNIT]] [: CONDITION]
 *
 * Without a range that of the file (`range`) is searched. The condition of a run is
 *
 *     none           the list of happenings changes: slips and contacts that open, at the start and as events
 *     an outcome     `block slips`, `crate lifts`, `crate tips`, `cord breaks`, or an event: its name, `stick`,
 *                    `block.stick`: it begins or ceases to happen
 *     an equation    `ball.x = 12 m`, `max(ball.y) = 2*R`, `time(land) = 1.5 s`: expressions of the outputs of a
 *                    sweep and of parameters
 *
 * and with `statics`: none, where equilibrium ceases or begins; the name of a limit (fbd_statics_limit), where
 * that is reached.
 *
 * Method: runs at equal distances in the range (a scan); between two that differ, bisection for outcomes and
 * Brent's method (GSL) for equations, until the parameter is known to 1e-12 of the range, or of its rounding.
 * Of two changes of an outcome between two runs of the scan both may be missed; of two solutions of an equation
 * only where the difference of its sides has several extrema between them, since every minimum of its size is
 * searched. The error of a solution contains the effect of the tolerance of the run, estimated by runs with a
 * hundredth of it (half the step).
 *
 * The text is that of a model file, `name` its name in messages (fbd_model_source). NULL with notes in
 * `errors`: those of a wrong file or option, `unknown-parameter`, `bad-find`, `unknown-output`, `stopped`. */
FBD_API fbd_find *fbd_find_parse(const char *text, size_t length, const char *name, const char *question,
                                 const fbd_find_plan *plan, fbd_errors *errors);
FBD_API void fbd_find_free(fbd_find *find);

typedef enum fbd_solution_kind {
    FBD_SOLUTION_ROOT,   /* both sides of the equation agree */
    FBD_SOLUTION_CHANGE, /* an outcome changes */
    FBD_SOLUTION_JUMP,   /* the difference of both sides changes its sign in a jump: no value is a solution */
} fbd_solution_kind;

typedef struct fbd_solution {
    fbd_solution_kind kind;
    double value, error; /* of the parameter; error: estimated, of any sign */
    bool closed_form;    /* statics: from a margin that is linear in the parameter */
    /* outcomes: the happenings with smaller and larger values; equations: the difference of both sides, "-0.2 m"
     * at the neighbouring runs of the scan. NULL past the end. */
    const char *below, *above;
} fbd_solution;

/* The solutions in ascending order. */
FBD_API size_t fbd_find_solution_count(const fbd_find *find);
FBD_API fbd_solution fbd_find_solution(const fbd_find *find, size_t index);

/* The range that was searched, and the cost. */
typedef struct fbd_found {
    const char *parameter, *unit, *condition; /* unit of all its values; "" for a bare number */
    double from, to;
    double step; /* distance of the runs of the scan: of two solutions closer than that both may be missed */
    bool
        linear; /* equations: their difference is linear at all runs of the scan, so there is no other solution */
    size_t scan;   /* runs of the scan */
    size_t runs;   /* all runs */
    size_t failed; /* runs without a value because they failed: fbd_find_gap */
} fbd_found;

FBD_API fbd_found fbd_find_summary(const fbd_find *find);

/* A value of the parameter whose run has no value, so that its neighbourhood was not searched. */
typedef struct fbd_find_gap {
    double value;
    const char *status, *reason; /* as in a sweep; reason NULL past the end */
    bool failed;                 /* not only an output without a value, such as the time of an event */
} fbd_find_gap;

FBD_API size_t fbd_find_gap_count(const fbd_find *find);
FBD_API fbd_find_gap fbd_find_gap_get(const fbd_find *find, size_t index);

/* As text, and as one JSON object; NULL when memory is out. */
FBD_API char *fbd_find_text(const fbd_find *find);
FBD_API char *fbd_find_json(const fbd_find *find);

/* ---------------------------------------------------------------- fit to data */

/* Parameters of a model that make its run agree best with measured data. */
typedef struct fbd_fit fbd_fit;

/* How they are fitted. */
typedef struct fbd_fit_plan {
    size_t size;                   /* sizeof(fbd_fit_plan), or 0 */
    const char *const *parameters; /* names; NULL for all of the file that do not follow from others */
    size_t parameter_count;
    const fbd_setting *settings; /* parameters: where the search starts; others: their values */
    size_t setting_count;
    const fbd_options *run; /* NULL for the file's; the runs end at the last time of the data */
    fbd_watch *progress;    /* called after every run, or NULL; nonzero ends the fit (`stopped`) */
    void *progress_context;
} fbd_fit_plan;

/* Fit parameters to data: least squares by the Levenberg-Marquardt method (GSL, multifit_nlinear), from the values
 * of the file. `data` is a CSV text: its header has `t` and names of coordinates, rates and user states, with a
 * unit behind them ("pendulum.theta [deg]") or in the units of the model; then a row for each time, not before
 * the last one; a cell may be empty. A column "NAME +-" (or "NAME ±") has the standard deviations of column NAME,
 * for all columns or none; without them all columns must have one unit, and have one standard deviation, which
 * follows from the residuals. The run is evaluated at the times of the data by its dense output. Derivatives by
 * parameters are central differences with steps of the cube root of the tolerance times the value.
 *
 * NULL with notes in `errors`: those of a wrong file or option, `bad-data` (with line and column of the data),
 * `unknown-column`, `unknown-parameter`, `no-fit` (a run fails, or there is no convergence), `stopped`. A parameter
 * that the data do not determine is noted (`not-determined`, a warning), and its error is INFINITY. */
FBD_API fbd_fit *fbd_fit_parse(const char *text, size_t length, const char *name, const char *data,
                               size_t data_length, const char *data_name, const fbd_fit_plan *plan,
                               fbd_errors *errors);
FBD_API void fbd_fit_free(fbd_fit *fit);

/* A fitted parameter, in the units of the model. `error` is its standard error, [low, high] its confidence
 * interval of 95 % (Student's t, or normal where standard deviations are given), NAN without degrees of freedom.
 * The name is NULL past the last one. */
typedef struct fbd_fitted {
    const char *name, *unit;
    double value, error, low, high;
} fbd_fitted;

FBD_API size_t fbd_fit_count(const fbd_fit *fit);
FBD_API fbd_fitted fbd_fit_get(const fbd_fit *fit, size_t index);

/* The correlation of two fitted parameters; NAN where one is not determined. */
FBD_API double fbd_fit_correlation(const fbd_fit *fit, size_t a, size_t b);

/* The quality of the fit, and its cost. */
typedef struct fbd_fit_quality {
    size_t values;    /* measured values */
    size_t freedom;   /* those less the parameters */
    bool weighted;    /* by standard deviations: then squares are of residuals divided by these */
    double squares;   /* sum of squares of the residuals */
    double deviation; /* sqrt(squares / freedom) [*unit]; NAN without degrees of freedom */
    const char *unit; /* of the residuals; "" if weighted */
    size_t iterations, runs;
} fbd_fit_quality;

FBD_API fbd_fit_quality fbd_fit_summary(const fbd_fit *fit);

/* As text, and as one JSON object; NULL when memory is out. */
FBD_API char *fbd_fit_text(const fbd_fit *fit);
FBD_API char *fbd_fit_json(const fbd_fit *fit);

/* The data and the fitted run as a script for gnuplot that contains them, one plot for each quantity. `file` as in
 * fbd_result_gnuplot (fbd_export.h); NULL when memory is out. */
FBD_API char *fbd_fit_gnuplot(const fbd_fit *fit, const char *file);

#ifdef __cplusplus
}
#endif

#endif
