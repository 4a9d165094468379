/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A linearisation with inputs u and outputs y: x' = A x + B u, y = C x + D u, all as deviations from the equilibrium.
 *
 * B and D are exact: the derivatives of the accelerations by the inputs (api/input_slopes.h). In independent coordinates z
 * with q - q0 = T z (linearize.h) their rows are those of z, because the accelerations vanish at q0.
 *
 *     y                    row of C                    row of D
 *     coordinate           [T, 0]                      0
 *     rate                 [0, T]                      0
 *     acceleration         T [rows of z'' of A]        T [rows of z'' of B]
 *     place of a point     [J T, 0], J T e_k is its velocity for z' = e_k, and likewise its velocity and acceleration
 *     user state           that of the state           0
 */
#ifndef FBD_REST_LINEAR_SYSTEM_H
#define FBD_REST_LINEAR_SYSTEM_H

#include "base/arena.h"
#include "fbd_linear.h"
#include "rest/linearize.h"
#include "rest/transfer.h"

struct fbd_linear_system {
    struct arena arena;
    const struct fbd_linearization *linear;
    size_t input_count, output_count;
    fbd_signal *inputs, *outputs;
    double *B, *C, *D; /* size x inputs, outputs x size, outputs x inputs; row by row */
};

/* The part between an input and an output, reduced; in `arena`. False when memory is out. */
bool linear_system_siso(const struct fbd_linear_system *system, size_t input, size_t output,
                        struct arena *arena, struct siso *siso);

/* Frequencies [rad/s] of a plot of all responses: 50 in a decade, from a decade below the lowest frequency of poles and
 * zeros other than 0 to a decade above the highest, and those frequencies themselves. NULL when memory is out. */
double *linear_system_frequencies(const struct fbd_linear_system *system, struct arena *arena, size_t *count);

#endif
