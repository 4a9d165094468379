/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of dimensions: the quantity, its coherent unit, and common units.
 */
#include <stdio.h>
#include <string.h>

#include "expr/unit.h"

struct quantity {
    struct dim dim;
    const char *name;
    const char *si, *us; /* the coherent unit if not composed by rule */
    const char *examples;
};

static const struct quantity quantities[] = {
    {DIM_INIT(0, 0, 0), "pure number", "", "", "rad, deg, rev"},
    {DIM_INIT(1, 0, 0), "mass", "kg", "slug", "kg, g, t, lbm, slug"},
    {DIM_INIT(0, 1, 0), "length", "m", "ft", "m, mm, cm, km, in, ft"},
    {DIM_INIT(0, 0, 1), "time", "s", "s", "s, ms, min, h"},
    {DIM_INIT(0, 1, -1), "velocity", "m/s", "ft/s", "m/s, km/h, ft/s, mi/h"},
    {DIM_INIT(0, 1, -2), "acceleration", "m/s^2", "ft/s^2", "m/s^2, ft/s^2"},
    {DIM_INIT(0, 1, -3), "jerk", NULL, NULL, "m/s^3, ft/s^3"},
    {DIM_INIT(0, 0, -1), "angular velocity or rate", "rad/s", "rad/s", "rad/s, deg/s, rpm, rev/s, 1/s, Hz"},
    {DIM_INIT(0, 0, -2), "angular acceleration", "rad/s^2", "rad/s^2", "rad/s^2, deg/s^2, rev/s^2"},
    {DIM_INIT(0, 2, 0), "area", NULL, NULL, "m^2, cm^2, in^2, ft^2"},
    {DIM_INIT(0, 3, 0), "volume", NULL, NULL, "m^3, cm^3, in^3, ft^3"},
    {DIM_INIT(1, 1, -2), "force", "N", "lbf", "N, kN, lbf, kip"},
    {DIM_INIT(1, 1, -3), "force per time", NULL, NULL, "N/s, kN/s, lbf/s"},
    {DIM_INIT(1, 2, -2), "moment or energy", NULL, NULL, "N*m, N*mm, kN*m, J, lbf*ft, lbf*in"},
    {DIM_INIT(1, 2, -3), "power", "W", "lbf*ft/s", "W, kW, hp, lbf*ft/s"},
    {DIM_INIT(1, 2, 0), "moment of inertia", NULL, NULL, "kg*m^2, kg*cm^2, slug*ft^2, lbm*ft^2"},
    {DIM_INIT(1, 0, -2), "stiffness", NULL, NULL, "N/m, kN/m, N/mm, lbf/ft, lbf/in"},
    {DIM_INIT(1, -2, -2), "cubic stiffness", NULL, NULL, "N/m^3, lbf/ft^3"},
    {DIM_INIT(1, 0, -1), "damping or flow of mass", NULL, NULL, "N*s/m, kg/s, lbf*s/ft"},
    {DIM_INIT(1, 2, -1), "angular damping or angular momentum", NULL, NULL, "N*m*s/rad, N*m*s, lbf*ft*s/rad"},
    {DIM_INIT(1, -1, 0), "quadratic drag or mass per length", NULL, NULL, "N*s^2/m^2, kg/m, lbf*s^2/ft^2"},
    {DIM_INIT(1, 1, -1), "momentum or impulse", NULL, NULL, "N*s, kg*m/s, lbf*s"},
    {DIM_INIT(1, -1, -2), "pressure", "Pa", NULL, "Pa, kPa, MPa, GPa, psi"},
    {DIM_ALL(0, 0, 0, 1, 0), "electric current", "A", "A", "A, mA"},
    {DIM_ALL(1, 2, -3, -1, 0), "voltage", "V", NULL, "V, mV"},
    {DIM_ALL(1, 2, -3, -2, 0), "resistance", "ohm", NULL, "ohm, V/A"},
    {DIM_ALL(1, 2, -2, -2, 0), "inductance", "H", NULL, "H, mH, V*s/A"},
    {DIM_ALL(1, 2, -2, -1, 0), "magnetic flux", "V*s", NULL, "V*s, N*m/A"},
    {DIM_ALL(0, 0, 1, 1, 0), "electric charge", "C", "C", "C, A*s"},
    {DIM_ALL(-1, -2, 4, 2, 0), "capacitance", "C/V", NULL, "C/V"},
    {DIM_ALL(0, 0, 0, 0, 1), "temperature", "K", "K", "K"},
    {DIM_INIT(1, -3, 0), "density", NULL, NULL, "kg/m^3, g/cm^3, slug/ft^3, lbm/ft^3"},
};

static const struct quantity *find(struct dim dim)
{
    for (size_t i = 0; i < sizeof quantities / sizeof quantities[0]; i++)
        if (dim_equal(quantities[i].dim, dim)) return &quantities[i];
    return NULL;
}

const char *unit_quantity(struct dim dim)
{
    const struct quantity *quantity = find(dim);
    return quantity ? quantity->name : NULL;
}

void unit_examples(struct dim dim, char *buffer, size_t size)
{
    const struct quantity *quantity = find(dim);
    snprintf(buffer, size, "%s", quantity ? quantity->examples : "");
}

const char *unit_name_energy(enum unit_system system)
{
    return system == unit_si ? "J" : "ft*lbf";
}

/* ---- composing */

struct power {
    const char *name;
    int twelfths;
};

static void append(char *buffer, size_t size, const char *piece)
{
    size_t used = strlen(buffer);
    if (used < size) snprintf(buffer + used, size - used, "%s", piece);
}

static int common_divisor(int a, int b)
{
    return b == 0 ? a : common_divisor(b, a % b);
}

static void append_power(char *buffer, size_t size, const char *name, int twelfths)
{
    char text[48];
    int divisor = common_divisor(twelfths, dim_unit);
    int over = twelfths / divisor, under = dim_unit / divisor;
    if (under != 1)
        snprintf(text, sizeof text, "%s^(%d/%d)", name, over, under);
    else if (over != 1)
        snprintf(text, sizeof text, "%s^%d", name, over);
    else
        snprintf(text, sizeof text, "%s", name);
    append(buffer, size, text);
}

/* Numerators joined by `*`, then `/` and the denominators, in parentheses when there are several. */
static void compose(const struct power *powers, size_t count, char *buffer, size_t size)
{
    int below = 0, above = 0;
    for (size_t i = 0; i < count; i++) {
        if (powers[i].twelfths < 0) below++;
        if (powers[i].twelfths <= 0) continue;
        if (above++) append(buffer, size, "*");
        append_power(buffer, size, powers[i].name, powers[i].twelfths);
    }
    if (!below) return;
    append(buffer, size, above ? "/" : "1/");
    if (below > 1) append(buffer, size, "(");
    bool first = true;
    for (size_t i = 0; i < count; i++) {
        if (powers[i].twelfths >= 0) continue;
        if (!first) append(buffer, size, "*");
        first = false;
        append_power(buffer, size, powers[i].name, -powers[i].twelfths);
    }
    if (below > 1) append(buffer, size, ")");
}

void unit_name(struct dim dim, enum unit_system system, char *buffer, size_t size)
{
    if (size == 0) return;
    buffer[0] = '\0';
    const struct quantity *quantity = find(dim);
    const char *known = !quantity ? NULL : system == unit_si ? quantity->si : quantity->us;
    if (known) {
        append(buffer, size, known);
        return;
    }
    const char *length = system == unit_si ? "m" : "ft";
    /* A unit with mass to the first power and a negative power of time is composed of a force (N*m, N*s/m,
     * N/m^3); otherwise of a mass (kg*m^2, kg/m^3). */
    if (dim.mass == dim_unit && dim.time < 0) {
        struct power by_force[] = {{system == unit_si ? "N" : "lbf", dim_unit},
                                   {length, dim.length - dim_unit},
                                   {"s", dim.time + 2 * dim_unit},
                                   {"A", dim.current},
                                   {"K", dim.temperature}};
        compose(by_force, sizeof by_force / sizeof by_force[0], buffer, size);
        return;
    }
    struct power by_mass[] = {{system == unit_si ? "kg" : "slug", dim.mass},
                              {length, dim.length},
                              {"s", dim.time},
                              {"A", dim.current},
                              {"K", dim.temperature}};
    compose(by_mass, sizeof by_mass / sizeof by_mass[0], buffer, size);
}
