/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which sequences of gains end a run for want of progress, and which may go on.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "loop/progress.h"

/* The window, counted from 1, at which a run of this length ends that gains `first` in its first one and then each time `ratio`
 * of the gain before; 0 when it goes on for all of them, or comes to its end. */
static int ends_at(double length, double first_step, double gain, double ratio, bool rejects, int windows)
{
    double passed = 0;
    for (int k = 1; k <= windows && passed < length; k++) {
        passed += gain;
        const struct gain now = {gain, passed, length, first_step, rejects};
        if (progress_is_none(&now)) return k;
        gain *= ratio;
    }
    return 0;
}

static void steady_runs_go_on(void **unused)
{
    (void)unused;
    assert_int_equal(ends_at(10, 1e-3, 1e-1, 1, false, 1000), 0);
    assert_int_equal(ends_at(10, 1e-3, 2e-5, 1, false, 200000),
                     0);                                        /* the slowest that may: a million windows */
    assert_int_equal(ends_at(1e9, 1e-3, 1, 2, false, 100), 0);  /* an event is to end it */
    assert_int_equal(ends_at(10, 1e-3, 1e-2, 1, true, 500), 0); /* many rejections alone are no reason */
}

static void steps_that_shrink_for_ever_end(void **unused)
{
    (void)unused;
    assert_int_equal(ends_at(10, 1e-3, 1, 0.1, false, 100), 7); /* 1e-6 of 10 s, in a window of 1 % at most */
    assert_int_equal(ends_at(10, 1e-3, 1, 0.1, true, 100), 4);  /* and sooner where most are rejected */
    assert_int_equal(ends_at(1e3, 1e-3, 1e-11, 1, false, 100), 1);
}

static void what_would_not_end_ends(void **unused)
{
    (void)unused;
    assert_int_equal(ends_at(1e16, 1e-3, 1, 1, false, 10), 1);    /* 1e16 windows */
    assert_int_equal(ends_at(1e8, 1e-3, 1, 1, false, 1000), 101); /* 1e8, after a hundred */
    assert_int_equal(ends_at(1e-3, 1, 1e-9, 1, false, 1000),
                     0); /* a first step beyond the end is no measure */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steady_runs_go_on),
        cmocka_unit_test(steps_that_shrink_for_ever_end),
        cmocka_unit_test(what_would_not_end_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
