/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A row of parallelograms between cranks of one length on a line of axes (IFToMM benchmark A02 is the row
 * with rods of 1 m: Gonzalez, Dopico, Lugris and Cuadrado, Multibody System Dynamics 16 (2006)).
 *
 * What makes it hard: twice in each turn all rods lie in one line. There one row of each window loses its
 * slope, the windows could fold over, each by itself, and multipliers are quotients of two numbers that
 * vanish. The position is passed in some steps by chance, and in others a stage comes to lie next to it.
 *
 * Reference: all cranks turn alike, as one pendulum does: omega' = -K cos(theta), from which the energy gives
 * omega = -sqrt(omega_0^2 + 2 K (1 - sin(theta))) while it turns clockwise from the top.
 */
#ifndef FBD_TESTS_WINDOWS_H
#define FBD_TESTS_WINDOWS_H

#include "hard.h"

/* `windows` with rods of 1 kg: cranks of length a on axes L apart, on a line at angle phi. */
struct row_of_windows {
    int windows;
    double a, L, phi, omega;
    bool planar; /* every rod by itself in x, y and theta, every joint a pin; phi is 0 */
};

/* Its model file; the caller frees it. */
char *windows_text(const struct row_of_windows *row);

/* How far crank 0 is off its speed, as the energy gives it from its angle: relative. */
double windows_speed_off(const struct trial *trial, const struct row_of_windows *row);

/* Turn it for 10 s with a method, and check the pins and the speed all the way. */
void windows_turn(struct checks *checks, const struct row_of_windows *row, const struct hard_method *method);

#endif
