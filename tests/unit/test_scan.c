/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "events/scan.h"

/* Functions under test: value and rate at t. */
typedef double function(double t, double *rate);

struct bench {
    function *functions[4];
    size_t count;
    double fails_at;
    bool resumed;
    unsigned long work, dear; /* right-hand sides so far, and of each sample */
};

static int sample(void *context, double t, const bool *asked, double *values, double *rates)
{
    struct bench *bench = context;
    bench->work += bench->dear;
    if (t >= bench->fails_at) return -7;
    for (size_t i = 0; i < bench->count; i++) {
        values[i] = bench->functions[i](t, &rates[i]);
        if (asked && !asked[i]) values[i] = HUGE_VAL; /* must not be used */
    }
    return 0;
}

static unsigned long work_so_far(void *context)
{
    return ((const struct bench *)context)->work;
}

static struct arena memory; /* of the scan of a test */

static int scan_once(struct scan *scan, struct bench *bench, double from, double to)
{
    if (bench->fails_at == 0) bench->fails_at = HUGE_VAL;
    assert_true(scan_init(scan, bench->count, sample, bench, &memory));
    for (size_t i = 0; i < bench->count; i++) scan->crossed[i] = bench->resumed;
    scan_pass_over(scan);
    if (bench->dear > 0) scan->work = work_so_far;
    return scan_interval(scan, from, to);
}

/* One function, one zero: where it is, within `roundings` of t. */
static void expect_zero(function *f, double from, double to, double zero, double roundings)
{
    struct bench bench = {.functions = {f}, .count = 1};
    struct scan scan;
    assert_int_equal(scan_once(&scan, &bench, from, to), 1);
    assert_true(scan.crossed[0]);
    double allowed = roundings * DBL_EPSILON * fabs(zero);
    if (fabs(scan.t - zero) > allowed) fail_msg("zero at %.17g, expected %.17g", scan.t, zero);
    arena_free(&memory);
}

static void expect_none(function *f, double from, double to)
{
    struct bench bench = {.functions = {f}, .count = 1};
    struct scan scan;
    assert_int_equal(scan_once(&scan, &bench, from, to), 0);
    arena_free(&memory);
}

static double falling_line(double t, double *rate)
{
    *rate = -1;
    return 2.943 - t;
}

static double cosine(double t, double *rate)
{
    *rate = -sin(t);
    return cos(t);
}

static double fast_cosine(double t, double *rate)
{
    *rate = -100 * sin(100 * t);
    return 0.5 + cos(100 * t);
}

/* Below zero for 1e-3 around 0.7 only. */
static double dip(double t, double *rate)
{
    *rate = 2 * (t - 0.7);
    return (t - 0.7) * (t - 0.7) - 0.25e-6;
}

static double touch(double t, double *rate)
{
    *rate = 2 * (t - 0.7);
    return (t - 0.7) * (t - 0.7) + 1e-9;
}

static double steep(double t, double *rate)
{
    *rate = -1e6 / cosh(1e6 * (t - 0.3)) / cosh(1e6 * (t - 0.3));
    return -tanh(1e6 * (t - 0.3));
}

static double from_rest(double t, double *rate)
{
    *rate = 2 * t - 3 * t * t;
    return t * t - t * t * t;
}

/* Below zero by 1 % for 9 % of each period: the hold of friction under a force that only just overcomes it.
 */
static double shallow(double t, double *rate)
{
    *rate = -3.03 * cos(3 * t);
    return 1 - 1.01 * sin(3 * t);
}

static double negative(double t, double *rate)
{
    *rate = -1;
    return -1 - t;
}

static double inactive(double t, double *rate)
{
    (void)t;
    *rate = 0;
    return HUGE_VAL;
}

static void a_zero_is_found_to_rounding(void **unused)
{
    (void)unused;
    expect_zero(falling_line, 0, 10, 2.943, 4);
    expect_zero(cosine, 0, 3, acos(0), 4);
    expect_zero(cosine, 1.5, 1.6, acos(0), 4);
}

static void a_steep_zero_is_found_to_rounding(void **unused)
{
    (void)unused;
    expect_zero(steep, 0, 1, 0.3, 4);
}

static void the_first_of_many_zeros_is_found(void **unused)
{
    (void)unused;
    expect_zero(fast_cosine, 0, 10, acos(-0.5) / 100, 8);
    /* Any length of the interval: none may alias with the period. */
    for (int i = 0; i < 146; i++) /* 1 ... 200 */
        expect_zero(shallow, 0, pow(1.037, i), asin(1 / 1.01) / 3, 40);
}

static void a_dip_below_zero_within_the_interval_is_seen(void **unused)
{
    (void)unused;
    /* The zero of a parabola near its vertex is known to eps f / f' only: rounding of the value / slope 1e-3.
     */
    expect_zero(dip, 0, 1, 0.6995, 1000);
}

static void touching_without_crossing_is_no_zero(void **unused)
{
    (void)unused;
    expect_none(touch, 0, 1);
    expect_none(cosine, 0, 1);
}

static void a_start_at_zero_counts_when_the_function_has_been_positive(void **unused)
{
    (void)unused;
    expect_zero(from_rest, 0, 1.5, 1, 8);
    expect_none(from_rest, 0, 0.9);
}

static void what_is_negative_from_the_start_is_left_alone_in_a_search_that_is_resumed(void **unused)
{
    (void)unused;
    struct bench bench = {.functions = {negative, inactive}, .count = 2, .resumed = true};
    struct scan scan;
    assert_int_equal(scan_once(&scan, &bench, 0, 1), 0);
    arena_free(&memory);
    expect_none(inactive, 0, 1);
}

static void zeros_at_one_instant_are_taken_together(void **unused)
{
    (void)unused;
    struct bench bench = {.functions = {falling_line, cosine, falling_line}, .count = 3, .resumed = true};
    struct scan scan;
    assert_int_equal(scan_once(&scan, &bench, 2, 6), 1);
    assert_true(scan.crossed[0]);
    assert_false(scan.crossed[1]);
    assert_true(scan.crossed[2]);
    arena_free(&memory);
}

static void the_earlier_of_two_functions_wins(void **unused)
{
    (void)unused;
    struct bench bench = {.functions = {falling_line, cosine}, .count = 2};
    struct scan scan;
    assert_int_equal(scan_once(&scan, &bench, 0, 4), 1);
    assert_false(scan.crossed[0]);
    assert_true(scan.crossed[1]);
    assert_true(fabs(scan.t - acos(0)) <= 4 * DBL_EPSILON * scan.t);
    arena_free(&memory);
}

static void a_function_that_outruns_the_samples_bounds_the_next_interval(void **unused)
{
    (void)unused;
    struct bench bench = {.functions = {cosine}, .count = 1};
    struct scan scan;
    assert_int_equal(scan_once(&scan, &bench, 0, 0.1), 0);
    assert_true(scan.resolved == HUGE_VAL);
    arena_free(&memory);
    bench.functions[0] = fast_cosine;
    assert_int_equal(scan_once(&scan, &bench, 0, 0.5), 1);
    assert_true(scan.resolved <= 1);
    arena_free(&memory);
}

static void a_failing_sample_ends_the_scan(void **unused)
{
    (void)unused;
    struct bench bench = {.functions = {cosine}, .count = 1, .fails_at = 0.5};
    struct scan scan;
    assert_int_equal(scan_once(&scan, &bench, 0, 1), -7);
    arena_free(&memory);
}

static double noise(double t, double *rate)
{
    double many = 1e12 * sin(1e9 * t);
    *rate = 0;
    return many - floor(many) - 0.1;
}

/* A step whose inside is walked again for each sample: some seconds of work went into one interval of noise. */
static void dear_samples_are_given_up_sooner(void **unused)
{
    (void)unused;
    for (unsigned long dear = 0; dear <= 100000; dear = dear > 0 ? 10 * dear : 50) {
        struct bench bench = {.functions = {noise}, .count = 1, .dear = dear};
        struct scan scan;
        assert_true(scan_once(&scan, &bench, 0, 1) >= 0);
        if (dear <= 50) assert_true(scan.samples >= 4096);
        assert_true(scan.samples < 8192 + 200 && bench.work < 800000 + 200 * dear);
        arena_free(&memory);
    }
}

static double falling_early(double t, double *rate)
{
    *rate = -1;
    return 1 - t;
}

static void what_is_left_out_does_not_hide_others(void **unused)
{
    (void)unused;
    struct bench bench = {.functions = {falling_early, falling_line}, .count = 2};
    struct scan scan;
    assert_int_equal(scan_once(&scan, &bench, 0, 4), 1);
    assert_true(scan.crossed[0] && !scan.crossed[1]);
    assert_true(scan_leave_out(&scan));
    assert_false(scan_leave_out(&scan));
    assert_int_equal(scan_interval(&scan, 0, 4), 1);
    assert_true(scan.crossed[1] && fabs(scan.t - 2.943) < 1e-14);
    scan_start(&scan);
    assert_int_equal(scan_interval(&scan, 0, 4), 1);
    assert_true(scan.crossed[0] && fabs(scan.t - 1) < 1e-14);
    arena_free(&memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_zero_is_found_to_rounding),
        cmocka_unit_test(a_steep_zero_is_found_to_rounding),
        cmocka_unit_test(the_first_of_many_zeros_is_found),
        cmocka_unit_test(a_dip_below_zero_within_the_interval_is_seen),
        cmocka_unit_test(touching_without_crossing_is_no_zero),
        cmocka_unit_test(a_start_at_zero_counts_when_the_function_has_been_positive),
        cmocka_unit_test(what_is_negative_from_the_start_is_left_alone_in_a_search_that_is_resumed),
        cmocka_unit_test(zeros_at_one_instant_are_taken_together),
        cmocka_unit_test(the_earlier_of_two_functions_wins),
        cmocka_unit_test(a_function_that_outruns_the_samples_bounds_the_next_interval),
        cmocka_unit_test(what_is_left_out_does_not_hide_others),
        cmocka_unit_test(a_failing_sample_ends_the_scan),
        cmocka_unit_test(dear_samples_are_given_up_sooner),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
