/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Texts that are wrong: which error, at which column, with what advice.
 */
#include "expr_scope.h"

#include <stdio.h>

struct wrong {
    const char *text, *id;
    int column;
    const char *says; /* a part of the message or of the hint; NULL for any */
};

static bool matches(const fbd_error *note, const struct wrong *w)
{
    if (strcmp(note->id, w->id) != 0 || note->line != 1 || note->column != w->column) return false;
    return !w->says || strstr(note->message, w->says) || (note->hint && strstr(note->hint, w->says));
}

/* The first note must be the one described; a warning leaves an expression, an error does not. */
static void check(const struct wrong *rows, size_t count, const struct expr_want *want)
{
    for (size_t i = 0; i < count; i++) {
        struct trial trial = try_text(rows[i].text, want, unit_si);
        const fbd_error note = fbd_errors_get(trial.errors, 0);
        bool compiled = trial.expr != NULL, failed = fbd_errors_failed_count(trial.errors) > 0;
        if (!note.id || !matches(&note, &rows[i]) || compiled == failed) {
            fbd_errors_print(trial.errors, stdout);
            fail_msg("`%s` should give %s at column %d: %s", rows[i].text, rows[i].id, rows[i].column,
                     rows[i].says ? rows[i].says : "");
        }
        end_trial(&trial);
    }
}

#define CHECK(rows, want) check((rows), sizeof(rows) / sizeof((rows)[0]), (want))

static const struct expr_want a_force = {.dim = DIM_INIT(1, 1, -2), .what = "value"};

/* ---- syntax */

static void what_is_no_expression_is_refused_where_it_goes_wrong(void **state)
{
    (void)state;
    const struct wrong rows[] = {
        {"", "expression-syntax", 1, "an expression is missing"},
        {"  ", "expression-syntax", 3, "an expression is missing"},
        {"F +", "expression-syntax", 4, "a value is missing"},
        {"* F", "expression-syntax", 1, "a value is missing before `*`"},
        {"F + * F", "expression-syntax", 5, "a value is missing before `*`"},
        {"F F", "expression-syntax", 3, "written with `*`"},
        {"F 2", "expression-syntax", 3, "written with `*`"},
        {"F (2)", "unknown-function", 1, "F*(...)"},
        {"2 F", "expression-syntax", 3, "2*F"},
        {"2F", "expression-syntax", 2, "2*F"},
        {"2 pi", "expression-syntax", 3, "2*pi"},
        {"2 sin(t)", "expression-syntax", 3, "2*sin"},
        {"2(F)", "expression-syntax", 2, "written with `*`"},
        {"(F)(F)", "expression-syntax", 4, "written with `*`"},
        {"(F", "expression-syntax", 3, "`)` is missing"},
        {"F)", "expression-syntax", 2, "`)` without `(`"},
        {"()", "expression-syntax", 2, "a value is missing"},
        {"sin(theta", "expression-syntax", 10, "`)` is missing"},
        {"max(F,,F)", "expression-syntax", 7, "a value is missing"},
        {"1,5", "expression-syntax", 2, "a decimal point is written `.`"},
        {"1_000", "expression-syntax", 2, "1000"},
        {"1.2.3", "expression-syntax", 4, NULL},
        {"F**2", "expression-syntax", 2, "`^`"},
        {"F = 3", "expression-syntax", 3, "`==`"},
        {"F != 3", "expression-syntax", 3, "not (a == b)"},
        {"F <> 3", "expression-syntax", 3, "not (a == b)"},
        {"F > 1 && F < 2", "expression-syntax", 7, "`and`"},
        {"F > 1 || F < 2", "expression-syntax", 7, "`or`"},
        {"F > 1 AND F < 2", "expression-syntax", 7, "`and`"},
        {"|F|", "expression-syntax", 1, "abs(x)"},
        {"!F", "expression-syntax", 1, "`not`"},
        {"7 % 3", "expression-syntax", 3, "mod(a, b)"},
        {"F > 1 ? 2 : 3", "expression-syntax", 7, "if(condition, a, b)"},
        {"1:30", "expression-syntax", 2, "90 s"},
        {"F;", "expression-syntax", 2, NULL},
        {"F'", "expression-syntax", 2, NULL},
        {"F $ 2", "expression-syntax", 3, NULL},
        {"1 < 2 < 3", "expression-syntax", 7, "a < b and b < c"},
        {"F and", "expression-syntax", 6, "a value is missing"},
        {"F + not F", "expression-syntax", 5, "a value is missing"},
        {"F[N]", "expression-syntax", 2, "*1[N]"},
        {"[N]", "expression-syntax", 1, "a number is missing"},
        {"5[N", "expression-syntax", 2, "without `]`"},
        {"5]", "expression-syntax", 2, NULL},
        {"F\x01", "expression-syntax", 2, "0x01"},
        {"F\xff", "expression-syntax", 2, "0xFF"},
    };
    CHECK(rows, &a_force);
}

static void pasted_signs_are_named_with_what_to_type(void **state)
{
    (void)state;
    const struct wrong rows[] = {
        {"F*cos(θ)", "expression-syntax", 7, "`theta`"},
        {"F·2", "expression-syntax", 2, "`*`"},
        {"F×2", "expression-syntax", 2, "`*`"},
        {"F − 3", "expression-syntax", 3, "`-`"},
        {"F÷2", "expression-syntax", 2, "`/`"},
        {"F²", "expression-syntax", 2, "`^2`"},
        {"F*π", "expression-syntax", 3, "`pi`"},
        {"µ*F", "expression-syntax", 1, "`mu`"},
        {"30°", "expression-syntax", 3, "`deg`"},
        {"F ≤ 3", "expression-syntax", 3, "`<=`"},
        {"F +\u00A02", "expression-syntax", 4, "no-break"},
        {"√(F)", "expression-syntax", 1, "sqrt"},
        {"F + ☃", "expression-syntax", 5, "☃"},
    };
    CHECK(rows, &a_force);
}

static void columns_count_characters_not_bytes(void **state)
{
    (void)state;
    struct trial trial = try_text("5[N·m] + foo", &a_force, unit_si);
    assert_int_equal(fbd_errors_count(trial.errors), 2);
    assert_int_equal(fbd_errors_get(trial.errors, 0).column, 4);
    assert_int_equal(fbd_errors_get(trial.errors, 1).column, 10);
    end_trial(&trial);
    /* What stands before the text in its line is the caller's column. */
    fbd_errors *errors = fbd_errors_new();
    struct arena arena = {0};
    struct scope scope = {.lookup = scope_lookup, .names = scope_list, .units = unit_si};
    assert_null(expr_compile(&arena, "F + foo", (struct pos){12, 40}, &scope, &a_force, errors));
    assert_int_equal(fbd_errors_get(errors, 0).line, 12);
    assert_int_equal(fbd_errors_get(errors, 0).column, 44);
    fbd_errors_free(errors);
    arena_free(&arena);
}

/* ---- names */

static void unknown_names_come_with_the_nearest_one(void **state)
{
    (void)state;
    const struct wrong rows[] = {
        {"F*cos(tetha)", "unknown-name", 7, "`theta`"},
        {"F*crank.teta", "unknown-name", 3, "`crank.theta`"},
        {"5*N", "unknown-name", 3, "5[N]"},
        {"F*e", "unknown-name", 3, "exp(1)"},
        {"F*PI", "unknown-name", 3, "`pi`"},
        {"F*sin theta", "unknown-name", 3, "sin(...)"},
        {"F*sn(theta)", "unknown-function", 3, "`sin`"},
        {"F*arcsin(0.5)", "unknown-function", 3, "`asin`"},
        {"F*sgn(v)", "unknown-function", 3, "`sign`"},
        {"F*theta(t)", "unknown-function", 3, "theta*(...)"},
    };
    CHECK(rows, &a_force);
}

static void a_name_that_failed_before_is_not_reported_again(void **state)
{
    (void)state;
    struct trial trial = try_text("F + secret*sin(secret) + x*secret^v + sin(t)", &a_force, unit_si);
    assert_null(trial.expr);
    assert_int_equal(fbd_errors_count(trial.errors), 1); /* sin(t) */
    end_trial(&trial);
    trial = try_text("if(secret > 3 and not secret < F, F, max(secret, x))", &a_force, unit_si);
    assert_null(trial.expr);
    assert_int_equal(fbd_errors_count(trial.errors), 0);
    end_trial(&trial);
}

static void all_errors_of_names_and_dimensions_are_found_at_once(void **state)
{
    (void)state;
    struct trial trial = try_text("foo + F*sin(t) + (F + x)*bar(2) + min(F) + 3[furlong]", &a_force, unit_si);
    const char *const ids[] = {"unknown-name",     "wrong-dimension", "wrong-dimension",
                               "unknown-function", "argument-count",  "unknown-unit"};
    const int columns[] = {1, 13, 21, 26, 35, 46};
    assert_null(trial.expr);
    assert_int_equal(fbd_errors_count(trial.errors), 6);
    for (size_t i = 0; i < 6; i++) {
        assert_string_equal(fbd_errors_get(trial.errors, i).id, ids[i]);
        assert_int_equal(fbd_errors_get(trial.errors, i).column, columns[i]);
    }
    end_trial(&trial);
}

static void the_number_of_arguments_is_checked(void **state)
{
    (void)state;
    const struct wrong rows[] = {
        {"sin()", "argument-count", 1, "takes 1 argument, not none"},
        {"F*sin(1, 2)", "argument-count", 3, "takes 1 argument, not 2"},
        {"F*atan2(1)", "argument-count", 3, "atan2(y, x)"},
        {"min(F)", "argument-count", 1, "at least 2 arguments, not 1"},
        {"F*pulse(t, 3)", "argument-count", 3, "pulse(t, start, width)"},
        {"if()", "argument-count", 1, "not none"},
        {"if(x > 0)", "argument-count", 1, "not 1"},
        {"if(x > 0, F)", "argument-count", 1, "if(condition, a, b)"},
        {"if(x > 0, F, F, F)", "argument-count", 1, "not 4"},
        {"max(1,2,3,4,5,6,7,8,9)", "argument-count", 1, "not 9"},
    };
    CHECK(rows, &a_force);
}

/* ---- dimensions */

static void dimensions_that_do_not_fit_are_named(void **state)
{
    (void)state;
    const struct wrong rows[] = {
        {"F + x", "wrong-dimension", 3, "cannot add force [N] and length [m]"},
        {"F + x", "wrong-dimension", 3, "stiffness [N/m] times length is force"},
        {"F - m", "wrong-dimension", 3, "cannot subtract mass [kg] from force [N]"},
        {"F - m", "wrong-dimension", 3, "acceleration [m/s^2] times mass is force"},
        {"F + c*x", "wrong-dimension", 3, "momentum or impulse [N*s]"},
        {"F*(x + cos(theta))", "wrong-dimension", 6, "1[m]"},
        {"F*x + k", "wrong-dimension", 5, "moment or energy [N*m]"},
        {"F*if(x < v, 1, 2)", "wrong-dimension", 8, "cannot compare length [m] with velocity [m/s]"},
        {"max(F, x)", "wrong-dimension", 8, "cannot give `max` force [N] and length [m]"},
        {"clamp(F, -3, x)", "wrong-dimension", 14, "`clamp`"},
        {"F*atan2(x, v)", "wrong-dimension", 12, "`atan2`"},
        {"F*pulse(t, x, 1)", "wrong-dimension", 12, "`pulse`"},
        {"if(x > 0, F, x)", "wrong-dimension", 14, "cannot choose between force [N] and length [m]"},
        {"F*sin(t)", "wrong-dimension", 7, "2[rad/s]*t"},
        {"F*exp(x)", "wrong-dimension", 7, "1[m]"},
        {"F*floor(t)", "wrong-dimension", 9, "not time [s]"},
        {"F*square(t)", "wrong-dimension", 10, "t/3[s]"},
        {"F*2^x", "wrong-dimension", 5, "an exponent must be a pure number, not length [m]"},
        {"F*x^theta", "wrong-dimension", 5, "the exponent of length [m] must be a number"},
        {"F*x^0.123", "wrong-dimension", 5, "cannot be raised"},
        {"F*x^100^2", "wrong-dimension", 8, "cannot be raised"},
        {"x", "wrong-dimension", 1, "`value` needs force [N], not length [m]"},
        {"m*v/x", "wrong-dimension", 4, "units of force: N, kN, lbf, kip"},
        {"sin(theta)", "wrong-dimension", 1, "1[N]"},
        {"-x", "wrong-dimension", 1, "length [m]"},
        {"x^2", "wrong-dimension", 2, "area [m^2]"},
        {"pow(x, 2)", "wrong-dimension", 1, "area [m^2]"},
    };
    CHECK(rows, &a_force);
}

static void conditions_and_numbers_are_not_mixed(void **state)
{
    (void)state;
    const struct wrong rows[] = {
        {"x < 3", "expression-syntax", 3, "if(condition, 1, 0)"},
        {"if(x, F, F)", "expression-syntax", 4, "`x > 0`"},
        {"F*(x < 3)", "expression-syntax", 6, "where a number is needed"},
        {"-(x < 3)", "expression-syntax", 5, "where a number is needed"},
        {"abs(x < 3)", "expression-syntax", 7, "where a number is needed"},
        {"if(x and v > 0, F, F)", "expression-syntax", 4, "where a condition is needed"},
        {"if(not F, F, F)", "expression-syntax", 8, "where a condition is needed"},
        {"if(x < 0, F, x < 0)", "expression-syntax", 16, "where a number is needed"},
        {"not x < 3", "expression-syntax", 1, "where a number is needed"},
    };
    CHECK(rows, &a_force);
    const struct expr_want condition = {.condition = true, .any_dim = true, .what = "when"};
    const struct wrong numbers[] = {{"x - 3", "expression-syntax", 3, "where a condition is needed"},
                                    {"5 N", "expression-syntax", 3, "where a condition is needed"}};
    CHECK(numbers, &condition);
    struct trial trial = try_text("x < 3 and not v > 0", &condition, unit_si);
    assert_non_null(trial.expr);
    end_trial(&trial);
}

/* ---- quantities and units */

static void a_unit_inside_an_expression_needs_brackets(void **state)
{
    (void)state;
    const struct wrong rows[] = {
        {"5 N + F", "unit-needs-brackets", 3, "5[N]"},
        {"F + 5 N", "unit-needs-brackets", 7, "5[N]"},
        {"3 kN*m/2[m]", "unit-needs-brackets", 3, "3[kN*m]"},
        {"F*sin(30 deg)", "unit-needs-brackets", 10, "30[deg]"},
        {"2 m*foo", "unknown-unit", 5, NULL},
        {"F + 2 m", "unit-needs-brackets", 7, "`2[m]`, or `2*m`"},
        {"5[furlong]", "unknown-unit", 3, NULL},
        {"5[N-m]", "unit-syntax", 4, "N*m"},
        {"5[]", "unit-syntax", 3, "leave the brackets out"},
    };
    CHECK(rows, &a_force);
}

static void a_wrong_unit_of_a_whole_scalar_is_a_wrong_unit(void **state)
{
    (void)state;
    const struct wrong rows[] = {
        {"10 mph", "unknown-unit", 4, "mi/h"},    {"-10 mph", "unknown-unit", 5, "mi/h"},
        {"5 lb", "unknown-unit", 3, "lbf"},       {"5 ft*lb", "unknown-unit", 6, "lbf"},
        {"9.81 ms-2", "unit-syntax", 8, "m/s^2"}, {"9.81 m/s2", "unit-syntax", 9, "s^2"},
        {"9.81 m/s²", "unit-syntax", 9, "^2"},    {"5 m^0.5", "unit-syntax", 5, "whole numbers"},
        {"5 N·m", "unit-syntax", 4, "*"},         {"30 degrees", "unknown-unit", 4, "`deg`"},
        {"5 Nm", "unknown-unit", 3, "N*m"},
    };
    CHECK(rows, &a_force);
}

static void a_quantity_of_the_wrong_dimension_is_explained(void **state)
{
    (void)state;
    const struct wrong forces[] = {
        {"4 N*t", "time-as-unit", 3, "`4[N/s]*t`"},        {"4 N/s*t", "time-as-unit", 3, "`4[N/s]*t`"},
        {"4 N t", "time-as-unit", 3, "`4[N/s]*t`"},        {"5 t", "time-as-unit", 3, "`5*t`"},
        {"4 N/t", "time-as-unit", 3, "`4[N*s]/t`"},        {"2 kg", "wrong-dimension", 3, "units of force"},
        {"30 deg", "wrong-dimension", 4, "a pure number"},
    };
    CHECK(forces, &a_force);
    const struct expr_want damping = {.dim = DIM_DAMPING, .what = "coefficient"};
    const struct wrong dampings[] = {{"3 N/m/s", "wrong-dimension", 3, "`N*s/m`"},
                                     {"3 N/m", "wrong-dimension", 3,
                                      "`coefficient` needs damping or flow of mass [N*s/m]"}};
    CHECK(dampings, &damping);
    const struct expr_want gravity = {.dim = DIM_ACCELERATION, .what = "gravity"};
    const struct wrong gravities[] = {{"1 g", "wrong-dimension", 3, "9.80665 m/s^2"}};
    CHECK(gravities, &gravity);
    const struct expr_want pure = {.dim = DIM_NONE, .what = "friction.static"};
    const struct wrong pures[] = {
        {"0.5 N", "wrong-dimension", 5, "`friction.static` needs a pure number, not force [N]"}};
    CHECK(pures, &pure);
}

/* ---- values */

static void what_must_be_constant_may_not_vary(void **state)
{
    (void)state;
    const struct expr_want constant = {.dim = DIM_MASS, .constant = true, .what = "mass"};
    const struct wrong rows[] = {
        {"m*sin(theta)", "not-constant", 7, "`theta` changes with the motion"},
        {"2[kg/s]*t", "not-constant", 9, "`t` is the time"},
    };
    CHECK(rows, &constant);
}

static void a_constant_part_without_a_finite_value_is_refused(void **state)
{
    (void)state;
    const struct wrong rows[] = {
        {"1/0", "not-finite", 2, NULL},
        {"F*(1 + 1/(1/0))", "not-finite", 12, NULL},
        {"F/zero + F", "not-finite", 2, NULL},
        {"F*sqrt(-1)", "not-finite", 3, NULL},
        {"F*ln(zero)", "not-finite", 3, NULL},
        {"F*0^-1", "not-finite", 4, NULL},
        {"1e999", "not-finite", 1, "1e999"},
        {"F*(2 + 1e999)", "not-finite", 8, NULL},
        {"1e308[GPa]*x*x", "not-finite", 1, NULL},
        {"1e308 MN", "not-finite", 1, NULL},
        {"1e999 N", "not-finite", 1, NULL},
        {"if(x > 0, F, F/zero)", "not-finite", 15, NULL},
        {"x*F/x + F*mod(1, 0)", "not-finite", 11, NULL},
    };
    CHECK(rows, &a_force);
}

static void a_bare_angle_beyond_one_turn_is_doubted(void **state)
{
    (void)state;
    const struct expr_want angle = {.dim = DIM_NONE, .angle = true, .what = "angle"};
    const struct wrong doubtful[] = {{"30", "bare-angle", 1, "30 deg"},
                                     {"-7", "bare-angle", 1, "30 deg"},
                                     {"90/2", "bare-angle", 3, "30 deg"}};
    CHECK(doubtful, &angle);
    const char *const fine[] = {"30 deg", "720 deg",      "6.28",   "-6.2831853",
                                "5*pi/2", "2*theta + 30", "30[deg]"};
    for (size_t i = 0; i < sizeof fine / sizeof fine[0]; i++) {
        struct trial trial = try_text(fine[i], &angle, unit_si);
        assert_non_null(trial.expr);
        assert_int_equal(fbd_errors_count(trial.errors), 0);
        end_trial(&trial);
    }
}

static void hertz_for_an_angular_velocity_is_doubted(void **state)
{
    (void)state;
    const struct expr_want rate = {.dim = DIM_RATE, .what = "omega"};
    const struct wrong doubtful[] = {{"5 Hz", "hertz-as-rate", 3, "rev/s"}};
    CHECK(doubtful, &rate);
    const char *const fine[] = {"5 rad/s", "300 rpm", "5 rev/s", "5 rev*Hz", "2*pi*5[Hz]", "5 1/s"};
    for (size_t i = 0; i < sizeof fine / sizeof fine[0]; i++) {
        struct trial trial = try_text(fine[i], &rate, unit_si);
        assert_non_null(trial.expr);
        assert_int_equal(fbd_errors_count(trial.errors), 0);
        end_trial(&trial);
    }
}

static void limits_have_their_own_id(void **state)
{
    (void)state;
    char text[20000] = "";
    memset(text, '(', 101);
    const struct wrong deep[] = {{text, "expression-too-long", 101, "100 deep"}};
    CHECK(deep, &a_force);
    snprintf(text, sizeof text, "F%16384s", "+F");
    const struct wrong wide[] = {{text, "expression-too-long", 1, "16384 characters"}};
    CHECK(wide, &a_force);
    int used = snprintf(text, sizeof text, "k*x");
    for (int i = 0; i < 2048; i++) used += snprintf(text + used, sizeof text - (size_t)used, "+k*x");
    const struct wrong many[] = {{text, "expression-too-long", 1, "4096 operations"}};
    CHECK(many, &a_force);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_no_expression_is_refused_where_it_goes_wrong),
        cmocka_unit_test(pasted_signs_are_named_with_what_to_type),
        cmocka_unit_test(columns_count_characters_not_bytes),
        cmocka_unit_test(unknown_names_come_with_the_nearest_one),
        cmocka_unit_test(a_name_that_failed_before_is_not_reported_again),
        cmocka_unit_test(all_errors_of_names_and_dimensions_are_found_at_once),
        cmocka_unit_test(the_number_of_arguments_is_checked),
        cmocka_unit_test(dimensions_that_do_not_fit_are_named),
        cmocka_unit_test(conditions_and_numbers_are_not_mixed),
        cmocka_unit_test(a_unit_inside_an_expression_needs_brackets),
        cmocka_unit_test(a_wrong_unit_of_a_whole_scalar_is_a_wrong_unit),
        cmocka_unit_test(a_quantity_of_the_wrong_dimension_is_explained),
        cmocka_unit_test(what_must_be_constant_may_not_vary),
        cmocka_unit_test(a_constant_part_without_a_finite_value_is_refused),
        cmocka_unit_test(a_bare_angle_beyond_one_turn_is_doubted),
        cmocka_unit_test(hertz_for_an_angular_velocity_is_doubted),
        cmocka_unit_test(limits_have_their_own_id),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
