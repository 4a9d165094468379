/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Expressions: what they mean, what dimension they have, what is known of them.
 */
#include "expr_value.h"

#include <stdio.h>

static bool has_dim(const char *text, struct dim dim)
{
    struct trial trial = must_compile(text);
    bool same = dim_equal(expr_dim(trial.expr), dim) && !expr_is_bare(trial.expr);
    end_trial(&trial);
    return same;
}

static bool is_bare(const char *text)
{
    struct trial trial = must_compile(text);
    bool bare = expr_is_bare(trial.expr);
    end_trial(&trial);
    return bare;
}

/* ---- grammar */

static void operators_bind_as_in_mathematics(void **state)
{
    (void)state;
    assert_true(value_of("1 + 2*3") == 7);
    assert_true(value_of("(1 + 2)*3") == 9);
    assert_true(value_of("8/4/2") == 1);
    assert_true(value_of("8 - 4 - 2") == 2);
    assert_true(value_of("-2^2") == -4);
    assert_true(value_of("2^3^2") == 512);
    assert_true(value_of("2^-1") == 0.5);
    assert_true(value_of("2*-3") == -6);
    assert_true(value_of("- -3") == 3);
    assert_true(value_of("+3") == 3);
    assert_true(value_of("6/2*3") == 9);
}

static void conditions_bind_looser_than_comparisons_and_these_than_sums(void **state)
{
    (void)state;
    assert_true(value_of("if(1 + 1 < 3, 1, 2)") == 1);
    assert_true(value_of("if(not 1 < 2, 1, 2)") == 2);
    assert_true(value_of("if(1 < 2 or 1 < 2 and 2 < 1, 1, 2)") == 1);
    assert_true(value_of("if(not 1 < 2 or 1 < 2, 1, 2)") == 1);
    assert_true(value_of("if((1 < 2 or 1 < 2) and 2 < 1, 1, 2)") == 2);
    assert_true(value_of("if(1 <= 1 and 1 >= 1 and 1 == 1, 1, 2)") == 1);
    assert_true(value_of("if(1 > 1 or 1 < 1, 1, 2)") == 2);
}

static void blanks_and_lines_do_not_matter(void **state)
{
    (void)state;
    assert_true(value_of(" \t1+\n 2 ") == 3);
}

static void variables_are_read_from_their_slots(void **state)
{
    (void)state;
    assert_true(value_of("t") == now);
    assert_true(value_of("x") == here[0]);
    assert_true(value_of("crank.theta - theta") == here[4] - here[2]);
    assert_true(value_of("k*x + c*v") == 200 * here[0] + 3 * here[1]);
    assert_true(value_of("omega*t - t*omega + pi") == 3.14159265358979323846);
}

struct row {
    const char *text;
    double value;
};

static void check_values(const struct row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double value = value_of(rows[i].text);
        /* Sums such as 1.5 - 2*0.7 are rounded twice. */
        if (fabs(value - rows[i].value) > 4e-16)
            fail_msg("%s: %.17g, not %.17g", rows[i].text, value, rows[i].value);
    }
}

static void every_function_has_its_value(void **state)
{
    (void)state;
    const struct row rows[] = {
        {"sin(theta)", sin(1.25)},
        {"cos(theta)", cos(1.25)},
        {"tan(theta)", tan(1.25)},
        {"asin(0.3)", asin(0.3)},
        {"acos(0.3)", acos(0.3)},
        {"atan(theta)", atan(1.25)},
        {"atan2(x, -0.2)", atan2(0.3, -0.2)},
        {"sinh(theta)", sinh(1.25)},
        {"cosh(theta)", cosh(1.25)},
        {"tanh(theta)", tanh(1.25)},
        {"exp(theta)", exp(1.25)},
        {"ln(theta)", log(1.25)},
        {"log(theta)", log(1.25)},
        {"log10(theta)", log10(1.25)},
        {"sqrt(x)", sqrt(0.3)},
        {"cbrt(v)", cbrt(-0.5)},
        {"hypot(x, 0.4)", hypot(0.3, 0.4)},
        {"pow(x, 3)", 0.3 * 0.3 * 0.3},
        {"pow(theta, 2.5)", pow(1.25, 2.5)},
    };
    check_values(rows, sizeof rows / sizeof rows[0]);
}

static void every_switch_has_its_value(void **state)
{
    (void)state;
    const struct row rows[] = {
        {"abs(v)", 0.5},
        {"sign(v)", -1},
        {"sign(x - x)", 0},
        {"min(x, 0.2)", 0.2},
        {"min(x, 0.7, 0.1, 0.4)", 0.1},
        {"max(x, 0.7, 0.1, 0.4)", 0.7},
        {"floor(-theta)", -2},
        {"ceil(theta)", 2},
        {"round(-2.5)", -3},
        {"mod(-0.25, 1)", 0.75},
        {"mod(0.25, -1)", -0.75},
        {"mod(t, 0.7)", 1.5 - 2 * 0.7},
        {"mod(1e300, 7)", fmod(1e300, 7)},
        {"mod(1, 1.7e-300)*1e300", fmod(1, 1.7e-300) * 1e300},
        {"mod(-3e17, 0.1)", fmod(-3e17, 0.1) + 0.1},
        {"mod(1e-3, 3e-307)*1e300", fmod(1e-3, 3e-307) * 1e300},
        {"step(v)", 0},
        {"step(x - x)", 1},
        {"step(x)", 1},
        {"pulse(t, 1, 0.4)", 0},
        {"pulse(t, 1, 0.6)", 1},
        {"pulse(t, 1.5, 1)", 1},
        {"pulse(t, 0.5, 1)", 0},
        {"pulse(t, 1, -0.5)", 0},
        {"square(0.25)", 1},
        {"square(theta + 0.5)", -1},
        {"square(-0.25)", -1},
        {"square(-0.75)", 1},
        {"sawtooth(-theta)", 0.75},
        {"min(theta, crank.theta, theta/5)", 0.25},
        {"clamp(theta, crank.theta, theta*0.8)", 1},
        {"clamp(x, 0.4, 0.5)", 0.4},
        {"clamp(x, 0.1, 0.2)", 0.2},
        {"clamp(x, 0.1, 0.5)", 0.3},
        {"clamp(0.1, 0.4, x + 0.9)", 0.4},
        {"clamp(x + 0.1, x + 0.2, x + 0.3)", 0.5},
        {"if(x > 0.2, x, 2*x)", 0.3},
        {"if(x < 0.2, x, 2*x)", 0.6},
        {"if(x < 0.2, if(v < 0, 1, 2), if(v < 0, 3*x/x, 4))", 3},
        {"x + if(x < 0.2, 5*x, 2*x)*if(v < 0, 3*x/x, 4)", 0.3 + 0.6 * 3},
    };
    check_values(rows, sizeof rows / sizeof rows[0]);
}

static void the_side_not_chosen_does_no_harm(void **state)
{
    (void)state;
    assert_true(value_of("if(v > 0, sqrt(v), 7)") == 7);
    assert_true(value_of("if(zero > 0, 1/zero, 7)") == 7);
    assert_true(value_of("if(zero < 1, 7, 1/zero)") == 7);
}

static void a_missing_value_is_not_hidden_by_a_switch(void **state)
{
    (void)state;
    const char *const texts[] = {"min(1, ln(-theta))", "max(1, ln(-theta))",     "max(ln(-theta), 1)",
                                 "abs(ln(-theta))",    "step(ln(-theta))",       "square(ln(-theta))",
                                 "sign(ln(-theta))",   "clamp(ln(-theta), 0, 1)"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) assert_true(isnan(value_of(texts[i])));
}

static void folding_gives_the_bits_of_evaluation(void **state)
{
    (void)state;
    const char *const pairs[][2] = {{"theta*0.1 + 0.7/3", "1.25*0.1 + 0.7/3"},
                                    {"sin(theta)^3 - exp(theta)", "sin(1.25)^3 - exp(1.25)"},
                                    {"mod(theta, 0.07)", "mod(1.25, 0.07)"},
                                    {"theta^31 + theta^-7", "1.25^31 + 1.25^-7"},
                                    {"hypot(theta, 2)^0.3", "hypot(1.25, 2)^0.3"}};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++)
        assert_true(value_of(pairs[i][0]) == value_of(pairs[i][1]));
}

/* ---- units */

static void a_whole_scalar_may_be_a_number_with_its_unit(void **state)
{
    (void)state;
    assert_true(value_of("30 deg") == 30 * (3.14159265358979323846 / 180));
    assert_true(value_of("-5 lbf") == -5 * 4.4482216152605);
    assert_true(value_of("+1.5e3mm") == 1.5);
    assert_true(value_of(" 2 N*m*s/rad ") == 2);
    assert_true(value_of("5 1/s") == 5);
    assert_true(has_dim("2 N*m*s/rad", DIM_ANGULAR_DAMPING));
    assert_true(has_dim("3 kg m^2", DIM_INERTIA));
}

static void a_literal_takes_a_unit_in_brackets(void **state)
{
    (void)state;
    assert_true(value_of("4[N/s]*t") == 4 * now);
    assert_true(value_of("-5[cm] + x") == -0.05 + 0.3);
    assert_true(value_of("2 [m]") == 2);
    assert_true(has_dim("4[N/s]*t", DIM_FORCE));
    assert_true(has_dim("1[m]^2/2[s^2]", DIM(0, 2, -2)));
}

static void a_model_in_us_units_is_computed_in_them(void **state)
{
    (void)state;
    struct expr_want want = {.dim = DIM_ACCELERATION, .what = "gravity"};
    struct trial trial = try_text("32.2 ft/s^2", &want, unit_us);
    assert_true(expr_value(trial.expr) == 32.2);
    end_trial(&trial);
    want.dim = DIM_FORCE;
    trial = try_text("0.5[slug]*32.2[ft/s^2] + 1[kip]", &want, unit_us);
    assert_true(expr_value(trial.expr) == 0.5 * 32.2 + 1000);
    end_trial(&trial);
}

/* ---- dimensions */

static void dimensions_follow_the_operations(void **state)
{
    (void)state;
    assert_true(has_dim("m*x*omega^2", DIM_FORCE));
    assert_true(has_dim("k*x/m", DIM_ACCELERATION));
    assert_true(has_dim("sqrt(k/m)", DIM_RATE));
    assert_true(has_dim("cbrt(x^3)", DIM_LENGTH));
    assert_true(has_dim("(x^2)^0.5", DIM_LENGTH));
    assert_true(has_dim("(x^3)^(1/3)", DIM_LENGTH));
    assert_true(has_dim("(x^2)^(0.7 - 0.2)", DIM_LENGTH)); /* 0.49999999999999994 */
    assert_true(has_dim("x^-2", DIM(0, -2, 0)));
    assert_true(has_dim("x^1", DIM_LENGTH));
    assert_true(has_dim("x^0", DIM_NONE));
    assert_true(has_dim("theta^theta", DIM_NONE));
    assert_true(has_dim("hypot(x, x)", DIM_LENGTH));
    assert_true(has_dim("atan2(x, x)", DIM_NONE));
    assert_true(has_dim("sign(F)", DIM_NONE));
    assert_true(has_dim("step(t - 0.3)", DIM_NONE));
    assert_true(has_dim("mod(t, 0.7)", DIM_TIME));
    assert_true(has_dim("abs(v)", DIM_VELOCITY));
    assert_true(has_dim("clamp(x, -1, 1)", DIM_LENGTH));
    assert_true(has_dim("if(v > 0, F, -F)", DIM_FORCE));
    assert_true(has_dim("pulse(t, 500, 0.001)", DIM_NONE));
    assert_true(has_dim("F*cos(theta)", DIM_FORCE));
}

static void a_bare_literal_in_a_sum_takes_the_dimension_of_its_partner(void **state)
{
    (void)state;
    assert_true(has_dim("x + 3", DIM_LENGTH));
    assert_true(has_dim("3 - x", DIM_LENGTH));
    assert_true(has_dim("max(x, 0)", DIM_LENGTH));
    assert_true(has_dim("if(x < 3, F, 0)", DIM_FORCE));
    assert_true(is_bare("3 + 4"));
}

static void a_product_with_a_bare_literal_takes_any_dimension(void **state)
{
    (void)state;
    assert_true(is_bare("2*x"));
    assert_true(is_bare("x/2"));
    assert_true(is_bare("pi*t"));
    assert_true(is_bare("gain*t^2"));
    assert_true(is_bare("(2*x)^2"));
    assert_true(is_bare("sqrt(2*x)"));
    assert_true(has_dim("F + 2*x", DIM_FORCE));
    assert_true(has_dim("-k*x - 3*x^3", DIM_FORCE));
    assert_true(has_dim("sin(2*t)", DIM_NONE));
    assert_true(has_dim("exp(-t/2)", DIM_NONE));
}

static void a_bare_result_satisfies_whatever_is_wanted(void **state)
{
    (void)state;
    struct expr_want want = {.dim = DIM_FORCE, .what = "value"};
    struct trial trial = try_text("10*sin(2*t)", &want, unit_si);
    assert_non_null(trial.expr);
    assert_true(expr_is_bare(trial.expr));
    assert_true(dim_equal(expr_dim(trial.expr), DIM_FORCE));
    end_trial(&trial);
}

static void a_bare_result_that_any_dimension_would_do_for_reports_its_plain_one(void **state)
{
    (void)state;
    struct trial trial = must_compile("2*x + 1");
    assert_true(dim_equal(expr_dim(trial.expr), DIM_LENGTH));
    end_trial(&trial);
}

/* ---- what is known of an expression */

static void an_expression_of_constants_is_one_number(void **state)
{
    (void)state;
    struct trial trial = must_compile("k*(2[m] + 3)/gain + if(zero < 1, 0, 5)");
    assert_true(expr_is_constant(trial.expr));
    assert_true(expr_value(trial.expr) == 200.0 * 5 / 4);
    assert_int_equal(expr_switches(trial.expr), 0);
    end_trial(&trial);
    trial = must_compile("t");
    assert_false(expr_is_constant(trial.expr));
    end_trial(&trial);
}

static void a_constant_needs_no_text(void **state)
{
    (void)state;
    struct arena arena = {0};
    const struct expr *expr = expr_constant(&arena, 9.81, DIM_ACCELERATION);
    double d = 1;
    assert_true(expr_is_constant(expr) && !expr_is_bare(expr) && !expr_uses_time(expr));
    assert_true(expr_value(expr) == 9.81 && expr_eval(expr, 0, NULL, NULL) == 9.81);
    assert_true(dim_equal(expr_dim(expr), DIM_ACCELERATION));
    assert_true(expr_eval_along(expr, 0, NULL, 1, NULL, NULL, &d) == 9.81 && d == 0);
    arena_free(&arena);
}

static void an_expression_knows_its_variables(void **state)
{
    (void)state;
    const int *slots;
    struct trial trial = must_compile("omega*theta + omega*sin(2*t) - crank.theta*x*omega/x + omega");
    assert_int_equal(expr_variables(trial.expr, &slots), 4);
    assert_int_equal(slots[0], 1);
    assert_int_equal(slots[1], 3);
    assert_int_equal(slots[2], 4);
    assert_int_equal(slots[3], 5);
    assert_true(expr_uses_time(trial.expr));
    end_trial(&trial);
    trial = must_compile("k*x");
    assert_int_equal(expr_variables(trial.expr, &slots), 1);
    assert_false(expr_uses_time(trial.expr));
    end_trial(&trial);
}

/* ---- relations */

struct pair {
    struct arena arena;
    fbd_errors *errors;
    const struct expr *left, *right;
    char relation;
    bool good;
};

static struct pair relate(const char *text)
{
    struct pair pair = {.errors = fbd_errors_new(), .relation = '?'};
    struct scope scope = {.lookup = scope_lookup, .names = scope_list, .units = unit_si};
    struct expr_want want = {.any_dim = true, .what = "hand"};
    pair.good = expr_compile_relation(&pair.arena, text, (struct pos){4, 11}, &scope, &want, pair.errors,
                                      &pair.left, &pair.relation, &pair.right);
    return pair;
}

static void end_pair(struct pair *pair)
{
    arena_free(&pair->arena);
    fbd_errors_free(pair->errors);
}

static void a_relation_yields_both_sides(void **state)
{
    (void)state;
    const struct {
        const char *text;
        char relation;
        double left, right;
    } rows[] = {
        {"m*v = F*t", '=', 2 * -0.5, 5 * 1.5},
        {"F == k*x", '=', 5, 200 * 0.3},
        {"x<0.5", '<', 0.3, 0.5},
        {"x <= 5 cm", '<', 0.3, 0.05},
        {"x*(v - 2) > if(x < 3, 1, 2)", '>', 0.3 * -2.5, 1},
        {"F>=3", '>', 5, 3},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct pair pair = relate(rows[i].text);
        if (!pair.good) fbd_errors_print(pair.errors, stdout);
        assert_true(pair.good);
        assert_int_equal(pair.relation, rows[i].relation);
        assert_true(expr_eval(pair.left, now, here, NULL) == rows[i].left);
        assert_true(expr_eval(pair.right, now, here, NULL) == rows[i].right);
        assert_true(dim_equal(expr_dim(pair.left), expr_dim(pair.right)));
        end_pair(&pair);
    }
}

static void without_a_relation_there_is_one_side(void **state)
{
    (void)state;
    struct pair pair = relate("x - 3");
    assert_true(pair.good && pair.relation == '\0' && pair.left && !pair.right);
    end_pair(&pair);
}

static void a_wrong_relation_is_refused_where_it_is_wrong(void **state)
{
    (void)state;
    const struct {
        const char *text, *id;
        int column;
    } rows[] = {
        {"F = x", "wrong-dimension", 13},         {"x > 0 and v > 0", "expression-syntax", 23},
        {"x =", "expression-syntax", 14},         {"= x", "expression-syntax", 11},
        {"x = foo", "unknown-name", 15},          {"x + F = 3", "wrong-dimension", 13},
        {"x = 3*(v + F)", "wrong-dimension", 20}, {"(x < 3) = 1", "expression-syntax", 14},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct pair pair = relate(rows[i].text);
        assert_false(pair.good);
        const fbd_error note = fbd_errors_get(pair.errors, 0);
        if (strcmp(note.id, rows[i].id) != 0 || note.line != 4 || note.column != rows[i].column) {
            fbd_errors_print(pair.errors, stdout);
            fail_msg("%s", rows[i].text);
        }
        end_pair(&pair);
    }
}
int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operators_bind_as_in_mathematics),
        cmocka_unit_test(conditions_bind_looser_than_comparisons_and_these_than_sums),
        cmocka_unit_test(blanks_and_lines_do_not_matter),
        cmocka_unit_test(variables_are_read_from_their_slots),
        cmocka_unit_test(every_function_has_its_value),
        cmocka_unit_test(every_switch_has_its_value),
        cmocka_unit_test(the_side_not_chosen_does_no_harm),
        cmocka_unit_test(a_missing_value_is_not_hidden_by_a_switch),
        cmocka_unit_test(folding_gives_the_bits_of_evaluation),
        cmocka_unit_test(a_whole_scalar_may_be_a_number_with_its_unit),
        cmocka_unit_test(a_literal_takes_a_unit_in_brackets),
        cmocka_unit_test(a_model_in_us_units_is_computed_in_them),
        cmocka_unit_test(dimensions_follow_the_operations),
        cmocka_unit_test(a_bare_literal_in_a_sum_takes_the_dimension_of_its_partner),
        cmocka_unit_test(a_product_with_a_bare_literal_takes_any_dimension),
        cmocka_unit_test(a_bare_result_satisfies_whatever_is_wanted),
        cmocka_unit_test(a_bare_result_that_any_dimension_would_do_for_reports_its_plain_one),
        cmocka_unit_test(an_expression_of_constants_is_one_number),
        cmocka_unit_test(a_constant_needs_no_text),
        cmocka_unit_test(an_expression_knows_its_variables),
        cmocka_unit_test(a_relation_yields_both_sides),
        cmocka_unit_test(without_a_relation_there_is_one_side),
        cmocka_unit_test(a_wrong_relation_is_refused_where_it_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
