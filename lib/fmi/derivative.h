/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Directional derivatives: how rates and accelerations change at once with coordinates, rates and inputs.
 *
 * By coordinates and rates they are the exact Jacobian of the equations of motion. By an input they are that of a model in
 * which the input stands in the place of the time, and the time is a constant: the derivative by the time that its
 * dual numbers carry then is the one by the input.
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
