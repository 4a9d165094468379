/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Directional derivatives: the instantaneous dependence of rates and accelerations on coordinates, rates and
 * inputs.
 *
 * They are exact (fbd_state_derivatives). Those by an input are taken at a state that holds it (plant_held_state), so that no call
 * but the first may compile a model.
 */
#ifndef FBD_FMI_DERIVATIVE_H
#define FBD_FMI_DERIVATIVE_H

#include "fmi/instance.h"

struct derivative_call {
    const char *function;
    const unsigned *unknowns;
    size_t unknown_count;
    const unsigned *knowns;
    size_t known_count;
    const double *seed; /* of the knowns; adjoint: of the unknowns */
    double *answer;     /* for the unknowns; adjoint: for the knowns */
    bool adjoint;
};

enum instance_status derivative_get(struct instance *instance, const struct derivative_call *call);

#endif
