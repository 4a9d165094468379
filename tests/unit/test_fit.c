/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The fit of parameters to data, compared with linear regression, which has a closed form.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fbd_find.h"

/* x = v0 t + F t^2/(2 m): linear in v0 and F. */
static const char block[] = "fbd: 1\nparameters: {v0: 1 m/s, F: 2 N, m: 2 kg}\n"
                            "bodies:\n  block: {mass: m, motion: slide, initial: {v: v0}, forces: [applied: "
                            "{name: push, value: F}]}\n"
                            "simulate: {until: 1 s}\n";

enum { rows = 6 };
static const double t[rows] = {0.5, 1, 1.5, 2, 2.5, 3}, x[rows] = {1.02, 2.3, 4.15, 6.05, 8.4, 11.2};

/* The regression x = a u + b w with u = t, w = t^2/4 and weights 1/s^2: estimates and their covariance without the
 * variance. */
struct regression {
    double a, b, aa, ab, bb, squares;
};

static struct regression regress(const double *s)
{
    double uu = 0, uw = 0, ww = 0, ux = 0, wx = 0;
    struct regression fit = {0};
    for (int i = 0; i < rows; i++) {
        const double u = t[i], w = t[i] * t[i] / 4, weight = 1 / (s[i] * s[i]);
        uu += weight * u * u, uw += weight * u * w, ww += weight * w * w;
        ux += weight * u * x[i], wx += weight * w * x[i];
    }
    const double det = uu * ww - uw * uw;
    fit.a = (ww * ux - uw * wx) / det;
    fit.b = (uu * wx - uw * ux) / det;
    fit.aa = ww / det, fit.ab = -uw / det, fit.bb = uu / det;
    for (int i = 0; i < rows; i++)
        fit.squares += pow((fit.a * t[i] + fit.b * t[i] * t[i] / 4 - x[i]) / s[i], 2);
    return fit;
}

struct asked {
    fbd_fit *fit;
    fbd_errors *errors;
};

static const char *const v0_and_F[] = {"v0", "F"};

static struct asked ask(const char *data, const fbd_fit_plan *plan)
{
    const fbd_fit_plan usual = {.parameters = v0_and_F, .parameter_count = 2};
    struct asked asked = {.errors = fbd_errors_new()};
    assert_non_null(asked.errors);
    asked.fit = fbd_fit_parse(block, strlen(block), "model.yaml", data, strlen(data), "data.csv",
                              plan ? plan : &usual, asked.errors);
    return asked;
}

static void end(struct asked *asked)
{
    fbd_fit_free(asked->fit);
    fbd_errors_free(asked->errors);
}

static void assert_near(double actual, double expected, double share)
{
    if (!(fabs(actual - expected) <= share * fabs(expected)))
        print_error("%.17g instead of %.17g, off by %.2g of %.2g\n", actual, expected,
                    fabs(actual / expected - 1), share);
    assert_true(fabs(actual - expected) <= share * fabs(expected));
}

/* Derivatives are central differences with steps of 5e-4, exact for a linear model to the tolerance 1e-10 of the
 * runs divided by the step: 2e-7. */
static const double share = 1e-6;

static void write_data(char *text, size_t size, const double *s)
{
    int used = snprintf(text, size, s ? "t,block.x,block.x +-\n" : "t,block.x\n");
    for (int i = 0; i < rows; i++) {
        used += snprintf(text + used, size - (size_t)used, "%g,%g", t[i], x[i]);
        used += snprintf(text + used, size - (size_t)used, s ? ",%g\n" : "\n", s ? s[i] : 0);
    }
}

static void a_linear_model_has_the_errors_of_regression(void **unused)
{
    (void)unused;
    static const double ones[rows] = {1, 1, 1, 1, 1, 1};
    const double student = 2.7764451051977987; /* of 97.5 % for 4 degrees of freedom */
    const struct regression expected = regress(ones);
    char data[1000];
    write_data(data, sizeof data, NULL);
    struct asked asked = ask(data, NULL);
    assert_non_null(asked.fit);
    const fbd_fitted v0 = fbd_fit_get(asked.fit, 0), F = fbd_fit_get(asked.fit, 1);
    const double variance = expected.squares / (rows - 2);
    assert_near(v0.value, expected.a, share);
    assert_near(F.value, expected.b, share);
    assert_near(v0.error, sqrt(variance * expected.aa), share);
    assert_near(F.error, sqrt(variance * expected.bb), share);
    assert_near(v0.high - v0.value, student * v0.error, 1e-9);
    assert_near(F.value - F.low, student * F.error, 1e-9);
    assert_near(fbd_fit_correlation(asked.fit, 0, 1), expected.ab / sqrt(expected.aa * expected.bb), share);
    const fbd_fit_quality quality = fbd_fit_summary(asked.fit);
    assert_near(quality.squares, expected.squares, share);
    assert_near(quality.deviation, sqrt(variance), share);
    assert_true(quality.values == rows && quality.freedom == rows - 2 && !quality.weighted &&
                quality.runs > 2);
    assert_string_equal(quality.unit, "m");
    assert_string_equal(F.unit, "N");
    end(&asked);
}

static void given_deviations_weigh(void **unused)
{
    (void)unused;
    static const double s[rows] = {0.01, 0.1, 0.05, 0.1, 0.2, 0.4};
    const double normal = 1.959963984540054;
    const struct regression expected = regress(s);
    char data[1000];
    write_data(data, sizeof data, s);
    struct asked asked = ask(data, NULL);
    assert_non_null(asked.fit);
    const fbd_fitted v0 = fbd_fit_get(asked.fit, 0), F = fbd_fit_get(asked.fit, 1);
    assert_near(v0.value, expected.a, share);
    assert_near(F.value, expected.b, share);
    assert_near(v0.error, sqrt(expected.aa), share);
    assert_near(F.error, sqrt(expected.bb), share);
    assert_near(F.high - F.value, normal * F.error, 1e-9);
    assert_near(fbd_fit_summary(asked.fit).squares, expected.squares, share);
    assert_true(fbd_fit_summary(asked.fit).weighted);
    end(&asked);
}

/* v = v0 + F t/m and x, exact, in other units, with empty cells: 3 m/s and 4 N. */
static void exact_data_are_met(void **unused)
{
    (void)unused;
    struct asked asked = ask("\"t [ms]\",\"block.x [cm]\",block.x +-,block.v,block.v \xC2\xB1\r\n"
                             "500,175,0.1,,\r\n1000,,,5,0.1\r\n\r\n2000,1000,0.1,7,0.1\r\n",
                             NULL);
    if (!asked.fit) fbd_errors_print(asked.errors, stderr);
    assert_non_null(asked.fit);
    assert_near(fbd_fit_get(asked.fit, 0).value, 3, 1e-9);
    assert_near(fbd_fit_get(asked.fit, 1).value, 4, 1e-9);
    assert_int_equal(fbd_fit_summary(asked.fit).values, 4);
    end(&asked);
}

/* Only F/m counts. */
static void parameters_that_data_do_not_determine_are_named(void **unused)
{
    (void)unused;
    static const char *const all[] = {"v0", "F", "m"};
    char data[1000];
    write_data(data, sizeof data, NULL);
    struct asked asked = ask(data, &(fbd_fit_plan){.parameters = all, .parameter_count = 3});
    assert_non_null(asked.fit);
    assert_int_equal(fbd_errors_count(asked.errors), 1);
    assert_string_equal(fbd_errors_get(asked.errors, 0).id, "not-determined");
    assert_non_null(strstr(fbd_errors_get(asked.errors, 0).message, "`F`, `m`"));
    assert_true(isfinite(fbd_fit_get(asked.fit, 0).error));
    assert_true(isinf(fbd_fit_get(asked.fit, 1).error) && isinf(fbd_fit_get(asked.fit, 2).error));
    assert_true(isnan(fbd_fit_correlation(asked.fit, 1, 2)));
    end(&asked);
    asked = ask(data, &(fbd_fit_plan){0}); /* all of the file: the same three */
    assert_int_equal(fbd_fit_count(asked.fit), 3);
    end(&asked);
}

static void without_degrees_of_freedom_errors_are_unknown(void **unused)
{
    (void)unused;
    struct asked asked = ask("t,block.x\n1,4\n2,10\n", NULL);
    assert_non_null(asked.fit);
    assert_near(fbd_fit_get(asked.fit, 0).value, 3, 1e-9);
    assert_near(fbd_fit_get(asked.fit, 1).value, 4, 1e-9);
    assert_true(isnan(fbd_fit_get(asked.fit, 0).error) && isnan(fbd_fit_summary(asked.fit).deviation));
    assert_int_equal(fbd_errors_count(asked.errors), 0);
    end(&asked);
}

static void assert_refused(const char *data, const fbd_fit_plan *plan, const char *id, int line, int column,
                           const char *words)
{
    struct asked asked = ask(data, plan);
    assert_null(asked.fit);
    const fbd_error error = fbd_errors_get(asked.errors, 0);
    if (!error.id || strcmp(error.id, id) != 0 || error.line != line || error.column != column ||
        !strstr(error.message, words))
        print_error("%d:%d: %s [%s]\n", error.line, error.column, error.message, error.id);
    assert_string_equal(error.id, id);
    assert_int_equal(error.line, line);
    assert_int_equal(error.column, column);
    assert_non_null(strstr(error.message, words));
    end(&asked);
}

static void wrong_data_are_refused_with_their_place(void **unused)
{
    (void)unused;
    assert_refused("", NULL, "bad-data", 1, 1, "not `t`");
    assert_refused("x,t\n", NULL, "bad-data", 1, 1, "not `t`");
    assert_refused("t\n1\n", NULL, "bad-data", 1, 0, "no column");
    assert_refused("t,block.q\n", NULL, "unknown-column", 1, 3, "block.q");
    assert_refused("t,block.x,t\n", NULL, "bad-data", 1, 11, "first column");
    assert_refused("t,block.x,block.x\n", NULL, "bad-data", 1, 11, "twice");
    assert_refused("t,block.x [kg]\n", NULL, "bad-data", 1, 3, "kg");
    assert_refused("t,block.x [qq]\n", NULL, "bad-data", 1, 3, "no unit");
    assert_refused("t,block.x +-\n", NULL, "bad-data", 1, 0, "missing");
    assert_refused("t,block.x,block.v\n", NULL, "bad-data", 1, 0, "another unit");
    assert_refused("t,block.x,block.v,block.x +-\n", NULL, "bad-data", 1, 0, "standard deviations");
    assert_refused("t,block.x\n1,2\n2,two\n", NULL, "bad-data", 3, 3, "`two` is no number");
    assert_refused("t,block.x\n1\n", NULL, "bad-data", 2, 1, "fewer cells");
    assert_refused("t,block.x\n1,2,3\n", NULL, "bad-data", 2, 3, "more cells");
    assert_refused("t,block.x\n1,2\n0.5,2\n", NULL, "bad-data", 3, 1, "before");
    assert_refused("t,block.x\n-1,2\n", NULL, "bad-data", 2, 1, "below 0");
    assert_refused("t,block.x\n,2\n", NULL, "bad-data", 2, 1, "missing");
    assert_refused("t,block.x,block.x +-\n1,2,0\n", NULL, "bad-data", 2, 5, "above 0");
    assert_refused("t,block.x\n1,2\n", NULL, "bad-data", 0, 0, "fewer values");
}

static int stop(void *context, const fbd_progress *progress)
{
    (void)context;
    return progress->written >= 3;
}

static void fits_that_cannot_be_made(void **unused)
{
    (void)unused;
    static const char *const names[] = {"v1"}, *const hole[] = {NULL}, *const mass[] = {"m"};
    const char data[] = "t,block.x\n1,2\n2,3\n3,4\n";
    assert_refused(data, &(fbd_fit_plan){.parameters = names, .parameter_count = 1}, "unknown-parameter", 0,
                   0, "`v1`");
    assert_refused(data, &(fbd_fit_plan){.parameters = hole, .parameter_count = 1}, "bad-call", 0, 0,
                   "missing");
    assert_refused(data, &(fbd_fit_plan){.progress = stop}, "stopped", 0, 0, "stopped");
    assert_refused(data, &(fbd_fit_plan){.run = &(fbd_options){.method = "euler"}}, "unknown-method", 0, 0,
                   "euler");
    struct asked asked = ask(data, &(fbd_fit_plan){.parameters = mass, .parameter_count = 1});
    assert_true(asked.fit || fbd_errors_failed_count(asked.errors) > 0); /* the mass tends to infinity */
    end(&asked);
    assert_int_equal(fbd_fit_count(NULL), 0);
    assert_null(fbd_fit_get(NULL, 0).name);
    assert_null(fbd_fit_text(NULL));
    assert_null(fbd_fit_gnuplot(NULL, NULL));
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_linear_model_has_the_errors_of_regression),
        cmocka_unit_test(given_deviations_weigh),
        cmocka_unit_test(exact_data_are_met),
        cmocka_unit_test(parameters_that_data_do_not_determine_are_named),
        cmocka_unit_test(without_degrees_of_freedom_errors_are_unknown),
        cmocka_unit_test(wrong_data_are_refused_with_their_place),
        cmocka_unit_test(fits_that_cannot_be_made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
