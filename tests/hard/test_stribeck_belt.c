/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Stick-slip on a belt with friction that falls with the slip s (Stribeck), over 25 cycles.
 *
 * Reference: with x the coordinate and s = v_b - v, while it slips
 *
 *     x' = v_b - s,   s' = k x/m - g (mu_d + (mu_s - mu_d) e),   e' = -e s'/v_s,   e = exp(-s/v_s)
 *
 * so that the Taylor coefficients follow from those before. In long double, to degree 30 in pieces of a
 * hundredth of the period, this is good to 1e-17. It begins at x = mu_s m g/k with s = s' = 0 and ends where
 * s is zero again; the stick that follows lasts for the way back to mu_s m g/k at v_b.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"
#include "random_numbers.h"

enum { cycles = 25, degree = 30 };

struct belt {
    double k, mu_s, mu_d, v_s, v_b;
};

struct series {
    long double x[degree + 1], s[degree + 1];
};

static struct series expand(const struct belt *belt, long double x, long double s)
{
    const long double g = 9.81L;
    struct series series = {.x = {x}, .s = {s}};
    long double e[degree + 1] = {expl(-s / (long double)belt->v_s)};
    for (int j = 0; j < degree; j++) {
        long double mu =
            (j == 0 ? (long double)belt->mu_d : 0) + (long double)(belt->mu_s - belt->mu_d) * e[j];
        series.x[j + 1] = ((j == 0 ? (long double)belt->v_b : 0) - series.s[j]) / (j + 1);
        series.s[j + 1] = ((long double)belt->k * series.x[j] - g * mu) / (j + 1);
        long double sum = 0;
        for (int i = 0; i <= j; i++) sum += e[j - i] * (long double)(i + 1) * series.s[i + 1];
        e[j + 1] = -sum / (long double)belt->v_s / (j + 1);
    }
    return series;
}

static long double value(const long double *c, long double t)
{
    long double sum = 0;
    for (int j = degree; j >= 0; j--) sum = sum * t + c[j];
    return sum;
}

/* How long a slip lasts from the breakaway, and the coordinate at its end. */
static double slip_time(const struct belt *belt, double *end)
{
    const long double g = 9.81L, h = 0.01L / sqrtl((long double)belt->k) * 6.283185307179586477L;
    long double x = (long double)belt->mu_s * g / (long double)belt->k, s = 0, t = 0;
    struct series series = expand(belt, x, s);
    while (value(series.s, h) > 0) {
        x = value(series.x, h);
        s = value(series.s, h);
        t += h;
        series = expand(belt, x, s);
    }
    long double low = 0, high = h;
    for (int i = 0; i < 80; i++) {
        long double middle = (low + high) / 2;
        *(value(series.s, middle) > 0 ? &low : &high) = middle;
    }
    *end = (double)value(series.x, low);
    return (double)(t + low);
}

/* The largest error of the breakaways and of the sticks that follow. */
static double worst_transition(const struct trial *trial, const struct belt *belt)
{
    double end, slip = slip_time(belt, &end), worst = 0;
    double breakaway = belt->mu_s * 9.81 / belt->k, period = slip + (breakaway - end) / belt->v_b;
    for (int n = 0; n < cycles; n++) {
        double t = breakaway / belt->v_b + n * period;
        double got = trial_event(trial, FBD_EVENT_BREAKAWAY, NULL, n);
        double sticks = trial_event(trial, FBD_EVENT_STICK, NULL, n);
        if (isnan(got) || isnan(sticks)) return HUGE_VAL;
        worst = fmax(worst, fmax(fabs(got - t), fabs(sticks - t - slip)));
    }
    return worst;
}

/* As with a constant coefficient (test_stick_slip_belt.c). The slope of the law drives the slip at its start,
 * but what errs there errs in proportion to the slip itself, and each stick forgets all of a slip but where
 * it ended. */
static void each_transition_of_each_method(void **unused)
{
    (void)unused;
    const struct belt belt = {100, 0.4, 0.25, 0.1, 0.2};
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/stribeck_belt.yaml", NULL);
        hard_start(&trial, &method, NAN);
        if (hard_done(&checks, &trial))
            hard_case(&checks, &trial, "Stribeck's law", worst_transition(&trial, &belt),
                      i == 0 ? 1e-9 : 0.6 * hard_promise(&trial));
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Other belts: soft and stiff springs, laws that fall within a tenth of the belt's speed or hardly at all. */
static void belts_drawn_at_random(void **unused)
{
    (void)unused;
    enum { seed = 1902 };
    const int draws = draws_of(12);
    static const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws; draw++) {
        struct belt belt = {.k = exp(random_between(&numbers, 2, 6)),
                            .mu_d = random_between(&numbers, 0.05, 0.4),
                            .v_b = random_between(&numbers, 0.05, 0.5)};
        belt.mu_s = belt.mu_d * random_between(&numbers, 1.1, 2);
        belt.v_s = random_between(&numbers, 0.3, 3) * (belt.mu_s - belt.mu_d) * 9.81 / sqrt(belt.k);
        char text[700];
        snprintf(text, sizeof text,
                 "fbd: 1\nparameters: {mu_s: %.17g, mu_d: %.17g, v_s: %.17g m/s, v_b: %.17g m/s}\nbodies:\n"
                 "  block:\n    mass: 1 kg\n    motion: slide\n    initial: {v: v_b}\n    forces:\n"
                 "      - gravity\n      - normal\n      - spring: {stiffness: %.17g N/m}\n"
                 "      - friction: {static: mu_s, kinetic: mu_d + (mu_s - mu_d)*exp(-slip/v_s),\n"
                 "          surface_speed: v_b}\nsimulate: {until: %.17g s}\n",
                 belt.mu_s, belt.mu_d, belt.v_s, belt.v_b, belt.k,
                 (cycles + 2) * (8 / sqrt(belt.k) + 4 * belt.mu_s * 9.81 / belt.k / belt.v_b));
        struct hard_method method = {NULL, tolerances[draw % 5], 8, false, false};
        struct trial trial = trial_parse(text);
        hard_start(&trial, &method, NAN);
        if (hard_done(&checks, &trial))
            hard_case(&checks, &trial, "a belt at random", worst_transition(&trial, &belt),
                      hard_promise(&trial) / sqrt(belt.k));
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_transition_of_each_method),
        cmocka_unit_test(belts_drawn_at_random),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
