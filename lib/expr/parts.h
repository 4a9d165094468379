/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parts: the form of the most common force laws, which is evaluated without a program.
 *
 *   sum of c u^n, c sin(w u + p) and c cos(w u + p),  u being t, a coordinate or a rate
 *
 * as in F*sin(w*t), -k*x - k3*x^3, a*t + b*v. Only formulas written in this form are accepted: terms are not
 * multiplied out or reordered, so the results are bitwise those of the program.
 */
#ifndef FBD_EXPR_PARTS_H
#define FBD_EXPR_PARTS_H

#include <math.h>

#include "expr/program.h"

enum { most_parts = 6 };

struct expr_part {
    enum part_kind { part_power, part_sin, part_cos } kind;
    int power;    /* 0 to 3 */
    int variable; /* u: index into the slots of the expression, -1 for t */
    double c;
    double w, p;
};

/* Set the parts of a finished program, in `arena`, if it has that form. False when memory is out. */
bool parts_make(struct expr *expr, struct arena *scratch, struct arena *arena);

static inline double part_power_of(double u, int n)
{
    switch (n) {
    case 0: return 1;
    case 1: return u;
    case 2: return u * u;
    default: return u * (u * u);
    }
}

static inline double part_value(const struct expr_part *part, double u)
{
    if (part->kind == part_power) return part->c * part_power_of(u, part->power);
    double angle = part->w * u;
    if (part->p != 0) angle += part->p;
    return part->c * (part->kind == part_sin ? sin(angle) : cos(angle));
}

static inline double part_variable(const struct expr *expr, const struct expr_part *part, double t,
                                   const double *y)
{
    return part->variable < 0 ? t : y[expr->slots[part->variable] - 1];
}

/* In the header, to be inlined into the calling loop. */
static inline double parts_run(const struct expr *expr, double t, const double *y)
{
    const struct expr_part *part = expr->parts, *end = part + expr->part_count;
    double sum = part_value(part, part_variable(expr, part, t, y));
    while (++part < end) sum += part_value(part, part_variable(expr, part, t, y));
    return sum;
}

#endif
