/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names for the tests of notations: those of a derivation. Each has a value, by its place in the list; `y` and the single
 * letters of `pure` are pure numbers that no unit is like.
 */
#ifndef TESTS_NOTATION_SCOPE_H
#define TESTS_NOTATION_SCOPE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after its prerequisites */
#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "expr/notation.h"

struct notation_name {
    const char *name;
    struct dim dim;
};

/* A pendulum and a block in one: accelerations, forces, another body. */
static const struct notation_name derivation_names[] = {
    {"t", DIM_INIT(0, 0, 1)},          {"x", DIM_INIT(0, 1, 0)},         {"x_dot", DIM_INIT(0, 1, -1)},
    {"v", DIM_INIT(0, 1, -1)},         {"x_ddot", DIM_INIT(0, 1, -2)},   {"v_dot", DIM_INIT(0, 1, -2)},
    {"a", DIM_INIT(0, 1, -2)},         {"theta", DIM_INIT(0, 0, 0)},     {"theta_dot", DIM_INIT(0, 0, -1)},
    {"omega", DIM_INIT(0, 0, -1)},     {"alpha", DIM_INIT(0, 0, -2)},    {"theta_ddot", DIM_INIT(0, 0, -2)},
    {"omega_dot", DIM_INIT(0, 0, -2)}, {"phi", DIM_INIT(0, 0, 0)},       {"m", DIM_INIT(1, 0, 0)},
    {"g", DIM_INIT(0, 1, -2)},         {"k", DIM_INIT(1, 0, -2)},        {"c", DIM_INIT(1, 0, -1)},
    {"L", DIM_INIT(0, 1, 0)},          {"I_O", DIM_INIT(1, 2, 0)},       {"I_G", DIM_INIT(1, 2, 0)},
    {"N", DIM_INIT(1, 1, -2)},         {"F", DIM_INIT(1, 1, -2)},        {"mu", DIM_INIT(0, 0, 0)},
    {"mu_s", DIM_INIT(0, 0, 0)},       {"mu_k", DIM_INIT(0, 0, 0)},      {"m_1", DIM_INIT(1, 0, 0)},
    {"m2", DIM_INIT(1, 0, 0)},         {"ax", DIM_INIT(0, 1, -2)},       {"vy_dot", DIM_INIT(0, 1, -2)},
    {"A.x", DIM_INIT(0, 1, 0)},        {"A.x_ddot", DIM_INIT(0, 1, -2)}, {"rod2.theta", DIM_INIT(0, 0, 0)},
    {"m_R", DIM_INIT(1, 0, 0)},        {"R", DIM_INIT(0, 1, 0)},         {"x0", DIM_INIT(0, 1, 0)},
    {"v_0", DIM_INIT(0, 1, -1)},       {"lambda", DIM_INIT(1, -1, 0)},
};

/* Pure numbers, for expressions whose dimensions are no matter. */
static const struct notation_name pure_names[] = {
    {"y", DIM_INIT(0, 0, 0)},      {"m", DIM_INIT(0, 0, 0)},         {"g", DIM_INIT(0, 0, 0)},
    {"k", DIM_INIT(0, 0, 0)},      {"b", DIM_INIT(0, 0, 0)},         {"L", DIM_INIT(0, 0, 0)},
    {"R", DIM_INIT(0, 0, 0)},      {"F", DIM_INIT(0, 0, 0)},         {"q", DIM_INIT(0, 0, 0)},
    {"theta", DIM_INIT(0, 0, 0)},  {"theta_dot", DIM_INIT(0, 0, 0)}, {"theta_ddot", DIM_INIT(0, 0, 0)},
    {"x", DIM_INIT(0, 0, 0)},      {"x_dot", DIM_INIT(0, 0, 0)},     {"x_ddot", DIM_INIT(0, 0, 0)},
    {"mu_k", DIM_INIT(0, 0, 0)},   {"m_1", DIM_INIT(0, 0, 0)},       {"omega", DIM_INIT(0, 0, 0)},
    {"lambda", DIM_INIT(0, 0, 0)},
};

struct notation_names {
    const struct notation_name *names;
    size_t count;
};

#define NAMES(list)                                                                                          \
    {                                                                                                        \
        (list), sizeof(list) / sizeof *(list)                                                                \
    }

static inline struct notation_names *derivation(void)
{
    static struct notation_names names = NAMES(derivation_names);
    return &names;
}

static inline struct notation_names *pure(void)
{
    static struct notation_names names = NAMES(pure_names);
    return &names;
}

static inline struct symbol notation_lookup(void *context, const char *name, struct pos at)
{
    const struct notation_names *names = context;
    (void)at;
    for (size_t i = 0; i < names->count; i++)
        if (strcmp(names->names[i].name, name) == 0)
            return (struct symbol){.kind = symbol_variable, .dim = names->names[i].dim, .slot = (int)i + 1};
    return (struct symbol){.kind = symbol_unknown};
}

static inline struct scope notation_scope(struct notation_names *names)
{
    return (struct scope){.lookup = notation_lookup, .context = names, .units = unit_si};
}

#endif
