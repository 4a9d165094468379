/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random rows of blocks, each joined to the one before (the first to the ground) by a spring, linear or stiffening, and by
 * a damper with the square of the speed, w*abs(w); one end is pulled, and all start from rest.
 *
 * What makes it hard: the far blocks start as high powers of the time, so the signs of their relative speeds are those of
 * roundings at first, and of the polynomials that follow a step. Each looked like a switch that is passed: rows of four
 * and more took steps of 1e-21 s or ended with "events chatter".
 *
 * Reference: the equations of motion by hand, integrated by GSL's rk8pd; once more with a larger tolerance, which tells
 * how much such a row magnifies errors.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "hard.h"
#include "random_numbers.h"

enum { most_blocks = 8 };

struct row {
    int count, pulled;
    double mass[most_blocks], stiffness[most_blocks], linear[most_blocks], damping[most_blocks];
    int power[most_blocks]; /* of the spring beside the linear one */
    double force, until;
};

static struct row random_row(struct random_numbers *numbers)
{
    struct row row = {.count = (int)random_between(numbers, 2, most_blocks + 1)};
    row.pulled = random_between(numbers, 0, 1) < 0.2 ? 0 : row.count - 1;
    for (int i = 0; i < row.count; i++) {
        row.mass[i] = pow(10, random_between(numbers, -1, 2));
        row.power[i] = random_between(numbers, 0, 1) < 0.7 ? 3 : 5;
        row.stiffness[i] = pow(10, random_between(numbers, 1, 6));
        double linear = random_perhaps(numbers, 0.5, 0, 4), damping = random_perhaps(numbers, 0.8, -2, 1);
        if (linear != 0) row.linear[i] = pow(10, linear);
        if (damping != 0) row.damping[i] = pow(10, damping);
    }
    row.force = pow(10, random_between(numbers, -1, 3));
    row.until = random_between(numbers, 0.3, 2);
    return row;
}

static double stretch_force(const struct row *row, int i, double d, double w)
{
    return row->stiffness[i] * pow(d, row->power[i]) + row->linear[i] * d + row->damping[i] * w * fabs(w);
}

static int slopes_by_hand(double t, const double *y, double *f, void *context)
{
    const struct row *row = context;
    const double *x = y, *v = y + row->count;
    double *a = f + row->count, behind = 0;
    (void)t;
    for (int i = row->count - 1; i >= 0; i--) {
        double pull = stretch_force(row, i, x[i] - (i > 0 ? x[i - 1] : 0), v[i] - (i > 0 ? v[i - 1] : 0));
        a[i] = (behind - pull + (i == row->pulled ? row->force : 0)) / row->mass[i];
        behind = pull;
        f[i] = v[i];
    }
    return GSL_SUCCESS;
}

/* The end by hand, and the largest speed on the way. */
static double end_by_hand(const struct row *row, double tolerance, double *y)
{
    enum { looks = 200 };
    size_t size = 2 * (size_t)row->count;
    double t = 0, fastest = 0;
    gsl_odeiv2_system system = {slopes_by_hand, NULL, size, (void *)row};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-9, 1e-20, tolerance);
    for (size_t i = 0; i < size; i++) y[i] = 0;
    for (int look = 1; look <= looks; look++) {
        assert_int_equal(gsl_odeiv2_driver_apply(driver, &t, row->until * look / looks, y), GSL_SUCCESS);
        for (int i = 0; i < row->count; i++) fastest = fmax(fastest, fabs(y[row->count + i]));
    }
    gsl_odeiv2_driver_free(driver);
    return fastest;
}

static void write_stretch(const struct row *row, int i, const char *sign, char *text, size_t size)
{
    char d[40] = "b0.x", w[40] = "b0.v";
    if (i > 0) snprintf(d, sizeof d, "(b%d.x - b%d.x)", i, i - 1);
    if (i > 0) snprintf(w, sizeof w, "(b%d.v - b%d.v)", i, i - 1);
    snprintf(text, size, "%s(%.17g[N/m^%d]*%s^%d + %.17g[N/m]*%s + %.17g[N*s^2/m^2]*%s*abs(%s))", sign,
             row->stiffness[i], row->power[i], d, row->power[i], row->linear[i], d, row->damping[i], w, w);
}

static struct trial trial_of(const struct row *row)
{
    char text[12000], own[400], next[400], pull[60];
    size_t at =
        (size_t)snprintf(text, sizeof text, "fbd: 1\nsimulate: {until: %.17g}\nbodies:\n", row->until);
    for (int i = 0; i < row->count; i++) {
        write_stretch(row, i, "-", own, sizeof own);
        next[0] = pull[0] = '\0';
        if (i + 1 < row->count) write_stretch(row, i + 1, " + ", next, sizeof next);
        if (i == row->pulled) snprintf(pull, sizeof pull, " + %.17g[N]", row->force);
        at += (size_t)snprintf(
            text + at, sizeof text - at,
            "  b%d: {mass: %.17g, motion: slide, forces: [applied: {name: f%d, value: \"%s%s%s\"}]}\n", i,
            row->mass[i], i, own, next, pull);
    }
    return trial_parse(text);
}

/* Of the speeds, over the largest on the way. */
static double error_of(const struct row *row, const double *y, const double *other, double fastest)
{
    double worst = 0;
    for (int i = row->count; i < 2 * row->count; i++) worst = fmax(worst, fabs(y[i] - other[i]) / fastest);
    return worst;
}

static void the_far_blocks_wait(void **unused)
{
    (void)unused;
    const double most = 20, loose = 1e-10, tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10};
    struct checks checks = {0};
    int first = number_of("FBD_ROWS_SEED", 1), many = number_of("FBD_ROWS", draws_of(20));
    for (int seed = first; seed < first + many; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct row row = random_row(&numbers);
        double right[2 * most_blocks], rough[2 * most_blocks], now[2 * most_blocks];
        double fastest = end_by_hand(&row, 1e-14, right);
        end_by_hand(&row, loose, rough);
        double magnified = error_of(&row, rough, right, fastest) / loose;
        for (size_t k = 0; k < sizeof tolerances / sizeof *tolerances; k++) {
            struct trial trial = trial_of(&row);
            hard_start(&trial, &(struct hard_method){.tolerance = tolerances[k]}, NAN);
            char name[60];
            snprintf(name, sizeof name, "seed %d, %d blocks", seed, row.count);
            if (hard_done(&checks, &trial)) {
                for (int i = 0; i < row.count; i++) {
                    char speed[20];
                    snprintf(speed, sizeof speed, "b%d.v", i);
                    now[row.count + i] = trial_get(&trial, speed);
                }
                hard_case(&checks, &trial, name, error_of(&row, now, right, fastest),
                          most * tolerances[k] * fmax(1, magnified));
            }
            trial_close(&trial);
        }
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_far_blocks_wait),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
