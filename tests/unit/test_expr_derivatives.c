/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivatives of expressions against closed forms and against differences.
 *
 * The closed forms are expressions themselves, evaluated plainly: test_expr.c holds those against the C
 * library.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after its prerequisites */
#include <cmocka.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/expr.h"
#include "random_numbers.h"

enum { slot_p = 1, slot_q = 2, points = 200 };

static const unsigned seed = 417;

/* Only t, p and q exist, all pure numbers. */
static struct symbol lookup(void *context, const char *name, struct pos at)
{
    (void)context, (void)at;
    int slot = strcmp(name, "p") == 0   ? slot_p
               : strcmp(name, "q") == 0 ? slot_q
               : strcmp(name, "t") == 0 ? 0
                                        : -1;
    if (slot < 0) return (struct symbol){.kind = symbol_unknown};
    return (struct symbol){.kind = symbol_variable, .dim = DIM_NONE, .slot = slot};
}

static const struct expr *compile(struct arena *arena, const char *text)
{
    struct scope scope = {.lookup = lookup, .units = unit_si};
    struct expr_want want = {.any_dim = true, .what = "value"};
    fbd_errors *errors = fbd_errors_new();
    const struct expr *expr = expr_compile(arena, text, (struct pos){1, 1}, &scope, &want, errors);
    if (!expr) {
        fbd_errors_print(errors, stdout);
        fail_msg("`%s` does not compile", text);
    }
    fbd_errors_free(errors);
    return expr;
}

/* Equal up to `tolerance`, relative to the larger of 1 and the wanted value. */
static void expect(const char *text, const char *what, const double *y, double got, double wanted,
                   double tolerance)
{
    double allowed = tolerance * fmax(1, fabs(wanted));
    if (!(fabs(got - wanted) <= allowed))
        fail_msg(
            "seed %u: %s of `%s` at p = %.17g, q = %.17g: got %.17g, wanted %.17g, %.2g of what is allowed",
            seed, what, text, y[0], y[1], got, wanted, fabs(got - wanted) / allowed);
}

/* ---- closed forms */

struct row {
    const char *f, *p, *q, *pp, *pq, *qq; /* NULL is 0 */
    double low, high;                     /* p and q are drawn from here */
};

static const struct row rows[] = {
    {"p + q", "1", "1", NULL, NULL, NULL, -5, 5},
    {"p - q", "1", "-1", NULL, NULL, NULL, -5, 5},
    {"-p", "-1", NULL, NULL, NULL, NULL, -5, 5},
    {"p*q", "q", "p", NULL, "1", NULL, -5, 5},
    {"p*p", "2*p", NULL, "2", NULL, NULL, -5, 5},
    {"p/q", "1/q", "-p/q^2", NULL, "-1/q^2", "2*p/q^3", 0.5, 5},
    {"p^2", "2*p", NULL, "2", NULL, NULL, -5, 5},
    {"p^3", "3*p^2", NULL, "6*p", NULL, NULL, -5, 5},
    {"p^7", "7*p^6", NULL, "42*p^5", NULL, NULL, -2, 2},
    {"p^-2", "-2/(p*p*p)", NULL, "6/(p*p*p*p)", NULL, NULL, 0.5, 5},
    {"p^1", "1", NULL, NULL, NULL, NULL, -5, 5},
    {"p^0", NULL, NULL, NULL, NULL, NULL, -5, 5},
    {"p^2.5", "2.5*p*sqrt(p)", NULL, "3.75*sqrt(p)", NULL, NULL, 0.1, 5},
    {"p^q", "q*p^(q - 1)", "p^q*ln(p)", "q*(q - 1)*p^(q - 2)", "p^(q - 1)*(1 + q*ln(p))", "p^q*ln(p)*ln(p)",
     0.5, 3},
    {"p^p", "p^p*(1 + ln(p))", NULL, "p^p*((1 + ln(p))^2 + 1/p)", NULL, NULL, 0.2, 3},
    {"sqrt(p)", "0.5/sqrt(p)", NULL, "-0.25/(p*sqrt(p))", NULL, NULL, 0.1, 5},
    {"cbrt(p)", "cbrt(p)/(3*p)", NULL, "-2*cbrt(p)/(9*p*p)", NULL, NULL, -5, -0.1},
    {"exp(p)", "exp(p)", NULL, "exp(p)", NULL, NULL, -3, 3},
    {"ln(p)", "1/p", NULL, "-1/p^2", NULL, NULL, 0.1, 5},
    {"log(p)", "1/p", NULL, "-1/p^2", NULL, NULL, 0.1, 5},
    {"log10(p)", "1/(p*ln(10))", NULL, "-1/(p^2*ln(10))", NULL, NULL, 0.1, 5},
    {"sin(p)", "cos(p)", NULL, "-sin(p)", NULL, NULL, -9, 9},
    {"cos(p)", "-sin(p)", NULL, "-cos(p)", NULL, NULL, -9, 9},
    {"tan(p)", "1/cos(p)^2", NULL, "2*sin(p)/cos(p)^3", NULL, NULL, -1.4, 1.4},
    {"asin(p)", "1/sqrt(1 - p^2)", NULL, "p/(1 - p^2)^1.5", NULL, NULL, -0.9, 0.9},
    {"acos(p)", "-1/sqrt(1 - p^2)", NULL, "-p/(1 - p^2)^1.5", NULL, NULL, -0.9, 0.9},
    {"atan(p)", "1/(1 + p^2)", NULL, "-2*p/(1 + p^2)^2", NULL, NULL, -5, 5},
    {"atan2(p, q)", "q/(p^2 + q^2)", "-p/(p^2 + q^2)", "-2*p*q/(p^2 + q^2)^2", "(p^2 - q^2)/(p^2 + q^2)^2",
     "2*p*q/(p^2 + q^2)^2", -5, 5},
    {"sinh(p)", "cosh(p)", NULL, "sinh(p)", NULL, NULL, -3, 3},
    {"cosh(p)", "sinh(p)", NULL, "cosh(p)", NULL, NULL, -3, 3},
    {"tanh(p)", "1/cosh(p)^2", NULL, "-2*tanh(p)/cosh(p)^2", NULL, NULL, -3, 3},
    {"hypot(p, q)", "p/hypot(p, q)", "q/hypot(p, q)", "q^2/hypot(p, q)^3", "-p*q/hypot(p, q)^3",
     "p^2/hypot(p, q)^3", 0.1, 5},
    {"abs(p)", "sign(p)", NULL, NULL, NULL, NULL, -5, 5},
    {"min(p, q)", "if(p < q, 1, 0)", "if(p < q, 0, 1)", NULL, NULL, NULL, -5, 5},
    {"max(p, q)", "if(p > q, 1, 0)", "if(p > q, 0, 1)", NULL, NULL, NULL, -5, 5},
    {"clamp(p, -1, q)", "if(p > -1 and max(p, -1) < q, 1, 0)", "if(max(p, -1) < q, 0, 1)", NULL, NULL, NULL,
     -5, 5},
    {"mod(p, q)", "1", "-floor(p/q)", NULL, NULL, NULL, 0.3, 5},
    {"sawtooth(p)", "1", NULL, NULL, NULL, NULL, -5, 5},
    {"floor(p) + ceil(p) + round(p) + sign(p) + step(p) + square(p)", NULL, NULL, NULL, NULL, NULL, -5, 5},
    {"pulse(p, -1, 2)*p^2", "pulse(p, -1, 2)*2*p", NULL, "pulse(p, -1, 2)*2", NULL, NULL, -5, 5},
    {"if(p < q and not p < -q, p^2, q^3)", "if(p < q and p >= -q, 2*p, 0)", "if(p < q and p >= -q, 0, 3*q^2)",
     "if(p < q and p >= -q, 2, 0)", NULL, "if(p < q and p >= -q, 0, 6*q)", -5, 5},
    {"sin(p*q)*exp(-p)", "exp(-p)*(q*cos(p*q) - sin(p*q))", "exp(-p)*p*cos(p*q)",
     "exp(-p)*(sin(p*q) - 2*q*cos(p*q) - q^2*sin(p*q))", "exp(-p)*((1 - p)*cos(p*q) - p*q*sin(p*q))",
     "-exp(-p)*p^2*sin(p*q)", -2, 2},
};

static double plain(const char *text, const double *y)
{
    if (!text) return 0;
    struct arena arena = {0};
    double value = expr_eval(compile(&arena, text), 0, y, NULL);
    arena_free(&arena);
    return value;
}

/* Closed form and chain rule differ by the rounding of a handful of operations on numbers up to a few
 * hundred, whose cancellation (as in 1 - p^2) costs one more digit. */
static const double by_rounding = 200 * DBL_EPSILON;

static void check_row(const struct row *row, const struct expr *f, const double *y,
                      struct random_numbers *numbers)
{
    double dp = NAN, dq = NAN, dpq = NAN, unused, along = NAN;
    double value = plain(row->f, y), p = plain(row->p, y), q = plain(row->q, y), dy[2];
    for (int i = 0; i < 2; i++) dy[i] = random_between(numbers, -2, 2);

    expect(row->f, "value", y, expr_eval_along(f, 0, y, 0, dy, NULL, &along), value, by_rounding);
    expect(row->f, "d/ds", y, along, p * dy[0] + q * dy[1], by_rounding);
    expect(row->f, "value", y, expr_eval_slot(f, 0, y, slot_p, NULL, &dp), value, by_rounding);
    expect(row->f, "d/dp", y, dp, p, by_rounding);
    expr_eval_slot(f, 0, y, slot_q, NULL, &dq);
    expect(row->f, "d/dq", y, dq, q, by_rounding);

    expect(row->f, "value", y, expr_eval_second(f, 0, y, slot_p, slot_q, NULL, &dp, &dq, &dpq), value,
           by_rounding);
    expect(row->f, "d/dp", y, dp, p, by_rounding);
    expect(row->f, "d/dq", y, dq, q, by_rounding);
    expect(row->f, "d2/dpdq", y, dpq, plain(row->pq, y), by_rounding);
    expr_eval_second(f, 0, y, slot_p, slot_p, NULL, &dp, &unused, &dpq);
    expect(row->f, "d2/dp2", y, dpq, plain(row->pp, y), by_rounding);
    expr_eval_second(f, 0, y, slot_q, slot_q, NULL, &unused, &dq, &dpq);
    expect(row->f, "d2/dq2", y, dpq, plain(row->qq, y), by_rounding);
}

static void derivatives_agree_with_closed_forms(void **state)
{
    (void)state;
    struct random_numbers numbers = {seed};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct arena arena = {0};
        const struct expr *f = compile(&arena, rows[i].f);
        for (int k = 0; k < points; k++) {
            double y[2];
            for (int j = 0; j < 2; j++) y[j] = random_between(&numbers, rows[i].low, rows[i].high);
            check_row(&rows[i], f, y, &numbers);
        }
        arena_free(&arena);
    }
}

/* ---- differences */

static const char *const laws[] = {
    "-200*p - 3*p^3 - 0.7*q*abs(q)",
    "10*sin(3*t + p)*exp(-q/4) + cosh(p)/(1 + q^2)",
    "sqrt(1 + p^2 + q^2)*atan2(p + 3, q + 4)",
    "(p - q)*(p + q)/(2 + p*q/9)^2",
    "hypot(p - 5, q)^1.3 + ln(9 + p)*tanh(q) - mod(t + p/100, 7)",
    "if(sin(p) + 9 > cos(q), (1 + t*p)^3 - q^2, p/q)",
    "max(p - 20, q*p, p^2 - 40)*clamp(q/9, -2, 2)",
    "asin(p/9) - acos(q/9)*atan(p*q) + log10(p + 6)*cbrt(q + 7) + (p + 4)^(q/3)",
};

/* Central differences err by h^2 |f'''|/6 and by rounding, about 1e-16 |f|/h; with h = 1e-5, |f| up to 1000
 * and |f'''| up to 100 that is 1e-8. The second ones are differences of exact first derivatives and no worse.
 */
static const double step_of_difference = 1e-5, by_difference = 1e-7;

static void derivatives_agree_with_central_differences(void **state)
{
    (void)state;
    struct random_numbers numbers = {seed};
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
        struct arena arena = {0};
        const struct expr *f = compile(&arena, laws[i]);
        for (int k = 0; k < points; k++) {
            const double h = step_of_difference, t = random_between(&numbers, 0, 2);
            double y[2] = {random_between(&numbers, -3, 3), random_between(&numbers, 0.5, 3)},
                   dt = random_between(&numbers, -1, 1), dy[2], up[2], down[2];
            double slope = NAN, before = NAN, after = NAN, p, q, pq = NAN;
            for (int j = 0; j < 2; j++) {
                dy[j] = random_between(&numbers, -1, 1);
                up[j] = y[j] + h * dy[j];
                down[j] = y[j] - h * dy[j];
            }
            expr_eval_along(f, t, y, dt, dy, NULL, &slope);
            double ahead = expr_eval(f, t + h * dt, up, NULL), behind = expr_eval(f, t - h * dt, down, NULL);
            expect(laws[i], "d/ds", y, slope, (ahead - behind) / (2 * h), by_difference);

            expr_eval_second(f, t, y, slot_p, slot_q, NULL, &p, &q, &pq);
            expr_eval_slot(f, t, (double[]){y[0], y[1] + h}, slot_p, NULL, &after);
            expr_eval_slot(f, t, (double[]){y[0], y[1] - h}, slot_p, NULL, &before);
            expect(laws[i], "d2/dpdq", y, pq, (after - before) / (2 * h), by_difference);
        }
        arena_free(&arena);
    }
}

static void time_is_slot_zero(void **state)
{
    (void)state;
    struct arena arena = {0};
    const struct expr *f = compile(&arena, "p*t^3");
    double y[2] = {5, 0}, d = NAN, a = NAN, b = NAN, ab = NAN;
    expr_eval_slot(f, 2, y, 0, NULL, &d);
    assert_true(d == 60);
    expr_eval_along(f, 2, y, 1, NULL, NULL, &d);
    assert_true(d == 60);
    expr_eval_second(f, 2, y, 0, 0, NULL, &a, &b, &ab);
    assert_true(a == 60 && b == 60 && ab == 60);
    expr_eval_second(f, 2, y, slot_p, 0, NULL, &a, &b, &ab);
    assert_true(a == 8 && b == 60 && ab == 12);
    arena_free(&arena);
}

/* ---- where formulas have holes that functions do not have */

static void derivatives_exist_where_the_function_has_them(void **state)
{
    (void)state;
    const struct {
        const char *text;
        double p, q, dp, dpp;
    } cases[] = {
        {"p^2", 0, 0, 0, 2},
        {"p^3", 0, 0, 0, 0},
        {"p^1", 0, 0, 1, 0},
        {"p^2*q^0", 0, 0, 0, 2},
        {"p^0 + p", 0, 0, 1, 0},
        {"p^2.5", 0, 0, 0, 0},
        {"p^q", 0, 2, 0, 2},
        {"p^q", 0, 1, 1, 0},
        {"p^q", -2, 3, 12, -12},
        {"p*sqrt(q)", 3, 0, 0, 0},
        {"p + sqrt(q)", 3, 0, 1, 0},
        {"p + asin(q)", 3, 1, 1, 0},
        {"p*abs(p)", 0, 0, 0, 0},
        {"hypot(p, q)", 0, 0, 0, 0},
        {"min(p, q + sqrt(p - 3))", 3, 4, 1, 0},
        {"p*sqrt(p)", 0, 0, 0, INFINITY},
        {"if(p < 1, p^2, sqrt(p - 9))", 0.5, 0, 1, 2},
        {"tanh(p)", 800, 0, 0, 0},
        {"p/(1 + p^2)", 0, 0, 1, 0},
        {"1e5/cosh(1e6*p)^2", -354.9e-6, 0, 0, 0},
        {"p^4/4 - p^2/2", 0, 0, 0, -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        const struct expr *f = compile(&arena, cases[i].text);
        double y[2] = {cases[i].p, cases[i].q}, d = NAN, a = NAN, b, ab = NAN;
        expr_eval_slot(f, 0, y, slot_p, NULL, &d);
        expr_eval_second(f, 0, y, slot_p, slot_p, NULL, &a, &b, &ab);
        if (d != cases[i].dp || a != cases[i].dp || ab != cases[i].dpp)
            fail_msg("`%s` at p = %g, q = %g: d/dp = %.17g and %.17g, d2/dp2 = %.17g", cases[i].text, y[0],
                     y[1], d, a, ab);
        arena_free(&arena);
    }
}

static void mixed_derivatives_of_a_power_have_their_limits_at_zero(void **state)
{
    (void)state;
    struct arena arena = {0};
    const struct expr *f = compile(&arena, "p^q");
    double y[2] = {0, 1.5}, p, q, pq = NAN;
    expr_eval_second(f, 0, y, slot_p, slot_q, NULL, &p, &q, &pq);
    assert_true(p == 0 && q == 0 && pq == 0);
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_agree_with_closed_forms),
        cmocka_unit_test(derivatives_agree_with_central_differences),
        cmocka_unit_test(time_is_slot_zero),
        cmocka_unit_test(derivatives_exist_where_the_function_has_them),
        cmocka_unit_test(mixed_derivatives_of_a_power_have_their_limits_at_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
