/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Common declarations of the files that write expressions.
 */
#ifndef FBD_EMIT_EXPRESSION_H
#define FBD_EMIT_EXPRESSION_H

#include "emit/emit.h"

/* Operator precedence of the text of a register. */
enum bond { bond_choice, bond_truth, bond_sum, bond_product, bond_sign, bond_whole };

struct piece {
    const char *text;
    enum bond bond;
};

struct reading {
    struct emitter *emitter;
    const struct expr *expr;
    struct piece *registers;
    struct emit_switch *switches; /* NULL if not required */
    int first;
    bool dual; /* values with their derivatives by `slot` */
    int slot;
};

/* As emit_expression, with the derivatives by a slot: a struct dual. */
const char *emit_dual(struct emitter *emitter, const struct expr *expr, int first, int slot);

/* The dual-number function of an operation; NULL for a switch with piecewise constant value. */
const char *emit_dual_name(unsigned op);
bool emit_dual_takes_two(unsigned op);

#endif
