/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Structure: what the forces on a group of bodies have in common, and the method that makes use of it.
 *
 * `auto` looks at the forces once, before the run. What it recognises holds for every state, so nothing is
 * asked again on the way; where the motion turns out stiff, `auto` still goes over to the method for that.
 */
#ifndef FBD_LOOP_STRUCTURE_H
#define FBD_LOOP_STRUCTURE_H

#include "integrate/method.h"
#include "model/model.h"

enum structure {
    structure_general,       /* nothing in particular: the default method */
    structure_velocity_free, /* no force depends on a velocity: nystrom.h */
    structure_linear,        /* linear equations with constant coefficients between events: linear.h */
    structure_constant,      /* accelerations are constant between events: parabola.h */
    structure_fixed, /* there is no way to move, as the bodies lie (state_is_fixed); structure_of never says so */
    structure_kinds
};

enum structure structure_of(const struct fbd_model *model);

/* The method for a structure. In general it is rk8pd; with states of the file's own dop853, which knows the inside of its
 * steps for them as well as for coordinates, at three evaluations. */
const struct method *structure_method(const struct fbd_model *model, enum structure structure);

/* Does that method make steps of any length without error? */
static inline bool structure_is_exact(enum structure structure)
{
    return structure == structure_constant || structure == structure_fixed || structure == structure_linear;
}

/* One step goes to the next event. */
static inline bool structure_is_one_step(enum structure structure)
{
    return structure == structure_constant || structure == structure_fixed;
}

#endif
