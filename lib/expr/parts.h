/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parts: the form of the commonest force laws, which needs no program at run time.
 *
 *     sum of c u^n, c sin(w u + p) and c cos(w u + p),    u being t, a coordinate or a rate
 *
 * as in F*sin(w*t), -k*x - k3*x^3, a*t + b*v. Only what has this shape as it is written is taken: nothing is
 * multiplied out or put in another order, so the bits are those of the program.
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

/* Give a finished program its parts, in `arena`, if it has that shape. False when memory is out. */
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

/* Here, to be a part of the loop that asks for it. */
static inline double parts_run(const struct expr *expr, double t, const double *y)
{
    const struct expr_part *part = expr->parts, *end = part + expr->part_count;
    double sum = part_value(part, part_variable(expr, part, t, y));
    while (++part < end) sum += part_value(part, part_variable(expr, part, t, y));
    return sum;
}

#endif
