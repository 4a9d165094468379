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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_windows_turn_with_every_method),
        cmocka_unit_test(rows_of_windows_turn_at_every_tolerance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
