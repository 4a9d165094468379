/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the files that write expressions share.
 */
#ifndef FBD_EMIT_EXPRESSION_H
#define FBD_EMIT_EXPRESSION_H

#include "emit/emit.h"

/* How tightly the text of a register binds. */
enum bond { bond_choice, bond_truth, bond_sum, bond_product, bond_sign, bond_whole };

struct piece {
    const char *text;
    enum bond bond;
};

struct reading {
    struct emitter *emitter;
    const struct expr *expr;
    struct piece *registers;
    struct emit_switch *switches; /* NULL when nobody asks */
    int first;
    bool dual; /* values with their derivatives by `slot` */
    int slot;
};

/* The same as emit_expression with the derivatives by a slot: a struct dual. */
const char *emit_dual(struct emitter *emitter, const struct expr *expr, int first, int slot);

/* The function of duals that does an operation, NULL for a switch whose value does not vary. */
const char *emit_dual_name(unsigned op);
bool emit_dual_takes_two(unsigned op);

#endif
