/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Absolute rounding errors of formulas; a relative bound does not hold: (tanh(u + 3) - tanh(u - 3))/2 is a
 * staircase of 1e-16 far from u = 0, and the integration of a body at rest would follow each of its stairs.
 */
#ifndef FBD_DYNAMICS_LOAD_ROUNDING_H
#define FBD_DYNAMICS_LOAD_ROUNDING_H

#include "dynamics/diagram.h"
#include "dynamics/instant.h"
#include "dynamics/state.h"

/* The rounding of the formulas of a load: of its force [N], in its direction in the world, and of a couple [N
 * m]. Bounds, with the sign of each component. */
struct load_rounding {
    struct vec force;
    double couple;
};
struct load_rounding load_rounding(const struct fbd_model *model, size_t index, const struct instant *at);

/* That of one formula, in its own unit. */
double formula_rounding(const struct formula *formula, const struct instant *at);

/* That of the power of load `index` [W]. */
double load_power_rounding(const struct fbd_model *model, size_t index, const struct instant *at);

/* The effect of rounding at a state of an island or the whole, as energies. */
struct rounded {
    double places; /* force times distance of its point, and couples: one rounding of positions */
    double ways;   /* of unit time: force times the displacement of its body by it */
};

/* Of an evaluated state. */
struct rounded rounded_at(const struct fbd_state *state);

#endif
