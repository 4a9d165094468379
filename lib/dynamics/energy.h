/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Kinetic energy of bodies and potential energy of their conservative loads.
 */
#ifndef FBD_DYNAMICS_ENERGY_H
#define FBD_DYNAMICS_ENERGY_H

#include "dynamics/diagram.h"
#include "dynamics/state.h"

/* m v_G^2 / 2 + I_G omega^2 / 2; for a pivot I_O omega^2 / 2. */
double kinetic_energy(const struct model_body *body, const struct instant *at);

/* Of all bodies together; moves the links first, or expects them at the state (after state_misfit). */
double total_kinetic_energy(struct fbd_state *state);
double standing_kinetic_energy(struct fbd_state *state);

/* V of a load at an instant; 0 when it has none. A load by quadrature is integrated from its reference
 * (numeric/quadrature.h): `scratch` has plan_size entries. NAN when that fails. */
double potential_energy(const struct fbd_model *model, const struct model_load *load,
                        const struct instant *at, double *scratch);

#endif
