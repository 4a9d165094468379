/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Structure: a common property of the forces on an island, and the method that exploits it.
 *
 * `auto` analyses the forces once, before the run. The result holds for every state, so the analysis is not
 * repeated; if the motion turns out stiff, `auto` still switches to the stiff method.
 */
#ifndef FBD_LOOP_STRUCTURE_H
#define FBD_LOOP_STRUCTURE_H

#include "integrate/method.h"
#include "model/model.h"

enum structure {
    structure_general,       /* none of the others: the default method */
    structure_velocity_free, /* no force depends on a velocity: nystrom.h */
    structure_linear,        /* linear equations with constant coefficients between events: linear.h */
    structure_constant,      /* accelerations are constant between events: parabola.h */
    structure_flights,       /* the same while no contact is closed; else general */
    structure_fixed, /* no motion is possible in its positions (state_is_fixed); not returned by structure_of */
    structure_kinds
};

enum structure structure_of(const struct fbd_model *model);

/* The method for a structure. The general one is rk8pd; with user states dop853, whose dense output includes
 * them at three evaluations. */
const struct method *structure_method(const struct fbd_model *model, enum structure structure);

/* Is the force of a load constant while modes and branches last? That of friction, while it slips. */
bool structure_keeps_force(const struct fbd_model *model, const struct model_load *load);

/* Does that method make steps of any length without truncation error? */
static inline bool structure_is_exact(enum structure structure)
{
    return structure == structure_constant || structure == structure_fixed || structure == structure_linear;
}

/* Do steps extend to the next event? */
static inline bool structure_is_one_step(enum structure structure)
{
    return structure == structure_constant || structure == structure_fixed;
}

#endif
