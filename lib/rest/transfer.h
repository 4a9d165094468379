/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The transfer function of a linear system with one input u and one output y:
 *
 *     x' = A x + b u,  y = c x + d u,  H(s) = c (s - A)^-1 b + d = gain prod(s - zeros) / prod(s - poles)
 *
 * States that the input does not reach, or that do not act on the output, by the zeros of A, b and c are left out:
 * independent bodies have no poles and zeros in H. Then A is balanced: states have different units.
 *
 * Zeros (A. Emami-Naeini, P. Van Dooren, Automatica 18 (1982) 415, for one input and one output): with d != 0 they are
 * the eigenvalues of A - b c/d. With d = 0 a reflection Q turns c into sigma e_n, so that y = sigma x_n. Where y = 0, x_n
 * is 0 too, and its equation is the output equation of a system with the same zeros without that state:
 * 0 = c' x + d' u with c' the last row of A without its last entry, d' = b_n. After r such reductions d' != 0: H falls as
 * s^-r, and its gain is the product of the sigmas and the last d'.
 */
#ifndef FBD_REST_TRANSFER_H
#define FBD_REST_TRANSFER_H

#include "base/arena.h"
#include "fbd_linear.h"

/* A system with one input and one output; A size x size, row by row. */
struct siso {
    size_t size;
    double *A, *b, *c, d;
};

struct transfer {
    size_t pole_count, zero_count;
    fbd_complex *poles, *zeros; /* by absolute value; of a pair the one with positive imaginary part first */
    double gain;                /* 0 where the input does not act on the output */
};

/* Leave out states without effect, and balance. False when memory is out. */
bool siso_reduce(struct siso *system, struct arena *arena);

/* Find poles, zeros and gain. 1 found, 0 eigenvalues not found or not finite, -1 out of memory. */
int transfer_find(const struct siso *system, struct arena *arena, struct transfer *transfer);

/* H(i omega), with infinite parts at a pole. False when memory is out. */
bool siso_response(const struct siso *system, struct arena *arena, double omega, fbd_complex *response);

/* The phase of H(i omega) [rad] as the sum of the phases of its factors, each continuous in omega: 0 for s = 0 in a factor
 * of the left half-plane, and -pi for a negative sign. A factor on the imaginary axis turns by pi in its frequency. */
double transfer_phase(const struct transfer *transfer, double omega);

#endif
