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

#include "base/moment.h"
#include "random_numbers.h"

static void what_a_sum_loses_is_kept(void **unused)
{
    (void)unused;
    struct twofold s = twofold_sum(1, 0x1p-60);
    assert_true(s.x == 1 && s.rest == 0x1p-60);
    s = twofold_sum(0x1p-60, -1);
    assert_true(s.x == -1 && s.rest == 0x1p-60);
    s = twofold_sum(1e308, 1e308);
    assert_true(isinf(s.x) && s.rest == 0);
}

/* (1 + a)(1 + b) = 1 + a + b + a b */
static void what_a_product_loses_is_kept(void **unused)
{
    (void)unused;
    struct twofold p = twofold_product(1 + 0x1p-30, 1 + 0x1p-31);
    assert_true(p.x == 1 + 0x1p-30 + 0x1p-31 && p.rest == 0x1p-61);
    p = twofold_product(1e200, 1e200);
    assert_true(isinf(p.x) && p.rest == 0);
}

/* Each undoes the other, to some eps^2 of the larger operand. */
static void operations_undo_each_other(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {1};
    for (int i = 0; i < 20000; i++) {
        struct twofold a =
            twofold_sum(random_between(&numbers, -9, 9), random_between(&numbers, -1, 1) / 1e17);
        struct twofold b =
            twofold_sum(random_between(&numbers, 1, 2), random_between(&numbers, -1, 1) / 1e17);
        const double most = 16 * DBL_EPSILON * DBL_EPSILON * (fabs(a.x) + fabs(b.x));
        struct twofold sum = twofold_subtract(twofold_add(a, b), b);
        struct twofold product = twofold_divide(twofold_multiply(a, b), b);
        assert_true(fabs(twofold_value(twofold_subtract(sum, a))) <= most);
        assert_true(fabs(twofold_value(twofold_subtract(product, a))) <= most);
    }
}

/* Steps that a double does not see at all. */
static void a_moment_keeps_its_digits(void **unused)
{
    (void)unused;
    const double start = 1e6, step = 0x1p-60;
    struct moment t = moment_at(start);
    for (int i = 0; i < 1000; i++) t = moment_after(t, step);
    assert_true(t.t == start && moment_since(t, moment_at(start)) == 1000 * step);
    assert_true(moment_since(moment_at(start), t) == -1000 * step);
    assert_true(moment_equal(moment_earlier(t, moment_at(start)), moment_at(start)));
    assert_true(moment_since(moment_at(3), moment_at(1)) == 2);
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
