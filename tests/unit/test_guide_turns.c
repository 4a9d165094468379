/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A bead slips along a driven table: its guide presses with N = m (2 omega v + alpha x - omega^2 d), which changes its side in
 * motion, and friction goes with |N|. Random tables, by methods of any order and at loose tolerances, against small steps of
 * the classical Runge-Kutta method.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

#include <stdio.h>

/* The table turns by theta = A t + B sin(w t); its slot is at a distance d from the pivot. */
struct table {
    double A, B, w, d, mu, until, x, v;
};

static double omega(const struct table *table, double t)
{
    return table->A + table->B * table->w * cos(table->w * t);
}

static double press(const struct table *table, double t, double x, double v)
{
    double o = omega(table, t), alpha = -table->B * table->w * table->w * sin(table->w * t);
    return 2 * o * v + alpha * x - o * o * table->d;
}

/* Of what slips outwards. */
static double acceleration(const struct table *table, double t, double x, double v)
{
    double o = omega(table, t), alpha = -table->B * table->w * table->w * sin(table->w * t);
    return o * o * x + alpha * table->d - table->mu * fabs(press(table, t, x, v));
}

/* The state at the end; how often N has changed its side, -1 where it comes near to a stop. */
static int follow(const struct table *table, double *x, double *v)
{
    enum { steps = 20000 };
    const double h = table->until / steps;
    int turns = 0;
    *x = table->x;
    *v = table->v;
    for (int i = 0; i < steps; i++) {
        double t = h * i, X = *x, V = *v, N = press(table, t, X, V);
        double a1 = acceleration(table, t, X, V);
        double v2 = V + h / 2 * a1, a2 = acceleration(table, t + h / 2, X + h / 2 * V, v2);
        double v3 = V + h / 2 * a2, a3 = acceleration(table, t + h / 2, X + h / 2 * v2, v3);
        double v4 = V + h * a3, a4 = acceleration(table, t + h, X + h * v3, v4);
        *x += h / 6 * (V + 2 * v2 + 2 * v3 + v4);
        *v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        turns += N * press(table, t + h, *x, *v) < 0;
        if (*v < 0.1) return -1;
    }
    return turns;
}

static struct table draw_table(struct random_numbers *numbers)
{
    struct table table = {.A = random_between(numbers, -2, 2), .B = random_between(numbers, 0.3, 1)};
    table.w = random_between(numbers, 2, 6);
    table.d = random_perhaps(numbers, 0.5, -0.5, 0.5);
    table.mu = random_between(numbers, 0.05, 0.5);
    table.until = random_between(numbers, 0.5, 1.5);
    table.x = random_between(numbers, 0.1, 0.5);
    table.v = random_between(numbers, 0.3, 1);
    return table;
}

static void check_table(struct checks *checks, const struct table *table, double x, double v)
{
    static const char *const methods[] = {"msadams", "msbdf", "rk4", "rkf45", "auto"};
    static const double tolerances[] = {1e-4, 1e-6, 1e-9};
    const double errors = 3e4; /* of a step: those of msbdf add up */
    char text[1000];
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: 0\nbodies:\n"
             "  table: {mass: 1, inertia: 1, motion: {pivot: {theta: \"%.17g[rad/s]*t + "
             "%.17g[rad]*sin(%.17g[rad/s]*t)\"}}}\n"
             "  bead: {mass: 1, motion: {slide: {on: table, through: [0, %.17g]}}, initial: {x: %.17g, v: "
             "%.17g},\n"
             "         forces: [normal: {two_sided: true}, friction: %.17g]}\n"
             "simulate: {until: %.17g}\n",
             table->A, table->B, table->w, table->d, table->x, table->v, table->mu, table->until);
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
            fbd_options options = FBD_OPTIONS_DEFAULT;
            options.method = methods[k];
            options.tolerance = tolerances[i];
            struct trial trial = trial_parse(text);
            const size_t failed = checks->failed;
            const double most = errors * tolerances[i] * (1 + fabs(x) + fabs(v));
            trial_start(&trial, &options);
            trial_finish(&trial);
            check_that(checks, methods[k], trial.outcome == FBD_DONE);
            check_close(checks, "x", trial_get(&trial, "bead.x"), x, fmin(most, 0.05));
            check_close(checks, "v", trial_get(&trial, "bead.v"), v, fmin(most, 0.2));
            if (checks->failed > failed)
                print_message("# %s at %g: %s\n%s", methods[k], tolerances[i],
                              fbd_simulation_reason(trial.simulation), text);
            trial_close(&trial);
        }
    }
}

static void a_guide_turns_where_its_force_is_zero(void **unused)
{
    (void)unused;
    enum { seed = 1015 };
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int left = draws_of(40); left > 0 && !checks.failed;) {
        double x, v;
        const struct table table = draw_table(&numbers);
        if (follow(&table, &x, &v) < 1) continue;
        check_table(&checks, &table, x, v);
        left--;
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_guide_turns_where_its_force_is_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
