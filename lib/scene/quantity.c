/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/quantity.h"

static const struct {
    const char *name, *example;
    short mass, length, time;
} table[] = {
    [a_number] = {"a number", "0.5", 0, 0, 0},
    [an_angle] = {"an angle", "30 deg", 0, 0, 0},
    [a_mass] = {"a mass", "2 kg", 1, 0, 0},
    [a_length] = {"a length", "0.5 m", 0, 1, 0},
    [a_time] = {"a time", "2 s", 0, 0, 1},
    [a_velocity] = {"a velocity", "3 m/s", 0, 1, -1},
    [an_acceleration] = {"an acceleration", "9.81 m/s^2", 0, 1, -2},
    [an_angular_velocity] = {"an angular velocity", "2 rad/s", 0, 0, -1},
    [a_force] = {"a force", "5 N", 1, 1, -2},
    [a_moment] = {"a moment", "5 N*m", 1, 2, -2},
    [an_energy] = {"an energy", "5 J", 1, 2, -2},
    [a_power] = {"a power", "500 W", 1, 2, -3},
    [an_inertia] = {"a moment of inertia", "0.5 kg*m^2", 1, 2, 0},
    [a_stiffness] = {"a stiffness", "200 N/m", 1, 0, -2},
    [a_torsional_stiffness] = {"a torsional stiffness", "5 N*m/rad", 1, 2, -2},
    [a_damping] = {"a damping coefficient", "0.5 N*s/m", 1, 0, -1},
    [a_torsional_damping] = {"a torsional damping coefficient", "0.1 N*m*s/rad", 1, 2, -1},
    [a_quadratic_drag] = {"a quadratic drag coefficient", "0.2 N*s^2/m^2", 1, -1, 0},
    [a_parameter] = {"a number or quantity", "2 kg", 0, 0, 0},
};

struct dim quantity_dim(enum quantity quantity)
{
    return (struct dim){(short)(dim_unit * table[quantity].mass), (short)(dim_unit * table[quantity].length),
                        (short)(dim_unit * table[quantity].time), 0, 0};
}

const char *quantity_name(enum quantity quantity)
{
    return table[quantity].name;
}

const char *quantity_example(enum quantity quantity)
{
    return table[quantity].example;
}
