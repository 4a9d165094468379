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

#include "expr/program.h"

enum { most_parts = 6 };

struct part {
    enum part_kind { part_power, part_sin, part_cos } kind;
    int power; /* 0 to 3 */
    int index; /* of u in the state, -1 for t */
    double c;
    double w, p;
};

/* Give a finished program its parts, in `arena`, if it has that shape. False when memory is out. */
bool parts_make(struct expr *expr, struct arena *scratch, struct arena *arena);

double parts_run(const struct expr *expr, double t, const double *y);

#endif
