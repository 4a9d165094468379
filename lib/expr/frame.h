/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Filling the frame of a program (see program.h) before its instructions run. Each component of a number that
 * is more than a double (rate, second derivative, rounding bound) has an array of its own.
 */
#ifndef FBD_EXPR_FRAME_H
#define FBD_EXPR_FRAME_H

#include <string.h>

#include "expr/program.h"

/* The values of variables and constants. */
static inline void frame_values(const struct expr *expr, double t, const double *y, double *value)
{
    size_t n = 0;
    if (expr->uses_time) value[n++] = t;
    for (size_t i = 0; i < expr->variables; i++) value[n++] = y[expr->slots[i] - 1];
    for (size_t i = 0; i < expr->constants; i++) value[n++] = expr->constant[i];
}

/* Their rates along (dt, dy); dy may be NULL for zero. */
static inline void frame_rates(const struct expr *expr, double dt, const double *dy, double *rate)
{
    size_t n = 0;
    if (expr->uses_time) rate[n++] = dt;
    for (size_t i = 0; i < expr->variables; i++) rate[n++] = dy ? dy[expr->slots[i] - 1] : 0;
    for (size_t i = 0; i < expr->constants; i++) rate[n++] = 0;
}

/* Their derivatives with respect to one slot. */
static inline void frame_slot(const struct expr *expr, int slot, double *rate)
{
    size_t n = 0;
    if (expr->uses_time) rate[n++] = slot == 0;
    for (size_t i = 0; i < expr->variables; i++) rate[n++] = slot == expr->slots[i];
    for (size_t i = 0; i < expr->constants; i++) rate[n++] = 0;
}

#endif
