/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The rows of rates.h and their functions.
 */
#ifndef FBD_DYNAMICS_RATES_ROW_H
#define FBD_DYNAMICS_RATES_ROW_H

#include "dynamics/rates.h"
#include "dynamics/tree_bare.h"
#include "dynamics/tree_loop.h"

struct row {
    rates_function *function;
    const struct rates *all;
    int q, v;       /* indices of the coordinate and its rate in y */
    int link;       /* alone: its number */
    double inverse; /* 1/m, 1/I_O or 1/I_G */
    double c0, kq, kv;
    double s, c;
    double square;
    bool turns;      /* s or c is not zero */
    bool has_others; /* square is not zero, or there are formulas */
    double friction; /* against +x, in the present mode */
    double rate;     /* held: dx/dt */
    const struct formula_term *formulas;
    int formula_count;
    const struct expr_part *part; /* of a single formula with one part, else NULL */
    double scale;                 /* of that formula */
    int u;                        /* its variable in y, -1 for t */
    struct tree_bare *bare;
    const struct tree_loop *loop;
    double along[3]; /* the loads along the links of the loop, if constant */
};

struct rates {
    struct fbd_state *state;
    enum rates_kind kind;
    int count;
    struct row rows[];
};

rates_function scalar_row, held_row, no_row, alone_row, whole_row, bare_row, loop_row, driven_loop_row,
    loops_row, own_row, all_rows;

#endif
