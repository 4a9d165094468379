/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dimensions and units.
 */
#include "expr_scope.h"

/* ---- dimensions */

static void square_cube_and_fourth_roots_of_dimensions_are_exact(void **state)
{
    (void)state;
    struct dim root;
    for (int degree = 2; degree <= 4; degree++) {
        assert_true(dim_power(DIM_FORCE, 1, degree, &root));
        assert_true(dim_power(root, degree, 1, &root));
        assert_true(dim_equal(root, DIM_FORCE));
    }
}

static void a_root_that_is_no_twelfth_is_refused(void **state)
{
    (void)state;
    struct dim root;
    assert_false(dim_power(DIM_LENGTH, 1, 5, &root));
    assert_false(dim_power(DIM_LENGTH, 1, 0, &root));
    assert_false(dim_power(DIM_LENGTH, 100000, 1, &root));
}

static void products_and_quotients_of_dimensions_undo_each_other(void **state)
{
    (void)state;
    assert_true(dim_equal(dim_times(DIM_MASS, DIM_ACCELERATION), DIM_FORCE));
    assert_true(dim_equal(dim_over(DIM_MOMENT, DIM_LENGTH), DIM_FORCE));
    assert_true(dim_equal(dim_over(DIM_FORCE, DIM_FORCE), DIM_NONE));
}

static void an_absurd_power_saturates_and_does_not_wrap(void **state)
{
    (void)state;
    struct dim power = DIM_LENGTH;
    for (int i = 0; i < 100; i++) power = dim_times(power, power);
    assert_true(power.length > 0);
}

/* ---- reading */

static struct unit read_unit(const char *text, enum unit_system system)
{
    struct unit unit = {.factor = NAN};
    if (!unit_parse(text, strlen(text), system, NULL, (struct pos){1, 1}, &unit))
        fail_msg("`%s` is no unit", text);
    return unit;
}

static void each_unit_has_its_exact_factor(void **state)
{
    (void)state;
    const double lbf = 4.4482216152605, pi = 3.14159265358979323846;
    const struct {
        const char *name;
        struct dim dim;
        double si, us;
    } rows[] = {
        {"m", DIM_LENGTH, 1, 1 / 0.3048},
        {"mm", DIM_LENGTH, 1e-3, 1 / 304.8},
        {"cm", DIM_LENGTH, 1e-2, 1 / 30.48},
        {"km", DIM_LENGTH, 1e3, 1000 / 0.3048},
        {"in", DIM_LENGTH, 0.0254, 1.0 / 12},
        {"ft", DIM_LENGTH, 0.3048, 1},
        {"yd", DIM_LENGTH, 0.9144, 3},
        {"mi", DIM_LENGTH, 1609.344, 5280},
        {"kg", DIM_MASS, 1, 0.3048 / lbf},
        {"g", DIM_MASS, 1e-3, 0.3048e-3 / lbf},
        {"mg", DIM_MASS, 1e-6, 0.3048e-6 / lbf},
        {"t", DIM_MASS, 1e3, 304.8 / lbf},
        {"lbm", DIM_MASS, 0.45359237, 0.3048 / 9.80665},
        {"slug", DIM_MASS, lbf / 0.3048, 1},
        {"s", DIM_TIME, 1, 1},
        {"ms", DIM_TIME, 1e-3, 1e-3},
        {"us", DIM_TIME, 1e-6, 1e-6},
        {"min", DIM_TIME, 60, 60},
        {"h", DIM_TIME, 3600, 3600},
        {"N", DIM_FORCE, 1, 1 / lbf},
        {"mN", DIM_FORCE, 1e-3, 1e-3 / lbf},
        {"kN", DIM_FORCE, 1e3, 1e3 / lbf},
        {"MN", DIM_FORCE, 1e6, 1e6 / lbf},
        {"lbf", DIM_FORCE, lbf, 1},
        {"kip", DIM_FORCE, 1000 * lbf, 1000},
        {"Pa", DIM_PRESSURE, 1, 0.09290304 / lbf},
        {"kPa", DIM_PRESSURE, 1e3, 92.90304 / lbf},
        {"MPa", DIM_PRESSURE, 1e6, 92903.04 / lbf},
        {"GPa", DIM_PRESSURE, 1e9, 92903040 / lbf},
        {"psi", DIM_PRESSURE, lbf / 0.00064516, 144},
        {"J", DIM_MOMENT, 1, 1 / (0.3048 * lbf)},
        {"kJ", DIM_MOMENT, 1e3, 1e3 / (0.3048 * lbf)},
        {"W", DIM_POWER, 1, 1 / (0.3048 * lbf)},
        {"kW", DIM_POWER, 1e3, 1e3 / (0.3048 * lbf)},
        {"hp", DIM_POWER, 550 * 0.3048 * lbf, 550},
        {"rad", DIM_NONE, 1, 1},
        {"deg", DIM_NONE, pi / 180, pi / 180},
        {"rev", DIM_NONE, 2 * pi, 2 * pi},
        {"rpm", DIM_RATE, 2 * pi / 60, 2 * pi / 60},
        {"Hz", DIM_RATE, 1, 1},
        {"1", DIM_NONE, 1, 1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct unit si = read_unit(rows[i].name, unit_si), us = read_unit(rows[i].name, unit_us);
        assert_true(dim_equal(si.dim, rows[i].dim) && dim_equal(us.dim, rows[i].dim));
        /* The reference is itself rounded up to three times. */
        assert_true(fabs(si.factor / rows[i].si - 1) < 4 * 2.3e-16);
        assert_true(fabs(us.factor / rows[i].us - 1) < 4 * 2.3e-16);
    }
}

static void units_of_one_system_convert_without_rounding(void **state)
{
    (void)state;
    const struct {
        const char *text;
        enum unit_system system;
        double factor;
    } rows[] = {
        {"slug*ft/s^2", unit_us, 1},  {"lbf*s^2/ft", unit_us, 1},
        {"lbf/in", unit_us, 12},      {"lbf/in^2", unit_us, 144},
        {"in^2", unit_us, 1.0 / 144}, {"kip/in", unit_us, 12000},
        {"in^-1", unit_us, 12},       {"mi/h", unit_us, 5280.0 / 3600},
        {"hp", unit_us, 550},         {"N*m/rad", unit_si, 1},
        {"kg*m/s^2", unit_si, 1},     {"N/mm", unit_si, 1000},
        {"kN/mm", unit_si, 1e6},      {"N/mm^2", unit_si, 1e6},
        {"g/cm^3", unit_si, 1000},    {"km/h", unit_si, 1000.0 / 3600},
        {"J/kg", unit_si, 1},         {"W*s", unit_si, 1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_true(read_unit(rows[i].text, rows[i].system).factor == rows[i].factor);
}

static void products_may_be_written_in_several_ways(void **state)
{
    (void)state;
    const char *const texts[] = {"N*m*s/rad",         "N.m.s/rad",     "N m s/rad", "N*m/rad*s",
                                 " N * m * s / rad ", "(N*m)*s/(rad)", "N/(1/m)*s", "kg*m^2/s",
                                 "kg m^2 s^-1",       "kg*m^+2*s^-1",  "J s"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct unit unit = read_unit(texts[i], unit_si);
        assert_true(dim_equal(unit.dim, DIM_ANGULAR_DAMPING));
        assert_true(unit.factor == 1);
    }
}

static void division_goes_from_left_to_right(void **state)
{
    (void)state;
    assert_true(dim_equal(read_unit("N/m/s", unit_si).dim, read_unit("N/(m*s)", unit_si).dim));
    assert_true(dim_equal(read_unit("1/s", unit_si).dim, DIM_RATE));
}

static void a_unit_knows_whether_it_names_an_angle_or_hertz(void **state)
{
    (void)state;
    assert_true(read_unit("deg/s", unit_si).angle);
    assert_true(read_unit("rpm", unit_si).angle);
    assert_true(read_unit("N*m/rad", unit_si).angle);
    assert_false(read_unit("N*m", unit_si).angle);
    assert_true(read_unit("rev*Hz", unit_si).hertz);
    assert_false(read_unit("1/s", unit_si).hertz);
}

/* ---- what is no unit */

struct wrong {
    const char *text, *id;
    int column;
    const char *hint; /* a part of it */
};

static const struct wrong wrongs[] = {
    {"mph", "unknown-unit", 1, "mi/h"},
    {"MPH", "unknown-unit", 1, "mi/h"},
    {"lb", "unknown-unit", 1, "`lbf` for a force, `lbm` for a mass"},
    {"ft*lb", "unknown-unit", 4, "lbf"},
    {"oz", "unknown-unit", 1, "0.0625 lbf"},
    {"Nm", "unknown-unit", 1, "N*m"},
    {"degree", "unknown-unit", 1, "`deg`"},
    {"Degrees", "unknown-unit", 1, "`deg`"},
    {"m/sec", "unknown-unit", 3, "`s`"},
    {"kph", "unknown-unit", 1, "km/h"},
    {"kmh", "unknown-unit", 1, "km/h"},
    {"KG", "unknown-unit", 1, "`kg`"},
    {"inches", "unknown-unit", 1, "`in`"},
    {"newtons", "unknown-unit", 1, "`N`"},
    {"kgf", "unknown-unit", 1, "9.80665 N"},
    {"slgu", "unknown-unit", 1, "`slug`"},
    {"ms-2", "unit-syntax", 3, "m/s^2"},
    {"ms-1", "unit-syntax", 3, "m/s`"},
    {"kg m-3", "unit-syntax", 5, "m^-3"},
    {"N-m", "unit-syntax", 2, "N*m"},
    {"m/s2", "unit-syntax", 4, "s^2"},
    {"m^0.5", "unit-syntax", 3, "whole numbers"},
    {"m^(1/2)", "unit-syntax", 3, "whole numbers"},
    {"m^", "unit-syntax", 3, "whole numbers"},
    {"m**2", "unit-syntax", 2, "`^`"},
    {"m²", "unit-syntax", 2, "^2"},
    {"N·m", "unit-syntax", 2, "*"},
    {"N·µs", "unit-syntax", 2, "*"},
    {"°", "unit-syntax", 1, "deg"},
    {"µs", "unit-syntax", 1, "`us`"},
    {"2 m", "unit-syntax", 1, "number before the unit"},
    {"12", "unit-syntax", 1, "number before the unit"},
    {"%", "unit-syntax", 1, "0.05"},
    {"m^99", "unit-syntax", 3, NULL},
    {"", "unit-syntax", 1, "leave the brackets out"},
    {"N*", "unit-syntax", 3, NULL},
    {"N**m", "unit-syntax", 2, NULL},
    {"N/", "unit-syntax", 3, NULL},
    {"(N", "unit-syntax", 3, NULL},
    {"N)", "unit-syntax", 2, NULL},
    {"((((((((((((((((((((((N))))))))))))))))))))))", "unit-syntax", 21, NULL},
    {"km^12*km^12*km^12*km^12*km^12*km^12*km^12*km^12*km^12", "unit-syntax", 54, NULL},
};

static void what_is_no_unit_is_refused_at_its_column_with_a_hint(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrongs / sizeof wrongs[0]; i++) {
        const struct wrong *w = &wrongs[i];
        struct unit unit;
        fbd_errors *errors = fbd_errors_new();
        assert_false(unit_parse(w->text, strlen(w->text), unit_si, errors, (struct pos){7, 1}, &unit));
        assert_int_equal(fbd_errors_count(errors), 1);
        const fbd_error note = fbd_errors_get(errors, 0);
        bool hinted = !w->hint || (note.hint && strstr(note.hint, w->hint));
        if (strcmp(note.id, w->id) != 0 || note.line != 7 || note.column != w->column || !hinted) {
            fbd_errors_print(errors, stdout);
            fail_msg("`%s` should give %s at column %d with the hint `%s`", w->text, w->id, w->column,
                     w->hint ? w->hint : "");
        }
        fbd_errors_free(errors);
        assert_false(unit_parse(w->text, strlen(w->text), unit_si, NULL, (struct pos){1, 1}, &unit));
    }
}

/* ---- writing */

static void coherent_units_are_written_as_engineers_write_them(void **state)
{
    (void)state;
    const struct {
        struct dim dim;
        const char *si, *us;
    } rows[] = {
        {DIM_NONE, "", ""},
        {DIM_VELOCITY, "m/s", "ft/s"},
        {DIM_RATE, "rad/s", "rad/s"},
        {DIM_FORCE, "N", "lbf"},
        {DIM_MOMENT, "N*m", "lbf*ft"},
        {DIM_POWER, "W", "lbf*ft/s"},
        {DIM_INERTIA, "kg*m^2", "slug*ft^2"},
        {DIM_STIFFNESS, "N/m", "lbf/ft"},
        {DIM_DAMPING, "N*s/m", "lbf*s/ft"},
        {DIM_ANGULAR_DAMPING, "N*m*s", "lbf*ft*s"},
        {DIM_QUADRATIC_DRAG, "kg/m", "slug/ft"},
        {DIM_PRESSURE, "Pa", "lbf/ft^2"},
        {DIM(1, 0, -3), "N/(m*s)", "lbf/(ft*s)"},
        {DIM(0, 0, -3), "1/s^3", "1/s^3"},
        {{0, dim_unit / 2, 0, 0, 0}, "m^(1/2)", "ft^(1/2)"},
        {DIM_ALL(0, 0, 0, 1, 0), "A", "A"},
        {DIM_ALL(1, 2, -3, -1, 0), "V", "lbf*ft/(s*A)"},
        {DIM_ALL(1, 2, -3, -2, 0), "ohm", "lbf*ft/(s*A^2)"},
        {DIM_ALL(1, 2, -2, 0, -1), "N*m/K", "lbf*ft/K"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[64];
        unit_name(rows[i].dim, unit_si, text, sizeof text);
        assert_string_equal(text, rows[i].si);
        unit_name(rows[i].dim, unit_us, text, sizeof text);
        assert_string_equal(text, rows[i].us);
    }
}

static void a_written_unit_reads_back_with_factor_one(void **state)
{
    (void)state;
    for (int mass = -2; mass <= 2; mass++)
        for (int length = -4; length <= 4; length++)
            for (int time = -4; time <= 4; time++)
                for (int system = unit_si; system <= unit_us; system++) {
                    char text[64];
                    struct dim dim = {(short)(mass * dim_unit), (short)(length * dim_unit),
                                      (short)(time * dim_unit), 0, 0};
                    unit_name(dim, (enum unit_system)system, text, sizeof text);
                    if (!text[0]) continue;
                    struct unit unit = read_unit(text, (enum unit_system)system);
                    assert_true(dim_equal(unit.dim, dim));
                    assert_true(unit.factor == 1);
                }
}

static void every_example_of_a_dimension_has_that_dimension(void **state)
{
    (void)state;
    int found = 0;
    for (int mass = 0; mass <= 1; mass++)
        for (int length = -3; length <= 3; length++)
            for (int time = -3; time <= 2; time++) {
                char examples[200];
                struct dim dim = {(short)(mass * dim_unit), (short)(length * dim_unit),
                                  (short)(time * dim_unit), 0, 0};
                unit_examples(dim, examples, sizeof examples);
                assert_true((unit_quantity(dim) != NULL) == (examples[0] != '\0'));
                for (char *word = strtok(examples, ","); word; word = strtok(NULL, ",")) {
                    assert_true(dim_equal(read_unit(word, unit_si).dim, dim));
                    found++;
                }
            }
    assert_true(found > 60);
}

static void a_short_buffer_is_never_overrun(void **state)
{
    (void)state;
    char text[4] = "###";
    unit_name(DIM_INERTIA, unit_us, text, sizeof text);
    assert_string_equal(text, "slu");
    unit_name(DIM_INERTIA, unit_us, text, 0);
    assert_string_equal(text, "slu");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(square_cube_and_fourth_roots_of_dimensions_are_exact),
        cmocka_unit_test(a_root_that_is_no_twelfth_is_refused),
        cmocka_unit_test(products_and_quotients_of_dimensions_undo_each_other),
        cmocka_unit_test(an_absurd_power_saturates_and_does_not_wrap),
        cmocka_unit_test(each_unit_has_its_exact_factor),
        cmocka_unit_test(units_of_one_system_convert_without_rounding),
        cmocka_unit_test(products_may_be_written_in_several_ways),
        cmocka_unit_test(division_goes_from_left_to_right),
        cmocka_unit_test(a_unit_knows_whether_it_names_an_angle_or_hertz),
        cmocka_unit_test(what_is_no_unit_is_refused_at_its_column_with_a_hint),
        cmocka_unit_test(coherent_units_are_written_as_engineers_write_them),
        cmocka_unit_test(a_written_unit_reads_back_with_factor_one),
        cmocka_unit_test(every_example_of_a_dimension_has_that_dimension),
        cmocka_unit_test(a_short_buffer_is_never_overrun),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
