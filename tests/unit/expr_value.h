/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Values of texts in the world of expr_scope.h, at one instant and in one state of it.
 */
#ifndef TESTS_EXPR_VALUE_H
#define TESTS_EXPR_VALUE_H

#include "expr_scope.h"

static const double here[] = {0.3, -0.5, 1.25, 2, 3}; /* x, v, theta, omega, crank.theta */
static const double now = 1.5;

static inline double value_of(const char *text)
{
    struct trial trial = must_compile(text);
    double value = expr_eval(trial.expr, now, here, NULL);
    end_trial(&trial);
    return value;
}

#endif
