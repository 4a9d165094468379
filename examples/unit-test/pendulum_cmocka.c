/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The same derivation by cmocka, as a table: at each state every term of the equation.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <fbd_test.h>

static void each_term_is_that_of_the_diagram(void **unused)
{
    (void)unused;
    const double I_O = 0.5 / 3 + 2, pi = 3.14159265358979323846;
    const fbd_expected table[] = {
        {.at = {{"theta", 0}, {"omega", 2}},
         .coordinate = "theta",
         .inertia = I_O,
         .terms = {{"damper", -0.2}},
         .acceleration = -0.2 / I_O},
        {.at = {{"theta", pi / 2}, {"omega", 0}},
         .coordinate = "theta",
         .inertia = I_O,
         .terms = {{"gravity", -2.25 * 9.81}},
         .acceleration = -2.25 * 9.81 / I_O},
        {.at = {{"theta", -pi / 6}, {"omega", -1}},
         .coordinate = "theta",
         .inertia = I_O,
         .terms = {{"gravity", 2.25 * 9.81 / 2}, {"damper", 0.1}},
         .acceleration = (2.25 * 9.81 / 2 + 0.1) / I_O},
    };
    assert_true(fbd_check_table("pendulum.yaml", table, sizeof table / sizeof *table));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_term_is_that_of_the_diagram)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
