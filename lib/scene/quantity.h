/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The physical quantities of the numbers in a model file.
 */
#ifndef FBD_SCENE_QUANTITY_H
#define FBD_SCENE_QUANTITY_H

#include "expr/dim.h"

enum quantity {
    a_number, /* pure */
    an_angle, /* pure; a bare number beyond one turn is suspect */
    a_mass,
    a_length,
    a_time,
    a_velocity,
    an_acceleration,
    an_angular_velocity,
    a_force,
    a_moment,
    an_energy,
    a_power,
    an_inertia,
    a_stiffness,
    a_torsional_stiffness,
    a_damping,
    a_torsional_damping,
    a_quadratic_drag,
    a_parameter, /* of any dimension */
};

struct dim quantity_dim(enum quantity quantity);

/* For messages: "a mass", and "2 kg". */
const char *quantity_name(enum quantity quantity);
const char *quantity_example(enum quantity quantity);

#endif
