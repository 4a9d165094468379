/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What rounding within a formula does to its value is no share of that: (tanh(u + 3) - tanh(u - 3))/2 is a staircase of 1e-16
 * before it wakes up, and a body that it finds at rest would be followed over each of its stairs.
 */
#ifndef FBD_DYNAMICS_LOAD_ROUNDING_H
#define FBD_DYNAMICS_LOAD_ROUNDING_H

#include "dynamics/diagram.h"
#include "dynamics/instant.h"
#include "dynamics/state.h"

/* The rounding of the formulas of a load: of its force [N], in its direction in the world, and of a moment by itself
 * [N m]. Bounds, with one sign of each. */
struct load_rounding {
    struct vec force;
    double couple;
};
struct load_rounding load_rounding(const struct fbd_model *model, size_t index, const struct instant *at);

/* That of one formula, in its own unit. */
double formula_rounding(const struct formula *formula, const struct instant *at);

/* That of the power of load `index` [W]. */
double load_power_rounding(const struct fbd_model *model, size_t index, const struct instant *at);

/* The effect of rounding at a state of a group or of the whole, as energies. */
struct rounded {
    double
        places; /* every force times the distance of its point, and every couple: one rounding of all places */
    double ways; /* of unit time: every force times what it moves its body by alone */
};

/* Of an evaluated state; `arrows` is scratch: diagram_most_arrows. */
struct rounded rounded_at(const struct fbd_state *state, struct arrow *arrows);

#endif
