/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/unit_table.h"

#include <string.h>

/* All factors follow from three definitions (NIST SP 811, appendix B):
 *
 *     1 ft = 0.3048 m,   1 lbm = 0.45359237 kg,   1 lbf = 1 lbm * 9.80665 m/s^2 = 4.4482216152605 N.
 *
 * The slug is the mass that 1 lbf accelerates at 1 ft/s^2: 4.4482216152605/0.3048 kg. Decimal fractions are
 * scaled to whole numbers that a double holds exactly, so each quotient is rounded once. */
#define LBF_E13    44482216152605.0    /* lbf in N, times 10^13 */
#define LBF_FT_E16 13558179483314004.0 /* ft*lbf in J, times 10^16: 2^2 * 3389544870828501, exact */
#define HP_IN_W    745.69987158227022  /* 550 ft*lbf/s */
#define PI         3.14159265358979323846

#define LENGTH   DIM_INIT(0, 1, 0)
#define MASS     DIM_INIT(1, 0, 0)
#define TIME     DIM_INIT(0, 0, 1)
#define FORCE    DIM_INIT(1, 1, -2)
#define PRESSURE DIM_INIT(1, -1, -2)
#define ENERGY   DIM_INIT(1, 2, -2)
#define POWER    DIM_INIT(1, 2, -3)
#define RATE     DIM_INIT(0, 0, -1)
#define ANGLE    DIM_INIT(0, 0, 0)
#define CURRENT  DIM_ALL(0, 0, 0, 1, 0)
#define VOLTAGE  DIM_ALL(1, 2, -3, -1, 0)

#define SAME(over, under)                                                                                    \
    {                                                                                                        \
        {(over), (under)},                                                                                   \
        {                                                                                                    \
            (over), (under)                                                                                  \
        }                                                                                                    \
    }

static const struct unit_row table[] = {
    /* name, dimension, {factor in SI, factor in US}, names an angle */
    {"m", LENGTH, {{1, 1}, {1e4, 3048}}, false},
    {"mm", LENGTH, {{1, 1000}, {10, 3048}}, false},
    {"cm", LENGTH, {{1, 100}, {100, 3048}}, false},
    {"km", LENGTH, {{1000, 1}, {1e7, 3048}}, false},
    {"in", LENGTH, {{254, 1e4}, {1, 12}}, false},
    {"ft", LENGTH, {{3048, 1e4}, {1, 1}}, false},
    {"yd", LENGTH, {{9144, 1e4}, {3, 1}}, false},
    {"mi", LENGTH, {{1609344, 1000}, {5280, 1}}, false},

    {"kg", MASS, {{1, 1}, {3048e9, LBF_E13}}, false},
    {"g", MASS, {{1, 1000}, {3048e6, LBF_E13}}, false},
    {"mg", MASS, {{1, 1e6}, {3048e3, LBF_E13}}, false},
    {"t", MASS, {{1000, 1}, {3048e12, LBF_E13}}, false},
    {"lbm", MASS, {{45359237, 1e8}, {30480, 980665}}, false},
    {"slug", MASS, {{LBF_E13, 3048e9}, {1, 1}}, false},

    {"s", TIME, SAME(1, 1), false},
    {"ms", TIME, SAME(1, 1000), false},
    {"us", TIME, SAME(1, 1e6), false},
    {"min", TIME, SAME(60, 1), false},
    {"h", TIME, SAME(3600, 1), false},

    {"N", FORCE, {{1, 1}, {1e13, LBF_E13}}, false},
    {"mN", FORCE, {{1, 1000}, {1e10, LBF_E13}}, false},
    {"kN", FORCE, {{1000, 1}, {1e16, LBF_E13}}, false},
    {"MN", FORCE, {{1e6, 1}, {1e19, LBF_E13}}, false},
    {"lbf", FORCE, {{LBF_E13, 1e13}, {1, 1}}, false},
    {"kip", FORCE, {{LBF_E13, 1e10}, {1000, 1}}, false},

    {"Pa", PRESSURE, {{1, 1}, {9290304e5, LBF_E13}}, false},
    {"kPa", PRESSURE, {{1000, 1}, {9290304e8, LBF_E13}}, false},
    {"MPa", PRESSURE, {{1e6, 1}, {9290304e11, LBF_E13}}, false},
    {"GPa", PRESSURE, {{1e9, 1}, {9290304e14, LBF_E13}}, false},
    {"psi", PRESSURE, {{LBF_E13, 64516e5}, {144, 1}}, false},

    {"J", ENERGY, {{1, 1}, {1e16, LBF_FT_E16}}, false},
    {"kJ", ENERGY, {{1000, 1}, {1e19, LBF_FT_E16}}, false},
    {"W", POWER, {{1, 1}, {1e16, LBF_FT_E16}}, false},
    {"kW", POWER, {{1000, 1}, {1e19, LBF_FT_E16}}, false},
    {"hp", POWER, {{HP_IN_W, 1}, {550, 1}}, false},

    {"rad", ANGLE, SAME(1, 1), true},
    {"deg", ANGLE, SAME(PI, 180), true},
    {"rev", ANGLE, SAME(2 * PI, 1), true},
    {"rpm", RATE, SAME(PI, 30), true},
    {"Hz", RATE, SAME(1, 1), false},

    {"A", CURRENT, SAME(1, 1), false},
    {"mA", CURRENT, SAME(1, 1000), false},
    {"V", VOLTAGE, {{1, 1}, {1e16, LBF_FT_E16}}, false},
    {"mV", VOLTAGE, {{1, 1000}, {1e13, LBF_FT_E16}}, false},
    {"ohm", DIM_ALL(1, 2, -3, -2, 0), {{1, 1}, {1e16, LBF_FT_E16}}, false},
    {"H", DIM_ALL(1, 2, -2, -2, 0), {{1, 1}, {1e16, LBF_FT_E16}}, false},
    {"mH", DIM_ALL(1, 2, -2, -2, 0), {{1, 1000}, {1e13, LBF_FT_E16}}, false},
    {"C", DIM_ALL(0, 0, 1, 1, 0), SAME(1, 1), false},

    {"K", DIM_ALL(0, 0, 0, 0, 1), SAME(1, 1), false},
};

enum { row_count = sizeof table / sizeof table[0] };

static bool is_called(const char *name, const char *text, size_t length)
{
    return strlen(name) == length && memcmp(name, text, length) == 0;
}

const struct unit_row *unit_find(const char *name, size_t length)
{
    for (size_t i = 0; i < row_count; i++)
        if (is_called(table[i].name, name, length)) return &table[i];
    return NULL;
}

const struct unit_row *unit_row(size_t index)
{
    return index < row_count ? &table[index] : NULL;
}

/* ---- hints for common spellings */

/* Hints for words whose nearest spelling would mislead (`mph` is no `mg`, `lb` may be a force or a mass). */
static const char *const habits[][2] = {
    {"lb", "`lbf` for a force, `lbm` for a mass"},
    {"lbs", "`lbf` for a force, `lbm` for a mass"},
    {"pound", "`lbf` for a force, `lbm` for a mass"},
    {"pounds", "`lbf` for a force, `lbm` for a mass"},
    {"oz", "an ounce is 0.0625 lbf (force) or 0.0625 lbm (mass)"},
    {"ounce", "an ounce is 0.0625 lbf (force) or 0.0625 lbm (mass)"},
    {"ton", "`t` for 1000 kg; a short ton is 2000 lbm, its weight 2 kip"},
    {"tons", "`t` for 1000 kg; a short ton is 2000 lbm, its weight 2 kip"},
    {"kgf", "1 kgf is 9.80665 N"},
    {"kp", "1 kp is 9.80665 N"},
    {"dyn", "1 dyn is 0.01 mN"},
    {"gee", "standard gravity is 9.80665 m/s^2"},
    {"mph", "write `mi/h`"},
    {"kph", "write `km/h`"},
    {"kmh", "write `km/h`"},
    {"kmph", "write `km/h`"},
    {"fps", "write `ft/s`"},
    {"mps", "write `m/s`"},
    {"kt", "a knot is 1.852 km/h"},
    {"knot", "a knot is 1.852 km/h"},
    {"knots", "a knot is 1.852 km/h"},
    {"rps", "write `rev/s`"},
    {"cps", "write `Hz`"},
    {"Nm", "write `N*m`"},
    {"kNm", "write `kN*m`"},
    {"Nmm", "write `N*mm`"},
    {"Ncm", "write `N*cm`"},
    {"Ns", "write `N*s`"},
    {"Ws", "write `W*s`"},
    {"kWh", "write `kW*h`"},
    {"ftlb", "write `ft*lbf`"},
    {"ftlbf", "write `ft*lbf`"},
    {"lbft", "write `lbf*ft`"},
    {"lbfft", "write `lbf*ft`"},
    {"inlb", "write `in*lbf`"},
    {"inlbf", "write `in*lbf`"},
    {"lbin", "write `lbf*in`"},
    {"psf", "write `lbf/ft^2`"},
    {"ksi", "1 ksi is 1000 psi"},
    {"bar", "1 bar is 100 kPa"},
    {"atm", "1 atm is 101.325 kPa"},
    {"MJ", "1 MJ is 1000 kJ"},
    {"MW", "1 MW is 1000 kW"},
    {"mW", "1 mW is 0.001 W"},
    {"mJ", "1 mJ is 0.001 J"},
    {"cal", "1 cal is 4.184 J"},
    {"kHz", "1 kHz is 1000 Hz"},
    {"PS", "1 PS is 735.49875 W"},
    {"dm", "1 dm is 10 cm"},
    {"um", "1 um is 0.001 mm"},
    {"nm", "1 nm is 1e-6 mm; a moment is `N*m`"},
    {"ns", "1 ns is 0.001 us"},
    {"d", "a day is 24 h"},
    {"day", "a day is 24 h"},
    {"days", "a day is 24 h"},
    {"grad", "1 grad is 0.9 deg"},
    {"gon", "1 gon is 0.9 deg"},
    {"L", "a litre is 1000 cm^3"},
    {"l", "a litre is 1000 cm^3"},
    {"e", "the exponent of a number takes no blank: 1e3"},
    {"E", "the exponent of a number takes no blank: 1e3"},
    {"degC", "a difference of temperature is in `K`; count temperatures from a reference"},
    {"degF", "a difference of temperature is in `K`: 1 degF is 0.5556 K"},
    {"kV", "1 kV is 1000 V"},
    {"kohm", "1 kohm is 1000 ohm"},
    {"Ohm", "write `ohm`"},
    {"uH", "1 uH is 0.001 mH"},
    {"uF", "a farad is 1 C/V"},
    {"Wb", "write `V*s`"},
    {"T", "write `V*s/m^2`"},
};

/* Words for units, each also with an `s` for the plural, without regard to case. */
static const char *const words[][2] = {
    {"meter", "m"},        {"metre", "m"},       {"centimeter", "cm"},  {"centimetre", "cm"},
    {"millimeter", "mm"},  {"millimetre", "mm"}, {"kilometer", "km"},   {"kilometre", "km"},
    {"inch", "in"},        {"inche", "in"},      {"foot", "ft"},        {"feet", "ft"},
    {"yard", "yd"},        {"mile", "mi"},       {"gram", "g"},         {"kilogram", "kg"},
    {"kilo", "kg"},        {"kg", "kg"},         {"milligram", "mg"},   {"tonne", "t"},
    {"slug", "slug"},      {"sec", "s"},         {"second", "s"},       {"msec", "ms"},
    {"millisecond", "ms"}, {"usec", "us"},       {"microsecond", "us"}, {"minute", "min"},
    {"min", "min"},        {"hr", "h"},          {"hour", "h"},         {"newton", "N"},
    {"kilonewton", "kN"},  {"kip", "kip"},       {"pascal", "Pa"},      {"joule", "J"},
    {"watt", "W"},         {"kilowatt", "kW"},   {"horsepower", "hp"},  {"radian", "rad"},
    {"rad", "rad"},        {"degree", "deg"},    {"deg", "deg"},        {"turn", "rev"},
    {"revolution", "rev"}, {"rev", "rev"},       {"cycle", "rev"},      {"hertz", "Hz"},
    {"lbf", "lbf"},        {"lbm", "lbm"},       {"ampere", "A"},       {"amp", "A"},
    {"volt", "V"},         {"henry", "H"},       {"coulomb", "C"},      {"kelvin", "K"},
};

static char small(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool same_word(const char *word, const char *text, size_t length)
{
    if (strlen(word) != length) return false;
    for (size_t i = 0; i < length; i++)
        if (small(word[i]) != small(text[i])) return false;
    return true;
}

static const char *find_word(const char *name, size_t length)
{
    bool plural = length > 1 && small(name[length - 1]) == 's';
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (same_word(words[i][0], name, length) || (plural && same_word(words[i][0], name, length - 1)))
            return words[i][1];
    for (size_t i = 0; i < row_count; i++)
        if (same_word(table[i].name, name, length)) return table[i].name;
    return NULL;
}

const char *unit_suggest(fbd_errors *errors, const char *name, size_t length)
{
    enum { longest = 32 };
    const char *names[row_count];
    for (size_t i = 0; i < sizeof habits / sizeof habits[0]; i++)
        if (is_called(habits[i][0], name, length)) return habits[i][1];
    char copy[longest + 1];
    const size_t copied = length < longest ? length : longest;
    memcpy(copy, name, copied);
    copy[copied] = '\0';
    const char *word = find_word(name, length);
    if (word) return diag_replace(errors, copy, word, "write `%s`", word);
    for (size_t i = 0; i < sizeof habits / sizeof habits[0]; i++)
        if (same_word(habits[i][0], name, length)) return habits[i][1];
    for (size_t i = 0; i < row_count; i++) names[i] = table[i].name;
    return diag_nearest(errors, copy, names, row_count);
}
