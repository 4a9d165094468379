/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The choice between an explicit and an implicit method: its rules, and what it says of real motions.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <math.h>

#include "integrate/pair8.h"
#include "integrate/rodas5p.h"
#include "integrate/stiffness.h"

enum { explicit_order = 8, implicit_order = 5 };

/* The error ratio of a method of order k whose step could be `gain` times as long. */
static double ratio_of(double gain, int k)
{
    return pow(gain, -k);
}

/* Steps up to and including the one after which the next attempt is due. */
static int steps_to_attempt(struct stiffness *s)
{
    int steps = 1;
    while (!stiffness_due(s, INFINITY)) steps++;
    return steps;
}

static void attempts_become_rare_where_nothing_changes(void **state)
{
    (void)state;
    struct stiffness s;
    stiffness_start(&s, 1);
    const int expected[] = {8, 8, 16, 32, 64, 64, 64};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        assert_int_equal(steps_to_attempt(&s), expected[i]);
        assert_false(stiffness_decide(&s, ratio_of(0.5, implicit_order), implicit_order, 0));
    }
    assert_false(s.implicit);
}

/* Of 22 coordinates a step of the implicit method costs four times what it does in a small system, beside the
 * explicit one: it is asked for a step that is four times as long, a quarter as often. */
static void large_systems_ask_for_longer_steps_more_seldom(void **state)
{
    (void)state;
    struct stiffness s;
    stiffness_start(&s, 22);
    const int expected[] = {32, 32, 64, 128, 256, 256};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        assert_true(stiffness_stride(&s) == 4);
        assert_int_equal(steps_to_attempt(&s), expected[i]);
        assert_false(stiffness_decide(&s, ratio_of(1.7, implicit_order), implicit_order, 0));
    }
    for (int i = 0; i < 2; i++) stiffness_decide(&s, ratio_of(2, implicit_order), implicit_order, 0);
    assert_true(s.implicit);
    assert_true(stiffness_stride(&s) == 0.25);
    assert_int_equal(steps_to_attempt(&s), 8);
    for (size_t few = 1; few <= 4; few++) {
        stiffness_start(&s, few);
        assert_true(stiffness_stride(&s) == 1);
    }
}

/* By less in small ones, and not on the way back. */
static void attempts_are_put_off_where_nothing_looks_stiff(void **state)
{
    (void)state;
    struct stiffness s;
    for (int large = 0; large < 2; large++)
        for (int implicit = 0; implicit < 2; implicit++) {
            int steps = 1;
            stiffness_start(&s, large ? 22 : 1);
            s.implicit = implicit;
            int usual = s.wait;
            while (!stiffness_due(&s, 0.49)) steps++;
            int later = large ? usual + 4 * 64 - 1 : 4 * usual;
            assert_int_equal(steps, implicit ? usual : later);
            stiffness_start(&s, large ? 22 : 1);
            s.implicit = implicit;
            for (steps = 1; !stiffness_due(&s, 0.51);) steps++;
            assert_int_equal(steps, usual);
        }
}

static void two_answers_in_a_row_make_the_switch(void **state)
{
    (void)state;
    struct stiffness s;
    stiffness_start(&s, 1);
    double yes = ratio_of(2, implicit_order), no = ratio_of(1.7, implicit_order);
    assert_false(stiffness_decide(&s, yes, implicit_order, 0));
    assert_int_equal(steps_to_attempt(&s), 3);
    assert_false(stiffness_decide(&s, no, implicit_order, 0));
    assert_false(stiffness_decide(&s, yes, implicit_order, 0));
    assert_true(stiffness_decide(&s, yes, implicit_order, 0));
    assert_true(s.implicit);
    yes = ratio_of(1.3, explicit_order);
    assert_int_equal(steps_to_attempt(&s), 8);
    assert_false(stiffness_decide(&s, yes, explicit_order, 0));
    assert_true(stiffness_decide(&s, yes, explicit_order, 0));
    assert_false(s.implicit);
}

/* Whatever the relation of the steps of two methods, as long as it stays the same: one switch at most. */
static void a_constant_relation_is_not_sent_to_and_fro(void **state)
{
    (void)state;
    for (int trial = 0; trial < 95; trial++) {
        double relation = 0.1 * pow(1.05, trial); /* implicit step / explicit step: 0.1 ... 10 */
        struct stiffness s;
        int switches = 0;
        stiffness_start(&s, 1);
        for (int i = 0; i < 100; i++) {
            int k = s.implicit ? explicit_order : implicit_order;
            switches += stiffness_decide(&s, ratio_of(s.implicit ? 1 / relation : relation, k), k, 0);
        }
        assert_true(switches == (relation > 1.8));
    }
}

static void failed_attempts_and_such_without_error_change_nothing(void **state)
{
    (void)state;
    const double ratios[] = {INFINITY, NAN, 0};
    for (size_t i = 0; i < sizeof ratios / sizeof *ratios; i++) {
        struct stiffness s;
        stiffness_start(&s, 1);
        for (int n = 0; n < 5; n++) assert_false(stiffness_decide(&s, ratios[i], implicit_order, 0));
    }
}

/* Not where it gains enough, nor where it would have to make shorter steps, nor on the way back. */
static void a_gain_that_is_nearly_enough_leaves_doubt(void **state)
{
    (void)state;
    struct stiffness s;
    stiffness_start(&s, 1);
    assert_true(stiffness_doubts(&s, ratio_of(1.7, implicit_order), implicit_order));
    assert_true(stiffness_doubts(&s, ratio_of(0.6, implicit_order), implicit_order));
    assert_false(stiffness_doubts(&s, 0, implicit_order));
    assert_false(stiffness_doubts(&s, ratio_of(1.9, implicit_order), implicit_order));
    assert_false(stiffness_doubts(&s, ratio_of(0.4, implicit_order), implicit_order));
    assert_false(stiffness_doubts(&s, INFINITY, implicit_order));
    assert_false(stiffness_doubts(&s, NAN, implicit_order));
    s.implicit = true;
    assert_false(stiffness_doubts(&s, ratio_of(1.1, explicit_order), explicit_order));
}

static void an_event_between_two_answers_makes_them_void(void **state)
{
    (void)state;
    struct stiffness s;
    stiffness_start(&s, 1);
    double yes = ratio_of(5, implicit_order);
    stiffness_decide(&s, yes, implicit_order, 0);
    stiffness_forget(&s);
    assert_int_equal(steps_to_attempt(&s), 3); /* and does not put the next one off */
    assert_false(stiffness_decide(&s, yes, implicit_order, 0));
    for (int i = 0; i < 10; i++) stiffness_decide(&s, 1, implicit_order, 0);
    assert_int_equal(s.wait, 64);
    stiffness_forget(&s);
    assert_int_equal(steps_to_attempt(&s), 8);
}

static void fast_rates_bar_the_way_back(void **state)
{
    (void)state;
    const double barred[] = {3.1, 1e5, INFINITY, NAN};
    double yes = ratio_of(5, explicit_order);
    for (size_t i = 0; i <= sizeof barred / sizeof *barred; i++) {
        struct stiffness s;
        stiffness_start(&s, 1);
        s.implicit = true;
        double h_rate = i > 0 ? barred[i - 1] : 2.9;
        stiffness_decide(&s, yes, explicit_order, h_rate);
        assert_true(stiffness_decide(&s, yes, explicit_order, h_rate) == (i == 0));
    }
}

/* The explicit method makes no error in the short steps of the implicit one, in which nothing is fast. */
static void steps_without_error_and_without_fast_rates_open_it(void **state)
{
    (void)state;
    const double h_rates[] = {0.1, 1.1, NAN};
    for (size_t i = 0; i < sizeof h_rates / sizeof *h_rates; i++) {
        struct stiffness s;
        stiffness_start(&s, 1);
        s.implicit = true;
        stiffness_decide(&s, 0, explicit_order, h_rates[i]);
        assert_true(stiffness_decide(&s, 0, explicit_order, h_rates[i]) == (i == 0));
    }
}

static void the_rate_is_that_of_the_system_in_all_units(void **state)
{
    (void)state;
    double work[8];
    for (int decade = -12; decade <= 12; decade += 6) {
        double unit = pow(10, decade); /* of q against v */
        const double swing[4] = {0, unit, -1e8 / unit, 0};
        /* 12 rounds: (1e16)^(1 / 2^12) = 1.01 */
        assert_true(fabs(stiffness_rate(2, swing, work) - 1e4) < 200);
        const double damped[4] = {0, unit, -1e6 / unit, -1e5}; /* rates 10 and 1e5 */
        double rate = stiffness_rate(2, damped, work);
        assert_true(rate > 99990 && rate < 1.1e5);
        /* A spring of 1e8 N/m beside one of 1 N/m. */
        const double two[16] = {[2] = unit, [7] = 1, [8] = -1e8 / unit, [13] = -1};
        assert_true(fabs(stiffness_rate(4, two, work) - 1e4) < 200);
    }
    const double drag[4] = {0, 1, 0, -3}, still[4] = {0}, nan[4] = {0, 1, NAN, 0};
    assert_true(fabs(stiffness_rate(2, drag, work) - 3) < 0.01);
    assert_true(stiffness_rate(2, still, work) == 0);
    assert_false(stiffness_rate(2, nan, work) < INFINITY);
}

/* q'' = -k q - c v. */
struct oscillator {
    double k, c;
};

static int rhs(double t, const double y[], double f[], void *params)
{
    const struct oscillator *o = params;
    (void)t;
    f[0] = y[1];
    f[1] = -o->k * y[0] - o->c * y[1];
    return GSL_SUCCESS;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    const struct oscillator *o = params;
    (void)t, (void)y;
    dfdy[0] = dfdt[0] = dfdt[1] = 0;
    dfdy[1] = 1;
    dfdy[2] = -o->k;
    dfdy[3] = -o->c;
    return GSL_SUCCESS;
}

/* A step of size h by one method from y0; the error ratio for the tolerance 1e-8 and the scales 1 and v. */
static double attempt(const gsl_odeiv2_step_type *type, struct oscillator *o, const double y0[2], double h,
                      double v)
{
    gsl_odeiv2_system sys = {rhs, jacobian, 2, o};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(type, 2);
    double y[2] = {y0[0], y0[1]}, yerr[2];
    assert_int_equal(gsl_odeiv2_step_apply(step, 0, h, y, yerr, NULL, NULL, &sys), GSL_SUCCESS);
    gsl_odeiv2_step_free(step);
    return fmax(fabs(yerr[0]), fabs(yerr[1]) / v) / 1e-8;
}

/* The same answer to attempts at every turn, beginning with this method; true for a switch. */
static bool switches(bool implicit, double ratio)
{
    struct stiffness s;
    int k = implicit ? explicit_order : implicit_order;
    stiffness_start(&s, 1);
    s.implicit = implicit;
    stiffness_decide(&s, ratio, k, 0);
    return stiffness_decide(&s, ratio, k, 0);
}

static void real_motions_get_the_method_that_suits_them(void **state)
{
    (void)state;
    /* The rates -10 and -1e5; the fast one has died out. dop853 is at its limit h rho = 6.4. */
    struct oscillator damped = {1e6, 1e5};
    const double slow = -1e6 / (5e4 + sqrt(2.5e9 - 1e6)), crawl[2] = {1, slow};
    assert_true(switches(false, attempt(step_rodas5p, &damped, crawl, 6.4e-5, 10)));
    assert_false(switches(true, attempt(step_dop853, &damped, crawl, 6.4e-4, 10)));
    /* An oscillation to be followed, with the steps that each method makes for this tolerance. */
    struct oscillator lively = {1e8, 0};
    const double swing[2] = {0.6, 8e3};
    assert_false(switches(false, attempt(step_rodas5p, &lively, swing, 4e-5, 1e4)));
    assert_true(switches(true, attempt(step_dop853, &lively, swing, 0.8e-5, 1e4)));
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(attempts_become_rare_where_nothing_changes),
        cmocka_unit_test(large_systems_ask_for_longer_steps_more_seldom),
        cmocka_unit_test(attempts_are_put_off_where_nothing_looks_stiff),
        cmocka_unit_test(two_answers_in_a_row_make_the_switch),
        cmocka_unit_test(a_constant_relation_is_not_sent_to_and_fro),
        cmocka_unit_test(failed_attempts_and_such_without_error_change_nothing),
        cmocka_unit_test(a_gain_that_is_nearly_enough_leaves_doubt),
        cmocka_unit_test(an_event_between_two_answers_makes_them_void),
        cmocka_unit_test(fast_rates_bar_the_way_back),
        cmocka_unit_test(steps_without_error_and_without_fast_rates_open_it),
        cmocka_unit_test(the_rate_is_that_of_the_system_in_all_units),
        cmocka_unit_test(real_motions_get_the_method_that_suits_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
