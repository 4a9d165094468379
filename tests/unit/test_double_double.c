/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Twofold numbers and moments: sums and products keep what a double loses of them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>

#include "base/time_dd.h"
#include "random_numbers.h"

static void what_a_sum_loses_is_kept(void **unused)
{
    (void)unused;
    struct double_double s = dd_sum(1, 0x1p-60);
    assert_true(s.x == 1 && s.rest == 0x1p-60);
    s = dd_sum(0x1p-60, -1);
    assert_true(s.x == -1 && s.rest == 0x1p-60);
    s = dd_sum(1e308, 1e308);
    assert_true(isinf(s.x) && s.rest == 0);
}

/* (1 + a)(1 + b) = 1 + a + b + a b */
static void what_a_product_loses_is_kept(void **unused)
{
    (void)unused;
    struct double_double p = dd_product(1 + 0x1p-30, 1 + 0x1p-31);
    assert_true(p.x == 1 + 0x1p-30 + 0x1p-31 && p.rest == 0x1p-61);
    p = dd_product(1e200, 1e200);
    assert_true(isinf(p.x) && p.rest == 0);
}

/* Each undoes the other, to some eps^2 of the larger operand. */
static void operations_undo_each_other(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {1};
    for (int i = 0; i < 20000; i++) {
        struct double_double a =
            dd_sum(random_between(&numbers, -9, 9), random_between(&numbers, -1, 1) / 1e17);
        struct double_double b =
            dd_sum(random_between(&numbers, 1, 2), random_between(&numbers, -1, 1) / 1e17);
        const double most = 16 * DBL_EPSILON * DBL_EPSILON * (fabs(a.x) + fabs(b.x));
        struct double_double sum = dd_subtract(dd_add(a, b), b);
        struct double_double product = dd_divide(dd_multiply(a, b), b);
        assert_true(fabs(dd_value(dd_subtract(sum, a))) <= most);
        assert_true(fabs(dd_value(dd_subtract(product, a))) <= most);
    }
}

/* Steps that a double does not see at all. */
static void a_moment_keeps_its_digits(void **unused)
{
    (void)unused;
    const double start = 1e6, step = 0x1p-60;
    struct time_dd t = time_dd_at(start);
    for (int i = 0; i < 1000; i++) t = time_dd_after(t, step);
    assert_true(t.t == start && time_dd_since(t, time_dd_at(start)) == 1000 * step);
    assert_true(time_dd_since(time_dd_at(start), t) == -1000 * step);
    assert_true(time_dd_equal(time_dd_earlier(t, time_dd_at(start)), time_dd_at(start)));
    assert_true(time_dd_since(time_dd_at(3), time_dd_at(1)) == 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_sum_loses_is_kept),
        cmocka_unit_test(what_a_product_loses_is_kept),
        cmocka_unit_test(operations_undo_each_other),
        cmocka_unit_test(a_moment_keeps_its_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
