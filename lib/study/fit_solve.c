/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Least squares: residuals by runs, their derivatives, the minimum and its covariance.
 */
#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <string.h>

#include "study/fit.h"

/* ---- residuals */

static fbd_model *model_of(struct fbd_fit *fit, const double *p)
{
    const fbd_fit_plan *plan = fit->plan;
    const size_t count = plan->setting_count + fit->count;
    struct arena scratch = {0};
    fbd_setting *settings = ARENA_ARRAY(&scratch, count + 1, fbd_setting);
    size_t used = 0;
    for (size_t i = 0; settings && i < plan->setting_count; i++) {
        bool fitted = false;
        for (size_t k = 0; k < fit->count; k++)
            fitted |= strcmp(fit->fitted[k].name, plan->settings[i].name) == 0;
        if (!fitted) settings[used++] = plan->settings[i];
    }
    for (size_t k = 0; settings && k < fit->count; k++) {
        struct text text = {0};
        text_exact(&text, p[k]);
        const char *value = text.failed ? NULL : arena_text(&scratch, text.data, text.length);
        text_free(&text);
        settings[used++] = (fbd_setting){fit->fitted[k].name, value};
    }
    fbd_errors_free(fit->run_errors);
    fit->run_errors = fbd_errors_new();
    fbd_model *model =
        settings && !scratch.failed
            ? fbd_model_parse(fit->source, fit->source_length, fit->name, settings, used, fit->run_errors)
            : NULL;
    arena_free(&scratch);
    return model;
}

/* Residuals of the values in the last step, from value *next on. */
static bool take(const struct fit_data *data, fbd_simulation *simulation, fbd_state *state, size_t *next,
                 double *r)
{
    double from, to, y;
    fbd_simulation_interval(simulation, &from, &to);
    for (; *next < data->count && data->values[*next].t <= to; (*next)++) {
        const struct fit_value *value = &data->values[*next];
        if (!fbd_simulation_state(simulation, value->t, state)) return false;
        if (!fbd_state_get(state, data->columns[value->column], &y)) return false;
        r[*next] = (y - value->value) / value->deviation;
    }
    return true;
}

static bool run_along(struct fbd_fit *fit, const struct fit_data *data, const fbd_model *model,
                      fbd_simulation *simulation, double *r)
{
    fbd_state *state = fbd_state_new(model);
    fbd_outcome outcome = FBD_GOING;
    size_t next = 0;
    bool taken = state != NULL;
    while (taken && outcome == FBD_GOING && next < data->count) {
        outcome = fbd_simulation_advance(simulation);
        taken =
            outcome != FBD_FAILED && outcome != FBD_OUT_OF_MEMORY && take(data, simulation, state, &next, r);
    }
    fbd_state_free(state);
    if (taken && next == data->count) return true;
    const char *reason = fbd_simulation_reason(simulation);
    if (!reason[0]) reason = "the run ends before the last time of the data";
    fit->reason = arena_text(&fit->arena, reason, strlen(reason));
    return false;
}

static bool goes_on(struct fbd_fit *fit)
{
    const fbd_fit_plan *plan = fit->plan;
    const fbd_progress progress = {"fit", .written = ++fit->runs};
    if (!plan->progress || plan->progress(plan->progress_context, &progress) == 0) return true;
    fit->stopped = true;
    return false;
}

bool fit_residuals(struct fbd_fit *fit, const struct fit_data *data, const double *p, double *r)
{
    fbd_options run = *fit->plan->run;
    run.until = fmax(data->values[data->count - 1].t, 1e-9);
    fbd_model *model = model_of(fit, p);
    fbd_simulation *simulation = model ? fbd_simulation_new(model, &run, fit->run_errors) : NULL;
    bool made = simulation && run_along(fit, data, model, simulation, r);
    if (!simulation && fit->run_errors) {
        size_t i = 0;
        while (i + 1 < fbd_errors_count(fit->run_errors) &&
               fbd_errors_get(fit->run_errors, i).severity != FBD_ERROR)
            i++;
        const fbd_error error = fbd_errors_get(fit->run_errors, i);
        fit->reason =
            error.message ? arena_text(&fit->arena, error.message, strlen(error.message)) : "out of memory";
    }
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return goes_on(fit) && made;
}

/* ---- for GSL */

/* The residuals of a run that fails: so large that the step towards it is rejected. */
static void fill_refused(gsl_vector *f)
{
    const double refused = 1e100;
    gsl_vector_set_all(f, refused);
}

static int residuals(const gsl_vector *x, void *context, gsl_vector *f)
{
    struct fbd_fit *fit = context;
    if (fit->stopped) return GSL_EBADFUNC;
    if (!fit_residuals(fit, &fit->data, x->data, f->data)) fill_refused(f);
    return fit->stopped ? GSL_EBADFUNC : GSL_SUCCESS;
}

/* Central differences: with a relative error eps of the runs the error is least for steps of some eps^(1/3). */
static int derivatives(const gsl_vector *x, void *context, gsl_matrix *J)
{
    struct fbd_fit *fit = context;
    const size_t n = fit->data.count;
    gsl_vector *p = gsl_vector_alloc(fit->count), *up = gsl_vector_alloc(n), *down = gsl_vector_alloc(n);
    int status = p && up && down ? GSL_SUCCESS : GSL_ENOMEM;
    for (size_t k = 0; status == GSL_SUCCESS && k < fit->count; k++) {
        const double value = gsl_vector_get(x, k), h = cbrt(fit->tolerance) * (value != 0 ? fabs(value) : 1);
        gsl_vector_memcpy(p, x);
        gsl_vector_set(p, k, value + h);
        bool made = fit_residuals(fit, &fit->data, p->data, up->data);
        gsl_vector_set(p, k, value - h);
        made = made && fit_residuals(fit, &fit->data, p->data, down->data);
        if (!made) status = GSL_EBADFUNC;
        for (size_t i = 0; made && i < n; i++)
            gsl_matrix_set(J, i, k, (up->data[i] - down->data[i]) / (2 * h));
    }
    gsl_vector_free(p);
    gsl_vector_free(up);
    gsl_vector_free(down);
    return status;
}

/* ---- the covariance */

static bool add_undetermined(struct fbd_fit *fit, const bool *lost)
{
    struct text names = {0};
    for (size_t k = 0; k < fit->count; k++)
        if (lost[k]) text_printf(&names, names.length ? ", `%s`" : "`%s`", fit->fitted[k].name);
    if (names.length && !names.failed)
        diag_add(fit->errors, FBD_WARNING, "not-determined", (struct pos){0, 0},
                 "fit fewer parameters, or give data that depend on them in another way",
                 "the data do not determine %s", names.data);
    const bool failed = names.failed;
    text_free(&names);
    return !failed;
}

/* The singular value decomposition of J with columns of length one. Small singular values are directions that the
 * data do not determine; parameters with a part in one of them are lost, within the accuracy of J. */
static bool covariance(struct fbd_fit *fit, const gsl_matrix *J)
{
    const double rounding = 1e-6, part = 0.01;
    const size_t count = fit->count;
    gsl_matrix *U = gsl_matrix_alloc(J->size1, count), *V = gsl_matrix_alloc(count, count);
    gsl_vector *s = gsl_vector_alloc(count), *work = gsl_vector_alloc(count);
    double *norms = ARENA_ARRAY(&fit->arena, count, double);
    bool *lost = ARENA_ARRAY(&fit->arena, count, bool);
    bool fine = U && V && s && work && norms && lost;
    if (fine) {
        gsl_matrix_memcpy(U, J);
        for (size_t k = 0; k < count; k++) {
            gsl_vector_view column = gsl_matrix_column(U, k);
            norms[k] = gsl_blas_dnrm2(&column.vector);
            lost[k] = !(norms[k] > 0);
            if (norms[k] > 0) gsl_vector_scale(&column.vector, 1 / norms[k]);
        }
        fine = gsl_linalg_SV_decomp(U, V, s, work) == GSL_SUCCESS;
    }
    const double least = fine ? rounding * gsl_vector_get(s, 0) : 0;
    for (size_t j = 0; fine && j < count; j++)
        for (size_t k = 0; k < count && gsl_vector_get(s, j) <= least; k++)
            lost[k] |= fabs(gsl_matrix_get(V, k, j)) > part;
    for (size_t a = 0; fine && a < count; a++) {
        for (size_t b = 0; b < count; b++) {
            double sum = 0;
            for (size_t j = 0; j < count; j++) {
                const double sigma = gsl_vector_get(s, j);
                if (sigma > least) sum += gsl_matrix_get(V, a, j) * gsl_matrix_get(V, b, j) / (sigma * sigma);
            }
            fit->covariance[a * count + b] = lost[a] || lost[b] ? NAN : sum / (norms[a] * norms[b]);
        }
    }
    gsl_matrix_free(U);
    gsl_matrix_free(V);
    gsl_vector_free(s);
    gsl_vector_free(work);
    return fine && add_undetermined(fit, lost);
}

static void set_errors(struct fbd_fit *fit)
{
    const double tail = 0.975;
    const size_t count = fit->count, freedom = fit->data.count - count;
    const double variance = fit->data.weighted ? 1 : freedom > 0 ? fit->squares / (double)freedom : NAN;
    const double reach = fit->data.weighted ? gsl_cdf_gaussian_Pinv(tail, 1)
                         : freedom > 0      ? gsl_cdf_tdist_Pinv(tail, (double)freedom)
                                            : NAN;
    for (size_t i = 0; i < count * count; i++) fit->covariance[i] *= variance;
    for (size_t k = 0; k < count; k++) {
        fbd_fitted *fitted = &fit->fitted[k];
        const double own = fit->covariance[k * count + k];
        fitted->error = isnan(own) && !isnan(variance) ? INFINITY : sqrt(own);
        fitted->low = fitted->value - reach * fitted->error;
        fitted->high = fitted->value + reach * fitted->error;
    }
}

/* ---- the minimum */

/* At a minimum the residuals are orthogonal to their derivatives; those of exact data are as small as rounding. */
static bool is_minimum(const struct fbd_fit *fit, const gsl_vector *f, const gsl_matrix *J)
{
    const double cosine = 1e-3, exact = 1e-7;
    const double norm = gsl_blas_dnrm2(f);
    double size = 0;
    for (size_t i = 0; i < fit->data.count; i++)
        size = hypot(size, fit->data.values[i].value / fit->data.values[i].deviation);
    if (norm <= exact * size) return true;
    for (size_t k = 0; k < fit->count; k++) {
        gsl_vector_const_view column = gsl_matrix_const_column(J, k);
        double product;
        gsl_blas_ddot(f, &column.vector, &product);
        if (fabs(product) > cosine * norm * gsl_blas_dnrm2(&column.vector)) return false;
    }
    return true;
}

static bool give_up(struct fbd_fit *fit, const char *message)
{
    const bool failed = fit->reason && fit->reason[0];
    diag_in_file(fit->errors, NULL);
    if (fit->stopped)
        diag_add(fit->errors, FBD_ERROR, "stopped", (struct pos){0, 0}, NULL, "the fit was stopped");
    else
        diag_add(fit->errors, FBD_ERROR, "no-fit", (struct pos){0, 0},
                 "start nearer to the solution, by --set, or fit fewer parameters", "%s%s%s", message,
                 failed ? ": " : "", failed ? fit->reason : "");
    return false;
}

static bool minimize(struct fbd_fit *fit, gsl_multifit_nlinear_workspace *work,
                     gsl_multifit_nlinear_fdf *system)
{
    enum { most_iterations = 200 };
    const double step = 1e-10, gradient = 1e-14;
    int info;
    gsl_vector *start = gsl_vector_alloc(fit->count);
    if (!start) return false;
    for (size_t k = 0; k < fit->count; k++) gsl_vector_set(start, k, fit->fitted[k].value);
    bool begun = fit_residuals(fit, &fit->data, start->data, work->f->data);
    int status = begun ? gsl_multifit_nlinear_init(start, system, work) : GSL_EBADFUNC;
    gsl_vector_free(start);
    if (status != GSL_SUCCESS) return give_up(fit, "no run with the parameters of the start");
    fit->reason = NULL;
    status = gsl_multifit_nlinear_driver(most_iterations, step, gradient, 0, NULL, NULL, &info, work);
    fit->iterations = gsl_multifit_nlinear_niter(work);
    if (fit->stopped || status == GSL_EBADFUNC) return give_up(fit, "a run beside the parameters failed");
    const gsl_vector *f = gsl_multifit_nlinear_residual(work);
    if (!is_minimum(fit, f, gsl_multifit_nlinear_jac(work)))
        return give_up(fit, "the search has not converged to a minimum");
    for (size_t k = 0; k < fit->count; k++)
        fit->fitted[k].value = gsl_vector_get(gsl_multifit_nlinear_position(work), k);
    gsl_blas_ddot(f, f, &fit->squares);
    return true;
}

bool fit_solve(struct fbd_fit *fit)
{
    const gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_fdf system = {
        .f = residuals, .df = derivatives, .n = fit->data.count, .p = fit->count, .params = fit};
    gsl_multifit_nlinear_workspace *work =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, system.n, system.p);
    fit->covariance = ARENA_ARRAY(&fit->arena, fit->count * fit->count, double);
    bool fine = work && fit->covariance && minimize(fit, work, &system) &&
                covariance(fit, gsl_multifit_nlinear_jac(work));
    if (fine) set_errors(fit);
    if (fine && !fit_make_curve(fit))
        fine = !fit->arena.failed && give_up(fit, "the run with the fitted parameters failed");
    if (work) gsl_multifit_nlinear_free(work);
    return fine;
}
