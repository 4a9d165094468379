/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows of parallelograms that pass the line in which all rods lie (windows.h), with every method and at every
 * tolerance.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "random_numbers.h"
#include "windows.h"

static const struct row_of_windows rows[] = {
    {1, 1, 1, 0, 1, false},     {8, 1, 1, 0, 1, false}, {8, 1, 1, 0.3, 1, false}, {3, 0.5, 2, 0, 3, false},
    {4, 1, 0.7, 1.1, 8, false}, {2, 1, 1, 0, 1, true},  {3, 0.5, 2, 0, 3, true},
};

static void rows_of_windows_turn_with_every_method(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t r = 0; r < (thorough() ? sizeof rows / sizeof *rows : 1); r += 4)
        for (size_t i = 0; hard_method_at(i, &method); i++) windows_turn(&checks, &rows[r], &method);
    checks_end(&checks);
}

static void rows_of_windows_turn_at_every_tolerance(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const double tolerances[] = {1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++)
            if (thorough() || i == r % 3)
                windows_turn(&checks, &rows[r], &(struct hard_method){.tolerance = tolerances[i]});
    checks_end(&checks);
}

static double worst_speed(const struct row_of_windows *row, double tolerance, bool *done)
{
    char *text = windows_text(row);
    assert_non_null(text);
    struct trial trial = trial_parse(text);
    hard_start(&trial, &(struct hard_method){.tolerance = tolerance}, NAN);
    *done = hard_finish(&trial) == FBD_DONE;
    double off = windows_speed_off(&trial, row);
    trial_close(&trial);
    free(text);
    return off;
}

/* A tolerance of 1e-14 had rows drift from their pins, and 12 windows fall apart. */
static void tighter_is_no_worse(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const double tolerances[] = {1e-8, 1e-10, 1e-12, 1e-13, 1e-14}, least = 2e-9;
    int first = number_of("FBD_WINDOWS_SEED", 1), many = number_of("FBD_WINDOWS", draws_of(12));
    for (int seed = first; seed < first + many; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct row_of_windows row = {.windows = 1 + (int)random_between(&numbers, 0, 14),
                                     .a = random_between(&numbers, 0.5, 2),
                                     .L = random_between(&numbers, 0.5, 2),
                                     .phi = random_perhaps(&numbers, 0.5, -1.5, 1.5),
                                     .omega = random_between(&numbers, 1, 8)};
        double best = HUGE_VAL;
        for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
            bool done;
            double off = worst_speed(&row, tolerances[i], &done), most = fmax(3 * best, least);
            printf("# seed %d, %d windows at %g: speed off by %.1e\n", seed, row.windows, tolerances[i], off);
            check_that(&checks, "it goes round to the end", done);
            check_that(&checks, "no worse than at a larger tolerance", off <= most);
            check_that(&checks, "no floor of accuracy", tolerances[i] > 1e-11 || off <= 5e-10);
            best = fmin(best, off);
        }
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_windows_turn_with_every_method),
        cmocka_unit_test(rows_of_windows_turn_at_every_tolerance),
        cmocka_unit_test(tighter_is_no_worse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
