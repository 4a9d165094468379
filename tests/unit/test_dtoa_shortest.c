/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The shortest decimals by integers are those that printf and strtod find by trying, and rounded ones those of printf.
 * Compiled a second time as for a processor of 32 bits, which has no integers of 128: there fractions are left to others.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/dtoa_shortest.h"
#include "base/format.h"
#include "random_numbers.h"

static void by_trying(char *buffer, size_t size, double value)
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(buffer, size, "%.*g", digits, value);
        double read = strtod(buffer, NULL);
        if (!(read < value || read > value)) return;
    }
}

static void check_rounded(double value)
{
    for (int digits = 1; digits <= 17; digits++) {
        char quick[dtoa_size], slow[64];
        int length = dtoa_rounded(quick, value, digits);
        if (length < 0) continue;
        snprintf(slow, sizeof slow, "%.*g", digits, value);
        assert_string_equal(quick, slow);
        assert_int_equal(length, strlen(slow));
    }
}

#ifdef __SIZEOF_INT128__
static const bool is_wide = true;
#else
static const bool is_wide = false;
#endif

/* False where the number is left to others. */
static bool check(double value)
{
    check_rounded(value);
    char quick[dtoa_size], slow[64], written[64];
    int length = dtoa_shortest(quick, value);
    by_trying(slow, sizeof slow, value);
    format_shortest(written, sizeof written, value);
    assert_string_equal(written, slow);
    if (length < 0) return false;
    assert_string_equal(quick, slow);
    assert_int_equal(length, strlen(slow));
    return true;
}

static void numbers_of_all_sizes(void **state)
{
    struct random_numbers seed = {1};
    int taken = 0;
    const int count = 50000;
    (void)state;
    for (int i = 0; i < count; i++) {
        double size = exp(40 * (random_between(&seed, 0, 1) - 0.5));
        taken += check(i % 2 ? size : -size);
        check(exp(1400 * (random_between(&seed, 0, 1) - 0.5)));
    }
    assert_true(is_wide ? taken > count * 9 / 10 : taken < count / 10);
}

/* Few digits, halves, carries to one digit more, neighbours of powers of ten and two. */
static void numbers_that_are_special(void **state)
{
    (void)state;
    for (int k = -25; k <= 25; k++) {
        double power = pow(10, k), two = ldexp(1, 3 * k);
        for (int i = 1; i < 100; i++) check(i * power);
        const double special[] = {nextafter(power, 0),
                                  nextafter(power, HUGE_VAL),
                                  two,
                                  nextafter(two, 0),
                                  nextafter(two, HUGE_VAL),
                                  9.995 * power,
                                  0.3 * power,
                                  power / 3,
                                  two + 0.5};
        for (size_t i = 0; i < sizeof special / sizeof *special; i++) check(special[i]);
    }
    assert_true(check(0.0));
    char buffer[dtoa_size];
    assert_true((dtoa_rounded(buffer, 1.0 / 3, 6) > 0) == is_wide);
    assert_true((dtoa_rounded(buffer, -2.5, 1) > 0) == is_wide);
    assert_true(dtoa_shortest(buffer, 12) == 2 && dtoa_rounded(buffer, 0, 6) == 1);
    assert_true(dtoa_rounded(buffer, 1.0, 0) < 0 && dtoa_rounded(buffer, 1.0, 18) < 0);
    assert_false(check(-0.0) || check(HUGE_VAL) || check(NAN) || check(5e-324) || check(1.7e308));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_of_all_sizes),
        cmocka_unit_test(numbers_that_are_special),
    };
    return cmocka_run_group_tests_name("shortest", tests, NULL, NULL);
}
