/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Switches of expressions: which branch they take, and the margins to its ends.
 */
#include "expr_scope.h"

#include <float.h>

#include "expr/pieces.h"
#include "random_numbers.h"

enum { most_switches = 16 };

static const double origin[5] = {0, 0, 0, 0, 0};

static int resolved_branch(const char *text, double t, const double *y, double dt, const double *dy)
{
    struct trial trial = must_compile(text);
    int branch[most_switches];
    assert_int_equal(expr_switches(trial.expr), 1);
    expr_resolve(trial.expr, time_dd_at(t), y, dt, dy, NULL, branch);
    end_trial(&trial);
    return branch[0];
}

/* The branch at t = `t`, going forward or back in time. */
static int branch_at(const char *text, double t, double dt)
{
    return resolved_branch(text, t, origin, dt, NULL);
}

/* ---- choosing branches */

static void away_from_its_kink_a_switch_takes_the_side_of_the_value(void **state)
{
    (void)state;
    for (int way = -1; way <= 1; way++) {
        assert_int_equal(branch_at("sign(t)", 0.5, way), 1);
        assert_int_equal(branch_at("abs(t)", -0.5, way), -1);
        assert_int_equal(branch_at("step(t - 3)", 2, way), -1);
        assert_int_equal(branch_at("if(t < 3, 1, 2)", 2, way), -1);
        assert_int_equal(branch_at("if(t == 3, 1, 2)", 4, way), 1);
        assert_int_equal(branch_at("max(t, 3)", 2, way), -1);
        assert_int_equal(branch_at("floor(t/1[s])", -2.5, way), -3);
        assert_int_equal(branch_at("ceil(t/1[s])", -2.5, way), -2);
        assert_int_equal(branch_at("round(t/1[s])", -2.7, way), -3);
        assert_int_equal(branch_at("mod(t, 0.5)", 1.7, way), 3);
        assert_int_equal(branch_at("mod(t, -0.5)", 1.7, way), -4);
        assert_int_equal(branch_at("sawtooth(t/1[s])", 1.7, way), 1);
        assert_int_equal(branch_at("square(t/1[s])", 1.7, way), 3);
    }
}

static void on_its_kink_a_switch_takes_the_side_to_which_the_motion_goes(void **state)
{
    (void)state;
    const char *const by_sign[] = {"sign(t - 3)",      "abs(t - 3)",      "step(t - 3)",
                                   "min(t, 3)",        "max(t, 3)",       "if(t < 3, 1, 2)",
                                   "if(t <= 3, 1, 2)", "if(t > 3, 1, 2)", "if(t >= 3, 1, 2)",
                                   "if(t == 3, 1, 2)"};
    for (size_t i = 0; i < sizeof by_sign / sizeof by_sign[0]; i++) {
        assert_int_equal(branch_at(by_sign[i], 3, 1), 1);
        assert_int_equal(branch_at(by_sign[i], 3, -1), -1);
    }
    assert_int_equal(branch_at("floor(t/1[s])", 3, 1), 3);
    assert_int_equal(branch_at("floor(t/1[s])", 3, -1), 2);
    assert_int_equal(branch_at("ceil(t/1[s])", 3, 1), 4);
    assert_int_equal(branch_at("ceil(t/1[s])", 3, -1), 3);
    assert_int_equal(branch_at("round(t/1[s])", 2.5, 1), 3);
    assert_int_equal(branch_at("round(t/1[s])", 2.5, -1), 2);
    assert_int_equal(branch_at("round(t/1[s])", -2.5, 1), -2);
    assert_int_equal(branch_at("sawtooth(t/1[s])", -3, -1), -4);
    assert_int_equal(branch_at("square(t/1[s])", 1.5, 1), 3);
    assert_int_equal(branch_at("square(t/1[s])", 1.5, -1), 2);
    assert_int_equal(branch_at("mod(-t, 0.5)", 1, 1), -3);
    assert_int_equal(branch_at("mod(-t, 0.5)", 1, -1), -2);
}

static void at_rest_on_its_kink_a_switch_takes_its_plain_side_and_sign_is_zero(void **state)
{
    (void)state;
    assert_int_equal(branch_at("sign(t - 3)", 3, 0), 0);
    assert_int_equal(branch_at("if(t == 3, 1, 2)", 3, 0), 0);
    assert_int_equal(branch_at("abs(t - 3)", 3, 0), 1);
    assert_int_equal(branch_at("step(t - 3)", 3, 0), 1);
    assert_int_equal(branch_at("if(t < 3, 1, 2)", 3, 0), 1);
    assert_int_equal(branch_at("if(t <= 3, 1, 2)", 3, 0), -1);
    assert_int_equal(branch_at("if(t > 3, 1, 2)", 3, 0), -1);
    assert_int_equal(branch_at("if(t >= 3, 1, 2)", 3, 0), 1);
    assert_int_equal(branch_at("floor(t/1[s])", 3, 0), 3);
    assert_int_equal(branch_at("ceil(t/1[s])", 3, 0), 3);
    assert_int_equal(branch_at("round(t/1[s])", 2.5, 0), 3);
}

static void a_kink_is_recognised_through_rounding(void **state)
{
    (void)state;
    for (int k = 1; k <= 1000; k++) {
        assert_int_equal(branch_at("floor(t/0.7[s])", k * 0.7, 1), k);
        assert_int_equal(branch_at("floor(t/0.7[s])", k * 0.7, -1), k - 1);
        assert_int_equal(branch_at("mod(t, 0.7)", k * 0.7, 1), k);
        assert_int_equal(branch_at("mod(t, 0.7)", k * 0.7, -1), k - 1);
        assert_int_equal(branch_at("square(t/0.7[s])", k * 0.7 + 0.35, 1), 2 * k + 1);
        assert_int_equal(branch_at("sign(sin(2*pi*t/0.7[s]))", k * 0.7, 1), 1);
        assert_int_equal(branch_at("sign(sin(2*pi*t/0.7[s]))", k * 0.7, -1), -1);
    }
}

static void both_operands_count_for_the_rate_and_for_the_rounding(void **state)
{
    (void)state;
    const double near = 3 * 0.7; /* one rounding below 2.1 */
    assert_int_equal(branch_at("if(0 < t - 2.1, 1, 2)", near, 1), -1);
    assert_int_equal(branch_at("if(0 < t - 2.1, 1, 2)", near, -1), 1);
    assert_int_equal(branch_at("mod(3, t)", 1.5, 1), 1);
    assert_int_equal(branch_at("mod(3, t)", 1.5, -1), 2);
}

static void an_infinite_slope_or_value_does_not_count_as_zero(void **state)
{
    (void)state;
    assert_int_equal(branch_at("if(sqrt(t - 1) < 0.5, 1, 2)", 1, 1), -1);
    assert_int_equal(branch_at("sign(-1/(t - t))", 1, 1), -1);
}

static void a_point_clear_of_the_kink_is_not_taken_for_it(void **state)
{
    (void)state;
    const double clear = 1e-12; /* thousands of roundings away */
    assert_int_equal(branch_at("sign(t - 3)", 3 - clear, 1), -1);
    assert_int_equal(branch_at("floor(t/0.7[s])", 2.1 - clear, 1), 2);
    assert_int_equal(branch_at("floor(t/0.7[s])", 2.1 + clear, -1), 3);
    assert_int_equal(branch_at("sign(t)", 1e-300, -1), 1);
}

static void a_tiny_velocity_is_no_rest(void **state)
{
    (void)state;
    const double slow[5] = {0, 1e-300, 0, 0, 0}, rest[5] = {0, 0, 0, 0, 0}, toward[5] = {0, -1, 0, 0, 0};
    assert_int_equal(resolved_branch("sign(v)", 0, slow, 1, toward), 1);
    assert_int_equal(resolved_branch("sign(v)", 0, rest, 1, toward), -1);
    assert_int_equal(resolved_branch("sign(v)", 0, rest, 1, NULL), 0);
}

static void a_kept_branch_stays_and_what_depends_on_it_follows(void **state)
{
    (void)state;
    struct trial trial = must_compile("if(mod(t, 0.7) < 0.35, 10, -10)");
    int branch[2] = {2, 5};
    const bool keep[2] = {true, false};
    assert_int_equal(expr_switches(trial.expr), 2);
    expr_resolve(trial.expr, time_dd_at(2.1), origin, 1, NULL, keep, branch);
    assert_int_equal(branch[0], 2); /* still in its last period: mod is 0.7 */
    assert_int_equal(branch[1], 1);
    expr_resolve(trial.expr, time_dd_at(2.1), origin, 1, NULL, NULL, branch);
    assert_int_equal(branch[0], 3);
    assert_int_equal(branch[1], -1);
    end_trial(&trial);
}

/* ---- the smooth formula of a branch, and its margins */

static void a_branch_follows_its_formula_beyond_its_end(void **state)
{
    (void)state;
    const struct {
        const char *text;
        int branch;
        double t, value, slope;
    } rows[] = {
        {"abs(t)", 1, -0.5, -0.5, 1},
        {"abs(t)", -1, 0.5, -0.5, -1},
        {"sign(t)", 1, -0.5, 1, 0},
        {"sign(t)", 0, 0.5, 0, 0},
        {"step(t)", -1, 0.5, 0, 0},
        {"min(t, 1)", -1, 1.5, 1.5, 1},
        {"min(t, 1)", 1, 0.5, 1, 0},
        {"max(t, 1)", -1, 1.5, 1, 0},
        {"max(t, 1)", 1, 0.5, 0.5, 1},
        {"if(t < 1, t^2, 7)", -1, 3, 9, 6},
        {"if(t < 1, t^2, 7)", 1, 0.5, 7, 0},
        {"if(t == 1, 3, 7)", 0, 2, 3, 0},
        {"floor(t/1[s])", 2, 5.5, 2, 0},
        {"mod(t, 2)", 1, 7.5, 5.5, 1},
        {"sawtooth(t/1[s])", 1, 3.25, 2.25, 1},
        {"square(t/1[s])", 3, 0.25, -1, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct trial trial = must_compile(rows[i].text);
        double slope = NAN, second, a, b;
        assert_true(expr_eval(trial.expr, rows[i].t, NULL, &rows[i].branch) == rows[i].value);
        assert_true(expr_eval_slot(trial.expr, rows[i].t, NULL, 0, &rows[i].branch, &slope) == rows[i].value);
        assert_true(slope == rows[i].slope);
        expr_eval_second(trial.expr, rows[i].t, NULL, 0, 0, &rows[i].branch, &a, &b, &second);
        assert_true(a == rows[i].slope && b == rows[i].slope);
        end_trial(&trial);
    }
}

static void margins_measure_the_way_to_both_ends_of_a_branch(void **state)
{
    (void)state;
    const struct {
        const char *text;
        int branch;
        double t, lower, upper, rate; /* rate: of the watched function */
    } rows[] = {
        {"abs(2*t)", 1, 0.5, 1, HUGE_VAL, 2},   {"abs(2*t)", 1, -0.5, -1, HUGE_VAL, 2},
        {"abs(2*t)", -1, -0.5, HUGE_VAL, 1, 2}, {"abs(2*t)", -1, 0.5, HUGE_VAL, -1, 2},
        {"min(t, 3)", -1, 1, HUGE_VAL, 2, 1},   {"if(t^2 > 4[s^2], 1, 2)", 1, 3, 5, HUGE_VAL, 6},
        {"floor(t/2[s])", 1, 3, 0.5, 0.5, 0.5}, {"floor(t/2[s])", 1, 5, 1.5, -0.5, 0.5},
        {"ceil(t/2[s])", 2, 3, 0.5, 0.5, 0.5},  {"round(t/2[s])", 1, 2.5, 0.75, 0.25, 0.5},
        {"mod(t, 2)", 1, 2.5, 0.25, 0.75, 0.5}, {"square(t/2[s])", 2, 2.5, 0.5, 0.5, 1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct trial trial = must_compile(rows[i].text);
        double margins[2], rates[2];
        expr_margins(trial.expr, time_dd_at(rows[i].t), NULL, 1, NULL, &rows[i].branch, margins, rates, NULL);
        assert_true(margins[0] == rows[i].lower && margins[1] == rows[i].upper);
        assert_true(rates[0] == (isinf(rows[i].lower) ? 0 : rows[i].rate));
        assert_true(rates[1] == (isinf(rows[i].upper) ? 0 : -rows[i].rate));
        margins[0] = margins[1] = NAN;
        expr_margins(trial.expr, time_dd_at(rows[i].t), NULL, 0, NULL, &rows[i].branch, margins, NULL, NULL);
        assert_true(margins[0] == rows[i].lower && margins[1] == rows[i].upper);
        end_trial(&trial);
    }
}

static void a_sign_at_rest_ends_as_soon_as_it_moves(void **state)
{
    (void)state;
    struct trial trial = must_compile("sign(v)");
    const int branch = 0;
    double y[5] = {0, 0, 0, 0, 0}, margins[2];
    expr_margins(trial.expr, time_dd_at(0), y, 0, NULL, &branch, margins, NULL, NULL);
    assert_true(margins[0] > 0 && margins[1] > 0);
    y[1] = 1e-100;
    expr_margins(trial.expr, time_dd_at(0), y, 0, NULL, &branch, margins, NULL, NULL);
    assert_true(margins[0] > 0 && margins[1] < 0);
    y[1] = -1e-100;
    expr_margins(trial.expr, time_dd_at(0), y, 0, NULL, &branch, margins, NULL, NULL);
    assert_true(margins[0] < 0 && margins[1] > 0);
    end_trial(&trial);
}

static void beyond_an_end_lies_the_neighbouring_branch(void **state)
{
    (void)state;
    struct trial trial = must_compile("sign(v) + floor(theta)");
    assert_int_equal(expr_branch_beyond(trial.expr, 0, 0, 1), -1);
    assert_int_equal(expr_branch_beyond(trial.expr, 0, 1, -1), 1);
    assert_int_equal(expr_branch_beyond(trial.expr, 0, 0, 0), -1);
    assert_int_equal(expr_branch_beyond(trial.expr, 0, 1, 0), 1);
    assert_int_equal(expr_branch_beyond(trial.expr, 1, 0, -4), -5);
    assert_int_equal(expr_branch_beyond(trial.expr, 1, 1, -4), -3);
    end_trial(&trial);
}

static void steps_beyond_counting_are_smooth_and_silent(void **state)
{
    (void)state;
    struct trial trial = must_compile("floor(1e12*theta) + mod(1e12*theta, 0.25)");
    const double y[5] = {0, 0, 1.5, 0, 0};
    int branch[2];
    double margins[4];
    expr_resolve(trial.expr, time_dd_at(0), y, 1, NULL, NULL, branch);
    expr_margins(trial.expr, time_dd_at(0), y, 1, NULL, branch, margins, NULL, NULL);
    for (int i = 0; i < 4; i++) assert_true(margins[i] == HUGE_VAL);
    assert_true(expr_eval(trial.expr, 0, y, branch) == 1.5e12);
    assert_true(expr_branch_beyond(trial.expr, 0, 1, branch[0]) == branch[0]);
    end_trial(&trial);
}

static void switches_of_the_side_not_chosen_are_silent_until_it_is_chosen(void **state)
{
    (void)state;
    struct trial trial = must_compile("if(x > 0, abs(v), F*floor(theta)/5[N*s/m])");
    double y[5] = {1, -2, 3.5, 0, 0}, margins[6], rates[6];
    int branch[3] = {77, 77, 77};
    expr_resolve(trial.expr, time_dd_at(0), y, 1, NULL, NULL, branch);
    expr_margins(trial.expr, time_dd_at(0), y, 1, NULL, branch, margins, rates, NULL);
    assert_true(branch[0] == 1 && branch[1] == -1 && branch[2] == 0);
    assert_true(margins[2] == HUGE_VAL && margins[3] == 2);
    assert_true(margins[4] == HUGE_VAL && margins[5] == HUGE_VAL && rates[4] == 0 && rates[5] == 0);
    assert_true(expr_eval(trial.expr, 0, y, branch) == 2);
    y[0] = -1;
    expr_resolve(trial.expr, time_dd_at(0), y, 1, NULL, NULL, branch);
    expr_margins(trial.expr, time_dd_at(0), y, 1, NULL, branch, margins, rates, NULL);
    assert_true(branch[0] == -1 && branch[2] == 3);
    assert_true(margins[2] == HUGE_VAL && margins[3] == HUGE_VAL && margins[4] == 0.5 && margins[5] == 0.5);
    assert_true(expr_eval(trial.expr, 0, y, branch) == 3);
    end_trial(&trial);
}

static void a_switch_knows_whether_only_time_moves_it(void **state)
{
    (void)state;
    struct trial trial = must_compile(
        "step(t - 1)*sign(v)*floor(theta + t/1[s]) + if(x > 0, square(3*t), 2) + abs(step(t - 2))");
    const bool by_time[] = {true, false, false, false, true, true, true};
    assert_int_equal(expr_switches(trial.expr), 7);
    for (size_t i = 0; i < 7; i++) assert_true(expr_switch_is_time(trial.expr, i) == by_time[i]);
    end_trial(&trial);
}

static void resolved_branches_give_the_plain_value_and_positive_margins(void **state)
{
    (void)state;
    const unsigned seed = 99;
    const char *const laws[] = {
        "1*clamp(x, -1, 1)*max(v, 2*x, 0) + abs(theta)*sign(v - omega*x)",
        "if(x > 0 and (v < 0 or not theta > 1), floor(3*theta)*x, mod(v, 0.3 + 1*x^2))",
        "square(2*theta) + sawtooth(5*omega)*pulse(x, -1, 1.5) + round(4*theta) - ceil(1*v)",
        "if(min(1*x, v) < max(1*theta, omega)/2, step(x - 0.5), 2)*abs(abs(x) - 1)",
    };
    struct random_numbers numbers = {seed};
    for (size_t i = 0; i < sizeof laws / sizeof laws[0]; i++) {
        struct trial trial = must_compile(laws[i]);
        for (int k = 0; k < 2000; k++) {
            double y[5], dy[5], margins[2 * most_switches], a, b;
            int branch[most_switches];
            for (int j = 0; j < 5; j++) {
                y[j] = random_between(&numbers, -2, 2);
                dy[j] = random_between(&numbers, -2, 2);
            }
            expr_resolve(trial.expr, time_dd_at(0), y, 1, dy, NULL, branch);
            double plain = expr_eval_along(trial.expr, 0, y, 1, dy, NULL, &a);
            double smooth = expr_eval_along(trial.expr, 0, y, 1, dy, branch, &b);
            /* mod is exact in plain form and a - n b in a branch. */
            if (fabs(plain - smooth) > 1e-14 || a != b || expr_eval(trial.expr, 0, y, branch) != smooth)
                fail_msg("seed %u, point %d of `%s`: %.17g and %.17g, slopes %.17g and %.17g", seed, k,
                         laws[i], plain, smooth, a, b);
            expr_margins(trial.expr, time_dd_at(0), y, 1, dy, branch, margins, NULL, NULL);
            for (size_t j = 0; j < 2 * expr_switches(trial.expr); j++) assert_true(margins[j] > 0);
        }
        end_trial(&trial);
    }
}

/* ---- pieces of a stretch */

/* The variable x in slot 1. Halves of the smallest number are nothing: the search did not end. */
static void stretches_next_to_nothing_are_one_piece(void **state)
{
    (void)state;
    const double ends[][2] = {{0, DBL_TRUE_MIN},
                              {0, 8 * DBL_TRUE_MIN},
                              {-DBL_TRUE_MIN, DBL_TRUE_MIN},
                              {0, DBL_MIN / 2},
                              {1, 1 + DBL_EPSILON}};
    struct trial trial = must_compile("sign(x)");
    const struct expr *formula = trial.expr;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        double cut[9];
        assert_int_equal(pieces_cut(&formula, 1, 1, ends[i][0], ends[i][1], 8, cut), 1);
        assert_true(cut[0] == ends[i][0] && cut[1] == ends[i][1]);
    }
    end_trial(&trial);
}

/* Halves of a stretch that is longer than numbers go are as long: the search did not end. */
static void stretches_beyond_numbers_are_not_cut(void **state)
{
    (void)state;
    const double ends[][2] = {{0, HUGE_VAL}, {-HUGE_VAL, 0}, {-DBL_MAX, DBL_MAX}, {1, (double)NAN}};
    struct trial trial = must_compile("sign(x)");
    const struct expr *formula = trial.expr;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        double cut[9];
        assert_int_equal(pieces_cut(&formula, 1, 1, ends[i][0], ends[i][1], 8, cut), pieces_too_many);
    }
    double cut[9];
    assert_int_equal(pieces_cut(&formula, 1, 1, -DBL_MAX / 4, DBL_MAX / 4, 8, cut), 2);
    end_trial(&trial);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stretches_beyond_numbers_are_not_cut),
        cmocka_unit_test(away_from_its_kink_a_switch_takes_the_side_of_the_value),
        cmocka_unit_test(on_its_kink_a_switch_takes_the_side_to_which_the_motion_goes),
        cmocka_unit_test(at_rest_on_its_kink_a_switch_takes_its_plain_side_and_sign_is_zero),
        cmocka_unit_test(a_kink_is_recognised_through_rounding),
        cmocka_unit_test(both_operands_count_for_the_rate_and_for_the_rounding),
        cmocka_unit_test(an_infinite_slope_or_value_does_not_count_as_zero),
        cmocka_unit_test(a_point_clear_of_the_kink_is_not_taken_for_it),
        cmocka_unit_test(a_tiny_velocity_is_no_rest),
        cmocka_unit_test(a_kept_branch_stays_and_what_depends_on_it_follows),
        cmocka_unit_test(a_branch_follows_its_formula_beyond_its_end),
        cmocka_unit_test(margins_measure_the_way_to_both_ends_of_a_branch),
        cmocka_unit_test(a_sign_at_rest_ends_as_soon_as_it_moves),
        cmocka_unit_test(beyond_an_end_lies_the_neighbouring_branch),
        cmocka_unit_test(steps_beyond_counting_are_smooth_and_silent),
        cmocka_unit_test(switches_of_the_side_not_chosen_are_silent_until_it_is_chosen),
        cmocka_unit_test(a_switch_knows_whether_only_time_moves_it),
        cmocka_unit_test(stretches_next_to_nothing_are_one_piece),
        cmocka_unit_test(resolved_branches_give_the_plain_value_and_positive_margins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
